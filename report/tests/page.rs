//! The page: complete, self-contained, legible, the same for the same outcomes.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::path::Path;
use std::sync::OnceLock;

use coadjoint_draw::run::{Picture, Run, Series};
use coadjoint_learn::experiment::{NAMES, Report, RunOptions, run};
use coadjoint_report::{FIGURES, Page, page, read_benchmarks, sections};

/// Experiments that train no network.
const CHEAP: [&str; 7] = [
    "simulation",
    "orders",
    "work",
    "hamiltonian",
    "geometrize",
    "hamilton-jacobi",
    "reduction-error",
];

fn outcome(name: &str) -> Report {
    let options = RunOptions { quick: true, seed: 0, out: None };
    run(name, &options, &mut |_| {}).unwrap().remove(0)
}

fn empty(name: &str) -> Report {
    Report {
        name: name.into(),
        quick: true,
        seed: 0,
        tables: Vec::new(),
        notes: Vec::new(),
        judgements: Vec::new(),
        curves: Vec::new(),
    }
}

/// A spinning body, and something on five coordinates.
fn gallery() -> Vec<Picture> {
    let times: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.05).collect();
    let series = |name: &str, of: &dyn Fn(f64) -> f64| Series {
        name: name.into(),
        unit: Some("kg m²/s".into()),
        values: times.iter().map(|&t| of(t)).collect(),
    };
    let picture = |name: &str, momentum: Vec<Series>, drift: f64| Picture {
        name: name.into(),
        settings: vec!["group <SO3>".into(), "K = 7".into()],
        time_unit: Some("s".into()),
        runs: vec![Run {
            label: "K = 7, exp".into(),
            times: times.clone(),
            momentum,
            drifts: vec![series("energy", &|t| 1e-9 * t), series("spatial momentum", &|_| drift)],
        }],
    };
    let sphere = vec![
        series("x", &|t| 2.0 * t.cos() * 0.6),
        series("y", &|t| 2.0 * t.sin() * 0.6),
        series("z", &|_| 2.0 * 0.8),
    ];
    let five = (0..5).map(|i| series(&format!("m{i}"), &|t| (t * f64::from(i)).sin())).collect();
    vec![picture("round", sphere, 1e-16), picture("flat", five, 1e-3)]
}

/// A page of everything: what is cheap is run, the rest is there without numbers.
fn whole() -> &'static Page {
    static WHOLE: OnceLock<Page> = OnceLock::new();
    WHOLE.get_or_init(|| {
        let one = |name: &&str| if CHEAP.contains(name) { outcome(name) } else { empty(name) };
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/benchmark");
        Page {
            reports: NAMES.iter().map(one).collect(),
            gallery: gallery(),
            benchmarks: read_benchmarks(&folder).unwrap(),
        }
    })
}

#[test]
fn every_figure_is_there_in_its_order() {
    let html = page(whole());
    let mut from = 0;
    for id in FIGURES {
        let at = html.find(&format!(" id=\"{id}\"")).unwrap_or_else(|| panic!("{id}"));
        assert!(at > from, "{id}");
        assert!(html.contains(&format!("href=\"#{id}\"")), "{id}");
        from = at;
    }
}

/// What is judged is judged well, by the numbers of the short version.
#[test]
fn what_is_cheap_holds() {
    for section in sections(whole()).iter().filter(|section| !section.panels.is_empty()) {
        for judgement in &section.judgements {
            assert!(judgement.holds(), "{judgement:?}");
        }
    }
    let own = |id: &str| sections(whole()).iter().find(|s| s.id == id).unwrap().judgements.len();
    for id in ["energy", "energy-7", "momentum", "difference", "geometrize", "hamilton-jacobi"] {
        assert!(own(id) >= 1, "{id}");
    }
    for id in ["reduction-error", "hamiltonian", "charts", "orders", "work"] {
        assert!(own(id) >= 1, "{id}");
    }
}

