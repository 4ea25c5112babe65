//! The types that emitted items mention.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Options;
use super::group::group_type;
use crate::lie::{Chart, LieAlgebra};

/// The types that emitted items mention, and the items that define them.
pub(crate) struct Types {
    /// The dimension of the algebra.
    pub dim: usize,
    /// The group, over the scalar `T`.
    pub group: TokenStream,
    /// Whether elements are matrices in the representation of the basis, also those of a product.
    pub by_tables: bool,
    /// The chart.
    pub chart: TokenStream,
    /// Vectors of the algebra or its dual, over the scalar `T`.
    pub vector: TokenStream,
    /// Square matrices of this dimension, over the scalar `T`.
    pub matrix: TokenStream,
    /// Items the group needs, to stand beside the struct.
    pub definition: TokenStream,
    /// Tables of the group, to stand at the end.
    pub tables: TokenStream,
    /// The aliases for a block that uses these types.
    pub aliases: TokenStream,
}

impl Types {
    /// The types for this algebra and chart.
    #[must_use]
    pub(crate) fn new(algebra: &LieAlgebra, chart: Chart, options: &Options) -> Self {
        let Options { krate, visibility, name, .. } = options;
        let dim = algebra.dim();
        let n = Literal::usize_unsuffixed(dim);
        let chart = match chart {
            Chart::Exponential => quote!(#krate::groups::Exponential),
            Chart::Cayley => quote!(#krate::groups::Cayley),
        };
        let group = group_type(algebra, name, visibility, krate);
        // In a block of their own; the struct may have either name.
        let alias = |plain: &str| match *name == plain {
            true => format_ident!("{plain}Of"),
            false => format_ident!("{plain}"),
        };
        let (vector, matrix) = (alias("Vector"), alias("Matrix"));
        Self {
            dim,
            group: group.ty,
            by_tables: group.by_tables,
            chart,
            vector: quote!(#vector<T>),
            matrix: quote!(#matrix<T>),
            definition: group.definition,
            tables: group.tables,
            aliases: quote! {
                // Whatever names the user has in scope.
                use ::core::prelude::v1::*;
                use #krate::plumbing::Coefficients as _;

                type #vector<T> = #krate::nalgebra::SVector<T, #n>;
                type #matrix<T> = #krate::nalgebra::SMatrix<T, #n, #n>;
            },
        }
    }
}
