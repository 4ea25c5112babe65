import { chromium } from "playwright-core";
import { pathToFileURL } from "node:url";
import { resolve } from "node:path";
const scheme = process.argv[2] ?? "light";
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"] });
const p = await browser.newPage({ viewport: { width: 1000, height: 700 }, colorScheme: scheme });
p.on("console", (m) => console.log("console", m.type(), m.text()));
p.on("pageerror", (e) => console.log("error", e.message, e.stack));
await p.goto(pathToFileURL(resolve(import.meta.dirname, "../dist/coadjoint.html")).href);
await p.waitForTimeout(900);
const ids = await p.evaluate(() => gallery.map((e) => e.id));
for (const id of ids) {
  const t = await p.evaluate((id) => { const a = performance.now(); choose(id); return performance.now() - a; }, id);
  await p.waitForTimeout(2500);
  const info = await p.evaluate(() => JSON.stringify({ draw: page.drawTime, m: about.substeps, dim: about.dim, most: [...session.most()].map((x) => x.toExponential(1)), ref: byId("refusal").hidden ? "" : byId("refusal").textContent, mist: byId("general").textContent }));
  console.log(id, "build ms", t.toFixed(0), info);
  await p.locator("#stage").screenshot({ path: `/tmp/c_${id}.png` });
}
await browser.close();
