// The momentum on its coadjoint orbit, among the level curves of the energy.
const orbitScene = { curves: null, extent: 1, radius: 0, picture: null, key: "" };

// Called when the system or the momentum at the start is another.
function readCurves(session, start) {
  const raw = session.curves(Float64Array.from(start));
  orbitScene.key = "";
  if (!raw.length) {
    orbitScene.curves = null;
    orbitScene.radius = 0;
    orbitScene.extent = 0;
    return;
  }
  const [radius, extent, spread] = raw;
  const curves = [];
  for (let at = 3; at < raw.length; ) {
    const count = raw[at];
    curves.push({ points: raw.subarray(at + 1, at + 1 + 6 * count), own: curves.length >= spread });
    at += 1 + 6 * count;
  }
  Object.assign(orbitScene, { radius, extent, curves });
}

// The radius of the sphere that the three axes shown stay on, or 0.
function sphereRadius(about, start) {
  if (orbitScene.curves) return orbitScene.radius;
  const sphere = about.spheres.find((sphere) => sphere.join() === state.axes.join());
  return sphere ? Math.hypot(...sphere.map((i) => start[i])) : 0;
}

function orbitFrame(canvas, about, start) {
  const [width, height] = sizes.get(canvas) ?? [canvas.clientWidth, canvas.clientHeight];
  const radius = sphereRadius(about, start);
  const shown = radius || orbitScene.extent || 1;
  const scale = (Math.min(width, height) * (radius ? 0.41 : 0.44)) / shown / (radius ? 1 : 1.15);
  const rows = camera(state.view);
  const place = (p) => {
    const [x, y, z] = times(rows, p);
    return [width / 2 + x * scale, height / 2 - y * scale, z];
  };
  // The point of the sphere's front side under a place on the screen; outside the disc, the nearest on its rim.
  const pick = ([px, py]) => {
    let [x, y] = [(px - width / 2) / scale, (height / 2 - py) / scale];
    const r = Math.hypot(x, y);
    if (r > radius) [x, y] = [(x * radius) / r, (y * radius) / r];
    const z = Math.sqrt(Math.max(radius * radius - x * x - y * y, 0));
    return [0, 1, 2].map((i) => rows[0][i] * x + rows[1][i] * y + rows[2][i] * z);
  };
  return { width, height, radius, scale, rows, place, pick };
}

// `trails` are points (x, y, z): the rival's, then ours.
function drawOrbit(canvas, about, start, trails) {
  const [context, width, height] = clear(canvas);
  if (!width) return;
  if (!orbitScene.curves && !sphereRadius(about, start)) growExtent(trails[1]);
  const frame = orbitFrame(canvas, about, start);
  const key = [width, height, ...state.view, canvas.width, orbitScene.extent, colours.paper, frame.radius, state.axes].join();
  if (orbitScene.key !== key || !orbitScene.picture) {
    orbitScene.picture = backdrop(canvas, about, frame);
    orbitScene.key = key;
  }
  context.drawImage(orbitScene.picture, 0, 0, width, height);
  const [rival, ours] = trails;
  drawTrail(context, frame, rival, colours.rival, [5, 4]);
  drawTrail(context, frame, ours, colours.ours, []);
  const first = state.axes.map((i) => start[i] ?? 0);
  ring(context, frame, first);
  const at = [...ours.slice(-3)];
  if (at.length === 3 && at.every(Number.isFinite)) spot(context, frame, at);
}

// The parts that stay while the momentum moves: the surface, its level curves, the axes.
function backdrop(canvas, about, frame) {
  const picture = document.createElement("canvas");
  [picture.width, picture.height] = [canvas.width, canvas.height];
  const context = picture.getContext("2d");
  const ratio = canvas.width / frame.width;
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  const { width, height, radius, scale, rows, place } = frame;
  if (radius) {
    const r = radius * scale;
    const shade = context.createRadialGradient(width / 2 - r * 0.35, height / 2 - r * 0.45, r * 0.1, width / 2, height / 2, r);
    shade.addColorStop(0, colours["sphere-light"]);
    shade.addColorStop(1, colours["sphere-dark"]);
    disc(context, [width / 2, height / 2], r, shade, colours.line, 1.25);
  }
  drawAxes(context, about, frame);
  for (const front of [false, true]) {
    for (const { points, own } of orbitScene.curves ?? []) {
      const places = [];
      for (let i = 0; i < points.length; i += 6) {
        const facing = dot(points.subarray(i + 3, i + 6), rows[2]);
        places.push(facing >= 0 === front && place(points.subarray(i, i + 3)));
      }
      const colour = own ? faint(colours.ours, front ? 0.55 : 0.16) : faint(colours.level, front ? 0.6 : 0.16);
      line(context, places, colour, own ? 1.75 : 1);
    }
  }
  return picture;
}

function drawAxes(context, about, { radius, place, rows, width, height }) {
  const length = (radius || orbitScene.extent || 1) * (radius ? 1.14 : 1.02);
  context.font = FONT;
  context.textAlign = "center";
  context.textBaseline = "middle";
  state.axes.forEach((coordinate, axis) => {
    // Groups of one or two dimensions have no more axes.
    if (coordinate >= about.dim) return;
    const end = [0, 0, 0];
    end[axis] = length;
    const away = rows[2][axis] < 0;
    // On a sphere only what stands out of it.
    const from = radius ? scaled(end, radius / length) : scaled(end, -1);
    const [a, b] = [place(from), place(end)];
    line(context, [a, b], faint(colours.soft, away ? 0.45 : 0.9), 1.25);
    const [mx, my] = [b[0] - width / 2, b[1] - height / 2];
    const far = Math.hypot(mx, my) || 1;
    context.fillStyle = away ? colours.soft : colours.ink;
    context.fillText(nicely(about.coordinates[coordinate]), b[0] + (mx / far) * 13, b[1] + (my / far) * 13);
  });
}

// Of trails on spheres what is behind is fainter.
function drawTrail(context, { radius, place }, points, colour, dash) {
  if (points.length < 6) return;
  for (const front of radius ? [false, true] : [true]) {
    const places = [];
    for (let i = 0; i + 2 < points.length; i += 3) {
      const at = place(points.subarray(i, i + 3));
      if (!Number.isFinite(at[0])) break;
      places.push((!radius || at[2] >= 0 === front) && at);
    }
    context.lineJoin = context.lineCap = "round";
    line(context, places, faint(colour, front ? 1 : 0.28), 2.25, dash);
  }
}

// The momentum at the start: a ring, to be taken hold of.
function ring(context, { radius, place }, p) {
  const at = place(p);
  const behind = radius && at[2] < 0;
  disc(context, at, 8, "transparent", faint(colours.ink, behind ? 0.35 : 1), 2);
}

function spot(context, { radius, place }, p) {
  const at = place(p);
  const behind = radius && at[2] < 0;
  disc(context, at, 6, faint(colours.ours, behind ? 0.35 : 1), faint(colours.sheet, behind ? 0.2 : 1), 2);
}

// Without a surface the picture is as large as what has been seen.
function growExtent(points) {
  let most = 0;
  for (const x of points) if (Math.abs(x) > most) most = Math.abs(x);
  if (most > orbitScene.extent) orbitScene.extent = most * 1.1;
}
