//! The compiler's messages about mistakes under the attributes: `ui` has a program and the expected messages for each.
//! `TRYBUILD=overwrite` rewrites them.

#[test]
fn mistakes_are_reported_in_the_users_words() {
    let cases = trybuild::TestCases::new();
    cases.compile_fail("tests/ui/*.rs");
}
