// The page as a whole: head, controls, theme.
'use strict';

function drawHead() {
  const { datasets, settings, machine, failures } = report.study;
  const names = datasets.map((d) => d.name);
  $('#title').textContent = names.length ? names.join(', ') : 'Nothing was studied';
  document.title = `${names.join(', ')} – stipple study`;
  const points = datasets.reduce((sum, d) => sum + d.points_total, 0);
  $('#subtitle').textContent = [
    `${points.toLocaleString('en-US')} points`,
    `${methods.length} method${methods.length === 1 ? '' : 's'}`,
    `${settings.width} × ${settings.height}`,
    settings.target_fps ? `${settings.target_fps} frames/s wanted` : `${format.points(settings.budget_points)} points a frame`,
    report.study.gl_renderer,
    `${machine.cores} cores of ${machine.cpu}`,
  ].join(' · ');
  $('#program').textContent = `stipple ${report.study.version}`;
  if (failures.length)
    $('#notices').append(make('div', { class: 'notice' }, 'These failed, the rest is here:', make('ul', {}, ...failures.map((f) => make('li', {}, f)))));
  else if (!report.study.complete)
    $('#notices').append(make('div', { class: 'notice' }, 'The study was interrupted: this is what it had finished. The same command with --resume goes on.'));
}

function redraw() {
  drawCharts();
  drawTables();
  drawFilms();
}

function toggleButton(text, pressed, press) {
  const button = make('button', { type: 'button', 'aria-pressed': pressed }, ...text);
  button.addEventListener('click', press);
  return button;
}

function drawMethodToggles() {
  const toggle = (mode) => {
    if (visible(mode)) state.hidden.add(mode);
    else state.hidden.delete(mode);
    drawMethodToggles();
    redraw();
  };
  const button = (mode) => {
    const swatch = make('span', { class: 'swatch', style: `--color: var(${colorName(mode)})` });
    const node = toggleButton([swatch, mode], visible(mode), () => toggle(mode));
    node.dataset.mode = mode;
    return node;
  };
  $('#methods').replaceChildren(...methods.map(button));
}

function drawClocks() {
  const clocks = timed ? ['points', 'time'] : ['points'];
  const choose = (clock) => {
    state.clock = clock;
    drawClocks();
    redraw();
  };
  const buttons = clocks.map((clock) => {
    const node = toggleButton([clock], clock === state.clock, () => choose(clock));
    node.dataset.clock = clock;
    return node;
  });
  $('#clocks').replaceChildren(...buttons);
}

const systemTheme = matchMedia('(prefers-color-scheme: dark)');
function applyTheme(choice) {
  const theme = choice === 'auto' ? (systemTheme.matches ? 'dark' : 'light') : choice;
  document.documentElement.dataset.theme = theme;
  document.documentElement.dataset.choice = choice;
  $('#theme').textContent = { auto: 'Theme: system', light: 'Theme: light', dark: 'Theme: dark' }[choice];
}

function setUpControls() {
  const names = report.study.datasets.map((d) => d.name);
  $('#dataset').replaceChildren(...names.map((name) => make('option', {}, name)));
  $('#dataset-control').hidden = names.length < 2;
  $('#dataset').addEventListener('change', () => {
    state.dataset = $('#dataset').value;
    redraw();
    drawScenes();
  });
  $('#measure').replaceChildren(...kMeasures.map((m) => make('option', { value: m.key }, m.name)));
  $('#measure').addEventListener('change', () => {
    state.measure = kMeasures.find((m) => m.key === $('#measure').value);
    drawCharts();
  });
  $('#log').addEventListener('change', () => {
    state.log = $('#log').checked;
    drawCharts();
  });
  $('#theme').addEventListener('click', () => {
    const next = { auto: 'light', light: 'dark', dark: 'auto' };
    applyTheme(next[document.documentElement.dataset.choice]);
    drawCharts();
  });
  systemTheme.addEventListener('change', () => {
    applyTheme(document.documentElement.dataset.choice);
    drawCharts();
  });
}

// index.html#show=curves,compare: those sections alone, for slides and figures.
function showChosenSections() {
  const chosen = location.hash.match(/^#show=([\w,-]+)$/)?.[1].split(',');
  if (!chosen) return;
  for (const section of document.querySelectorAll('main > section')) section.classList.toggle('left-out', !chosen.includes(section.id));
  for (const part of document.querySelectorAll('header.page, nav.controls, footer'))
    part.classList.toggle('left-out', !chosen.includes('head'));
}

applyTheme('auto');
drawHead();
drawMethodToggles();
drawClocks();
setUpControls();
setUpCompare();
drawSettings();
redraw();
drawScenes();
showChosenSections();
