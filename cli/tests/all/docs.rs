//! The pages are run as they stand: README.md, the command's own README, and every chapter of the manual
//! (`docs/book/src`), each in a folder of its own with the examples (`support/page.rs`).

use crate::support::page::{Block, blocks, file_name, run, with_examples};
use crate::support::{root, text_of as page};

#[test]
fn the_two_commands_of_the_readme_stand_there() {
    let page = page("README.md");
    let mut texts = blocks(&page).into_iter().filter(|block| block.language == "text");
    let commands = texts.find(|block| block.text.contains("cargo")).unwrap().text;
    assert_eq!(
        commands,
        "cargo run --release -- simulate examples/rigid_body.toml\ncargo test --workspace\n"
    );
    crate::support::run("simulate examples/rigid_body.toml").ok().prints(&["drift"]);
}

#[test]
fn the_commands_own_readme() {
    let folder = with_examples();
    assert!(run("cli/README.md", folder.path()) >= 5);
    for made in ["run.csv", "run.svg", "body.rs"] {
        assert!(folder.path().join(made).exists(), "{made}");
    }
}

/// README and the pages beside the manual: their scripts are commands of ours alone.
#[test]
fn readme_and_other_pages() {
    let mut paths = vec!["README.md".to_owned()];
    for entry in std::fs::read_dir(root().join("docs")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        paths.extend(name.ends_with(".md").then(|| format!("docs/{name}")));
    }
    for path in paths {
        let page = page(&path);
        for block in blocks(&page).iter().filter(|block| block.language == "sh") {
            let ours = block.text.lines().all(|line| line.starts_with("coadjoint "));
            assert!(ours, "{path}: only commands of coadjoint can be run here:\n{}", block.text);
        }
        run(&path, with_examples().path());
    }
}

/// A test for each chapter, with the least number of its commands.
macro_rules! chapters {
    ($($name:ident: $least:literal;)*) => {
        $(
            #[test]
            fn $name() {
                let path = format!("docs/book/src/{}.md", stringify!($name).replace('_', "-"));
                let count = run(&path, with_examples().path());
                assert!(count >= $least, "{count}");
            }
        )*

        /// Every chapter is run, and only chapters without commands are not listed above.
        #[test]
        fn no_command_is_forgotten() {
            let run = [$(stringify!($name).replace('_', "-")),*];
            for (name, page) in chapters() {
                let commands = |block: &Block<'_>| ["sh", "console"].contains(&block.language);
                let listed = run.iter().any(|listed| *listed == name);
                assert_eq!(blocks(&page).iter().any(commands), listed, "{name}");
            }
        }
    };
}

chapters! {
    start: 3;
    hamiltonian: 2;
    group: 2;
    groups: 21;
    chart_and_step: 2;
    gyrostat: 6;
    canonical: 4;
    simulate: 2;
    faster: 1;
    forces: 1;
    ensembles: 2;
    lattices: 1;
    spins: 2;
    cluster: 2;
    learning: 4;
    targets: 2;
    guarantee: 3;
}

/// Every block of the manual is run by something. What `text` blocks are is listed here: those that no test of this
/// file runs, with the reason or the test that does.
#[test]
fn every_block_is_run() {
    // Commands without an output to compare: flags of a build, and programs that run for minutes.
    let long = [
        "RUSTFLAGS=",
        // For a machine with a card; `device.rs` runs it on OpenCL's processor.
        "coadjoint ensemble examples/rigid_body.toml --initial states.npy --out final.npy --device cuda\n",
        "cargo install --locked --path cli\n",
        "cargo run --release -p coadjoint-tests --bin stress\n",
        "pip install ./python\n",
        "cargo run --release -p coadjoint-paper -- all --quick --html report.html ",
        // Needs a cluster, or is a message that a test of the package looks for.
        "sbatch examples/cluster/slurm.sh ",
        "ManifestError: ",
        "pip install './python[all]'\n",
    ];
    for (name, page) in chapters() {
        let all = blocks(&page);
        for (at, block) in all.iter().enumerate() {
            let run = match block.language {
                "sh" | "console" | "python" => true,
                // `tests/src/lib.rs`.
                language if language.starts_with("rust") => true,
                "toml" | "c" | "bash" => file_name(block).is_some() || name == "file-format",
                "text" => {
                    let printed_by_python = at > 0 && all[at - 1].language == "python";
                    printed_by_python
                        // Quoted messages, compared in `file_format.rs`.
                        || name == "file-format"
                        || long.iter().any(|start| block.text.starts_with(start))
                }
                _ => false,
            };
            assert!(run, "{name}: a block `{}` that nothing runs:\n{}", block.language, block.text);
        }
    }
}

/// The chapters by name, with their text.
fn chapters() -> Vec<(String, String)> {
    let mut chapters = Vec::new();
    for entry in std::fs::read_dir(root().join("docs/book/src")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if let Some(stem) = name.strip_suffix(".md") {
            chapters.push((stem.to_owned(), page(&format!("docs/book/src/{name}"))));
        }
    }
    chapters.sort();
    assert!(chapters.len() > 10);
    chapters
}
