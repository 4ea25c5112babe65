//! The signature: which argument is the momentum, and the parameters.

use quote::ToTokens;
use syn::{Expr, FnArg, GenericArgument, Pat, PathArguments, PathSegment, ReturnType, Type};

use super::evaluate::Evaluator;
use super::value::Value;
use crate::diagnostic::{Mistake, Span};
use crate::expr::Node;
use crate::problem::{Parameter, Shape};

/// The first argument of a function, besides the parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variable {
    /// The momentum, an array or a vector.
    Momentum,
    /// The matrix of a group element.
    Element,
}

impl Variable {
    /// True if an argument of this shape can be this variable.
    fn accepts(self, shape: &Shape) -> bool {
        match self {
            Self::Momentum => matches!(shape, Shape::Array(_) | Shape::Vector(_)),
            Self::Element => matches!(shape, Shape::Grid(..) | Shape::Matrix(..)),
        }
    }

    fn expected(self) -> (&'static str, &'static str) {
        match self {
            Self::Momentum => (
                "the first argument is the momentum: an array or a vector of f64 with a literal \
                 length",
                "write for example mu: [f64; 3] or mu: nalgebra::Vector3<f64>",
            ),
            Self::Element => (
                "the first argument is the group element: a matrix of f64 of literal size",
                "write for example g: [[f64; 3]; 3] or g: nalgebra::Matrix3<f64>",
            ),
        }
    }
}

/// The shape of the variable, the names of its entries, and its place.
type Variables = (Shape, Vec<String>, Span);

/// Reads a signature and binds its arguments: the shape of the first one, the names of its entries, and where, `None` if it
/// is not usable; and the parameters. `time` is the name of the argument that is the time, and where it is said.
pub(super) fn read(
    signature: &syn::Signature,
    variable: Variable,
    mut time: Option<(String, Span)>,
    evaluator: &mut Evaluator<'_>,
) -> (Option<Variables>, Vec<Parameter>) {
    if let Some(token) = &signature.asyncness {
        evaluator.unsupported(Span::of(token), "an energy cannot be async", "remove `async`");
    }
    if !signature.generics.params.is_empty() {
        let help = "write the function for f64; what is generated is generic by itself";
        let span = Span::of(&signature.generics);
        evaluator.unsupported(span, "an energy cannot be generic", help);
    }
    let output = match &signature.output {
        ReturnType::Type(_, ty) if is_f64(ty) => None,
        ReturnType::Default => Some(Span::of(&signature.ident)),
        output => Some(Span::of(output)),
    };
    if let Some(span) = output {
        evaluator.unsupported(span, "the energy is returned as f64", "write -> f64");
    }
    let (mut first, mut parameters) = (None, Vec::new());
    for (position, argument) in signature.inputs.iter().enumerate() {
        let FnArg::Typed(typed) = argument else {
            let help = "write a free function of its variables and parameters";
            evaluator.unsupported(Span::of(argument), "a method cannot be read", help);
            continue;
        };
        let (span, place) = (Span::of(&typed.ty), Span::of(&typed.pat));
        let shape = shape(&typed.ty);
        if position == 0 {
            let Some(shape) = shape.filter(|shape| variable.accepts(shape)) else {
                let (what, help) = variable.expected();
                evaluator.unsupported(span, what, help);
                continue;
            };
            let value = shaped(&shape, |i| evaluator.push(Node::Coordinate(i), place));
            evaluator.bind(&typed.pat, value);
            let names = coordinate_names(&typed.pat, shape.len());
            first = Some((shape, names, span));
            continue;
        }
        if let Some(name) = name(&typed.pat)
            && time.take_if(|(time, _)| *time == name).is_some()
        {
            let value = match shape {
                Some(Shape::Scalar) => evaluator.push(Node::Time, place),
                _ => {
                    evaluator.unsupported(span, "the time is a number", "write for example t: f64")
                }
            };
            evaluator.bind(&typed.pat, value);
            continue;
        }
        parameter(typed, &mut parameters, evaluator);
    }
    if let Some((name, place)) = time {
        let what = format!("the function has no argument `{name}` after the first to be the time");
        evaluator.unsupported(place, &what, "write for example time = t, with an argument t: f64");
    }
    if signature.inputs.is_empty() {
        let (what, help) = match variable {
            Variable::Momentum => ("the momentum", "write for example mu: [f64; 3]"),
            Variable::Element => ("the group element", "write for example g: [[f64; 3]; 3]"),
        };
        let what = format!("the function has no arguments: the first one must be {what}");
        evaluator.unsupported(Span::of(&signature.ident), &what, help);
    }
    (first, parameters)
}

