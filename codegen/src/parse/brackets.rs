//! Brackets of generators: `[a, b] = -1/2*c + d`.

use super::names::{Name, Names};
use super::text;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::Arena;
use crate::lie::LieAlgebraError;
use crate::number::Rational;
use crate::pass::linear;
use num_traits::Zero;

/// \\[e_i, e_j\\] with its components along the generators: (i, j, [(k, c_ij^k)]).
pub(crate) type Bracket = (usize, usize, Vec<(usize, Rational)>);

/// Reads one bracket. The generators are the coordinates among `names`; `line` begins at byte
/// `offset` of its source, and `whole` is where it stands.
pub(crate) fn bracket(
    line: &str,
    offset: usize,
    whole: Span,
    names: &Names,
    diagnostics: &Diagnostics,
) -> Option<Bracket> {
    let parts = line.split_once('=').and_then(|(left, right)| {
        let inside = left.trim().strip_prefix('[')?.strip_suffix(']')?;
        let (a, b) = inside.split_once(',')?;
        Some((a.trim(), b.trim(), right))
    });
    let Some((a, b, right)) = parts else {
        let help = "write for example \"[a, b] = c\" or \"[a, c] = -1/2*b\"";
        diagnostics.report_other(whole, format!("`{line}` is no bracket"), help);
        return None;
    };
    let generator = |name: &str| match names.get(name) {
        Some(Name::Coordinate(i)) => Some(*i),
        _ => {
            diagnostics.report(whole, names.unknown(name));
            None
        }
    };
    let (i, j) = (generator(a), generator(b));
    let mut arena = Arena::new();
    let start = offset + line.len() - right.len();
    let before = diagnostics.len();
    let root = text::parse(right, start, &[], names, &mut arena, diagnostics);
    if diagnostics.len() > before {
        return None;
    }
    let components = linear(&arena, root, diagnostics)?;
    let (i, j) = (i?, j?);
    if i == j && components.iter().any(|(_, value)| !value.is_zero()) {
        let wrong = LieAlgebraError::SelfBracket { generator: a.to_owned(), index: i };
        diagnostics.report(whole, Mistake::Algebra(wrong));
        return None;
    }
    Some((i, j, components))
}
