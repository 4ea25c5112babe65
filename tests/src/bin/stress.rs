//! `cargo run --release -p coadjoint-tests --bin stress -- --steps 1000000 [--seed 1] [--only NAME] [--threads 1]`
//!
//! Random steps over groups, charts, truncations, solvers and frames, judged in doubled precision. Prints a
//! table by family, the first examples of what is wrong, and a closing line (and to standard error how long steps
//! took); ends with 1 if anything was.
//! `--only FAMILY --instance SEED` repeats the 64 draws of an example.

use std::process::ExitCode;

use coadjoint_tests::stress::{Campaign, report, run, times};

fn main() -> ExitCode {
    match options() {
        Ok(options) => {
            let tallies = run(&options);
            if tallies.is_empty() {
                eprintln!("no family's name contains {:?}", options.only);
                return ExitCode::from(2);
            }
            eprintln!("{}", times(&tallies));
            println!("{}", report(&tallies));
            match tallies.iter().any(|(_, tally)| tally.wrong() > 0) {
                true => ExitCode::FAILURE,
                false => ExitCode::SUCCESS,
            }
        }
        Err(message) => {
            eprintln!(
                "{message}\nusage: stress [--steps N] [--seed N] [--only NAME] [--threads N] [--instance SEED]"
            );
            ExitCode::from(2)
        }
    }
}

fn options() -> Result<Campaign, String> {
    let mut options = Campaign {
        steps: 100_000,
        seed: 1,
        only: String::new(),
        threads: 1,
        instance: None,
        even: false,
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{name} wants a value"))?;
        let number =
            || value.parse::<f64>().map_err(|_| format!("{name}: {value} is not a number"));
        let whole = || value.parse::<u64>().map_err(|_| format!("{name}: {value} is not whole"));
        match name.as_str() {
            "--steps" => options.steps = number()? as u64,
            "--seed" => options.seed = whole()?,
            "--only" => options.only = value,
            "--threads" => options.threads = whole()? as usize,
            "--instance" => options.instance = Some(whole()?),
            _ => return Err(format!("unknown option {name}")),
        }
    }
    Ok(options)
}
