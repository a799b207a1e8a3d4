#include "app/report/page_style.h"

namespace billet::report {

const std::string_view page_style = R"css(
:root {
  color-scheme: light dark;
  --paper: #ffffff; --panel: #f5f6f8; --ink: #1b2430; --soft: #5b6675; --rule: #d9dee5;
  --accent: #1f5fa8; --good: #1d7a46; --bad: #b3261e; --warn: #9a6300; --busy: #1f5fa8;
  --c1: #1f77b4; --c2: #d1495b; --c3: #2e8b57; --c4: #b8860b; --c5: #7b4fa3; --c6: #4a5568;
}
@media (prefers-color-scheme: dark) {
  :root {
    --paper: #14181d; --panel: #1d232b; --ink: #e4e8ee; --soft: #9aa5b3; --rule: #343d48;
    --accent: #7db3ee; --good: #5cc48a; --bad: #ff8a80; --warn: #e6b450; --busy: #7db3ee;
    --c1: #5aa9e6; --c2: #ff7f8e; --c3: #5fd08c; --c4: #e3b341; --c5: #b794f4; --c6: #a0aec0;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; }
header, main { max-width: 1240px; margin: 0 auto; padding: 0 24px; }
header { padding-top: 24px; }
h1 { font-size: 26px; margin: 0 0 12px; }
h2 { font-size: 19px; margin: 36px 0 12px; padding-bottom: 4px; border-bottom: 1px solid var(--rule); }
h3 { font-size: 15px; margin: 0 0 6px; }
p { margin: 4px 0; }
small { color: var(--soft); font-weight: normal; }
code, pre { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 13px; }
pre { background: var(--panel); padding: 12px; border-radius: 6px; overflow: auto; max-height: 480px;
  white-space: pre-wrap; overflow-wrap: anywhere; }
ul { margin: 4px 0; padding-left: 20px; }
li { overflow-wrap: anywhere; }
.verdict { border-left: 5px solid var(--soft); background: var(--panel); padding: 10px 16px;
  border-radius: 0 6px 6px 0; margin-bottom: 12px; }
.verdict strong { font-size: 17px; }
.verdict.good { border-color: var(--good); } .verdict.good strong { color: var(--good); }
.verdict.bad { border-color: var(--bad); } .verdict.bad strong { color: var(--bad); }
.verdict.busy { border-color: var(--busy); } .verdict.busy strong { color: var(--busy); }
.callout { border: 1px solid var(--rule); border-left: 5px solid var(--soft); padding: 8px 16px;
  border-radius: 6px; margin: 10px 0; }
.callout.bad { border-left-color: var(--bad); } .callout.warn { border-left-color: var(--warn); }
.callout.note { border-left-color: var(--accent); }
.tiles { display: flex; flex-wrap: wrap; gap: 10px; margin: 14px 0; }
.tile { flex: 1 1 150px; background: var(--panel); border-radius: 8px; padding: 10px 14px; }
.tile b { font-size: 20px; } .tile small { display: block; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
table.figures { width: 100%; margin: 6px 0 14px; }
.figures th { text-align: right; font-weight: 600; vertical-align: bottom; padding: 4px 10px;
  border-bottom: 2px solid var(--rule); }
.figures td { text-align: right; padding: 3px 10px; border-bottom: 1px solid var(--rule); }
.figures th:first-child, .figures td:first-child { text-align: left; padding-left: 0; }
.facts th { text-align: left; font-weight: normal; color: var(--soft); padding: 2px 20px 2px 0;
  vertical-align: top; white-space: nowrap; }
.facts td { padding: 2px 0; overflow-wrap: anywhere; }
.columns { display: flex; flex-wrap: wrap; gap: 12px 48px; align-items: flex-start; }
.columns > .wide { flex: 1 1 420px; }
.bar { display: block; height: 10px; background: var(--c1); border-radius: 2px; min-width: 1px; }
.effort td:last-child, #effort .figures td:last-child { width: 40%; }
details { margin: 10px 0; } summary { cursor: pointer; color: var(--accent); }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(480px, 1fr)); gap: 18px; }
figure.chart { margin: 0; padding: 12px; background: var(--panel); border-radius: 8px; min-width: 0; }
figure.chart svg { width: 100%; height: auto; }
svg text { fill: var(--soft); font-size: 12px; }
svg .grid { stroke: var(--rule); stroke-width: 1; }
svg polyline { fill: none; stroke-width: 1.8; stroke-linejoin: round; }
figcaption { font-size: 13px; color: var(--soft); }
.key { margin-right: 14px; white-space: nowrap; }
.key i { display: inline-block; width: 18px; height: 3px; margin-right: 6px; vertical-align: middle; }
.missing, .notes { color: var(--soft); font-size: 13px; }
main { padding-bottom: 48px; }
@media (max-width: 560px) { .charts { grid-template-columns: 1fr; } }
@media print {
  :root { --paper: #fff; --panel: #fff; --ink: #000; --soft: #444; --rule: #bbb;
    --c1: #1f77b4; --c2: #d1495b; --c3: #2e8b57; --c4: #b8860b; --c5: #7b4fa3; --c6: #4a5568; }
  body { font-size: 11px; }
  header, main { max-width: none; padding: 0; }
  figure.chart, .tile, .callout, tr { break-inside: avoid; }
  h2 { break-after: avoid; }
  pre { max-height: none; }
}
)css";

} // namespace billet::report
