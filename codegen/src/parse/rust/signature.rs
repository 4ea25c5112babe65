//! The signature: which argument is the momentum, and the parameters.

use quote::ToTokens;
use syn::{Expr, FnArg, ItemFn, Pat, PatType, PathSegment, ReturnType, Type};

use super::evaluate::{Evaluator, source};
use super::value::Value;
use crate::diagnostic::{Diagnostics, Mistake, Span};
use crate::expr::Node;
use crate::pass::Formula;
use crate::problem::{Parameter, Shape};

/// The first argument of a function, besides the parameters, and the attribute that makes it so.
pub(super) struct Variable {
    pub attribute: &'static str,
    /// The keys of the attribute; `crate` is taken out before.
    pub keys: &'static [&'static str],
    name: &'static str,
    /// True if an argument of this shape can be this variable.
    accepts: fn(&Shape) -> bool,
    shape: &'static str,
    /// An example, and another one.
    examples: [&'static str; 2],
}

/// The momentum, an array or a vector.
pub(super) const MOMENTUM: Variable = Variable {
    attribute: "#[lie_poisson(…)]",
    keys: &["group", "truncation", "chart", "solver", "frame", "time", "method", "crate"],
    name: "the momentum",
    accepts: |shape| matches!(shape, Shape::Array(_) | Shape::Vector(_)),
    shape: "an array or a vector of f64 with a literal length",
    examples: ["mu: [f64; 3]", "mu: nalgebra::Vector3<f64>"],
};

/// The matrix of a group element.
pub(super) const ELEMENT: Variable = Variable {
    attribute: "#[potential(…)]",
    keys: &["group", "crate"],
    name: "the group element",
    accepts: |shape| matches!(shape, Shape::Grid(..) | Shape::Matrix(..)),
    shape: "a matrix of f64 of literal size",
    examples: ["g: [[f64; 3]; 3]", "g: nalgebra::Matrix3<f64>"],
};

/// The shape of the variable, the names of its entries, and its place.
type Variables = (Shape, Vec<String>, Span);

/// Reads a function: its variable, `None` if that is not usable, and the energy that it computes. `time` is the name of the
/// argument that is the time, and where it is said.
pub(super) fn read(
    function: &ItemFn,
    variable: &Variable,
    time: Option<(String, Span)>,
    diagnostics: &Diagnostics,
) -> (Option<Variables>, Formula) {
    let mut evaluator = Evaluator::new(diagnostics);
    let (first, parameters) = arguments(&function.sig, variable, time, &mut evaluator);
    let number = |value: &Value| match value {
        Value::Number(id) => Ok(*id),
        other => Err(format!("the function must end with a number, not {}", other.kind())),
    };
    let help = "end it with the energy, without a semicolon";
    // Without its variable every name of the body would be unknown.
    let root = first.as_ref().and_then(|_| evaluator.result(&function.block, number, help));
    let (arena, source) = (evaluator.into_arena(), source(&function.block));
    (first, Formula { arena, root, parameters, source })
}

/// Binds the arguments of a signature.
fn arguments(
    signature: &syn::Signature,
    variable: &Variable,
    mut time: Option<(String, Span)>,
    evaluator: &mut Evaluator<'_>,
) -> (Option<Variables>, Vec<Parameter>) {
    let Variable { name: variable_name, shape: expected, examples: [example, other], .. } =
        variable;
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
        let name = name(&typed.pat);
        if position == 0 {
            let what = format!("the first argument is {variable_name}: {expected}");
            let help = format!("write for example {example} or {other}");
            let bound = bind(typed, variable.accepts, Node::Coordinate, [&what, &help], evaluator);
            first = bound.map(|shape| {
                let names = coordinate_names(&typed.pat, shape.len());
                (shape, names, Span::of(&typed.ty))
            });
        } else if time.take_if(|(time, _)| name.as_ref() == Some(time)).is_some() {
            let number = |shape: &Shape| *shape == Shape::Scalar;
            let said = ["the time is a number", "write for example t: f64"];
            bind(typed, number, |_| Node::Time, said, evaluator);
        } else {
            parameter(typed, &mut parameters, evaluator);
        }
    }
    if let Some((name, place)) = time {
        let what = format!("the function has no argument `{name}` after the first to be the time");
        evaluator.unsupported(place, &what, "write for example time = t, with an argument t: f64");
    }
    if signature.inputs.is_empty() {
        let what = format!("the function has no arguments: the first one must be {variable_name}");
        let help = format!("write for example {example}");
        evaluator.unsupported(Span::of(&signature.ident), &what, &help);
    }
    (first, parameters)
}

