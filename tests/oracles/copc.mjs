// Reads a COPC file with copc, an npm package, and prints what it saw as JSON: nodes, pages of the hierarchy, points, a
// line "key points" of every node in alphabetical order, and the sums of the grid coordinates and of the colours.
//
//   node copc.mjs NODE_MODULES FILE
import { createRequire } from 'node:module';
import path from 'node:path';

const [modules, name] = process.argv.slice(2);
const { Copc } = createRequire(path.join(path.resolve(modules), 'any.js'))('copc');

const copc = await Copc.create(name);
const { scale, offset } = copc.header;
const seen = { nodes: [], pages: 0, points: 0, position: [0, 0, 0], rgb: [0, 0, 0] };

async function count(key, node) {
  seen.nodes.push(`${key} ${node.pointCount}`);
  if (node.pointCount === 0) return;
  const view = await Copc.loadPointDataView(name, copc, node);
  seen.points += view.pointCount;
  const axes = ['X', 'Y', 'Z'].map((axis) => view.getter(axis));
  const colours = view.dimensions.Red ? ['Red', 'Green', 'Blue'].map((colour) => view.getter(colour)) : [];
  for (let i = 0; i < view.pointCount; ++i) {
    axes.forEach((get, axis) => (seen.position[axis] += Math.round((get(i) - offset[axis]) / scale[axis])));
    colours.forEach((get, colour) => (seen.rgb[colour] += get(i)));
  }
}

const pages = [copc.info.rootHierarchyPage];
while (pages.length) {
  const page = await Copc.loadHierarchyPage(name, pages.pop());
  seen.pages += 1;
  for (const [key, node] of Object.entries(page.nodes)) await count(key, node);
  pages.push(...Object.values(page.pages));
}
seen.nodes.sort();
console.log(JSON.stringify(seen));
