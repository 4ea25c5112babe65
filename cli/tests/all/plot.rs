//! `simulate --plot`: curves and names; the case `plot` shows what pictures say.

use std::collections::BTreeSet;

use crate::cases::legible::legible;
use crate::support::{Folder, root, text_of};
use coadjoint_codegen::system::{Options, read_either};

/// The picture of a run.
fn picture(arguments: &str) -> String {
    picture_in(&Folder::new(), &format!("examples/{arguments}"))
}

fn picture_in(folder: &Folder, arguments: &str) -> String {
    folder.run(&format!("simulate {arguments} --plot picture.svg")).ok();
    folder.text("picture.svg")
}

/// The panels of the momentum: what is drawn above the drifts.
fn motion(svg: &str) -> &str {
    svg.split("<title>relative drift").next().unwrap()
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
    legible(&svg, 21).unwrap();
    for example in ["heisenberg_spin_ring", "spin_chain_64"] {
        let svg = picture(&format!("{example}.toml --time 1"));
        assert_eq!(self::motion(&svg).matches("<polyline ").count(), 8, "{example}");
    }
    let svg = picture("rigid_body.toml --truncation 3,5,7 --time 10");
    let drifts = svg.split("<title>relative drift of").skip(1);
    let curves: Vec<usize> = drifts.map(|drift| drift.matches("<polyline ").count()).collect();
    assert_eq!(curves, [3, 3, 3]);
}

/// The momentum has the same axis of time as the drifts.
#[test]
fn the_momentum_covers_the_time_of_the_drifts() {
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
    let last = times(&whole);
    assert_eq!(last[0], last[1], "{last:?}");
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
        let unit = system.units.time.map(|unit| format!(" {unit}")).unwrap_or_default();
        for text in [
            name.to_owned(),
            format!("group {}", system.problem.facts().algebra.name()),
            format!("h = {}{unit}", system.run.step.unwrap()),
            format!("T = {}{unit}", system.run.time.unwrap()),
        ] {
            assert!(svg.contains(&format!(">{text}</text>")), "{stem}: {text}");
        }
        legible(&svg, 21).unwrap();
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
