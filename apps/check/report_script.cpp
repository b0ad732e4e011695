#include "apps/check/report_html.h"

namespace lagomorph::apps {

const std::string_view report_script = R"js(
'use strict';
(() => {
  const $ = id => document.getElementById(id), viewer = $('viewer'), chart = document.querySelector('.chart');
  if (!viewer) return;
  const shown = new Map([...document.querySelectorAll('[data-pictures]')].map(e => [Number(e.dataset.pictures), e]));
  const numbers = chart ? chart.dataset.frames.split(' ').map(Number) : [...shown.keys()];
  const failing = viewer.dataset.failing ? viewer.dataset.failing.split(' ').map(Number) : [];
  if (!numbers.length) return;
  const views = ['side', 'slider', 'blink', 'diff', 'heat'], left = $('left'), right = $('right');
  const state = { i: 0, view: 'side', zoom: 1, x: 0.5, y: 0.5, times: 8, wipe: 0.5, blink: false };
  const clamp = (v, a, b) => Math.min(b, Math.max(a, v));
  const pictures = () => {
    const e = shown.get(numbers[state.i]);
    if (!e) return null;
    const golden = e.querySelector('.golden'), fresh = e.querySelector('.new');
    return { golden: golden || fresh, fresh: fresh || golden, heat: e.querySelector('.heat'), both: golden && fresh,
      w: Number(e.dataset.width), h: Number(e.dataset.height) };
  };
  const scratch = (w, h) => { const c = document.createElement('canvas'); c.width = w; c.height = h; return c; };
  // |golden - new| times 2^k, by adding the picture to itself.
  const difference = p => {
    const w = p.fresh.naturalWidth, h = p.fresh.naturalHeight;
    let c = scratch(w, h), g = c.getContext('2d');
    g.drawImage(p.golden, 0, 0, w, h); g.globalCompositeOperation = 'difference'; g.drawImage(p.fresh, 0, 0, w, h);
    for (let n = 1; n < state.times; n *= 2) {
      const d = scratch(w, h), k = d.getContext('2d');
      k.drawImage(c, 0, 0); k.globalCompositeOperation = 'lighter'; k.drawImage(c, 0, 0); c = d;
    }
    return c;
  };
  const place = (canvas, p) => {
    const scale = canvas.width / p.w * state.zoom;
    return { x: canvas.width / 2 - state.x * p.w * scale, y: canvas.height / 2 - state.y * p.h * scale, w: p.w * scale, h: p.h * scale, scale };
  };
  const paint = (canvas, p, image) => {
    const g = canvas.getContext('2d'), at = place(canvas, p);
    g.imageSmoothingEnabled = at.scale < 2;
    g.clearRect(0, 0, canvas.width, canvas.height);
    if (image) g.drawImage(image, at.x, at.y, at.w, at.h);
    return g;
  };
  const draw = () => {
    const p = pictures(), two = state.view === 'side';
    right.hidden = !two;
    if (!p) {
      left.height = 60; right.hidden = true;
      $('what').textContent = failing.includes(numbers[state.i]) ? 'This page keeps no picture of this frame.'
        : 'This frame passes; the page keeps no picture of it.';
      return;
    }
    for (const c of [left, right]) {
      const w = Math.max(1, Math.round(c.clientWidth * devicePixelRatio));
      c.width = w; c.height = Math.max(1, Math.round(w * p.h / p.w));
    }
    const late = [p.golden, p.fresh, p.heat].filter(e => e && !e.complete);
    if (late.length) late[0].addEventListener('load', draw, { once: true });
    let what = 'golden left, new right';
    if (state.view === 'side') { paint(left, p, p.golden); paint(right, p, p.fresh); }
    if (state.view === 'slider') {
      const g = paint(left, p, p.golden), at = place(left, p), x = state.wipe * left.width;
      g.save(); g.beginPath(); g.rect(x, 0, left.width, left.height); g.clip();
      g.clearRect(0, 0, left.width, left.height); g.drawImage(p.fresh, at.x, at.y, at.w, at.h); g.restore();
      g.fillStyle = '#f0884a'; g.fillRect(x - 1, 0, 2, left.height);
      what = 'golden left of the line, new right of it; drag the line';
    }
    if (state.view === 'blink') { paint(left, p, state.blink ? p.fresh : p.golden); what = state.blink ? 'new' : 'golden'; }
    if (state.view === 'diff') { paint(left, p, difference(p)); what = '|golden − new| times ' + state.times; }
    if (state.view === 'heat') { paint(left, p, p.heat); what = p.heat ? "FLIP's error in magma: black none, white most" : 'no heat: the frame passes, or cannot be compared'; }
    $('what').textContent = p.both ? what : what + ' (only one picture is on this page)';
  };
  const link = () => history.replaceState(null, '', '#frame=' + numbers[state.i] + '&view=' + state.view +
    (state.zoom > 1 ? '&zoom=' + +state.zoom.toFixed(3) + '&at=' + state.x.toFixed(4) + ',' + state.y.toFixed(4) : '') +
    (state.view === 'diff' ? '&times=' + state.times : ''));
  const tell = () => {
    const n = numbers[state.i];
    $('where').textContent = 'frame ' + n + (failing.includes(n) ? ' fails' : ' passes');
    $('scrub').value = state.i; $('times').value = state.times;
    $('scrub').setAttribute('aria-valuetext', $('where').textContent);
    document.querySelectorAll('#views button').forEach(b => b.classList.toggle('on', b.dataset.view === state.view));
    if (chart) {
      const now = chart.querySelector('.now'), first = numbers[0], last = numbers[numbers.length - 1];
      now.hidden = false; now.style.left = (last > first ? 100 * (n - first) / (last - first) : 50) + '%';
      chart.querySelectorAll('output').forEach(o => { o.textContent = o.dataset.values.split(' ')[state.i]; });
    }
  };
  const update = () => { tell(); draw(); link(); };
  const seek = i => { state.i = clamp(i, 0, numbers.length - 1); $('values').textContent = ''; update(); };
  const nearest = v => numbers.reduce((b, n, i) => Math.abs(n - v) < Math.abs(numbers[b] - v) ? i : b, 0);
  const look = view => { state.view = view; update(); };
  const bad = () => { if (failing.length) seek(numbers.indexOf(failing.find(n => n > numbers[state.i]) ?? failing[0])); };
  const zoom = (by, x = state.x, y = state.y) => {
    const z = clamp(state.zoom * by, 1, 64), k = state.zoom / z;
    state.x = clamp(x + (state.x - x) * k, 0, 1); state.y = clamp(y + (state.y - y) * k, 0, 1); state.zoom = z;
    if (z === 1) state.x = state.y = 0.5;
    update();
  };
  const times = by => { state.times = clamp(state.times * by, 1, 64); update(); };
  const pixel = (canvas, e) => {
    const p = pictures(), box = canvas.getBoundingClientRect();
    if (!p) return null;
    const at = place(canvas, p), u = (e.clientX - box.left) / box.width * canvas.width, v = (e.clientY - box.top) / box.height * canvas.height;
    return { p, x: (u - at.x) / at.w, y: (v - at.y) / at.h, u: u / canvas.width };
  };
  const samples = new WeakMap();
  const value = (image, x, y) => {
    if (!samples.has(image)) {
      const c = scratch(image.naturalWidth, image.naturalHeight), g = c.getContext('2d', { willReadFrequently: true });
      g.drawImage(image, 0, 0); samples.set(image, g);
    }
    return [...samples.get(image).getImageData(Math.floor(x * image.naturalWidth), Math.floor(y * image.naturalHeight), 1, 1).data].slice(0, 3);
  };
  const read = at => {
    if (!at || at.x < 0 || at.y < 0 || at.x >= 1 || at.y >= 1) return;
    const { p, x, y } = at;
    try {
      const a = value(p.golden, x, y), b = value(p.fresh, x, y);
      $('values').textContent = 'x ' + Math.floor(x * p.w) + ', y ' + Math.floor(y * p.h) + ': golden ' + a.join(' ') + ', new ' + b.join(' ') +
        ', difference ' + a.map((v, i) => (b[i] > v ? '+' : '') + (b[i] - v)).join(' ').replaceAll('-', '−') +
        (p.fresh.naturalWidth < p.w ? ' (of the smaller copy)' : '');
    } catch (error) { $('values').textContent = 'pixel values need this page from a server: the browser does not let files read files'; }
  };
  let held = null;
  for (const canvas of [left, right]) {
    canvas.addEventListener('wheel', e => { const at = pixel(canvas, e); if (at) { e.preventDefault(); zoom(e.deltaY < 0 ? 1.25 : 0.8, at.x, at.y); } }, { passive: false });
    canvas.addEventListener('pointerdown', e => { canvas.setPointerCapture(e.pointerId); held = pixel(canvas, e);
      if (held && state.view === 'slider') { state.wipe = clamp(held.u, 0, 1); draw(); } });
    canvas.addEventListener('pointermove', e => {
      const at = pixel(canvas, e);
      read(at);
      if (!held || !at || !e.buttons) return;
      if (state.view === 'slider') { state.wipe = clamp(at.u, 0, 1); draw(); return; }
      if (state.zoom > 1) { state.x = clamp(state.x + held.x - at.x, 0, 1); state.y = clamp(state.y + held.y - at.y, 0, 1); draw(); }
    });
    canvas.addEventListener('pointerup', () => { if (held) { held = null; link(); } });
  }
  const follow = () => {
    const part = new URLSearchParams(location.hash.slice(1));
    if (!part.has('frame')) return false;
    state.i = nearest(Number(part.get('frame')) || 0);
    if (views.includes(part.get('view'))) state.view = part.get('view');
    if (part.has('zoom')) state.zoom = clamp(Number(part.get('zoom')) || 1, 1, 64);
    const at = (part.get('at') || '').split(',').map(Number);
    if (at.length === 2 && at.every(Number.isFinite)) { state.x = clamp(at[0], 0, 1); state.y = clamp(at[1], 0, 1); }
    if ([1, 2, 4, 8, 16, 32, 64].includes(Number(part.get('times')))) state.times = Number(part.get('times'));
    tell(); draw(); viewer.scrollIntoView();
    return true;
  };
  document.querySelectorAll('#views button').forEach(b => b.addEventListener('click', () => look(b.dataset.view)));
  $('back').addEventListener('click', () => seek(state.i - 1));
  $('next').addEventListener('click', () => seek(state.i + 1));
  $('bad').addEventListener('click', bad);
  $('in').addEventListener('click', () => zoom(2));
  $('out').addEventListener('click', () => zoom(0.5));
  $('fit').addEventListener('click', () => zoom(0));
  $('times').addEventListener('change', e => { state.times = Number(e.target.value); look('diff'); });
  $('scrub').addEventListener('input', e => seek(Number(e.target.value)));
  if (chart) {
    const area = chart.querySelector('.area');
    const go = e => { const b = area.getBoundingClientRect(), first = numbers[0];
      seek(nearest(first + (numbers[numbers.length - 1] - first) * clamp((e.clientX - b.left) / b.width, 0, 1))); };
    area.addEventListener('pointerdown', e => { area.setPointerCapture(e.pointerId); go(e); });
    area.addEventListener('pointermove', e => { if (e.buttons) go(e); });
  }
  const keys = { ArrowLeft: () => seek(state.i - 1), ArrowRight: () => seek(state.i + 1), Home: () => seek(0),
    End: () => seek(numbers.length - 1), n: bad, '+': () => zoom(2), '-': () => zoom(0.5), 0: () => zoom(0),
    '[': () => times(0.5), ']': () => times(2) };
  views.forEach((view, i) => { keys[i + 1] = () => look(view); });
  document.addEventListener('keydown', e => {
    if (e.ctrlKey || e.metaKey || e.altKey || !keys[e.key] || e.target.closest('select')) return;
    e.preventDefault();
    keys[e.key]();
  });
  setInterval(() => { if (state.view === 'blink') { state.blink = !state.blink; draw(); } }, 500);
  addEventListener('hashchange', follow);
  addEventListener('resize', draw);
  document.documentElement.classList.add('js');
  viewer.hidden = false;
  const worst = document.querySelector('[data-pictures]');
  state.i = worst ? Math.max(0, numbers.indexOf(Number(worst.dataset.pictures))) : 0;
  if (!follow()) { tell(); draw(); }
})();
)js";

}  // namespace lagomorph::apps
