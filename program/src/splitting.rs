//! Symmetric splittings of a step into kicks and flows, kick first.
//!
//! S. Blanes, P. C. Moan, *Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström
//! methods*, J. Comput. Appl. Math. 142 (2002) 313–330, tables 2 and 3. The last coefficient of
//! each kind follows from consistency: they sum to one.

/// A palindromic sequence of kicks and flows, starting and ending with a kick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Splitting {
    /// The order of accuracy.
    pub order: u32,
    /// How many flows a step has; kicks are one more.
    pub stages: usize,
    /// The lengths of the kicks as parts of the step: the first half of the palindrome, its
    /// middle included.
    pub kicks: &'static [f64],
    /// The lengths of the flows, in the same way.
    pub flows: &'static [f64],
}

/// Half a kick, the flow, half a kick.
pub const STRANG: Splitting = Splitting { order: 2, stages: 1, kicks: &[0.5], flows: &[1.0] };

/// RKN₆ᵇ.
pub const RKN4: Splitting = Splitting {
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

/// RKN₁₁ᵇ.
pub const RKN6: Splitting = Splitting {
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

/// S₆.
pub const PRK4: Splitting = Splitting {
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

/// S₁₀.
pub const PRK6: Splitting = Splitting {
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
