// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Draws measure.html from its JSON with Chart.js.
const rows = data.rows, count = rows.frame.length;
const travelMoves = Math.max(...rows.travel) > Math.min(...rows.travel);
const along = i => travelMoves ? rows.travel[i] : rows.frame[i];
const alongText = !travelMoves ? 'frame' : data.rotary ? 'angle, \u00b0' : 'travel, mm';
const placeOf = i => !travelMoves ? '' : data.rotary ? `, angle ${fixed(along(i), 1)}\u00b0` : `, travel ${fixed(along(i), 1)} mm`;
const fixed = (v, digits) => v === null || v === undefined ? '-' : (Number(v.toFixed(digits)) || 0).toFixed(digits);
const withUnit = q => q.unit ? q.label + ', ' + q.unit : q.label;

function showHead() {
  at('title').textContent = `${data.object} against ${data.nominal}`;
  const failed = rows.verdict.filter(v => v === 'fail').length, judged = rows.verdict.some(v => v !== '');
  const v = at('verdict');
  v.textContent = `${data.ok} of ${counted(count, 'section')} measured completely` +
    (failed ? `; ${failed} beyond a limit` : judged ? '; none beyond a limit' : '; no limits were given');
  v.classList.add(failed || !data.ok ? 'bad' : judged ? 'good' : 'plain');
  data.warnings.forEach(w => element('div', w, at('warnings'), 'warning'));
  data.calibration_error.forEach(t => element('p', t[0].toUpperCase() + t.slice(1) + '.', at('warnings'), 'note'));
  at('source').textContent = `From ${data.profiles}. `;
  if (data.view) { const a = element('a', 'Look at the cloud in 3D', at('source')); a.href = data.view; }
}

function limitText(q) {
  return [q.low !== null ? '\u2265 ' + q.low : '', q.high !== null ? '\u2264 ' + q.high : ''].filter(t => t).join(', ');
}

function showSummary() {
  const known = data.quantities.filter(q => q.known), unknown = data.quantities.filter(q => !q.known);
  table(at('summary'), ['quantity', 'sections', 'lowest', 'mean', 'highest', 'typical sigma', 'limit'], known.map(q => {
    const sigmas = q.sigmas.filter(s => s !== null).sort((a, b) => a - b);
    return [withUnit(q), q.known, fixed(q.lowest, q.decimals), fixed(q.mean, q.decimals), fixed(q.highest, q.decimals),
      sigmas.length ? fixed(sigmas[Math.floor(sigmas.length / 2)], Math.max(3, q.decimals)) : '-', limitText(q)];
  }));
  unknown.forEach(q => {
    const reason = q.reasons.find(r => r);
    element('p', `${q.label}: not known in any section${reason ? ' (' + reason + ')' : ''}.`, at('summary'), 'note');
  });
}

function showWorst() {
  const box = at('worst');
  if (!data.worst.length) {
    element('p', 'No place stands out: no limit is exceeded, and no wear is beyond 0.05 mm and three times its predicted error.', box);
    return;
  }
  const track = ['vertical_wear', 'side_wear', 'corner45_wear', 'right_vertical_wear', 'right_side_wear', 'right_corner45_wear', 'gauge', 'conicity'];
  const isTrack = data.quantities.some(q => q.name === 'gauge');
  const wanted = q => isTrack ? track.includes(q.name) : !/deviation|overlap|radius/.test(q.name);
  const shown = data.quantities.filter(q => q.known && wanted(q)).slice(0, 9);
  const t = table(box, ['frame', alongText, ...shown.map(withUnit), 'verdict', 'status'], data.worst.map(i => ['', fixed(along(i), 1),
    ...shown.map(q => fixed(q.values[i], q.decimals)), rows.verdict[i], rows.status[i]]));
  data.worst.forEach((i, k) => {
    const line = t.rows[k + 1], link = element('a', String(rows.frame[i]), line.cells[0]);
    link.href = '#f' + rows.frame[i];
    line.cells[2 + shown.length].className = rows.verdict[i];
  });
}

// The quantity's own span with its limits; sigma widens it at most by as much again, beyond that the band is cut at the frame.
function valueSpan(q) {
  const known = q.values.filter(v => v !== null), limits = [q.low, q.high].filter(v => v !== null);
  let low = Math.min(...known), high = Math.max(...known);
  const own = Math.max(high - low, 0.02), sigma = Math.min(own, Math.max(0, ...q.sigmas.filter(s => s !== null)));
  low -= sigma; high += sigma;
  limits.forEach(l => { low = Math.min(low, l); high = Math.max(high, l); });
  const margin = Math.max(0.005, 0.08 * (high - low));
  return [low - margin, high + margin];
}

function nearestSection(i) {
  return data.sections.reduce((best, s) => Math.abs(s.row - i) < Math.abs(best.row - i) ? s : best, data.sections[0]);
}

