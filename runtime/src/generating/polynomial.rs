//! A generating function given by its terms.

use alloc::vec::Vec;
use core::marker::PhantomData;

use coadjoint_program::fold::{gradient_bound, radius};
use coadjoint_program::limits::LARGEST_RATIO;
use nalgebra::ComplexField;

use crate::chart::Chart;
use crate::generating::series;
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;
use crate::table::dynamic::TableError;

/// The polynomial S(p) = Σ c·∏ pᵢ^power as a generating function on the group `G` in the chart
/// `C`: a series derived elsewhere, or any polynomial at all.
///
/// ```
/// use coadjoint::{Phase, SO3};
/// use coadjoint::generating::PolynomialFunction;
/// use coadjoint::groups::Exponential;
/// use coadjoint::steps::advance;
/// use nalgebra::Vector3;
///
/// // The rigid body at truncation 1: S = h·H.
/// let h = 0.1;
/// let terms = [(h / 3.0, vec![(0, 2)]), (h / 4.0, vec![(1, 2)]), (h / 5.0, vec![(2, 2)])];
/// let map = PolynomialFunction::new(SO3::new(), Exponential, terms)?;
/// let mut body = Phase::<SO3>::at_identity(Vector3::new(2.0, 0.5, 1.0));
/// advance(&map, &mut body)?;
/// assert!((body.momentum.norm_squared() - 5.25_f64).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PolynomialFunction<G, C> {
    group: G,
    chart: PhantomData<C>,
    terms: Vec<(f64, Vec<(usize, u32)>)>,
    /// The data by which a truncated series is judged, if S is one.
    series: Option<TruncatedSeries>,
}

/// A term of S_K or S_{K−2} as (coefficient, whether it is one of S_K, monomial).
type LastTerm = (f64, bool, Vec<(u32, u32)>);

#[derive(Clone, Debug)]
struct TruncatedSeries {
    last: Vec<LastTerm>,
    /// The direct factor of the group that each coordinate belongs to.
    factors: Vec<u32>,
    /// Up to which |p| of each factor their ratio is at most ½ in every direction.
    radius: f64,
}

impl<G: LieGroup, C: Chart<G>> PolynomialFunction<G, C> {
    /// The polynomial with these terms (c, [(i, power), …]); factors of the same coordinate are
    /// merged.
    ///
    /// # Errors
    /// [`TableError::IndexOutOfRange`] for a coordinate the group does not have.
    pub fn new(
        group: G,
        _chart: C,
        terms: impl IntoIterator<Item = (f64, Vec<(usize, u32)>)>,
    ) -> Result<Self, TableError> {
        let dim = group.dim();
        let merged = |(c, mut factors): (f64, Vec<(usize, u32)>)| {
            factors.retain(|factor| factor.1 > 0);
            factors.sort_unstable();
            factors.dedup_by(|next, last| {
                let same = next.0 == last.0;
                last.1 += if same { next.1 } else { 0 };
                same
            });
            match factors.last() {
                Some(&(index, _)) if index >= dim => {
                    Err(TableError::IndexOutOfRange { index, dim })
                }
                _ => Ok((c, factors)),
            }
        };
        let terms = terms.into_iter().map(merged).collect::<Result<_, _>>()?;
        Ok(Self { group, chart: PhantomData, terms, series: None })
    }

    /// The truncated series with these terms (order k of the S_k they belong to, c, [(i, power), …]): steps are then
    /// judged by the ratio of its last two terms, too.
    ///
    /// # Errors
    /// As [`PolynomialFunction::new`].
    pub fn of_series(
        group: G,
        chart: C,
        terms: impl IntoIterator<Item = (usize, f64, Vec<(usize, u32)>)>,
    ) -> Result<Self, TableError> {
        let terms: Vec<_> = terms.into_iter().collect();
        let truncation = terms.iter().map(|term| term.0).max().unwrap_or(0);
        let last = terms.iter().filter(|term| truncation > 1 && term.0 + 2 >= truncation);
        let last: Vec<_> = last
            .map(|(order, c, monomial)| {
                let monomial = monomial.iter().map(|&(i, power)| (i as u32, power));
                (*c, *order == truncation, monomial.collect::<Vec<_>>())
            })
            .collect();
        let factors = factor_of_coordinates(&group);
        let function = Self::new(group, chart, terms.into_iter().map(|(_, c, f)| (c, f)))?;
        let factor_of = |i: u32| factors.get(i as usize).copied().unwrap_or(0);
        let count = factors.last().map_or(0, |last| last + 1);
        let counted = last.iter().flat_map(|(c, highest, monomial)| {
            (0..count).filter_map(move |factor| {
                let bound = gradient_bound(monomial, factor_of, factor, ComplexField::sqrt);
                let (degree, weight) = bound?;
                Some((*c, (0, factor, *highest, degree, weight)))
            })
        });
        let radius = radius(counted, LARGEST_RATIO);
        Ok(Self { series: Some(TruncatedSeries { last, factors, radius }), ..function })
    }
}

