// The run on the screen.
let session = null, about = null, scene = null;
// The momentum at the start.
let start = [];
// Steps owed, from 0 to 1: how far the picture is on its way to the last step made.
let part = 1;
let lastFrame = 0;
// Milliseconds that steps may take in a frame.
const BUDGET = 7;
const frameTimes = [];
const [bodyCanvas, orbitCanvas] = [byId("body"), byId("orbit")];
let dirty = true;

function say(text) {
  byId("said").textContent = "";
  setTimeout(() => (byId("said").textContent = text), 50);
}

// Makes the system of the fields; with mistakes the last one stays.
function build() {
  let made;
  try {
    made = new wasm_bindgen.Session(JSON.stringify(state.fields));
  } catch (error) {
    let mistakes;
    try {
      mistakes = JSON.parse(error);
    } catch {
      mistakes = [{ field: null, start: 0, end: 0, message: "the library has stopped: this is a defect of the page", help: "load the page again" }];
    }
    showMistakes(mistakes);
    byId("stale").hidden = !session;
    byId("stage").classList.toggle("dim", true);
    writeLink();
    return false;
  }
  showMistakes([]);
  byId("stale").hidden = true;
  byId("stage").classList.remove("dim");
  session?.free();
  session = made;
  about = JSON.parse(session.about());
  document.title = `${about.name} · coadjoint`;
  start = about.momentum;
  scene = sceneOf(about);
  if (state.axes.length !== 3 || about.dim <= 3 || state.axes.some((i) => i >= about.dim)) {
    state.axes = (about.dim > 3 && about.spheres[0]) || [0, 1, 2];
  }
  fillAxes();
  readCurves(session, start);
  captions();
  begin();
  showText();
  writeLink();
  return true;
}

function begin() {
  part = 1;
  scene.tips = [];
  if (!orbitScene.curves) orbitScene.extent = 0;
  byId("refusal").hidden = true;
  dirty = true;
  numbers();
}

function captions() {
  byId("body-title").textContent = { body: "The body", top: "The top", spins: "The spins", plane: "The body", matrix: "The group element" }[scene.kind];
  byId("body-caption").textContent = captionOf(scene, about);
  const sphere = sphereRadius(about, start) > 0;
  byId("orbit-caption").textContent = sphere
    ? `${orbitScene.curves ? "" : state.axes.map((i) => nicely(about.coordinates[i])).join(", ") + " "}on ${orbitScene.curves ? "its" : "a"} sphere: drag the ring`
    : orbitScene.curves ? "on its orbit, with energy levels" : "three of its coordinates";
  const m = about.substeps;
  const unitOfTime = about.time_unit ? ` ${about.time_unit}` : "";
  byId("ours-name").textContent = `this method, order ${about.order}, h = ${shortly(about.step)}${unitOfTime}`;
  byId("rival-name").textContent = `Runge–Kutta of order 4, h = ${shortly(about.step / m)}${unitOfTime}`;
  const terms = about.terms.map(([, count]) => count).join(" + ");
  const made = terms ? `S has ${terms} terms.` : `Steps are made by collocation at ${about.order / 2} nodes.`;
  byId("cost").textContent =
    `At the same cost: ${m === 1 ? "one step of Runge–Kutta" : `${m} steps of Runge–Kutta`} for each of ours, counted in operations. ` +
    `${made} Drifts are relative, the numbers the largest so far; rounding is at 10⁻¹⁶.`;
}

function fillAxes() {
  byId("axes").hidden = about.dim <= 3;
  state.axes.forEach((coordinate, axis) => {
    const choice = byId(`axis-${axis}`);
    choice.replaceChildren(...about.coordinates.map((name, i) => new Option(nicely(name), i)));
    choice.value = coordinate;
  });
}

// The momentum at the start is another, by hand.
function startFrom(momentum) {
  start = momentum;
  state.fields.momentum = momentum.map((x) => String(+x.toPrecision(6))).join(" ");
  start = state.fields.momentum.split(" ").map(Number);
  byId("momentum").value = state.fields.momentum;
  session.restart(Float64Array.from(start));
  readCurves(session, start);
  begin();
  textLater();
  writeLink();
}

function setPlaying(playing) {
  state.playing = playing;
  byId("play").textContent = playing ? "Pause" : "Play";
  dirty = true;
  writeLink();
}

function advance(count) {
  const began = performance.now();
  let made = 0;
  // In pieces, so that a slow system never holds the page up.
  for (let piece = 1; made < count; piece = Math.min(2 * piece, 64)) {
    const asked = Math.min(piece, count - made);
    const done = session.advance(asked);
    made += done;
    if (done < asked) {
      refused();
      break;
    }
    if (performance.now() - began > BUDGET) break;
  }
  dirty = true;
  return made;
}

