//! The key `potential`: a polynomial in the entries of the group element's matrix.

use super::hamiltonian::content_offset;
use super::parameters::Parameters;
use super::table::Table;
use crate::diagnostic::{Diagnostics, Span};
use crate::expr::Arena;
use crate::lie::LieAlgebra;
use crate::parse::{Name, Names, text};
use crate::pass::PotentialDraft;
use crate::potential::matrix_size;

const POTENTIAL: &str = "potential = \"m*g[2][2]\"";

/// Reads `potential`, if the file has one and its group is known.
pub(super) fn read(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    given: &Parameters,
    file: &str,
    diagnostics: &mut Diagnostics,
) -> Option<PotentialDraft> {
    let (text, place) = root.string("potential", POTENTIAL, diagnostics)?;
    let algebra = algebra?;
    let size = matrix_size(algebra);
    let mut names = Names::default();
    for at in 0..size * size {
        let name = format!("g[{}][{}]", at / size, at % size);
        names.add(&name, Name::Coordinate(at), Span::Whole, diagnostics);
    }
    let parameters = given.add_to(&mut names, diagnostics);
    let mut arena = Arena::new();
    let offset = content_offset(file, place, text);
    let energy = text::parse(text, offset, &names, &mut arena, diagnostics);
    Some(PotentialDraft {
        name: "potential".to_owned(),
        algebra: Some(algebra.clone()),
        declared: None,
        arena,
        energy: Some((energy, place)),
        parameters,
        source: text.to_owned(),
    })
}
