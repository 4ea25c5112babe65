//! The names of the catalogue.

/// The names of the catalogue, families by their smallest members.
#[must_use]
pub fn names() -> &'static [&'static str] {
    &[
        "SO2",
        "SO3",
        "SO4",
        "SO5",
        "SE2",
        "SE3",
        "SU2",
        "SU3",
        "SU4",
        "U1",
        "U2",
        "U3",
        "SL2",
        "Heisenberg",
        "Aff1",
        "R1",
        "R2",
        "R3",
    ]
}
