// The fields, and mistakes at their places.
const TRUNCATIONS = [1, 3, 5, 7, 9, 11, 13];
// The step that the slider's middle stands for.
let middleStep = 0.1;

function makeForm(groups, changed) {
  const choice = byId("gallery");
  for (const { id, title, family } of gallery) {
    let group = [...choice.children].find((group) => group.label === family);
    if (!group) {
      group = document.createElement("optgroup");
      group.label = family;
      choice.append(group);
    }
    group.append(new Option(title, id));
  }
  for (const [name, summary] of groups) {
    const option = new Option(summary, name);
    byId("groups").append(option);
  }
  for (const key of FIELDS) {
    const field = byId(key);
    const list = document.createElement("div");
    list.className = "mistakes";
    list.id = `${key}-mistakes`;
    field.closest(".field").append(list);
    field.addEventListener("input", () => {
      state.fields[key] = field.value;
      if (key === "step") showSlider();
      if (key === "parameters") fillKnobs();
      if (key !== "hamiltonian" && key !== "parameters") unmark(key);
      copyText(field);
      changed(field.tagName === "SELECT" ? 0 : 180);
    });
    if (field.tagName === "TEXTAREA") field.addEventListener("scroll", () => (marksOf(field).scrollTop = field.scrollTop));
  }
  byId("step-slider").addEventListener("input", (event) => {
    const step = middleStep * 10 ** (event.target.value / 100);
    state.fields.step = byId("step").value = String(+step.toPrecision(2));
    changed(0);
  });
  byId("parameters").addEventListener("turned", () => changed(0));
  byId("own").addEventListener("toggle", () => {
    if (byId("own").open && !state.fields.algebra) byId("algebra").focus();
  });
}

// The state into the fields.
function fillForm() {
  const entry = gallery.find((entry) => entry.id === state.system);
  byId("gallery").value = state.system;
  showAbout();
  const truncation = byId("truncation");
  truncation.replaceChildren(...TRUNCATIONS.map((k) => new Option(`${k} (order ${k + 1})`, k)));
  for (const key of FIELDS) {
    const [field, value] = [byId(key), state.fields[key] ?? ""];
    if (field.tagName === "SELECT" && ![...field.options].some((option) => option.value === value)) field.add(new Option(value || "(none)", value));
    field.value = value;
    if (field.tagName === "TEXTAREA") field.rows = Math.min(Math.max(value.split("\n").length, Math.ceil(value.length / 34), 2), 9);
  }
  byId("own").open = Boolean(state.fields.algebra);
  fillKnobs();
  middleStep = Number(entry?.fields.step) || Number(state.fields.step) || 0.1;
  showSlider();
}

// A slider for each parameter that is a number; it writes into the text.
const KNOB = /(^|[\n,;])([ \t]*)([A-Za-z_]\w*)([ \t]*=[ \t]*)(-?\d+(?:\.\d+)?(?:\/\d+)?)(?=[ \t]*(?:[\n,;]|$))/g;

function fillKnobs() {
  const box = document.querySelector(".knobs");
  const found = [...(state.fields.parameters ?? "").matchAll(KNOB)];
  byId("knobs").hidden = !found.length;
  // While a slider is moved it must stay.
  if (box.contains(document.activeElement)) return;
  box.replaceChildren();
  for (const [, , , name, , text] of found) {
    const [over, under = 1] = text.split("/").map(Number);
    const middle = over / under;
    const slider = element("input");
    const label = element("label", "", nicely(name));
    const shown = element("output", "", shortly(middle));
    slider.type = "range";
    slider.id = `knob-${name}`;
    label.htmlFor = shown.htmlFor = slider.id;
    Object.assign(slider, { min: -100, max: 100, step: 1, value: 0 });
    slider.addEventListener("input", () => {
      // Up to four times as large or small; a zero up to one to both sides.
      const value = middle ? middle * 4 ** (slider.value / 100) : slider.value / 100;
      const written = String(+value.toPrecision(3));
      shown.textContent = shortly(+written);
      state.fields.parameters = state.fields.parameters.replace(KNOB, (all, before, blank, own, equals) =>
        own === name ? before + blank + own + equals + written : all);
      byId("parameters").value = state.fields.parameters;
      byId("parameters").dispatchEvent(new Event("turned"));
    });
    box.append(label, slider, shown);
  }
}

