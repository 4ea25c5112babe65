//! `coadjoint`: derive, emit, simulate and check Lie–Poisson integrators from a system file.
//!
//! This crate only wires: reading and derivation are in `coadjoint-codegen`, groups and steps in
//! `coadjoint`, learning in `coadjoint-learn`. Exit codes: 0 fine, 1 a failure while running (or a law
//! that does not hold), 2 bad input, 3 not verified (`verify` alone), 130 interrupted.

#[macro_use]
mod output;

mod arguments;
mod casimirs;
mod check;
mod derive;
mod emit;
mod ensemble;
mod error;
mod form;
mod groups;
mod learn;
mod load;
mod named;
mod note;
mod progress;
mod reproduce;
mod simulate;
mod source;
mod verify;

use std::process::ExitCode;

use arguments::Verb;

fn main() -> ExitCode {
    let outcome = match arguments::parse().verb {
        Verb::Derive(options) => derive::run(&options),
        Verb::Emit(options) => emit::run(&options),
        Verb::Simulate(options) => simulate::run(&options),
        Verb::Ensemble(options) => ensemble::run(&options),
        Verb::Check(options) => check::run(&options),
        Verb::Verify(options) => verify::run(&options),
        Verb::Casimirs(options) => casimirs::run(&options),
        Verb::Groups(options) => groups::run(&options),
        Verb::Learn(options) => learn::run(&options),
        Verb::Reproduce(options) => reproduce::run(&options),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            err!("{}", error.text());
            ExitCode::from(error.exit_code())
        }
    }
}
