//! Symmetric splittings into kicks and flows, kick first.
//!
//! S. Blanes, P. C. Moan, *Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods*, J. Comput. Appl.
//! Math. 142 (2002) 313–330, tables 2 and 3. The lengths are those of the runtime's `steps`, whose users need no exact
//! algebra; a test compares both.

/// A palindromic sequence of kicks and flows, starting and ending with a kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Splitting {
    /// Half a kick, the flow, half a kick: order 2.
    Strang,
    /// Order 4 in six flows, for Hamiltonians of degree at most two (RKN₆ᵇ).
    Rkn4,
    /// Order 6 in eleven flows, for Hamiltonians of degree at most two (RKN₁₁ᵇ).
    Rkn6,
    /// Order 4 in six flows (S₆).
    Prk4,
    /// Order 6 in ten flows (S₁₀).
    Prk6,
}

/// The first lengths of kicks and of flows as parts of a step, and whether the number of flows is odd. The next of each, which is
/// in the middle of the palindrome or stands there twice, follows: all lengths sum to one.
type Halves = (&'static [f64], &'static [f64], bool);

const RKN4: Halves = (
    &[0.082_984_406_417_405_2, 0.396_309_801_498_368, -0.039_056_304_922_348_6],
    &[0.245_298_957_184_271, 0.604_872_665_711_080],
    false,
);
const RKN6: Halves = (
    &[
        0.041_464_998_518_262_4,
        0.198_128_671_918_067,
        -0.040_006_192_104_153_3,
        0.075_253_984_301_580_7,
        -0.011_511_387_420_687_9,
    ],
    &[
        0.123_229_775_946_271,
        0.290_553_797_799_558,
        -0.127_049_212_625_417,
        -0.246_331_761_062_075,
        0.357_208_872_795_928,
    ],
    true,
);
const PRK4: Halves = (
    &[0.079_203_696_431_195_7, 0.353_172_906_049_774, -0.042_065_080_357_719_5],
    &[0.209_515_106_613_362, -0.143_851_773_179_818],
    false,
);
const PRK6: Halves = (
    &[
        0.050_262_764_400_392_2,
        0.413_514_300_428_344,
        0.045_079_889_794_397_7,
        -0.188_054_853_819_569,
        0.541_960_678_450_780,
    ],
    &[0.148_816_447_901_042, -0.132_385_865_767_784, 0.067_307_604_692_185, 0.432_666_402_578_175],
    false,
);

impl Splitting {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Strang, Self::Rkn4, Self::Rkn6, Self::Prk4, Self::Prk6];

    /// The name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Strang => "strang",
            Self::Rkn4 => "rkn4",
            Self::Rkn6 => "rkn6",
            Self::Prk4 => "prk4",
            Self::Prk6 => "prk6",
        }
    }

    /// The order of accuracy.
    #[must_use]
    pub fn order(self) -> u32 {
        match self {
            Self::Strang => 2,
            Self::Rkn4 | Self::Prk4 => 4,
            Self::Rkn6 | Self::Prk6 => 6,
        }
    }

    /// The lengths of the kicks of a step, as parts of it.
    #[must_use]
    pub fn kicks(self) -> Vec<f64> {
        let (kicks, _, odd) = self.halves();
        palindrome(kicks, !odd)
    }

    /// The lengths of the flows of a step, as parts of it; kicks are one more.
    #[must_use]
    pub fn flows(self) -> Vec<f64> {
        let (_, flows, odd) = self.halves();
        palindrome(flows, odd)
    }

    fn halves(self) -> Halves {
        match self {
            Self::Strang => (&[], &[], true),
            Self::Rkn4 => RKN4,
            Self::Rkn6 => RKN6,
            Self::Prk4 => PRK4,
            Self::Prk6 => PRK6,
        }
    }
}

/// A palindrome of an odd or even number of lengths from the first of them; the last that there is follows.
fn palindrome(first: &[f64], odd: bool) -> Vec<f64> {
    let sum: f64 = first.iter().sum();
    let last = if odd { 1.0 - 2.0 * sum } else { 0.5 - sum };
    let mut whole = first.to_vec();
    whole.push(last);
    let mirrored: Vec<f64> = whole.iter().rev().skip(usize::from(odd)).copied().collect();
    whole.extend(mirrored);
    whole
}
