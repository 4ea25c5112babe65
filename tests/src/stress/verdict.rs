//! Counts of what was found.

use std::fmt::Write as _;

/// What can be wrong with a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wrong {
    /// It does not solve its equation.
    Residual,
    /// It is another solution than the one continued from zero.
    Branch,
    /// x is outside the chart.
    Chart,
    /// The last two terms of the series have a ratio above a half.
    Series,
    /// The state is not where the right solution leads.
    State,
    /// A number is not finite.
    NotFinite,
    /// A refused step changed the state.
    Changed,
    /// A lane's bits depend on its neighbours.
    Lanes,
    /// A step was refused that must be accepted.
    Refused,
}

/// All kinds with their headings.
pub const KINDS: [(Wrong, &str); 9] = [
    (Wrong::Residual, "residual"),
    (Wrong::Branch, "branch"),
    (Wrong::Chart, "chart"),
    (Wrong::Series, "series"),
    (Wrong::State, "state"),
    (Wrong::NotFinite, "NaN"),
    (Wrong::Changed, "changed"),
    (Wrong::Lanes, "lanes"),
    (Wrong::Refused, "refused!"),
];

/// What came of the steps of one family.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were refused.
    pub refused: u64,
    /// Wrong ones by `KINDS`.
    pub wrong: [u64; KINDS.len()],
    /// Accepted ones of which the judge cannot tell.
    pub unsure: u64,
    /// The largest residual / bound of a step that is not wrong.
    pub residual: f64,
    /// The largest deviation / bound of a state that is not wrong.
    pub deviation: f64,
    /// The first examples of each kind.
    pub examples: Vec<(Wrong, String)>,
}

/// Examples kept of each kind.
const EXAMPLES: usize = 3;

impl Tally {
    /// Counts a wrong step.
    pub fn note(&mut self, wrong: Wrong, example: impl FnOnce() -> String) {
        self.wrong[wrong as usize] += 1;
        if self.examples.iter().filter(|e| e.0 == wrong).count() < EXAMPLES {
            self.examples.push((wrong, example()));
        }
    }

    /// Adds what another run found.
    pub fn add(&mut self, other: Self) {
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.unsure += other.unsure;
        self.residual = self.residual.max(other.residual);
        self.deviation = self.deviation.max(other.deviation);
        for (own, other) in self.wrong.iter_mut().zip(other.wrong) {
            *own += other;
        }
        for (wrong, example) in other.examples {
            if self.examples.iter().filter(|e| e.0 == wrong).count() < EXAMPLES {
                self.examples.push((wrong, example));
            }
        }
    }

    /// How many were wrong.
    #[must_use]
    pub fn wrong(&self) -> u64 {
        self.wrong.iter().sum()
    }
}

/// The table of all families, the examples, and a closing line.
#[must_use]
pub fn report(tallies: &[(String, Tally)]) -> String {
    let mut out = String::new();
    let _ = write!(out, "{:<24} {:>10} {:>10}", "family", "accepted", "refused");
    for (_, heading) in KINDS {
        let _ = write!(out, " {heading:>8}");
    }
    let _ = writeln!(out, " {:>8} {:>9} {:>9}", "unsure", "residual", "state");
    let mut whole = Tally::default();
    for (name, tally) in tallies {
        row(&mut out, name, tally);
        whole.add(tally.clone());
    }
    row(&mut out, "all", &whole);
    for (name, tally) in tallies {
        for (wrong, example) in &tally.examples {
            let _ = writeln!(out, "\n{name}, {wrong:?}: {example}");
        }
    }
    let (steps, wrong) = (whole.accepted + whole.refused, whole.wrong());
    let _ = match wrong {
        0 => writeln!(out, "\n{steps} steps, none wrong, {} not told", whole.unsure),
        _ => writeln!(out, "\n{steps} steps, {wrong} WRONG, {} not told", whole.unsure),
    };
    out
}

fn row(out: &mut String, name: &str, tally: &Tally) {
    let _ = write!(out, "{name:<24} {:>10} {:>10}", tally.accepted, tally.refused);
    for count in tally.wrong {
        let _ = write!(out, " {count:>8}");
    }
    let _ =
        writeln!(out, " {:>8} {:>9.1e} {:>9.1e}", tally.unsure, tally.residual, tally.deviation);
}
