#include "apps/page/style.h"

namespace lagomorph::apps {

const std::string_view page_style = R"css(
:root { color-scheme: light dark; --bg: #f6f6f4; --card: #fff; --ink: #1b1d21; --soft: #646a74; --line: #e2e2de;
  --good: #1a7f4b; --warn: #9a5b00; --accent: #11727f; --c1: #1b1d21; --c2: #d2601a; --c3: #11808f; --c4: #8a63c9; }
@media (prefers-color-scheme: dark) {
  :root { --bg: #131519; --card: #1c1f25; --ink: #eceef1; --soft: #9aa1ac; --line: #2e323a; --good: #56c98c;
    --warn: #eab15f; --accent: #4fb9c6; --c1: #eceef1; --c2: #f0884a; --c3: #43b9c8; --c4: #b494ec; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--bg); color: var(--ink); font: 16px/1.5 system-ui, -apple-system, "Segoe UI", Roboto,
  "Helvetica Neue", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
main { max-width: 1120px; margin: 0 auto; padding: 28px 20px 48px; }
header { margin-bottom: 20px; }
h1 { margin: 0; font-size: clamp(26px, 5vw, 38px); line-height: 1.15; letter-spacing: -.02em; overflow-wrap: anywhere; }
header p { margin: 6px 0 0; font-size: 18px; color: var(--soft); }
h2 { font-size: 19px; margin: 36px 0 12px; letter-spacing: -.01em; }
.good { color: var(--good); font-weight: 600; } .good::before { content: "✓ "; }
.part { color: var(--warn); font-weight: 600; }
.remarks { list-style: none; margin: 14px 0 0; padding: 0; }
.remarks li { border-left: 4px solid var(--warn); background: var(--card); padding: 8px 12px; margin-top: 6px;
  border-radius: 0 8px 8px 0; overflow-wrap: anywhere; }
.card, .chart { background: var(--card); border: 1px solid var(--line); border-radius: 12px; margin: 0; }
.top { display: grid; grid-template-columns: minmax(0, 1fr) 300px; gap: 20px; align-items: start; }
.player { overflow: hidden; }
.stage { background: #0c0d10; display: flex; justify-content: center; }
.stage img, .stage canvas { display: block; width: 100%; max-height: 72vh; object-fit: contain; }
.stage .tiny { image-rendering: pixelated; }
.controls { display: none; flex-wrap: wrap; gap: 10px; align-items: center; padding: 12px 14px; }
.js .controls { display: flex; }
.controls input { flex: 1 1 100%; margin: 0; height: 22px; accent-color: var(--accent); }
.controls button, .controls select { font: inherit; color: inherit; background: var(--bg); border: 1px solid var(--line);
  border-radius: 8px; min-width: 42px; height: 38px; padding: 0 10px; cursor: pointer; }
.controls button:hover, .controls select:hover { border-color: var(--accent); }
.controls .play { background: var(--accent); border-color: var(--accent); color: #fff; min-width: 84px; font-weight: 600; }
@media (prefers-color-scheme: dark) { .controls .play { color: #06181b; } }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; }
.where { margin-left: auto; font-weight: 600; white-space: nowrap; }
.keys { margin: 8px 2px 0; color: var(--soft); font-size: 13px; display: none; } .js .keys { display: block; }
kbd { font: 12px ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; border: 1px solid var(--line); border-radius: 4px;
  padding: 0 4px; background: var(--card); }
dl { margin: 0; padding: 6px 16px; }
dl div { padding: 9px 0; border-top: 1px solid var(--line); } dl div:first-child { border: 0; }
dt { color: var(--soft); font-size: 13px; } dd { margin: 0; overflow-wrap: anywhere; line-height: 1.4; }
.charts { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 20px; }
.chart { padding: 14px 16px 10px; } .chart:first-child { grid-column: 1 / -1; }
figcaption span { color: var(--soft); font-size: 14px; }
figcaption ul { display: flex; flex-wrap: wrap; gap: 2px 18px; list-style: none; margin: 4px 0 12px; padding: 0; font-size: 14px; }
figcaption i { display: inline-block; width: 14px; height: 4px; border-radius: 2px; margin-right: 6px; vertical-align: middle;
  background: currentColor; }
li.s1 i { color: var(--c1); } li.s2 i { color: var(--c2); } li.s3 i { color: var(--c3); } li.s4 i { color: var(--c4); }
figcaption output { font-weight: 600; }
.plot { position: relative; padding: 0 6px 24px 54px; }
.area { position: relative; height: 190px; cursor: pointer; }
.area svg { width: 100%; height: 100%; display: block; overflow: visible; }
polyline { fill: none; stroke-width: 2.25; vector-effect: non-scaling-stroke; stroke-linejoin: round; }
polyline.s1 { stroke: var(--c1); } polyline.s2 { stroke: var(--c2); } polyline.s3 { stroke: var(--c3); } polyline.s4 { stroke: var(--c4); }
path.s1 { fill: var(--c1); } path.s2 { fill: var(--c2); } path.s3 { fill: var(--c3); } path.s4 { fill: var(--c4); }
.grid, .zero { stroke: var(--line); stroke-width: 1; vector-effect: non-scaling-stroke; } .zero { stroke: var(--soft); }
.y span, .x span { position: absolute; font-size: 12px; line-height: 1; color: var(--soft); white-space: nowrap; }
.y { position: absolute; left: 0; top: 0; bottom: 24px; width: 46px; } .y span { right: 0; transform: translateY(50%); }
.x { position: absolute; left: 54px; right: 6px; bottom: 0; height: 14px; } .x span { transform: translateX(-50%); }
.now { position: absolute; top: -3px; bottom: -3px; width: 2px; margin-left: -1px; background: var(--ink); opacity: .6; pointer-events: none; }
.sheet { display: grid; grid-template-columns: repeat(auto-fill, minmax(200px, 1fr)); gap: 14px; list-style: none; margin: 0; padding: 0; }
.sheet a { display: block; color: inherit; text-decoration: none; border-radius: 8px; }
.sheet img { display: block; width: 100%; border-radius: 8px; background: #0c0d10; }
.sheet .none { display: grid; place-items: center; border-radius: 8px; background: var(--card); border: 1px dashed var(--warn);
  color: var(--warn); min-height: 80px; height: 100%; }
.sheet span { display: flex; justify-content: space-between; font-size: 14px; padding: 4px 2px 0; }
.sheet span i { font-style: normal; color: var(--soft); }
.sheet a:hover img, .sheet a.current img { box-shadow: 0 0 0 3px var(--accent); }
details { margin-top: 14px; } summary { cursor: pointer; padding: 12px 16px; font-weight: 600; }
pre { margin: 0; padding: 0 16px 16px; overflow-x: auto; font: 13px/1.5 ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; }
.wide { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(300px, 100%), 1fr)); column-gap: 28px; }
.wide div:first-child { border-top: 1px solid var(--line); }
footer { margin-top: 32px; color: var(--soft); font-size: 13px; }
@media (max-width: 860px) { .top, .charts { grid-template-columns: minmax(0, 1fr); } }
@media (max-width: 520px) { main { padding: 18px 14px 36px; } header p { font-size: 16px; }
  .sheet { grid-template-columns: 1fr 1fr; gap: 10px; } .plot { padding-left: 46px; } .x { left: 46px; } .y { width: 40px; }
  .keys { display: none !important; } .where { margin-left: 0; flex: 1 1 100%; order: -1; } }
@media print { .controls, .keys { display: none !important; } }
)css";

}  // namespace lagomorph::apps
