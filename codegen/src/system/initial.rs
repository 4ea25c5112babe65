//! The table `[initial]`: the state at the start.

use toml::de::DeValue;

use super::project::project;
use super::run::{Run, accepted};
use super::table::{Table, Value, span};
use crate::diagnostic::{Mistake, Span};
use crate::lie::{LieAlgebra, RationalMatrix};
use crate::number::{Rational, integer, nearest_float};
use crate::poly::split_at;
use crate::problem::Problem;
use crate::smooth::Smooth;

const TIME: &str = "time = 5.0";
const MOMENTUM: &str = "momentum = [2.0, 0.5, 1.0]";
const VELOCITY: &str = "angular_velocity = [0.1, 0, 2]";
const ELEMENT: &str = "group_element = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
const QUATERNION: &str = "quaternion = [1, 0, 0, 0]";
const TRANSLATION: &str = "translation = [0, 0, 0]";
/// The largest difference of a quaternion's length from 1 without `project`.
const UNIT: f64 = 1e-9;

/// Reads `[initial]` into `run`; returns a velocity and its place, from which [`momentum`] finds the momentum.
pub(super) fn read(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    run: &mut Run,
) -> Option<(Vec<Rational>, Span)> {
    let table = root.table("initial")?;
    table.check_keys(&[
        "time",
        "momentum",
        "angular_velocity",
        "group_element",
        "quaternion",
        "translation",
        "project",
    ]);
    let time = accepted(&table, table.number("time", TIME), TIME, |time| {
        (!time.is_finite()).then_some("the time must be finite")
    });
    run.initial_time = time.unwrap_or(0.0);
    run.group_element = element(&table, algebra);
    let momentum = coordinates(&table, "momentum", MOMENTUM, algebra);
    run.momentum = momentum.map(|(list, _)| list.iter().map(nearest_float).collect());
    let velocity = coordinates(&table, "angular_velocity", VELOCITY, algebra)?;
    if table.has("momentum") {
        let what = "`momentum` and `angular_velocity` are both given: keep one";
        table.refuse(velocity.1, what, MOMENTUM);
    }
    if !algebra.is_none_or(|algebra| matches!(factor(algebra).0, "SO3" | "SU2")) {
        let what = "an angular velocity is one of SO3, SU2 or a power of them: give the momentum";
        table.refuse(velocity.1, what, MOMENTUM);
    }
    Some(velocity)
}

/// The group of which `algebra` is a power, and how many factors it has.
fn factor(algebra: &LieAlgebra) -> (&str, usize) {
    let power = algebra.name().rsplit_once('^');
    let power = power.and_then(|(factor, copies)| Some((factor, copies.parse().ok()?)));
    power.unwrap_or((algebra.name(), 1))
}

/// The number of copies in a power of a group if `each` coordinates are those of one copy.
pub(super) fn copies(algebra: &LieAlgebra, each: usize) -> Option<usize> {
    let (_, copies) = factor(algebra);
    (copies > 1 && each * copies == algebra.dim()).then_some(copies)
}

/// A list of numbers, as many as the momentum has coordinates. In a power of a group it may be given for one copy:
/// numbers, or expressions in the copy's number i, counted from 0.
pub(super) fn coordinates(
    table: &Table<'_>,
    key: &str,
    example: &str,
    algebra: Option<&LieAlgebra>,
) -> Option<(Vec<Rational>, Span)> {
    let (list, place) = table.array(key, example)?;
    // Without a group, what may stand in an entry is not known.
    algebra?;
    if let Some(copies) = algebra.and_then(|algebra| copies(algebra, list.len())) {
        let column = |value: &Value<'_>| match value.get_ref() {
            DeValue::String(text) => {
                let copy = |i: usize| table.expression(text, span(value), &[("i", i as i64)]);
                (0..copies).map(copy).collect()
            }
            _ => Some(vec![table.exact(key, value, example)?; copies]),
        };
        let columns: Option<Vec<Vec<_>>> = list.into_iter().map(column).collect();
        let columns = columns?;
        let all = (0..copies).flat_map(|i| columns.iter().map(move |column| column[i].clone()));
        return Some((all.collect(), place));
    }
    let count = list.len();
    let numbers = table.numbers(key, list, example);
    if let Some(algebra) = algebra
        && count != algebra.dim()
    {
        let (name, dim) = (algebra.name().to_owned(), algebra.dim());
        table.diagnostics.report(place, Mistake::Dimension(count, name, dim));
    }
    Some((numbers?, place))
}

