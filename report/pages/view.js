// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Shows a cloud with three.js. The camera is orthographic: the scale bar holds for all that is seen.
// #points=12,345 selects points, #colour=sigma a colouring, #view=top a view; joined by '&'.

// The columns as report/cloud_view.cpp lays them out: x y z (upper 16 bits), intensity, sigma, [deviation]; then bytes:
// x y z (lower 8 bits), stripe.
function readColumns() {
  const text = atob(at('binary').textContent), bytes = new Uint8Array(text.length), n = data.count;
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  let offset = 0;
  const wide = () => { const c = new Uint16Array(bytes.buffer, offset, n); offset += 2 * n; return c; };
  const narrow = () => { const c = bytes.subarray(offset, offset + n); offset += n; return c; };
  const columns = { high: [wide(), wide(), wide()], intensity: wide(), sigma: wide() };
  if (data.deviation) columns.deviation = wide();
  columns.low = [narrow(), narrow(), narrow()];
  columns.group = narrow();
  return columns;
}

const columns = readColumns();
const boxLow = data.box.map(b => b[0]), boxSize = data.box.map(b => b[1]);
const middle = boxLow.map((low, a) => low + boxSize[a] / 2);
const coordinate = (i, axis) => boxLow[axis] + (columns.high[axis][i] * 256 + columns.low[axis][i]) / 16777215 * boxSize[axis];
const deviationOf = i => columns.deviation[i] ? (columns.deviation[i] - 32768) / 32767 * data.deviation_max : NaN;
const frameStarts = [];
data.frames.reduce((sum, run) => { frameStarts.push(sum); return sum + run[1]; }, 0);

function frameOf(i) {
  let low = 0, high = frameStarts.length - 1;
  while (low < high) {
    const half = (low + high + 1) >> 1;
    if (frameStarts[half] <= i) low = half; else high = half - 1;
  }
  return data.frames[low][0];
}
const sensorName = s => data.sensors[s] || 'sensor ' + s;

// Google's Turbo (A. Mikhailov, 2019), by the polynomial that its authors give.
function turbo(part) {
  const t = 0.08 + 0.87 * part;  // its ends are too dark on this ground
  const p = [1, t, t * t, t ** 3, t ** 4, t ** 5];
  const k = [[0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943],
    [0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604],
    [0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973]];
  return k.map(c => Math.max(0, Math.min(1, c.reduce((sum, v, i) => sum + v * p[i], 0))));
}
// Red where material is missing, grey where the nominal is met, blue where it stands out.
function diverging(t) {
  const grey = [0.82, 0.83, 0.84], end = t < 0.5 ? [0.85, 0.15, 0.08] : [0.1, 0.42, 0.9], part = Math.min(1, Math.abs(t - 0.5) * 2);
  return grey.map((g, i) => g + (end[i] - g) * part);
}
const rgb = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255);

const modes = {
  height: { label: 'height z', unit: 'mm', value: i => coordinate(i, 2), map: turbo },
  intensity: { label: 'intensity', unit: 'grey levels', value: i => columns.intensity[i] / 65535 * data.intensity_max, map: turbo },
  sigma: { label: 'predicted sigma', unit: 'mm', value: i => columns.sigma[i] / 65535 * data.sigma_max, map: turbo },
  sensor: { label: 'sensor', unit: '', value: i => data.groups[columns.group[i]][0], classes: true }
};
if (data.deviation) modes.wear = { label: 'deviation from ' + data.nominal, unit: 'mm', value: deviationOf, map: diverging, symmetric: true };
if (data.intensity_max === 1) delete modes.intensity;  // sections carry none

// The middle 98 % of the values: stray points must not take the colours.
function robustSpan(mode) {
  const step = Math.max(1, Math.floor(data.count / 50000)), values = [];
  for (let i = 0; i < data.count; i += step) { const v = mode.value(i); if (!isNaN(v)) values.push(v); }
  values.sort((a, b) => a - b);
  let low = values[Math.floor(0.01 * (values.length - 1))] || 0, high = values[Math.ceil(0.99 * (values.length - 1))] || 0;
  if (mode.symmetric) { high = Math.max(Math.abs(low), Math.abs(high)); low = -high; }
  return high > low ? [low, high] : [low - 0.5, low + 0.5];
}

