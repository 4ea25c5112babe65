//! Bodies with their attitude: equations, start, end and a converged reference, from `reference/end_states.json`.

use serde::Deserialize;

use crate::timing::Failure;

pub type Vector = [f64; 3];
/// Scalar part first.
pub type Quaternion = [f64; 4];

#[inline(always)]
pub fn cross(u: &Vector, v: &Vector) -> Vector {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

#[inline(always)]
pub fn dot(u: &Vector, v: &Vector) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

/// The state of a run: body momentum, and group element from the body to space.
#[derive(Clone, Debug)]
pub struct State {
    /// Angular momentum in the body.
    pub momentum: Vector,
    /// Linear momentum in the body (of a top: the direction of gravity); zero for a free body.
    pub force: Vector,
    /// The rotation, by rows.
    pub rotation: [Vector; 3],
    pub position: Vector,
}

impl State {
    pub fn rotating(momentum: Vector, rotation: [Vector; 3]) -> Self {
        Self { momentum, force: [0.0; 3], rotation, position: [0.0; 3] }
    }

    /// The largest difference of a component from another state, momenta and positions in units of `scale`; infinite
    /// where there is no number.
    pub fn error(&self, other: &Self, scale: f64) -> f64 {
        let far = |a: &Vector, b: &Vector, unit: f64| {
            let far = (0..3).map(|i| (a[i] - b[i]).abs() / unit);
            far.fold(0.0, |a, b| if b.is_nan() { f64::INFINITY } else { b.max(a) })
        };
        (0..3)
            .map(|row| far(&self.rotation[row], &other.rotation[row], 1.0))
            .fold(0.0, f64::max)
            .max(far(&self.momentum, &other.momentum, scale))
            .max(far(&self.force, &other.force, 1.0))
            .max(far(&self.position, &other.position, scale))
    }
}

/// The rotation of a unit quaternion, by rows.
pub fn matrix(q: &Quaternion) -> [Vector; 3] {
    let [w, x, y, z] = *q;
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// The Hamiltonian: H = ½ Σ Πᵢ²/Iᵢ, and besides on se(3)\* …
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dynamics {
    /// … nothing: a free body.
    Free,
    /// … w Γ₁: a top with its centre of mass on the first axis.
    TopOnFirst(f64),
    /// … w Γ₂: on the second.
    TopOnSecond(f64),
    /// … ½ Σ Γᵢ²/Mᵢ: a body in an ideal fluid, with its 1/Mᵢ.
    Fluid(Vector),
    /// √(1 + Σ μᵢ²/Iᵢ) + μ₂³/10 in place of all of it.
    Root,
    /// 3/5 μ₀ + 3/10 exp(4/5 μ₂) + 1/5 exp(−μ₁/2), likewise.
    Spin,
    /// Six variables with 1/√ and exp, likewise; the motion in space is left aside.
    Six,
}

/// An initial value problem; every body starts at the identity.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Its name in files and options.
    pub name: String,
    pub title: &'static str,
    /// 1/Iᵢ.
    pub inverse_inertia: Vector,
    pub kind: Dynamics,
    /// Π at the start.
    pub momentum: Vector,
    /// Γ at the start.
    pub force: Vector,
    /// T.
    pub end: f64,
    /// The state at T, converged to more digits than a double holds.
    pub reference: State,
    /// The unit of momenta and positions.
    pub scale: f64,
    /// A time over which the body turns by about a radian.
    pub time_scale: f64,
}

const TITLES: [(&str, &str, f64, f64); 7] = [
    ("free-body-a", "Free body A", 1.0, 0.8),
    ("free-body-b", "Free body B", 1.0, 0.8),
    ("heavy-top", "Heavy top of Brüls, Cardona and Arnold", 100.0, 0.008),
    ("kirchhoff", "Kirchhoff's body in a fluid", 1.0, 0.8),
    ("kovalevskaya", "Kovalevskaya's top", 1.0, 0.25),
    ("kirchhoff-long", "Kirchhoff's body in a fluid", 1.0, 0.8),
    ("kovalevskaya-long", "Kovalevskaya's top", 1.0, 0.25),
];

#[derive(Deserialize)]
struct Entry {
    name: String,
    inverse_inertia: [String; 3],
    inverse_mass: Option<[String; 3]>,
    linear: Option<[String; 3]>,
    momentum: [String; 3],
    force: Option<[String; 3]>,
    end: String,
    end_state: Figures,
}

#[derive(Deserialize)]
pub struct Figures {
    momentum: [String; 3],
    force: [String; 3],
    quaternion: [String; 4],
    position: [String; 3],
}

impl Figures {
    pub fn state(&self) -> Result<State, Failure> {
        let [momentum, force, position] =
            [numbers(&self.momentum)?, numbers(&self.force)?, numbers(&self.position)?];
        Ok(State { momentum, force, rotation: matrix(&numbers(&self.quaternion)?), position })
    }
}

/// Numbers and quotients of numbers.
fn numbers<const N: usize>(texts: &[String; N]) -> Result<[f64; N], Failure> {
    let mut values = [0.0; N];
    for (value, text) in values.iter_mut().zip(texts) {
        let (above, below) = text.split_once('/').unwrap_or((text, "1"));
        *value = above.parse::<f64>()? / below.parse::<f64>()?;
    }
    Ok(values)
}

/// The file of references, written by `tests/reference/make_references.py`.
pub const FILE: &str = include_str!("../../reference/end_states.json");

pub fn all() -> Result<Vec<Problem>, Failure> {
    let entries: Vec<Entry> = serde_json::from_str(FILE)?;
    entries.iter().map(problem).collect()
}

fn problem(entry: &Entry) -> Result<Problem, Failure> {
    let known = TITLES.iter().find(|known| known.0 == entry.name);
    let (_, title, scale, time_scale) = *known.ok_or("a problem without a title")?;
    let optional = |texts: &Option<[String; 3]>| texts.as_ref().map_or(Ok([0.0; 3]), numbers);
    let weight = optional(&entry.linear)?;
    let kind = match (&entry.inverse_mass, weight) {
        (Some(mass), _) => Dynamics::Fluid(numbers(mass)?),
        (None, [w, 0.0, 0.0]) if w != 0.0 => Dynamics::TopOnFirst(w),
        (None, [0.0, w, 0.0]) if w != 0.0 => Dynamics::TopOnSecond(w),
        _ => Dynamics::Free,
    };
    Ok(Problem {
        name: entry.name.clone(),
        title,
        inverse_inertia: numbers(&entry.inverse_inertia)?,
        kind,
        momentum: numbers(&entry.momentum)?,
        force: optional(&entry.force)?,
        end: numbers(std::slice::from_ref(&entry.end).try_into()?).map(|[end]| end)?,
        reference: entry.end_state.state()?,
        scale,
        time_scale,
    })
}
