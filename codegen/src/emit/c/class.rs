//! The class of C++.

use super::names::Names;
use super::programs::casimirs;
use super::template::{CLASS, CLASS_CASIMIRS};
use crate::integrator::Integrator;
use crate::step::Step;

/// The class, for compilers of C++ alone.
pub fn class(integrator: &Integrator, step: &Step, names: &Names) -> String {
    let with = !integrator.problem.parameters.is_empty();
    let parameters = if with { "    typedef @p@_parameters Parameters;\n" } else { "" };
    let text = CLASS
        .replace("/*PARAMETERS*/\n", &format!("{parameters}\n"))
        .replace("/*ARGUMENT*/", if with { ", const Parameters &parameters" } else { "" })
        .replace("/*PASSED*/", if with { ", &parameters" } else { "" })
        .replace("/*CASIMIRS*/\n", if casimirs(step) > 0 { CLASS_CASIMIRS } else { "" });
    let text = text.replace("    double energy(const State &state) const noexcept { return @p@_energy(&map_, &state); }\n    /** As", "    double energy(const State &state) const noexcept { return @p@_energy(&map_, &state); }\n\n    /** As");
    names.fill(&format!("\n#if defined(__cplusplus){text}#endif\n"))
}
