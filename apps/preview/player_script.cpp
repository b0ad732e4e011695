#include "apps/preview/page.h"

namespace lagomorph::apps {

const std::string_view player_script = R"js(
'use strict';
(() => {
  const data = document.getElementById('frames');
  const frames = data ? JSON.parse(data.textContent) : null;
  const charts = [...document.querySelectorAll('.chart')].map(figure => ({
    area: figure.querySelector('.area'), now: figure.querySelector('.now'),
    frames: figure.dataset.frames.split(' ').map(Number), half: figure.dataset.bars === '1' ? 0.5 : 0,
    outputs: [...figure.querySelectorAll('output')].map(o => ({ o, values: o.dataset.values.split(' ') })),
  }));
  const nearest = (list, value) => list.reduce((best, v, i) => Math.abs(v - value) < Math.abs(list[best] - value) ? i : best, 0);

  // The frame `number` of the run in every chart; nearest for those that lack it.
  const mark = number => charts.forEach(c => {
    const first = c.frames[0] - c.half, last = c.frames[c.frames.length - 1] + c.half;
    const i = nearest(c.frames, number);
    c.now.hidden = false;
    c.now.style.left = (last > first ? 100 * (c.frames[i] - first) / (last - first) : 50) + '%';
    c.outputs.forEach(({ o, values }) => { o.textContent = values[i].replace('-', '−'); });
  });
  const frameAt = (c, event) => {
    const box = c.area.getBoundingClientRect();
    const first = c.frames[0] - c.half, last = c.frames[c.frames.length - 1] + c.half;
    return first + (last - first) * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
  };
  if (!frames) {
    charts.forEach(c => c.area.addEventListener('pointermove', e => mark(frameAt(c, e))));
    return;
  }

  const root = document.documentElement, $ = id => document.getElementById(id);
  const numbers = frames.frames.map(f => f.n);
  const images = frames.frames.map(f => { const image = new Image(); image.src = f.src; return image; });
  const still = $('still'), canvas = document.createElement('canvas');
  canvas.id = 'view'; canvas.className = still.className;
  canvas.width = still.getAttribute('width'); canvas.height = still.getAttribute('height');
  canvas.setAttribute('role', 'img');
  const context = canvas.getContext('2d');
  let at = 0, playing = false, speed = 1, begun = 0, from = 0;

  const draw = i => {
    const image = images[i];
    if (!image.complete) { image.addEventListener('load', () => { if (at === i) draw(i); }, { once: true }); return; }
    context.drawImage(image, 0, 0, canvas.width, canvas.height);
  };
  const show = i => {
    at = Math.min(numbers.length - 1, Math.max(0, i));
    const f = frames.frames[at];
    draw(at);
    $('scrub').value = at;
    $('where').textContent = 'frame ' + f.n + (f.t === undefined ? '' : ' · ' + f.t.toFixed(2) + ' s');
    $('scrub').setAttribute('aria-valuetext', $('where').textContent);
    canvas.setAttribute('aria-label', $('where').textContent);
    mark(f.n);
    document.querySelectorAll('.sheet a').forEach(a => a.classList.toggle('current', Number(a.dataset.frame) === f.n));
  };
  const tick = now => {
    if (!playing) return;
    const i = from + Math.floor((now - begun) / 1000 * frames.rate * speed);
    if (i > numbers.length - 1) { begun = now; from = 0; show(0); } else if (i !== at) show(i);
    requestAnimationFrame(tick);
  };
  const play = on => {
    playing = on && numbers.length > 1;
    $('play').textContent = playing ? 'Pause' : 'Play';
    begun = performance.now(); from = at === numbers.length - 1 ? 0 : at;
    if (playing) requestAnimationFrame(tick);
  };
  const seek = i => { play(false); show(i); };
  const change = by => {
    const options = $('speed').options;
    $('speed').selectedIndex = Math.min(options.length - 1, Math.max(0, $('speed').selectedIndex + by));
    $('speed').dispatchEvent(new Event('change'));
  };
  const follow = () => {
    const match = /^#frame=(\d+)$/.exec(location.hash);
    if (match) seek(nearest(numbers, Number(match[1])));
    return match;
  };

  $('play').addEventListener('click', () => play(!playing));
  $('back').addEventListener('click', () => seek(at - 1));
  $('next').addEventListener('click', () => seek(at + 1));
  $('scrub').addEventListener('input', e => seek(Number(e.target.value)));
  $('speed').addEventListener('change', e => { speed = Number(e.target.value); begun = performance.now(); from = at; });
  canvas.addEventListener('click', () => play(!playing));
  charts.forEach(c => {
    const go = e => seek(nearest(numbers, frameAt(c, e)));
    c.area.addEventListener('pointerdown', e => { c.area.setPointerCapture(e.pointerId); go(e); });
    c.area.addEventListener('pointermove', e => { if (e.buttons) go(e); });
  });
  const keys = { ' ': () => play(!playing), ArrowLeft: () => seek(at - 1), ArrowRight: () => seek(at + 1),
    Home: () => seek(0), End: () => seek(numbers.length - 1), '+': () => change(1), '-': () => change(-1) };
  document.addEventListener('keydown', e => {
    if (e.ctrlKey || e.metaKey || e.altKey || !keys[e.key]) return;
    if (e.target.closest('select, summary, a') || (e.key === ' ' && e.target.closest('button'))) return;
    e.preventDefault();
    keys[e.key]();
  });
  addEventListener('hashchange', follow);

  root.classList.add('js');
  still.replaceWith(canvas);
  show(numbers.indexOf(Number(still.dataset.frame)));
  follow();
})();
)js";

}  // namespace lagomorph::apps
