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

#[test]
fn every_mistake_is_at_its_place() {
    let field = |fields: &Fields, name: Option<&str>| match name {
        Some("hamiltonian") => fields.hamiltonian.clone(),
        Some("parameters") => fields.parameters.clone(),
        Some("group") => fields.group.clone(),
        Some("coordinates") => fields.coordinates.clone(),
        Some("momentum") => fields.momentum.clone(),
        Some("truncation") => fields.truncation.clone(),
        Some("chart") => fields.chart.clone(),
        Some("step") => fields.step.clone(),
        Some("algebra") => fields.algebra.clone(),
        other => panic!("{other:?}"),
    };
    type Change = fn(&mut Fields);
    let cases: [(&str, &str, Change); 18] = [
        ("hamiltonian", "w", |f| f.hamiltonian = "x^2/2 + w^2".into()),
        ("hamiltonian", "w", |f| f.hamiltonian = "  x^2/2\n + w^2".into()),
        // Letters of several bytes before it.
        ("hamiltonian", "§", |f| f.hamiltonian = "x^2 + §*y".into()),
        ("hamiltonian", "\"", |f| f.hamiltonian = "x^2 + \"*y".into()),
        ("hamiltonian", "erf", |f| f.hamiltonian = "y^2 + erf(x)".into()),
        ("parameters", "1.5.2", |f| f.parameters = "I1 = 1.5.2, I2 = 2, I3 = 3".into()),
        ("parameters", "I2", |f| f.parameters = "I1 = 1\nI2\nI3 = 3".into()),
        ("parameters", "x", |f| f.parameters = "I1 = 1, I2 = 2, I3 = 3, x = 4".into()),
        ("group", "SO33", |f| f.group = "SO33".into()),
        ("coordinates", "x, y", |f| {
            f.coordinates = "x, y".into();
            f.hamiltonian = "x^2".into()
        }),
        ("momentum", "2 1", |f| f.momentum = "2 1".into()),
        ("momentum", "one", |f| f.momentum = "2 one 3".into()),
        ("truncation", "4", |f| f.truncation = "4".into()),
        ("step", "0", |f| f.step = "0".into()),
        ("chart", "cayley", |f| {
            (f.hamiltonian, f.chart) = ("y^2 + sin(x)".into(), "cayley".into())
        }),
        ("hamiltonian", "sin(x)", |f| {
            (f.hamiltonian, f.method) = ("y^2 + sin(x)".into(), "series".into())
        }),
        ("momentum", "2 0.5 1", |f| f.hamiltonian = "y^2 + ln(x - 2)".into()),
        ("algebra", "[A, B] = D", |f| {
            f.algebra = "generators = [\"A\", \"B\", \"C\"]\nbrackets = [\"[A, B] = D\"]".into()
        }),
    ];
    for (name, place, change) in cases {
        let (fields, found) = mistakes(change);
        let here = found.iter().find(|mistake| mistake.field == Some(name));
        let here = here.unwrap_or_else(|| panic!("{name} {place}: {found:?}"));
        let text = field(&fields, here.field);
        let marked = &text[here.start..here.end];
        assert!(
            marked.contains(place) || place.contains(marked) && !marked.is_empty(),
            "{name}: {marked:?} for {place:?}: {here:?}"
        );
        assert!(marked.len() <= place.len() + 2, "{name}: {marked:?} for {place:?}");
    }
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
