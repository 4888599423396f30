// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Draws calibration.html from its JSON with Chart.js and three.js.
const signed = v => (Math.round(1000 * v) / 1000 || 0).toFixed(3);  // no -0.000
// At least two digits that count: 0.0000 would be a promise.
const mm = (v, digits = 4) => !(v > 0) ? '-' : v >= 10 ** (1 - digits) ? v.toFixed(digits) : v.toPrecision(2);

const were = count => count === 1 ? 'was' : 'were';

// What was left out, in a few words for the header.
function leftOut() {
  const words = [];
  data.stripes.forEach(s => {
    if (s.found > s.agreeing) words.push(`${s.found - s.agreeing} of ${s.found} stripes of ${s.name} ${were(s.found - s.agreeing)} left out`);
  });
  const lost = data.rejected.length, all = lost + data.used.length;
  if (lost) words.push(`${lost} of ${all} pictures ${were(lost)} left out, whole or in part`);
  return words.join('; ');
}

// Hides an empty part of the page with its heading and notes.
function hide(id) {
  for (let e = at(id); e; e = e.previousElementSibling) {
    e.style.display = 'none';
    if (e.tagName === 'H2') break;
  }
}

// A field above the pictures that keeps those whose name, sensor or reason has the text in it.
function addFilter(id) {
  const box = at(id), field = element('input', undefined, undefined, 'filter');
  field.placeholder = 'filter: sensor, picture or reason';
  box.before(field);
  field.addEventListener('input', () => {
    const wanted = field.value.toLowerCase();
    [...box.children].forEach(f => { f.style.display = f.textContent.toLowerCase().includes(wanted) ? '' : 'none'; });
  });
}

function showVerdict() {
  const but = leftOut();
  at('verdict').textContent = data.usable ? 'Usable' + (but ? ', but ' + but : '') : 'Not usable: ' + data.message;
  at('verdict').classList.add(data.usable ? 'good' : 'bad');
  data.warnings.forEach(w => element('div', w, at('warnings'), 'warning'));
  const s = at('summary');
  if (data.shape_mm > 0)
    element('p', `A section is predicted to be right to ${mm(data.shape_mm)} mm in shape (after a rigid move) and ` +
      `${mm(data.absolute_mm, 3)} mm in place, 1 sigma. ` + (data.warp_mm[0] || data.warp_mm[1] ?
      `Board bowed by ${signed(data.warp_mm[0])} mm along x and ${signed(data.warp_mm[1])} mm along y.` :
      'The board was taken as flat.'), s);
  table(s, ['sensor', 'lens', 'corners px', 'stripe px', 'views', 'with stripe', 'image covered'],
    data.sensors.map(q => [q.name, q.lens, q.board_rms_px.toFixed(3), q.stripe_rms_px.toFixed(3), q.board_views,
      q.stripe_views, q.coverage >= 0 ? Math.round(100 * q.coverage) + ' %' : '-']));
  data.sensors.filter(q => q.trials.length).forEach(q => element('p', `${q.name}: error on views left out, px: ` +
    q.trials.map(t => `${t.lens} ${t.px.toFixed(4)}`).join(', '), s, 'note'));
  if (data.weakest) at('weakest').textContent = 'Weakest: ' + data.weakest + '.';
  const c = data.cross_validation;
  at('cross').textContent = c.done ?
    `Calibrated by every other view and by the rest, the sections differ by ${mm(c.difference_mm)} mm; predicted: ` +
    `${mm(c.predicted_mm)} mm (ratio ${(c.difference_mm / c.predicted_mm).toFixed(2)}).` :
    (c.why_not ? 'No cross-validation: ' + c.why_not + '.' : '');
}

// Blue over green and yellow to red, t in 0 .. 1.
function heat(t) { return `hsl(${Math.round(240 * (1 - Math.min(1, Math.max(0, t))))}, 85%, 48%)`; }

