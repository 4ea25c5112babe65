// The page in a real browser, from disk: every control, a typed system, a mistake, a refused step, a link and back, the
// numbers of the command, contrast and names for screen readers; and pictures to look at, in `pictures`.
//
// COADJOINT may name the command: its figures are then compared with the page's, and it reads the copied file.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const here = import.meta.dirname;
const url = pathToFileURL(resolve(here, "../dist/coadjoint.html")).href;
const axe = readFileSync(join(here, "node_modules/axe-core/axe.min.js"), "utf8");
const pictures = join(here, "pictures");
mkdirSync(pictures, { recursive: true });

let browser;
before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking"],
  });
});
after(() => browser.close());

// A page that fails the test with anything it has to say to the console, and that may load nothing.
async function open(hash = "", options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const tab = await context.newPage();
  const said = [];
  tab.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
  tab.on("pageerror", (error) => said.push(`error: ${error.stack}`));
  tab.on("request", (request) => {
    if (!request.url().startsWith("file:") && !request.url().startsWith("data:")) said.push(`request: ${request.url()}`);
  });
  await tab.goto(url + hash);
  await tab.waitForFunction(() => page.firstPicture > 0 || !document.getElementById("general").matches(":empty"));
  return {
    tab,
    said,
    async done() {
      await context.close();
      assert.deepEqual(said, []);
    },
  };
}

// A test on a page that `open` opens with these arguments.
function onPage(name, given, body) {
  test(name, async () => {
    const { tab, done } = await open(...given);
    await body(tab);
    await done();
  });
}

const text = (tab, id) => tab.locator(`#${id}`).textContent();
const state = (tab) => tab.evaluate(() => JSON.parse(JSON.stringify(page.state)));
const frames = (tab, count = 3) => tab.evaluate((count) => new Promise((done) => {
  const next = () => (count-- > 0 ? requestAnimationFrame(next) : done());
  next();
}), count);

onPage("opens from disk, moves, and says nothing to the console", [], async (tab) => {
  assert.equal(await text(tab, "play"), "Pause");
  await tab.waitForFunction(() => page.session().steps() > 10);
  const before = await tab.evaluate(() => page.session().steps());
  await tab.waitForTimeout(2500);
  const [after, first, draw, frame] = await tab.evaluate(() => {
    const middle = (list) => [...list].sort((a, b) => a - b)[list.length >> 1];
    return [page.session().steps(), page.firstPicture, page.drawTime, middle(page.frameTimes)];
  });
  assert.ok(after > before);
  const size = readFileSync(new URL(url)).length;
  console.log(`first picture after ${first.toFixed(0)} ms, ${(size / 1000).toFixed(0)} kB; a frame every ${frame.toFixed(1)} ms, of which drawing ${draw.toFixed(1)} ms`);
  assert.ok(size < 3_000_000);
});

onPage("every system of the gallery can be chosen and runs", [], async (tab) => {
  const ids = await tab.locator("#gallery option").evaluateAll((list) => list.map((option) => option.value));
  assert.ok(ids.length >= 27);
  for (const id of ids) {
    await tab.selectOption("#gallery", id);
    await tab.waitForFunction(() => page.session().steps() > 3);
    assert.equal(await tab.locator("#refusal").isVisible(), false, id);
    assert.equal(await tab.locator(".mistake").count(), 0, id);
    await frames(tab);
  }
});

