// The body, or what stands for it on groups that turn no body.
const TIPS = 240;

// The scene of a system, and its shape.
function sceneOf(about) {
  const [first] = about.factors;
  if (about.factors.length > 1 && about.factors.every((factor) => factor.kind === "rotation")) return { kind: "spins" };
  if (first.kind === "plane") return { kind: "plane", tips: [] };
  if (first.kind === "matrix") return { kind: "matrix" };
  const slope = first.kind === "motion" ? about.slope.slice(3, 6) : [0, 0, 0];
  const { values, axes } = principal(about.inverse_inertia);
  const solid = values.every((value) => value > 1e-12);
  // Moments of inertia, and from them the edges of a homogeneous box: a² is proportional to I₂ + I₃ − I₁.
  const moments = solid ? values.map((value) => 1 / value) : [1.2, 1, 0.6];
  const total = moments[0] + moments[1] + moments[2];
  const edges = moments.map((moment) => Math.sqrt(Math.max(total - 2 * moment, 0.02 * total)));
  if (size(slope) > 0) {
    const axis = unit(slope);
    return { kind: "top", axis, across: upright(axis), tips: [], tip: axis };
  }
  const longest = Math.hypot(...edges);
  // The axis whose way is shown: that nearest to the momentum.
  const along = axes.map((axis) => Math.abs(dot(axis, about.momentum)));
  const tip = axes[along.indexOf(Math.max(...along))];
  return { kind: "body", axes, edges: edges.map((edge) => edge / longest), tips: [], tip };
}

function captionOf(scene, about) {
  const motion = about.factors[0].kind === "motion";
  return {
    body: motion ? "the arrow: its impulse, which stays" : "the arrow: its momentum, which stays",
    top: "the arrow: the vertical",
    spins: "an arrow each",
    plane: "from above, with its way",
    matrix: "its matrix: colour for signs",
  }[scene.kind];
}

// The entries of a factor's block before and after the last step.
function blocksOf(matrices, { row }) {
  const rows = Math.sqrt(matrices.length / 2);
  const block = (offset) => (i, j) => matrices[offset + (row + i) * rows + row + j];
  return [block(0), block(rows * rows)];
}

// `now` is μ, and the matrices of g before and after the last step, of which `part` is shown.
function drawBody(canvas, scene, about, now, start) {
  const [context, width, height] = clear(canvas);
  if (!width) return;
  const draw = { body: drawSolid, top: drawSolid, spins: drawSpins, plane: drawPlane, matrix: drawMatrix }[scene.kind];
  draw(context, width, height, scene, about, now, start);
}

// The screen's place of a point, with a little perspective; the third number grows towards the eye.
function onScreen(width, height, scale) {
  const rows = camera(state.bodyView);
  return (p) => {
    const [x, y, z] = times(rows, p);
    const near = 1 / (1 - 0.12 * z);
    return [width / 2 + x * near * scale, height * 0.54 - y * near * scale, z];
  };
}

