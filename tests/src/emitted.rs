//! Systems whose Rust the build script emits, for `tests/all/emitted_steps.rs` to compile and compare: arguments of the
//! attribute, and the function.

use coadjoint_codegen::diagnostic::Diagnostics;
use coadjoint_codegen::hamilton_jacobi::TermLimit;
use coadjoint_codegen::parse::rust;
use coadjoint_codegen::step::Origin;

/// The arguments of an attribute and its function.
pub type Source = (&'static str, &'static str);

pub const SYSTEMS: [Source; 13] = [
    RIGID_BODY,
    CAYLEY_BODY,
    HEAVY_TOP,
    COMOVING_BODY,
    THREE_WAVE,
    RELATIVISTIC,
    TABLES,
    TWIST,
    PLANAR_BODY,
    SPIN,
    SPINS,
    CHARGE,
    SIDE_BY_SIDE,
];

/// The system that the attribute with `arguments` makes steps of, from the source of a function.
pub fn origin((arguments, function): Source) -> syn::Result<Origin> {
    let function: syn::ItemFn = syn::parse_str(function)?;
    let read =
        rust::hamiltonian(arguments.parse()?, &function).map_err(Diagnostics::into_syn_error)?;
    Origin::derive(read, TermLimit::default())
        .map_err(|error| syn::Error::new_spanned(&function.sig.ident, error))
}

/// The paper's rigid body, its Hessian truncated for Newton's method.
pub const RIGID_BODY: (&str, &str) = (
    "group = SO3, truncation = 9",
    "fn rigid_body(mu: [f64; 3]) -> f64 {
        let [x, y, z] = mu;
        0.5 * (x * x / 1.5 + y * y / 2.0 + z * z / 2.5)
    }",
);

/// A cubic Hamiltonian in the Cayley chart.
pub const CAYLEY_BODY: (&str, &str) = (
    "group = SO3, truncation = 3, chart = cayley",
    "fn cayley_body(mu: [f64; 3]) -> f64 {
        mu[0] * mu[0] / 3.0 + mu[1] * mu[1] / 4.0 + mu[2] * mu[2] / 5.0 + 0.1 * mu[0].powi(3)
    }",
);

/// A heavy top on SE(3), H linear in part.
pub const HEAVY_TOP: (&str, &str) = (
    "group = SE3, truncation = 3",
    "fn heavy_top(mu: [f64; 6], inertia: [f64; 3], m: f64, g: f64, l: f64) -> f64 {
        let [a, b, c, _, _, up] = mu;
        0.5 * (a * a / inertia[0] + b * b / inertia[1] + c * c / inertia[2]) + m * g * l * up
    }",
);

/// A symmetric body in a fluid: a spin and a Casimir move the frame.
pub const COMOVING_BODY: (&str, &str) = (
    "group = SE3, truncation = 3, frame = comoving",
    "fn comoving_body(mu: [f64; 6], inertia: [f64; 2], mass: [f64; 2]) -> f64 {
        let [a, b, c, u, v, w] = mu;
        0.5 * ((a * a + b * b) / inertia[0] + c * c / inertia[1] + (u * u + v * v) / mass[0] + w * w / mass[1])
    }",
);

/// The resonant three-wave interaction on SL(2,R), a group the runtime has tables for.
pub const THREE_WAVE: (&str, &str) = (
    "group = SL2, truncation = 5",
    "fn three_wave(mu: [f64; 3], s: f64) -> f64 {
        mu[0] * mu[0] / 8.0 + s * mu[1] * mu[2]
    }",
);

/// A body at speeds near that of light, by collocation.
pub const RELATIVISTIC: Source = (
    "group = SO3",
    "fn relativistic(mu: [f64; 3], inertia: [f64; 3]) -> f64 {
        let [x, y, z] = mu;
        (1.0 + x * x / inertia[0] + y * y / inertia[1] + z * z / inertia[2]).sqrt()
    }",
);

/// One node on a group by tables, of its own.
pub const TABLES: Source = (
    "group = algebra(generators = [a, b, c], brackets = [\"[a, b] = c\"]), truncation = 1",
    "fn tables(mu: [f64; 3]) -> f64 {
        (1.0 + mu[0] * mu[0] + mu[1] * mu[1]).sqrt() + mu[2].sin()
    }",
);

/// A twist about the third axis whose rate grows.
pub const TWIST: Source = (
    "group = SO3, truncation = 5, time = s",
    "fn twist(mu: [f64; 3], s: f64, rate: f64) -> f64 {
        0.5 * mu[2] * mu[2] * (rate * s).exp() + 0.1 * mu[0] * mu[1]
    }",
);

/// A planar body in an ideal fluid.
pub const PLANAR_BODY: Source = (
    "group = SE2, truncation = 7",
    "fn planar_body(mu: [f64; 3], inertia: f64, mass: [f64; 2]) -> f64 {
        0.5 * (mu[0] * mu[0] / inertia + mu[1] * mu[1] / mass[0] + mu[2] * mu[2] / mass[1])
    }",
);

/// A spin with a quartic anisotropy.
pub const SPIN: Source = (
    "group = SU2, truncation = 5",
    "fn spin(mu: [f64; 3], field: f64) -> f64 {
        mu[0].powi(2) / 3.0 + mu[1].powi(4) / 8.0 + field * mu[2]
    }",
);

pub const SPINS: Source = (
    "group = SO3^2, truncation = 3",
    "fn spins(mu: [f64; 6], coupling: f64) -> f64 {
        coupling * (mu[0] * mu[3] + mu[1] * mu[4] + mu[2] * mu[5]) + mu[2] * mu[2] / 3.0
    }",
);

/// A charge in a homogeneous magnetic field of strength μ₃.
pub const CHARGE: Source = (
    "group = Heisenberg, truncation = 7, chart = cayley",
    "fn charge(mu: [f64; 3]) -> f64 {
        0.5 * (mu[0] * mu[0] + mu[1] * mu[1])
    }",
);

/// A body in space and one in the plane.
pub const SIDE_BY_SIDE: Source = (
    "group = SO3 * SE2, truncation = 5",
    "fn side_by_side(mu: [f64; 6]) -> f64 {
        let [a, b, c, x, y, z] = mu;
        a * a / 2.0 + b * b / 3.0 + c * c / 4.0 + x * x / 2.0 + y * y / 2.0 + z * z / 4.0
    }",
);
