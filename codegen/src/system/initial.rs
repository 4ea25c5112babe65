//! The table `[initial]`: the state at the start.

use toml::de::DeValue;

use super::project::project;
use super::run::{Run, accepted};
use super::table::{Table, Value, span};
use crate::diagnostic::{Mistake, Span};
use crate::lie::{LieAlgebra, RationalMatrix};
use crate::number::{Rational, integer, nearest_float};
use crate::poly::{Numeric, split_at};
use crate::problem::Problem;
use crate::smooth::Smooth;

const TIME: &str = "time = 5.0";
const MOMENTUM: &str = "momentum = [2.0, 0.5, 1.0]";
const VELOCITY: &str = "angular_velocity = [0.1, 0, 2]";
const LINEAR: &str = "linear_velocity = [0, 0, 1]";
const ELEMENT: &str = "group_element = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
const QUATERNION: &str = "quaternion = [1, 0, 0, 0]";
const TRANSLATION: &str = "translation = [0, 0, 0]";
/// The largest difference of a quaternion's length from 1 without `project`.
const UNIT: f64 = 1e-9;

/// Velocities at the start, of which the first coordinates of the momentum follow.
pub(super) struct Velocities {
    /// The first coordinates of ∂H/∂μ.
    velocity: Vec<Rational>,
    /// The other coordinates of the momentum.
    others: Vec<Rational>,
    place: Span,
}

