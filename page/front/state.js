// The state of the page, and the link that holds it.
const FIELDS = ["name", "group", "algebra", "coordinates", "hamiltonian", "parameters", "truncation", "chart", "frame", "method", "step", "momentum", "time"];
const TABS = ["formulas", "file"];

// The systems to choose from.
let gallery = [];

const state = {
  // The system of the gallery that the fields began with.
  system: "",
  fields: {},
  // Steps a second.
  speed: 20,
  playing: true,
  axes: [0, 1, 2],
  tab: "formulas",
  // Where the momentum is looked at from, and the body: azimuth, elevation.
  view: [0.6, 0.5],
  bodyView: [0.5, 0.32],
};

function linkOf() {
  const entries = new URLSearchParams();
  if (state.system) entries.set("system", state.system);
  const given = gallery.find((entry) => entry.id === state.system)?.fields ?? {};
  for (const key of FIELDS) if (state.fields[key] || given[key]) entries.set(key, state.fields[key] ?? "");
  entries.set("speed", String(+state.speed.toPrecision(3)));
  if (about?.dim > 3) entries.set("axes", state.axes.join(" "));
  if (state.tab !== "formulas") entries.set("tab", state.tab);
  if (!state.playing) entries.set("paused", "1");
  const angles = [...state.view, ...state.bodyView].map((angle) => +angle.toFixed(2));
  if (angles.join() !== "0.6,0.5,0.5,0.32") entries.set("view", angles.join(" "));
  return "#" + entries.toString();
}

// Takes what the link says into the state; whether it says anything.
function readLink() {
  const entries = new URLSearchParams(location.hash.slice(1));
  const entry = gallery.find((entry) => entry.id === entries.get("system"));
  if (!entry && !entries.has("hamiltonian")) return false;
  state.system = entry ? entry.id : "";
  state.fields = {};
  for (const key of FIELDS) state.fields[key] = entries.get(key) ?? entry?.fields[key] ?? "";
  if (!state.fields.chart) state.fields.chart = "exp";
  for (const key of ["frame", "method"]) if (!state.fields[key]) state.fields[key] = "auto";
  const number = (text) => (text !== null && Number.isFinite(+text) ? +text : null);
  const speed = number(entries.get("speed"));
  if (speed !== null) state.speed = Math.min(Math.max(speed, 0.5), 5000);
  const axes = (entries.get("axes") ?? "").split(" ").map(Number);
  state.axes = axes.length === 3 && axes.every((i) => Number.isInteger(i) && i >= 0) ? axes : [];
  state.tab = TABS.includes(entries.get("tab")) ? entries.get("tab") : "formulas";
  state.playing = !entries.has("paused");
  const view = (entries.get("view") ?? "").split(" ").map(Number);
  if (view.length === 4 && view.every(Number.isFinite)) {
    state.view = view.slice(0, 2);
    state.bodyView = view.slice(2);
  }
  return true;
}

let written = location.hash;
const writeLink = later(250, () => {
  written = linkOf();
  try {
    history.replaceState(null, "", written);
  } catch {
    location.replace(written);
  }
});
