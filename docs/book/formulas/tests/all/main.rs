//! The pages of the manual after the preprocessor: formulas, and links that leave the book.
#![allow(missing_docs, clippy::unwrap_used)]

use std::path::Path;

use coadjoint_book::{with_formulas, without_outside};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

#[test]
fn code_and_prose_stay() {
    for page in ["`$x$` and\n\n```text\n$ coadjoint groups\n$$\n```\n", "costs 5 $ and 6 $\n", ""] {
        assert_eq!(with_formulas(page).unwrap(), page);
    }
}

#[test]
fn a_formula_is_one_line_that_markdown_leaves_alone() {
    let page = with_formulas("| $\\mathrm{Ad}^*_g [a, b]^*$ | $$\\lvert x \\rvert$$ |").unwrap();
    assert_eq!(page.lines().count(), 1);
    assert_eq!(page.matches("<math").count(), 2);
    assert_eq!(page.matches("display=\"block\"").count(), 1);
    let mut text = page.as_str();
    while let Some((before, after)) = text.split_once('<') {
        assert!(!before.contains(['*', '_', '[']), "{before}");
        text = after.split_once('>').unwrap().1;
    }
}

#[test]
fn punctuation_stays_with_its_formula() {
    let page = with_formulas("With $a$, $b$ and $c$.").unwrap();
    assert!(page.contains("</math>,</span> <math") && page.ends_with("</math>.</span>"), "{page}");
}

#[test]
fn a_mistake_is_named_with_its_line() {
    let said = with_formulas("one\n\n$$ \\nothing $$\n").unwrap_err().to_string();
    assert!(said.starts_with("line 3: the formula ` \\nothing ` cannot be read"), "{said}");
}

/// No formula of the manual is left in LaTeX.
#[test]
fn every_formula_of_the_manual_is_read() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let mut count = 0;
    for entry in std::fs::read_dir(source).unwrap() {
        let path = entry.unwrap().path();
        let page = std::fs::read_to_string(&path).unwrap();
        let page = with_formulas(&page).map_err(|error| format!("{}: {error}", path.display()));
        let page = page.unwrap();
        count += page.matches("<math").count();
        assert_eq!(dollars(&page), 0, "{}: dollar signs that enclose no formula", path.display());
    }
    assert!(count > 20, "{count}");
}

/// Dollar signs outside of code.
fn dollars(page: &str) -> usize {
    let mut code = false;
    let mut count = 0;
    for event in Parser::new_ext(page, Options::ENABLE_TABLES) {
        match event {
            Event::Start(Tag::CodeBlock(_)) => code = true,
            Event::End(TagEnd::CodeBlock) => code = false,
            Event::Text(text) if !code => count += text.matches('$').count(),
            _ => {}
        }
    }
    count
}

fn converted(page: &str) -> String {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    without_outside(page, &source).unwrap()
}

#[test]
fn links_within_stay() {
    let page = "[a](group.md#casimirs), [b](https://rust-lang.org), `[c](../../d.md)`\n";
    assert_eq!(converted(page), page);
}

#[test]
fn links_outside_become_paths() {
    assert_eq!(
        converted(
            "see ([figures](../../measurements/peers.md#now)) and [`a.toml`](../../../examples/a.toml)"
        ),
        "see (figures, `docs/measurements/peers.md`) and `examples/a.toml`"
    );
}

#[test]
fn pictures_become_part_of_the_page() {
    let page = converted("![Drift](../../images/rigid_body.svg)\n");
    assert!(page.starts_with("![Drift](data:image/svg+xml;base64,PHN2Zy"), "{}", &page[..60]);
    assert!(page.ends_with(")\n") && !page.contains(".svg)"));
    let missing = without_outside("![a](../../images/none.svg)", Path::new("."));
    assert!(missing.is_err());
}
