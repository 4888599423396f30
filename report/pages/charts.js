// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// Draws a page of facts, tables and line charts from its JSON with Chart.js.
const short = v => v === null ? '-' : String(Number(v.toPrecision(6)));

function showHead() {
  at('title').textContent = data.title;
  at('verdict').textContent = data.verdict;
  at('verdict').classList.add(data.good === null ? 'plain' : data.good ? 'good' : 'bad');
  if (data.rows.length) table(at('table'), data.header, data.rows);
  data.notes.forEach(n => element('p', n, at('table'), 'note'));
}

function setsOf(line, color) {
  const each = f => line.x.map((x, i) => ({ x, y: line.y[i] === null ? NaN : f(line.y[i], line.half[i] || 0), half: line.half[i] }));
  const sets = [{ label: line.name, data: each(v => v), borderColor: color, backgroundColor: color, borderWidth: line.dots ? 0 : 1.5,
    showLine: !line.dots, pointRadius: line.dots ? 1.6 : line.x.length < 60 ? 2 : 0, measured: true, order: line.dots ? 1 : 0 }];
  if (line.half.length) {
    sets.push({ label: '', data: each((v, h) => v + h), showLine: true, borderWidth: 0, pointRadius: 0, fill: '+1', backgroundColor: color + '2e', order: 2 });
    sets.push({ label: '', data: each((v, h) => v - h), showLine: true, borderWidth: 0, pointRadius: 0, order: 2 });
  }
  return sets;
}

// Of the lines and limits themselves; bands may leave the frame.
function spanOf(values, share) {
  const known = values.filter(v => v !== null);
  const low = Math.min(...known), high = Math.max(...known), margin = Math.max(1e-4, share * (high - low) || 0.1 * Math.abs(high));
  return known.length ? [low - margin, high + margin] : [0, 1];
}

// Widens the span of the axis that has fewer millimetres a pixel, so that circles are round.
function equalised(x, y, width, height) {
  const scale = Math.max((x[1] - x[0]) / width, (y[1] - y[0]) / height);
  const about = (s, pixels) => [(s[0] + s[1] - scale * pixels) / 2, (s[0] + s[1] + scale * pixels) / 2];
  return [about(x, width), about(y, height)];
}

function addBox(chart) {
  const card = element('div', undefined, at('charts'), 'card');
  element('h3', chart.title, card);
  return element('div', undefined, card, 'chart');
}

function showChart(chart, box) {
  let x = spanOf(chart.lines.flatMap(l => l.x), 0.02), y = spanOf(chart.lines.flatMap(l => l.y).concat(chart.limits), 0.1);
  if (chart.equal_scales) [x, y] = equalised(x, y, box.clientWidth - 60, box.clientHeight - 50);
  const sets = chart.lines.flatMap((l, i) => setsOf(l, colors[i % colors.length]));
  chart.limits.forEach(l => sets.push({ label: 'limit', data: [{ x: x[0], y: l }, { x: x[1], y: l }], showLine: true, borderColor: '#dc2626', borderWidth: 1.5,
    borderDash: [6, 4], pointRadius: 0, order: 3 }));
  new Chart(element('canvas', undefined, box), {
    type: 'scatter', data: { datasets: sets },
    options: { animation: false, maintainAspectRatio: false, clip: true, interaction: { mode: 'nearest', intersect: false },
      plugins: { legend: { display: chart.lines.some(l => l.name), labels: { boxWidth: 14, filter: l => l.text !== '' } },
        tooltip: { filter: c => c.dataset.measured, displayColors: false, callbacks: {
          label: c => `${c.dataset.label ? c.dataset.label + ': ' : ''}${short(c.raw.x)}, ${short(c.raw.y)}` + (c.raw.half ? ` \u00b1 ${short(c.raw.half)}` : '') } } },
      scales: { x: { type: 'linear', min: x[0], max: x[1], title: { display: true, text: chart.x_name }, ticks: { includeBounds: false } },
        y: { min: y[0], max: y[1], title: { display: true, text: chart.y_name }, ticks: { includeBounds: false, maxTicksLimit: 7 } } } }
  });
}

showHead();
// All boxes first: a chart needs the size that its box has beside the others.
const boxes = data.charts.map(addBox);
data.charts.forEach((chart, i) => showChart(chart, boxes[i]));
