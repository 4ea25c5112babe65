//! Coadjoint orbits of three-dimensional algebras as surfaces, and the level curves of the energy on them.

use std::collections::HashMap;

use coadjoint_codegen::poly::Numeric;
use coadjoint_codegen::step::Energy;

use crate::system::START;

/// Cells of the grid along an axis.
const CELLS: usize = 34;
/// Surfaces other than spheres are looked at up to this multiple of |μ|.
const EXTENT: f64 = 1.7;
/// Curves of the energy.
const LEVELS: usize = 14;

/// A surface C(μ) = c in ℝ³ as triangles.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Its radius where it is a sphere about 0.
    pub radius: Option<f64>,
    /// The largest coordinate.
    pub extent: f64,
}

/// A curve: points, and the normals of the surface there.
pub type Curve = Vec<[f64; 6]>;

/// An orbit with the energy on it.
#[derive(Clone, Debug)]
pub struct Orbit {
    pub surface: Surface,
    /// The curves of evenly spread values of the energy.
    pub spread: Vec<Curve>,
    values: Vec<f64>,
    slopes: Vec<Numeric>,
}

impl Orbit {
    /// The orbit through μ; none where it is no surface.
    pub fn new(energy: &Energy<'_>, casimir: &Numeric, mu: &[f64]) -> Option<Self> {
        let surface = Surface::new(casimir, mu)?;
        let values: Vec<f64> = surface.points.iter().map(|p| energy.value(START, p)).collect();
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let least = finite().fold(f64::INFINITY, f64::min);
        let most = finite().fold(f64::NEG_INFINITY, f64::max);
        let slopes = casimir.gradient(3);
        let level = |i: usize| least + (most - least) * (i as f64 + 0.5) / LEVELS as f64;
        let spread =
            (0..LEVELS).flat_map(|i| surface.level_curves(&values, level(i), &slopes)).collect();
        Some(Self { surface, spread, values, slopes })
    }

    /// The curves of this energy.
    pub fn level(&self, energy: f64) -> Vec<Curve> {
        self.surface.level_curves(&self.values, energy, &self.slopes)
    }

    /// True if this is a sphere with μ on it, to a relative error of 1e-5.
    pub fn holds(&self, mu: &[f64]) -> bool {
        let size = mu.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        self.surface.radius.is_some_and(|radius| (size - radius).abs() < 1e-5 * radius)
    }
}

impl Surface {
    /// The orbit through μ, given the Casimir; none where μ or the Casimir is nothing.
    pub fn new(casimir: &Numeric, mu: &[f64]) -> Option<Self> {
        let size = mu.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let sphere = is_sphere(casimir);
        let extent = if sphere { 1.05 * size } else { EXTENT * size };
        let mut surface = Self::level(casimir, casimir.value(mu), extent);
        if sphere {
            surface.points.iter_mut().for_each(|p| *p = unit(*p).map(|x| x * size));
            (surface.radius, surface.extent) = (Some(size), size);
        }
        Some(surface).filter(|surface| !surface.triangles.is_empty())
    }