function showMap(field, title) {
  const card = element('div', undefined, at('maps'), 'card');
  const canvas = element('canvas', undefined, card);
  const near = data.map.filter(c => !c.extrapolated);
  const sorted = (near.length ? near : data.map).map(c => c[field]).sort((a, b) => a - b);
  const low = sorted[0], high = sorted[Math.floor(0.99 * (sorted.length - 1))];
  const color = c => heat((c[field] - low) / Math.max(1e-9, high - low));
  showScale(card, low, high);
  new Chart(canvas, {
    type: 'scatter',
    data: { datasets: data.sensors.map((s, i) => {
      const cells = data.map.filter(c => c.sensor === i);
      return { label: s.name, data: cells.map(c => ({ x: c.u, y: c.v, value: c[field] })),
        pointStyle: i % 2 ? 'rectRot' : 'rect', pointRadius: 6, backgroundColor: 'transparent', borderColor: '#475569',
        pointBackgroundColor: cells.map(c => c.extrapolated ? 'transparent' : color(c)), pointBorderColor: cells.map(color) };
    }) },
    options: { animation: false, aspectRatio: 1.25,
      plugins: { legend: pointLegend, title: { display: true, text: title },
        tooltip: { callbacks: { label: c => `${c.raw.value.toFixed(4)} mm at y ${c.raw.x.toFixed(0)}, z ${c.raw.y.toFixed(0)}` } } },
      scales: { x: { title: { display: true, text: 'y of the rig, mm' } }, y: { title: { display: true, text: 'z of the rig, mm' } } } }
  });
}

// One colour says nothing there: cells and lines have their own.
const pointLegend = { labels: { usePointStyle: true } };

function showScale(card, low, high) {
  const scale = element('div', undefined, card, 'scale');
  element('span', low.toFixed(4) + ' mm', scale);
  const bar = element('i', undefined, scale);
  bar.style.background = `linear-gradient(to right, ${[0, 0.25, 0.5, 0.75, 1].map(heat).join(', ')})`;
  element('span', high.toFixed(4) + ' mm or more', scale);
}

function showViews() {
  const label = v => `${v.sensor} ${v.image}`;
  new Chart(at('views'), {
    type: 'bar',
    data: { labels: data.views.map(label), datasets: [
      { label: 'corners, rms px', data: data.views.map(v => v.board_rms_px), backgroundColor: colors[0] },
      { label: 'stripe, rms px', data: data.views.map(v => v.stripe_rms_px), backgroundColor: colors[1] },
      { label: 'left out', data: data.views.map(v => v.left_out), backgroundColor: '#9ca3af', yAxisID: 'count' }] },
    options: { animation: false, scales: { x: { ticks: { autoSkip: true, font: { size: 9 } } },
      y: { title: { display: true, text: 'px' } }, count: { position: 'right', grid: { display: false }, ticks: { precision: 0 },
        title: { display: true, text: 'points left out' } } } }
  });
}

// Segments as one dataset: a gap between each two.
function arrows(residuals, scale) {
  const points = [];
  residuals.forEach(r => points.push({ x: r[3], y: r[4] }, { x: r[3] + scale * r[5], y: r[4] + scale * r[6] }, { x: NaN, y: NaN }));
  return points;
}

function showResiduals(sensor, index) {
  const own = data.residuals.filter(r => data.views[r[0]].sensor === sensor.name);
  const card = element('div', undefined, at('residuals'), 'card');
  const lengths = own.filter(r => r[1] && r[2]).map(r => Math.hypot(r[5], r[6])).sort((a, b) => a - b);
  const scale = Math.round(0.014 * sensor.size[0] / Math.max(1e-4, lengths[Math.floor(lengths.length / 2)] || 1));
  const corners = own.filter(r => r[1] && r[2]), stripe = own.filter(r => !r[1] && r[2]), out = own.filter(r => !r[2]);
  new Chart(element('canvas', undefined, card), {
    type: 'scatter',
    data: { datasets: [
      { label: 'corners', data: arrows(corners, scale), showLine: true, spanGaps: false, pointRadius: 0, borderWidth: 1, borderColor: colors[index % 6],
        borderDash: [1e6, 0] },  // solid; without it Chart.js thins lines out
      { label: 'stripe', order: -1, data: stripe.map(r => ({ x: r[3], y: r[4] })), pointRadius: 1.5, pointBackgroundColor: index % 6 === 1 ? '#1e293b' : '#dc2626', pointBorderWidth: 0 },
      { label: 'left out', order: -2, data: out.map(r => ({ x: r[3], y: r[4] })), pointStyle: 'crossRot', pointRadius: 4, pointBorderColor: '#111' }] },
    options: { animation: false, aspectRatio: sensor.size[0] / sensor.size[1],
      plugins: { legend: pointLegend, title: { display: true, text: `${sensor.name}, arrows ${scale} times as long` } },
      scales: { x: { min: 0, max: sensor.size[0], title: { display: true, text: 'x of the image, px' } },
        y: { min: 0, max: sensor.size[1], reverse: true, title: { display: true, text: 'y of the image, px' } } } }
  });
}

