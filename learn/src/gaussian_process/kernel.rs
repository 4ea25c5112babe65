//! The squared-exponential kernel and the covariance of gradients.

use nalgebra::DMatrix;

/// The kernel's derivatives at the difference d = u − u′, for unit σ.
pub(super) struct Kernel {
    pub(super) inverse: f64,
    pub(super) value: f64,
}

impl Kernel {
    pub(super) fn at(d: &[f64], length: f64) -> Self {
        let inverse = 1.0 / (length * length);
        let square: f64 = d.iter().map(|v| v * v).sum();
        Self { inverse, value: (-0.5 * square * inverse).exp() }
    }

    /// ∂²k/∂u_a∂u′_b.
    pub(super) fn mixed(&self, d: &[f64], a: usize, b: usize) -> f64 {
        let delta = if a == b { 1.0 } else { 0.0 };
        self.inverse * (delta - d[a] * d[b] * self.inverse) * self.value
    }

    /// ∂³k/∂u_a∂u_c∂u′_b.
    pub(super) fn third(&self, d: &[f64], a: usize, b: usize, c: usize) -> f64 {
        let delta = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        let product = delta(a, c) * d[b] + delta(b, c) * d[a] + delta(a, b) * d[c];
        let inner = d[a] * d[b] * d[c] * self.inverse - product;
        self.inverse * self.inverse * inner * self.value
    }
}

/// K + noise for unit σ: blocks of n×n per pair of points.
pub(super) fn covariance(points: &[f64], dim: usize, length: f64, noise: f64) -> DMatrix<f64> {
    let size = points.len();
    let mut matrix = DMatrix::zeros(size, size);
    let mut d = vec![0.0; dim];
    for (i, u) in points.chunks_exact(dim).enumerate() {
        for (j, v) in points.chunks_exact(dim).enumerate().take(i + 1) {
            d.iter_mut().zip(u.iter().zip(v)).for_each(|(d, (u, v))| *d = u - v);
            let kernel = Kernel::at(&d, length);
            for a in 0..dim {
                for b in 0..dim {
                    let entry = kernel.mixed(&d, a, b);
                    matrix[(i * dim + a, j * dim + b)] = entry;
                    matrix[(j * dim + b, i * dim + a)] = entry;
                }
            }
        }
    }
    for k in 0..size {
        // The diagonal of K is 1/ℓ²; noise is relative to it.
        matrix[(k, k)] += noise / (length * length);
    }
    matrix
}