const geometry = new THREE.BufferGeometry(), colourBytes = new Uint8Array(3 * data.count);
function setUpGeometry() {
  const positions = new Float32Array(3 * data.count);
  for (let i = 0; i < data.count; i++) for (let a = 0; a < 3; a++) positions[3 * i + a] = coordinate(i, a) - middle[a];
  geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(colourBytes, 3, true));
}

function paint(name) {
  const mode = modes[name], missing = [90, 100, 112];
  const span = mode.classes ? null : robustSpan(mode);
  const ramp = mode.classes ? colors.map(rgb) : Array.from({ length: 256 }, (_, k) => mode.map(k / 255));
  for (let i = 0; i < data.count; i++) {
    const v = mode.value(i);
    const c = isNaN(v) ? null : mode.classes ? ramp[v % ramp.length] : ramp[Math.max(0, Math.min(255, Math.round(255 * (v - span[0]) / (span[1] - span[0]))))];
    for (let k = 0; k < 3; k++) colourBytes[3 * i + k] = c ? 255 * c[k] : missing[k];
  }
  geometry.attributes.color.needsUpdate = true;
  showLegend(mode, span);
}

function niceStep(range, most) {
  const raw = range / most, power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map(k => k * power).find(s => s >= raw * 0.999);
}
function ticks(low, high, most) {
  const step = niceStep(high - low, most), out = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) out.push(k * step);
  return { step, values: out, text: v => v.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))).replace(/^-(0(\.0*)?)$/, '$1') };
}

function showLegend(mode, span) {
  const box = at('legend');
  box.textContent = '';
  element('div', mode.label + (mode.unit ? ', ' + mode.unit : ''), box);
  if (mode.classes) {
    [...new Set(data.groups.map(g => g[0]))].sort().forEach(s => {
      const line = element('div', undefined, box);
      element('span', '\u25a0 ', line).style.color = colors[s % colors.length];
      element('span', sensorName(s), line);
    });
    return;
  }
  const canvas = element('canvas', undefined, box), height = 220, draw = canvas.getContext('2d');
  canvas.width = 100; canvas.height = height + 16;
  for (let y = 0; y < height; y++) {
    draw.fillStyle = 'rgb(' + mode.map(1 - y / (height - 1)).map(v => Math.round(255 * v)).join(',') + ')';
    draw.fillRect(0, y + 8, 22, 1);
  }
  draw.fillStyle = '#dbe3ec'; draw.font = '12px system-ui, "DejaVu Sans", sans-serif'; draw.textBaseline = 'middle';
  const marks = ticks(span[0], span[1], 8);
  marks.values.forEach(v => {
    const y = 8 + (1 - (v - span[0]) / (span[1] - span[0])) * (height - 1);
    draw.fillRect(22, Math.round(y), 5, 1);
    draw.fillText(marks.text(v), 31, y);
  });
}

let renderer, camera, controls, points, marker;
const scene = new THREE.Scene(), labels = [];
const size = Math.hypot(...boxSize);

function addLabel(position, text, className) {
  const e = element('div', text, at('labels'), 'label ' + (className || ''));
  labels.push({ e, position });
}

function segments(list, color) {
  const g = new THREE.BufferGeometry();
  g.setAttribute('position', new THREE.Float32BufferAttribute(list.flat(), 3));
  const object = new THREE.LineSegments(g, new THREE.LineBasicMaterial({ color }));
  scene.add(object);
  return object;
}

// Three edges of the cloud's box, each with ticks; the names of the axes at their ends.
function addAxes() {
  const low = boxSize.map(s => -s / 2), lines = [], tick = size * 0.008;
  [0, 1, 2].forEach(axis => {
    const begin = low.slice(), end = low.slice(), beside = [[1, 2], [0, 2], [1, 0]][axis];  // clear of the edge in every view
    end[axis] = boxSize[axis] / 2;
    lines.push(begin, end);
    const share = boxSize[axis] / size, marks = ticks(boxLow[axis], boxLow[axis] + boxSize[axis], Math.max(2, Math.round(8 * share)));
    if (share > 0.04) marks.values.forEach(v => {
      const p = low.slice(), q = low.slice(), t = low.slice();
      p[axis] = q[axis] = t[axis] = v - middle[axis];
      q[beside[0]] -= tick; beside.forEach(b => { t[b] -= 3.5 * tick; });
      lines.push(p, q);
      addLabel(t, marks.text(v));
    });
    const name = end.slice();
    name[axis] += 5 * tick;
    addLabel(name, 'xyz'[axis], 'axis');
  });
  segments(lines, 0x6c7f95);
}

