//! docs/book/src/file-format.md: every example on the page is a file that works, and no key is forgotten.

use crate::support::{Folder, run, text_of};
use coadjoint_codegen::expr::Function;
use coadjoint_codegen::hamilton_jacobi::{TermLimit, derive};
use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::problem::{FrameChoice, Method, Solver};
use coadjoint_codegen::system::{Options, Splitting, read, read_either, read_lattice};

fn page() -> String {
    text_of("docs/book/src/file-format.md")
}

/// The fenced blocks of a language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    page.split(&fence).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned()).collect()
}

/// Each example is read and derived as it stands, and run if it has a duration.
#[test]
fn every_example_of_the_page_works() {
    let examples = blocks(&page(), "toml");
    assert!(examples.len() >= 11, "{}", examples.len());
    let mut runs = 0;
    for text in &examples {
        if text.contains("[lattice]") {
            let ran = Folder::with(text).run("simulate system.toml");
            ran.ok().prints(&["estimated relative error"]);
            continue;
        }
        let system = read_either(text, Options::default(), &[])
            .unwrap_or_else(|mistakes| panic!("{text}\n{}", mistakes.render("page", text)));
        if let Some(problem) = system.problem.polynomial() {
            // Higher orders are no more to the point, and slower.
            let series = derive(
                &problem.algebra,
                problem.chart,
                problem.generated(),
                problem.truncation.min(3),
                TermLimit::default(),
            );
            assert!(!series.unwrap().order(1).is_zero(), "{text}");
        }
        if system.run.time.is_some() {
            let ran = Folder::with(text).run("simulate system.toml");
            ran.ok().prints(&["largest relative drift"]);
            runs += 1;
        }
    }
    assert!(runs >= 5, "{runs}");
}

/// The messages that the page quotes are those that are printed.
#[test]
fn the_mistakes_of_the_page_are_reported_in_its_words() {
    let wrong = [
        "name = \"a\"\ngroup = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonain = \"x\"\n",
        "group = \"SO3\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x^2 + sin(y)\"\n",
    ];
    let quoted = blocks(&page(), "text");
    assert_eq!(quoted.len(), wrong.len());
    for (text, quoted) in wrong.iter().zip(quoted) {
        let said = read(text, Options::default()).unwrap_err().render("system.toml", text);
        assert!(said.contains(quoted.trim()), "{said}");
    }
}

/// The known keys are taken from the message about an unknown one.
#[test]
fn every_key_and_every_name_is_on_the_page() {
    let page = page();
    let start = "group = \"SO3\"\nhamiltonian = \"mu[0]\"\n";
    let own = "hamiltonian = \"mu[0]\"\n[algebra]\nbasis = [[[1]]]\n";
    let cases = [
        format!("unknown_ = 1\n{start}"),
        format!("{start}[integrator]\nunknown_ = 1\n"),
        format!("{start}[initial]\nunknown_ = 1\n"),
        format!("{start}[run]\nunknown_ = 1\n"),
        format!("{start}[units]\nunknown_ = \"s\"\n"),
        format!("{own}unknown_ = 1\n"),
    ];
    let lattice = "group = \"SO3\"\n[lattice]\nshape = [4]\nsite = \"z\"\n";
    let of_lattice = [
        format!("unknown_ = 1\n{lattice}"),
        format!("{lattice}unknown_ = 1\n"),
        format!("{lattice}[[lattice.bond]]\noffset = [1]\nenergy = \"dot(a, b)\"\nunknown_ = 1\n"),
        format!("{lattice}[initial]\nunknown_ = 1\n"),
        format!("{lattice}[integrator]\nunknown_ = 1\n"),
    ];
    let mut seen = 0;
    let ordinary = cases.map(|text| (read(&text, Options::default()).unwrap_err(), text));
    let of_lattice = of_lattice.map(|text| (read_lattice(&text).unwrap_err(), text));
    for (mistakes, text) in ordinary.into_iter().chain(of_lattice) {
        let said = mistakes.render("system.toml", &text);
        let known = said.split("known keys: ").nth(1).unwrap_or_else(|| panic!("{said}"));
        for key in known.lines().next().unwrap().split(", ").filter(|key| *key != "mu") {
            assert!(page.contains(&format!("`{key}`")), "{key}");
            seen += 1;
        }
    }
    assert!(seen >= 28, "{seen}");
    let quoted = |name: &str| page.contains(&format!("`\"{name}\"`"));
    for name in Splitting::ALL.map(Splitting::name) {
        assert!(quoted(name), "{name}");
    }
    for name in Solver::NAMES.into_iter().chain(FrameChoice::NAMES).chain(Method::NAMES) {
        assert!(quoted(name), "{name}");
    }
    assert!(quoted(Chart::Exponential.name()) && quoted(Chart::Cayley.name()));
    for function in Function::ALL {
        assert!(page.contains(&format!("`{}`", function.name())), "{function:?}");
    }
}

#[test]
fn the_help_leads_to_the_page() {
    run("simulate --help").ok().prints(&["docs/book/src/file-format.md", "coadjoint groups"]);
}
