//! Samples in columns: pairs of momenta, and points of a Lagrangian submanifold.

use nalgebra::DMatrix;

/// Pairs of momenta, a sample per column.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumPairs {
    /// μ′, n×N.
    pub before: DMatrix<f64>,
    /// μ″, n×N.
    pub after: DMatrix<f64>,
}

impl MomentumPairs {
    /// N, the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.before.ncols()
    }

    /// Whether there are no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The samples with the numbers given.
    #[must_use]
    pub fn select(&self, samples: &[usize]) -> Self {
        Self {
            before: self.before.select_columns(samples),
            after: self.after.select_columns(samples),
        }
    }
}

/// Reduced data: points (x, p) of the Lagrangian submanifold to be learned, a sample per column,
/// and the momenta they came from.
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedData {
    /// x, the chart coordinate of g′⁻¹g″, n×N.
    pub x: DMatrix<f64>,
    /// p = (d^Lτ_x)ᵀ μ″, the canonical momentum of g′⁻¹·α″, n×N.
    pub p: DMatrix<f64>,
    /// μ′ and μ″.
    pub momenta: MomentumPairs,
}

impl ReducedData {
    /// N, the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.p.ncols()
    }

    /// Whether there are no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// n, the dimension of the group.
    #[must_use]
    pub fn dim(&self) -> usize {
        self.p.nrows()
    }

    /// The samples with the numbers given.
    #[must_use]
    pub fn select(&self, samples: &[usize]) -> Self {
        Self {
            x: self.x.select_columns(samples),
            p: self.p.select_columns(samples),
            momenta: self.momenta.select(samples),
        }
    }
}
