//! Opaque coefficients as Rust expressions in the user's parameters.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::program::exact;
use crate::expr::{Function, ParameterExpr};

/// The value of `expr` as an expression of type `T`; `parameters[i]` is the expression of scalar
/// parameter number i.
pub(crate) fn expression(expr: &ParameterExpr, parameters: &[TokenStream]) -> TokenStream {
    let sub = |e: &ParameterExpr| expression(e, parameters);
    match expr {
        ParameterExpr::Rational(value) => {
            let value = exact(value);
            quote!(T::of(#value))
        }
        ParameterExpr::Parameter(index) => parameters[*index].clone(),
        ParameterExpr::Add(a, b) => binary(quote!(+), sub(a), sub(b)),
        ParameterExpr::Sub(a, b) => binary(quote!(-), sub(a), sub(b)),
        ParameterExpr::Mul(a, b) => binary(quote!(*), sub(a), sub(b)),
        ParameterExpr::Div(a, b) => binary(quote!(/), sub(a), sub(b)),
        ParameterExpr::Neg(a) => {
            let a = sub(a);
            quote!((-#a))
        }
        ParameterExpr::Powi(a, exponent) => {
            let a = sub(a);
            let exponent = Literal::i32_unsuffixed(*exponent);
            quote!(#a.simd_powi(#exponent))
        }
        ParameterExpr::Call(function, a) => {
            let a = sub(a);
            match function {
                Function::Sqrt => quote!(#a.simd_sqrt()),
                Function::Sin => quote!(#a.simd_sin()),
                Function::Cos => quote!(#a.simd_cos()),
                Function::Tan => quote!(#a.simd_tan()),
                Function::Atan => quote!(#a.simd_atan()),
                Function::Tanh => quote!(#a.simd_tanh()),
                Function::Exp => quote!(#a.simd_exp()),
                Function::Ln => quote!(#a.simd_ln()),
                Function::Abs => quote!(#a.simd_abs()),
            }
        }
    }
}

fn binary(operator: TokenStream, a: TokenStream, b: TokenStream) -> TokenStream {
    quote!((#a #operator #b))
}
