//! Formulas of Lie groups, each written once for all kinds of numbers.
//!
//! A formula is a function of arrays `[T; N]` of a [`number::Number`] T: a scalar or lanes (feature `simba`), a
//! [`row::Tuple`] of nodes side by side, a [`dual::Dual`] number, or a type that writes the nodes of a program as the formula
//! runs. Steps that run as programs and those of the generic runtime are then made of the same text.
#![no_std]

pub mod angle;
pub mod bernoulli;
pub mod dual;
pub mod group;
pub mod motion;
pub mod number;
pub mod plane;
pub mod rotation;
pub mod row;
pub mod series;
pub mod vector;
