//! Symmetric splittings into kicks and flows, kick first.

use core::fmt::Debug;

use coadjoint_program::splitting::{PRK4, PRK6, RKN4, RKN6, STRANG};

/// A palindromic sequence of kicks and flows, starting and ending with a kick.
pub trait Splitting: Copy + Debug {
    /// The order of accuracy.
    const ORDER: u32;
    /// How many flows a step has; kicks are one more.
    const STAGES: usize;
    /// The lengths of the kicks as parts of the step: the first half of the palindrome, its
    /// middle included.
    const KICKS: &'static [f64];
    /// The lengths of the flows, in the same way; at most [`MAX_FLOWS`].
    const PARTS: &'static [f64];
}

/// The most flows of different length a splitting may have.
pub const MAX_FLOWS: usize = 6;

/// Half a kick, the flow, half a kick: order 2.
#[derive(Clone, Copy, Debug)]
pub struct Strang;

impl Splitting for Strang {
    const ORDER: u32 = STRANG.order;
    const STAGES: usize = STRANG.stages;
    const KICKS: &'static [f64] = STRANG.kicks;
    const PARTS: &'static [f64] = STRANG.flows;
}

/// Order 4 in six flows, for a Hamiltonian of degree at most two in the momentum (the method's
/// RKN₆ᵇ): then kicks and the brackets [V, [V, H]] commute, which it relies on.
#[derive(Clone, Copy, Debug)]
pub struct Rkn4;

impl Splitting for Rkn4 {
    const ORDER: u32 = RKN4.order;
    const STAGES: usize = RKN4.stages;
    const KICKS: &'static [f64] = RKN4.kicks;
    const PARTS: &'static [f64] = RKN4.flows;
}

/// Order 6 in eleven flows, for a Hamiltonian of degree at most two in the momentum (the
/// method's RKN₁₁ᵇ).
#[derive(Clone, Copy, Debug)]
pub struct Rkn6;

impl Splitting for Rkn6 {
    const ORDER: u32 = RKN6.order;
    const STAGES: usize = RKN6.stages;
    const KICKS: &'static [f64] = RKN6.kicks;
    const PARTS: &'static [f64] = RKN6.flows;
}

/// Order 4 in six flows for any Hamiltonian (the method's S₆).
#[derive(Clone, Copy, Debug)]
pub struct Prk4;

impl Splitting for Prk4 {
    const ORDER: u32 = PRK4.order;
    const STAGES: usize = PRK4.stages;
    const KICKS: &'static [f64] = PRK4.kicks;
    const PARTS: &'static [f64] = PRK4.flows;
}

/// Order 6 in ten flows for any Hamiltonian (the method's S₁₀).
#[derive(Clone, Copy, Debug)]
pub struct Prk6;

impl Splitting for Prk6 {
    const ORDER: u32 = PRK6.order;
    const STAGES: usize = PRK6.stages;
    const KICKS: &'static [f64] = PRK6.kicks;
    const PARTS: &'static [f64] = PRK6.flows;
}