function picture(parent, p) {
  const f = element('figure', undefined, parent);
  if (p.picture) element('img', undefined, f).src = p.picture;
  const caption = element('figcaption', `${p.sensor} ${p.image} `, f);
  if (p.reason) element('span', p.reason, caption, 'reason');
}

function line(points, color, scene, closed) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(points.flat(), 3));
  const material = new THREE.LineBasicMaterial({ color });
  scene.add(closed ? new THREE.LineLoop(geometry, material) : new THREE.Line(geometry, material));
}

function addSheet(corners, color, scene) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute([...corners[0], ...corners[1], ...corners[2],
    ...corners[0], ...corners[2], ...corners[3]], 3));
  scene.add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color, transparent: true, opacity: 0.22,
    side: THREE.DoubleSide, depthWrite: false })));
}

function showRig() {
  const box = at('rig3d');
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  } catch (e) {
    element('p', 'This browser shows no WebGL: ' + e.message, box);
    return;
  }
  renderer.setClearColor(0x10151c);
  const scene = new THREE.Scene(), all = new THREE.Box3();
  const camera = new THREE.PerspectiveCamera(40, box.clientWidth / box.clientHeight, 1, 1e5);
  camera.up.set(0, 0, 1);
  renderer.setSize(box.clientWidth, box.clientHeight);
  box.appendChild(renderer.domElement);
  data.rig3d.boards.forEach(b => { line(b, 0x8fa3b8, scene, true); b.forEach(p => all.expandByPoint(new THREE.Vector3(...p))); });
  data.rig3d.cameras.forEach((c, i) => {
    const color = colors[i % 6];
    c.frustum.forEach(p => line([c.centre, p], color, scene));
    line(c.frustum, color, scene, true);
    all.expandByPoint(new THREE.Vector3(...c.centre));
  });
  data.rig3d.sheets.forEach(s => { addSheet(s.corners, 0xff3030, scene); line(s.corners, 0xff6060, scene, true); });
  const middle = all.getCenter(new THREE.Vector3()), size = all.getSize(new THREE.Vector3()).length();
  [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((d, i) => line([[0, 0, 0], d.map(v => v * size / 6)], [0xff5555, 0x55ff55, 0x6688ff][i], scene));
  camera.position.copy(middle).add(new THREE.Vector3(0.95 * size, -0.78 * size, 0.43 * size));
  const controls = new THREE.OrbitControls(camera, renderer.domElement);
  controls.target.copy(middle);
  const draw = () => renderer.render(scene, camera);
  controls.addEventListener('change', draw);
  controls.update();
  draw();
}

showVerdict();
if (data.map.length) { showMap('shape', 'shape'); showMap('absolute', 'place'); } else hide('maps');
if (data.views.length) showViews(); else hide('views_box');
if (data.residuals.length) data.sensors.forEach(showResiduals); else hide('residuals');
if (data.rig3d.cameras.length) showRig(); else hide('rig3d');
data.rejected.forEach(p => picture(at('rejected'), p));
if (!data.rejected.length) element('p', 'None.', at('rejected'));
data.used.forEach(p => picture(at('used'), p));
if (data.rejected.length > 3) addFilter('rejected');
if (data.used.length > 3) addFilter('used');
if (!Object.keys(data.sigma).length) hide('sigma_box');
table(at('sigma'), ['parameter', '1 sigma'], Object.entries(data.sigma).map(([k, v]) => [k, v === null ? '-' : v.toPrecision(3)]));
document.body.dataset.ready = 'yes';
