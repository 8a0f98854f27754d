// The tables, and what was set.
'use strict';

function table(head, ...rows) {
  const cells = head.map((text) => make('th', { scope: 'col' }, text));
  return make('table', {}, make('thead', {}, make('tr', {}, ...cells)), make('tbody', {}, ...rows));
}
const groupRow = (title, columns) => make('tr', { class: 'group-row' }, make('td', { colspan: columns }, title));

// Bold where a row has the least of its group. `value` of a row may be null.
function leastOf(group, value) {
  const values = group.map(value).filter((v) => v !== null && v !== undefined);
  return values.length > 1 ? Math.min(...values) : undefined;
}

function reachedCell(row, key, group) {
  const reached = row.reached[key];
  if (!reached) return make('td', { 'data-key': key }, '–');
  const least = (what) => reached[what] === leastOf(group, (r) => r.reached[key]?.[what]);
  const cell = make('td', { 'data-key': key });
  cell.append(make('span', { class: least('points') ? 'best' : '' }, format.points(reached.points)));
  cell.dataset.points = reached.points;
  if (timed) {
    cell.dataset.ms = reached.ms_median;
    cell.append(make('span', { class: least('ms_median') ? 'time best' : 'time' }, format.ms(reached.ms_median)));
    if (row.repeats > 1)
      cell.append(make('span', { class: 'time' }, `${format.ms(reached.ms_min)} – ${format.ms(reached.ms_max)}`));
  }
  return cell;
}

function drawSummary() {
  const rows = ofDataset(report.study.summary).filter((row) => row.regime !== 'path' && visible(row.mode));
  const head = ['', ...kQualities.map(([, title]) => title), 'on the way', 'last frame', 'SSIM', 'FLIP', 'frames'];
  if (timed) head.push('P50 / P95 frame');
  const body = [];
  for (const [title, group] of grouped(rows, routeName)) {
    body.push(groupRow(title, head.length));
    for (const row of group) {
      const tr = make('tr', { 'data-mode': row.mode, 'data-view': row.view, 'data-regime': row.regime });
      tr.append(make('td', { title: row.reads }, methodCell(row.mode)));
      tr.append(...kQualities.map(([key]) => reachedCell(row, key, group)));
      tr.append(make('td', { 'data-key': 'area_db' }, format.db(row.area_db)));
      tr.append(make('td', { 'data-key': 'psnr_db' }, format.db(row.psnr_db)), make('td', {}, format.plain(row.ssim, 4)));
      tr.append(make('td', {}, format.plain(row.flip, 4)), make('td', {}, String(row.frames)));
      if (timed) tr.append(make('td', {}, `${format.ms(row.frame_ms.p50)} / ${format.ms(row.frame_ms.p95)}`));
      body.push(tr);
    }
  }
  $('#summary .scroll').replaceChildren(table(head, ...body));
  $('#summary').hidden = rows.length === 0;
}

function drawMotionSummary() {
  const rows = ofDataset(report.study.summary).filter((row) => row.regime === 'path' && visible(row.mode));
  const head = ['', 'PSNR', 'covered', 'SSIM', 'FLIP', 'holes', 'see-through', 'ghosts', 'flicker', 'reuse'];
  if (timed) head.push('P50', 'P95', 'P99', 'over target');
  const body = [];
  for (const [view, group] of grouped(rows, (row) => row.view)) {
    const target = timed && group[0].target_ms ? `; target ${format.ms(group[0].target_ms)} a frame` : '';
    body.push(groupRow(`${view}, ${group[0].frames} frames${target}`, head.length));
    for (const row of group) {
      const m = row.mean;
      const texts = [
        format.db(m.psnr_db), format.db(m.psnr_covered_db), format.plain(m.ssim, 4), format.plain(m.flip, 4),
        format.share(m.hole), format.share(m.see_through), format.share(m.ghost), format.plain(m.flicker, 2),
        format.share(m.reuse),
      ];
      if (timed) texts.push(...['p50', 'p95', 'p99'].map((p) => format.ms(row.frame_ms[p])), format.share(row.frames_over_target));
      const tr = make('tr', { 'data-mode': row.mode }, make('td', { title: row.reads }, methodCell(row.mode)));
      tr.append(...texts.map((text) => make('td', {}, text)));
      body.push(tr);
    }
  }
  $('#motion-summary .scroll').replaceChildren(table(head, ...body));
  $('#motion-summary').hidden = rows.length === 0;
}

