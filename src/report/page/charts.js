// The charts; Chart.js draws them.
'use strict';

// Round numbers around the finite decibels; infinite ones stand on the upper edge.
function decibelRange(values) {
  const finite = values.filter(Number.isFinite);
  if (finite.length === 0) return { min: 0, max: 60, step: 10 };
  const [least, most] = [Math.min(...finite), Math.max(...finite) + 1];
  const step = most - least > 25 ? 10 : 5;
  return { min: step * Math.floor(least / step), max: step * Math.ceil(most / step), step };
}

function decibelAxis(title, { min, max, step }, infinite) {
  return axis(title, { min, max, ticks: { stepSize: step, callback: (v) => (infinite && v === max ? '∞' : v) } });
}

function axis(title, more = {}) {
  return {
    title: { display: true, text: title, color: css('--muted') },
    grid: { color: css('--rule'), borderColor: css('--rule') },
    ...more,
    ticks: { color: css('--muted'), maxRotation: 0, autoSkipPadding: 12, ...more.ticks },
  };
}

function addChart(place, title, config) {
  const canvas = make('canvas', { role: 'img', 'aria-label': title });
  place.append(make('figure', {}, make('h3', {}, title), make('div', { class: 'plot' }, canvas)));
  const options = {
    animation: false,
    maintainAspectRatio: false,
    normalized: true,
    ...config.options,
    plugins: { legend: { display: false }, ...config.options.plugins },
  };
  const chart = new Chart(canvas, { ...config, options });
  report.charts.push({ title, place: place.parentElement.id, chart });
}

const workAxis = (clock) => (clock === 'points' ? 'points drawn [M]' : 'time of drawing [ms]');
const workOf = (columns, clock, i) => (clock === 'points' ? columns.points_drawn[i] / 1e6 : columns.ms[i]);

// A value a frame as a line for each method.
function lineChart(place, title, curves, { x, xTitle, measure, value, log = false }) {
  const values = curves.map((curve) => curve.columns.frame.map((_, i) => number(value(curve.columns, i))));
  const decibels = measure.unit === 'dB';
  const range = decibels ? decibelRange(values.flat().filter((v) => v !== null)) : {};
  const datasets = curves.map((curve, c) => ({
    label: curve.mode,
    data: values[c]
      .map((y, i) => ({ x: x(curve.columns, i), y: y === Infinity ? range.max : y, frame: i, real: y }))
      .filter((point) => point.y !== null && (!log || point.x > 0)),
    columns: curve.columns,
    showLine: true,
    borderColor: color(curve.mode),
    backgroundColor: color(curve.mode),
    borderWidth: 1.8,
    pointStyle: mark(curve.mode),
    pointRadius: curve.columns.frame.length > 60 ? 0 : 2.8,
    pointHoverRadius: 5,
    hidden: !visible(curve.mode),
  }));
  const yTitle = measure.unit ? `${measure.name} [${measure.unit}]` : measure.name;
  addChart(place, title, {
    type: 'scatter',
    data: { datasets },
    options: {
      scales: {
        x: axis(xTitle, log ? { type: 'logarithmic' } : { beginAtZero: true }),
        y: decibels
          ? decibelAxis(yTitle, range, values.flat().includes(Infinity))
          : axis(yTitle, { beginAtZero: measure.key !== 'ssim' }),
      },
      interaction: { mode: 'nearest', intersect: false },
      plugins: { tooltip: { callbacks: { label: (item) => tooltip(item, measure) } } },
    },
  });
}

function tooltip({ dataset, raw }, measure) {
  const { columns } = dataset;
  const i = raw.frame;
  const lines = [`${dataset.label}, frame ${columns.frame[i]}`, format.points(columns.points_drawn[i]) + ' points drawn'];
  if (timed) lines.push(format.ms(columns.ms[i]));
  lines.push(`${measure.name} ${raw.real === Infinity ? '∞' : Number(raw.real.toPrecision(5))} ${measure.unit}`);
  return lines;
}

// The repeats after the first would hide each other.
const firstRuns = () => ofDataset(report.curves).filter((curve) => curve.repeat === 0);

function drawCurves() {
  const place = $('#curves .charts');
  for (const [title, curves] of grouped(firstRuns().filter((curve) => curve.regime !== 'path'), routeName))
    lineChart(place, title, curves, {
      x: (columns, i) => workOf(columns, state.clock, i),
      xTitle: workAxis(state.clock),
      measure: state.measure,
      value: (columns, i) => columns[state.measure.key][i],
      log: state.log,
    });
}

function drawMoving() {
  const place = $('#moving .charts');
  for (const [title, curves] of grouped(firstRuns().filter((curve) => curve.regime === 'path'), (curve) => curve.view)) {
    const along = { x: (columns, i) => columns.frame[i], xTitle: 'frame' };
    const chart = (name, measure, value) => lineChart(place, `${title}: ${name}`, curves, { ...along, measure, value });
    chart(state.measure.name, state.measure, (columns, i) => columns[state.measure.key][i]);
    if (timed) chart('frame time', { name: 'frame time', unit: 'ms' }, (columns, i) => columns.frame_ms[i]);
    chart('flicker', { name: 'flicker', unit: 'levels of 255' }, (columns, i) => columns.flicker[i]);
    chart('reuse', { name: 'reuse', unit: 'share of pixels' }, (columns, i) => columns.reuse[i]);
  }
}

