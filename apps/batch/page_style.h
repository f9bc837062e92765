// How the page of a batch looks: light and dark, wide and narrow.
#pragma once

namespace folprom::batch {

inline constexpr const char* kPageStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #f4f5f7; --card: #ffffff; --text: #1b2027; --muted: #5c6675; --line: #dfe3e8;
  --good: #17703c; --good-back: #e0f3e7; --bad: #a8201a; --bad-back: #fde7e5;
  --wait: #7a5200; --wait-back: #fdf0d5; --accent: #1d5fb4;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #12151a; --card: #1b2027; --text: #e6e9ee; --muted: #9aa5b4; --line: #323a45;
    --good: #7fd8a0; --good-back: #16331f; --bad: #ff9a92; --bad-back: #431c1a;
    --wait: #f0c777; --wait-back: #3a2d10; --accent: #7db2f5;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", "Liberation Sans", Helvetica, Arial, sans-serif; }
main { max-width: 1240px; margin: 0 auto; padding: 24px 20px 64px; }
h1 { font-size: 26px; line-height: 1.25; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 19px; margin: 32px 0 12px; }
h3 { font-size: 17px; margin: 0; overflow-wrap: anywhere; }
p { margin: 0; }
a { color: var(--accent); }
.muted { color: var(--muted); overflow-wrap: anywhere; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 12px;
  margin: 20px 0 0; padding: 0; }
.figures div { background: var(--card); border: 1px solid var(--line); border-radius: 10px;
  padding: 12px 14px; }
.figures dt { color: var(--muted); font-size: 13px; }
.figures dd { margin: 2px 0 0; font-size: 20px; font-weight: 600; font-variant-numeric: tabular-nums; }
.errors { background: var(--bad-back); color: var(--bad); border-radius: 10px; padding: 12px 16px;
  margin-top: 20px; }
.errors ul { margin: 6px 0 0; padding-left: 20px; }
.errors li { overflow-wrap: anywhere; white-space: pre-line; }
.errors a { color: inherit; font-weight: 600; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 10px; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: right; padding: 7px 12px; border-bottom: 1px solid var(--line);
  vertical-align: top; white-space: nowrap; }
th { color: var(--muted); font-weight: 500; font-size: 13px; vertical-align: bottom; }
th:first-child, td:first-child, td.text, th.text { text-align: left; white-space: normal;
  overflow-wrap: anywhere; }
tr:last-child td { border-bottom: 0; }
td.error { color: var(--bad); white-space: pre-line; }
.state { display: inline-block; border-radius: 999px; padding: 0 9px; font-size: 13px;
  white-space: nowrap; }
.good { color: var(--good); background: var(--good-back); }
.bad { color: var(--bad); background: var(--bad-back); }
.wait { color: var(--wait); background: var(--wait-back); }
.scan { margin-top: 18px; padding: 16px 18px; scroll-margin-top: 12px; }
.scan header { display: flex; gap: 10px; align-items: baseline; flex-wrap: wrap; }
.pictures { display: grid; grid-template-columns: repeat(4, minmax(0, 1fr)); gap: 14px;
  margin: 12px 0 0; }
figure { margin: 0; }
figure img { display: block; width: 100%; height: auto; }
figcaption { font-size: 13px; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
figcaption b { font-weight: 600; }
.missing { aspect-ratio: 5 / 4; display: flex; align-items: center; justify-content: center;
  text-align: center; padding: 8px; border: 1px dashed var(--line); border-radius: 8px;
  color: var(--muted); font-size: 13px; overflow: auto; overflow-wrap: anywhere; }
.operations { margin-top: 12px; font-size: 14px; }
.operations th, .operations td { padding: 5px 10px; }
.warnings { margin: 10px 0 0; padding-left: 20px; color: var(--wait); overflow-wrap: anywhere; }
.plots { display: grid; grid-template-columns: minmax(0, 3fr) minmax(0, 2fr); gap: 18px;
  margin-top: 16px; align-items: start; }
.plot svg { display: block; width: 100%; height: auto; font-family: inherit; fill: var(--text); }
.plot svg [fill="#ffffff"] { fill: var(--card); }
.plot svg [fill="#4b5563"] { fill: var(--muted); }
.plot svg [stroke="#e5e7eb"], .plot svg [stroke="#d1d5db"] { stroke: var(--line); }
.plot svg [stroke="#6b7280"] { stroke: var(--muted); }
.plot svg [stroke="#ffffff"] { stroke: var(--card); }
.plot svg [fill="#1d5fb4"] { fill: var(--accent); }
.plot svg [stroke="#1d5fb4"] { stroke: var(--accent); }
footer { margin-top: 32px; color: var(--muted); font-size: 13px; overflow-wrap: anywhere; }
@media (max-width: 860px) {
  main { padding: 16px 12px 48px; }
  .pictures { grid-template-columns: repeat(2, minmax(0, 1fr)); }
  .plots { grid-template-columns: minmax(0, 1fr); }
  .scan { padding: 14px 12px; }
  .plot { overflow-x: auto; }
  .plot svg { min-width: 560px; }
  thead { display: none; }
  table, tbody { display: block; }
  tr { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 2px 14px;
    padding: 10px 12px; border-bottom: 1px solid var(--line); }
  tr:last-child { border-bottom: 0; }
  td, td:first-child, td.text { display: block; border: 0; padding: 0; text-align: left;
    white-space: normal; overflow-wrap: anywhere; }
  .operations td { padding: 0; }
  .operations tr { padding: 8px 0; }
  td[data-label]::before { content: attr(data-label); display: block; color: var(--muted);
    font-size: 12px; }
  td.text[data-label]::before { margin-bottom: 2px; }
  td:first-child, td.error { grid-column: 1 / -1; font-weight: 600; }
  td:first-child::before { display: none !important; }
  td.empty { display: none; }
}
@media print { body { background: none; } .card { break-inside: avoid; } }
)css";

}  // namespace folprom::batch
