//! Inputs that are functions, which no file holds; cases `smooth_*` and `inputs*` show the rest.

use std::path::Path;

use coadjoint_codegen::signal::Signal;
use coadjoint_codegen::smooth::Functions;
use coadjoint_codegen::system::Options;
use coadjoint_run::simulate::{Schedule, Setup, run};
use coadjoint_run::{Accuracy, Derived, read_given};

use crate::support::distance;

/// The system of `inputs.case` without its tables.
const STEERED: &str = r#"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "u*z^2/2 + v*z"
[integrator]
truncation = 5
step = 0.1
[initial]
momentum = [0.5, -0.3, 0.9]
[run]
time = 6
"#;

/// Functions in place of tables, which are called at the times of the nodes; where one has no value the step is refused.
#[test]
fn inputs_may_be_functions() {
    // By the integral of z u + v, z = 0.9.
    let (sin, cos) = (0.9 * 1.8 - 0.6_f64).sin_cos();
    let expected = [0.5 * cos - 0.3 * sin, -0.5 * sin - 0.3 * cos, 0.9];
    let run_until = |end: f64| {
        // The polynomials by which the table was made.
        let u =
            move |t: f64| if t < end { 0.3 - t + 0.7 * t * t - 0.1 * t * t * t } else { f64::NAN };
        let u = Signal::of_function("u".to_owned(), u);
        let v = Signal::of_function("v".to_owned(), |t| 0.5 + 0.2 * t - 0.1 * t * t);
        let given = Functions { inputs: vec![u, v], ..Functions::default() };
        let system = read_given("system", STEERED, Options::default(), &[], &given)?;
        let schedule = Schedule::new(Path::new("system"), &Accuracy::default(), &system.run)?;
        let setup = Setup::new(schedule, system.run.momentum.clone().unwrap());
        run(&Derived::of(system)?, &setup, &mut ())
    };
    let found = run_until(f64::INFINITY).unwrap().momentum;
    assert!(distance(&found, &expected) < 1e-13, "{found:?}");
    let error = run_until(3.05).unwrap_err().to_string();
    assert!(error.starts_with("at time 3") && error.contains("step 31"), "{error}");
}
