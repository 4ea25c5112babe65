//! `simulate --plot`: what the picture says, and that it can be read.

use std::collections::BTreeSet;

use crate::support::{Folder, json, root, run, text_of};
use coadjoint_codegen::system::{Options, read_either};

/// The picture of a run.
fn picture(arguments: &str) -> String {
    picture_in(&Folder::new(), &format!("examples/{arguments}"))
}

fn picture_in(folder: &Folder, arguments: &str) -> String {
    folder.run(&format!("simulate {arguments} --plot picture.svg")).ok();
    folder.text("picture.svg")
}

/// No two texts overlap, and none leaves the picture. Widths are those of a wide font.
fn assert_legible(svg: &str) {
    let document = roxmltree::Document::parse(svg).unwrap();
    let number = |node: &roxmltree::Node<'_, '_>, name| -> Option<f64> {
        node.attribute(name).map(|value| value.parse().unwrap())
    };
    let root = document.root_element();
    let [width, height] = ["width", "height"].map(|name| number(&root, name).unwrap());
    let texts = document.descendants().filter(|node| node.tag_name().name() == "text");
    let boxes: Vec<(f64, f64, f64, f64, String)> = texts
        .map(|node| {
            let [x, y] = ["x", "y"].map(|name| number(&node, name).unwrap());
            let size = number(&node, "font-size").unwrap_or(13.0);
            let text = node.text().unwrap_or_default().to_owned();
            let wide = 0.6 * size * text.chars().count() as f64;
            let left = match node.attribute("text-anchor").unwrap() {
                "start" => x,
                "middle" => x - wide / 2.0,
                _ => x - wide,
            };
            (left, left + wide, y - 0.75 * size, y + 0.2 * size, text)
        })
        .collect();
    assert!(boxes.len() > 20, "{svg}");
    for (i, a) in boxes.iter().enumerate() {
        assert!(a.0 >= 0.0 && a.1 <= width && a.3 <= height, "outside: {a:?}");
        for b in &boxes[i + 1..] {
            let apart = a.1 <= b.0 || b.1 <= a.0 || a.3 <= b.2 || b.3 <= a.2;
            assert!(apart, "{a:?} and {b:?}");
        }
    }
}

/// The panels of the momentum: what is drawn above the drifts.
fn motion(svg: &str) -> &str {
    svg.split("<title>relative drift").next().unwrap()
}

fn contains(svg: &str, expected: &[&str]) {
    for text in expected {
        assert!(svg.contains(text), "{text}");
    }
}

#[test]
fn a_picture_says_what_was_run_in_which_units() {
    let svg = picture("rigid_body.toml --time 20");
    contains(
        &svg,
        &[
            ">rigid-body</text>",
            ">group SO3</text>",
            ">chart exp</text>",
            ">K = 7</text>",
            ">h = 0.1 s</text>",
            ">T = 20 s</text>",
            ">Body momentum (kg m²/s)</text>",
            ">time (s)</text>",
            ">relative drift of energy</text>",
            ">≤ 1e-17</text>",
            "drawn at 1e-17",
            "role=\"img\"",
            "<title id=\"title\">rigid-body",
            "<desc id=\"description\">rigid-body (group SO3, chart exp, K = 7",
        ],
    );
    assert!(!svg.contains(">-0") && !svg.contains(">−0<") && !svg.contains(">−0.0<"));
    assert_legible(&svg);
}

/// Every curve of a panel has a colour and a pattern of dashes of its own, and is named once.
#[test]
fn curves_are_told_apart_by_colour_and_by_dashes() {
    let svg = picture("su3_quadratic.toml --time 2");
    let motion = motion(&svg);
    let curves: Vec<&str> = motion.split("<polyline ").skip(1).collect();
    assert_eq!(curves.len(), 8);
    let of = |curve: &str, name: &str| {
        let value = curve.split("/>").next().unwrap().split(&format!("{name}=\"")).nth(1);
        value.map_or("", |rest| rest.split('"').next().unwrap()).to_owned()
    };
    for name in ["stroke", "stroke-dasharray"] {
        let different: BTreeSet<String> = curves.iter().map(|curve| of(curve, name)).collect();
        assert_eq!(different.len(), 8, "{name}");
    }
    for name in ["r12", "q12", "r13", "q13", "r23", "q23", "h1", "h2"] {
        assert_eq!(svg.matches(&format!(">{name}</text>")).count(), 1, "{name}");
    }
    assert_legible(&svg);
}

