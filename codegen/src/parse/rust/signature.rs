//! The signature: which argument is the momentum, and the parameters.

use quote::ToTokens;
use syn::{FnArg, Pat, ReturnType, Type};

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
    /// Whether an argument of this shape can be it.
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

/// The contents of the signature.
pub(super) struct Signature {
    /// The shape of the first argument, the names of its entries, and where; `None` if it is not
    /// usable.
    pub variable: Option<(Shape, Vec<String>, Span)>,
    pub parameters: Vec<Parameter>,
}

/// Reads a signature and binds its arguments.
pub(super) fn read(
    signature: &syn::Signature,
    variable: Variable,
    evaluator: &mut Evaluator<'_>,
) -> Signature {
    qualifiers(signature, evaluator);
    let mut result = Signature { variable: None, parameters: Vec::new() };
    let mut scalars = 0;
    for (position, argument) in signature.inputs.iter().enumerate() {
        let typed = match argument {
            FnArg::Typed(typed) => typed,
            FnArg::Receiver(receiver) => {
                unsupported(
                    evaluator,
                    Span::of(receiver),
                    "a method cannot be read",
                    "write a free function of its variables and parameters",
                );
                continue;
            }
        };
        let span = Span::of(&typed.ty);
        let shape = shape(&typed.ty);
        if position == 0 {
            let Some(shape) = shape.filter(|shape| variable.accepts(shape)) else {
                let (what, help) = variable.expected();
                unsupported(evaluator, span, what, help);
                continue;
            };
            let place = Span::of(&typed.pat);
            let value = shaped(Some(&shape), |i| evaluator.push(Node::Coordinate(i), place));
            evaluator.bind(&typed.pat, value);
            let names = coordinate_names(&typed.pat, shape.len());
            result.variable = Some((shape, names, span));
            continue;
        }
        let Some(name) = name(&typed.pat) else {
            unsupported(
                evaluator,
                Span::of(&typed.pat),
                "a parameter needs a name",
                "take it apart in the body instead, with let",
            );
            continue;
        };
        if name == "step" {
            let taken = "the step size, the first argument of the integrator's `new`".to_owned();
            evaluator.report(Span::of(&typed.pat), Mistake::NameTaken(name.clone(), taken));
        }
        let Some(shape) = shape else {
            let message = format!("parameters of type `{}` are not read", tokens_text(&typed.ty));
            unsupported(
                evaluator,
                span,
                &message,
                "parameters are f64, [f64; n], [[f64; n]; m], or vectors and matrices of nalgebra \
                 of fixed size",
            );
            evaluator.bind(&typed.pat, Value::Wrong);
            continue;
        };
        let place = Span::of(&typed.pat);
        let value = shaped(Some(&shape), |i| evaluator.push(Node::Parameter(scalars + i), place));
        evaluator.bind(&typed.pat, value);
        scalars += shape.len();
        result.parameters.push(Parameter { name, shape, default: None });
    }
    if signature.inputs.is_empty() {
        let (what, help) = match variable {
            Variable::Momentum => ("the momentum", "write for example mu: [f64; 3]"),
            Variable::Element => ("the group element", "write for example g: [[f64; 3]; 3]"),
        };
        let what = format!("the function has no arguments: the first one must be {what}");
        unsupported(evaluator, Span::of(&signature.ident), &what, help);
    }
    result
}

fn unsupported(evaluator: &mut Evaluator<'_>, span: Span, what: &str, help: &str) {
    evaluator.report(span, Mistake::Unsupported(what.to_owned(), help.to_owned()));
}

fn qualifiers(signature: &syn::Signature, evaluator: &mut Evaluator<'_>) {
    if let Some(token) = &signature.asyncness {
        unsupported(evaluator, Span::of(token), "an energy cannot be async", "remove `async`");
    }
    if !signature.generics.params.is_empty() {
        let span = Span::of(&signature.generics);
        let help = "write the function for f64; what is generated is generic by itself";
        unsupported(evaluator, span, "an energy cannot be generic", help);
    }
    let returns_f64 = match &signature.output {
        ReturnType::Type(_, ty) => is_f64(ty),
        ReturnType::Default => false,
    };
    if !returns_f64 {
        let span = match &signature.output {
            ReturnType::Default => Span::of(&signature.ident),
            output => Span::of(output),
        };
        unsupported(evaluator, span, "the energy is returned as f64", "write -> f64");
    }
}

