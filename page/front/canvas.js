// Canvases at the screen's own resolution, the page's colours, and turning by hand.
let colours = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  const names = ["paper", "sheet", "ink", "soft", "line", "ours", "rival", "sphere-light", "sphere-dark", "level", "face-1", "face-2", "face-3", "edge", "mark"];
  colours = Object.fromEntries(names.map((name) => [name, style.getPropertyValue("--" + name).trim()]));
}

const calm = matchMedia("(prefers-reduced-motion: reduce)");
const sizes = new Map();
const watcher = new ResizeObserver((entries) => {
  for (const { target, contentRect } of entries) {
    sizes.set(target, [contentRect.width, contentRect.height]);
    target.dispatchEvent(new Event("resized"));
  }
});

// A context whose unit is a pixel of CSS, cleared; with its width and height.
function clear(canvas) {
  const [width, height] = sizes.get(canvas) ?? [canvas.clientWidth, canvas.clientHeight];
  const ratio = Math.min(devicePixelRatio || 1, 3);
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return [context, width, height];
}

const FONT = "500 14px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif";

// A colour with less of it: `part` from 0 to 1.
function faint(colour, part) {
  const n = parseInt(colour.slice(1), 16);
  return `rgba(${n >> 16}, ${(n >> 8) & 255}, ${n & 255}, ${part})`;
}
// Between two colours.
function blend(a, b, part) {
  const [m, n] = [parseInt(a.slice(1), 16), parseInt(b.slice(1), 16)];
  const at = (shift) => Math.round(((m >> shift) & 255) * (1 - part) + ((n >> shift) & 255) * part);
  return `rgb(${at(16)}, ${at(8)}, ${at(0)})`;
}

// A line through places on the screen, broken where one is missing.
function line(context, places, colour, width, dash = []) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.beginPath();
  let down = false;
  for (const place of places) {
    if (place) down ? context.lineTo(place[0], place[1]) : context.moveTo(place[0], place[1]);
    down = Boolean(place);
  }
  context.stroke();
  context.setLineDash([]);
}

// A disc, filled, and with an edge where it has a colour.
function disc(context, [x, y], radius, fill, edge, width) {
  context.fillStyle = fill;
  context.beginPath();
  context.arc(x, y, radius, 0, 7);
  context.fill();
  if (!edge) return;
  context.strokeStyle = edge;
  context.lineWidth = width;
  context.stroke();
}

// An arrow from a to b on the screen.
function arrow(context, a, b, colour, width = 2.5) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = Math.hypot(dx, dy);
  if (length < 1) return;
  const [ux, uy] = [dx / length, dy / length];
  const head = Math.min(4 + 2.4 * width, length);
  context.fillStyle = colour;
  context.lineCap = "round";
  line(context, [a, [b[0] - ux * head * 0.8, b[1] - uy * head * 0.8]], colour, width);
  context.beginPath();
  context.moveTo(b[0], b[1]);
  context.lineTo(b[0] - ux * head - uy * head * 0.42, b[1] - uy * head + ux * head * 0.42);
  context.lineTo(b[0] - ux * head + uy * head * 0.42, b[1] - uy * head - ux * head * 0.42);
  context.fill();
}

// Turns a view by dragging and by arrow keys; `take` may take a pointer or a key for itself.
function turnable(canvas, view, changed, take = {}) {
  let last = null, taken = false;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const turn = (dx, dy) => {
    const angles = view();
    angles[0] -= dx;
    angles[1] = Math.min(Math.max(angles[1] + dy, -1.5), 1.5);
    changed();
  };
  canvas.addEventListener("touchstart", (event) => {
    const touch = event.touches[0];
    if (take.wants?.(at(touch))) event.preventDefault();
  }, { passive: false });
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    last = at(event);
    taken = Boolean(take.wants?.(last));
    canvas.setPointerCapture(event.pointerId);
    if (taken) take.move(last);
  });
  canvas.addEventListener("pointermove", (event) => {
    const now = at(event);
    if (!last) {
      canvas.classList.toggle("near", Boolean(take.wants?.(now)));
      return;
    }
    if (taken) take.move(now);
    else turn((now[0] - last[0]) * 0.01, (now[1] - last[1]) * 0.01);
    last = now;
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, () => {
      if (taken) take.end?.();
      last = null;
      taken = false;
    });
  }
  const KEYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  canvas.addEventListener("keydown", (event) => {
    const way = KEYS[event.key];
    if (!way || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    if (!event.shiftKey && take.key?.(way)) return;
    turn(way[0] * 0.1, way[1] * 0.1);
  });
}