onPage("every control does what it says", ["#system=rigid-body&paused=1"], async (tab) => {
  const steps = () => tab.evaluate(() => page.session().steps());
  assert.equal(await text(tab, "play"), "Play");
  await tab.click("#single");
  await tab.click("#single");
  assert.equal(await steps(), 2);
  await tab.click("#play");
  await tab.waitForFunction(() => page.session().steps() > 5);
  await tab.click("#play");
  const at = await steps();
  await frames(tab, 10);
  assert.equal(await steps(), at);
  await tab.click("#again");
  assert.equal(await steps(), 0);
  await tab.locator("#speed").fill("75");
  assert.equal(await text(tab, "speed-text"), "1000 steps/s");
  const about = () => tab.evaluate(() => page.about());
  await tab.selectOption("#truncation", "3");
  assert.equal((await about()).order, 4);
  await tab.selectOption("#chart", "cayley");
  assert.equal((await about()).chart, "cayley");
  await tab.selectOption("#frame", "comoving");
  assert.equal((await about()).comoving, true);
  await tab.locator("#step-slider").fill("30");
  assert.equal((await about()).step, 0.2);
  await tab.fill("#step", "1/20");
  await tab.waitForFunction(() => page.about().step === 0.05);
  await tab.fill("#momentum", "0, 1, 2");
  await tab.waitForFunction(() => page.about().momentum.join() === "0,1,2");
  await tab.fill("#name", "my body");
  await tab.fill("#time", "12");
  await tab.fill("#parameters", "I1 = 1, I2 = 2, I3 = 3");
  await tab.waitForFunction(() => page.about().inverse_inertia[8] === 1 / 3);
  await tab.click("#knobs summary");
  await tab.locator("#knob-I2").fill("-50");
  assert.equal(await tab.inputValue("#parameters"), "I1 = 1, I2 = 1, I3 = 3");
  assert.equal((await about()).inverse_inertia[4], 1);
  await tab.click("#tab-file");
  assert.ok((await text(tab, "text")).includes("name = \"my body\""));
  await tab.evaluate(() => { navigator.clipboard.writeText = async (text) => { window.copied = text; }; });
  await tab.click("#copy");
  assert.equal(await tab.evaluate(() => window.copied), await text(tab, "text"));
  await tab.focus("#tab-file");
  await tab.keyboard.press("ArrowRight");
  assert.equal(await tab.locator("#tab-formulas").getAttribute("aria-selected"), "true");
  assert.ok((await tab.locator("#text math").count()) > 5);
  await tab.click("#link");
  assert.ok((await tab.evaluate(() => window.copied)).startsWith(url + "#"));
  await tab.selectOption("#gallery", "manakov-so4");
  await tab.selectOption("#axis-1", "5");
  assert.deepEqual((await state(tab)).axes, [0, 5, 2]);
});

onPage("the momentum at the start is dragged over its sphere, by hand and by keys", ["#system=rigid-body&paused=1"], async (tab) => {
  const canvas = tab.locator("#orbit");
  const box = await canvas.boundingBox();
  const place = await tab.evaluate(() => orbitFrame(orbitCanvas, about, start).place(start));
  const before = await tab.evaluate(() => [...start]);
  await tab.mouse.move(box.x + place[0], box.y + place[1]);
  await tab.mouse.down();
  await tab.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 6 });
  await tab.mouse.up();
  const now = await tab.evaluate(() => [...start]);
  assert.notDeepEqual(now, before);
  assert.ok(Math.abs(Math.hypot(...now) - Math.hypot(...before)) < 1e-4, "it stays on its sphere");
  const eye = await tab.evaluate(() => camera(state.view)[2]);
  const along = now.reduce((sum, x, i) => sum + x * eye[i], 0) / Math.hypot(...now);
  assert.ok(along > 0.99, "it is under the pointer");
  assert.equal(await tab.inputValue("#momentum"), now.join(" "));
  await canvas.focus();
  await tab.keyboard.press("ArrowLeft");
  assert.notDeepEqual(await tab.evaluate(() => [...start]), now);
  const view = (await state(tab)).view;
  await tab.keyboard.press("Shift+ArrowLeft");
  assert.notDeepEqual((await state(tab)).view, view);
  // Elsewhere the view is turned.
  await tab.mouse.move(box.x + 30, box.y + 30);
  await tab.mouse.down();
  await tab.mouse.move(box.x + 90, box.y + 50, { steps: 4 });
  await tab.mouse.up();
  assert.notDeepEqual((await state(tab)).view, view);
});

