//! Options whose values have names.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use coadjoint_codegen::emit::c::Language;
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::problem::{Method, Solver};
use coadjoint_program::{Precision, print::DeviceLanguage};
use coadjoint_run::Backend;

/// Names, descriptions and values; names without a description are understood, and not listed.
pub(crate) type Names<T> = [(&'static str, &'static str, T)];

/// Reads one of these names.
pub(crate) fn named<T>(list: &'static Names<T>) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    let names = list
        .iter()
        .map(|&(name, about, _)| PossibleValue::new(name).help(about).hide(about.is_empty()));
    PossibleValuesParser::new(names).try_map(|name| {
        let known = list.iter().find(|known| known.0 == name);
        known.map(|known| known.2).ok_or("no such name")
    })
}

/// Charts.
pub(crate) const CHARTS: &Names<Chart> =
    &[("exp", "The exponential", Chart::Exponential), ("cayley", "The Cayley map", Chart::Cayley)];

/// Solvers.
pub(crate) const SOLVERS: &Names<Solver> = &[
    ("newton", "Newton's method, with the Hessian", Solver::Newton),
    ("fixed_point", "The fixed point, with the gradient alone", Solver::FixedPoint),
    ("fixed-point", "", Solver::FixedPoint),
];

/// Methods.
pub(crate) const METHODS: &Names<Method> = &[
    ("series", "The generating function of a polynomial", Method::Series),
    ("collocation", "Gauss's method, for any smooth Hamiltonian", Method::Collocation),
];

/// Backends.
pub(crate) const BACKENDS: &Names<Backend> = &[
    ("auto", "The cheapest for this run: a short one never waits for a compiler", Backend::Auto),
    ("interpreter", "The interpreter, which is always available", Backend::Interpreter),
    ("c", "The system's C compiler, for this processor", Backend::C),
    #[cfg(feature = "jit")]
    ("jit", "Cranelift, for this processor", Backend::Jit),
];

/// Precisions.
pub(crate) const PRECISIONS: &Names<Precision> = &[
    ("double", "64 bits: the same bits as every back end", Precision::Double),
    (
        "single",
        "32 bits: faster on most cards; what is conserved drifts by 1e-7 and above",
        Precision::Single,
    ),
];

/// A language to emit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// Rust.
    Rust,
    /// A header.
    Header(Language),
    /// A kernel for devices.
    Kernel(DeviceLanguage),
}

/// Languages to emit.
pub(crate) const LANGUAGES: &Names<Target> = &[
    ("rust", "A Rust module", Target::Rust),
    ("c", "One header of C99, for embedded and flight software", Target::Header(Language::C)),
    ("cpp", "The header of C99 with a class of C++11", Target::Header(Language::Cpp)),
    (
        "opencl",
        "A kernel in OpenCL C, one thread per trajectory",
        Target::Kernel(DeviceLanguage::OpenCl),
    ),
    (
        "cuda",
        "A kernel in CUDA C++, one thread per trajectory",
        Target::Kernel(DeviceLanguage::Cuda),
    ),
];

/// Formats for people, and for programs.
pub(crate) const FORMATS: &Names<Format> =
    &[("text", "For people", Format::Text), ("json", "For programs", Format::Json)];

/// The format of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// Text for people.
    Text,
    /// JSON for programs.
    Json,
}
