//! Energies as numbers: the fields of neighbours, and matrices in parts whose flows are rotations.

use alloc::vec::Vec;

use coadjoint_geometry::number::Number;
use coadjoint_geometry::vector::{V3, plus_by, sum};
use nalgebra::{Matrix3, Vector3};

use super::colours;
use super::graph::Edge;
use super::lanes::Pack;
use super::layout::{Adjacency, Copies, Neighbours, Places, Vectors, row};

/// The energies of a lattice.
#[derive(Clone, Debug, Default)]
pub struct Energies {
    /// Edges (a, b) with the energy a·M b.
    pub bonds: Vec<(Vec<Edge>, Matrix3<f64>)>,
    /// Of each site s: f·s
    pub field: Vector3<f64>,
    /// Of each site s: s·A s
    pub anisotropy: Matrix3<f64>,
}

/// A matrix of a coupling, in the way that is cheapest to apply.
#[derive(Clone, Copy)]
enum Applied {
    Isotropic(f64),
    Diagonal([f64; 3]),
    Full([[f64; 3]; 3]),
}

/// Neighbours whose spins have one matrix before them in the field.
struct Bundle {
    matrix: Matrix3<f64>,
    applied: Applied,
    neighbours: Neighbours,
}

/// The neighbours of sites, and the fields they make.
pub struct Couplings {
    groups: Vec<Bundle>,
    pub places: Places,
    pub copies: Copies,
}

impl Couplings {
    pub fn new(sites: usize, bonds: &[(Vec<Edge>, Matrix3<f64>)]) -> Self {
        let turned = |[a, b]: Edge| [b, a];
        let edges = || bonds.iter().flat_map(|(edges, _)| edges);
        let all = Adjacency::new(sites, || edges().flat_map(|edge| [*edge, turned(*edge)]));
        let (colours, count) = colours::sites(&all);
        let places = Places::new(&colours, count);
        let mut matrices: Vec<Matrix3<f64>> = Vec::new();
        for (_, matrix) in bonds {
            for matrix in [*matrix, matrix.transpose()] {
                if !matrices.contains(&matrix) {
                    matrices.push(matrix);
                }
            }
        }
        let adjacency = matrices.iter().map(|matrix| {
            let directed = || {
                bonds.iter().flat_map(|(edges, own)| {
                    let ahead = (own == matrix).then_some(edges).into_iter().flatten();
                    let back = (own.transpose() == *matrix).then_some(edges).into_iter().flatten();
                    ahead.copied().chain(back.map(|edge| turned(*edge)))
                })
            };
            Adjacency::new(sites, directed)
        });
        let (copies, neighbours) = Copies::new(&places, &adjacency.collect::<Vec<_>>());
        let group = |(matrix, neighbours): (Matrix3<f64>, Neighbours)| {
            let diagonal = Matrix3::from_diagonal(&matrix.diagonal()) == matrix;
            let applied = match <[f64; 3]>::from(matrix.diagonal()) {
                [x, y, z] if diagonal && x == y && y == z => Applied::Isotropic(x),
                list if diagonal => Applied::Diagonal(list),
                _ => Applied::Full([0, 1, 2].map(|i| [0, 1, 2].map(|j| matrix[(i, j)]))),
            };
            Bundle { matrix, applied, neighbours }
        };
        Self { groups: matrices.into_iter().zip(neighbours).map(group).collect(), places, copies }
    }

    /// The matrices, in the order of the weights of [`Couplings::along`].
    pub fn matrices(&self) -> impl Iterator<Item = &Matrix3<f64>> {
        self.groups.iter().map(|group| &group.matrix)
    }

    /// The most neighbours of a site that have each matrix, in the same order.
    pub fn most(&self) -> impl Iterator<Item = f64> {
        self.groups.iter().map(|group| f64::from(group.neighbours.most()))
    }