/// Of more than eight coordinates the eight that vary most have names, the others are a band.
#[test]
fn many_coordinates_are_summarised_and_the_picture_says_so() {
    for (example, all) in [("heisenberg_spin_ring", 12), ("spin_chain_64", 192)] {
        let svg = picture(&format!("{example}.toml --time 1"));
        let motion = motion(&svg);
        assert_eq!(motion.matches("<polyline ").count(), 8, "{example}");
        let more = format!(">{} more, from their least to their greatest</text>", all - 8);
        contains(&svg, &[&more, &format!("the 8 of {all} coordinates that vary most")]);
        assert_legible(&svg);
    }
}

/// With several runs each has a name in the legend of the drifts, and its settings.
#[test]
fn several_runs_are_compared() {
    let svg = picture("rigid_body.toml --truncation 3,5,7 --time 10");
    contains(
        &svg,
        &[
            ">K = 3, 5, 7</text>",
            ">K = 3, exp</text>",
            ">K = 7, exp</text>",
            ">Body momentum (kg m²/s), K = 3, exp</text>",
        ],
    );
    let drifts: Vec<&str> = svg.split("<title>relative drift of").skip(1).collect();
    for drift in &drifts {
        assert_eq!(drift.matches("<polyline ").count(), 3);
    }
    assert_eq!(drifts.len(), 3);
    assert_legible(&svg);
}

/// The momentum has the same axis of time as the drifts; where that would be a block of ink, the
/// picture says which part is shown.
#[test]
fn the_momentum_covers_the_time_of_the_drifts_or_says_why_not() {
    let times = |svg: &str| {
        let panels: Vec<String> = svg
            .split(">time (s)</text>")
            .map(|panel| {
                let at = panel.rfind("text-anchor=\"middle\"").unwrap_or(0);
                panel[at..].split('>').nth(1).unwrap_or("").split('<').next().unwrap().to_owned()
            })
            .collect();
        panels
    };
    let whole = picture("rigid_body.toml --time 40");
    assert!(!whole.contains("would run together"));
    let last = times(&whole);
    assert_eq!(last[0], last[1], "{last:?}");

    let part = picture("rigid_body.toml --time 1000 --step 0.5");
    contains(&part, &["s of 1000 s: over all of it the oscillations would run together."]);
    assert_legible(&part);
    // Records too far apart to show any oscillation.
    let coarse = picture("rigid_body.toml --time 1000 --step 0.5 --every 18");
    contains(&coarse, &["too far apart to follow every oscillation"]);
}

/// Coordinates with different units are not drawn on one axis.
#[test]
fn each_unit_has_a_panel() {
    let svg = picture("heavy_top.toml --time 10");
    contains(&svg, &[">Body momentum (kg m²/s)</text>", ">Body momentum (pure number)</text>"]);
    assert_legible(&svg);
    let kicked = picture("satellite.toml --time 10");
    contains(&kicked, &[">rkn6</text>", "spatial momentum, the one component that is conserved"]);
    assert_legible(&kicked);
}

/// A name may hold what has a meaning in SVG, and be long.
#[test]
fn no_name_breaks_the_picture() {
    let name = "a <b> & \\\"c\\\" ".repeat(12);
    let folder = Folder::with(&format!(
        "name = \"{name}\"\ngroup = \"SO3\"\ncoordinates = [\"{}\", \"y\", \"z\"]\nhamiltonian = \"y^2 + 2*z^2\"\n\
         [integrator]\nstep = 0.1\n[initial]\nmomentum = [0, 1e-9, 2e-9]\n[run]\ntime = 1\n",
        "long_name".repeat(12)
    ));
    let svg = picture_in(&folder, "system.toml");
    contains(&svg, &["a &lt;b&gt; &amp; &quot;c&quot;", "e-9</text>"]);
    assert_legible(&svg);
    // A file without units has none in its picture.
    contains(&svg, &[">time</text>", ">Body momentum</text>", ">h = 0.1</text>"]);
}

