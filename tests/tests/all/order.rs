//! The order of accuracy of generated integrators, measured by halving the step.

use coadjoint::nalgebra::Vector3;
use coadjoint::{Phase, SO3, StepError, lie_poisson};

macro_rules! rigid_body {
    ($module:ident, $truncation:literal, $chart:ident) => {
        mod $module {
            use super::*;
            #[lie_poisson(group = SO3, truncation = $truncation, chart = $chart)]
            pub fn body(mu: [f64; 3]) -> f64 {
                mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0
            }
        }
    };
}

rigid_body!(exp1, 1, exp);
rigid_body!(exp3, 3, exp);
rigid_body!(exp5, 5, exp);
rigid_body!(exp7, 7, exp);
rigid_body!(cayley1, 1, cayley);
rigid_body!(cayley3, 3, cayley);
rigid_body!(cayley5, 5, cayley);
rigid_body!(cayley7, 7, cayley);

/// tests/reference/end_states.json, "rigid-body (paper)": the momentum at T = 100.
const END: [f64; 3] = [2.010707126264523070, -0.368082789199028512, -1.035167577102806352];

macro_rules! order {
    ($module:ident, $steps:expr) => {{
        let error = |n: u32| -> Result<f64, StepError> {
            let step = $module::Body::new(100.0 / f64::from(n))?;
            let mut body = Phase::<SO3>::at_identity([2.0, 0.5, 1.0]);
            for _ in 0..n {
                step.advance(&mut body)?;
            }
            Ok((body.momentum - Vector3::from(END)).amax())
        };
        let (coarse, fine) = (error($steps)?, error(2 * $steps)?);
        (coarse / fine).log2()
    }};
}

#[test]
fn the_order_is_truncation_plus_one() -> Result<(), StepError> {
    // Steps small enough for the asymptotic regime, large enough to stay above rounding.
    let measured = [
        (2.0, order!(exp1, 3200)),
        (4.0, order!(exp3, 800)),
        (6.0, order!(exp5, 400)),
        (8.0, order!(exp7, 200)),
        (2.0, order!(cayley1, 6400)),
        (4.0, order!(cayley3, 1600)),
        (6.0, order!(cayley5, 1000)),
        (8.0, order!(cayley7, 800)),
    ];
    for (expected, order) in measured {
        assert!((order - expected).abs() < 0.3, "expected {expected}: {measured:?}");
    }
    Ok(())
}