function drawSolid(context, width, height, scene, about, now, start) {
  const [first] = about.factors;
  const [before, after] = blocksOf(now.matrices, first).map((at) => quaternionOf(at, first.kind === "motion" ? 3 : first.size));
  const rotation = rotationOf(...quaternionBetween(before, after, now.part));
  const vertical = first.kind === "motion" && size(start.slice(3, 6)) > 0 ? start.slice(3, 6) : start.slice(0, 3);
  const up = upright(vertical);
  const place = onScreen(width, height, Math.min(width, height) * 0.385);
  const toWorld = (p) => times(up, times(rotation, p));
  const tip = toWorld(scene.tip);
  leaveTip(scene, tip);
  drawFloor(context, place);
  const faces = scene.kind === "top" ? topFaces(scene) : boxFaces(scene);
  const eye = camera(state.bodyView)[2];
  const light = unit(plus(plus(eye, [0, 0, 0.9]), scaled(camera(state.bodyView)[0], -0.4)));
  const visible = faces
    .map((face) => ({ ...face, points: face.points.map(toWorld), normal: toWorld(face.normal) }))
    .map((face) => ({ ...face, depth: face.points.reduce((sum, p) => sum + dot(p, eye), 0) / face.points.length }))
    .filter((face) => face.both || dot(face.normal, eye) - 0.12 * dot(face.normal, face.points[0]) > 0)
    .sort((a, b) => a.depth - b.depth);
  drawTips(context, place, scene, eye, false);
  arrow(context, place([0, 0, 0]), place([0, 0, 1.2]), colours.ours, 3);
  for (const face of visible) {
    const points = face.points.map(place);
    const shade = Math.max(dot(face.normal, light), face.both ? Math.abs(dot(face.normal, light)) : 0);
    context.fillStyle = blend(face.colour, colours["sphere-light"], 0.28 * shade);
    context.strokeStyle = faint(colours.edge, face.fine ? 0.35 : 0.75);
    context.lineWidth = face.fine ? 0.75 : 1.25;
    context.lineJoin = "round";
    context.beginPath();
    points.forEach(([x, y], i) => (i ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.closePath();
    context.fill();
    context.stroke();
  }
  if (scene.kind === "top") disc(context, place([0, 0, 0]), 3.5, colours.ink);
  drawTips(context, place, scene, eye, true);
}

function boxFaces({ axes, edges }) {
  const corner = (i, j, k) => plus(plus(scaled(axes[0], i * edges[0]), scaled(axes[1], j * edges[1])), scaled(axes[2], k * edges[2]));
  const faces = [];
  for (const axis of [0, 1, 2]) {
    for (const sign of [1, -1]) {
      const ring = [[1, 1], [1, -1], [-1, -1], [-1, 1]].map(([a, b]) => {
        const at = [0, 0, 0];
        at[axis] = sign;
        at[(axis + 1) % 3] = a;
        at[(axis + 2) % 3] = b;
        return at;
      });
      faces.push({ points: ring.map((at) => corner(...at)), normal: scaled(axes[axis], sign), colour: colours[`face-${axis + 1}`] });
      if (sign === 1) {
        // A mark, so that one side is told from the other.
        const mark = ring.map((at) => corner(...at.map((x, i) => (i === axis ? x * 1.001 : x * 0.16))));
        faces.push({ points: mark, normal: scaled(axes[axis], sign), colour: colours.mark, fine: true });
      }
    }
  }
  return faces;
}

// A disc on a stick that stands on its tip.
function topFaces({ axis, across }) {
  const [first, second] = across;
  const ring = (radius, at) => [...Array(24).keys()].map((i) => {
    const angle = (i / 24) * 2 * Math.PI;
    return plus(scaled(axis, at), plus(scaled(first, radius * Math.cos(angle)), scaled(second, radius * Math.sin(angle))));
  });
  const faces = [];
  const band = (below, above, colour) => {
    for (let i = 0; i < 24; i++) {
      const j = (i + 1) % 24;
      const points = [below[i], below[j], above[j], above[i]];
      const normal = unit(cross(plus(points[1], scaled(points[0], -1)), plus(points[2], scaled(points[0], -1))));
      faces.push({ points, normal, colour: colour(i), fine: true });
    }
  };
  const sector = (i) => colours[i % 8 < 4 ? "face-2" : "face-1"];
  const stick = () => colours["face-3"];
  band(ring(0.012, 0), ring(0.045, 0.5), stick);
  band(ring(0.06, 0.46), ring(0.5, 0.62), sector);
  band(ring(0.5, 0.62), ring(0.5, 0.7), sector);
  band(ring(0.5, 0.7), ring(0.05, 0.76), sector);
  band(ring(0.04, 0.76), ring(0.04, 1), stick);
  faces.push({ points: ring(0.04, 1), normal: axis, colour: colours["face-3"], fine: true });
  return faces;
}

// A disc below, for the eye to hold on to.
function drawFloor(context, place) {
  for (const radius of [0.5, 1]) {
    const angles = [...Array(73).keys()].map((i) => (i / 36) * Math.PI);
    line(context, angles.map((a) => place([radius * Math.cos(a), radius * Math.sin(a), 0])), colours.line, 1);
  }
}

function leaveTip(scene, tip) {
  const last = scene.tips[scene.tips.length - 1];
  if (last && size(plus(tip, scaled(last, -1))) < 0.008) return;
  scene.tips.push(tip);
  if (scene.tips.length > TIPS) scene.tips.shift();
}

// Where the tip of an axis has been, on the sphere of directions: what is behind, or what is in front.
function drawTips(context, place, scene, eye, inFront) {
  context.lineCap = "butt";
  const { tips } = scene;
  for (let i = 1; i < tips.length; i++) {
    if (dot(tips[i], eye) > 0 !== inFront) continue;
    if (size(plus(tips[i], scaled(tips[i - 1], -1))) > 0.3) continue;
    const colour = faint(colours.ours, ((inFront ? 0.75 : 0.3) * i) / tips.length);
    line(context, [place(tips[i - 1]), place(tips[i])], colour, 1.75);
  }
}

function drawSpins(context, width, height, scene, about, now) {
  const count = about.factors.length;
  const place = onScreen(width, height, Math.min(width, height) * 0.38);
  const eye = camera(state.bodyView)[2];
  const spins = about.factors.map((factor, i) => {
    const angle = (i / count) * 2 * Math.PI;
    const foot = count === 2 ? [0, i ? 0.55 : -0.55, 0] : [0.72 * Math.cos(angle), 0.72 * Math.sin(angle), 0];
    const mu = [...now.momentum.subarray(factor.coordinate, factor.coordinate + 3)];
    return { foot, mu, depth: dot(foot, eye) };
  });
  const largest = Math.max(...spins.map((spin) => size(spin.mu)), 1e-300);
  const length = Math.min(0.7, 2.4 / count + 0.2);
  drawFloor(context, place);
  for (const { foot, mu } of spins.sort((a, b) => a.depth - b.depth)) {
    const end = plus(foot, scaled(mu, length / largest));
    const back = plus(foot, scaled(mu, -0.3 * length / largest));
    const along = dot(unit(mu), [0, 0, 1]);
    arrow(context, place(back), place(end), blend(colours["face-1"], colours.ours, 0.5 + 0.5 * along), 5);
    disc(context, place(foot), 3, colours.ink);
  }
}

function drawPlane(context, width, height, scene, about, now) {
  const [before, after] = blocksOf(now.matrices, about.factors[0]);
  const between = (i, j) => before(i, j) * (1 - now.part) + after(i, j) * now.part;
  const [x, y] = [between(0, 2), between(1, 2)];
  const angle = Math.atan2(between(1, 0), between(0, 0));
  const last = scene.tips[scene.tips.length - 1];
  if (!last || Math.hypot(x - last[0], y - last[1]) > 0.02) scene.tips.push([x, y]);
  if (scene.tips.length > 3000) scene.tips.shift();
  const unitLength = Math.min(width, height) * 0.13;
  const place = ([a, b]) => [width / 2 + (a - x) * unitLength, height / 2 - (b - y) * unitLength];
  const reach = Math.ceil(width / unitLength / 2) + 1;
  for (let i = -reach; i <= reach; i++) {
    const [px, py] = place([Math.round(x) + i, Math.round(y) + i]);
    line(context, [[px, 0], [px, height], null, [0, py], [width, py]], colours.line, 1);
  }
  line(context, [...scene.tips.map(place), [width / 2, height / 2]], faint(colours.ours, 0.8), 2);
  context.save();
  context.translate(width / 2, height / 2);
  context.rotate(-angle);
  context.fillStyle = colours["face-2"];
  context.strokeStyle = colours.edge;
  context.lineWidth = 1.25;
  context.beginPath();
  context.ellipse(0, 0, unitLength * 0.9, unitLength * 0.32, 0, 0, 7);
  context.fill();
  context.stroke();
  disc(context, [unitLength * 0.62, 0], unitLength * 0.1, colours["face-1"]);
  context.restore();
}

function drawMatrix(context, width, height, scene, about, now) {
  const [before, after] = blocksOf(now.matrices, about.factors[0]);
  const rows = about.factors[0].size;
  const entry = (at) => [Math.floor(at / rows), at % rows];
  const g = [...Array(rows * rows).keys()].map((at) => before(...entry(at)) * (1 - now.part) + after(...entry(at)) * now.part);
  const largest = g.reduce((most, x) => Math.max(most, Math.abs(x)), 1e-300);
  const side = (Math.min(width, height) * 0.78) / rows;
  const [left, top] = [(width - side * rows) / 2, (height - side * rows) / 2];
  g.forEach((value, at) => {
    const [x, y] = [left + (at % rows) * side, top + Math.floor(at / rows) * side];
    context.fillStyle = colours.paper;
    context.fillRect(x + 1, y + 1, side - 2, side - 2);
    context.fillStyle = faint(value >= 0 ? colours.ours : colours.rival, Math.abs(value) / largest);
    context.fillRect(x + 1, y + 1, side - 2, side - 2);
  });
  const [high, low] = [top - 6, top + side * rows + 6];
  for (const [x, end] of [[left - 8, left], [left + side * rows + 8, left + side * rows]]) {
    line(context, [[end, high], [x, high], [x, low], [end, low]], colours.soft, 1.5);
  }
}
