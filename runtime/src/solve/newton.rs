//! Newton's method, for groups of few dimensions.

use nalgebra::{SimdBool, SimdComplexField, SimdPartialOrd};

use super::candidate::{Branch, Candidate, CandidateOf, inverse_scale, rounding, sized};
use crate::chart::Chart;
use crate::generating::{GeneratingFunction, MatrixOf, ScalarOf, VectorOf};
use crate::linear::coordinates::Coordinates;
use crate::number::Scalar;

/// Newton iterations allowed before the solver gives up.
const MAX_ITERATIONS: u32 = 20;

/// A correction larger than this part of the one before it ends the solve.
const SHRINKS: f64 = 0.25;

/// The largest change of ∂F/∂p between guess and solution, for the sums of rows: where it is larger, as where S has waves
/// shorter than the way between them, small corrections do not tell that the solution next to the guess was found.
const BENDS: f64 = 0.25;

/// The solution for `scale`·S from this guess. Each correction has a Hessian of its own, and must be much smaller than the
/// one before it; the residual is measured.
pub(super) fn newton<S: GeneratingFunction + ?Sized>(
    generating: &S,
    mu: &VectorOf<S>,
    scale: ScalarOf<S>,
    guess: VectorOf<S>,
) -> CandidateOf<S> {
    let (group, chart, dim) = (generating.group(), S::Chart::default(), mu.dim());
    let (inverse_scale, rounding) = (inverse_scale(generating, mu), rounding(generating));
    let mut p = guess;
    let mut moved = ScalarOf::<S>::of(0.0);
    let mut allowed = ScalarOf::<S>::of(f64::MAX);
    let mut iterations = 0;
    let mut first = None;
    loop {
        iterations += 1;
        let (x, hessian) = generating.gradient_and_hessian(&p);
        let x = VectorOf::<S>::from_entries(dim, |i| scale * x[i]);
        let hessian = VectorOf::<S>::matrix_from_entries(dim, |i, j| scale * hessian[(i, j)]);
        // F(p) = p − (d^R τ_x)ᵀ μ, ∂F/∂p = 1 − D·Hess S.
        let (pulled, derivative) = chart.pull_back_with_derivative(group, &x, mu);
        let jacobian = VectorOf::<S>::one_minus_product(dim, &derivative, &hessian);
        let left = p.clone().minus(&pulled);
        let residual = sized(generating, &left).largest_entry() * inverse_scale;
        if residual.simd_le(rounding).all() {
            let apart = first.is_some_and(|first| bends(generating, dim, &first, &jacobian));
            let branch = match apart {
                true => Branch::Bent,
                false => branch(generating, dim, &derivative, jacobian),
            };
            return Candidate { x, moved, residual, branch, iterations };
        }
        let correction = VectorOf::<S>::solve(&jacobian, &left);
        first.get_or_insert(jacobian);
        let relative = sized(generating, &correction).largest_entry() * inverse_scale;
        moved += relative;
        if !relative.simd_le(allowed).all() || iterations == MAX_ITERATIONS {
            return Candidate { x, moved, residual, branch: Branch::Unknown, iterations };
        }
        p = p.minus(&correction);
        // Corrections by rounding do not shrink.
        allowed = (ScalarOf::<S>::of(SHRINKS) * relative).simd_max(rounding);
    }
}

/// True if a lane of one matrix differs by more than [`BENDS`] from another.
fn bends<S: GeneratingFunction + ?Sized>(
    generating: &S,
    dim: usize,
    first: &MatrixOf<S>,
    last: &MatrixOf<S>,
) -> bool {
    let zero = ScalarOf::<S>::of(0.0);
    (0..dim).any(|i| {
        let change = |j| in_units(generating, i, j, last[(i, j)] - first[(i, j)]).simd_abs();
        let sum = (0..dim).fold(zero, |sum, j| sum + change(j));
        !sum.simd_le(ScalarOf::<S>::of(BENDS)).all()
    })
}

/// The entry (i, j) of a matrix from momenta to momenta, in comparable units.
fn in_units<S: GeneratingFunction + ?Sized>(
    generating: &S,
    i: usize,
    j: usize,
    entry: ScalarOf<S>,
) -> ScalarOf<S> {
    entry * ScalarOf::<S>::of(generating.unit(i) / generating.unit(j))
}

/// The branch of the solution, as far as 1 − D·Hess S tells, D = ∂p/∂x.
fn branch<S: GeneratingFunction + ?Sized>(
    generating: &S,
    dim: usize,
    derivative: &MatrixOf<S>,
    jacobian: MatrixOf<S>,
) -> Branch {
    let [zero, one] = [0.0, 1.0].map(ScalarOf::<S>::of);
    let contracts = (0..dim).all(|i| {
        let product =
            |j| in_units(generating, i, j, jacobian[(i, j)] - if i == j { one } else { zero });
        (0..dim).fold(zero, |sum, j| sum + product(j).simd_abs()).simd_lt(one).all()
    });
    match contracts {
        true => Branch::Only,
        false if is_oriented::<S>(dim, derivative, jacobian) => Branch::Oriented,
        false => Branch::Unknown,
    }
}

/// True if the leading minors at the ends of the blocks of D are positive, by elimination with pivots from each block, of
/// one lane. Blocks belong to the direct factors of the group: the determinants of two like bodies have like signs.
fn is_oriented<S: GeneratingFunction + ?Sized>(
    dim: usize,
    derivative: &MatrixOf<S>,
    mut matrix: MatrixOf<S>,
) -> bool {
    let couples = |i, j| [(i, j), (j, i)].iter().any(|&at| derivative[at].largest_lane() != 0.0);
    let ends = |end: usize| !(0..end).any(|i| (end..dim).any(|j| couples(i, j)));
    let (mut positive, mut end) = (true, 0);
    for k in 0..dim {
        if k == end {
            end = (k + 1..dim).find(|&end| ends(end)).unwrap_or(dim);
        }
        let size = |i: usize| matrix[(i, k)].simd_abs().largest_lane();
        let pivot = (k..end).fold(k, |best, i| if size(i) > size(best) { i } else { best });
        if pivot != k {
            positive = !positive;
            for j in k..dim {
                let entry = matrix[(k, j)];
                matrix[(k, j)] = matrix[(pivot, j)];
                matrix[(pivot, j)] = entry;
            }
        }
        let top = matrix[(k, k)];
        positive ^= top.largest_lane() < 0.0;
        if top.largest_lane() == 0.0 || k + 1 == end && !positive {
            return false;
        }
        for i in k + 1..dim {
            let factor = matrix[(i, k)] / top;
            for j in k + 1..dim {
                let change = factor * matrix[(k, j)];
                matrix[(i, j)] -= change;
            }
        }
    }
    true
}
