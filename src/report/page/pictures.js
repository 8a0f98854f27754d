// Pictures: two compared, and all in strips.
'use strict';

const pictureOf = (id) => report.pictures[id];
// Scenes: a view or path under a regime, with the pictures that are large enough to compare.
const scenes = () => report.scenes.filter((scene) => scene.dataset === state.dataset && scene.pictures.length > 1);

const compare = { way: 'slider', split: 50, timer: null };

function fill(select, items, chosen) {
  select.replaceChildren(...items.map((text, i) => make('option', { value: i }, text)));
  select.value = Math.max(0, chosen);
}

function drawScenes() {
  const all = scenes();
  $('#compare').hidden = all.length === 0;
  if (all.length === 0) return;
  fill($('#scene'), all.map((scene) => `${scene.view}, ${kRegimes[scene.regime]}`), 0);
  drawPictureChoice();
}

const scene = () => scenes()[Number($('#scene').value)];

function drawPictureChoice(left = 1, right = 0) {
  const labels = scene().pictures.map((picture) => picture.label);
  fill($('#left'), labels, left);
  fill($('#right'), labels, right);
  showPictures();
}

async function showPictures() {
  const [left, right] = ['left', 'right'].map((side) => scene().pictures[Number($(`#${side}`).value)]);
  for (const [side, picture] of [['left', left], ['right', right]]) {
    $(`#${side}-image`).src = pictureOf(picture.id);
    $(`#${side}-image`).alt = picture.label;
    $(`.tag.${side}`).textContent = picture.label;
  }
  const scale = report.picture_scale;
  $('#picture-note').textContent = scale > 1
    ? `Shown at 1/${scale} of ${report.study.settings.width} × ${report.study.settings.height}, ${scale} × ${scale} pixels averaged; the folders frames and reference have them whole.`
    : `Every pixel of ${report.study.settings.width} × ${report.study.settings.height}, without loss.`;
  await drawDifference();
}

// |left - right| times the gain, for each channel.
async function drawDifference() {
  if (compare.way !== 'difference') return;
  const images = [$('#left-image'), $('#right-image')];
  await Promise.all(images.map((image) => image.decode()));
  const [width, height] = [images[0].naturalWidth, images[0].naturalHeight];
  const [a, b] = images.map((image) => {
    const canvas = make('canvas', { width, height });
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, width, height);
  });
  const gain = Number($('#gain').value);
  for (let i = 0; i < a.data.length; ++i) if (i % 4 !== 3) a.data[i] = Math.min(255, gain * Math.abs(a.data[i] - b.data[i]));
  const canvas = $('#difference');
  canvas.width = width;
  canvas.height = height;
  canvas.getContext('2d').putImageData(a, 0, 0);
}

function setWay(way) {
  compare.way = way;
  const sheet = $('.sheet');
  sheet.className = `sheet ${way}`;
  for (const button of document.querySelectorAll('#ways button')) button.setAttribute('aria-pressed', button.dataset.way === way);
  clearInterval(compare.timer);
  if (way === 'blink') compare.timer = setInterval(() => sheet.classList.toggle('second'), 500);
  $('#gain-control').hidden = way !== 'difference';
  drawDifference();
}

function setSplit(percent) {
  compare.split = Math.min(100, Math.max(0, percent));
  $('.sheet').style.setProperty('--split', `${compare.split}%`);
}

function setUpCompare() {
  for (const way of ['slider', 'difference', 'blink']) {
    const button = make('button', { type: 'button', 'data-way': way }, way);
    button.addEventListener('click', () => setWay(way));
    $('#ways').append(button);
  }
  const sheet = $('.sheet');
  const drag = (event) => {
    if (compare.way !== 'slider' || (event.type === 'pointermove' && !event.buttons)) return;
    const box = sheet.getBoundingClientRect();
    setSplit((100 * (event.clientX - box.left)) / box.width);
  };
  sheet.addEventListener('pointerdown', drag);
  sheet.addEventListener('pointermove', drag);
  sheet.addEventListener('dragstart', (event) => event.preventDefault());
  $('.stage').addEventListener('keydown', (event) => {
    if (event.key === 'ArrowLeft') setSplit(compare.split - 2);
    if (event.key === 'ArrowRight') setSplit(compare.split + 2);
  });
  $('#scene').addEventListener('change', () => drawPictureChoice());
  for (const side of ['left', 'right']) $(`#${side}`).addEventListener('change', showPictures);
  $('#gain').addEventListener('change', drawDifference);
  $('#zoom').addEventListener('change', () => { sheet.style.width = `${100 * Number($('#zoom').value)}%`; });
  setWay('slider');
  setSplit(50);
}

function openInComparison(item, frame) {
  const at = scenes().indexOf(item);
  const picture = item.pictures.findIndex((p) => p.mode === frame.mode && p.frame === frame.frame);
  if (at < 0 || picture < 0) return;
  $('#scene').value = at;
  // Of a path, the reference of the same frame
  const reference = item.pictures.findIndex((p) => p.mode === 'reference' && (p.frame === 0 || p.frame === frame.frame));
  drawPictureChoice(picture, Math.max(0, reference));
  $('#compare').scrollIntoView({ behavior: 'smooth' });
}

// Along a path the work so far says little.
function captions(item, frame) {
  if (item.regime === 'path') return [`frame ${frame.frame}`, format.db(frame.psnr_db)];
  const time = frame.ms === null ? '' : ` · ${format.ms(frame.ms)}`;
  return [`${format.points(frame.points)}${time}`, `frame ${frame.frame} · ${format.db(frame.psnr_db)}`];
}

function drawFilms() {
  const place = $('#films .reels');
  place.replaceChildren();
  for (const item of report.scenes.filter((s) => s.dataset === state.dataset)) {
    const reels = grouped(item.film.filter((frame) => visible(frame.mode)), (frame) => frame.mode);
    if (reels.length === 0) continue;
    place.append(make('h3', { class: 'scene-name' }, `${item.view}, ${kRegimes[item.regime]}`));
    for (const [mode, frames] of reels) {
      const strip = make('div', { class: 'strip' });
      for (const frame of frames) {
        const large = item.pictures.some((p) => p.mode === mode && p.frame === frame.frame);
        const lines = captions(item, frame).map((text) => make('span', {}, text));
        const image = make('img', { src: pictureOf(frame.id), alt: `${mode}, frame ${frame.frame}`, loading: 'lazy' });
        const node = make(large ? 'button' : 'figure', { class: 'frame', ...(large ? { type: 'button' } : {}) }, image, ...lines);
        if (large) node.addEventListener('click', () => openInComparison(item, frame));
        strip.append(node);
      }
      place.append(make('div', { class: 'reel' }, make('div', { class: 'name' }, methodCell(mode)), strip));
    }
  }
  $('#films').hidden = place.childElementCount === 0;
}
