//! Symmetric splittings of a step into kicks and flows, kick first.
//!
//! S. Blanes, P. C. Moan, *Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström
//! methods*, J. Comput. Appl. Math. 142 (2002) 313–330, tables 2 and 3. The last coefficient of
//! each kind follows from consistency: they sum to one.

/// A palindromic sequence of kicks and flows, starting and ending with a kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Splitting {
    /// Half a kick, the flow, half a kick: order 2.
    Strang,
    /// Order 4 in six flows, for a Hamiltonian of degree at most two in the momentum (RKN₆ᵇ): then kicks and the brackets
    /// [V, [V, H]] commute, which it relies on.
    Rkn4,
    /// Order 6 in eleven flows, for a Hamiltonian of degree at most two in the momentum (RKN₁₁ᵇ).
    Rkn6,
    /// Order 4 in six flows for any Hamiltonian (S₆).
    Prk4,
    /// Order 6 in ten flows for any Hamiltonian (S₁₀).
    Prk6,
}

/// The lengths of a splitting, as parts of the step: the first halves of the palindromes, their middles included.
struct Lengths {
    name: &'static str,
    order: u32,
    /// The number of flows in a step; there is one kick more.
    stages: usize,
    kicks: &'static [f64],
    flows: &'static [f64],
}

impl Splitting {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Strang, Self::Rkn4, Self::Rkn6, Self::Prk4, Self::Prk6];
    /// The most flows of different length that one of them has.
    pub const MAX_FLOWS: usize = 6;

    /// The name in files.
    pub fn name(self) -> &'static str {
        self.lengths().name
    }

    /// The order of accuracy.
    pub fn order(self) -> u32 {
        self.lengths().order
    }

    /// The lengths of the kicks of a step, as parts of it.
    pub fn kicks(self) -> impl Iterator<Item = f64> {
        let Lengths { stages, kicks, .. } = self.lengths();
        (0..=stages).map(move |i| kicks[i.min(stages - i)])
    }

    /// The lengths of the flows of a step, as parts of it; kicks are one more.
    pub fn flows(self) -> impl ExactSizeIterator<Item = f64> {
        let Lengths { stages, flows, .. } = self.lengths();
        (0..stages).map(move |i| flows[i.min(stages - 1 - i)])
    }

    fn lengths(self) -> Lengths {
        match self {
            Self::Strang => STRANG,
            Self::Rkn4 => RKN4,
            Self::Rkn6 => RKN6,
            Self::Prk4 => PRK4,
            Self::Prk6 => PRK6,
        }
    }
}

const STRANG: Lengths =
    Lengths { name: "strang", order: 2, stages: 1, kicks: &[0.5], flows: &[1.0] };

const RKN4: Lengths = Lengths {
    name: "rkn4",
    order: 4,
    stages: 6,
    kicks: &[
        0.082_984_406_417_405_2,
        0.396_309_801_498_368,
        -0.039_056_304_922_348_6,
        1.0 - 2.0 * (0.082_984_406_417_405_2 + 0.396_309_801_498_368 - 0.039_056_304_922_348_6),
    ],
    flows: &[
        0.245_298_957_184_271,
        0.604_872_665_711_080,
        0.5 - (0.245_298_957_184_271 + 0.604_872_665_711_080),
    ],
};

const RKN6: Lengths = Lengths {
    name: "rkn6",
    order: 6,
    stages: 11,
    kicks: &[
        0.041_464_998_518_262_4,
        0.198_128_671_918_067,
        -0.040_006_192_104_153_3,
        0.075_253_984_301_580_7,
        -0.011_511_387_420_687_9,
        0.5 - (0.041_464_998_518_262_4 + 0.198_128_671_918_067 - 0.040_006_192_104_153_3
            + 0.075_253_984_301_580_7
            - 0.011_511_387_420_687_9),
    ],
    flows: &[
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
    ],
};

const PRK4: Lengths = Lengths {
    name: "prk4",
    order: 4,
    stages: 6,
    kicks: &[
        0.079_203_696_431_195_7,
        0.353_172_906_049_774,
        -0.042_065_080_357_719_5,
        1.0 - 2.0 * (0.079_203_696_431_195_7 + 0.353_172_906_049_774 - 0.042_065_080_357_719_5),
    ],
    flows: &[
        0.209_515_106_613_362,
        -0.143_851_773_179_818,
        0.5 - (0.209_515_106_613_362 - 0.143_851_773_179_818),
    ],
};

const PRK6: Lengths = Lengths {
    name: "prk6",
    order: 6,
    stages: 10,
    kicks: &[
        0.050_262_764_400_392_2,
        0.413_514_300_428_344,
        0.045_079_889_794_397_7,
        -0.188_054_853_819_569,
        0.541_960_678_450_780,
        1.0 - 2.0
            * (0.050_262_764_400_392_2 + 0.413_514_300_428_344 + 0.045_079_889_794_397_7
                - 0.188_054_853_819_569
                + 0.541_960_678_450_780),
    ],
    flows: &[
        0.148_816_447_901_042,
        -0.132_385_865_767_784,
        0.067_307_604_692_185,
        0.432_666_402_578_175,
        0.5 - (0.148_816_447_901_042 - 0.132_385_865_767_784
            + 0.067_307_604_692_185
            + 0.432_666_402_578_175),
    ],
};
