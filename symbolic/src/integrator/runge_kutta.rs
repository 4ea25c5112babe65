//! An explicit method of Runge and Kutta, for guesses along the flow: the "most efficient" one of order six in eight
//! stages of J. H. Verner, Numer. Algorithms 53 (2010) 383-396.
//!
//! Where half the digits will do and the field is cheap it takes less than half the work of Taylor's.
#![allow(clippy::excessive_precision, clippy::unreadable_literal)]

/// Weights of the rates at the stages so far, by their numbers; those that vanish are left out.
pub type Weights = &'static [(usize, f64)];

/// How each stage but the first is reached.
pub const STAGES: &[Weights] = &[
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
];

/// How the end is.
pub const LAST: Weights = &[
    (0, 0.03438957868357036),
    (3, 0.2582624555633503),
    (4, 0.4209371189673537),
    (5, 4.40539646966931),
    (6, -176.48311902429865),
    (7, 172.36413340141507),
];

#[cfg(test)]
mod tests {
    use super::*;

    /// One step for a free rigid body.
    fn step(h: f64, start: [f64; 3]) -> [f64; 3] {
        let field = |y: [f64; 3]| [y[1] * y[2], -y[0] * y[2], -0.5 * y[0] * y[1]];
        let mut rates = vec![field(start)];
        let weigh = |rates: &[[f64; 3]], weights: Weights| {
            let sum = |i: usize| weights.iter().map(|&(j, w)| w * rates[j][i]).sum::<f64>();
            [0, 1, 2].map(|i| start[i] + h * sum(i))
        };
        for weights in STAGES {
            rates.push(field(weigh(&rates, weights)));
        }
        weigh(&rates, LAST)
    }

    /// The largest error after one step, against many short ones.
    fn error(h: f64) -> f64 {
        let start = [0.6, 0.8, 1.0];
        let end = step(h, start);
        let exact = (0..64).fold(start, |y, _| step(h / 64.0, y));
        (0..3).map(|i| (end[i] - exact[i]).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn its_order_is_six() {
        let observed = (error(0.5) / error(0.25)).log2();
        // Its leading error is small: at these steps the next one shows too.
        assert!((6.5..8.5).contains(&observed), "{observed}");
    }
}
