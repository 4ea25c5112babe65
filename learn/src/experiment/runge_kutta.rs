//! The variable-step Runge–Kutta method the paper compares with (RK45).

/// The integration could not go on.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the step size fell to {step:e} at time {time}")]
pub struct RungeKuttaError {
    /// Where.
    pub time: f64,
    /// The step size reached.
    pub step: f64,
}

/// The stages of Dormand and Prince's 5(4) pair (Hairer, Nørsett, Wanner I, table II.5.2).
const STAGES: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[19_372.0 / 6561.0, -25_360.0 / 2187.0, 64_448.0 / 6561.0, -212.0 / 729.0],
    &[9017.0 / 3168.0, -355.0 / 33.0, 46_732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18_656.0],
    &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// The difference of the two formulas.
const ERROR: [f64; 7] = [
    71.0 / 57_600.0,
    0.0,
    -71.0 / 16_695.0,
    71.0 / 1920.0,
    -17_253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Integrates y′ = f(y) to the times given (increasing, from 0), returning y at each.
///
/// # Errors
/// [`RungeKuttaError`] when the step size falls to rounding.
pub fn dormand_prince(
    start: &[f64],
    times: &[f64],
    relative: f64,
    absolute: f64,
    slope: impl Fn(&[f64], &mut [f64]),
) -> Result<Vec<Vec<f64>>, RungeKuttaError> {
    let size = start.len();
    let (mut time, mut y) = (0.0, start.to_vec());
    let mut stages = vec![vec![0.0; size]; 7];
    let mut step: f64 = 1e-3;
    let mut outputs = Vec::with_capacity(times.len());
    for &target in times {
        while time < target {
            let h = step.min(target - time);
            slope(&y, &mut stages[0]);
            let mut next = y.clone();
            for (s, weights) in STAGES.iter().enumerate() {
                for i in 0..size {
                    let sum: f64 = weights.iter().zip(&stages).map(|(w, k)| w * k[i]).sum();
                    next[i] = y[i] + h * sum;
                }
                slope(&next, &mut stages[s + 1]);
            }
            let squares = (0..size).map(|i| {
                let sum: f64 = ERROR.iter().zip(&stages).map(|(w, k)| w * k[i]).sum();
                let scale = absolute + relative * y[i].abs().max(next[i].abs());
                (h * sum / scale).powi(2)
            });
            let error = (squares.sum::<f64>() / size as f64).sqrt();
            let factor = (0.9 * error.max(1e-10).powf(-0.2)).clamp(0.2, 10.0);
            if error <= 1.0 {
                time += h;
                y = next;
                // A step cut short by an output time says nothing about the next one.
                step = if h < step { step } else { h * factor };
            } else if error.is_nan() || h <= 1e-14 * target {
                return Err(RungeKuttaError { time, step: h });
            } else {
                step = h * factor.min(1.0);
            }
        }
        outputs.push(y.clone());
    }
    Ok(outputs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_harmonic_oscillator_comes_back() {
        let period = 2.0 * std::f64::consts::PI;
        let end = dormand_prince(&[1.0, 0.0], &[period], 1e-10, 1e-12, |y, f| {
            f[0] = y[1];
            f[1] = -y[0];
        });
        let end = end.unwrap();
        assert!((end[0][0] - 1.0).abs() < 1e-8 && end[0][1].abs() < 1e-8);
    }
}
