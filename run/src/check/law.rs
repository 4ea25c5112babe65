//! A law of the method.

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
    /// Whether it holds.
    pub pass: bool,
}