// The sentence about the chosen system, as long as the fields are its own.
function showAbout() {
  const entry = gallery.find((entry) => entry.id === state.system);
  const same = entry && ["group", "algebra", "hamiltonian"].every((key) => entry.fields[key] === state.fields[key]);
  byId("about").textContent = same ? entry.about : "A system of your own.";
}

function showSlider() {
  const step = Number(state.fields.step);
  if (step > 0) byId("step-slider").value = Math.round(100 * Math.log10(step / middleStep));
}

const marksOf = (field) => field.parentElement.querySelector(".marks");
// Behind a field stands its text without colour, to carry the marks.
function copyText(field) {
  if (field.tagName === "TEXTAREA") marksOf(field).textContent = "";
}

function unmark(key) {
  const field = byId(key);
  field.removeAttribute("aria-invalid");
  field.removeAttribute("aria-describedby");
  byId(`${key}-mistakes`).replaceChildren();
  copyText(field);
}

function showMistakes(mistakes) {
  FIELDS.forEach(unmark);
  byId("general").replaceChildren();
  for (const key of FIELDS) {
    const own = mistakes.filter((mistake) => mistake.field === key);
    if (!own.length) continue;
    const field = byId(key);
    const value = state.fields[key] ?? "";
    field.setAttribute("aria-invalid", "true");
    field.setAttribute("aria-describedby", `${key}-mistakes`);
    const places = own.map(({ start, end }) => [placeInString(value, start), placeInString(value, end)]);
    byId(`${key}-mistakes`).replaceChildren(...own.map((mistake, i) => shown(mistake, value, places[i])));
    if (field.tagName === "TEXTAREA") mark(field, value, places);
    if (key === "algebra") byId("own").open = true;
  }
  const rest = mistakes.filter((mistake) => !FIELDS.includes(mistake.field));
  byId("general").replaceChildren(...rest.map((mistake) => shown(mistake, "", [0, 0])));
  announce(mistakes);
}

// For those who do not see the marks; not at every key.
const announce = later(700, (mistakes) => {
  const names = (mistake) => (mistake.field ? `${byId(mistake.field).labels[0].textContent}: ` : "");
  byId("summary").textContent = mistakes.length
    ? `${mistakes.length} ${mistakes.length > 1 ? "mistakes" : "mistake"}. ` + mistakes.map((mistake) => names(mistake) + mistake.message).join(". ")
    : "";
});

function element(tag, className, text) {
  const made = document.createElement(tag);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
}

// A mistake: the line with its place, what is wrong, what to write instead.
function shown(mistake, value, [start, end]) {
  const box = element("div", "mistake");
  // In a short text the mark in the field itself is enough.
  const long = value.length > 30 || value.includes("\n") || byId(mistake.field)?.tagName !== "TEXTAREA";
  if (value && long && mistake.end > mistake.start && !(start === 0 && end >= value.length)) {
    const [from, to] = [value.lastIndexOf("\n", start - 1) + 1, value.indexOf("\n", start)];
    const line = to < 0 ? value.length : to;
    const [near, far] = [Math.max(from, start - 24), Math.min(line, Math.max(end, start + 1) + 24)];
    const place = element("code", "place");
    place.append(near > from ? "…" : "", value.slice(near, start));
    place.append(element("mark", "", value.slice(start, Math.min(end, line)) || " "));
    place.append(value.slice(Math.min(end, line), far), far < line ? "…" : "");
    box.append(place);
  }
  box.append(element("b", "", mistake.message));
  if (mistake.help) box.append(element("div", "help", mistake.help));
  return box;
}

function mark(field, value, places) {
  const marks = marksOf(field);
  marks.replaceChildren();
  let at = 0;
  for (const [start, end] of places.sort((a, b) => a[0] - b[0])) {
    if (start < at) continue;
    marks.append(value.slice(at, start), element("mark", "", value.slice(start, Math.max(end, start + 1)) || " "));
    at = Math.max(end, start + 1);
  }
  marks.append(value.slice(at));
  marks.scrollTop = field.scrollTop;
}
