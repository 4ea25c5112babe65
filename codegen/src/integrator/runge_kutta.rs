//! Explicit methods of Runge and Kutta, for guesses along the flow.
//!
//! Where half the digits will do and the field is cheap they take less than half the work of Taylor's.
#![allow(clippy::excessive_precision, clippy::unreadable_literal)]

/// Weights of the rates at the stages so far, by their numbers; those that vanish are left out.
type Weights = &'static [(usize, f64)];

/// An explicit method.
pub struct Method {
    /// How each stage but the first is reached.
    pub stages: &'static [Weights],
    /// How the end is.
    pub last: Weights,
}

/// The "most efficient" method of order six in eight stages: J. H. Verner, Numer. Algorithms 53 (2010) 383-396.
pub const SIXTH: Method = Method {
    stages: &[
        &[(0, 0.06)],
        &[(0, 0.019239962962962962), (1, 0.07669337037037037)],
        &[(0, 0.035975), (2, 0.107925)],
        &[(0, 1.3186834152331484), (2, -5.042058063628562), (3, 4.220674648395414)],
        &[
            (0, -41.872591664327516),
            (2, 159.4325621631375),
            (3, -122.11921356501003),
            (4, 5.531743066200054),
        ],
        &[
            (0, -54.430156935316504),
            (2, 207.06725136501848),
            (3, -158.61081378459),
            (4, 6.991816585950242),
            (5, -0.018597231062203234),
        ],
        &[
            (0, -54.66374178728198),
            (2, 207.95280625538936),
            (3, -159.2889574744995),
            (4, 7.018743740796944),
            (5, -0.018338785905045722),
            (6, -0.0005119484997882099),
        ],
    ],
    last: &[
        (0, 0.03438957868357036),
        (3, 0.2582624555633503),
        (4, 0.4209371189673537),
        (5, 4.40539646966931),
        (6, -176.48311902429865),
        (7, 172.36413340141507),
    ],
};

/// The method of order eight of Dormand and Prince in twelve stages: Hairer, Nørsett and Wanner, *Solving
/// Ordinary Differential Equations I*, 2nd ed., section II.5 (code DOP853).
pub const EIGHTH: Method = Method {
    stages: &[
        &[(0, 0.05260015195876773)],
        &[(0, 0.0197250569845379), (1, 0.0591751709536137)],
        &[(0, 0.02958758547680685), (2, 0.08876275643042054)],
        &[(0, 0.2413651341592667), (2, -0.8845494793282861), (3, 0.924834003261792)],
        &[(0, 0.037037037037037035), (3, 0.17082860872947386), (4, 0.12546768756682242)],
        &[(0, 0.037109375), (3, 0.17025221101954405), (4, 0.06021653898045596), (5, -0.017578125)],
        &[
            (0, 0.03709200011850479),
            (3, 0.17038392571223998),
            (4, 0.10726203044637328),
            (5, -0.015319437748624402),
            (6, 0.008273789163814023),
        ],
        &[
            (0, 0.6241109587160757),
            (3, -3.3608926294469414),
            (4, -0.868219346841726),
            (5, 27.59209969944671),
            (6, 20.154067550477894),
            (7, -43.48988418106996),
        ],
        &[
            (0, 0.47766253643826434),
            (3, -2.4881146199716677),
            (4, -0.590290826836843),
            (5, 21.230051448181193),
            (6, 15.279233632882423),
            (7, -33.28821096898486),
            (8, -0.020331201708508627),
        ],
        &[
            (0, -0.9371424300859873),
            (3, 5.186372428844064),
            (4, 1.0914373489967295),
            (5, -8.149787010746927),
            (6, -18.52006565999696),
            (7, 22.739487099350505),
            (8, 2.4936055526796523),
            (9, -3.0467644718982196),
        ],
        &[
            (0, 2.273310147516538),
            (3, -10.53449546673725),
            (4, -2.0008720582248625),
            (5, -17.9589318631188),
            (6, 27.94888452941996),
            (7, -2.8589982771350235),
            (8, -8.87285693353063),
            (9, 12.360567175794303),
            (10, 0.6433927460157636),
        ],
    ],
    last: &[
        (0, 0.054293734116568765),
        (5, 4.450312892752409),
        (6, 1.8915178993145003),
        (7, -5.801203960010585),
        (8, 0.3111643669578199),
        (9, -0.1521609496625161),
        (10, 0.20136540080403034),
        (11, 0.04471061572777259),
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    /// One step for a free rigid body.
    fn step(method: &Method, h: f64, start: [f64; 3]) -> [f64; 3] {
        let field = |y: [f64; 3]| [y[1] * y[2], -y[0] * y[2], -0.5 * y[0] * y[1]];
        let mut rates = vec![field(start)];
        let weigh = |rates: &[[f64; 3]], weights: Weights| {
            let sum = |i: usize| weights.iter().map(|&(j, w)| w * rates[j][i]).sum::<f64>();
            [0, 1, 2].map(|i| start[i] + h * sum(i))
        };
        for weights in method.stages {
            rates.push(field(weigh(&rates, weights)));
        }
        weigh(&rates, method.last)
    }

    /// The largest error after one step, against many short ones.
    fn error(method: &Method, h: f64) -> f64 {
        let start = [0.6, 0.8, 1.0];
        let end = step(method, h, start);
        let exact = (0..64).fold(start, |y, _| step(&EIGHTH, h / 64.0, y));
        (0..3).map(|i| (end[i] - exact[i]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn orders_are_six_and_eight() {
        for (method, order) in [(SIXTH, 6.0), (EIGHTH, 8.0)] {
            let observed = (error(&method, 2.0) / error(&method, 1.0)).log2();
            assert!(observed > order + 0.5, "{observed} for {order}");
        }
    }
}
