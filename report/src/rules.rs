//! The rules that lay the page out: desktop, phone, paper, light and dark.

/// The rules of the page, besides those of its pictures.
pub const RULES: &str = "\
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,\"Segoe UI\",sans-serif}
main,header{max-width:1180px;margin:0 auto;padding:0 20px}
h1{font-size:1.9rem;line-height:1.2;margin:1.2em 0 .3em}
h2{font-size:1.5rem;margin:2.2em 0 .2em;padding-top:.5em;border-top:2px solid var(--grid)}
h3{font-size:1.2rem;margin:1.8em 0 .3em}
p,dl,ul{max-width:78ch}
a{color:var(--s0)}
.settings{color:var(--faint);font-size:.9rem;margin:.1em 0 .6em}
.settings span{display:inline-block;max-width:100%}
sup,sub{line-height:0;font-size:.75em}
dl{display:grid;grid-template-columns:9em 1fr;gap:.25em 1em;margin:.6em 0}
dt{font-weight:600;color:var(--faint)}
dd{margin:0}
.panels{display:grid;grid-template-columns:repeat(2,minmax(0,500px));gap:18px 24px;margin:1em 0;align-items:end}
.panels.three{grid-template-columns:repeat(3,minmax(0,1fr))}
.panels svg{width:100%;height:auto}
.verdicts{list-style:none;padding:0;margin:.6em 0}
.verdicts li{padding:.35em .7em;margin:.3em 0;border-left:5px solid var(--pass);background:var(--soft)}
.verdicts li.fails{border-left-color:var(--fail)}
.mark{font-size:.8rem;font-weight:700;letter-spacing:.03em;padding:.1em .5em;border:1.5px solid currentColor;\
border-radius:3px;color:var(--pass);white-space:nowrap}
.mark.fails{color:var(--fail)}
.number{font-weight:700}
.scroll{overflow-x:auto;margin:.8em 0}
table{border-collapse:collapse;font-size:.86rem}
caption{text-align:left;font-weight:600;padding:.3em 0;max-width:min(78ch,92vw)}
tbody th{min-width:9em}
th,td{padding:.22em .8em .22em 0;text-align:left;border-bottom:1px solid var(--grid);vertical-align:top}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
details{margin:.6em 0}
summary{cursor:pointer;color:var(--faint)}
nav ol{columns:2;column-gap:3em;max-width:1000px;padding-left:2em}
nav li{break-inside:avoid;margin:.15em 0}
footer{color:var(--faint);margin:3em 0 2em;font-size:.9rem}
:root{--pass:#1a6e34;--fail:#b3261e;--soft:#f4f6f8}
@media screen and (prefers-color-scheme:dark){:root{--pass:#5fd07f;--fail:#ff8a80;--soft:#181e25}}
@media (max-width:1000px){.panels.three{grid-template-columns:repeat(2,minmax(0,1fr))}}
@media (max-width:720px){main,header{padding:0 14px}.panels,.panels.three{grid-template-columns:minmax(0,1fr)}\
dl{grid-template-columns:1fr;gap:0}dd{margin-bottom:.5em}nav ol{columns:1}h1{font-size:1.5rem}}
@media print{body{font-size:10.5pt}main,header{max-width:none;padding:0}nav{display:none}\
.panels,.panels.three{grid-template-columns:repeat(2,minmax(0,1fr))}\
svg,.verdicts li,tr,.exhibit h3{break-inside:avoid}h2,h3{break-after:avoid}.scroll{overflow:visible}\
details::details-content{content-visibility:visible;display:block}table{font-size:8pt}a{color:inherit;text-decoration:none}}
";
