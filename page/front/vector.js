// Vectors of three numbers, quaternions (w, x, y, z), and where things are looked at from.
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const scaled = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const size = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => {
  const s = size(a);
  return s > 0 ? scaled(a, 1 / s) : [0, 0, 1];
};

// The rows of the rotation of a quaternion, which need not have length 1.
function rotationOf(w, x, y, z) {
  const s = 2 / (w * w + x * x + y * y + z * z || 1);
  return [
    [1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
    [s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)],
    [s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)],
  ];
}
const times = (rows, v) => [dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)];

// The rows of a rotation that takes the direction of `a` to the third axis.
function upright(a) {
  const up = unit(a);
  const other = Math.abs(up[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const first = unit(cross(other, up));
  return [first, cross(up, first), up];
}

// To the right, up, and towards the eye, for somebody who looks from this azimuth and elevation.
function camera([azimuth, elevation]) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  return [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
}

// Eigenvalues and eigenvectors (as rows) of a symmetric 3 × 3 matrix, by Jacobi's rotations.
function principal(matrix) {
  const a = [0, 1, 2].map((i) => [0, 1, 2].map((j) => (matrix[3 * i + j] + matrix[3 * j + i]) / 2));
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 30; sweep++) {
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(a[p][q]) < 1e-300) continue;
      const angle = 0.5 * Math.atan2(2 * a[p][q], a[q][q] - a[p][p]);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let k = 0; k < 3; k++) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
      for (let k = 0; k < 3; k++) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
      for (let k = 0; k < 3; k++) [v[p][k], v[q][k]] = [c * v[p][k] - s * v[q][k], s * v[p][k] + c * v[q][k]];
    }
  }
  return { values: [a[0][0], a[1][1], a[2][2]], axes: v };
}

// The quaternion of a rotation's matrix, or of the real 4 × 4 matrix that stands for one; `at(i, j)` are the entries.
function quaternionOf(at, rows) {
  if (rows === 4) return [at(0, 0), -at(2, 1), at(1, 0), -at(2, 0)];
  const t = [
    1 + at(0, 0) + at(1, 1) + at(2, 2),
    1 + at(0, 0) - at(1, 1) - at(2, 2),
    1 - at(0, 0) + at(1, 1) - at(2, 2),
    1 - at(0, 0) - at(1, 1) + at(2, 2),
  ];
  const [a, b, c] = [at(2, 1) - at(1, 2), at(0, 2) - at(2, 0), at(1, 0) - at(0, 1)];
  const [d, e, f] = [at(1, 0) + at(0, 1), at(0, 2) + at(2, 0), at(2, 1) + at(1, 2)];
  const best = t.indexOf(Math.max(...t));
  const q = [[t[0], a, b, c], [a, t[1], d, e], [b, d, t[2], f], [c, e, f, t[3]]][best];
  const s = Math.hypot(...q);
  return q.map((x) => x / s);
}

// A part of the way from one quaternion to another, by the shorter way; not of length 1.
function quaternionBetween(a, b, part) {
  const way = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] < 0 ? -1 : 1;
  return a.map((x, i) => x * (1 - part) + way * b[i] * part);
}
