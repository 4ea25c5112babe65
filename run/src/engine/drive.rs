//! The velocity and the torque of a system, run by the interpreter.

use std::sync::Arc;

use coadjoint::LieGroup;
use coadjoint::collocation::{Drive, Undefined};
use coadjoint_codegen::smooth::Smooth;
use nalgebra::DVector;

use super::space::{Tables, entries_of};
use crate::error::kept;

/// The elements of the groups known at run time.
type Element = <Tables as LieGroup>::Element;

/// The drive of a smooth system, for these values of the parameters that it keeps.
#[derive(Clone, Debug)]
pub(super) struct Actuator<'a> {
    smooth: &'a Smooth,
    group: Arc<Tables>,
    symbols: Arc<[f64]>,
    /// True if its programs read the group element.
    reads: bool,
}

impl<'a> Actuator<'a> {
    pub(super) fn new(smooth: &'a Smooth, group: &Arc<Tables>, parameters: &[f64]) -> Self {
        let reads = smooth.drive.as_ref().is_some_and(|drive| drive.reads_element());
        let symbols = smooth.symbols_at(parameters).into();
        Self { smooth, group: group.clone(), symbols, reads }
    }

    fn entries(&self, g: &Element) -> Vec<f64> {
        if self.reads { entries_of(&self.group, g) } else { Vec::new() }
    }
}

impl Drive<Tables> for Actuator<'_> {
    fn acting(
        &self,
        time: f64,
        g: &Element,
        mu: &DVector<f64>,
        omega: &DVector<f64>,
    ) -> [DVector<f64>; 2] {
        let state = [mu.as_slice(), omega.as_slice()];
        self.smooth.acting(&self.symbols, time, &self.entries(g), state).map(DVector::from_vec)
    }

    fn undefined(
        &self,
        time: f64,
        g: &Element,
        mu: &DVector<f64>,
        omega: &DVector<f64>,
    ) -> Option<Undefined> {
        let state = [mu.as_slice(), omega.as_slice()];
        let found = self.smooth.undefined_in_drive(&self.symbols, time, &self.entries(g), state)?;
        Some(Undefined { expression: kept(found.0), argument: found.1 })
    }
}
