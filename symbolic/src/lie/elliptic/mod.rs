//! Bounds of the rotation in ad_x, and of the matrices of the Cayley chart, by quadratic forms.
//!
//! ad_x has the eigenvalues of the factors of a chain of ideals together (in general: a matrix of
//! a representation, those of a chain of submodules). On the factors a nilpotent ideal acts as
//! zero, so its part of x drops out by itself. Each factor is then bounded apart, with A = A(x) its
//! matrix less its trace over its dimension (a real shift), by the first of these that holds:
//!
//! - A = 0: no rotation, no form.
//! - A² = −q(x)·1, as in every factor of dimension 2: q, exactly.
//! - Dimension 3 and tr A³ = 0 for every x, as in the adjoint representations of 𝔰𝔬(3) and 𝔰𝔩(2):
//!   the eigenvalues are 0 and ±√(½ tr A²), so −½ tr A², exactly.
//! - Every A is skew, or 𝔤 modulo what acts as zero has a negative definite Killing form and so a
//!   compact group: the eigenvalues are ±iω_k, and −½ tr A² = Σ ω_k² bounds them all.
//! - Otherwise |Im λ| ≤ ‖(A − Aᵀ)/2‖₂ (Bendixson), and the spectral norm of a skew matrix squared
//!   is at most half its square in Frobenius' norm: ⅛ ‖A − Aᵀ‖_F².

mod form;
mod module;
mod subspace;

pub use form::QuadraticForm;

use super::LieAlgebra;
use crate::number::{integer, ratio};
use module::Module;
use num_traits::{Signed, Zero};
use std::collections::BTreeMap;
use subspace::Vector;

impl LieAlgebra {
    /// Quadratic forms of which the largest bounds the rotation in ad_x: |Im λ|² ≤ max(0, max_f
    /// Q_f(x)) for every eigenvalue λ of ad_x and every x.
    ///
    /// The exponential chart is regular at x where every |Im λ| < 2π and a chart where it is below
    /// π, so Q_f(x) < π² for all of them suffices. No form at all: nothing rotates (nilpotent
    /// algebras, aff(1)), and there is no limit. A form need not be definite: on 𝔰𝔩(2) it is
    /// negative where ad_x has real eigenvalues. Direct factors have forms of their own; equal forms
    /// are given once. It is |ω|² on 𝔰𝔬(3), 𝔰𝔢(2) and 𝔰𝔢(3), two forms on 𝔰𝔬(4).
    ///
    /// ```
    /// use coadjoint_symbolic::lie::catalogue::lookup;
    ///
    /// let forms = lookup("SE3").unwrap().elliptic_forms();
    /// assert_eq!(forms.len(), 1);
    /// assert_eq!(forms[0].value(&[1.0, 2.0, 2.0, 70.0, 80.0, 90.0]), 9.0);
    /// assert!(lookup("Heisenberg").unwrap().elliptic_forms().is_empty());
    /// ```
    #[must_use]
    pub fn elliptic_forms(&self) -> Vec<QuadraticForm> {
        let mut known: Vec<(Self, Vec<QuadraticForm>)> = Vec::new();
        let mut forms = Vec::new();
        for ideal in self.ideals().into_iter().filter(|ideal| ideal.len() > 1) {
            let algebra = self.restricted(&ideal);
            if !known.iter().any(|(other, _)| *other == algebra) {
                let adjoint = || Module::adjoint(&algebra);
                let factors = adjoint().factors();
                let own = factors.into_iter().filter_map(|factor| rotation(&adjoint(), &factor));
                let own = own.collect();
                known.push((algebra.clone(), own));
            }
            for (_, own) in known.iter().filter(|(other, _)| *other == algebra) {
                forms.extend(own.iter().map(|form| form.moved(&ideal)));
            }
        }
        distinct(forms)
    }