/// Reads a parameter and binds it.
pub(super) fn parameter(
    typed: &syn::PatType,
    parameters: &mut Vec<Parameter>,
    evaluator: &mut Evaluator<'_>,
) {
    let place = Span::of(&typed.pat);
    let Some(name) = name(&typed.pat) else {
        let help = "take it apart in the body instead, with let";
        evaluator.unsupported(place, "a parameter needs a name", help);
        return;
    };
    if name == "step" {
        let taken = "the step size, the first argument of the integrator's `new`".to_owned();
        evaluator.wrong(place, Mistake::NameTaken(name.clone(), taken));
    }
    let Some(shape) = shape(&typed.ty) else {
        let message = format!("parameters of type `{}` are not read", typed.ty.to_token_stream());
        let help = "parameters are f64, [f64; n], [[f64; n]; m], or vectors and matrices of nalgebra of fixed size";
        let value = evaluator.unsupported(Span::of(&typed.ty), &message, help);
        return evaluator.bind(&typed.pat, value);
    };
    let first = scalars(parameters);
    let value = shaped(&shape, |i| evaluator.push(Node::Parameter(first + i), place));
    evaluator.bind(&typed.pat, value);
    parameters.push(Parameter { name, shape, default: None });
}

/// The number of scalars that parameters are.
pub(super) fn scalars(parameters: &[Parameter]) -> usize {
    parameters.iter().map(|parameter| parameter.shape.len()).sum()
}

/// An expression without the parentheses and references around it.
pub(super) fn bare(mut expression: &Expr) -> &Expr {
    loop {
        expression = match expression {
            Expr::Paren(inner) => &inner.expr,
            Expr::Group(inner) => &inner.expr,
            Expr::Reference(inner) => &inner.expr,
            Expr::Unary(syn::ExprUnary { op: syn::UnOp::Deref(_), expr, .. }) => expr,
            _ => return expression,
        };
    }
}

/// Fills a shape with numbers by their position.
pub(super) fn shaped(shape: &Shape, mut number: impl FnMut(usize) -> Value) -> Value {
    match *shape {
        Shape::Scalar => number(0),
        Shape::Array(n) => Value::list((0..n).map(number)),
        Shape::Grid(rows, columns) => {
            let row = |i| Value::list((0..columns).map(|j| number(i * columns + j)));
            Value::list((0..rows).map(row))
        }
        Shape::Vector(n) => Value::matrix(n, 1, (0..n).map(number).collect()),
        Shape::Matrix(rows, columns) => {
            Value::matrix(rows, columns, (0..rows * columns).map(number).collect())
        }
    }
}

pub(super) fn name(pattern: &Pat) -> Option<String> {
    match pattern {
        Pat::Ident(ident) if ident.subpat.is_none() => Some(ident.ident.to_string()),
        _ => None,
    }
}

fn coordinate_names(pattern: &Pat, count: usize) -> Vec<String> {
    if let Pat::Slice(slice) = pattern
        && let Some(names) = slice.elems.iter().map(name).collect::<Option<Vec<String>>>()
        && names.len() == count
    {
        return names;
    }
    let name = name(pattern).unwrap_or_else(|| "mu".to_owned());
    (0..count).map(|i| format!("{name}[{i}]")).collect()
}

pub(super) fn is_f64(ty: &Type) -> bool {
    matches!(ty, Type::Path(path) if path.path.is_ident("f64"))
}

/// The shape of a type, where it is one.
pub(super) fn shape(ty: &Type) -> Option<Shape> {
    match ty {
        Type::Paren(inner) => shape(&inner.elem),
        Type::Group(inner) => shape(&inner.elem),
        Type::Reference(inner) => shape(&inner.elem),
        Type::Array(array) => {
            let n = length(&array.len)?;
            match shape(&array.elem)? {
                Shape::Scalar => Some(Shape::Array(n)),
                Shape::Array(columns) => Some(Shape::Grid(n, columns)),
                _ => None,
            }
        }
        Type::Path(path) if is_f64(ty) && path.qself.is_none() => Some(Shape::Scalar),
        Type::Path(path) => of_segment(path.path.segments.last()?),
        _ => None,
    }
}

/// The shape of a type of nalgebra of fixed size: `Vector3<f64>`, `SMatrix<f64, 2, 3>`, also without arguments where these are
/// no sizes.
pub(super) fn of_segment(segment: &PathSegment) -> Option<Shape> {
    let mut sizes = Vec::new();
    if let PathArguments::AngleBracketed(arguments) = &segment.arguments {
        for argument in &arguments.args {
            match argument {
                GenericArgument::Type(entry) if is_f64(entry) => {}
                GenericArgument::Const(size) => sizes.push(length(size)?),
                _ => return None,
            }
        }
    }
    let name = segment.ident.to_string();
    let digits = |prefix: &str| -> Option<Vec<usize>> {
        let digits = name.strip_prefix(prefix)?.split('x');
        digits.map(|n| n.parse().ok().filter(|n| (1..=6).contains(n))).collect()
    };
    if !matches!(name.as_str(), "SVector" | "SMatrix") {
        sizes = digits("Vector").or_else(|| digits("Matrix"))?;
    }
    match (name.contains("Vector"), &sizes[..]) {
        (true, &[n]) | (false, &[n, 1]) => Some(Shape::Vector(n)),
        (false, &[n]) => Some(Shape::Matrix(n, n)),
        (false, &[rows, columns]) => Some(Shape::Matrix(rows, columns)),
        _ => None,
    }
}

/// A length that is written as a number.
pub(super) fn length(expression: &Expr) -> Option<usize> {
    match bare(expression) {
        Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(n), .. }) => {
            n.base10_parse().ok().filter(|n| (1..=4096).contains(n))
        }
        _ => None,
    }
}