function refused() {
  const found = session.refusal();
  if (!found) return;
  const { text, usable } = JSON.parse(found);
  setPlaying(false);
  part = 1;
  const box = byId("refusal");
  const unitOfTime = about.time_unit ? ` ${about.time_unit}` : "";
  box.replaceChildren(element("b", "", `The step from t = ${shortly(session.time(), 4)}${unitOfTime} was refused. `), text.charAt(0).toUpperCase() + text.slice(1) + ".");
  const buttons = element("div");
  if (usable) {
    const shorter = element("button", "", `Use h = ${shortly(usable)}`);
    shorter.type = "button";
    shorter.id = "usable";
    shorter.addEventListener("click", () => {
      state.fields.step = byId("step").value = String(usable);
      showSlider();
      build();
      setPlaying(true);
    });
    buttons.append(shorter);
  } else box.append(" No shorter step helps.");
  box.append(buttons);
  box.hidden = false;
}

function frame(now) {
  requestAnimationFrame(frame);
  const elapsed = Math.min(now - lastFrame, 100) / 1000;
  if (lastFrame) {
    frameTimes.push(now - lastFrame);
    if (frameTimes.length > 240) frameTimes.shift();
  }
  lastFrame = now;
  if (!session) return;
  if (state.playing) {
    part += elapsed * state.speed;
    if (part > 1) {
      const owed = Math.ceil(part - 1);
      const made = advance(owed);
      part = made < owed ? 1 : part - owed;
    }
    dirty = true;
  }
  if (dirty) {
    dirty = false;
    drawAll();
  }
}

let drawn = 0;
function drawAll() {
  const began = performance.now();
  const now = { momentum: session.between(part), matrices: session.matrices(), part };
  drawBody(bodyCanvas, scene, about, now, start);
  const [a, b, c] = state.axes;
  drawOrbit(orbitCanvas, about, start, [session.trail(true, a, b, c, part), session.trail(false, a, b, c, part)]);
  const history = session.history();
  for (const which of [0, 1, 2]) {
    const chart = byId(`drift-${which}`);
    if (unknown(which)) clear(chart);
    else drawDrift(chart, history, which, about.time_unit);
  }
  if (drawn++ % 6 === 0 || !state.playing) numbers();
  page.drawTime = performance.now() - began;
}

// Why the energy, or the Casimirs, have no drift.
const unknown = (which) =>
  which === 0 && !about.conserves_energy ? "not conserved: H depends on t" : which === 2 && !about.casimirs.length ? "none known" : "";

function numbers() {
  const most = session.most();
  for (const which of [0, 1, 2]) {
    const nothing = unknown(which);
    byId(`ours-${which}`).textContent = nothing || shortly(most[which], 2);
    byId(`rival-${which}`).textContent = nothing ? "" : shortly(most[3 + which], 2);
  }
  const unitOfTime = about.time_unit ? ` ${about.time_unit}` : "";
  byId("clock").textContent = `t = ${shortly(session.time(), 4)}${unitOfTime}, ${session.steps()} steps, H = ${shortly(session.energy(), 5)}`;
}

function showSpeed() {
  byId("speed").value = Math.round(25 * Math.log10(state.speed));
  byId("speed-text").textContent = `${+state.speed.toPrecision(2)} steps/s`;
}

// Formulas and the system file.
let textShown = "";
const textLater = later(250, showText);
function showText() {
  if (!session) return;
  const panel = byId("text");
  for (const tab of TABS) {
    const button = byId(`tab-${tab}`);
    button.setAttribute("aria-selected", String(tab === state.tab));
    button.tabIndex = tab === state.tab ? 0 : -1;
  }
  panel.setAttribute("aria-labelledby", `tab-${state.tab}`);
  byId("copy").hidden = state.tab === "formulas";
  if (state.tab === "formulas") {
    const lead = about.comoving
      ? "S generates the flow of H − f; the frame moves by f. Exact, parameters put in."
      : about.terms.length
        ? "The generating function S = h S₁ + h³ S₃ + …, exact; even orders vanish."
        : "No series: a step asks for ∂H/∂μ at its nodes, and is symplectic all the same.";
    panel.innerHTML = `<p class="fine">${lead}</p>` + JSON.parse(session.formulas()).join("") +
      (about.casimirs.length ? `<p class="fine">Casimirs, which every step keeps:</p>${about.casimirs.join("")}` : "");
    return;
  }
  textShown = session.file();
  panel.replaceChildren(element("pre", "", textShown));
}

async function copy(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    say(`${what} copied`);
  } catch (error) {
    say(`${what} not copied: ${error}`);
  }
}

function flash(button, text) {
  const before = button.dataset.text ?? (button.dataset.text = button.textContent);
  button.textContent = text;
  setTimeout(() => (button.textContent = before), 1400);
}

