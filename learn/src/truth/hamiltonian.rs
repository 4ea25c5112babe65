//! Hamiltonians H: 𝔤\* → ℝ with hand-written derivatives.

use crate::function::MomentumFunction;

/// H = ½ Σ wᵢ μᵢ² + Σ bᵢ μᵢ: the free rigid body, the heavy top, and their like.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadratic {
    /// w, the reciprocal moments of inertia.
    pub weights: Vec<f64>,
    /// b, of the same length.
    pub linear: Vec<f64>,
}

impl Quadratic {
    /// The free rigid body on so(3)\* with the principal moments of inertia given.
    #[must_use]
    pub fn rigid_body(inertia: [f64; 3]) -> Self {
        Self { weights: inertia.map(f64::recip).to_vec(), linear: vec![0.0; 3] }
    }

    /// The rigid body of the paper, inertia (1.5, 2, 2.5).
    #[must_use]
    pub fn paper() -> Self {
        Self::rigid_body([1.5, 2.0, 2.5])
    }

    /// The heavy top on se(3)\*, μ = (Π, Γ): H = ½ Π·I⁻¹Π + mgl χ·Γ (Marsden and Ratiu,
    /// *Introduction to Mechanics and Symmetry*, section 1.4).
    #[must_use]
    pub fn heavy_top(inertia: [f64; 3], weight_arm: [f64; 3]) -> Self {
        let [a, b, c] = inertia.map(f64::recip);
        let [x, y, z] = weight_arm;
        Self { weights: vec![a, b, c, 0.0, 0.0, 0.0], linear: vec![0.0, 0.0, 0.0, x, y, z] }
    }
}

impl MomentumFunction for Quadratic {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let terms = p.iter().zip(&self.weights).zip(&self.linear);
        terms.map(|((v, w), b)| (0.5 * w * v + b) * v).sum()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.weights[i] * p[i] + self.linear[i];
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        hessian.fill(0.0);
        let dim = self.dim();
        for (i, weight) in self.weights.iter().enumerate() {
            hessian[i * dim + i] = *weight;
        }
    }
}

/// H = ½ Σ wᵢ μᵢ² + ¼ Σ vᵢ μᵢ⁴.
#[derive(Clone, Debug, PartialEq)]
pub struct Quartic {
    /// The weights w, one for each coordinate of the momentum.
    pub weights: Vec<f64>,
    /// The weights v of the fourth powers, as many.
    pub quartic: Vec<f64>,
}

impl MomentumFunction for Quartic {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        let terms = p.iter().zip(&self.weights).zip(&self.quartic);
        terms.map(|((v, w), q)| (0.5 * w + 0.25 * q * v * v) * v * v).sum()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = (self.weights[i] + self.quartic[i] * p[i] * p[i]) * p[i];
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        hessian.fill(0.0);
        let dim = self.dim();
        for i in 0..dim {
            hessian[i * dim + i] = self.weights[i] + 3.0 * self.quartic[i] * p[i] * p[i];
        }
    }
}

/// H = √(1 + Σ wᵢ μᵢ²) + a sin μ₁: no polynomial, and no polynomial S either.
#[derive(Clone, Debug, PartialEq)]
pub struct Relativistic {
    /// The weights w, one for each coordinate of the momentum.
    pub weights: Vec<f64>,
    /// The amplitude a of the sine.
    pub ripple: f64,
}

impl Relativistic {
    fn root(&self, p: &[f64]) -> f64 {
        (1.0 + p.iter().zip(&self.weights).map(|(v, w)| w * v * v).sum::<f64>()).sqrt()
    }
}

impl MomentumFunction for Relativistic {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        self.root(p) + self.ripple * p[0].sin()
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let root = self.root(p);
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.weights[i] * p[i] / root;
        }
        gradient[0] += self.ripple * p[0].cos();
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let root = self.root(p);
        let dim = self.dim();
        for i in 0..dim {
            for j in 0..dim {
                let slope = |k: usize| self.weights[k] * p[k] / root;
                let diagonal = if i == j { self.weights[i] } else { 0.0 };
                hessian[i * dim + j] = (diagonal - slope(i) * slope(j)) / root;
            }
        }
        hessian[0] -= self.ripple * p[0].sin();
    }
}

/// H = ½ Σ wᵢ μᵢ² + a exp(−½ Σ sᵢ (μᵢ − cᵢ)²): a body with a bump off its axes, far from any
/// polynomial and no function of a simpler Hamiltonian.
#[derive(Clone, Debug, PartialEq)]
pub struct Bump {
    /// The weights w, one for each coordinate of the momentum.
    pub weights: Vec<f64>,
    /// The height a of the bump.
    pub height: f64,
    /// The sharpness s of the bump in each coordinate.
    pub sharpness: Vec<f64>,
    /// The centre c of the bump.
    pub centre: Vec<f64>,
}

impl Bump {
    /// sᵢ (μᵢ − cᵢ).
    fn pull(&self, p: &[f64], i: usize) -> f64 {
        self.sharpness[i] * (p[i] - self.centre[i])
    }

    /// The second term.
    fn bell(&self, p: &[f64]) -> f64 {
        let square: f64 = (0..p.len()).map(|i| self.pull(p, i) * (p[i] - self.centre[i])).sum();
        self.height * (-0.5 * square).exp()
    }
}

impl MomentumFunction for Bump {
    fn dim(&self) -> usize {
        self.weights.len()
    }

    fn value(&self, p: &[f64]) -> f64 {
        0.5 * p.iter().zip(&self.weights).map(|(v, w)| w * v * v).sum::<f64>() + self.bell(p)
    }

    fn gradient(&self, p: &[f64], gradient: &mut [f64]) {
        let bell = self.bell(p);
        for (i, entry) in gradient.iter_mut().enumerate() {
            *entry = self.weights[i] * p[i] - self.pull(p, i) * bell;
        }
    }

    fn gradient_and_hessian(&self, p: &[f64], gradient: &mut [f64], hessian: &mut [f64]) {
        self.gradient(p, gradient);
        let (bell, dim) = (self.bell(p), self.dim());
        for i in 0..dim {
            for j in 0..dim {
                let diagonal =
                    if i == j { self.weights[i] - self.sharpness[i] * bell } else { 0.0 };
                hessian[i * dim + j] = diagonal + self.pull(p, i) * self.pull(p, j) * bell;
            }
        }
    }
}
