//! Why a text names no group.

use super::names::names;
use crate::nearest::nearest;

/// Why a text names no group.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CatalogueError {
    /// No group has this name.
    #[error(
        "unknown group `{name}`{}; known groups are {known}, and products such as SO3*SO3, SO3^4, SO3 |x R3",
        did_you_mean(.suggestion)
    )]
    Unknown {
        /// The name given.
        name: String,
        /// The nearest known name, if one is near.
        suggestion: Option<String>,
        /// All known names.
        known: String,
    },
    /// The text is not a product of groups.
    #[error("cannot read the group `{text}`: expected {expected} but found {found}")]
    Syntax {
        /// The whole text.
        text: String,
        /// The alternatives there.
        expected: &'static str,
        /// The text there.
        found: String,
    },
    /// The group has too many dimensions.
    #[error("the group `{name}` is too large: {what} is at most {limit}")]
    TooLarge {
        /// The name.
        name: String,
        /// The quantity limited.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// The group does not act on the space given.
    #[error("{group} does not act on {space} here; {instead}")]
    NoAction {
        /// The group.
        group: String,
        /// The space.
        space: String,
        /// A replacement.
        instead: String,
    },
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!(" (did you mean `{name}`?)")).unwrap_or_default()
}

impl CatalogueError {
    pub(super) fn unknown(name: &str) -> Self {
        let suggestion = nearest(name, names().iter().copied()).map(str::to_owned);
        let known = names().join(", ");
        Self::Unknown { name: name.to_owned(), suggestion, known }
    }
}
