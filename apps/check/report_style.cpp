#include "apps/check/report_html.h"

namespace lagomorph::apps {

const std::string_view report_style = R"css(
.bad { color: #c8321f; } @media (prefers-color-scheme: dark) { .bad { color: #ff8672; } }
.why { border-left: 6px solid #c8321f; padding: 12px 18px; margin: 0 0 14px; overflow-wrap: anywhere; }
.why h2 { margin: 0; } .why ul { margin: 6px 0 0; padding-left: 20px; } .why p { margin: 6px 0 0; }
.why li b { background: var(--bg); border-radius: 6px; padding: 1px 7px; margin-right: 4px; }
.verdict { font-size: 18px; margin: 0 0 8px; overflow-wrap: anywhere; }
.frame { padding: 14px 16px; margin: 0 0 16px; overflow-wrap: anywhere; } .frame h3 { margin: 0 0 6px; font-size: 17px; }
.frame h3 i { font-weight: 400; font-style: normal; color: var(--soft); font-size: 14px; }
.rules { margin: 0 0 10px; padding-left: 20px; } .rules i { font-style: normal; color: var(--soft); }
.rules .hint { color: var(--warn); }
.triple { display: grid; grid-template-columns: repeat(3, minmax(0, 1fr)); gap: 8px; }
.triple figure { margin: 0; } .triple figcaption { font-size: 13px; color: var(--soft); }
.triple img { display: block; width: 100%; border-radius: 6px; background: #0c0d10; }
.note { margin: 4px 0 0; font-size: 13px; color: var(--soft); }
.commands { padding: 8px 0 0; } .commands div { padding: 3px 0; border: 0; display: grid; grid-template-columns: 170px minmax(0, 1fr); }
code { font: 13px ui-monospace, Menlo, Consolas, "DejaVu Sans Mono", monospace; user-select: all; }
.small { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(460px, 100%), 1fr)); gap: 14px; }
.small .frame { margin: 0; } .small .commands div { grid-template-columns: minmax(0, 1fr); }
.curve { margin-top: 30px; } .curve .area { height: 150px; }
#viewer .bar { display: flex; flex-wrap: wrap; gap: 8px; padding: 10px 14px; align-items: center; }
#viewer button, #viewer select { font: inherit; color: inherit; background: var(--bg); border: 1px solid var(--line);
  border-radius: 8px; min-width: 42px; height: 38px; padding: 0 10px; cursor: pointer; }
#viewer button.on { background: var(--accent); border-color: var(--accent); color: #fff; }
#where { margin-left: auto; font-weight: 600; }
.panes { display: flex; gap: 4px; background: #0c0d10; } .panes canvas { flex: 1 1 0; min-width: 0; width: 100%; touch-action: none;
  cursor: crosshair; } .panes canvas[hidden] { display: none; }
#what, #values { display: block; margin: 6px 14px 0; font-size: 14px; min-height: 1.5em; } #what { color: var(--soft); }
#scrub { display: block; width: calc(100% - 28px); margin: 0 14px 14px; height: 22px; accent-color: var(--accent); }
@media (max-width: 860px) { .frame > .triple { grid-template-columns: minmax(0, 1fr); }
  .small .frame > .triple { grid-template-columns: repeat(3, minmax(0, 1fr)); }
  .commands div { grid-template-columns: minmax(0, 1fr); } #where { margin-left: 0; flex: 1 1 100%; } }
)css";

}  // namespace lagomorph::apps
