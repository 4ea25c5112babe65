//! How generation, code and steps grow with the number of spins of a Heisenberg ring.
//!
//! `cargo run --release -p coadjoint-bench --bin growth [-- sites …]`

use std::process::ExitCode;

use coadjoint_bench::growth::{Growth, measure};

fn main() -> ExitCode {
    let mut sites: Vec<usize> = Vec::new();
    for argument in std::env::args().skip(1) {
        match argument.parse() {
            Ok(count) if count > 2 => sites.push(count),
            _ => {
                eprintln!(
                    "error: `{argument}` is no number of sites: give numbers from 3, such as 4 16 64"
                );
                return ExitCode::from(2);
            }
        }
    }
    if sites.is_empty() {
        sites = vec![4, 16, 64, 256];
    }
    println!("Heisenberg ring on SO3^N, K = 3, exponential chart, h = 0.05; per site in brackets");
    println!("{}", Growth::HEADINGS);
    for count in sites {
        match measure(count) {
            Ok(row) => println!("{row}"),
            Err(error) => {
                eprintln!("error: {error}");
                return ExitCode::FAILURE;
            }
        }
    }
    ExitCode::SUCCESS
}