function place(view) {
  const from = { free: [-0.75, -0.85, 0.65], top: [0, -0.0001, 1], front: [-1, 0, 0], side: [0, -1, 0] }[view];
  const direction = new THREE.Vector3(...from).normalize();
  camera.position.copy(direction.multiplyScalar(2 * size));
  controls.target.set(0, 0, 0);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  // What of the box is seen decides how large it can be.
  let right = 1e-9, up = 1e-9;
  for (let corner = 0; corner < 8; corner++) {
    const p = new THREE.Vector3(...boxSize.map((s, a) => (corner >> a & 1 ? s : -s) / 2)).applyMatrix4(camera.matrixWorldInverse);
    right = Math.max(right, Math.abs(p.x)); up = Math.max(up, Math.abs(p.y));
  }
  camera.zoom = Math.min(innerWidth / (2 * right), innerHeight / (2 * up)) * 0.78;
  camera.updateProjectionMatrix();
  controls.update();
  draw();
}

function resize() {
  camera.left = -innerWidth / 2; camera.right = innerWidth / 2; camera.top = innerHeight / 2; camera.bottom = -innerHeight / 2;
  camera.updateProjectionMatrix();
  renderer.setSize(innerWidth, innerHeight);
  draw();
}

function toScreen(p) {
  const v = new THREE.Vector3(...p).project(camera);
  return [(v.x + 1) / 2 * innerWidth, (1 - v.y) / 2 * innerHeight];
}

function draw() {
  renderer.render(scene, camera);
  labels.forEach(l => {
    const [x, y] = toScreen(l.position);
    l.e.style.left = x + 'px'; l.e.style.top = y + 'px';
  });
  const length = niceStep(150 / camera.zoom, 1);  // mm of about 150 px; a pixel is 1 / zoom mm
  at('scalebar').firstElementChild.textContent = parseFloat(length.toPrecision(3)) + ' mm';
  at('scalebar').lastElementChild.style.width = length * camera.zoom + 'px';
  at('scalebar').dataset.mm = length;
  at('scalebar').dataset.px = length * camera.zoom;
}

// The point under the cursor: of those within a few pixels the one nearest to the viewer.
function pointAt(x, y) {
  const m = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).elements;
  const p = geometry.attributes.position.array;
  let best = -1, bestDepth = Infinity;
  for (let reach = 3; reach <= 9 && best < 0; reach += 3)
    for (let i = 0; i < data.count; i++) {
      const a = p[3 * i], b = p[3 * i + 1], c = p[3 * i + 2];
      const px = (m[0] * a + m[4] * b + m[8] * c + m[12] + 1) / 2 * innerWidth - x;
      const py = (1 - m[1] * a - m[5] * b - m[9] * c - m[13]) / 2 * innerHeight - y;
      if (px * px + py * py > reach * reach) continue;
      const depth = m[2] * a + m[6] * b + m[10] * c;
      if (depth < bestDepth) { bestDepth = depth; best = i; }
    }
  return best;
}

let picked = [];
const xyz = i => [0, 1, 2].map(a => coordinate(i, a));

function showMarker() {
  if (marker) scene.remove(marker);
  marker = null;
  if (!picked.length) return;
  const arm = 7 / camera.zoom, lines = [];
  picked.forEach(i => xyz(i).map((v, a) => v - middle[a]).forEach((_, a, p) => {
    const q = p.slice(), r = p.slice();
    q[a] -= arm; r[a] += arm;
    lines.push(q, r);
  }));
  if (picked.length === 2) lines.push(...picked.map(i => xyz(i).map((v, a) => v - middle[a])));
  marker = segments(lines, 0xffd166);
  marker.material.depthTest = false;
  marker.renderOrder = 1;
}

