//! The variable-step Runge–Kutta method the paper compares with (RK45).

/// The integration could not go on.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the step size fell to {step:e} at time {time}")]
pub struct RungeKuttaError {
    /// The time it had come to.
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

/// The dense output of fourth order: y(t + θh) = y + h Σᵢ kᵢ Σⱼ Pᵢⱼ θ^{j+1} (L. F. Shampine, *Some
/// practical Runge–Kutta formulas*, Math. Comp. 46, 1986).
const DENSE: [[f64; 4]; 7] = [
    [
        1.0,
        -8_048_581_381.0 / 2_820_520_608.0,
        8_663_915_743.0 / 2_820_520_608.0,
        -12_715_105_075.0 / 11_282_082_432.0,
    ],
    [0.0; 4],
    [
        0.0,
        131_558_114_200.0 / 32_700_410_799.0,
        -68_118_460_800.0 / 10_900_136_933.0,
        87_487_479_700.0 / 32_700_410_799.0,
    ],
    [
        0.0,
        -1_754_552_775.0 / 470_086_768.0,
        14_199_869_525.0 / 1_410_260_304.0,
        -10_690_763_975.0 / 1_880_347_072.0,
    ],
    [
        0.0,
        127_303_824_393.0 / 49_829_197_408.0,
        -318_862_633_887.0 / 49_829_197_408.0,
        701_980_252_875.0 / 199_316_789_632.0,
    ],
    [
        0.0,
        -282_668_133.0 / 205_662_961.0,
        2_019_193_451.0 / 616_988_883.0,
        -1_453_857_185.0 / 822_651_844.0,
    ],
    [0.0, 40_617_522.0 / 29_380_423.0, -110_615_467.0 / 29_380_423.0, 69_997_945.0 / 29_380_423.0],
];

/// Integrates y′ = f(y) to the times given (increasing, from 0), returning y at each by dense
/// output: the steps are the method's own.
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
    while outputs.len() < times.len() {
        slope(&y, &mut stages[0]);
        let mut next = y.clone();
        for (s, weights) in STAGES.iter().enumerate() {
            for i in 0..size {
                let sum: f64 = weights.iter().zip(&stages).map(|(w, k)| w * k[i]).sum();
                next[i] = y[i] + step * sum;
            }
            slope(&next, &mut stages[s + 1]);
        }
        let squares = (0..size).map(|i| {
            let sum: f64 = ERROR.iter().zip(&stages).map(|(w, k)| w * k[i]).sum();
            let scale = absolute + relative * y[i].abs().max(next[i].abs());
            (step * sum / scale).powi(2)
        });
        let error = (squares.sum::<f64>() / size as f64).sqrt();
        let factor = (0.9 * error.max(1e-10).powf(-0.2)).clamp(0.2, 10.0);
        if error <= 1.0 {
            while let Some(&target) = times.get(outputs.len()).filter(|&&t| t <= time + step) {
                let theta = (target - time) / step;
                let weights =
                    DENSE.map(|p| theta * (p[0] + theta * (p[1] + theta * (p[2] + theta * p[3]))));
                let value = |i: usize| -> f64 {
                    let sum: f64 = weights.iter().zip(&stages).map(|(w, k)| w * k[i]).sum();
                    y[i] + step * sum
                };
                outputs.push((0..size).map(value).collect());
            }
            time += step;
            y = next;
            step *= factor;
        } else if error.is_nan() || step <= 1e-14 * time.max(1e-3) {
            return Err(RungeKuttaError { time, step });
        } else {
            step *= factor.min(1.0);
        }
    }
    Ok(outputs)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_harmonic_oscillator_comes_back() {
        let period = 2.0 * std::f64::consts::PI;
        let end = dormand_prince(&[1.0, 0.0], &[1.0, period], 1e-10, 1e-12, |y, f| {
            f[0] = y[1];
            f[1] = -y[0];
        });
        let end = end.unwrap();
        // Between steps the dense output is of fourth order.
        assert!((end[0][0] - 1.0_f64.cos()).abs() < 1e-8);
        assert!((end[1][0] - 1.0).abs() < 1e-8 && end[1][1].abs() < 1e-8);
    }
}
