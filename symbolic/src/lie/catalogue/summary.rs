//! Descriptions of the groups of the catalogue, in a few words.

/// The description of a group of the catalogue, by its name in the form of [`names`](super::names): without
/// parentheses. `None` for products and for unknown names.
///
/// ```
/// use coadjoint_symbolic::lie::catalogue::{names, summary};
///
/// assert!(names().iter().all(|name| summary(name).is_some()));
/// assert_eq!(summary("SO3").as_deref(), Some("rotations of space; about axes 1, 2, 3"));
/// ```
#[must_use]
pub fn summary(name: &str) -> Option<String> {
    let split = name.find(|c: char| c.is_ascii_digit()).unwrap_or(name.len());
    let (family, digits) = name.split_at(split);
    let n: usize = match digits {
        "" => 0,
        digits => digits.parse().ok()?,
    };
    const PAIRS: &str = "for a < b a real and an imaginary direction, then the diagonal";
    let text = match (family, n) {
        ("SO", 2) => "rotations of the plane".to_owned(),
        ("SO", 3) => "rotations of space; about axes 1, 2, 3".to_owned(),
        ("SO", 4..) => format!("rotations of {n} dimensions; in the planes (a, b), a < b"),
        ("SE", 2) => "rigid motions of the plane; the rotation, then translations".to_owned(),
        ("SE", 3) => "rigid motions of space; rotations as in SO3, then translations".to_owned(),
        ("SU", 2) => "unit quaternions; -i/2 times the Pauli matrices".to_owned(),
        ("SU", 3..) => format!("unitary {n} x {n} matrices of determinant 1; {PAIRS}"),
        ("U", 1) => "complex numbers of modulus 1".to_owned(),
        ("U", 2..) => format!("unitary {n} x {n} matrices; {PAIRS}"),
        ("SL", 2) => "real 2 x 2 matrices of determinant 1; H, E, F".to_owned(),
        ("Heisenberg", 0) => {
            "upper 3 x 3 matrices with diagonal 1; the centre comes last".to_owned()
        }
        ("Aff", 1) => "affine maps of the line; scaling, then translation".to_owned(),
        ("R", 1) => "translations of the line".to_owned(),
        ("R", 2..) => format!("translations of {n} dimensions"),
        _ => return None,
    };
    Some(text)
}
