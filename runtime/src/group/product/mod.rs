//! Direct products of groups: of two, and of any number of one type.

mod pair;
mod row;

pub use pair::Product;
#[cfg(feature = "alloc")]
pub use row::DirectProduct;
pub use row::Power;
