// Reads a Potree 2.0 tree with potree-core, the loader of the Potree viewer as an npm package, and prints what it saw as
// JSON: nodes, points, and the sums of the grid coordinates and of the colours. Exact: a node's coordinates are floats
// relative to its corner, where a grid step is far above their rounding.
//
//   node potree_core.mjs NODE_MODULES TREE
import { readFile } from 'node:fs/promises';
import { resolveObjectURL } from 'node:buffer';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';
import path from 'node:path';
import vm from 'node:vm';

const [modules, tree] = process.argv.slice(2);

// What a browser has and Node has not, as far as the loader asks: a worker that lives in this thread.
globalThis.self = globalThis;
globalThis.Worker = class {
  constructor(url) {
    this.queue = [];
    this.scope = null;
    this.start(String(url)).catch((error) => this.onerror?.(error) ?? fail(error));
  }
  async start(url) {
    const source = await resolveObjectURL(url).text();
    const scope = {
      postMessage: (data) => this.onmessage?.({ data }),
      console, performance, TextDecoder, TextEncoder, setTimeout, clearTimeout,
    };
    scope.self = scope;
    scope.globalThis = scope;
    vm.runInNewContext(source, scope);
    this.scope = scope;
    for (const message of this.queue.splice(0)) this.deliver(message);
  }
  deliver(data) {
    this.scope.onmessage({ data });
  }
  postMessage(data) {
    if (this.scope) this.deliver(data);
    else this.queue.push(data);
  }
  terminate() {}
};

function fail(error) {
  console.error(error);
  process.exit(1);
}
process.on('unhandledRejection', fail);

// Files instead of HTTP, with the ranges that the loader asks for.
const files = {
  getUrl: async (url) => path.join(tree, path.basename(url)),
  fetch: async (url, init) => {
    const bytes = await readFile(path.join(tree, path.basename(url)));
    const range = /bytes=(\d+)-(\d+)/.exec(init?.headers?.Range ?? '');
    return new Response(range ? bytes.subarray(Number(range[1]), Number(range[2]) + 1) : bytes);
  },
};

const entry = createRequire(path.join(path.resolve(modules), 'any.js')).resolve('potree-core');
const { Potree } = await import(pathToFileURL(entry));
const octree = await new Potree().loadPointCloud('metadata.json', files);
const geometry = octree.pcoGeometry;
const metadata = JSON.parse(await readFile(path.join(tree, 'metadata.json'), 'utf8'));

async function loaded(node) {
  node.load();
  for (let i = 0; i < 20000 && !node.loaded; ++i) {
    await new Promise((resolve) => setTimeout(resolve, 1));
    if (!node.loading && !node.loaded) node.load();
  }
  if (!node.loaded) fail(new Error(`node ${node.name} never came`));
}

const sums = { nodes: 0, points: 0, position: [0, 0, 0], rgb: [0, 0, 0] };

function count(node) {
  const { position, rgba } = node.geometry.attributes;
  const corner = node.boundingBox.min.toArray();
  sums.points += position.count;
  for (let i = 0; i < position.count; ++i)
    for (let axis = 0; axis < 3; ++axis) {
      const world = position.array[3 * i + axis] + corner[axis] + geometry.offset.toArray()[axis];
      sums.position[axis] += Math.round((world - metadata.offset[axis]) / metadata.scale[axis]);
    }
  if (rgba) for (let i = 0; i < rgba.count; ++i) for (let c = 0; c < 3; ++c) sums.rgb[c] += rgba.array[4 * i + c];
}

const open = [geometry.root];
while (open.length) {
  const node = open.pop();
  await loaded(node);
  sums.nodes += 1;
  if (node.geometry && node.numPoints > 0) count(node);
  open.push(...Object.values(node.children).filter(Boolean));
}
console.log(JSON.stringify(sums));
process.exit(0);
