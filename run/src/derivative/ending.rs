//! The event that ends a run, to first order.

use coadjoint_codegen::lie::LieAlgebra;
use nalgebra::{DMatrix, DVector, RowDVector};
use num_traits::ToPrimitive;

use crate::engine::{Motion, Numbers};
use crate::simulate::Event;

/// The spacing of differences, relative to the size of what changes.
const SPACING: f64 = 0.02;

/// An event that ends a run within the step after its whole steps, and its time.
#[derive(Debug)]
pub(super) struct Ending {
    pub event: Event,
    pub time: f64,
}

/// The motion and the function of an event at the state where it occurs, to first order.
#[derive(Debug)]
pub(super) struct Slope {
    /// The rates (g⁻¹ġ, μ̇) of the motion.
    pub motion: DVector<f64>,
    /// The derivatives of the function in (ξ, ν).
    pub function: DVector<f64>,
    /// The rate of the function along the motion.
    pub rate: f64,
}

impl Slope {
    /// The change of the event's time with these changes of the state at a fixed time.
    pub(super) fn times(&self, tangents: &DMatrix<f64>) -> RowDVector<f64> {
        self.function.transpose() * tangents / -self.rate
    }
}

impl Ending {
    /// At this state, by differences.
    ///
    /// # Errors
    /// The reason for which there is no derivative.
    pub(super) fn slope(
        &self,
        motion: &Motion<'_>,
        algebra: &LieAlgebra,
        state: &Numbers,
    ) -> Result<Slope, String> {
        let (space, time, n) = (motion.space(), self.time, algebra.dim());
        let value = |time: f64, matrix: &[f64], mu: &[f64]| {
            (self.event.function)(time, matrix, mu)
                .map_err(|why| format!("the event `{}`: {why}", self.event.name))
        };
        let (matrix, size) = (space.matrix(&state.g), space.size());
        let less = |a: &DVector<f64>, b: &DVector<f64>| a - b;
        // Up to a break on either side.
        let step = motion.grid().step;
        let reach = [step, -step].map(|step| motion.parts_of([time, 0.1 * step])[0][1].abs());
        let along = difference(SPACING * reach[0].min(reach[1]) * 10.0, less, |s| {
            let next = motion.beside(state, time, s).map_err(|error| error.to_string())?;
            let matrix = space.matrix(&next.g);
            let value = value(time + s, &matrix, &next.mu)?;
            Ok::<_, String>(DVector::from_vec([&matrix[..], &next.mu, &[value]].concat()))
        })?;
        let (entries, rest) = along.as_slice().split_at(size * size);
        let xi = coordinates(algebra, &matrix, entries);
        let rate = rest[n];
        let motion = DVector::from_iterator(2 * n, xi.iter().chain(&rest[..n]).copied());
        let here = DMatrix::from_row_slice(size, size, &matrix);
        let mut function = DVector::zeros(2 * n);
        for (place, generator) in generators(algebra).iter().enumerate() {
            let moved = (&here * generator).transpose();
            let found = difference(SPACING, less, |s| {
                let own = matrix.iter().zip(moved.as_slice());
                let own: Vec<f64> = own.map(|(entry, change)| entry + s * change).collect();
                Ok::<_, String>(DVector::from_element(1, value(time, &own, &state.mu)?))
            })?;
            function[place] = found[0];
        }
        let largest = state.mu.iter().fold(0.0, |most: f64, mu| most.max(mu.abs()));
        let spacing = SPACING * if largest > 0.0 { largest } else { 1.0 };
        for place in 0..n {
            let found = difference(spacing, less, |s| {
                let mut mu = state.mu.clone();
                mu[place] += s;
                Ok::<_, String>(DVector::from_element(1, value(time, &matrix, &mu)?))
            })?;
            function[n + place] = found[0];
        }
        if rate == 0.0 || !rate.is_finite() || function.iter().any(|slope| !slope.is_finite()) {
            let name = &self.event.name;
            return Err(format!("the event `{name}`: its function has the rate {rate} there"));
        }
        Ok(Slope { motion, function, rate })
    }
}

/// The eighth-order central difference of f at 0.
///
/// # Errors
/// Those of f.
pub(super) fn difference<T, E>(
    spacing: f64,
    less: impl Fn(&T, &T) -> DVector<f64>,
    f: impl Fn(f64) -> Result<T, E>,
) -> Result<DVector<f64>, E> {
    let term = |weight: f64, at: f64| Ok(less(&f(at)?, &f(-at)?) * (weight / spacing));
    let mut sum = term(4.0 / 5.0, spacing)?;
    for (weight, at) in [(-1.0 / 5.0, 2.0), (4.0 / 105.0, 3.0), (-1.0 / 280.0, 4.0)] {
        sum += term(weight, at * spacing)?;
    }
    Ok(sum)
}

fn generators(algebra: &LieAlgebra) -> Vec<DMatrix<f64>> {
    let entry = |number: Option<f64>| number.unwrap_or(f64::NAN);
    let matrices = algebra.matrices();
    let dense = matrices
        .iter()
        .map(|e| DMatrix::from_fn(e.rows(), e.columns(), |i, j| entry(e.get(i, j).to_f64())));
    dense.collect()
}

/// The coordinates of g⁻¹ δg, both by rows; NaN where g has no inverse.
pub(super) fn coordinates(algebra: &LieAlgebra, g: &[f64], change: &[f64]) -> DVector<f64> {
    let size = g.len().isqrt();
    let back = DMatrix::from_row_slice(size, size, g).try_inverse();
    let generators = generators(algebra);
    let columns: Vec<DVector<f64>> =
        generators.iter().map(|e| DVector::from_column_slice(e.as_slice())).collect();
    let (Some(back), false) = (back, columns.is_empty()) else {
        return DVector::from_element(columns.len(), f64::NAN);
    };
    let body = back * DMatrix::from_row_slice(size, size, change);
    let generators = DMatrix::from_columns(&columns);
    let wanted = generators.tr_mul(&DVector::from_column_slice(body.as_slice()));
    let gram = generators.tr_mul(&generators).try_inverse();
    gram.map_or_else(|| DVector::from_element(columns.len(), f64::NAN), |gram| gram * wanted)
}