    /// Finds a level surface by marching tetrahedra, six in a cell.
    fn level(casimir: &Numeric, level: f64, extent: f64) -> Self {
        let side = CELLS + 1;
        // Off the symmetric places, where values are exactly the level's.
        let at = |i: usize| extent * ((2.0 * i as f64 + 0.0137) / CELLS as f64 - 1.0);
        let corner = |n: usize| [at(n % side), at(n / side % side), at(n / side / side)];
        let values: Vec<f64> =
            (0..side * side * side).map(|n| casimir.value(&corner(n)) - level).collect();
        let mut surface = Self { extent, ..Self::default() };
        let mut known: HashMap<(usize, usize), u32> = HashMap::new();
        const STEPS: [[usize; 2]; 6] = [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]];
        let strides = [1, side, side * side];
        for cell in 0..CELLS * CELLS * CELLS {
            let (i, j, k) = (cell % CELLS, cell / CELLS % CELLS, cell / CELLS / CELLS);
            let base = i + j * side + k * side * side;
            for [first, second] in STEPS {
                let one = base + strides[first];
                let two = one + strides[second];
                let tetrahedron = [base, one, two, base + 1 + side + side * side];
                let (inside, outside): (Vec<usize>, Vec<usize>) =
                    tetrahedron.into_iter().partition(|&n| values[n] < 0.0);
                let mut cut = |a: usize, b: usize| {
                    *known.entry((a.min(b), a.max(b))).or_insert_with(|| {
                        let (a, b) = (a.min(b), a.max(b));
                        let part = values[a] / (values[a] - values[b]);
                        let (p, q) = (corner(a), corner(b));
                        surface.points.push([0, 1, 2].map(|x| p[x] + part * (q[x] - p[x])));
                        surface.points.len() as u32 - 1
                    })
                };
                match (&inside[..], &outside[..]) {
                    (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => {
                        let triangle = [cut(a, b), cut(a, c), cut(a, d)];
                        surface.triangles.push(triangle);
                    }
                    (&[a, b], &[c, d]) => {
                        let [p, q, r, s] = [cut(a, c), cut(a, d), cut(b, d), cut(b, c)];
                        surface.triangles.extend([[p, q, r], [p, r, s]]);
                    }
                    _ => {}
                }
            }
        }
        surface
    }

    fn level_curves(&self, values: &[f64], level: f64, slopes: &[Numeric]) -> Vec<Curve> {
        type Edge = (u32, u32);
        let mut neighbours: HashMap<Edge, Vec<Edge>> = HashMap::new();
        let mut order: Vec<Edge> = Vec::new();
        let above = |n: u32| values[n as usize] >= level;
        let known = |n: u32| values[n as usize].is_finite();
        for &[a, b, c] in &self.triangles {
            let cut: Vec<Edge> = [(a, b), (b, c), (c, a)]
                .into_iter()
                .filter(|&(a, b)| above(a) != above(b) && known(a) && known(b))
                .map(|(a, b)| (a.min(b), a.max(b)))
                .collect();
            if let &[one, two] = &cut[..] {
                for (from, to) in [(one, two), (two, one)] {
                    neighbours
                        .entry(from)
                        .or_insert_with(|| {
                            order.push(from);
                            Vec::new()
                        })
                        .push(to);
                }
            }
        }
        let mut used: HashMap<Edge, bool> = HashMap::new();
        let mut curves = Vec::new();
        // Open curves from their ends first.
        let ends = order.iter().filter(|edge| neighbours[edge].len() == 1);
        for &start in ends.chain(&order) {
            if used.contains_key(&start) {
                continue;
            }
            let mut line = vec![start];
            used.insert(start, true);
            let mut at = start;
            while let Some(&next) = neighbours[&at].iter().find(|next| !used.contains_key(next)) {
                used.insert(next, true);
                line.push(next);
                at = next;
            }
            if line.len() > 2 && neighbours[&at].contains(&start) {
                line.push(start);
            }
            curves.push(line.iter().map(|&edge| self.point(values, level, edge, slopes)).collect());
        }
        curves
    }

    /// The point on an edge, and the normal there.
    fn point(
        &self,
        values: &[f64],
        level: f64,
        (a, b): (u32, u32),
        slopes: &[Numeric],
    ) -> [f64; 6] {
        let (a, b) = (a as usize, b as usize);
        let part = (level - values[a]) / (values[b] - values[a]);
        let mut p =
            [0, 1, 2].map(|x| self.points[a][x] + part * (self.points[b][x] - self.points[a][x]));
        if let Some(radius) = self.radius {
            p = unit(p).map(|x| x * radius);
        }
        let n = unit([0, 1, 2].map(|x| slopes[x].value(&p)));
        [p[0], p[1], p[2], n[0], n[1], n[2]]
    }
}

fn unit(p: [f64; 3]) -> [f64; 3] {
    let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
    p.map(|x| x / size)
}

/// True for multiples of μ₁² + μ₂² + μ₃².
fn is_sphere(casimir: &Numeric) -> bool {
    let terms: Vec<_> = casimir.terms().collect();
    terms.len() == 3
        && terms.iter().all(|(value, factors)| *value == terms[0].0 && matches!(factors, [(_, 2)]))
}