function choose(id) {
  const entry = gallery.find((entry) => entry.id === id);
  state.system = id;
  state.fields = { ...entry.fields };
  state.axes = [];
  orbitScene.extent = 0;
  fillForm();
  build();
  setPlaying(!calm.matches);
}

const rebuildLater = later(180, build);

function wire() {
  byId("gallery").addEventListener("change", (event) => choose(event.target.value));
  byId("play").addEventListener("click", () => setPlaying(!state.playing && session.refusal() === undefined));
  byId("single").addEventListener("click", () => {
    setPlaying(false);
    advance(1);
    part = 1;
  });
  byId("again").addEventListener("click", () => {
    session.restart(Float64Array.from(start));
    begin();
  });
  byId("speed").addEventListener("input", (event) => {
    state.speed = 10 ** (event.target.value / 25);
    showSpeed();
    writeLink();
  });
  for (const axis of [0, 1, 2]) {
    byId(`axis-${axis}`).addEventListener("change", (event) => {
      state.axes = [...state.axes];
      state.axes[axis] = Number(event.target.value);
      orbitScene.extent = 0;
      captions();
      dirty = true;
      writeLink();
    });
  }
  const turned = () => {
    dirty = true;
    writeLink();
  };
  turnable(bodyCanvas, () => state.bodyView, turned);
  // On a sphere the ring, or the momentum itself, is taken hold of.
  const setTriple = (p) => {
    const radius = sphereRadius(about, start);
    const momentum = [...start];
    const to = scaled(unit(p), radius);
    state.axes.forEach((coordinate, i) => (momentum[coordinate] = to[i]));
    startFrom(momentum);
  };
  turnable(orbitCanvas, () => state.view, turned, {
    wants: (at) => {
      if (!session || !sphereRadius(about, start)) return false;
      const { place } = orbitFrame(orbitCanvas, about, start);
      const now = session.momentum();
      return [start, now].some((mu) => {
        const [x, y, z] = place(state.axes.map((i) => mu[i]));
        return z > 0 && Math.hypot(x - at[0], y - at[1]) < 26;
      });
    },
    move: (at) => setTriple(orbitFrame(orbitCanvas, about, start).pick(at)),
    key: ([dx, dy]) => {
      if (!session || !sphereRadius(about, start)) return false;
      const p = state.axes.map((i) => start[i]);
      const [right, up] = camera(state.view);
      const push = scaled(plus(scaled(right, dx), scaled(up, -dy)), 0.05 * size(p));
      setTriple(plus(p, push));
      return true;
    },
  });
  const tabs = TABS.map((tab) => byId(`tab-${tab}`));
  tabs.forEach((button, i) => {
    button.addEventListener("click", () => {
      state.tab = TABS[i];
      showText();
      writeLink();
    });
    button.addEventListener("keydown", (event) => {
      const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: TABS.length - 1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      const next = tabs[(to + TABS.length) % TABS.length];
      next.focus();
      next.click();
    });
  });
  byId("copy").addEventListener("click", async () => {
    await copy(textShown, byId(`tab-${state.tab}`).textContent);
    flash(byId("copy"), "Copied");
  });
  byId("link").addEventListener("click", async () => {
    await copy(location.href.split("#")[0] + linkOf(), "Link");
    flash(byId("link"), "Copied");
  });
  addEventListener("hashchange", () => {
    if (location.hash === written || !readLink()) return;
    fillForm();
    build();
    setPlaying(state.playing && !calm.matches);
    showSpeed();
  });
  const recolour = () => {
    readColours();
    orbitScene.key = "";
    dirty = true;
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", recolour);
  for (const canvas of document.querySelectorAll("canvas")) {
    watcher.observe(canvas);
    canvas.addEventListener("resized", () => (dirty = true));
  }
}

// For tests and for the curious.
const page = { drawTime: 0, frameTimes, state, session: () => session, about: () => about, linkOf };

async function main() {
  readColours();
  await openLibrary();
  gallery = JSON.parse(wasm_bindgen.gallery());
  if (!readLink()) {
    state.system = gallery[0].id;
    state.fields = { ...gallery[0].fields };
  }
  makeForm(JSON.parse(wasm_bindgen.groups()), (wait) => {
    showAbout();
    if (wait) rebuildLater();
    else build();
  });
  fillForm();
  showSpeed();
  wire();
  if (build()) page.firstPicture = performance.now();
  setPlaying(state.playing && !calm.matches);
  requestAnimationFrame(frame);
}
main().catch((error) => {
  const box = byId("refusal");
  box.textContent = `The library could not be started: ${error}. The page needs a browser of 2023 or later.`;
  box.hidden = false;
});
