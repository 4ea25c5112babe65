//! Mistakes are where the user made them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint_page::fields::Fields;
use coadjoint_page::file::Mistake;
use coadjoint_page::system::System;

fn body() -> Fields {
    Fields {
        name: "body".into(),
        group: "SO3".into(),
        coordinates: "x, y, z".into(),
        hamiltonian: "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)".into(),
        parameters: "I1 = 1.5, I2 = 2\nI3 = 5/2".into(),
        truncation: "7".into(),
        chart: "exp".into(),
        frame: "auto".into(),
        method: "auto".into(),
        step: "1/10".into(),
        momentum: "2 0.5 1".into(),
        ..Fields::default()
    }
}

fn mistakes(change: impl FnOnce(&mut Fields)) -> (Fields, Vec<Mistake>) {
    let mut fields = body();
    change(&mut fields);
    let mistakes = System::new(&fields).unwrap_err();
    (fields, mistakes)
}

#[test]
fn fields_as_people_write_them_are_read() {
    let system = System::new(&body()).unwrap();
    assert_eq!(system.h, 0.1);
    assert_eq!(system.energy().value(0.0, &[1.0, 1.0, 1.0]), 1.0 / 3.0 + 0.25 + 0.2);
}

fn field<'a>(fields: &'a mut Fields, name: &str) -> &'a mut String {
    match name {
        "hamiltonian" => &mut fields.hamiltonian,
        "parameters" => &mut fields.parameters,
        "group" => &mut fields.group,
        "coordinates" => &mut fields.coordinates,
        "momentum" => &mut fields.momentum,
        "truncation" => &mut fields.truncation,
        "chart" => &mut fields.chart,
        "method" => &mut fields.method,
        "step" => &mut fields.step,
        "algebra" => &mut fields.algebra,
        other => panic!("{other}"),
    }
}

/// Each line of `page/tests/mistakes.cases`: the field with the mistake, the text that is marked there, and what is changed of a body.
#[test]
fn every_mistake_is_at_its_place() {
    let cases = include_str!("../mistakes.cases").lines().filter(|line| !line.starts_with('#'));
    let mut seen = 0;
    for case in cases {
        let [name, place, changes] = case.split(" | ").collect::<Vec<_>>()[..] else {
            panic!("{case}")
        };
        let (mut fields, found) = mistakes(|fields| {
            for change in changes.split("; ") {
                let (name, text) = change.split_once(" = ").unwrap();
                *field(fields, name) = text.replace("\\n", "\n");
            }
        });
        let here = found.iter().find(|mistake| mistake.field == Some(name));
        let here = here.unwrap_or_else(|| panic!("{case}: {found:?}"));
        let marked = &field(&mut fields, name)[here.start..here.end];
        assert!(
            marked.contains(place) || place.contains(marked) && !marked.is_empty(),
            "{case}: {marked:?}: {here:?}"
        );
        assert!(marked.len() <= place.len() + 2, "{case}: {marked:?}");
        seen += 1;
    }
    assert!(seen >= 18, "{seen}");
}

#[test]
fn several_mistakes_are_told_at_once() {
    let (_, found) = mistakes(|fields| {
        fields.hamiltonian = "x^2 + w".into();
        fields.group = "SOX".into();
        fields.parameters = "I1 = 1\nnothing".into();
        fields.truncation = "2".into();
    });
    let fields: Vec<_> = found.iter().filter_map(|mistake| mistake.field).collect();
    for name in ["group", "hamiltonian", "parameters", "truncation"] {
        assert!(fields.contains(&name), "{name}: {found:?}");
    }
}

#[test]
fn what_a_page_cannot_do_is_refused_in_words() {
    let (_, found) = mistakes(|fields| {
        fields.truncation = "31".into();
        fields.group = "SU3".into();
        fields.coordinates = "a b c d e f g h".into();
        fields.hamiltonian = "(a + b + c)^2 + d^4 + e*f*g*h".into();
        fields.momentum = "1 1 1 1 1 1 1 1".into();
    });
    assert_eq!(found[0].field, Some("truncation"), "{found:?}");
}

#[test]
fn a_copied_momentum_for_each_copy_is_read() {
    let mut fields = body();
    fields.group = "SO3^2".into();
    fields.hamiltonian = "sum(i, 0..2, z[i]^2 - x[i]*x[(i + 1) % 2])".into();
    fields.coordinates = "x y z".into();
    fields.momentum = "cos(i) sin(i) 1/2".into();
    let system = System::new(&fields).unwrap();
    assert_eq!(system.momentum[4], 1.0_f64.sin());
}
