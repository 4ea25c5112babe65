//! Energies as numbers: the fields of neighbours, and matrices in parts whose flows are rotations.

use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt;

use coadjoint_geometry::number::Number;
use coadjoint_geometry::vector::{V3, plus, plus_by, sum};
use nalgebra::{Matrix3, Vector3};

use super::colours;
use super::graph::Edge;
use super::lanes::Pack;
use super::layout::{Adjacency, Column, Copies, Neighbours, Places, Vectors, row};

/// The energies of a lattice.
#[derive(Clone, Debug, Default)]
pub struct Energies {
    pub bonds: Vec<Bond>,
    /// Of each site s: f·s
    pub field: Vector3<f64>,
    /// Of each site s: s·A s
    pub anisotropy: Matrix3<f64>,
    /// Energies that are not those of all sites.
    pub own: Vec<Own>,
    /// A field on all sites that depends on time: ∂H/∂s.
    pub driven: Option<UserFunction<dyn Fn(f64) -> [f64; 3] + Send + Sync>>,
    /// The velocity of a site beside ω = ∂H/∂s is Γ (s × ω) with this diagonal of Γ, and a function of t, its number, s and ω.
    pub damping: [f64; 3],
    pub velocity: Option<UserFunction<Velocity>>,
}

/// The velocity of a site by the time, its number, its spin s and ω = ∂H/∂s.
pub type Velocity = dyn Fn(f64, usize, [f64; 3], [f64; 3]) -> [f64; 3] + Send + Sync;

/// Edges (a, b) with the energy a·M b, times a factor for each if there are any.
#[derive(Clone, Debug)]
pub struct Bond {
    pub edges: Vec<Edge>,
    pub matrix: Matrix3<f64>,
    pub factors: Option<Vec<f64>>,
}

/// The energies linear·c + ½ square·c² of sites, c their component along a direction; none where a list is empty.
#[derive(Clone, Debug)]
pub struct Own<L = Vec<f64>> {
    pub direction: [f64; 3],
    pub linear: L,
    pub square: L,
}

/// A function that a user gave.
pub struct UserFunction<F: ?Sized>(pub Arc<F>);

impl<F: ?Sized> Clone for UserFunction<F> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<F: ?Sized> fmt::Debug for UserFunction<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("UserFunction")
    }
}

impl Energies {
    /// True if sites have a velocity beside that of the energy.
    pub fn is_driven(&self) -> bool {
        self.velocity.is_some() || self.damping != [0.0; 3]
    }

    /// Adds factor·(f·s + s·A s), with a factor for each site.
    pub fn add_own(&mut self, factors: &[f64], field: Vector3<f64>, anisotropy: Matrix3<f64>) {
        let linear = [field.x, field.y, field.z, 0.0, 0.0, 0.0];
        let square = by_directions(&(2.0 * anisotropy));
        for (at, direction) in directions().into_iter().enumerate() {
            if [linear[at], square[at]] == [0.0; 2] {
                continue;
            }
            let known = self.own.iter().position(|own| own.direction == direction);
            let known = known.unwrap_or_else(|| {
                self.own.push(Own { direction, linear: Vec::new(), square: Vec::new() });
                self.own.len() - 1
            });
            let Own { linear: of_linear, square: of_square, .. } = &mut self.own[known];
            for (list, weight) in [(of_linear, linear[at]), (of_square, square[at])] {
                if weight != 0.0 {
                    list.resize(factors.len(), 0.0);
                    list.iter_mut().zip(factors).for_each(|(sum, own)| *sum += own * weight);
                }
            }
        }
    }
}

impl Own {
    /// The energy of a site, and its derivative by the component.
    pub fn of(&self, site: usize, spin: [f64; 3]) -> [f64; 2] {
        let along: f64 = spin.iter().zip(self.direction).map(|(s, d)| s * d).sum();
        let number = |list: &Vec<f64>| list.get(site).copied().unwrap_or(0.0);
        let (linear, square) = (number(&self.linear), number(&self.square));
        [along * (linear + 0.5 * square * along), linear + square * along]
    }

    /// The numbers at the places of sites.
    pub fn placed(&self, places: &Places) -> Own<Option<Column>> {
        let column = |list: &Vec<f64>| (!list.is_empty()).then(|| places.column(list, 4));
        let (linear, square) = (column(&self.linear), column(&self.square));
        Own { direction: self.direction, linear, square }
    }
}

impl Own<Option<Column>> {
    /// The derivative by the component along the direction, which is `along`, of a pack from this place on.
    #[inline(always)]
    pub fn rate(&self, along: Pack, place: usize) -> Pack {
        let number = |column: &Column| row(column.all(), place);
        let linear = self.linear.as_ref().map_or(Pack::of(0.0), number);
        self.square.as_ref().map_or(linear, |square| number(square).times_plus(along, linear))
    }

