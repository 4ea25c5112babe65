//! The page: complete, self-contained, legible, the same for the same outcomes; and the numbers of what is cheap.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::collections::BTreeSet;
use std::sync::OnceLock;

use coadjoint_draw::run::{Channel, Picture, Recording};
use coadjoint_paper::experiment::{EXPERIMENTS, run};
use coadjoint_paper::outcome::{Config, Report};
use coadjoint_paper::page::{page, sections};
use coadjoint_paper::text::figures;

use crate::legible::legible;

const CHEAP: [&str; 8] = [
    "simulation",
    "orders",
    "work",
    "table-2",
    "hamiltonian",
    "geometrize",
    "hamilton-jacobi",
    "reduction-error",
];

fn outcome(name: &str) -> Report {
    run(name, &Config { quick: true, ..Config::default() }).unwrap().remove(0)
}

/// A spinning body, and something on five coordinates whose momentum drifts.
fn gallery() -> Vec<Picture> {
    let times: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.05).collect();
    let series = |name: &str, of: &dyn Fn(f64) -> f64| Channel {
        name: name.into(),
        unit: Some("kg m²/s".into()),
        values: times.iter().map(|&t| of(t)).collect(),
    };
    let picture = |name: &str, momentum: Vec<Channel>, drift: f64| {
        let drifts = vec![series("energy", &|t| 1e-9 * t), series("spatial momentum", &|_| drift)];
        let run = Recording { label: "K = 7, exp".into(), times: times.clone(), momentum, drifts };
        let settings = vec!["group <SO3>".into(), "K = 7".into()];
        Picture { name: name.into(), settings, time_unit: Some("s".into()), runs: vec![run] }
    };
    let sphere = vec![
        series("x", &|t| 2.0 * t.cos() * 0.6),
        series("y", &|t| 2.0 * t.sin() * 0.6),
        series("z", &|_| 2.0 * 0.8),
    ];
    let five = (0..5).map(|i| series(&format!("m{i}"), &|t| (t * f64::from(i)).sin())).collect();
    vec![picture("round", sphere, 1e-16), picture("flat", five, 1e-3)]
}

/// Everything: what is cheap is run, the rest is there without numbers.
fn whole() -> &'static [Report] {
    static WHOLE: OnceLock<Vec<Report>> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let empty = |name: &str| Report { name: name.into(), ..Report::default() };
        let one = |name| if CHEAP.contains(&name) { outcome(name) } else { empty(name) };
        EXPERIMENTS.iter().map(|(name, _)| one(*name)).collect()
    })
}

/// Tables, notes and judgements have what they must have; sharper than what judges.
#[test]
fn cheap_experiments_hold_their_numbers() {
    for section in sections(whole()).iter().filter(|s| CHEAP.contains(&&*s.figure.experiment)) {
        for judgement in &section.judgements {
            assert!(judgement.holds(), "{judgement:?}");
        }
        assert_eq!(section.judgements.len(), section.figure.judged.len(), "{}", section.figure.id);
        assert!(section.figure.judged.iter().all(|j| j.at_most.or(j.at_least).is_some()));
        let mut texts = section.settings.iter().chain([&section.out]);
        assert!(texts.all(|text| !text.contains(['{', '–'])), "{}", section.out);
    }
    let number = |name: &str, row: &str, column: usize| {
        whole().iter().find(|report| report.name == name).unwrap().tables[0].number(row, column)
    };
    for (name, row, column, most) in [
        ("simulation", "Cayley K=3", 2, 1e-13),
        ("simulation", "Cayley K=5", 2, 1e-13),
        ("simulation", "Cayley K=7", 2, 1e-13),
        ("simulation", "exp K=3", 2, 1e-13),
        ("simulation", "exp K=5", 2, 1e-13),
        ("simulation", "exp K=7", 2, 1e-13),
        ("simulation", "exp K=7", 3, 1e-2 * number("simulation", "exp K=5", 3)),
        ("table-2", "p eliminated, degree 4", 1, 1e-11),
        ("table-2", "p eliminated, degree 6", 1, 1e-15),
        ("geometrize", "geometrized_4", 2, 1e-12),
        ("geometrize", "geometrized_4", 3, 2e-3),
    ] {
        assert!(number(name, row, column) <= most, "{name}, {row}: {}", number(name, row, column));
    }
    assert!(number("simulation", "RK45 default", 2) > 1e-3);
    assert!(number("table-2", "identity", 1) > 1e-3);
    assert!(number("geometrize", "euler", 3) > 0.2);
    let long = &whole()[0].curves[0];
    assert_eq!((long.rows.len(), long.columns.len()), (501, long.rows[0].len()));
}

#[test]
fn the_page_is_complete_well_formed_and_needs_no_network() {
    let html = page(whole(), &gallery());
    let mut from = 0;
    for id in figures().iter().map(|figure| figure.id.as_str()).chain(["gallery"]) {
        let at = html.find(&format!(" id=\"{id}\"")).unwrap_or_else(|| panic!("{id}"));
        assert!(at > from && html.contains(&format!("href=\"#{id}\"")), "{id}");
        from = at;
    }
    for word in ["http:", "https:", "//", "url(", "@import", "<script", "<link", "src=", "<img"] {
        assert!(!html.contains(word), "{word}");
    }
    for word in ["NaN", ">inf<", " inf", "-inf", "infinity"] {
        assert!(!html.contains(word), "{word}");
    }
    let mut open: Vec<&str> = Vec::new();
    for part in html.split('<').skip(1) {
        let tag = part.split('>').next().unwrap();
        let name = tag.split([' ', '\n']).next().unwrap();
        if let Some(name) = name.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name), "{tag}");
        } else if !tag.ends_with('/') && !name.starts_with('!') && name != "meta" {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    let ids: Vec<&str> =
        html.split(" id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(ids.len(), ids.iter().collect::<BTreeSet<_>>().len());
    // A verdict that fails is seen.
    for (name, mark) in [("round", ">pass<"), ("flat", ">FAIL<")] {
        let rest = html.split(&format!("id=\"gallery-{name}\"")).nth(1).unwrap();
        assert!(rest.split("</h3>").next().unwrap().contains(mark), "{name}");
    }
    assert!(html.contains("group &lt;SO3&gt;"));
    // One seed makes the same bytes each time.
    let again: Vec<Report> = CHEAP.iter().map(|name| outcome(name)).collect();
    let cheap = whole().iter().filter(|report| CHEAP.contains(&&*report.name));
    assert!(page(&again, &[]) == page(&cheap.cloned().collect::<Vec<_>>(), &[]));
}

#[test]
fn texts_of_panels_do_not_overlap() {
    let html = page(whole(), &gallery());
    let panels = html.split("<svg ").skip(1).map(|rest| rest.split_once("</svg>").unwrap().0);
    let panels: Vec<String> = panels.map(|panel| format!("<svg {panel}</svg>")).collect();
    panels.iter().for_each(|panel| legible(panel, 1).unwrap());
    assert!(panels.len() > 25, "{}", panels.len());
}
