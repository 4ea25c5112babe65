//! Direct products of groups: of two, and of any number of one type.

pub(crate) mod pair;
pub(crate) mod row;
