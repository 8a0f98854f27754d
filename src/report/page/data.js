// What the page is made of, and how numbers are written.
'use strict';

const report = { ...JSON.parse(document.getElementById('data').textContent), charts: [] };

// JSON has no infinity: the study writes "inf".
const number = (value) => (value === 'inf' ? Infinity : value);

const kMeasures = [
  { key: 'psnr_db', name: 'PSNR', unit: 'dB' },
  { key: 'psnr_covered_db', name: 'PSNR, covered pixels', unit: 'dB' },
  { key: 'ssim', name: 'SSIM', unit: '' },
  { key: 'flip', name: 'FLIP', unit: '' },
  { key: 'hole', name: 'Holes', unit: 'share of pixels' },
  { key: 'see_through', name: 'See-through', unit: 'share of pixels' },
  { key: 'ghost', name: 'Ghosts', unit: 'share of pixels' },
  { key: 'wrong_point', name: 'Wrong points', unit: 'share of pixels' },
];
const kRegimes = {
  cold: 'from nothing',
  jump: 'after a jump',
  path: 'along the path',
  stop: 'after stopping',
  loading: 'while loading',
};
const kQualities = [
  ['30_db', '30 dB'], ['35_db', '35 dB'], ['40_db', '40 dB'], ['45_db', '45 dB'], ['identical', 'identical'],
];

const state = {
  dataset: report.study.datasets[0]?.name,
  clock: 'points',
  measure: kMeasures[0],
  log: false,
  hidden: new Set(),
};

const methods = [...new Set(report.curves.map((curve) => curve.mode))];
const visible = (mode) => !state.hidden.has(mode);
const routeName = (item) => `${item.view}, ${kRegimes[item.regime]}`;
const timed = report.study.settings.clock === 'wall';

// Every method has its colour and its mark, in all charts.
const kMarks = { 'brute-force': 'rectRot', hierarchical: 'circle', unstructured: 'triangle', hybrid: 'rect', lod: 'star', subsample: 'crossRot' };
const colorName = (mode) => (mode in kMarks ? `--${mode}` : '--other');
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const color = (mode) => css(colorName(mode));
const mark = (mode) => kMarks[mode] ?? 'rectRounded';

const format = {
  points: (n) => (n >= 1e6 ? `${(n / 1e6).toFixed(2)} M` : n >= 1e4 ? `${(n / 1e3).toFixed(0)} k` : n.toLocaleString('en-US')),
  ms: (ms) => (ms >= 1e4 ? `${(ms / 1e3).toFixed(1)} s` : ms >= 10 ? `${ms.toFixed(0)} ms` : `${ms.toFixed(2)} ms`),
  db: (db) => (number(db) === Infinity ? '∞ dB' : `${number(db).toFixed(2)} dB`),
  share: (x) => (x === null ? '–' : `${(100 * x).toFixed(x < 0.0995 ? 2 : 1)} %`),
  plain: (x, digits = 3) => (x === null || x === undefined ? '–' : x.toFixed(digits)),
};

// make('p', {class: 'muted'}, 'text', node, ...)
function make(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...children);
  return node;
}
const $ = (selector) => document.querySelector(selector);

// Rows of one kind that belong together, in the order in which they came: [[key, rows], ...].
function grouped(rows, keyOf) {
  const groups = new Map();
  for (const row of rows) {
    const key = keyOf(row);
    groups.set(key, [...(groups.get(key) ?? []), row]);
  }
  return [...groups];
}
const ofDataset = (rows) => rows.filter((row) => row.dataset === state.dataset);
const methodCell = (mode) => {
  const swatch = make('span', { class: 'swatch', style: `--color: var(${colorName(mode)})` });
  return make('span', { class: 'method' }, swatch, mode);
};
