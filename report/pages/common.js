// SPDX-FileCopyrightText: 2026 The lightstripe authors
// SPDX-License-Identifier: Apache-2.0
// What all pages share: their data, and small helpers for elements and colours.
'use strict';
const data = JSON.parse(document.getElementById('data').textContent);
const at = id => document.getElementById(id);
const colors = ['#2563eb', '#ea580c', '#16a34a', '#9333ea', '#0891b2', '#be123c'];

function element(tag, text, parent, className) {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (className) e.className = className;
  if (parent) parent.appendChild(e);
  return e;
}

function table(parent, header, rows) {
  const t = element('table', undefined, parent);
  const head = element('tr', undefined, t);
  const isText = c => typeof c === 'string' && !/^(-|[-+]?[\d.]+)?$/.test(c);
  header.forEach((h, i) => element('th', h, head, rows.some(r => isText(r[i])) ? 'text' : ''));
  rows.forEach(r => {
    const line = element('tr', undefined, t);
    r.forEach(c => element('td', c, line, isText(c) ? 'text' : ''));
  });
  return t;
}