function showChart(q) {
  element('h3', withUnit(q), at('charts'));
  const [low, high] = valueSpan(q);
  const point = (i, v) => ({ x: along(i), y: v, row: i });
  const each = f => q.values.map((v, i) => point(i, v === null ? NaN : f(v, q.sigmas[i] || 0)));
  const limit = (l, name) => ({ label: name, data: [{ x: along(0), y: l }, { x: along(count - 1), y: l }], borderColor: '#dc2626', borderWidth: 1.5,
    borderDash: [6, 4], pointRadius: 0, order: 3 });
  const sets = [
    { label: 'measured', data: each(v => v), borderColor: colors[0], backgroundColor: colors[0], borderWidth: 1.5, pointRadius: count > 300 ? 0 : 2, order: 1 },
    { label: '+ sigma', data: each((v, s) => v + s), borderWidth: 0, pointRadius: 0, fill: '+1', backgroundColor: 'rgba(37, 99, 235, .18)', order: 2 },
    { label: '- sigma', data: each((v, s) => v - s), borderWidth: 0, pointRadius: 0, order: 2 }];
  if (q.low !== null) sets.push(limit(q.low, 'lower limit'));
  if (q.high !== null) sets.push(limit(q.high, 'upper limit'));
  new Chart(element('canvas', undefined, element('div', undefined, at('charts'), 'chart')), {
    type: 'line', data: { datasets: sets },
    options: { animation: false, parsing: false, normalized: true, maintainAspectRatio: false, clip: true,
      interaction: { mode: 'nearest', axis: 'x', intersect: false },
      onClick: (e, hit) => { if (hit.length) location.hash = '#f' + rows.frame[nearestSection(hit[0].element.$context.raw.row).row]; },
      plugins: { legend: { display: false }, tooltip: { filter: c => c.datasetIndex === 0, displayColors: false, callbacks: {
        title: c => c.length ? `frame ${rows.frame[c[0].raw.row]}${placeOf(c[0].raw.row)}` : '',
        label: c => `${fixed(c.raw.y, q.decimals)} ${q.unit}` + (q.sigmas[c.raw.row] !== null ? `, sigma ${fixed(q.sigmas[c.raw.row], Math.max(3, q.decimals))}` : ''),
        afterLabel: c => rows.status[c.raw.row] === 'ok' ? '' : rows.status[c.raw.row] } } },
      scales: { x: { type: 'linear', min: Math.min(...rows.travel.map((_, i) => along(i))), max: Math.max(...rows.travel.map((_, i) => along(i))), title: { display: true, text: alongText } },
        y: { min: low, max: high, title: { display: true, text: q.unit }, ticks: { includeBounds: false, maxTicksLimit: 7 } } } }
  });
}

// Deviations of a turning wheel round a circle, enlarged so that they are seen.
function showRunOut() {
  if (!data.run_out) return;
  const text = (name, r) => r.value === null ? `${name} run-out: not known (${r.reason}).` :
    `${name} run-out ${fixed(r.value, 3)} mm, predicted sigma ${fixed(r.sigma, 3)} mm (highest less lowest of a whole turn).`;
  element('p', text('Radial', data.run_out.radial), at('runout'));
  element('p', text('Axial', data.run_out.axial), at('runout'));
  const of = name => data.quantities.find(q => q.name === name && q.known > 2);
  const curves = [['radial', of('radial_deviation'), colors[0]], ['axial', of('axial_deviation'), colors[1]]].filter(c => c[1]);
  if (!curves.length || !travelMoves) return;
  const most = Math.max(1e-3, ...curves.flatMap(c => c[1].values.filter(v => v !== null).map(Math.abs)));
  const ring = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5].find(r => r >= most / 2.01) || most, radius = 4 * ring;
  const place = (deg, r) => ({ x: r * Math.cos(deg * Math.PI / 180), y: r * Math.sin(deg * Math.PI / 180) });
  const circle = r => Array.from({ length: 121 }, (_, k) => place(3 * k, r));
  const rings = [-2, -1, 0, 1, 2].map(k => ({ label: k ? '' : 'mean', data: circle(radius + k * ring), showLine: true, pointRadius: 0,
    borderColor: k ? '#d5dbe3' : '#64748b', borderWidth: k ? 1 : 1.5, borderDash: k ? [3, 3] : [] }));
  const order = [...rows.travel.keys()].sort((a, b) => rows.travel[a] - rows.travel[b]);
  const sets = curves.map(([name, q, color]) => {
    const points = order.filter(i => q.values[i] !== null).map(i => ({ ...place(rows.travel[i], radius + q.values[i]), row: i }));
    const turn = rows.travel[order[order.length - 1]] - rows.travel[order[0]];
    if (points.length && turn > 300) points.push(points[0]);
    return { label: name + ' deviation', data: points, showLine: true, pointRadius: 2.5, borderColor: color, backgroundColor: color, borderWidth: 2, q };
  });
  element('h3', `Run-out by angle, one ring = ${ring} mm`, at('runout'));
  const reach = radius + 2.6 * ring;
  const hidden = { min: -reach, max: reach, display: false };
  new Chart(element('canvas', undefined, element('div', undefined, at('runout'), 'polar')), {
    type: 'scatter', data: { datasets: [...sets, ...rings] },
    options: { animation: false, maintainAspectRatio: false, scales: { x: hidden, y: hidden },
      plugins: { legend: { labels: { filter: l => l.text !== '', usePointStyle: true } }, tooltip: { filter: c => c.raw.row !== undefined, callbacks: {
        label: c => `${c.dataset.label} ${fixed(c.dataset.q.values[c.raw.row], 3)} mm at ${fixed(rows.travel[c.raw.row], 1)}\u00b0, frame ${rows.frame[c.raw.row]}` } } } },
    plugins: [{ id: 'angles', afterDatasetsDraw: chart => {
      const c = chart.ctx;
      c.save(); c.fillStyle = '#64748b'; c.font = '12px system-ui, "DejaVu Sans", sans-serif'; c.textAlign = 'center'; c.textBaseline = 'middle';
      [0, 45, 90, 135, 180, 225, 270, 315].forEach(deg => { const p = place(deg, radius + 2.4 * ring); c.fillText(deg + '\u00b0', chart.scales.x.getPixelForValue(p.x), chart.scales.y.getPixelForValue(p.y)); });
      c.restore();
    } }]
  });
}

