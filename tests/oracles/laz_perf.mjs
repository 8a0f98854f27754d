// Decodes a LAZ file with laz-perf, as an npm package, and prints what it saw as JSON: points, and the sums of the first
// four fields that every point format has at the same place: x, y, z, intensity. RECORDS: a file to write all records
// to, as they stand in a LAS file.
//
//   node laz_perf.mjs NODE_MODULES FILE [RECORDS]
import { readFile, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import path from 'node:path';

const [modules, name, recordsName] = process.argv.slice(2);
const { createLazPerf } = createRequire(path.join(path.resolve(modules), 'any.js'))('laz-perf');
const perf = await createLazPerf();

const file = await readFile(name);
const bytes = perf._malloc(file.length);
perf.HEAPU8.set(file, bytes);
const reader = new perf.LASZip();
reader.open(bytes, file.length);

const length = reader.getPointLength();
const record = perf._malloc(length);
const count = reader.getCount();
const records = Buffer.alloc(recordsName ? count * length : 0);
const position = [0, 0, 0];
let intensity = 0;
for (let i = 0; i < count; ++i) {
  reader.getPoint(record);
  const view = new DataView(perf.HEAPU8.buffer, record, 14);
  for (let axis = 0; axis < 3; ++axis) position[axis] += view.getInt32(4 * axis, true);
  intensity += view.getUint16(12, true);
  if (recordsName) records.set(perf.HEAPU8.subarray(record, record + length), i * length);
}
if (recordsName) await writeFile(recordsName, records);
console.log(JSON.stringify({ points: count, position, intensity }));