/// Reads `[initial]` into `run`; returns velocities from which [`momentum`] finds the momentum.
pub(super) fn read(
    root: &Table<'_>,
    algebra: Option<&LieAlgebra>,
    run: &mut Run,
) -> Option<Velocities> {
    let table = root.table("initial")?;
    table.check_keys(&[
        "time",
        "momentum",
        "angular_velocity",
        "linear_velocity",
        "linear_momentum",
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
    let stated = stated(&table, algebra)?;
    if table.has("momentum") {
        let what = "`momentum` and `angular_velocity` are both given: keep one";
        table.refuse(stated.place, what, MOMENTUM);
    }
    Some(stated)
}

/// Reads `angular_velocity`, on SE3 with the velocity or the momentum of translations beside it.
fn stated(table: &Table<'_>, algebra: Option<&LieAlgebra>) -> Option<Velocities> {
    let beside = [("linear_velocity", LINEAR), ("linear_momentum", "linear_momentum = [0, 0, 1]")];
    if algebra.is_some_and(|algebra| algebra.name() == "SE3") {
        let three = |key: &str, example: &str| {
            let (list, place) = table.array(key, example)?;
            if list.len() != 3 {
                table.refuse(place, &format!("`{key}` must be three numbers"), example);
                return None;
            }
            Some((table.numbers(key, list, example)?, place))
        };
        let angular = three("angular_velocity", VELOCITY);
        let [linear, momentum] = beside.map(|(key, example)| three(key, example));
        let (mut velocity, place) = angular?;
        let others = match (linear, momentum) {
            (Some((linear, _)), None) => {
                velocity.extend(linear);
                Vec::new()
            }
            (None, Some((momentum, _))) => momentum,
            _ => {
                let what = "beside an angular velocity of SE3 stands either `linear_velocity` or `linear_momentum`, in the body";
                table.refuse(place, what, LINEAR);
                return None;
            }
        };
        return Some(Velocities { velocity, others, place });
    }
    for (key, example) in beside {
        if let Some(value) = table.get(key) {
            let what = format!("`{key}` stands beside an `angular_velocity` on SE3");
            table.refuse(span(value), &what, example);
        }
    }
    let (velocity, place) = coordinates(table, "angular_velocity", VELOCITY, algebra)?;
    if !algebra.is_none_or(|algebra| matches!(factor(algebra).0, "SO3" | "SU2")) {
        let what = "an angular velocity is one of SO3, SU2 or a power of them, or of SE3: give the momentum";
        table.refuse(place, what, MOMENTUM);
    }
    Some(Velocities { velocity, others: Vec::new(), place })
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
type Linear = (RationalMatrix, Vec<Rational>);

/// A function of the momentum.
type Values<'a> = dyn Fn(&[f64]) -> Vec<f64> + 'a;

/// ∂H/∂μ at the start, at the defaults of parameters that are kept.
pub(super) struct Gradient<'a> {
    /// It as a linear function, where it is one.
    linear: Option<Linear>,
    /// Its values.
    at: Box<Values<'a>>,
}

/// Steps of Newton's method at most, and halvings of one.
const STEPS: u32 = 60;
const HALVINGS: u32 = 30;
/// The largest residual, relative to the velocity, and the spacing of differences of a gradient.
const CLOSE: f64 = 1e-14;
const SPACING: f64 = 1e-6;

/// The momentum of which ∂H/∂μ has the stated velocities; reports a Hamiltonian of which they do not determine it.
pub(super) fn momentum(
    gradient: &Gradient<'_>,
    stated: &Velocities,
    root: &Table<'_>,
) -> Option<Vec<f64>> {
    let Velocities { velocity, others, place } = stated;
    let count = velocity.len();
    let others = others.iter().map(nearest_float);
    let momentum = match &gradient.linear {
        Some((matrix, bias)) => {
            let known = |i: usize| -> Rational {
                let terms = stated.others.iter().enumerate();
                terms.map(|(j, own)| matrix.get(i, count + j) * own).sum()
            };
            let right = velocity.iter().zip(bias).enumerate();
            let right = right.map(|(i, (w, b))| (i, 0, w - b - known(i)));
            let right = RationalMatrix::from_entries(count, 1, right);
            let own = matrix.entries().filter(|(i, j, _)| *i.max(j) < count);
            let own = own.map(|(i, j, value)| (i, j, value.clone()));
            let inverse = RationalMatrix::from_entries(count, count, own).inverse();
            inverse.map(|inverse| {
                let own = inverse.times(&right);
                (0..count).map(|i| nearest_float(&own.get(i, 0))).chain(others).collect()
            })
        }
        None => {
            let velocity: Vec<f64> = velocity.iter().map(nearest_float).collect();
            newton(&gradient.at, &velocity, &others.collect::<Vec<_>>())
        }
    };
    if momentum.is_none() {
        let what = "this does not determine the momentum: ∂H/∂μ has no inverse there";
        root.refuse(*place, what, MOMENTUM);
    }
    momentum
}

/// The momentum with these last coordinates of which the first components of the gradient are the velocity.
fn newton(gradient: &Values<'_>, velocity: &[f64], others: &[f64]) -> Option<Vec<f64>> {
    let size = |list: &[f64]| list.iter().map(|x| x.abs()).sum::<f64>();
    let left = |mu: &[f64]| -> Vec<f64> {
        gradient(mu).iter().zip(velocity).map(|(found, wanted)| found - wanted).collect()
    };
    let count = velocity.len();
    let mut mu = [velocity, others].concat();
    let mut residual = left(&mu);
    for _ in 0..STEPS {
        if size(&residual) <= CLOSE * size(velocity) {
            return Some(mu);
        }
        let mut entries = Vec::new();
        for j in 0..count {
            let (here, by) = (mu[j], SPACING * mu[j].abs().max(1.0));
            let [above, below] = [by, -by].map(|by| {
                mu[j] = here + by;
                left(&mu)
            });
            mu[j] = here;
            for (i, (above, below)) in above.iter().zip(&below).enumerate() {
                entries.push((i, j, Rational::from_float((above - below) / (2.0 * by))?));
            }
        }
        let right =
            residual.iter().enumerate().map(|(i, x)| Some((i, 0, Rational::from_float(*x)?)));
        let right = RationalMatrix::from_entries(count, 1, right.collect::<Option<Vec<_>>>()?);
        let step = RationalMatrix::from_entries(count, count, entries).inverse()?.times(&right);
        let better = (0..HALVINGS).map(|halvings| 0.5_f64.powi(halvings as i32)).find_map(|part| {
            let mut next = mu.clone();
            for (i, own) in next.iter_mut().take(count).enumerate() {
                *own -= part * nearest_float(&step.get(i, 0));
            }
            let there = left(&next);
            (size(&there) < size(&residual)).then_some((next, there))
        });
        let Some((next, there)) = better else {
            // Rounding alone is left.
            return (size(&residual) <= 1e3 * CLOSE * size(velocity)).then_some(mu);
        };
        (mu, residual) = (next, there);
    }
    None
}

/// The gradient of a smooth Hamiltonian at this time.
pub(super) fn of_smooth(smooth: &Smooth, time: f64) -> Gradient<'_> {
    let dim = smooth.algebra.dim();
    let symbols = smooth.symbols_at(&smooth.facts().defaults());
    let at = move |mu: &[f64]| smooth.gradient(&symbols, time, mu);
    let exact = |mu: &[f64]| -> Option<Vec<Rational>> {
        at(mu).into_iter().map(Rational::from_float).collect()
    };
    let linear = || {
        let mut mu = vec![0.0; dim];
        let bias = exact(&mu)?;
        let mut entries = Vec::new();
        for j in 0..dim {
            mu[j] = 1.0;
            let column = exact(&mu)?.into_iter().zip(&bias).enumerate();
            entries.extend(column.map(|(i, (value, bias))| (i, j, value - bias)));
            mu[j] = 0.0;
        }
        Some((RationalMatrix::from_entries(dim, dim, entries), bias))
    };
    let linear = if smooth.is_quadratic() { linear() } else { None };
    Gradient { linear, at: Box::new(at) }
}

/// The gradient of a polynomial.
pub(super) fn of_polynomial(problem: &Problem) -> Gradient<'_> {
    let dim = problem.algebra.dim();
    let defaults = problem.facts().defaults();
    let symbols: Vec<f64> =
        problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&defaults)).collect();
    let slope = |i| Numeric::new(&problem.hamiltonian.derivative(i), dim, &symbols);
    let slopes: Vec<Numeric> = (0..dim).map(slope).collect();
    let at = move |mu: &[f64]| slopes.iter().map(|slope| slope.value(mu)).collect();
    Gradient { linear: linear(problem, &symbols), at: Box::new(at) }
}

/// The gradient of a polynomial as a linear function, if it is one.
fn linear(problem: &Problem, symbols: &[f64]) -> Option<Linear> {
    let dim = problem.algebra.dim();
    let symbols: Option<Vec<Rational>> =
        symbols.iter().map(|value| Rational::from_float(*value)).collect();
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