/// A report says in which units its numbers are; without units in the file it says nothing of them.
#[test]
fn reports_say_the_units() {
    let top = "simulate examples/heavy_top.toml --time 1";
    let out = run(top).ok().prints(&["20 steps to time 1 s\n"]).out;
    let line = |name: &str| out.lines().find(|line| line.trim().starts_with(name)).unwrap();
    assert!(
        line("Pi_y").ends_with(" kg m²/s") && line("Gamma_z").ends_with(" pure number"),
        "{out}"
    );
    let report = json(top);
    assert_eq!(report["units"]["time"], "s");
    assert_eq!(report["units"]["Pi_x"], "kg m²/s");
    let without = json("simulate examples/su3_quadratic.toml --time 1");
    assert!(without.get("units").is_none());
}

/// The pictures of the documentation are those of the examples as they are: name, settings and units.
#[test]
fn every_example_has_its_picture() {
    let mut seen = 0;
    for entry in std::fs::read_dir(root().join("examples")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|ending| ending != "toml") {
            continue;
        }
        let example = std::fs::read_to_string(&path).unwrap();
        let system = read_either(&example, Options::default(), &[]).unwrap();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let svg = text_of(&format!("docs/images/{stem}.svg"));
        let name = system.problem.facts().name;
        assert_ne!(name, "system", "{stem} has no name");
        contains(&svg, &[&format!(">{name}</text>")]);
        let unit = system.units.time.map(|unit| format!(" {unit}")).unwrap_or_default();
        contains(
            &svg,
            &[
                &format!(">group {}</text>", system.problem.facts().algebra.name()),
                &format!(">h = {}{unit}</text>", system.run.step.unwrap()),
                &format!(">T = {}{unit}</text>", system.run.time.unwrap()),
            ],
        );
        assert_legible(&svg);
        seen += 1;
    }
    assert!(seen >= 21, "{seen}");
}

/// Names and units of any kind are texts in pictures and in heads of tables, and end neither.
#[test]
fn hostile_names_stay_texts() {
    let folder = Folder::new();
    let names = [
        "</title><script>alert('1')</script>",
        "]]> --> <!-- & &amp; \" '",
        "line\nbreak\r# complete: 9 records\u{2028}",
        "=cmd|' /C calc'!A0",
        "\u{202e}reversed\u{2066} \u{0} \u{1b}[2J",
        &"long ".repeat(2000),
    ];
    for name in names {
        let quoted = serde_json::Value::from(name);
        let unit: String = name.chars().filter(|c| !c.is_control()).take(40).collect();
        let unit = serde_json::Value::from(unit.trim());
        let text = format!(
            "name = {quoted}\nhamiltonian = \"a^2/2 + b^2/4 + c^2/6\"\n[algebra]\nname = {quoted}\n\
             generators = [\"a\", \"b\", \"c\"]\nbrackets = [\"[a, b] = c\", \"[b, c] = a\", \"[c, a] = b\"]\n\
             [units]\ntime = {unit}\nmomentum = {unit}\n[integrator]\ntruncation = 3\nstep = 0.1\n\
             [initial]\nmomentum = [1, 0.2, 0.1]\n[run]\ntime = 1"
        );
        let system = "a\n# complete: 9 records\r\u{202e}.toml";
        folder.write(system, text);
        let svg = picture_in(&folder, &format!("'{system}' --out run.csv --backend interpreter"));
        let document = roxmltree::Document::parse(&svg).unwrap();
        let known =
            ["svg", "title", "desc", "rect", "g", "text", "line", "polyline", "polygon", "path"];
        for node in document.descendants().filter(roxmltree::Node::is_element) {
            assert!(known.contains(&node.tag_name().name()), "{}", node.tag_name().name());
        }
        assert!(!svg.contains(['\u{202e}', '\u{2066}', '\0', '\u{1b}']));
        let table = folder.table("run.csv");
        assert_eq!(table[0][..4], ["time", "a", "b", "c"]);
        assert!(table.len() == 12 && table.iter().all(|row| row.len() == table[0].len()));
        assert_eq!(
            folder.text("run.csv").lines().filter(|line| line.starts_with("# complete")).count(),
            1
        );
    }
}
