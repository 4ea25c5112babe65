//! The runtime type of a problem's group.

use coadjoint_program::quoting::rust_comment;
use num_traits::ToPrimitive;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::emit::Options;
use crate::emit::program::{float, tokens};
use crate::emit::table::list;
use crate::lie::{Chart, LieAlgebra, catalogue, watched_casimirs};
use crate::number::Rational;
use crate::step::Elements;

/// Groups the runtime has closed forms for, under the catalogue's name.
const CLOSED_FORMS: [&str; 4] = ["SO3", "SE3", "SU2", "SE2"];

/// Groups the runtime has tables for, under the catalogue's name.
pub const RUNTIME_TABLES: [&str; 8] =
    ["Aff1", "Heisenberg", "SE23", "SL2", "SO4", "SO5", "SU3", "Sp4"];

/// The group in generated code.
pub(crate) struct GroupType {
    /// The type, generic over the scalar `T` in scope.
    pub ty: TokenStream,
    /// Items it needs, to stand beside the integrator.
    pub definition: TokenStream,
    /// The tables of those items.
    pub tables: TokenStream,
    /// True if the whole group is given by tables.
    pub by_tables: bool,
}

/// The runtime type for `algebra`: one of the runtime's own, or tables written beside the
/// integrator `name`.
pub(crate) fn group_type(
    algebra: &LieAlgebra,
    name: &Ident,
    visibility: &TokenStream,
    krate: &TokenStream,
) -> GroupType {
    let nothing = TokenStream::new;
    // An algebra of the user's own may have the name of one in the catalogue.
    let known = catalogue::lookup(algebra.name()).is_ok_and(|known| known == *algebra);
    if known && CLOSED_FORMS.iter().chain(&RUNTIME_TABLES).any(|known| *known == algebra.name()) {
        let group = format_ident!("{}", algebra.name());
        let ty = quote!(#krate::groups::#group<T>);
        return GroupType { ty, definition: nothing(), tables: nothing(), by_tables: false };
    }
    let group = format_ident!("{name}Group");
    // Factors act on their own coordinates: far cheaper than one group of large matrices.
    let product = known.then(|| product(algebra, krate)).flatten();
    let by_tables = product.is_none();
    let (definition, tables) = match product {
        Some(ty) => {
            let about = format!(" The group {}.", rust_comment(algebra.name()));
            let definition = quote! {
                #[doc = #about]
                #visibility type #group<T = f64> = #ty;
            };
            (definition, nothing())
        }
        None => own_tables(algebra, name, &group, visibility, krate),
    };
    GroupType { ty: quote!(#group<T>), definition, tables, by_tables }
}

/// The type of a product of the runtime's closed forms and powers of them, by its name.
fn product(algebra: &LieAlgebra, krate: &TokenStream) -> Option<TokenStream> {
    let factors: Option<Vec<(TokenStream, usize)>> =
        algebra.name().split('*').map(|factor| power(factor.trim(), krate)).collect();
    let mut factors = factors?.into_iter().rev();
    let last = factors.next()?;
    let (ty, dim) = factors.fold(last, |(right, dim), (left, left_dim)| {
        let n = index(left_dim + dim);
        (quote!(#krate::groups::Product<#left, #right, #n>), left_dim + dim)
    });
    (dim == algebra.dim()).then_some(ty)
}

/// The type and the dimension of `SO3` or `SO3^4`.
fn power(factor: &str, krate: &TokenStream) -> Option<(TokenStream, usize)> {
    let (base, copies) = match factor.split_once('^') {
        Some((base, copies)) => (base, copies.parse().ok().filter(|&copies: &usize| copies > 0)?),
        None => (factor, 1),
    };
    let base = CLOSED_FORMS.iter().find(|known| **known == base)?;
    let dim = catalogue::lookup(base).ok()?.dim();
    let ty = format_ident!("{base}");
    if copies == 1 {
        return Some((quote!(#krate::groups::#ty<T>), dim));
    }
    let (n, count) = (index(copies * dim), index(copies));
    Some((quote!(#krate::groups::Power<#krate::groups::#ty<T>, #count, #n>), copies * dim))
}

/// The marker and the type of a group by its tables, and these.
fn own_tables(
    algebra: &LieAlgebra,
    name: &Ident,
    group: &Ident,
    visibility: &TokenStream,
    krate: &TokenStream,
) -> (TokenStream, TokenStream) {
    let n = algebra.dim();
    let basis = algebra.basis();
    let size = algebra.matrix_size();
    let number = |value: &Rational| value.to_f64().unwrap_or(f64::NAN);
    let structure = algebra.structure().iter().map(|c| (c.i, c.j, c.k, number(&c.value)));
    let structure = tokens(&list(&structure.collect::<Vec<_>>()));
    let basis = match basis {
        Some(matrices) => {
            let entries = matrices.iter().enumerate().flat_map(|(i, matrix)| {
                let entry =
                    move |(row, column, value): (_, _, &Rational)| (i, row, column, number(value));
                matrix.entries().map(entry).filter(|entry| entry.3 != 0.0)
            });
            let entries = tokens(&list(&entries.collect::<Vec<_>>()));
            quote!(::core::option::Option::Some(&[#entries]))
        }
        None => quote!(::core::option::Option::None),
    };
    let marker = format_ident!("{name}Algebra");
    let (n, d) = (index(n), index(size));
    let cayley = Chart::Cayley
        .check(algebra)
        .is_ok()
        .then(|| quote!(impl #krate::groups::CayleyAlgebra for #marker {}));
    // For large algebras these would be long tables, which only reports need.
    let watched = if algebra.dim() > 24 { Vec::new() } else { watched_casimirs(algebra) };
    let casimirs = watched.into_iter().map(|casimir| {
        let terms = casimir.terms().map(|(exponents, value)| {
            let powers = exponents.iter().enumerate().filter(|(_, power)| **power > 0);
            format!("({}, &{:?}), ", float(number(&value)), powers.collect::<Vec<_>>())
        });
        let terms = tokens(&terms.collect::<String>());
        quote!(&[#terms])
    });
    let about = format!(" The Lie algebra of {} as tables.", rust_comment(algebra.name()));
    let about_group = format!(" The group of {}.", rust_comment(algebra.name()));
    let definition = quote! {
        #[doc = #about_group]
        #visibility type #group<T = f64> = #krate::groups::StaticMatrixGroup<#marker, #n, #d, T>;

        #[doc = #about]
        #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug)]
        #visibility struct #marker;
    };
    let tables = quote! {
        impl #krate::groups::StaticAlgebra for #marker {
            const DIM: usize = #n;
            const MATRIX_SIZE: usize = #d;
            const STRUCTURE: &'static [#krate::groups::StructureConstant] = &[#structure];
            const BASIS: ::core::option::Option<&'static [#krate::groups::BasisEntry]> = #basis;
            const CASIMIRS: &'static [&'static [#krate::groups::CasimirTerm]] = &[#(#casimirs),*];
        }

        #cayley
    };
    (definition, tables)
}

fn index(value: usize) -> Literal {
    Literal::usize_unsuffixed(value)
}

/// The types that emitted items mention, and the items that define them.
pub(crate) struct Types {
    /// The dimension of the algebra.
    pub dim: usize,
    /// The group, over the scalar `T`.
    pub group: TokenStream,
    /// The numbers of its elements.
    pub elements: Elements,
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
            elements: if group.by_tables { Elements::Matrices } else { Elements::ByFactors },
            chart,
            vector: quote!(#vector<T>),
            matrix: quote!(#matrix<T>),
            definition: group.definition,
            tables: group.tables,
            aliases: quote! {
                // Whatever names the user has in scope.
                use ::core::prelude::v1::*;
                use #krate::plumbing::{self, Coefficients as _};

                type #vector<T> = #krate::nalgebra::SVector<T, #n>;
                type #matrix<T> = #krate::nalgebra::SMatrix<T, #n, #n>;
            },
        }
    }
}