    /// The largest derivative of spins of length zero, and by how much it grows with their length.
    pub fn speed(&self) -> [f64; 2] {
        let largest = |column: &Option<Column>| {
            let all = column.iter().flat_map(|column| column.all());
            all.fold(0.0_f64, |largest, number| largest.max(number.abs()))
        };
        [largest(&self.linear), largest(&self.square)]
    }
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
    /// The first bit in which the colours of the ends differ, of matrices that are not symmetric, where groups are by it.
    bit: Option<u32>,
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
    /// Neighbours in groups, by the matrix before them; with `by_bits` those whose matrix is not symmetric are also in groups by
    /// the first bit in which the colours of the two sites differ.
    pub fn new(sites: usize, bonds: &[Bond], by_bits: bool) -> Self {
        let edges = || bonds.iter().flat_map(|bond| &bond.edges);
        let all = Adjacency::new(sites, || edges().flat_map(|&[a, b]| [(a, b), (b, a)]));
        let (colours, count) = colours::sites(&all);
        let places = Places::new(&colours, count);
        let bit_of = |matrix: &Matrix3<f64>, [a, b]: Edge| {
            let differ = colours[a as usize] ^ colours[b as usize];
            (by_bits && *matrix != matrix.transpose()).then_some(differ.trailing_zeros())
        };
        // Bonds with factors have lists of their own.
        let mut matrices: Vec<(Matrix3<f64>, Option<usize>, Option<u32>)> = Vec::new();
        for (number, Bond { edges, matrix, factors }) in bonds.iter().enumerate() {
            let mut bits: Vec<_> = edges.iter().map(|edge| bit_of(matrix, *edge)).collect();
            bits.sort_unstable();
            bits.dedup();
            for (matrix, bit) in [*matrix, matrix.transpose()]
                .iter()
                .flat_map(|m| bits.iter().map(move |b| (*m, *b)))
            {
                let key = (matrix, factors.is_some().then_some(number), bit);
                if !matrices.contains(&key) {
                    matrices.push(key);
                }
            }
        }
        let adjacency = matrices.iter().map(|(matrix, number, bit)| {
            let of = |at: usize, bond: &Bond| match number {
                Some(number) => at == *number,
                None => bond.factors.is_none(),
            };
            let those = || bonds.iter().enumerate().filter(|(at, bond)| of(*at, bond));
            // The number of an edge of a bond, from one of its ends to the other.
            let directed = || {
                those().flat_map(|(_, Bond { edges, matrix: own, .. })| {
                    let numbered = move |taken: bool| {
                        let all = taken.then_some(edges).into_iter().flatten().enumerate();
                        all.filter(move |(_, edge)| bit_of(own, **edge) == *bit)
                    };
                    let ahead = numbered(own == matrix);
                    let back = numbered(own.transpose() == *matrix);
                    let ahead = ahead.map(|(at, &[a, b])| (a, b, at));
                    ahead.chain(back.map(|(at, &[a, b])| (b, a, at)))
                })
            };
            let factors = number.and_then(|number| bonds[number].factors.as_ref());
            let factors = factors.map(|factors| {
                Adjacency::new(sites, || directed().map(|(from, _, at)| (from, factors[at])))
            });
            (Adjacency::new(sites, || directed().map(|(from, to, _)| (from, to))), factors)
        });
        let (copies, neighbours) = Copies::new(&places, &adjacency.collect::<Vec<_>>());
        let matrices = matrices.into_iter().map(|(matrix, _, bit)| (matrix, bit));
        let group = |((matrix, bit), neighbours): ((Matrix3<f64>, Option<u32>), Neighbours)| {
            let diagonal = Matrix3::from_diagonal(&matrix.diagonal()) == matrix;
            let applied = match <[f64; 3]>::from(matrix.diagonal()) {
                [x, y, z] if diagonal && x == y && y == z => Applied::Isotropic(x),
                list if diagonal => Applied::Diagonal(list),
                _ => Applied::Full([0, 1, 2].map(|i| [0, 1, 2].map(|j| matrix[(i, j)]))),
            };
            Bundle { matrix, bit, applied, neighbours }
        };
        Self { groups: matrices.zip(neighbours).map(group).collect(), places, copies }
    }

    /// The matrices, in the order of the weights of [`Couplings::along`].
    pub fn matrices(&self) -> impl Iterator<Item = &Matrix3<f64>> {
        self.groups.iter().map(|group| &group.matrix)
    }

    /// The bits of [`Couplings::new`], in the same order.
    pub fn bits(&self) -> impl Iterator<Item = Option<u32>> {
        self.groups.iter().map(|group| group.bit)
    }

    /// The most neighbours of a site that have each matrix, in the same order, times the largest factor.
    pub fn most(&self) -> impl Iterator<Item = f64> {
        let lists = self.groups.iter().map(|group| &group.neighbours);
        lists.map(|list| f64::from(list.most()) * list.largest())
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
            group.neighbours.each(
                pack,
                #[inline(always)]
                |start, factor| {
                    for i in 0..M {
                        let own = spins[i].row(start);
                        sums[i] = match factor {
                            Some(factor) => plus(sums[i], factor, own),
                            None => sum(sums[i], own),
                        };
                    }
                },
            );
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
        for (at, group) in self.groups.iter().enumerate().filter(|(at, _)| weights[*at] != 0.0) {
            let mut sum = Pack::of(0.0);
            group.neighbours.each(
                pack,
                #[inline(always)]
                |start, factor| {
                    let own = row(numbers, start);
                    sum = factor.map_or(sum + own, |factor| own.times_plus(factor, sum));
                },
            );
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
