//! The experiments of the paper by name, seeded: figures beside the paper's, curves as CSV.

mod baseline;
mod geometrize;
mod hamilton_jacobi;
mod hamiltonian;
mod harder;
mod learned;
mod networks;
mod noise;
mod orders;
mod reduction_error;
mod report;
mod run;
mod runge_kutta;
mod simulation;
mod steps;
mod table_one;
mod table_two;
mod task;
mod work;

pub use report::{Bound, Cell, Curve, Judgement, Report, Table};
pub use run::{NAMES, RunOptions, run};
pub use runge_kutta::{RungeKuttaError, dormand_prince};
