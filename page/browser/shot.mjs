// Pictures of the page: node shot.mjs OUT [hash] [width] [height] [dark] [seconds]
import { chromium } from "playwright-core";
import { pathToFileURL } from "node:url";
import { resolve } from "node:path";
const [out, hash = "", width = "1280", height = "900", scheme = "light", seconds = "2.5"] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"] });
const page = await browser.newPage({ viewport: { width: +width, height: +height }, colorScheme: scheme, deviceScaleFactor: +width < 500 ? 2 : 1 });
page.on("console", (m) => console.log("console", m.type(), m.text()));
page.on("pageerror", (e) => console.log("error", e.message));
await page.goto(pathToFileURL(resolve(import.meta.dirname, "../dist/coadjoint.html")) + hash);
await page.waitForTimeout(+seconds * 1000);
console.log(await page.evaluate(() => JSON.stringify({ first: window.page?.firstPicture ?? (typeof page !== "undefined" ? page.firstPicture : null), url: location.href.slice(-200), draw: page.drawTime, frame: page.frameTimes.slice(-60).reduce((a, b) => a + b, 0) / 60 })));
await page.screenshot({ path: out, fullPage: true });
await browser.close();