function drawPartsTable() {
  const head = ['', 'at', 'MSE', ...kParts.map(([name]) => name)];
  const body = [];
  for (const [title, group] of grouped(ofDataset(report.study.summary).filter((row) => visible(row.mode)), routeName)) {
    body.push(groupRow(title, head.length));
    for (const row of group) {
      const parts = partsOf(row);
      const share = (key) => (parts.mse > 0 ? `${parts[key].toFixed(2)} (${((100 * parts[key]) / parts.mse).toFixed(1)} %)` : '0');
      const cells = [partsMoment(row), parts.mse.toFixed(2), ...kParts.map(([, key]) => share(key))];
      body.push(make('tr', {}, make('td', {}, methodCell(row.mode)), ...cells.map((text) => make('td', {}, text))));
    }
  }
  const routes = ofDataset([...report.study.views, ...report.study.paths]);
  body.push(groupRow('Rounding alone: each rasterizer, converged, against the reference', head.length));
  for (const route of routes)
    for (const [raster, rounding] of Object.entries(route.rounding))
      if (rounding)
        body.push(make('tr', {}, make('td', {}, `${route.name}: ${raster}`), make('td', {}, format.db(rounding.psnr_db)),
          make('td', {}, rounding.mse.toFixed(3)),
          make('td', { colspan: 3 }, `${rounding.pixels_different.toLocaleString('en-US')} of ${route.covered_pixels.toLocaleString('en-US')} covered pixels differ`)));
  $('#parts .scroll').replaceChildren(table(head, ...body));
}

function facts(title, entries) {
  const list = make('dl');
  for (const [name, value] of entries)
    if (value !== null && value !== undefined && value !== '') list.append(make('dt', {}, name), make('dd', {}, String(value)));
  return make('div', {}, make('h3', {}, title), list);
}

function drawSettings() {
  const { settings, machine, datasets, version } = report.study;
  const place = $('#settings .facts');
  place.append(
    facts('Machine', [
      ['processor', machine.cpu], ['cores', machine.cores], ['system', machine.system],
      ['OpenGL', `${report.study.gl_renderer}, ${report.study.gl_version}`], ['program', `stipple ${version}`],
    ]),
    facts('Settings', [
      ['picture', `${settings.width} × ${settings.height}, points of ${settings.point_size} px, background ${settings.background}`],
      ['rasterizer', settings.raster], ['regimes', settings.regimes.join(', ')], ['clock', settings.clock],
      ['budget a frame', settings.target_fps ? `steered to ${settings.target_fps} frames/s${settings.steered_by === 'gpu' ? ', of unstructured by the GPU' : ''}` : `${settings.budget_points.toLocaleString('en-US')} points`],
      ['memory', settings.memory_bytes], ['GPU memory', settings.gpu_memory_bytes], ['repeats', settings.repeats],
      ['seed', settings.seed], ['time is', settings.time_is], ['warm-up', settings.warm_up], ['FLIP', settings.flip],
    ]),
    ...datasets.map((d) => facts(`Data: ${d.name}`, [
      ['path', d.path], ['format', d.format], ['points', d.points_total.toLocaleString('en-US')], ['hash', d.points_hash],
      ['coloured by', d.color], ['load', d.load_ms === undefined ? null : format.ms(d.load_ms)],
      ['build octree', d.build_ms ? format.ms(d.build_ms) : null],
    ])),
    facts('What is read, and in which order', [...new Map(report.study.summary.map((row) => [row.mode, row.reads]))]),
  );
  $('#document').textContent = JSON.stringify(report.study, null, 2);
}

function drawTables() {
  drawSummary();
  drawMotionSummary();
  drawPartsTable();
}
