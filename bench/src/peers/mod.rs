//! The methods to measure against, each at its fastest.

pub mod crates;
pub mod dop853;
pub mod dormand_prince;
pub mod embedded;
pub mod gauss;
pub mod general;
pub mod jacobi;
pub mod moser_veselov;
pub mod munthe_kaas;
pub mod splitting;
pub mod taylor;

use crate::method::Method;
use general::General;
use moser_veselov::{Form, MoserVeselov};
use splitting::Splitting;
use taylor::Taylor;

/// Every peer.
#[must_use]
pub fn all() -> Vec<Box<dyn Method>> {
    let mut methods: Vec<Box<dyn Method>> = vec![
        Box::new(General::new("DOP853", "DOP853", 8, embedded::Adaptive(dop853::Dop853))),
        Box::new(General::new("DOP853 (ode_solvers)", "DOP853, crates", 8, crates::OdeSolvers)),
        Box::new(General::new(
            "DOP853 (differential-equations)",
            "DOP853, crates",
            8,
            crates::DifferentialEquations,
        )),
        Box::new(General::new(
            "RK45",
            "RK45",
            5,
            embedded::Adaptive(dormand_prince::DormandPrince),
        )),
        Box::new(Taylor::<13>::fixed()),
        Box::new(Taylor::<17>::fixed()),
        Box::new(Taylor::<21>::fixed()),
        Box::new(Taylor::<13>::adaptive()),
        Box::new(Taylor::<17>::adaptive()),
        Box::new(Taylor::<21>::adaptive()),
        Box::new(General::new("Gauss, order 4", "Gauss", 4, gauss::Gauss::<2, 2>::default())),
        Box::new(General::new("Gauss, order 6", "Gauss", 6, gauss::Gauss::<3, 4>::default())),
        Box::new(General::new("Gauss, order 8", "Gauss", 8, gauss::Gauss::<4, 4>::default())),
        Box::new(munthe_kaas::MuntheKaas),
        Box::new(Splitting::order2()),
        Box::new(Splitting::order4()),
        Box::new(Splitting::order6()),
        Box::new(Splitting::order8()),
    ];
    for form in [Form::FixedPoint, Form::Newton, Form::Compensated] {
        for order in [2, 4, 6, 8, 10] {
            methods.push(Box::new(MoserVeselov::new(order, form)));
        }
    }
    methods.push(Box::new(jacobi::Exact));
    methods
}
