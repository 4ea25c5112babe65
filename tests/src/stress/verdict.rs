//! Counts of what was found.

use std::fmt::Write as _;

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
    NotFinite,
    /// A refused step changed the state.
    Changed,
    /// A lane's bits depend on its neighbours.
    Lanes,
    /// A step was refused that must be accepted.
    Refused,
    /// An x that was made wrong on purpose was not told from a right one.
    Missed,
}

pub const KINDS: [(Wrong, &str); 10] = [
    (Wrong::Residual, "residual"),
    (Wrong::Branch, "branch"),
    (Wrong::Chart, "chart"),
    (Wrong::Series, "series"),
    (Wrong::State, "state"),
    (Wrong::NotFinite, "NaN"),
    (Wrong::Changed, "changed"),
    (Wrong::Lanes, "lanes"),
    (Wrong::Refused, "refused!"),
    (Wrong::Missed, "missed"),
];

#[derive(Clone, Debug, Default)]
pub struct Tally {
    pub accepted: u64,
    pub refused: u64,
    /// Steps among them that would have been right, where it is asked.
    pub right: u64,
    /// Steps among them that must be accepted.
    pub promised: u64,
    /// Right x made wrong on purpose, by more than rounding.
    pub spoilt: u64,
    pub wrong: [u64; KINDS.len()],
    /// Accepted ones of which the judge cannot tell.
    pub unsure: u64,
    /// The largest residual / bound of a step that is not wrong.
    pub residual: f64,
    pub worst: String,
    /// The largest deviation / bound of a state that is not wrong.
    pub deviation: f64,
    pub seconds: f64,
    pub examples: Vec<(Wrong, String)>,
}

/// The share of its bound from which a residual is reported.
const REMARKABLE: f64 = 0.25;

/// Examples kept of each kind.
const EXAMPLES: usize = 3;

impl Tally {
    pub fn note(&mut self, wrong: Wrong, example: impl FnOnce() -> String) {
        self.wrong[wrong as usize] += 1;
        if self.examples.iter().filter(|e| e.0 == wrong).count() < EXAMPLES {
            self.examples.push((wrong, example()));
        }
    }

    pub fn add(&mut self, other: Self) {
        self.accepted += other.accepted;
        self.refused += other.refused;
        self.right += other.right;
        self.promised += other.promised;
        self.spoilt += other.spoilt;
        self.unsure += other.unsure;
        self.seconds += other.seconds;
        if other.residual > self.residual {
            (self.residual, self.worst) = (other.residual, other.worst);
        }
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

    pub fn wrong(&self) -> u64 {
        self.wrong.iter().sum()
    }
}

/// How long steps of each family took, judged.
pub fn times(tallies: &[(String, Tally)]) -> String {
    let mut out = String::new();
    for (name, tally) in tallies {
        let steps = tally.accepted + tally.refused;
        let each = 1e6 * tally.seconds / steps.max(1) as f64;
        let _ = writeln!(
            out,
            "{name:<24} {steps:>9} steps {:>8.1} s {each:>8.0} µs each",
            tally.seconds
        );
    }
    out
}

/// The table of all families, the examples, and a closing line.
pub fn report(tallies: &[(String, Tally)]) -> String {
    let mut out = String::new();
    let _ = write!(
        out,
        "{:<24} {:>9} {:>9} {:>7} {:>8} {:>7}",
        "family", "accepted", "refused", "right", "promised", "spoilt"
    );
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
    for (name, tally) in tallies.iter().filter(|(_, tally)| tally.residual > REMARKABLE) {
        let _ = writeln!(out, "\n{name}, almost a residual: {}", tally.worst);
    }
    let (steps, wrong) = (whole.accepted + whole.refused, whole.wrong());
    let _ = match wrong {
        0 => writeln!(out, "\n{steps} steps, none wrong, {} not told", whole.unsure),
        _ => writeln!(out, "\n{steps} steps, {wrong} WRONG, {} not told", whole.unsure),
    };
    out
}

fn row(out: &mut String, name: &str, tally: &Tally) {
    let _ = write!(
        out,
        "{name:<24} {:>9} {:>9} {:>7} {:>8} {:>7}",
        tally.accepted, tally.refused, tally.right, tally.promised, tally.spoilt
    );
    for count in tally.wrong {
        let _ = write!(out, " {count:>8}");
    }
    let _ =
        writeln!(out, " {:>8} {:>9.1e} {:>9.1e}", tally.unsure, tally.residual, tally.deviation);
}