/// A and b of ∂H/∂μ = A μ + b at the start, at the defaults of parameters that are kept.
pub(super) type Linear = (RationalMatrix, Vec<Rational>);

/// The momentum with ∂H/∂μ = `velocity`; reports a Hamiltonian that is no quadratic function of which the velocity determines the
/// momentum.
pub(super) fn momentum(
    gradient: Option<Linear>,
    (velocity, place): &(Vec<Rational>, Span),
    root: &Table<'_>,
) -> Option<Vec<f64>> {
    let solved = |(matrix, bias): Linear| {
        let right = velocity.iter().zip(bias).enumerate().map(|(i, (w, b))| (i, 0, w - b));
        let right = RationalMatrix::from_entries(velocity.len(), 1, right);
        let momentum = matrix.inverse()?.times(&right);
        Some((0..velocity.len()).map(|i| nearest_float(&momentum.get(i, 0))).collect())
    };
    let momentum = gradient.and_then(solved);
    if momentum.is_none() {
        let what = "this does not determine the momentum: the Hamiltonian is not a quadratic function with an inverse, or has \
                    inputs that stand in a file";
        root.refuse(*place, what, MOMENTUM);
    }
    momentum
}

/// The linear gradient of a smooth Hamiltonian at this time, if it is quadratic and has no inputs in files.
pub(super) fn of_smooth(smooth: &Smooth, time: f64) -> Option<Linear> {
    if !smooth.is_quadratic() {
        return None;
    }
    let dim = smooth.algebra.dim();
    let symbols = smooth.symbols_at(&smooth.facts().defaults());
    let at = |mu: &[f64]| -> Option<Vec<Rational>> {
        smooth.gradient(&symbols, time, mu).into_iter().map(Rational::from_float).collect()
    };
    let mut mu = vec![0.0; dim];
    let bias = at(&mu)?;
    let mut entries = Vec::new();
    for j in 0..dim {
        mu[j] = 1.0;
        let column = at(&mu)?.into_iter().zip(&bias).enumerate();
        entries.extend(column.map(|(i, (value, bias))| (i, j, value - bias)));
        mu[j] = 0.0;
    }
    Some((RationalMatrix::from_entries(dim, dim, entries), bias))
}

/// The linear gradient of a polynomial, if it is quadratic.
pub(super) fn of_polynomial(problem: &Problem) -> Option<Linear> {
    let dim = problem.algebra.dim();
    let defaults =
        problem.parameters.iter().flat_map(|parameter| parameter.default.iter().flatten());
    let defaults: Vec<f64> = defaults.map(nearest_float).collect();
    let symbols: Option<Vec<Rational>> = problem
        .symbols
        .iter()
        .map(|symbol| Rational::from_float(symbol.expr.evaluate(&defaults)))
        .collect();
    let symbols = symbols?;
    // H = μᵀAμ/2 + bᵀμ.
    let mut bias = vec![integer(0); dim];
    let mut quadratic = Vec::new();
    for (factors, mut value) in problem.hamiltonian.factors() {
        let (momenta, own) = split_at(&factors, dim);
        for &(variable, power) in own {
            for _ in 0..power {
                value *= symbols.get(variable as usize - dim)?;
            }
        }
        match *momenta {
            [] => {}
            [(i, 1)] => bias[i as usize] += value,
            [(i, 2)] => quadratic.push((i as usize, i as usize, value * integer(2))),
            [(i, 1), (j, 1)] => {
                quadratic.push((i as usize, j as usize, value.clone()));
                quadratic.push((j as usize, i as usize, value));
            }
            _ => return None,
        }
    }
    Some((RationalMatrix::from_entries(dim, dim, quadratic), bias))
}

fn element(table: &Table<'_>, algebra: Option<&LieAlgebra>) -> Option<Vec<Vec<f64>>> {
    let projected = match table.get("project").map(|value| (value.get_ref(), value)) {
        Some((&DeValue::Boolean(yes), _)) => yes,
        Some((_, value)) => {
            table.wrong_kind("project", "true or false", value, "project = true");
            false
        }
        None => false,
    };
    if table.has("translation") && !table.has("quaternion") {
        let what = "`translation` stands beside `quaternion`";
        table.refuse(table.span, what, QUATERNION);
    }
    if let (Some(value), Some(algebra)) = (table.get("quaternion"), algebra) {
        if table.has("group_element") {
            let what = "`quaternion` and `group_element` are both given: keep one";
            table.refuse(span(value), what, QUATERNION);
        }
        return by_quaternions(table, value, algebra, projected);
    }
    let value = table.get("group_element")?;
    let rows = table.matrix("group_element", value, ELEMENT)?;
    let size = algebra.map(LieAlgebra::matrix_size);
    let square = rows.iter().all(|row| row.len() == rows.len());
    if !square || size.is_some_and(|size| size != rows.len()) {
        let expected = size.map_or("a square matrix".to_owned(), |n| format!("{n} × {n}"));
        let what = format!("the group element must be {expected}");
        table.refuse(span(value), &what, ELEMENT);
        return None;
    }
    let mut rows: Vec<Vec<f64>> =
        rows.iter().map(|row| row.iter().map(nearest_float).collect()).collect();
    if let (true, Some(algebra)) = (projected, algebra)
        && let Err(what) = project(&mut rows, algebra)
    {
        table.refuse(span(value), &what, ELEMENT);
    }
    Some(rows)
}