/// The number of the direct factor that each coordinate belongs to, ascending from 0: consecutive coordinates belong to one
/// where a bracket leads across.
fn factor_of_coordinates<G: LieGroup>(group: &G) -> Vec<u32> {
    let dim = group.dim();
    let mut begins = alloc::vec![true; dim];
    for (i, k) in (0..dim * dim).map(|at| (at / dim, at % dim)) {
        // Not zero for the j where [e_i, e_j] leads to e_k.
        let constants = group.ad_star(&G::Vector::unit(dim, i), &G::Vector::unit(dim, k));
        for j in (0..dim).filter(|&j| constants[j].largest_lane() != 0.0) {
            begins[i.min(j).min(k) + 1..=i.max(j).max(k)].fill(false);
        }
    }
    let mut factor = 0;
    let count = |(i, begins): (usize, bool)| {
        factor += u32::from(begins && i > 0);
        factor
    };
    begins.into_iter().enumerate().map(count).collect()
}

/// c ∏ pᵢ^power, each power less what is lowered of the factor at that place.
fn product<T: Scalar, V: Coordinates<T>>(
    c: f64,
    factors: &[(usize, u32)],
    p: &V,
    lowered: impl Fn(usize) -> u32,
) -> T {
    factors.iter().enumerate().fold(T::of(c), |product, (at, &(i, power))| {
        (lowered(at)..power).fold(product, |product, _| product * p[i])
    })
}

impl<G: LieGroup, C: Chart<G>> GeneratingFunction for PolynomialFunction<G, C> {
    type Group = G;
    type Chart = C;

    fn group(&self) -> &G {
        &self.group
    }

    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let terms = self.terms.iter();
        terms.fold(Scalar::of(0.0), |sum, (c, factors)| sum + product(*c, factors, p, |_| 0))
    }

    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        let mut x = VectorOf::<Self>::zeros(self.group.dim());
        for (c, factors) in &self.terms {
            for (at, &(i, n)) in factors.iter().enumerate() {
                x[i] += product(c * f64::from(n), factors, p, |other| u32::from(other == at));
            }
        }
        x
    }

    fn radius(&self) -> ScalarOf<Self> {
        Scalar::of(self.series.as_ref().map_or(f64::MAX, |series| series.radius))
    }

    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let Some(TruncatedSeries { last, factors, .. }) = &self.series else {
            return Scalar::of(0.0);
        };
        let terms = last.iter();
        let terms = terms.map(|(c, highest, monomial)| (Scalar::of(*c), *highest, &monomial[..]));
        let mut sums = alloc::vec![[Scalar::of(0.0); 2]; factors.len()];
        series::ratio(factors, terms, &mut sums, |i| p[i])
    }

    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        let mut hessian = VectorOf::<Self>::zero_matrix(self.group.dim());
        for (c, factors) in &self.terms {
            for (first, &(i, n)) in factors.iter().enumerate() {
                for (second, &(j, m)) in factors.iter().enumerate().take(first + 1) {
                    let degrees = if first == second { n * (n - 1) } else { n * m };
                    if degrees == 0 {
                        continue;
                    }
                    let lowered = |at| u32::from(at == first) + u32::from(at == second);
                    let entry = product(c * f64::from(degrees), factors, p, lowered);
                    hessian[(i, j)] += entry;
                    if i != j {
                        hessian[(j, i)] += entry;
                    }
                }
            }
        }
        (self.gradient(p), hessian)
    }
}
