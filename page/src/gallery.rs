//! The systems to choose from.

use serde::Serialize;

use crate::fields::Fields;

#[derive(Clone, Debug, Serialize)]
pub struct Exhibit {
    pub id: &'static str,
    pub title: &'static str,
    pub family: &'static str,
    pub about: &'static str,
    pub fields: Fields,
}

macro_rules! entries {
    ($($family:literal { $($id:literal, $title:literal, $path:literal, $about:literal;)* })*) => {
        const ENTRIES: &[[&str; 5]] = &[$($([$family, $id, $title, include_str!($path), $about]),*),*];
    };
}

entries! {
    "Free bodies" {
        "wing-nut", "Wing nut", "../systems/wing_nut.toml",
            "A free body that turns about its intermediate axis tumbles over, again and again (Dzhanibekov's effect).";
        "rigid-body", "Rigid body", "../../examples/rigid_body.toml",
            "The free rigid body of the paper: three moments of inertia, no forces.";
        "free-body-full-inertia", "Brick about its corner", "../../examples/free_body_full_inertia.toml",
            "A homogeneous brick turning about one of its corners, with a full inertia tensor.";
        "gyrostat", "Gyrostat", "../../examples/gyrostat.toml",
            "A spacecraft with a spinning rotor: terms linear in the momentum.";
        "manakov-so4", "Body in four dimensions", "../../examples/manakov_so4.toml",
            "Manakov's free rigid body on SO(4).";
        "relativistic-body", "Relativistic body", "../../examples/relativistic_body.toml",
            "A free body whose energy is a root, of no series: steps are made by collocation.";
    }
    "Tops" {
        "heavy-top", "Heavy top", "../../examples/heavy_top.toml",
            "An asymmetric top under gravity; its vertical, seen from the body, is part of the momentum.";
        "lagrange-top", "Lagrange's top", "../../examples/lagrange_top.toml",
            "The symmetric top: precession and nutation.";
        "heavy-top-bruels", "Fast top (Brüls)", "../../examples/heavy_top_bruels.toml",
            "The fast heavy top of the literature on Lie-group integrators.";
        "kovalevskaya-top", "Kovalevskaya's top", "../../examples/kovalevskaya_top.toml",
            "I₁ = I₂ = 2 I₃: integrable by a fourth integral.";
        "goryachev-chaplygin-top", "Goryachev–Chaplygin top", "../../examples/goryachev_chaplygin_top.toml",
            "I₁ = I₂ = 4 I₃, integrable where Π·Γ = 0.";
        "screened-top", "Top near a screened centre", "../../examples/screened_top.toml",
            "A near point draws the top by Yukawa's force, which falls off faster than Newton's.";
    }
    "Fluids" {
        "kirchhoff-body", "Body in a fluid", "../../examples/kirchhoff_body.toml",
            "Kirchhoff's equations for an ellipsoid in an ideal fluid.";
        "clebsch-case", "Clebsch's case", "../../examples/clebsch_case.toml",
            "Clebsch's integrable body in a fluid.";
        "plate-in-fluid", "Plate in a plane fluid", "../systems/plate_in_fluid.toml",
            "A body in a plane fluid on SE(2): it flutters and turns its broad side to the flow.";
        "zeitlin-3", "Vorticity on a torus", "../../examples/zeitlin_3.toml",
            "Ideal flow on a torus, truncated by the sine bracket at N = 3.";
        "sphere-vortices", "Three vortices on a sphere", "../../examples/sphere_vortices.toml",
            "Point vortices on a sphere, whose energy has logarithms: a triangle that turns without a change of shape.";
    }
    "Spins and waves" {
        "spin-in-crystal", "Spin in a crystal", "../systems/spin_in_crystal.toml",
            "A large spin in a crystal field: a Hamiltonian of degree four, on SU(2).";
        "heisenberg-spin-ring", "Ring of four spins", "../../examples/heisenberg_spin_ring.toml",
            "Four classical spins with exchange, anisotropy and a field, on SO(3)⁴.";
        "exponential-spin", "Spin in a narrow well", "../../examples/exponential_spin.toml",
            "An easy axis whose anisotropy is an exponential, in a field across it.";
        "driven-qubit", "Driven qubit", "../../examples/driven_qubit.toml",
            "A pulse turns a qubit: the Hamiltonian depends on the time t.";
        "three-wave", "Three waves", "../../examples/three_wave.toml",
            "A pump and two daughter waves exchange energy, on su(3)*.";
        "toda-lattice", "Toda lattice", "../../examples/toda_lattice.toml",
            "The open Toda lattice of four particles in Flaschka's variables: it scatters and is gone.";
    }
    "Other groups" {
        "su3-quadratic", "Euler's equations on su(3)*", "../../examples/su3_quadratic.toml",
            "A “free rigid body” whose configurations are SU(3).";
        "sl2-geodesic", "Geodesics on SL(2, ℝ)", "../../examples/sl2_by_basis.toml",
            "An algebra given by its matrices; orbits are hyperboloids.";
        "so21-top", "Top with an indefinite metric", "../../examples/so21_by_brackets.toml",
            "An algebra given by its brackets alone.";
        "kepler", "Kepler's problem", "../../examples/kepler.toml",
            "An orbit of eccentricity 0.9 in regularised time, on three pairs of Heisenberg's algebra.";
        "heisenberg-geodesics", "Heisenberg group", "../systems/heisenberg_geodesics.toml",
            "Geodesics of the Heisenberg group; orbits are planes.";
    }
}

pub fn gallery() -> Vec<Exhibit> {
    let entry = |&[family, id, title, text, about]: &[&'static str; 5]| {
        Fields::of_file(text).map(|fields| Exhibit { id, title, family, about, fields })
    };
    ENTRIES.iter().filter_map(entry).collect()
}