    /// Quadratic forms of which the largest bounds the matrices of the Cayley chart: |λ|² ≤ max_f
    /// Q_f(x) for every eigenvalue λ of the matrix of x. None if the algebra has no matrices.
    ///
    /// The chart condition Q_f(x) ≤ 4 for all of them suffices for |λ| ≤ 2, a quarter turn of every
    /// plane, where 1 − x/2 is far from singular: there cay(x) is one to one with a bounded
    /// inverse. The forms are −½ tr A² where the matrices A of x on a factor of the representation
    /// are skew (or of a compact group), ½‖A‖_F² for 2 × 2 matrices without trace, and ‖A‖_F²
    /// otherwise; nilpotent parts of x drop out. It is |ω|² on 𝔰𝔬(3), 𝔰𝔢(2) and 𝔰𝔢(3), |x|²/4 on
    /// the quaternions of 𝔰𝔲(2).
    #[must_use]
    pub fn cayley_forms(&self) -> Option<Vec<QuadraticForm>> {
        self.basis()?;
        let mut known: Vec<(Self, Vec<QuadraticForm>)> = Vec::new();
        let (mut forms, mut offset) = (Vec::new(), 0);
        for algebra in self.factors() {
            let places: Vec<usize> = (offset..offset + algebra.dim()).collect();
            offset += algebra.dim();
            if !known.iter().any(|(other, _)| *other == algebra) {
                let factors = Module::new(algebra.basis()?).factors();
                let adjoint = Module::adjoint(&algebra);
                let own = factors.into_iter().filter_map(|factor| size(&adjoint, &factor));
                let own = own.collect();
                known.push((algebra.clone(), own));
            }
            for (_, own) in known.iter().filter(|(other, _)| *other == algebra) {
                forms.extend(own.iter().map(|form| form.moved(&places)));
            }
        }
        Some(distinct(forms))
    }
}

/// The form of one factor that bounds |Im λ|².
fn rotation(adjoint: &Module, factor: &Module) -> Option<QuadraticForm> {
    let module = factor.traceless();
    if module.is_trivial() {
        return None;
    }
    if let Some(form) = module.square() {
        return Some(form);
    }
    let trace = module.trace_form();
    if (module.dim() == 3 && module.cubes_are_traceless()) || is_compact(adjoint, &module) {
        return Some(trace.scaled(&ratio(-1, 2)));
    }
    // ⅛ ‖A − Aᵀ‖² = ¼ (‖A‖² − tr A²).
    let norm = module.frobenius_form();
    let (norm, trace) = (norm.scaled(&ratio(1, 4)), trace.scaled(&ratio(-1, 4)));
    let terms = norm.terms().chain(trace.terms());
    let form = QuadraticForm::from_entries(terms.map(|(i, j, c)| (i, j, c.clone())));
    (!form.is_zero()).then_some(form)
}

/// The form of one factor that bounds |λ|².
fn size(adjoint: &Module, module: &Module) -> Option<QuadraticForm> {
    if module.is_trivial() {
        return None;
    }
    if is_compact(adjoint, module) {
        return Some(match module.square() {
            Some(form) => form,
            None => module.trace_form().scaled(&ratio(-1, 2)),
        });
    }
    let norm = module.frobenius_form();
    let without_trace = module.traceless().matrices() == module.matrices();
    Some(if module.dim() == 2 && without_trace { norm.scaled(&ratio(1, 2)) } else { norm })
}

/// Whether every matrix has imaginary eigenvalues for one of the two reasons above.
fn is_compact(adjoint: &Module, module: &Module) -> bool {
    if module.is_skew() {
        return true;
    }
    let killing = adjoint.modulo(&module.kernel());
    is_negative_definite(&killing.trace_form(), killing.dim())
}

/// By exact elimination.
fn is_negative_definite(form: &QuadraticForm, dim: usize) -> bool {
    let mut rows = vec![Vector::new(); dim];
    for (i, j, value) in form.terms() {
        let value = if i == j { value.clone() } else { value * ratio(1, 2) };
        rows[j].insert(i, value.clone());
        rows[i].insert(j, value);
    }
    for k in 0..dim {
        let Some(pivot) = rows[k].get(&k).filter(|value| value.is_negative()).cloned() else {
            return false;
        };
        let row: Vec<_> = rows[k].range(k + 1..).map(|(j, v)| (*j, v.clone())).collect();
        for (i, left) in &row {
            for (j, right) in &row {
                let slot = rows[*i].entry(*j).or_insert_with(|| integer(0));
                *slot -= left * right / &pivot;
                if slot.is_zero() {
                    rows[*i].remove(j);
                }
            }
        }
    }
    true
}

/// Each form once, in the order of their first terms.
fn distinct(forms: Vec<QuadraticForm>) -> Vec<QuadraticForm> {
    let key =
        |form: &QuadraticForm| form.terms().map(|(i, j, c)| (i, j, c.clone())).collect::<Vec<_>>();
    let sorted: BTreeMap<_, _> = forms.into_iter().map(|form| (key(&form), form)).collect();
    sorted.into_values().filter(|form| !form.is_zero()).collect()
}
