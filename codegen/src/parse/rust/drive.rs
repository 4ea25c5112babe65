//! Velocities and torques beside a Hamiltonian, as functions in its body: `#[torque] fn drag(mu: [f64; 3], c: f64) -> [f64; 3]`.

use syn::{FnArg, Item, ItemFn, Stmt};

use super::evaluate::{Evaluator, source};
use super::signature::{bind, name, parameter, scalars};
use super::value::Value;
use crate::diagnostic::{Diagnostics, Span};
use crate::drive::Drive;
use crate::expr::Node;
use crate::lie::LieAlgebra;
use crate::pass::{Acting, Formula, assemble_drive, without_space};
use crate::problem::{Parameter, Shape};

/// The attributes of functions that make a drive.
const ATTRIBUTES: [&str; 4] = ["velocity", "torque", "velocity_in_space", "torque_in_space"];

/// The function that a statement defines with one of these attributes, and the number of that.
fn attributed(statement: &Stmt) -> Option<(usize, &ItemFn)> {
    let Stmt::Item(Item::Fn(function)) = statement else { return None };
    let number = |at: &syn::Attribute| ATTRIBUTES.iter().position(|name| at.path().is_ident(name));
    Some((function.attrs.iter().find_map(number)?, function))
}

/// Reports the functions with these attributes where there is no Hamiltonian.
pub(super) fn refuse(function: &ItemFn, diagnostics: &Diagnostics) {
    for (number, inner) in function.block.stmts.iter().filter_map(attributed) {
        let message = format!("#[{}] stands beside a Hamiltonian only", ATTRIBUTES[number]);
        let help = "write it in the body of a function with #[lie_poisson(…)]";
        diagnostics.report_other(Span::of(&inner.sig.ident), message, help);
    }
}

/// The function as the compiler is to see it, which knows nothing of these attributes in its body.
#[must_use]
pub fn without_attributes(mut function: ItemFn) -> ItemFn {
    for statement in &mut function.block.stmts {
        if attributed(statement).is_some()
            && let Stmt::Item(Item::Fn(inner)) = statement
        {
            inner.attrs.retain(|at| !ATTRIBUTES.iter().any(|name| at.path().is_ident(name)));
            inner.attrs.push(syn::parse_quote!(#[allow(dead_code)]));
        }
    }
    function
}

/// The functions with these attributes, each with a body that is at fault nowhere: it returns the momentum.
#[must_use]
pub fn faultless(function: &ItemFn) -> Vec<ItemFn> {
    let Some(FnArg::Typed(first)) = function.sig.inputs.first() else { return Vec::new() };
    let own = function.block.stmts.iter().filter_map(attributed);
    let faultless = own.map(|(_, inner)| {
        let (mut inner, ty) = (inner.clone(), &first.ty);
        inner.block = syn::parse_quote!({ mu });
        let is_mu = |argument: &FnArg| matches!(argument, FnArg::Typed(own) if name(&own.pat).as_deref() == Some("mu"));
        if !inner.sig.inputs.iter().any(is_mu) {
            inner.sig.inputs.push(syn::parse_quote!(mu: #ty));
        }
        inner
    });
    faultless.collect()
}

/// The drive that functions in a body make; `None` where there are none, or one is wrong, which is reported. Parameters that the
/// Hamiltonian has not come after its own.
pub(super) fn read(
    function: &ItemFn,
    algebra: Option<&LieAlgebra>,
    coordinates: &[String],
    parameters: &mut Vec<Parameter>,
    diagnostics: &Diagnostics,
) -> Option<Drive> {
    let (dim, mut roots) = (coordinates.len(), [const { None }; 5]);
    let (mut sources, mut evaluator) = (Vec::new(), Evaluator::new(diagnostics));
    let algebra = algebra.filter(|algebra| algebra.dim() == dim);
    let statements = &function.block.stmts;
    for (number, inner) in statements.iter().filter_map(attributed) {
        let of = ATTRIBUTES[number];
        if roots[number].is_some() {
            let message = format!("there is another #[{of}] before this one");
            evaluator.unsupported(Span::of(&inner.sig.ident), &message, "add them in one function");
            continue;
        }
        if let Some(in_body) = of.strip_suffix("_in_space")
            && let Some(reason) = algebra.and_then(without_space)
        {
            let help = format!("give it in the body, with #[{in_body}]");
            evaluator.unsupported(Span::of(&inner.sig.ident), &format!("#[{of}]: {reason}"), &help);
            continue;
        }
        evaluator.begin(statements.iter().filter(|statement| attributed(statement).is_none()));
        arguments(&inner.sig, [algebra?.matrix_size(), dim], parameters, &mut evaluator);
        let numbers = |value: &Value| {
            let numbers = value.numbers().filter(|list| list.len() == dim);
            numbers.ok_or_else(|| {
                format!("a {of} has a number for each of the {dim} coordinates of the momentum")
            })
        };
        let help = "end the function with an array or a vector of them";
        let list = evaluator.result(&inner.block, numbers, help);
        roots[number] = Some(list.map(|(list, _)| list).unwrap_or_default());
        sources.push(format!("{of} = {}", source(&inner.block)));
    }
    if sources.is_empty() || roots.iter().flatten().any(Vec::is_empty) {
        return None;
    }
    let (arena, parameters) = (evaluator.into_arena(), parameters.clone());
    let energy = Formula { arena, root: None, parameters, source: sources.join(", ") };
    let acting = Some(Acting { energy, roots });
    let functions = [const { None }; 2];
    assemble_drive(algebra?, (coordinates, &[]), acting, functions, None, diagnostics)
}

/// Binds the arguments of a function: a parameter of the Hamiltonian by its name; the time `t`, the matrix `g` of the group element,
/// the momentum `mu` and the velocity `omega` = ∂H/∂μ; and parameters of its own.
fn arguments(
    signature: &syn::Signature,
    [size, dim]: [usize; 2],
    parameters: &mut Vec<Parameter>,
    evaluator: &mut Evaluator<'_>,
) {
    for argument in &signature.inputs {
        let FnArg::Typed(typed) = argument else { continue };
        let name = name(&typed.pat).unwrap_or_default();
        let known = parameters.iter().position(|parameter| parameter.name == name);
        let (first, node, lengths): (usize, fn(usize) -> Node, _) = match (known, &name[..]) {
            (Some(at), _) => {
                (scalars(&parameters[..at]), Node::Parameter, parameters[at].shape.lengths())
            }
            (None, "t") => (0, |_| Node::Time, vec![]),
            (None, "g") => (0, Node::Coordinate, vec![size, size]),
            (None, "mu") => (size * size, Node::Coordinate, vec![dim]),
            (None, "omega") => (size * size + dim, Node::Coordinate, vec![dim]),
            (None, _) => {
                parameter(typed, parameters, evaluator);
                continue;
            }
        };
        let described = match lengths[..] {
            [] => "a number".to_owned(),
            [n] => format!("a list of {n} numbers"),
            _ => format!("a matrix of {lengths:?} numbers"),
        };
        let message = format!("`{name}` is {described} here");
        let help = "t, g, mu and omega are the time, the matrix of the group element, the momentum and the velocity; \
                    parameters of the Hamiltonian are what they are there";
        let accepts = |shape: &Shape| shape.lengths() == lengths;
        bind(typed, accepts, |i| node(first + i), [&message, help], evaluator);
    }
}
