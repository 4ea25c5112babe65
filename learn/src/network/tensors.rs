//! A dense network over tensors: its value and its slope.

use burn::tensor::Tensor;

use super::activation::Activation;
use super::architecture::Architecture;
use super::objective::Unknowns;

impl Architecture {
    fn activate(&self, z: Tensor<2>) -> (Tensor<2>, Tensor<2>) {
        match self.activation {
            Activation::Tanh => {
                let a = z.tanh();
                let slope = a.clone().mul(a.clone()).neg().add_scalar(1.0);
                (a, slope)
            }
            Activation::Logistic => {
                let a = burn::tensor::activation::sigmoid(z);
                let slope = a.clone().mul(a.clone().neg().add_scalar(1.0));
                (a, slope)
            }
        }
    }

    /// N(u), a row per sample; the network's matrices begin at `first`.
    pub(super) fn value(&self, unknowns: &Unknowns, first: usize, u: Tensor<2>) -> Tensor<2> {
        let mut a = u;
        for k in 0..self.widths.len() {
            let at = first + 2 * k;
            a = self.activate(a.matmul(unknowns.at(at)).add(unknowns.at(at + 1))).0;
        }
        a.matmul(unknowns.at(first + self.len() - 1))
    }

    /// ∂N/∂u of a network with one output, a row per sample: written as forward operations,
    /// because the framework does not differentiate twice.
    pub(super) fn slope(&self, unknowns: &Unknowns, first: usize, u: Tensor<2>) -> Tensor<2> {
        let samples = u.dims()[0];
        let mut a = u;
        let mut slopes = Vec::with_capacity(self.widths.len());
        for k in 0..self.widths.len() {
            let at = first + 2 * k;
            let (next, slope) = self.activate(a.matmul(unknowns.at(at)).add(unknowns.at(at + 1)));
            a = next;
            slopes.push(slope);
        }
        let last = unknowns.at(first + self.len() - 1).transpose();
        let mut back = last.repeat_dim(0, samples);
        for (k, slope) in slopes.into_iter().enumerate().rev() {
            back = back.mul(slope).matmul(unknowns.at(first + 2 * k).transpose());
        }
        back
    }
}
