//! A generating function given by its terms.

use alloc::vec::Vec;
use core::marker::PhantomData;

use crate::chart::Chart;
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf, series};
use crate::group::LieGroup;
use crate::linear::coordinates::Coordinates;
use crate::number::scalar::Scalar;
use crate::table::TableError;

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
    coefficients: Vec<f64>,
    /// Where the factors of each term end in `factors`.
    ends: Vec<usize>,
    factors: Vec<(usize, u32)>,
    /// Where it is a truncated series, how that is judged.
    series: Option<TruncatedSeries>,
}

/// A term of S_K or S_{K−2} as (coefficient, whether it is one of S_K, monomial).
type LastTerm = (f64, bool, Vec<(u32, u32)>);

/// The last two terms of a truncated series.
#[derive(Clone, Debug)]
struct TruncatedSeries {
    /// The terms of S_K and S_{K−2}.
    last: Vec<LastTerm>,
    /// The direct factor of the group that each coordinate belongs to.
    factors: Vec<u32>,
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
        let mut result = Self {
            group,
            chart: PhantomData,
            coefficients: Vec::new(),
            ends: Vec::new(),
            factors: Vec::new(),
            series: None,
        };
        for (c, mut factors) in terms {
            factors.retain(|f| f.1 > 0);
            if let Some(&(index, _)) = factors.iter().find(|f| f.0 >= dim) {
                return Err(TableError::IndexOutOfRange { index, dim });
            }
            factors.sort_unstable();
            let start = result.factors.len();
            for (i, power) in factors {
                // Of this term alone: the last factor may still be one of the term before.
                match result.factors.get_mut(start..).and_then(<[_]>::last_mut) {
                    Some(last) if last.0 == i => last.1 += power,
                    _ => result.factors.push((i, power)),
                }
            }
            result.coefficients.push(c);
            result.ends.push(result.factors.len());
        }
        Ok(result)
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
        Ok(Self { series: Some(TruncatedSeries { last, factors }), ..function })
    }

    fn terms(&self) -> impl Iterator<Item = (f64, &[(usize, u32)])> {
        let mut start = 0;
        self.coefficients.iter().zip(&self.ends).map(move |(&c, &end)| {
            let factors = self.factors.get(start..end).unwrap_or_default();
            start = end;
            (c, factors)
        })
    }
}

/// The number of the direct factor that each coordinate belongs to, ascending from 0: consecutive coordinates belong to one
/// where a bracket leads across.
fn factor_of_coordinates<G: LieGroup>(group: &G) -> Vec<u32> {
    let dim = group.dim();
    let one = |i| {
        let entry = |j| G::Scalar::of(if i == j { 1.0 } else { 0.0 });
        G::Vector::from_entries(dim, entry)
    };
    let mut begins = alloc::vec![true; dim];
    for i in 0..dim {
        for j in i + 1..dim {
            let bracket = group.bracket(&one(i), &one(j));
            let reached = (0..dim).filter(|&k| bracket[k].largest_lane() != 0.0);
            let (first, last) = reached.fold((dim, 0), |(a, b), k| (a.min(k), b.max(k)));
            if first < dim {
                begins[first.min(i) + 1..=last.max(j)].fill(false);
            }
        }
    }
    let mut factor = 0;
    let count = |(i, begins): (usize, bool)| {
        factor += u32::from(begins && i > 0);
        factor
    };
    begins.into_iter().enumerate().map(count).collect()
}

/// p^power
fn power<T: Scalar>(p: T, power: u32) -> T {
    let mut result = T::of(1.0);
    for _ in 0..power {
        result *= p;
    }
    result
}

impl<G: LieGroup, C: Chart<G>> GeneratingFunction for PolynomialFunction<G, C> {
    type Group = G;
    type Chart = C;

    fn group(&self) -> &G {
        &self.group
    }

    fn value(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let mut sum = ScalarOf::<Self>::of(0.0);
        for (c, factors) in self.terms() {
            let mut product = ScalarOf::<Self>::of(c);
            for &(i, n) in factors {
                product *= power(p[i], n);
            }
            sum += product;
        }
        sum
    }

    fn gradient(&self, p: &VectorOf<Self>) -> VectorOf<Self> {
        let mut x = VectorOf::<Self>::zeros(self.group.dim());
        for (c, factors) in self.terms() {
            for (at, &(i, n)) in factors.iter().enumerate() {
                let mut product = ScalarOf::<Self>::of(c * f64::from(n)) * power(p[i], n - 1);
                for (other, &(j, m)) in factors.iter().enumerate() {
                    if other != at {
                        product *= power(p[j], m);
                    }
                }
                x[i] += product;
            }
        }
        x
    }

    fn series_ratio(&self, p: &VectorOf<Self>) -> ScalarOf<Self> {
        let Some(TruncatedSeries { last, factors }) = &self.series else {
            return Scalar::of(0.0);
        };
        let terms = last.iter();
        let terms = terms.map(|(c, highest, monomial)| (Scalar::of(*c), *highest, &monomial[..]));
        let mut sums = alloc::vec![[Scalar::of(0.0); 2]; factors.len()];
        series::ratio(factors, terms, &mut sums, |i| p[i])
    }

    fn gradient_and_hessian(&self, p: &VectorOf<Self>) -> (VectorOf<Self>, MatrixOf<Self>) {
        let mut hessian = VectorOf::<Self>::zero_matrix(self.group.dim());
        for (c, factors) in self.terms() {
            for (first, &(i, n)) in factors.iter().enumerate() {
                for (second, &(j, m)) in factors.iter().enumerate().take(first + 1) {
                    let degrees = if first == second { n * (n - 1) } else { n * m };
                    if degrees == 0 {
                        continue;
                    }
                    let mut product = ScalarOf::<Self>::of(c * f64::from(degrees));
                    product *= if first == second {
                        power(p[i], n - 2)
                    } else {
                        power(p[i], n - 1) * power(p[j], m - 1)
                    };
                    for (other, &(k, l)) in factors.iter().enumerate() {
                        if other != first && other != second {
                            product *= power(p[k], l);
                        }
                    }
                    hessian[(i, j)] += product;
                    if i != j {
                        hessian[(j, i)] += product;
                    }
                }
            }
        }
        (self.gradient(p), hessian)
    }
}
