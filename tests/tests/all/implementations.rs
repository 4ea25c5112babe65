//! Each part of a step is written once: each has a mark that any other implementation would have, too.
//!
//! The judge has its own acceptance and its own domain of a chart, on purpose.

use coadjoint_tests::sources;

/// A part of a step, words of which one is in every implementation of it, and the files that have them.
struct Part {
    name: &'static str,
    words: &'static [&'static str],
    files: &'static [&'static str],
}

const PARTS: &[Part] = &[
    Part {
        // A tree of statements. No other code counts corrections or evaluates them.
        name: "the loop of a step",
        words: &[
            "Tried, corrections",
            "..kernel.corrections",
            "..=kernel.corrections",
            "correct.run(",
        ],
        files: &["program/src/schedule/tree.rs"],
    },
    Part {
        // The interpreter, Cranelift, and the printers of C and Rust.
        name: "a walk through the loop of a step",
        words: &["ernel.schedule()"],
        files: &[
            "native/src/jit/steps.rs",
            "program/src/interpret.rs",
            "program/src/print/steps.rs",
        ],
    },
    Part {
        // Products of powers of the symbols, and the search for the radius of the series by roots of two.
        name: "folding",
        words: &["* self.product(", "* products[", "1.189_207", "fn gradient_bound"],
        files: &["program/src/fold.rs"],
    },
    Part {
        // C evaluates the same data itself.
        name: "folding in C",
        words: &["product[product_of[term]]", "1.1892071"],
        files: &["codegen/src/emit/c/header.h.in"],
    },
    Part {
        name: "the domain of a chart by eigenvalues",
        words: &["fn elliptic_form", "Bendixson"],
        files: &["runtime/src/table/domain.rs"],
    },
    Part {
        name: "the limits of acceptance",
        words: &[
            "LARGEST_RATIO: f64 = 0.5;",
            "NEAR: f64 = 0.05",
            "HALF_TURN: f64",
            "const LARGEST_TAIL",
            "const SOLVED",
        ],
        files: &["program/src/collocation.rs", "program/src/limits.rs"],
    },
    Part {
        // Of a series, and of collocation.
        name: "acceptance by a kernel",
        words: &["fn accept("],
        files: &["symbolic/src/step/collocation.rs", "symbolic/src/step/programs.rs"],
    },
    Part {
        // The generic step names refusals: of functions that are no program, and of steps that kernels refuse.
        name: "acceptance by the generic step",
        words: &["StepError::SeriesDiverges {", "fn accept<"],
        files: &["runtime/src/solve/accept.rs"],
    },
    Part {
        name: "acceptance by the generic step of collocation",
        words: &["StepError::Unresolved {"],
        files: &["runtime/src/collocation/following.rs"],
    },
    Part {
        // The charts of both.
        name: "refusal of a step outside the chart",
        words: &["StepError::OutsideChart {"],
        files: &["runtime/src/collocation/following.rs", "runtime/src/solve/accept.rs"],
    },
    Part {
        name: "rescue",
        words: &["const SHORTEST", "-> Result<CandidateOf<S>, f64>"],
        files: &["runtime/src/solve/continuation.rs"],
    },
    Part {
        // Outputs by the one function that never writes over an input, nor a part of a file; a compiler's text and its library.
        name: "a file that is written",
        words: &[
            "File::create",
            "fs::write",
            "OpenOptions",
            "File::options",
            "fs::rename",
            "fs::copy",
            "hard_link",
            "Writer::from_path",
            ".write_text(",
            ".write_bytes(",
            "os.replace",
            ", \"w\")",
            "\"w\", encoding",
            ", \"wb\"",
            ", \"xb\"",
            ", \"a\"",
        ],
        files: &[
            "codegen/src/file.rs",
            "native/src/c.rs",
            "native/src/store.rs",
            "python/coadjoint/cluster/files.py",
        ],
    },
    Part {
        name: "drift",
        words: &["fn measured(&self, now: &[f64]", "const MEASURABLE"],
        files: &["symbolic/src/step/drift.rs"],
    },
];

#[test]
fn each_part_of_a_step_is_implemented_where_it_is_said_to_be() {
    let crates = [
        "geometry", "program", "native", "symbolic", "codegen", "macros", "runtime", "learn",
        "run", "cli", "page", "python",
    ];
    let of =
        |ending| crates.iter().flat_map(move |name| sources::files(&format!("{name}/src"), ending));
    let python = sources::files("python/coadjoint", ".py").into_iter();
    let python = python.map(|(file, text)| (file, text.replace("_core.write_text", "")));
    let files: Vec<_> = of(".rs").chain(of(".in")).chain(python).collect();
    assert!(files.len() > 200, "{} files", files.len());
    for Part { name, words, files: known } in PARTS {
        let implements = |(file, text): &&(String, String)| {
            !file.contains("/judge/") && words.iter().any(|word| text.contains(word))
        };
        let mut found: Vec<&str> = files.iter().filter(implements).map(|file| &*file.0).collect();
        found.sort_unstable();
        assert_eq!(found, *known, "{name}");
    }
}
