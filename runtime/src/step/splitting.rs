//! Symmetric splittings into kicks and flows, kick first.
//!
//! S. Blanes, P. C. Moan, *Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström
//! methods*, J. Comput. Appl. Math. 142 (2002) 313–330, tables 2 and 3. The last coefficient of
//! each kind follows from consistency: they sum to one.

use core::fmt::Debug;

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
    const ORDER: u32 = 2;
    const STAGES: usize = 1;
    const KICKS: &'static [f64] = &[0.5];
    const PARTS: &'static [f64] = &[1.0];
}

/// Order 4 in six flows, for a Hamiltonian of degree at most two in the momentum (the method's
/// RKN₆ᵇ): then kicks and the brackets [V, [V, H]] commute, which it relies on.
#[derive(Clone, Copy, Debug)]
pub struct Rkn4;

impl Splitting for Rkn4 {
    const ORDER: u32 = 4;
    const STAGES: usize = 6;
    const KICKS: &'static [f64] = &[
        0.082_984_406_417_405_2,
        0.396_309_801_498_368,
        -0.039_056_304_922_348_6,
        1.0 - 2.0 * (0.082_984_406_417_405_2 + 0.396_309_801_498_368 - 0.039_056_304_922_348_6),
    ];
    const PARTS: &'static [f64] = &[
        0.245_298_957_184_271,
        0.604_872_665_711_080,
        0.5 - (0.245_298_957_184_271 + 0.604_872_665_711_080),
    ];
}

/// Order 6 in eleven flows, for a Hamiltonian of degree at most two in the momentum (the
/// method's RKN₁₁ᵇ).
#[derive(Clone, Copy, Debug)]
pub struct Rkn6;

impl Splitting for Rkn6 {
    const ORDER: u32 = 6;
    const STAGES: usize = 11;
    const KICKS: &'static [f64] = &[
        0.041_464_998_518_262_4,
        0.198_128_671_918_067,
        -0.040_006_192_104_153_3,
        0.075_253_984_301_580_7,
        -0.011_511_387_420_687_9,
        0.5 - (0.041_464_998_518_262_4 + 0.198_128_671_918_067 - 0.040_006_192_104_153_3
            + 0.075_253_984_301_580_7
            - 0.011_511_387_420_687_9),
    ];
    const PARTS: &'static [f64] = &[
        0.123_229_775_946_271,
        0.290_553_797_799_558,
        -0.127_049_212_625_417,
        -0.246_331_761_062_075,
        0.357_208_872_795_928,
        1.0 - 2.0
            * (0.123_229_775_946_271 + 0.290_553_797_799_558
                - 0.127_049_212_625_417
                - 0.246_331_761_062_075
                + 0.357_208_872_795_928),
    ];
}

/// Order 4 in six flows for any Hamiltonian (the method's S₆).
#[derive(Clone, Copy, Debug)]
pub struct Prk4;

impl Splitting for Prk4 {
    const ORDER: u32 = 4;
    const STAGES: usize = 6;
    const KICKS: &'static [f64] = &[
        0.079_203_696_431_195_7,
        0.353_172_906_049_774,
        -0.042_065_080_357_719_5,
        1.0 - 2.0 * (0.079_203_696_431_195_7 + 0.353_172_906_049_774 - 0.042_065_080_357_719_5),
    ];
    const PARTS: &'static [f64] = &[
        0.209_515_106_613_362,
        -0.143_851_773_179_818,
        0.5 - (0.209_515_106_613_362 - 0.143_851_773_179_818),
    ];
}

/// Order 6 in ten flows for any Hamiltonian (the method's S₁₀).
#[derive(Clone, Copy, Debug)]
pub struct Prk6;

impl Splitting for Prk6 {
    const ORDER: u32 = 6;
    const STAGES: usize = 10;
    const KICKS: &'static [f64] = &[
        0.050_262_764_400_392_2,
        0.413_514_300_428_344,
        0.045_079_889_794_397_7,
        -0.188_054_853_819_569,
        0.541_960_678_450_780,
        1.0 - 2.0
            * (0.050_262_764_400_392_2 + 0.413_514_300_428_344 + 0.045_079_889_794_397_7
                - 0.188_054_853_819_569
                + 0.541_960_678_450_780),
    ];
    const PARTS: &'static [f64] = &[
        0.148_816_447_901_042,
        -0.132_385_865_767_784,
        0.067_307_604_692_185,
        0.432_666_402_578_175,
        0.5 - (0.148_816_447_901_042 - 0.132_385_865_767_784
            + 0.067_307_604_692_185
            + 0.432_666_402_578_175),
    ];
}
