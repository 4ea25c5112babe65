//! Adam, on a row of numbers.

/// The state of Adam (D. Kingma and J. Ba, *Adam: a method for stochastic optimization*, 2015),
/// with its usual constants.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Adam {
    /// Running mean of the gradient.
    pub(super) first: Vec<f64>,
    /// Running mean of its squares.
    pub(super) second: Vec<f64>,
}

const BETA: (f64, f64) = (0.9, 0.999);
const EPSILON: f64 = 1e-8;

impl Adam {
    pub(super) fn new(unknowns: usize) -> Self {
        Self { first: vec![0.0; unknowns], second: vec![0.0; unknowns] }
    }

    /// Makes step number `step`, from 0, of size `rate`.
    pub(super) fn step(&mut self, step: usize, rate: f64, weights: &mut [f64], gradient: &[f64]) {
        let count = i32::try_from(step).unwrap_or(i32::MAX - 1) + 1;
        let unbias = (1.0 - BETA.0.powi(count), 1.0 - BETA.1.powi(count));
        let moments = self.first.iter_mut().zip(&mut self.second);
        for ((w, g), (m, v)) in weights.iter_mut().zip(gradient).zip(moments) {
            *m = BETA.0 * *m + (1.0 - BETA.0) * g;
            *v = BETA.1 * *v + (1.0 - BETA.1) * g * g;
            *w -= rate * (*m / unbias.0) / ((*v / unbias.1).sqrt() + EPSILON);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: after bias correction the first step is −rate·sign(g), and a constant gradient
    /// keeps it so.
    #[test]
    fn the_first_steps_go_against_the_sign() {
        let mut adam = Adam::new(2);
        let mut weights = [1.0, 1.0];
        for step in 0..3 {
            adam.step(step, 0.1, &mut weights, &[2.0, -0.5]);
        }
        assert!((weights[0] - 0.7).abs() < 1e-7 && (weights[1] - 1.3).abs() < 1e-7, "{weights:?}");
    }
}
