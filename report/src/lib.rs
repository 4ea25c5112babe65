//! One page that shows every figure and table of the paper, with what came out and the number that judges it.
//!
//! [`page`] makes HTML of the outcomes of [`coadjoint_learn::experiment`], of pictures of runs, and of the
//! benchmark's files. The page needs no network, is light or dark as the reader's system is, and is made for desktops,
//! phones and paper. The same outcomes make the same bytes.
//!
//! ```
//! use coadjoint_report::{Page, page};
//! assert!(page(&Page::default()).contains("<h1>"));
//! ```

mod benchmark;
mod gallery;
mod html;
mod ours;
mod paper;
mod prose;
mod rules;
mod section;

use std::collections::BTreeSet;

use coadjoint_draw::run::Picture;
use coadjoint_learn::experiment::Report;

pub use benchmark::{Benchmark, BenchmarkError, read_benchmarks};
pub use section::Section;

/// The identifiers of all figures and tables of a whole page, in its order.
pub const FIGURES: [&str; 20] = [
    "energy",
    "energy-7",
    "momentum",
    "difference",
    "training",
    "trajectory",
    "table-1",
    "noise",
    "reduction-error",
    "hamiltonian",
    "table-2",
    "poisson",
    "geometrize",
    "hamilton-jacobi",
    "charts",
    "orders",
    "work",
    "benchmark",
    "harder-truths",
    "gallery",
];

/// What a page is made of.
#[derive(Clone, Debug, Default)]
pub struct Page {
    /// The outcomes of experiments; what is not among them is not shown.
    pub reports: Vec<Report>,
    /// The pictures of the systems, in the order of the gallery; none where no gallery was asked for.
    pub gallery: Vec<Picture>,
    /// What the benchmark measured.
    pub benchmarks: Vec<Benchmark>,
}

/// The sections of a page, in its order.
#[must_use]
pub fn sections(page: &Page) -> Vec<Section> {
    let mut sections: Vec<Section> = page.reports.iter().flat_map(of_report).collect();
    sections.extend(benchmark::section(&page.benchmarks));
    let place = |section: &Section| FIGURES.iter().position(|id| *id == section.id);
    sections.sort_by_key(place);
    sections
}

fn of_report(report: &Report) -> Vec<Section> {
    match report.name.as_str() {
        "simulation" => paper::simulation::sections(report),
        "learned" => paper::learning::trained(report),
        "table-1" => vec![paper::learning::table_one(report)],
        "noise" => vec![paper::learning::noise(report)],
        "reduction-error" => vec![paper::learning::reduction_error(report)],
        "hamiltonian" => vec![paper::learning::hamiltonian(report)],
        "table-2" => paper::poisson::sections(report),
        "geometrize" => vec![paper::poisson::geometrize(report)],
        "hamilton-jacobi" => vec![paper::poisson::hamilton_jacobi(report)],
        "orders" => ours::orders(report),
        "work" => vec![ours::work(report)],
        "harder-truths" => vec![ours::harder(report)],
        _ => Vec::new(),
    }
}

/// The page as the text of an HTML file.
#[must_use]
pub fn page(page: &Page) -> String {
    let sections = sections(page);
    let quick = page.reports.iter().any(|report| report.quick);
    let seeds: BTreeSet<u64> = page.reports.iter().map(|report| report.seed).collect();
    html::page(&sections, &page.gallery, quick, &seeds)
}