/// Fills a shape with numbers by their position.
fn shaped(shape: Option<&Shape>, mut number: impl FnMut(usize) -> Value) -> Value {
    match shape {
        None => Value::Wrong,
        Some(Shape::Scalar) => number(0),
        Some(Shape::Array(n)) => Value::List((0..*n).map(number).collect()),
        Some(Shape::Vector(n)) => Value::Vector((0..*n).map(number).collect()),
        Some(Shape::Grid(rows, columns)) => {
            let row = |i| Value::List((0..*columns).map(|j| number(i * columns + j)).collect());
            Value::List((0..*rows).map(row).collect())
        }
        Some(Shape::Matrix(rows, columns)) => Value::Matrix {
            rows: *rows,
            columns: *columns,
            entries: (0..rows * columns).map(number).collect(),
        },
    }
}

fn name(pattern: &Pat) -> Option<String> {
    match pattern {
        Pat::Ident(ident) if ident.subpat.is_none() => Some(ident.ident.to_string()),
        _ => None,
    }
}

fn coordinate_names(pattern: &Pat, count: usize) -> Vec<String> {
    if let Some(name) = name(pattern) {
        return (0..count).map(|i| format!("{name}[{i}]")).collect();
    }
    let names: Vec<String> = match pattern {
        Pat::Slice(slice) => slice.elems.iter().filter_map(self::name).collect(),
        _ => Vec::new(),
    };
    if names.len() == count { names } else { (0..count).map(|i| format!("mu[{i}]")).collect() }
}

fn tokens_text(ty: &Type) -> String {
    ty.to_token_stream().to_string()
}

fn is_f64(ty: &Type) -> bool {
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
        Type::Path(path) => {
            let last = path.path.segments.last()?;
            let mut sizes = Vec::new();
            let mut numbers = 0;
            if let syn::PathArguments::AngleBracketed(arguments) = &last.arguments {
                for argument in &arguments.args {
                    match argument {
                        syn::GenericArgument::Type(ty) if is_f64(ty) => numbers += 1,
                        syn::GenericArgument::Const(size) => sizes.push(length(size)?),
                        _ => return None,
                    }
                }
            }
            if numbers != 1 {
                return None;
            }
            sized(&last.ident.to_string(), &sizes)
        }
        _ => None,
    }
}

/// The shape of nalgebra's types of fixed size by name.
pub(super) fn sized(name: &str, sizes: &[usize]) -> Option<Shape> {
    match (name, sizes) {
        ("SVector", &[n]) => return Some(Shape::Vector(n)),
        ("SMatrix", &[n, 1]) => return Some(Shape::Vector(n)),
        ("SMatrix", &[rows, columns]) => return Some(Shape::Matrix(rows, columns)),
        _ => {}
    }
    let digits = |text: &str| -> Option<Vec<usize>> {
        text.split('x').map(|n| n.parse().ok().filter(|n| (1..=6).contains(n))).collect()
    };
    if let Some(n) = name.strip_prefix("Vector").and_then(digits) {
        return matches!(n[..], [_]).then(|| Shape::Vector(n[0]));
    }
    match name.strip_prefix("Matrix").and_then(digits)?[..] {
        [n] => Some(Shape::Matrix(n, n)),
        [rows, columns] => Some(Shape::Matrix(rows, columns)),
        _ => None,
    }
}

fn length(expression: &syn::Expr) -> Option<usize> {
    match expression {
        syn::Expr::Lit(literal) => match &literal.lit {
            syn::Lit::Int(n) => n.base10_parse().ok().filter(|&n: &usize| n > 0 && n <= 4096),
            _ => None,
        },
        syn::Expr::Paren(inner) => length(&inner.expr),
        syn::Expr::Group(inner) => length(&inner.expr),
        syn::Expr::Block(block) => match &block.block.stmts[..] {
            [syn::Stmt::Expr(inner, None)] => length(inner),
            _ => None,
        },
        _ => None,
    }
}