function svg(tag, parent, attributes) {
  const e = document.createElementNS('http://www.w3.org/2000/svg', tag);
  Object.entries(attributes).forEach(([k, v]) => e.setAttribute(k, v));
  parent.appendChild(e);
  return e;
}

function pairs(list, each) {
  let path = '';
  for (let i = 0; i < list.length; i += 2) path += each(list[i], -list[i + 1], i / 2);
  return path;
}

function drawSection(parent, d) {
  const [left, low, right, high] = d.box;
  const picture = svg('svg', parent, { viewBox: `${left} ${-high} ${right - left} ${high - low}` });
  d.reference.forEach(line => svg('path', picture, { d: pairs(line, (x, y, k) => (k ? 'L' : 'M') + x + ' ' + y), fill: '#eef1f5', stroke: '#94a3b8', 'stroke-width': 0.4 }));
  const kinds = { '#c8401f': v => v < -0.1, '#2a7ab8': v => v > 0.1, '#4a9a4a': v => Math.abs(v) <= 0.1 };
  Object.entries(kinds).forEach(([color, is]) => {
    let path = '';
    d.differences.forEach((v, i) => { if (is(v)) { const w = d.whiskers.slice(4 * i, 4 * i + 4); path += `M${w[0]} ${-w[1]}L${w[2]} ${-w[3]}`; } });
    svg('path', picture, { d: path, stroke: color, 'stroke-width': 0.35 });
  });
  svg('path', picture, { d: pairs(d.points, (x, y) => `M${x} ${y}h0`), stroke: '#222', 'stroke-width': 0.5, 'stroke-linecap': 'round' });
}

function showSection(s) {
  const figure = element('figure', undefined, at('sections')), i = s.row;
  figure.id = 'f' + rows.frame[i];
  s.drawings.forEach(d => drawSection(figure, d));
  element('figcaption', `frame ${rows.frame[i]}${placeOf(i)}: ${rows.status[i]}; differences ${s.drawings[0].enlarged} times`, figure);
  if (!s.pictures.length) return;
  const thumbs = element('div', undefined, figure, 'thumbs');
  s.pictures.forEach(p => {
    const link = element('a', undefined, thumbs);
    link.href = p.href;
    if (p.picture) element('img', undefined, link).src = p.picture;
    element('span', p.sensor, link);
  });
}

// One line a drawn section, from the first (blue) to the last (orange).
function showConicity() {
  if (!data.conicity.length) return;
  element('h3', 'Equivalent conicity over the amplitude', at('charts'));
  const last = Math.max(1, data.conicity.length - 1);
  const color = k => `hsl(${k / last < 0.5 ? 215 : 25} ${40 + 50 * Math.abs(2 * k / last - 1)}% 50%)`;
  new Chart(element('canvas', undefined, element('div', undefined, at('charts'), 'chart tall')), {
    type: 'scatter', data: { datasets: data.conicity.map((c, k) => ({ label: 'frame ' + rows.frame[c.row], showLine: true, pointRadius: 0, pointHitRadius: 4,
      borderColor: color(k), backgroundColor: color(k), borderWidth: 1.5, data: c.y.map((y, j) => ({ x: y, y: c.values[j] })) })) },
    options: { animation: false, maintainAspectRatio: false, scales: { x: { title: { display: true, text: 'amplitude, mm' } }, y: { title: { display: true, text: 'tan \u03b3e' } } },
      plugins: { legend: { position: 'right', labels: { usePointStyle: true, pointStyle: 'line', boxWidth: 20 } },
        tooltip: { callbacks: { label: c => `${c.dataset.label}: ${fixed(c.raw.y, 4)} at ${fixed(c.raw.x, 1)} mm` } } } }
  });
}

showHead();
showSummary();
showRunOut();
showWorst();
data.quantities.filter(q => q.known > 1).forEach(showChart);
showConicity();
data.sections.forEach(showSection);
document.body.dataset.ready = 'yes';
