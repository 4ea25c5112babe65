//! Losses as burn writes them: unknowns as tensors, their gradient by automatic differentiation.

use burn::tensor::{DType, Device, Tensor, TensorData};

use crate::error::LearnError;

/// The device: the CPU, differentiating.
pub(super) fn device() -> Device {
    Device::flex().autodiff()
}

/// A rows×columns matrix of 64-bit floats, constant.
pub(super) fn matrix(values: &[f64], rows: usize, columns: usize, device: &Device) -> Tensor<2> {
    Tensor::from_data(TensorData::new(values.to_vec(), [rows, columns]), (device, DType::F64))
}

/// The entries, row by row.
fn values<const D: usize>(tensor: Tensor<D>) -> Result<Vec<f64>, LearnError> {
    let failed = |reason: String| LearnError::NotConverged { reason };
    let data = tensor.try_into_data().map_err(|e| failed(e.to_string()))?;
    data.try_into_vec::<f64>().map_err(|e| failed(format!("{e:?}")))
}

/// All unknowns of a fit, as matrices (biases are 1×k).
#[derive(Clone, Debug)]
pub(super) struct Unknowns {
    matrices: Vec<Tensor<2>>,
}

impl Unknowns {
    pub(super) fn at(&self, index: usize) -> Tensor<2> {
        self.matrices[index].clone()
    }
}

/// How a row of numbers is cut into matrices, row by row.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    shapes: Vec<(usize, usize)>,
    device: Device,
}

impl Layout {
    /// The layout of these matrices (entries, rows, columns), and their entries in a row.
    pub(super) fn of(parts: Vec<(Vec<f64>, usize, usize)>, device: &Device) -> (Self, Vec<f64>) {
        let shapes = parts.iter().map(|&(_, rows, columns)| (rows, columns)).collect();
        let flat = parts.into_iter().flat_map(|(entries, _, _)| entries).collect();
        (Self { shapes, device: device.clone() }, flat)
    }

    fn cut(&self, flat: &[f64]) -> Unknowns {
        let mut from = 0;
        let mut next = |&(rows, columns): &(usize, usize)| {
            let tensor = matrix(&flat[from..from + rows * columns], rows, columns, &self.device);
            from += rows * columns;
            tensor.require_grad()
        };
        Unknowns { matrices: self.shapes.iter().map(&mut next).collect() }
    }

    /// The loss and its gradient.
    pub(super) fn value_and_gradient(
        &self,
        flat: &[f64],
        loss: &impl Fn(&Unknowns) -> Tensor<1>,
    ) -> Result<(f64, Vec<f64>), LearnError> {
        let unknowns = self.cut(flat);
        let now = loss(&unknowns);
        let gradients = now.backward();
        let mut flat = Vec::with_capacity(flat.len());
        for (tensor, (rows, columns)) in unknowns.matrices.iter().zip(&self.shapes) {
            match tensor.grad(&gradients) {
                Some(gradient) => flat.extend(values(gradient)?),
                // The loss does not depend on it.
                None => flat.resize(flat.len() + rows * columns, 0.0),
            }
        }
        Ok((now.into_scalar(), flat))
    }
}
