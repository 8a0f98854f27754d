// Runs in the page after its own scripts: uses it as a reader would, and leaves what it found as JSON in <pre id="found">.
'use strict';
(async () => {
  const found = { errors: window.pageErrors, checks: {} };
  try {
    const check = (name, value) => { found.checks[name] = value; };
    const chartsIn = (place) => report.charts.filter((entry) => entry.place === place);
    const visibleSets = () => chartsIn('curves')[0].chart.data.datasets.filter((_, i) => chartsIn('curves')[0].chart.isDatasetVisible(i)).length;
    const click = (selector) => document.querySelector(selector).click();
    const cells = (mode) => Object.fromEntries([...document.querySelectorAll(`#summary tr[data-mode="${mode}"][data-regime="cold"] td[data-key]`)]
      .map((cell) => [cell.dataset.key, { text: cell.firstChild.textContent, points: cell.dataset.points, ms: cell.dataset.ms }]));

    check('title', document.title);
    check('theme', document.documentElement.dataset.theme);
    check('external', [...document.querySelectorAll('[src],link[href]')].map((n) => n.src || n.href).filter((url) => url && !url.startsWith('data:')));
    check('charts', report.charts.map(({ place, title }) => `${place}: ${title}`));
    check('hidden sections', [...document.querySelectorAll('main > section')].filter((s) => s.hidden).map((s) => s.id));

    // Methods
    const before = visibleSets();
    const rowsBefore = document.querySelectorAll('#summary tbody tr[data-mode]').length;
    click('#methods button[data-mode="hybrid"]');
    check('a method off', [visibleSets() - before, rowsBefore > document.querySelectorAll('#summary tbody tr[data-mode]').length,
      document.querySelector('#methods button[data-mode="hybrid"]').getAttribute('aria-pressed')]);
    click('#methods button[data-mode="hybrid"]');
    check('a method on again', visibleSets() - before);

    // Clocks
    const axis = () => chartsIn('curves')[0].chart.options.scales.x.title.text;
    const lineOf = (mode) => chartsIn('curves')[0].chart.data.datasets.find((set) => set.label === mode).data.map(({ x, y, real }) => [x, y, real === Infinity ? 'inf' : real]);
    const clocks = [...document.querySelectorAll('#clocks button')].map((button) => button.dataset.clock);
    check('clocks', clocks);
    const lines = {};
    for (const clock of clocks) {
      click(`#clocks button[data-clock="${clock}"]`);
      lines[clock] = { axis: axis(), line: lineOf('unstructured') };
    }
    check('lines', lines);
    click('#clocks button[data-clock="points"]');

    // Measures
    const measure = document.querySelector('#measure');
    measure.value = 'hole';
    measure.dispatchEvent(new Event('change'));
    check('holes', { title: chartsIn('curves')[0].chart.options.scales.y.title.text, line: lineOf('unstructured') });
    measure.value = 'psnr_db';
    measure.dispatchEvent(new Event('change'));

    check('cells', { unstructured: cells('unstructured'), hybrid: cells('hybrid') });
    check('scatter', chartsIn('rates').map(({ title, chart }) => [title, chart.data.datasets.filter((set) => set.named).map((set) => [set.label, set.data[0]])]));
    check('parts', chartsIn('parts').map(({ title, chart }) => [title, chart.data.labels, chart.data.datasets.map((set) => [set.label, set.data])]));

    // Pictures
    const sheet = document.querySelector('.sheet');
    check('scenes', [...document.querySelectorAll('#scene option')].map((o) => o.textContent));
    check('left', [...document.querySelectorAll('#left option')].map((o) => o.textContent));
    const size = async (selector) => { const image = document.querySelector(selector); await image.decode(); return [image.naturalWidth, image.naturalHeight]; };
    check('picture', await size('#left-image'));
    const brightest = () => {
      const canvas = document.querySelector('#difference');
      return canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.filter((_, i) => i % 4 !== 3).reduce((a, b) => Math.max(a, b), 0);
    };
    click('#ways button[data-way="difference"]');
    await drawDifference();
    const apart = brightest();
    document.querySelector('#left').value = document.querySelector('#right').value;
    await showPictures();
    check('difference', { class: sheet.className, apart, same: brightest() });
    click('#ways button[data-way="blink"]');
    const second = sheet.classList.contains('second');
    await new Promise((done) => setTimeout(done, 600));
    check('blinks', sheet.classList.contains('second') !== second);
    click('#ways button[data-way="slider"]');
    const box = sheet.getBoundingClientRect();
    sheet.dispatchEvent(new PointerEvent('pointerdown', { clientX: box.left + box.width / 4, buttons: 1 }));
    check('split', sheet.style.getPropertyValue('--split'));
    click('#films button.frame');
    check('opened from the film', document.querySelector('.tag.left').textContent);
    check('film frames', document.querySelectorAll('#films .frame').length);

    click('#theme');
    click('#theme');
    check('dark', [document.documentElement.dataset.theme, getComputedStyle(document.body).backgroundColor]);
    check('settings', document.querySelector('#settings').textContent.includes(report.study.gl_renderer));
    check('document', JSON.parse(document.querySelector('#document').textContent).schema);
  } catch (error) {
    found.errors.push(String(error.stack ?? error));
  }
  document.body.replaceChildren(Object.assign(document.createElement('pre'), { id: 'found', textContent: JSON.stringify(found) }));
})();
