// Style of the pages: classes of the drawings, then the page around them. Plain CSS, light and dark by the
// reader's setting, paper always light. The five spectral lines differ in dash as well as in colour.
#pragma once

#include <string_view>

namespace petzval::lens_sheet {

inline constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --paper: #fbfaf6; --ink: #211f1b; --quiet: #6a655b; --rule: #d8d2c4;
  --field: #ffffff; --grid: #ebe6da; --axis: #a49c8b; --glass: #d3e6f0; --flint: #b9cfe0; --edge: #46718c;
  --accent: #9a3b1a; --second: #1f6f8b; --third: #6b4c9a; --bar: #7a9cb0; --sum: #9a3b1a;
  --g: #7a3fc4; --F: #1c6fd0; --e: #1d8a3e; --d: #a87400; --C: #cc2a1e; }
@media (prefers-color-scheme: dark) { :root { --paper: #15161a; --ink: #ebe8e0; --quiet: #a29d92;
  --rule: #373840; --field: #1c1e24; --grid: #2b2d35; --axis: #6d6a63; --glass: #22404f; --flint: #34506b;
  --edge: #86bcd8; --accent: #f0926a; --second: #6cc3de; --third: #b79be8; --bar: #5f8399; --sum: #f0926a;
  --g: #b18cf5; --F: #68abff; --e: #5fce80; --d: #eebc4a; --C: #ff7d70; } }
@media print { :root { --paper: #fff; --ink: #000; --quiet: #444; --rule: #bbb; --field: #fff; --grid: #e8e8e8;
  --axis: #888; --glass: #d3e6f0; --flint: #b9cfe0; --edge: #46718c; --accent: #9a3b1a; --second: #1f6f8b;
  --third: #6b4c9a; --bar: #7a9cb0; --sum: #9a3b1a; --g: #7a3fc4; --F: #1c6fd0; --e: #1d8a3e; --d: #a87400;
  --C: #cc2a1e; } }
svg { font-family: "Helvetica Neue", "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
svg path, svg line { fill: none; }
.paper { fill: var(--paper); }
.field { fill: var(--field); stroke: var(--rule); }
.night { fill: #000; }
.grid { stroke: var(--grid); }
.axis { stroke: var(--axis); }
.mark { stroke: var(--quiet); stroke-dasharray: 2 3; }
.tick { font-size: 10.5px; fill: var(--quiet); }
.label { font-size: 11.5px; fill: var(--quiet); }
.title { font-size: 12.5px; font-weight: 600; fill: var(--ink); }
.note { font-size: 10.5px; fill: var(--quiet); font-style: italic; }
.word { font-size: 12px; fill: var(--ink); }
.name { font-size: 13px; font-weight: 600; fill: var(--ink); }
.w-g, .w-F, .w-e, .w-d, .w-C { stroke-width: 1.8; stroke-linejoin: round; }
.w-g { stroke: var(--g); stroke-dasharray: 1.5 2.5; }
.w-F { stroke: var(--F); stroke-dasharray: 7 3; }
.w-e { stroke: var(--e); stroke-dasharray: 12 2.5 2 2.5; }
.w-d { stroke: var(--d); }
.w-C { stroke: var(--C); stroke-dasharray: 4 2; }
text.w-g, text.w-F, text.w-e, text.w-d, text.w-C { stroke: none; font-size: 11px; font-weight: 600; }
text.w-g { fill: var(--g); } text.w-F { fill: var(--F); } text.w-e { fill: var(--e); }
text.w-d { fill: var(--d); } text.w-C { fill: var(--C); }
.dot { stroke-dasharray: none; stroke-width: 2.1; stroke-linecap: round; }
svg path.glass { fill: var(--glass); stroke: var(--edge); stroke-width: 1.1; stroke-linejoin: round; }
svg path.flint { fill: var(--flint); }
svg path.ghost { fill: var(--glass); fill-opacity: .5; stroke: var(--edge); stroke-dasharray: 5 3; }
.stop { stroke: var(--ink); stroke-width: 3; }
.sensor { stroke: var(--ink); stroke-width: 2; }
.optical-axis { stroke: var(--axis); stroke-dasharray: 12 3 2 3; }
.ray0, .ray1, .ray2 { stroke-width: 1; stroke-opacity: .85; }
.ray0 { stroke: var(--accent); } .ray1 { stroke: var(--second); } .ray2 { stroke: var(--third); }
text.ray0, text.ray1, text.ray2 { stroke: none; font-size: 11.5px; }
text.ray0 { fill: var(--accent); } text.ray1 { fill: var(--second); } text.ray2 { fill: var(--third); }
.bold { stroke-width: 2; stroke-opacity: 1; } .broken { stroke-dasharray: 6 3; }
.curve0, .curve1, .curve2 { stroke-width: 1.9; stroke-linejoin: round; }
.curve0 { stroke: var(--accent); } .curve1 { stroke: var(--second); stroke-dasharray: 7 3; }
.curve2 { stroke: var(--third); stroke-dasharray: 2 3; }
svg path.wash { fill: var(--second); fill-opacity: .14; }
.bar { fill: var(--bar); } .sum { fill: var(--sum); }
.ring { fill: none; stroke: var(--quiet); stroke-dasharray: 3 2; }
.rim { stroke: #000; stroke-width: 4; }
.ring-on-night { fill: none; stroke: #ffae1a; stroke-dasharray: 3 2; }
.on-night { font-size: 10.5px; fill: #d8d4ca; }
.line-on-night { stroke: #8d897f; stroke-opacity: .55; }
.light { isolation: isolate; } .light path { mix-blend-mode: screen; }
.object { stroke: var(--ink); stroke-width: 2.2; }
.dashed { stroke: var(--quiet); stroke-dasharray: 4 3; }
)css";

inline constexpr std::string_view kPageStyle = R"css(
* { box-sizing: border-box; }
html { background: var(--paper); color: var(--ink); }
body { max-width: 1180px; margin: 0 auto; padding: 40px 36px 60px; line-height: 1.55; font-size: 16.5px;
  font-family: "Iowan Old Style", "Palatino Linotype", Palatino, Georgia, "DejaVu Serif", serif; }
h1 { font-size: 2.5rem; line-height: 1.12; font-weight: 500; margin: 0 0 .25em; letter-spacing: -.01em; }
h2 { font-size: 1.5rem; font-weight: 500; margin: 2.6em 0 .3em; padding-top: .7em;
  border-top: 1px solid var(--rule); }
a { color: var(--accent); text-decoration-thickness: 1px; text-underline-offset: 2px; }
p { margin: .5em 0; } .lead { max-width: 46em; margin: .2em 0 1.1em; }
.kicker { font: 600 .78rem/1.4 "Helvetica Neue", "Segoe UI", Roboto, "DejaVu Sans", sans-serif; color: var(--accent);
  letter-spacing: .08em; text-transform: uppercase; margin: 0 0 .7em; }
.quiet, figcaption, footer, .source { color: var(--quiet); }
.source { font-size: .84rem; line-height: 1.45; overflow-wrap: anywhere; }
.history { font-size: 1.12rem; max-width: 42em; }
nav { margin: 1.6em 0 0; font: .86rem/2 "Helvetica Neue", "Segoe UI", Roboto, "DejaVu Sans", sans-serif; }
nav a { margin-right: 1.1em; text-decoration: none; white-space: nowrap; }
.head { display: grid; grid-template-columns: minmax(0, 7fr) minmax(0, 5fr); gap: 2.2em; align-items: start; }
.facts { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: .9em 1.2em; margin: 1.3em 0 .4em; }
.facts div { border-top: 1px solid var(--rule); padding-top: .4em; }
.facts b { display: block; font-weight: 500; font-size: 1.28rem; font-variant-numeric: tabular-nums; }
.facts span { font: .76rem/1.3 "Helvetica Neue", "Segoe UI", Roboto, "DejaVu Sans", sans-serif; color: var(--quiet); }
.figures { display: grid; grid-template-columns: repeat(12, minmax(0, 1fr)); gap: 1.5em 1.4em; align-items: start; }
figure { margin: 0; grid-column: span var(--share); break-inside: avoid; min-width: 0; }
figure svg { display: block; width: 100%; height: auto; }
figcaption { font-size: .9rem; line-height: 1.48; margin-top: .55em; max-width: 54em; }
figcaption b, .lead b { color: var(--ink); font-weight: 600; }
table { border-collapse: collapse; width: 100%; font: .84rem/1.5 "Helvetica Neue", "Segoe UI", Roboto, "DejaVu Sans",
  sans-serif; font-variant-numeric: tabular-nums; }
th { font-weight: 600; text-align: right; color: var(--quiet); border-bottom: 1px solid var(--rule); padding: .25em .5em; }
td { text-align: right; border-bottom: 1px solid var(--grid); padding: .22em .5em; }
th:first-child, td:first-child { text-align: left; padding-left: 0; }
tr.total td { font-weight: 600; border-top: 1px solid var(--axis); }
.words td { text-align: left; vertical-align: top; } .words td:first-child { color: var(--quiet); width: 44%; }
.cards { display: grid; grid-template-columns: repeat(auto-fill, minmax(205px, 1fr)); gap: 1.5em 1.2em; margin: 1.4em 0; }
.cards a { color: inherit; text-decoration: none; display: block; }
.cards svg { width: 100%; height: auto; display: block; }
.cards b { display: block; margin-top: .35em; font-weight: 600; }
.cards span { display: block; font-size: .82rem; line-height: 1.35; color: var(--quiet); }
.scroll { overflow-x: auto; }
.sheet td { vertical-align: middle; text-align: left; padding: .5em .6em .5em 0; } .sheet th { text-align: left; padding-left: 0; }
.sheet svg { display: block; }
footer { margin-top: 4em; padding-top: 1em; border-top: 1px solid var(--rule); font-size: .84rem; }
code { font-size: .86em; }
@media screen and (max-width: 780px) { body { padding: 22px 16px; } .head { display: block; } figure { grid-column: 1 / -1; }
  .facts { grid-template-columns: repeat(2, minmax(0, 1fr)); } }
@media print { body { max-width: none; padding: 0; font-size: 9.5pt; line-height: 1.4; } h1 { font-size: 20pt; }
  h2 { margin-top: 1.2em; font-size: 13pt; } figcaption { font-size: 8.5pt; } .figures { gap: .9em .9em; }
  table { font-size: 7.5pt; } nav { display: none; } h2 { break-after: avoid; }
  svg { print-color-adjust: exact; -webkit-print-color-adjust: exact; } @page { margin: 14mm; } }
)css";

}  // namespace petzval::lens_sheet