/// Binds an argument to nodes by the number of the entry; reports a type of which the shape is not accepted, with help.
pub(super) fn bind(
    typed: &PatType,
    accepts: impl Fn(&Shape) -> bool,
    node: impl Fn(usize) -> Node,
    [what, help]: [&str; 2],
    evaluator: &mut Evaluator<'_>,
) -> Option<Shape> {
    let (found, place) = (shape(&typed.ty).filter(accepts), Span::of(&typed.pat));
    let value = match &found {
        Some(shape) => shaped(shape, |i| evaluator.push(node(i), place)),
        None => evaluator.unsupported(Span::of(&typed.ty), what, help),
    };
    evaluator.bind(&typed.pat, value);
    found
}

/// Reads a parameter and binds it.
pub(super) fn parameter(
    typed: &PatType,
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
    let message = format!("parameters of type `{}` are not read", typed.ty.to_token_stream());
    let help = "parameters are f64, [f64; n], [[f64; n]; m], or vectors and matrices of nalgebra of fixed size";
    let first = scalars(parameters);
    let node = |i| Node::Parameter(first + i);
    let shape = bind(typed, |_| true, node, [&message, help], evaluator);
    parameters.extend(shape.map(|shape| Parameter { name, shape, default: None }));
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
    let mut list = |range: std::ops::Range<usize>| range.map(&mut number).collect::<Vec<_>>();
    match *shape {
        Shape::Scalar => number(0),
        Shape::Array(n) => Value::list(list(0..n)),
        Shape::Grid(rows, columns) => {
            let row = |i| Value::list(list(i * columns..(i + 1) * columns));
            Value::list((0..rows).map(row))
        }
        Shape::Vector(n) => Value::matrix(n, 1, list(0..n)),
        Shape::Matrix(rows, columns) => Value::matrix(rows, columns, list(0..rows * columns)),
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
fn shape(ty: &Type) -> Option<Shape> {
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
        Type::Path(_) if is_f64(ty) => Some(Shape::Scalar),
        Type::Path(path) => of_segment(path.path.segments.last()?),
        _ => None,
    }
}

/// The shape of a type of nalgebra of fixed size: `Vector3<f64>`, `SMatrix<f64, 2, 3>`, also without arguments where these are
/// no sizes.
pub(super) fn of_segment(segment: &PathSegment) -> Option<Shape> {
    let text = segment.to_token_stream().to_string().replace([' ', ':', '>'], "");
    let (name, arguments) = text.split_once('<').unwrap_or((&text, "f64"));
    let sizes = match name {
        "SVector" | "SMatrix" => arguments.strip_prefix("f64,")?,
        _ if arguments != "f64" => return None,
        _ => name.strip_prefix("Vector").or_else(|| name.strip_prefix("Matrix"))?,
    };
    let sizes: Option<Vec<usize>> = sizes.split([',', 'x']).map(of_digits).collect();
    match (name.contains("Vector"), &sizes?[..]) {
        (true, &[n]) | (false, &[n, 1]) => Some(Shape::Vector(n)),
        (false, &[n]) => Some(Shape::Matrix(n, n)),
        (false, &[rows, columns]) => Some(Shape::Matrix(rows, columns)),
        _ => None,
    }
}

/// A length that is written as a number.
pub(super) fn length(expression: &Expr) -> Option<usize> {
    match bare(expression) {
        Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(n), .. }) => of_digits(n.base10_digits()),
        _ => None,
    }
}

fn of_digits(digits: &str) -> Option<usize> {
    digits.parse().ok().filter(|n| (1..=4096).contains(n))
}
