//! A law, and what a trial says of it.

/// The result of a trial of a law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It holds, as far as was tried.
    Holds,
    /// It does not hold.
    Fails,
    /// Nothing is said, for this reason.
    NotMeasured(&'static str),
}

/// A law and how well it holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Its name.
    pub name: &'static str,
    /// Its statement.
    pub statement: &'static str,
    /// The value measured: the largest relative violation, or the order of accuracy.
    pub value: f64,
    /// The bound it is compared with.
    pub bound: f64,
    /// The result.
    pub verdict: Verdict,
}

impl Law {
    /// The law that a value, a relative violation, is at most the bound; where it is not a number, differences did not settle.
    pub(super) fn at_most(
        name: &'static str,
        statement: &'static str,
        value: f64,
        bound: f64,
    ) -> Self {
        let verdict = match value <= bound {
            true => Verdict::Holds,
            false if value.is_nan() => {
                Verdict::NotMeasured("differences do not settle at any of the points")
            }
            false => Verdict::Fails,
        };
        Self { name, statement, value, bound, verdict }
    }
}
