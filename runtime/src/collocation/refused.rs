//! Steps that the programs of the attribute refuse.

use nalgebra::{SVector, SimdValue};

use super::{Collocation, Drive, Energy};
use crate::error::StepError;
use crate::group::LieGroup;
use crate::group::phase::Phase;
use crate::number::Scalar;
use crate::step::numbers::ElementNumbers;
use crate::step::printed::load;
use crate::step::{StepReport, check};

/// Makes a step of this size from the state at `time` by [`Collocation`], in 64 bits, in each lane by itself. `H` is the group `G`
/// over `f64`, whose elements have `COUNT` numbers; `system`, the energy and what acts beside it, is given the values of the symbols.
///
/// # Errors
/// [`StepError`]; `phase` is then left as it was.
#[cold]
#[inline(never)]
pub fn collocated<G, H, E, D, const M: usize, const N: usize, const S: usize, const COUNT: usize>(
    phase: &mut Phase<G>,
    [time, step]: [G::Scalar; 2],
    symbols: &[G::Scalar; S],
    system: impl Fn([f64; S]) -> (E, D),
) -> Result<StepReport<G::Scalar>, StepError>
where
    G: ElementNumbers + LieGroup<Vector = SVector<<G as LieGroup>::Scalar, N>> + Default,
    H: ElementNumbers + LieGroup<Scalar = f64, Vector = SVector<f64, N>> + Default,
    E: Energy<SVector<f64, N>>,
    D: Drive<H>,
{
    let (mut g, mut mu) = load::<G, N, COUNT>(phase);
    let mut report = StepReport { iterations: 0, residual: G::Scalar::of(0.0) };
    for lane in 0..G::Scalar::LANES {
        let number =
            |value: G::Scalar| nalgebra::try_convert(value.extract(lane)).unwrap_or(f64::NAN);
        let mut own = Phase::<H>::new(H::read(&g.map(number)), mu.map(number));
        let (energy, drive) = system(symbols.map(number));
        let mut steps =
            Collocation::<H, E, M, D>::driven(H::default(), energy, drive, number(step))?;
        let made = steps.advance(&mut own, number(time))?;
        report.iterations = report.iterations.max(made.iterations);
        report.residual.replace(lane, nalgebra::convert(made.residual));
        let (own_g, own_mu) = load::<H, N, COUNT>(&own);
        let numbers = g.iter_mut().chain(&mut mu);
        for (number, value) in numbers.zip(own_g.into_iter().chain(own_mu)) {
            number.replace(lane, nalgebra::convert(value));
        }
    }
    let next = Phase::new(G::read(&g), mu);
    check(&G::default(), &next)?;
    *phase = next;
    Ok(report)
}
