//! Links that leave the book, and those that do not.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use coadjoint_book::without_outside;

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
    assert!(page.starts_with("![Drift](data:image/svg+xml,%3C"), "{}", &page[..60]);
    assert!(page.ends_with("%3E%0A)\n") && !page.contains(".svg)"));
    let missing = without_outside("![a](../../images/none.svg)", Path::new("."));
    assert!(missing.is_err());
}
