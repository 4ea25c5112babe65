// Pictures of the page: node shot.mjs OUT [LINK] [WIDTH] [HEIGHT] [light|dark] [SECONDS]; a height of 0 is the whole page.
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [out, link = "", width = "1280", height = "0", scheme = "light", seconds = "3"] = process.argv.slice(2);
if (!out) throw new Error("name the file to write");
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
});
const tab = await browser.newPage({
  viewport: { width: +width, height: +height || 900 },
  colorScheme: scheme,
  deviceScaleFactor: +width < 500 ? 2 : 1,
});
tab.on("console", (message) => console.log(`${message.type()}: ${message.text()}`));
await tab.goto(pathToFileURL(resolve(import.meta.dirname, "../dist/coadjoint.html")).href + link);
await tab.waitForTimeout(1000 * seconds);
await tab.screenshot({ path: out, fullPage: height === "0" });
await browser.close();