#[test]
fn the_page_needs_no_network() {
    let html = page(whole());
    for word in ["http:", "https:", "//", "url(", "@import", "<script", "<link", "src=", "<img"] {
        assert!(!html.contains(word), "{word}");
    }
}

#[test]
fn no_number_is_none() {
    let html = page(whole());
    for word in ["NaN", ">inf<", " inf", "-inf", "infinity"] {
        assert!(!html.contains(word), "{word}");
    }
}

#[test]
fn every_element_is_closed() {
    let html = page(whole());
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
    let different: std::collections::BTreeSet<&&str> = ids.iter().collect();
    assert_eq!(ids.len(), different.len());
}

#[test]
fn the_same_seed_makes_the_same_bytes() {
    let again: Vec<Report> = CHEAP.iter().map(|name| outcome(name)).collect();
    let first: Vec<Report> =
        whole().reports.iter().filter(|r| CHEAP.contains(&r.name.as_str())).cloned().collect();
    let made = |reports| page(&Page { reports, gallery: gallery(), benchmarks: Vec::new() });
    assert!(made(again) == made(first));
}

#[test]
fn a_verdict_that_fails_is_seen() {
    let html = page(whole());
    let exhibit = |name: &str| {
        let rest = html.split(&format!("id=\"gallery-{name}\"")).nth(1).unwrap();
        rest.split("</h3>").next().unwrap().to_owned()
    };
    assert!(exhibit("round").contains(">pass<"), "{}", exhibit("round"));
    assert!(exhibit("flat").contains(">FAIL<"), "{}", exhibit("flat"));
    assert!(html.contains("group &lt;SO3&gt;"));
}

/// No two texts of a panel overlap, and none leaves it; widths are those of a wide font.
#[test]
fn texts_of_panels_do_not_overlap() {
    let html = page(whole());
    let mut count = 0;
    for svg in html.split("<svg ").skip(1).map(|rest| rest.split("</svg>").next().unwrap()) {
        let of = |part: &str, name: &str| -> Option<String> {
            let value = part.split(&format!("{name}=\"")).nth(1)?;
            Some(value.split('"').next()?.to_owned())
        };
        let number = |part: &str, name: &str| of(part, name).map(|v| v.parse::<f64>().unwrap());
        let (width, height) = (number(svg, "width").unwrap(), number(svg, "height").unwrap());
        let boxes: Vec<(f64, f64, f64, f64, &str)> = svg
            .split("<text ")
            .skip(1)
            .map(|part| {
                let (head, rest) = part.split_once('>').unwrap();
                let text = rest.split("</text>").next().unwrap();
                let (x, y) = (number(head, "x").unwrap(), number(head, "y").unwrap());
                let size = number(head, "font-size").unwrap_or(13.0);
                let letters = text.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
                let wide = 0.6 * size * letters.chars().count() as f64;
                let left = match of(head, "text-anchor").unwrap().as_str() {
                    "start" => x,
                    "middle" => x - wide / 2.0,
                    _ => x - wide,
                };
                (left, left + wide, y - 0.75 * size, y + 0.2 * size, text)
            })
            .collect();
        for (i, a) in boxes.iter().enumerate() {
            assert!(a.0 >= -1.0 && a.1 <= width + 1.0 && a.3 <= height, "outside: {a:?}");
            for b in &boxes[i + 1..] {
                let apart = a.1 <= b.0 || b.1 <= a.0 || a.3 <= b.2 || b.3 <= a.2;
                assert!(apart, "{a:?} and {b:?}");
            }
        }
        count += 1;
    }
    assert!(count > 25, "{count}");
}

#[test]
fn a_folder_without_the_benchmarks_files_is_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let error = read_benchmarks(&folder).unwrap_err().to_string();
    assert!(error.contains("work --out"), "{error}");
    let missing = read_benchmarks(&folder.join("none")).unwrap_err().to_string();
    assert!(missing.contains("cannot read"), "{missing}");
}