// Writes the method beside its mark, no name over another.
const names = {
  id: 'names',
  afterDatasetsDraw(chart) {
    const { ctx, data, chartArea } = chart;
    const labels = data.datasets
      .map((dataset, i) => ({ dataset, mark: chart.getDatasetMeta(i).data[0], shown: chart.isDatasetVisible(i) }))
      .filter(({ dataset, mark: at, shown }) => dataset.named && at && shown)
      .sort((a, b) => a.mark.y - b.mark.y);
    ctx.save();
    ctx.font = `600 12px ${Chart.defaults.font.family}`;
    ctx.textBaseline = 'middle';
    let least = chartArea.top + 8;
    labels.forEach(({ dataset, mark: at }, i) => {
      // Those below need their lines, too
      const y = Math.min(Math.max(at.y, least), chartArea.bottom - 8 - 15 * (labels.length - 1 - i));
      least = y + 15;
      const left = at.x > (chartArea.left + chartArea.right) / 2;
      ctx.textAlign = left ? 'right' : 'left';
      ctx.fillStyle = dataset.borderColor;
      ctx.fillText(dataset.label, at.x + (left ? -13 : 13), y);
    });
    ctx.restore();
  },
};

// T16, figure 1, right: frame rate against quality.
function drawRates() {
  const place = $('#rates .charts');
  if (!timed) return;
  for (const [title, runs] of grouped(firstRuns(), routeName)) {
    const summaries = ofDataset(report.study.summary);
    const of = (curve) => summaries.find((s) => s.mode === curve.mode && s.view === curve.view && s.regime === curve.regime);
    const decibels = runs.flatMap((curve) => [...curve.columns.psnr_db.map(number), number(of(curve).mean.psnr_db)]);
    const range = decibelRange(decibels);
    const clamp = (db) => Math.min(number(db), range.max);
    const rates = runs.flatMap((curve) => curve.columns.frame_ms.map((ms) => 1e3 / ms)).filter(Number.isFinite);
    const style = (curve) => ({
      label: curve.mode,
      borderColor: color(curve.mode),
      pointStyle: mark(curve.mode),
      hidden: !visible(curve.mode),
    });
    const means = runs.map((curve) => ({
      ...style(curve),
      named: true,
      data: [{ x: 1e3 / of(curve).frame_ms.p50, y: clamp(of(curve).mean.psnr_db) }].filter(({ x }) => Number.isFinite(x)),
      backgroundColor: color(curve.mode),
      pointRadius: 8,
      pointHoverRadius: 9,
    }));
    const frames = runs.map((curve) => ({
      ...style(curve),
      data: curve.columns.psnr_db
        .map((db, i) => ({ x: 1e3 / curve.columns.frame_ms[i], y: clamp(db) }))
        .filter((point) => Number.isFinite(point.x)),
      backgroundColor: color(curve.mode) + '66',
      borderWidth: 0,
      pointRadius: 3,
    }));
    addChart(place, title, {
      type: 'scatter',
      plugins: [names],
      data: { datasets: [...means, ...frames] },
      options: {
        scales: {
          x: axis('frames per second', { type: 'logarithmic', min: 0.8 * Math.min(...rates), max: 1.25 * Math.max(...rates) }),
          y: decibelAxis('PSNR [dB]', range, decibels.includes(Infinity)),
        },
        plugins: {
          tooltip: {
            callbacks: { label: ({ dataset, raw }) => `${dataset.label}: ${raw.x.toFixed(1)} frames/s, ${raw.y.toFixed(1)} dB` },
          },
        },
      },
    });
  }
}

const kParts = [['rounding', 'mse_rounding'], ['selection', 'mse_selection'], ['carry', 'mse_carry']];

// Paths by their mean, others by the first frame: what is there before anything was done about it.
const partsOf = (row) => (row.regime === 'path' ? row.mean : row.first);
const partsMoment = (row) => (row.regime === 'path' ? 'mean over frames' : 'first frame');

function drawParts() {
  const place = $('#parts .charts');
  const rows = ofDataset(report.study.summary).filter((row) => visible(row.mode));
  for (const [title, group] of grouped(rows, (row) => `${routeName(row)}: ${partsMoment(row)}`))
    addChart(place, title, {
      type: 'bar',
      data: {
        labels: group.map((row) => row.mode),
        datasets: kParts.map(([name, key]) => ({
          label: name,
          data: group.map((row) => partsOf(row)[key]),
          backgroundColor: css(`--${name}`),
          maxBarThickness: 26,
        })),
      },
      options: {
        indexAxis: 'y',
        scales: {
          x: axis('mean squared error [levels²]', { stacked: true, beginAtZero: true }),
          y: axis('', { stacked: true, grid: { display: false }, title: { display: false } }),
        },
        plugins: { legend: { display: true, labels: { color: css('--muted'), boxWidth: 12 } } },
      },
    });
}

function drawCharts() {
  for (const { chart } of report.charts) chart.destroy();
  report.charts = [];
  for (const place of document.querySelectorAll('.charts')) place.replaceChildren();
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  drawCurves();
  drawMoving();
  drawRates();
  drawParts();
  for (const section of ['curves', 'moving', 'rates'])
    $(`#${section}`).hidden = $(`#${section} .charts`).childElementCount === 0;
}
