//! `cargo run --release -p coadjoint-tests --bin global_error -- [MOMENTA]`
//!
//! The errors at T = 100 of tuned and fitted series beside those of the plain one, over random momenta of three
//! bodies (200 of each), both frames, K = 7, 9 and 11. Ends with 1 where more than 1 % are worse than 1.1 times, or
//! one is worse than twice.

use std::process::ExitCode;

use coadjoint_tests::global_error::{CELLS, Comparison, sample};

fn main() -> ExitCode {
    let momenta = match std::env::args().nth(1).map(|count| count.parse()) {
        None => 200,
        Some(Ok(count)) => count,
        Some(Err(_)) => {
            eprintln!("usage: global_error [MOMENTA]");
            return ExitCode::from(2);
        }
    };
    let mut all = Vec::new();
    println!("| K, frame, h | median plain | tuned | fitted |\n|---|---|---|---|");
    for cell in &CELLS {
        let mut errors = sample(cell, momenta);
        errors.sort_by(|a, b| a.plain.total_cmp(&b.plain));
        let median = errors.get(errors.len() / 2).map_or(f64::NAN, |e| e.plain);
        let tuned = Comparison::of(&errors, |e| e.tuned);
        let fitted = Comparison::of(&errors, |e| e.fitted);
        let (k, frame, h) = (cell.truncation, cell.frame, cell.step);
        println!("| {k}, {frame}, {h} | {median:.1e} | {tuned} | {fitted} |");
        all.extend(errors);
    }
    let (tuned, fitted) = (Comparison::of(&all, |e| e.tuned), Comparison::of(&all, |e| e.fitted));
    println!("| all | | {tuned} | {fitted} |");
    match tuned.holds() && fitted.holds() {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}