onPage("on a phone a finger drags the ring, and scrolls elsewhere", ["#system=rigid-body&paused=1", { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true }], async (tab) => {
  await tab.locator("#orbit").scrollIntoViewIfNeeded();
  const client = await tab.context().newCDPSession(tab);
  const touch = (type, points) => client.send("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y]) => ({ x, y })) });
  const drag = async (from, to) => {
    await touch("touchStart", [from]);
    for (let i = 1; i <= 8; i++) await touch("touchMove", [[from[0] + ((to[0] - from[0]) * i) / 8, from[1] + ((to[1] - from[1]) * i) / 8]]);
    await touch("touchEnd", []);
    await frames(tab, 5);
  };
  const box = await tab.locator("#orbit").boundingBox();
  const ring = await tab.evaluate(() => orbitFrame(orbitCanvas, about, start).place(start));
  const [before, scrolled] = await tab.evaluate(() => [[...start], scrollY]);
  const at = [box.x + ring[0], box.y + ring[1]];
  await drag(at, [at[0], at[1] - 90]);
  const now = await tab.evaluate(() => [...start]);
  assert.notDeepEqual(now, before);
  assert.equal(await tab.evaluate(() => scrollY), scrolled);
  await drag([box.x + 20, box.y + box.height - 20], [box.x + 20, box.y + box.height - 220]);
  assert.notEqual(await tab.evaluate(() => scrollY), scrolled);
  assert.deepEqual(await tab.evaluate(() => [...start]), now);
});

onPage("a system of one's own is typed: a gyrostat with three wheels", [], async (tab) => {
  await tab.fill("#hamiltonian", "(x - a)^2/(2*I1) + (y - b)^2/(2*I2) + (z - c)^2/(2*I3)");
  await tab.fill("#parameters", "I1 = 3\nI2 = 4\nI3 = 5\na = 0.3\nb = -1/3\nc = 0.5");
  await tab.fill("#momentum", "1 2 3");
  await tab.waitForFunction(() => page.about().momentum.join() === "1,2,3" && page.session().steps() > 5);
  assert.equal(await tab.locator(".mistake").count(), 0);
  assert.equal(await text(tab, "about"), "A system of your own.");
  const expected = (0.7 ** 2) / 6 + ((2 + 1 / 3) ** 2) / 8 + (2.5 ** 2) / 10;
  assert.ok(Math.abs((await tab.evaluate(() => page.session().energy())) - expected) < 1e-9);
  // On another group, with brackets of its own.
  await tab.click("#own summary");
  await tab.fill("#algebra", 'generators = ["A", "B", "C"]\nbrackets = ["[A, B] = -C", "[B, C] = A", "[C, A] = B"]');
  await tab.fill("#hamiltonian", "x^2/2 + y^2/3 + z^2/5");
  await tab.waitForFunction(() => page.about().factors[0].kind === "matrix" && page.session().steps() > 5);
  assert.equal(await tab.locator(".mistake").count(), 0);
});

onPage("mistakes are shown at their places, and the last system stays", [], async (tab) => {
  const steps = await tab.evaluate(() => page.session().steps());
  await tab.fill("#hamiltonian", "x^2/(2*I1) + y^2/(2*I2) + zz^2/(2*I3)");
  await tab.waitForSelector("#hamiltonian-mistakes .mistake");
  const mistakes = tab.locator("#hamiltonian-mistakes .mistake");
  assert.match(await mistakes.textContent(), /unknown variable `zz`; did you mean/);
  assert.equal(await tab.locator("#hamiltonian-mistakes mark").textContent(), "zz");
  assert.equal(await tab.locator(".field:has(#hamiltonian) .marks mark").textContent(), "zz");
  assert.equal(await tab.locator("#hamiltonian").getAttribute("aria-invalid"), "true");
  assert.equal(await tab.locator("#hamiltonian").getAttribute("aria-describedby"), "hamiltonian-mistakes");
  assert.equal(await tab.locator("#stale").isVisible(), true);
  await tab.waitForFunction((steps) => page.session().steps() > steps, steps);
  await tab.waitForFunction(() => document.getElementById("summary").textContent.includes("1 mistake. Hamiltonian: unknown variable"));
  await tab.screenshot({ path: join(pictures, "mistake.png"), fullPage: true });
  // The mark lies on its letters.
  const [mark, area] = await Promise.all([tab.locator(".field:has(#hamiltonian) .marks mark").boundingBox(), tab.locator("#hamiltonian").boundingBox()]);
  assert.ok(mark.x > area.x && mark.y >= area.y && mark.y + mark.height <= area.y + area.height + 1);
  await tab.fill("#hamiltonian", "x^2/2 + y^2/(2*I2) + z^2/3");
  await tab.waitForFunction(() => !document.querySelector(".mistake"));
  assert.equal(await tab.locator("#hamiltonian").getAttribute("aria-invalid"), null);
  await tab.fill("#group", "SO4");
  await tab.waitForSelector("#coordinates-mistakes .mistake");
});

test("more than 24 dimensions move by the fixed point", async () => {
  const fields = new URLSearchParams({ hamiltonian: "sum(i, 0..9, z[i]^2 - x[i]*x[(i + 1) % 9])", group: "SO3^9", coordinates: "x y z", momentum: "cos(i) sin(i) 1", truncation: "3", step: "0.1", name: "ring" });
  const { tab, done } = await open("#" + fields);
  assert.equal(await text(tab, "general"), "");
  await tab.waitForFunction(() => page.session().steps() > 3);
  await done();
});

onPage("a refused step is told, with one that can be made", ["#system=rigid-body"], async (tab) => {
  await tab.fill("#step", "1.9");
  await tab.waitForSelector("#refusal:not([hidden])");
  assert.match(await text(tab, "refusal"), /was refused. Beyond the chart/);
  assert.equal(await text(tab, "play"), "Play");
  await tab.screenshot({ path: join(pictures, "refused.png"), fullPage: true });
  await tab.click("#usable");
  await tab.waitForFunction(() => page.about().step < 1.9 && page.session().steps() > 3);
  assert.equal(await tab.locator("#refusal").isVisible(), false);
});

onPage("a Hamiltonian that is no polynomial runs, and is refused outside its domain", ["#system=rigid-body&paused=1"], async (tab) => {
  await tab.fill("#hamiltonian", "z + x^(3/2)");
  await tab.fill("#momentum", "0.5 -1 1");
  await tab.waitForFunction(() => page.about().terms.length === 0 && page.about().momentum[0] === 0.5);
  assert.match(await text(tab, "cost"), /by collocation at 4 nodes/);
  assert.equal(await tab.locator("#text code").textContent(), "z + x^(3/2)");
  await tab.click("#play");
  await tab.waitForSelector("#refusal:not([hidden])");
  assert.match(await text(tab, "refusal"), /not defined at time .*: x\^\(3\/2\) of -/);
  await tab.screenshot({ path: join(pictures, "smooth.png"), fullPage: true });
});

test("a link holds the whole state", async () => {
  const first = await open("#system=heavy-top&paused=1");
  await first.tab.fill("#parameters", "I1 = 1.5\nI2 = 2\nI3 = 2.75\nm = 0.5\ng = 9.81\nl = 1/5");
  await first.tab.selectOption("#truncation", "5");
  await first.tab.selectOption("#axis-0", "1");
  await first.tab.click("#tab-file");
  await first.tab.locator("#speed").fill("60");
  await first.tab.locator("#orbit").focus();
  await first.tab.keyboard.press("Shift+ArrowRight");
  await first.tab.waitForTimeout(700);
  const [hash, there] = await first.tab.evaluate(() => [location.hash, page.linkOf()]);
  assert.equal(hash, there);
  const before = await state(first.tab);
  const shown = await text(first.tab, "text");
  await first.done();
  const second = await open(hash);
  const rounded = (s) => ({ ...s, speed: +s.speed.toPrecision(3), view: s.view.map((x) => +x.toFixed(2)), bodyView: s.bodyView.map((x) => +x.toFixed(2)) });
  assert.deepEqual(rounded(await state(second.tab)), rounded(before));
  assert.equal(await text(second.tab, "text"), shown);
  // A link that is put into the address of the open page.
  await second.tab.evaluate(() => { location.hash = "#system=rigid-body&truncation=3&paused=1"; });
  await second.tab.waitForFunction(() => page.about().name === "rigid-body");
  await second.tab.evaluate(() => { location.hash = "#system=three-wave"; });
  await second.tab.waitForFunction(() => page.about().name === "three-wave");
  await second.done();
});

onPage("the numbers are those of the command", ["#system=rigid-body&paused=1"], async (tab) => {
  await tab.selectOption("#truncation", "3");
  await tab.fill("#step", "0.25");
  await tab.waitForFunction(() => page.about().step === 0.25);
  await tab.click("#again");
  await tab.evaluate(() => { for (let made = 0; made < 400; ) made += page.session().advance(400 - made); dirty = true; });
  await frames(tab);
  const [energy, momentum, casimirs] = await tab.evaluate(() => [...page.session().most()]);
  // `coadjoint simulate examples/rigid_body.toml --truncation 3 --step 0.25`: drift of the energy.
  assert.ok(Math.abs(energy / 1.2377828154956593e-7 - 1) < 1e-6, String(energy));
  assert.ok(momentum < 1e-14 && casimirs < 1e-14);
  assert.equal(await text(tab, "ours-0"), "1.2e−7");
  await tab.click("#tab-file");
  const file = join(mkdtempSync(join(tmpdir(), "coadjoint-")), "copied.toml");
  writeFileSync(file, await text(tab, "text"));
  if (process.env.COADJOINT) {
    const run = spawnSync(process.env.COADJOINT, ["simulate", file, "--format", "json"], { encoding: "utf8" });
    assert.equal(run.status, 0, run.stderr);
    const report = JSON.parse(run.stdout);
    assert.deepEqual(report.momentum, await tab.evaluate(() => [...page.session().momentum()]));
    assert.ok(Math.abs(report.drift.energy / energy - 1) < 1e-6);
  }
});

onPage("nothing moves by itself where the user asks for calm", ["", { reducedMotion: "reduce" }], async (tab) => {
  await frames(tab, 10);
  assert.equal(await tab.evaluate(() => page.session().steps()), 0);
  assert.equal(await text(tab, "play"), "Play");
});

for (const [scheme, width] of [["light", 1280], ["dark", 1280], ["light", 390], ["dark", 390]]) {
  test(`contrast, names and room, ${scheme}, ${width} wide`, async () => {
    const phone = width < 500;
    const { tab, done } = await open("#system=wing-nut&speed=40", {
      colorScheme: scheme,
      viewport: { width, height: phone ? 844 : 900 },
      deviceScaleFactor: phone ? 2 : 1,
      hasTouch: phone,
    });
    await tab.waitForFunction(() => page.session().steps() > 60);
    await tab.screenshot({ path: join(pictures, `${scheme}-${width}.png`), fullPage: true });
    // With a mistake and a refused step on the screen, too.
    await tab.fill("#hamiltonian", "x^2/2 + q^2");
    await tab.waitForSelector("#hamiltonian-mistakes .mistake");
    await tab.evaluate((axe) => (0, eval)(axe), axe);
    const tags = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"];
    const check = () => tab.evaluate(async (tags) => {
      const { violations } = await globalThis.axe.run(document, { runOnly: { type: "tag", values: tags } });
      return violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target).join(", ")}`);
    }, tags);
    assert.deepEqual(await check(), []);
    await tab.selectOption("#gallery", "kirchhoff-body");
    await tab.click("#tab-file");
    assert.deepEqual(await check(), []);
    const [content, room] = await tab.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(content <= room, `${content} in ${room}`);
    await done();
  });
}