function showPicked() {
  const box = at('picked');
  box.textContent = '';
  box.style.display = picked.length ? 'block' : 'none';
  showMarker();
  if (!picked.length) return draw();
  if (picked.length === 2) {
    const [p, q] = picked.map(xyz), d = q.map((v, a) => v - p[a]);
    element('div', 'distance ' + Math.hypot(...d).toFixed(3) + ' mm', box, 'distance');
    element('div', 'dx ' + d[0].toFixed(3) + ', dy ' + d[1].toFixed(3) + ', dz ' + d[2].toFixed(3) + ' mm; sigma of the two together ' +
      Math.hypot(...picked.map(modes.sigma.value)).toFixed(3) + ' mm', box);
  }
  const rows = [['frame', frameOf], ['sensor', i => sensorName(data.groups[columns.group[i]][0])], ['line', i => data.groups[columns.group[i]][1]],
    ...[0, 1, 2].map(a => ['xyz'[a] + ', mm', i => coordinate(i, a).toFixed(3)]),
    ['sigma, mm', i => modes.sigma.value(i).toFixed(4)]];
  if (modes.intensity) rows.push(['intensity', i => modes.intensity.value(i).toFixed(0)]);
  if (data.deviation) rows.push(['deviation, mm', i => isNaN(deviationOf(i)) ? '-' : deviationOf(i).toFixed(3)]);
  table(box, ['point', ...picked.map((_, k) => 'AB'[k])], rows.map(([name, value]) => [name, ...picked.map(i => String(value(i)))]));
  const last = picked[picked.length - 1], frame = frameOf(last), sensor = sensorName(data.groups[columns.group[last]][0]);
  (data.links[frame] || []).filter(l => l[0] === sensor).forEach(l => {
    const link = element('a', 'picture of frame ' + frame + ', ' + sensor, box);
    link.href = l[1]; link.target = '_blank';
    const image = element('img', undefined, link);
    image.onerror = () => image.remove();  // moved away, or of a kind that browsers do not show
    image.src = l[1];
  });
  draw();
}

function setUpInput() {
  const canvas = renderer.domElement;
  let down = null;
  canvas.addEventListener('pointerdown', e => { down = [e.clientX, e.clientY]; });
  canvas.addEventListener('pointerup', e => {
    if (!down || e.button !== 0 || Math.hypot(e.clientX - down[0], e.clientY - down[1]) > 4) return;
    const i = pointAt(e.clientX, e.clientY);
    if (i < 0) return;
    picked = picked.length === 1 ? [picked[0], i] : [i];
    showPicked();
  });
  addEventListener('keydown', e => { if (e.key === 'Escape') { picked = []; showPicked(); } });
  addEventListener('resize', resize);
  document.querySelectorAll('[data-view]').forEach(b => b.addEventListener('click', () => place(b.dataset.view)));
  at('colour').addEventListener('change', () => { paint(at('colour').value); draw(); });
  at('size').addEventListener('input', () => { points.material.size = Number(at('size').value) * (devicePixelRatio || 1); draw(); });
  Object.keys(modes).forEach(name => { element('option', modes[name].label, at('colour')).value = name; });
}

function showCounts() {
  at('title').textContent = data.title;
  const text = n => n.toLocaleString('en').replace(/,/g, '\u202f');
  at('counts').textContent = data.count < data.total ?
    `${text(data.count)} of ${text(data.total)} points shown, one of each ${(data.total / data.count).toFixed(1)}, evenly drawn` :
    `${text(data.count)} points, all shown`;
}

function start() {
  showCounts();
  if (!data.count) { at('counts').textContent = 'The cloud has no points.'; return; }
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch (e) {
    at('counts').textContent = 'This browser shows no WebGL: ' + e.message;
    return;
  }
  const options = Object.fromEntries(location.hash.slice(1).split('&').map(o => o.split('=')));
  renderer.setClearColor(0x10151c);
  renderer.setPixelRatio(devicePixelRatio || 1);
  at('scene').appendChild(renderer.domElement);
  camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01 * size, 4 * size);
  camera.up.set(0, 0, 1);
  controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.addEventListener('change', () => { showMarker(); draw(); });
  setUpGeometry();
  points = new THREE.Points(geometry, new THREE.PointsMaterial({ size: 2 * (devicePixelRatio || 1), sizeAttenuation: false, vertexColors: THREE.VertexColors }));
  scene.add(points);
  addAxes();
  setUpInput();
  const colour = modes[options.colour] ? options.colour : data.deviation ? 'wear' : 'height';
  at('colour').value = colour;
  paint(colour);
  resize();
  place(['top', 'front', 'side'].includes(options.view) ? options.view : 'free');
  if (options.points) { picked = options.points.split(',').map(Number).filter(i => i >= 0 && i < data.count).slice(0, 2); showPicked(); }
}

start();
document.body.dataset.ready = 'yes';