    /// `fields` and those of the neighbours of a pack of sites, for several states side by side.
    #[inline(always)]
    pub fn fields<const M: usize>(
        &self,
        mut fields: [V3<Pack>; M],
        spins: [impl Vectors; M],
        pack: usize,
    ) -> [V3<Pack>; M] {
        for group in &self.groups {
            let mut sums = [[Pack::of(0.0); 3]; M];
            for &start in group.neighbours.of(pack) {
                for i in 0..M {
                    sums[i] = sum(sums[i], spins[i].row(start as usize));
                }
            }
            for i in 0..M {
                match &group.applied {
                    Applied::Isotropic(factor) => fields[i] = plus_by(fields[i], *factor, sums[i]),
                    Applied::Diagonal(factors) => {
                        for axis in 0..3 {
                            fields[i][axis] = sums[i][axis].by_plus(factors[axis], fields[i][axis]);
                        }
                    }
                    Applied::Full(matrix) => fields[i] = multiplied(fields[i], matrix, sums[i]),
                }
            }
        }
        fields
    }

    /// The sum of one number of each neighbour of a pack of sites, those of each matrix by its weight.
    #[inline(always)]
    pub fn along(&self, weights: &[f64], numbers: &[f64], pack: usize) -> Pack {
        let mut total = Pack::of(0.0);
        for (at, group) in self.groups.iter().enumerate() {
            let mut sum = Pack::of(0.0);
            for &start in group.neighbours.of(pack) {
                sum = sum + row(numbers, start as usize);
            }
            total = sum.by_plus(weights[at], total);
        }
        total
    }
}

/// constant + matrix·v
#[inline(always)]
pub fn multiplied(mut constant: V3<Pack>, matrix: &[[f64; 3]; 3], v: V3<Pack>) -> V3<Pack> {
    for i in 0..3 {
        for j in 0..3 {
            constant[i] = v[j].by_plus(matrix[i][j], constant[i]);
        }
    }
    constant
}

/// The energy factor (left·a)(right·b), of unit vectors: a turns about `left`, b about `right`.
#[derive(Clone, Copy, Debug)]
pub struct Dyad {
    pub factor: f64,
    pub left: [f64; 3],
    pub right: [f64; 3],
}

/// Entries below this multiple of the largest one are rounding.
const ROUNDING: f64 = 1e-14;

/// A matrix as isotropic + Σ dyads, with the fewest dyads.
pub fn dyads(matrix: &Matrix3<f64>) -> (f64, Vec<Dyad>) {
    let symmetric = (matrix + matrix.transpose()) * 0.5;
    // For matrices that are diagonal already these are exact.
    let values: [f64; 3] = match Matrix3::from_diagonal(&symmetric.diagonal()) == symmetric {
        true => symmetric.diagonal().into(),
        false => symmetric.symmetric_eigenvalues().into(),
    };
    let rest = |isotropic: f64| {
        let mut rest = matrix - Matrix3::identity() * isotropic;
        rest.iter_mut().filter(|v| v.abs() <= ROUNDING * matrix.amax()).for_each(|v| *v = 0.0);
        let parts = rest.svd(true, true);
        let mut list = Vec::new();
        for at in 0..3 {
            let factor = parts.singular_values[at];
            if let (Some(left), Some(right)) = (&parts.u, &parts.v_t)
                && factor > ROUNDING * matrix.amax()
            {
                let (left, right) = (left.column(at), right.row(at));
                list.push(Dyad {
                    factor,
                    left: [left[0], left[1], left[2]],
                    right: [right[0], right[1], right[2]],
                });
            }
        }
        (isotropic, list)
    };
    let tried = values.into_iter().chain([0.0]).map(rest);
    tried
        .min_by_key(|(isotropic, list)| 2 * list.len() + usize::from(*isotropic != 0.0))
        .unwrap_or_default()
}

/// Directions in whose squares every symmetric matrix is a sum: the axes, and those halfway between two of them.
pub fn directions() -> [[f64; 3]; 6] {
    const HALF: f64 = core::f64::consts::FRAC_1_SQRT_2;
    [
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [HALF, HALF, 0.0],
        [0.0, HALF, HALF],
        [HALF, 0.0, HALF],
    ]
}

/// A symmetric matrix as Σ cₖ dₖ dₖᵀ over the [`directions`].
pub fn by_directions(matrix: &Matrix3<f64>) -> [f64; 6] {
    let [xy, yz, xz] = [matrix[(0, 1)], matrix[(1, 2)], matrix[(0, 2)]];
    let [x, y, z]: [f64; 3] = matrix.diagonal().into();
    [x - xy - xz, y - xy - yz, z - yz - xz, 2.0 * xy, 2.0 * yz, 2.0 * xz]
}
