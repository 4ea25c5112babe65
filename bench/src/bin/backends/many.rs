//! Ensembles on one core: the attribute's lanes, and `ensemble` from a file.

use std::hint::black_box;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use coadjoint::lanes::ensemble::advance_all;
use coadjoint::lanes::{F64x8, Lanes};
use coadjoint::{GeneratingFunction, LieGroup, Phase};
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::integrator::Integrator;
use coadjoint_run::ensemble::{self, Attitude, How, Layout, Watch, engine, problem_of};
use coadjoint_run::{Backend, engine::Kept};

use crate::Failure;
use crate::measure::{Way, line, medians};
use crate::text::Text;

/// How many trajectories, and how many steps each makes in a round.
pub const BODIES: usize = 100_000;
pub const STEPS: u64 = 100;
/// Rounds over all ways.
const ROUNDS: usize = 7;

/// Prints the row of an ensemble whose momenta are the system's, each a little larger than the one before.
pub fn row<S, const N: usize>(text: &Text, compiled: &S) -> Result<(), Failure>
where
    S: Lanes + Sync,
    S::Over<F64x8>: Sync,
    S::Group: LieGroup<Vector = nalgebra::SVector<f64, N>> + Default,
    Phase<S::Group>: Send,
    <S as GeneratingFunction>::Group: Sync,
{
    let momenta: Vec<f64> = (0..BODIES)
        .flat_map(|i| {
            let size = 1.0 + 0.2 * i as f64 / BODIES as f64;
            text.momentum.iter().map(move |mu| mu * size)
        })
        .collect();
    let integrator = Integrator::build(problem_of(text.system()?)?, TermLimit::default())?;
    let mut states: Vec<Phase<S::Group>> = momenta
        .chunks_exact(N)
        .map(|mu| Phase::at_identity(nalgebra::SVector::<f64, N>::from_column_slice(mu)))
        .collect();
    let mut ways = vec![Way::timed("the attribute", move |_| {
        let begun = Instant::now();
        let failures = black_box(advance_all(compiled, &mut states, STEPS));
        none_refused(failures.len(), begun.elapsed())
    })];
    ways.push(from_file("C", text, &integrator, &momenta, Backend::C)?);
    #[cfg(feature = "jit")]
    ways.push(from_file("Cranelift", text, &integrator, &momenta, Backend::Jit)?);
    let counts = vec![BODIES as u64 * STEPS; ways.len()];
    let found = medians(&mut ways, &counts, ROUNDS)?;
    println!("{}", line(text.name, &ways, &found));
    Ok(())
}

fn from_file<'a>(
    name: &'static str,
    text: &Text,
    integrator: &'a Integrator,
    momenta: &[f64],
    backend: Backend,
) -> Result<Way<'a>, Failure> {
    let how = How { backend, work: 1e9, device: None };
    let engine = engine(Path::new(text.name), integrator, text.step, how, &Kept::default())?;
    let layout = Layout { shape: engine.shape(), attitude: Attitude::None };
    let mut values = momenta.to_vec();
    Ok(Way::timed(name, move |_| {
        let stop = AtomicBool::new(false);
        let watch = Watch { made: &|_| (), stop: &stop };
        let begun = Instant::now();
        let done = ensemble::advance_all(engine.as_ref(), &layout, STEPS, &mut values, &watch);
        let took = begun.elapsed();
        none_refused(black_box(done)?.0.len(), took)
    }))
}

/// The time, if every trajectory has got to its end.
fn none_refused(refused: usize, took: Duration) -> Result<Duration, Failure> {
    if refused == 0 { Ok(took) } else { Err(format!("{refused} trajectories were refused").into()) }
}