/// The matrix, block by block, of rotations given by unit quaternions w, x, y, z, and of translations beside them.
fn by_quaternions(
    table: &Table<'_>,
    value: &Value<'_>,
    algebra: &LieAlgebra,
    projected: bool,
) -> Option<Vec<Vec<f64>>> {
    let (name, copies) = factor(algebra);
    let block: fn([f64; 4], [f64; 3]) -> Vec<Vec<f64>> = match name {
        "SO3" => |q, _| rotation(q),
        "SE3" => |q, [x, y, z]| {
            let mut rows = rotation(q);
            rows.iter_mut().zip([x, y, z]).for_each(|(row, t)| row.push(t));
            rows.push(vec![0.0, 0.0, 0.0, 1.0]);
            rows
        },
        // U = w − i(xσ₁ + yσ₂ + zσ₃) as ((A, −B), (B, A)).
        "SU2" => |[w, x, y, z], _| {
            vec![vec![w, -y, z, x], vec![y, w, x, -z], vec![-z, -x, w, -y], vec![-x, z, y, w]]
        },
        _ => {
            let what = "a quaternion is an element of SO3, SU2, SE3 or of a power of them";
            table.refuse(span(value), what, ELEMENT);
            return None;
        }
    };
    let quaternions = lists::<4>(table, "quaternion", copies, QUATERNION)?;
    let translations = match table.get("translation") {
        Some(value) if name != "SE3" => {
            let what = "only an element of SE3 has a translation";
            table.refuse(span(value), what, QUATERNION);
            return None;
        }
        Some(_) => lists::<3>(table, "translation", copies, TRANSLATION)?,
        None => vec![[0.0; 3]; copies],
    };
    let mut blocks = Vec::new();
    for (q, t) in quaternions.into_iter().zip(translations) {
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        let off = (length - 1.0).abs();
        if !(off <= UNIT || (projected && length.is_normal())) {
            let what = format!(
                "a quaternion of a rotation has length 1, not {length}; project = true divides by its length"
            );
            table.refuse(span(value), &what, QUATERNION);
            return None;
        }
        blocks.push(block(q.map(|x| x / length), t));
    }
    let size = blocks.first().map_or(0, Vec::len);
    let mut rows = vec![vec![0.0; copies * size]; copies * size];
    for (copy, block) in blocks.iter().enumerate() {
        for (i, row) in block.iter().enumerate() {
            rows[copy * size + i][copy * size..][..size].copy_from_slice(row);
        }
    }
    Some(rows)
}

/// N numbers, or as many lists of N numbers as there are copies.
fn lists<const N: usize>(
    table: &Table<'_>,
    key: &str,
    copies: usize,
    example: &str,
) -> Option<Vec<[f64; N]>> {
    let (list, place) = table.array(key, example)?;
    let rows = if list.iter().any(|entry| entry.get_ref().is_array()) {
        table.matrix(key, table.get(key)?, example)?
    } else {
        vec![table.numbers(key, list, example)?]
    };
    let row = |row: &Vec<Rational>| {
        <[f64; N]>::try_from(row.iter().map(nearest_float).collect::<Vec<_>>()).ok()
    };
    let result: Option<Vec<[f64; N]>> = rows.iter().map(row).collect();
    match result {
        Some(result) if result.len() == copies => Some(result),
        _ => {
            let what = match copies {
                1 => format!("`{key}` must be {N} numbers"),
                _ => format!("`{key}` must be {copies} lists of {N} numbers, one for each factor"),
            };
            table.refuse(place, &what, example);
            None
        }
    }
}

/// The matrix of the rotation v ↦ q v q⁻¹.
fn rotation([w, x, y, z]: [f64; 4]) -> Vec<Vec<f64>> {
    vec![
        vec![1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        vec![2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        vec![2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}
