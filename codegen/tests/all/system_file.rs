//! System files without a Hamiltonian, and nested too deep; `cases/read.cases` has what is read of others.

use coadjoint_codegen::system;

use crate::given::said;

#[test]
fn a_group_is_read_without_a_hamiltonian() {
    let text = "[algebra]\ngenerators = [\"a\", \"b\"]\nbrackets = [\"[a, b] = s*b\"]\n[parameters]\ns = 2\n";
    assert_eq!(system::read_group(text).unwrap().structure().len(), 2);
    assert_eq!(system::read_group("group = \"SU2\"\nhamiltonian = 3\n").unwrap().name(), "SU2");
    let said =
        system::read_group("group = \"S03\"\n").unwrap_err().render("f.toml", "group = \"S03\"\n");
    assert!(said.starts_with("f.toml:1:9: error"), "{said}");
}

/// Recursion in the parser is bounded.
#[test]
fn nesting_is_refused_where_it_would_overflow() {
    let many = 20_000;
    let index = format!("mu[{}0{}]", "(".repeat(many), ")".repeat(many));
    let lists = format!("mu[{}0{}]", "P[".repeat(many), "]".repeat(many));
    let sums: String = (0..many).map(|i| format!("sum(i{i}, 0..1, ")).collect();
    for (energy, message) in [
        (index, "is not an integer known here"),
        (lists, "is not an integer known here"),
        (format!("{sums}mu[0]{}", ")".repeat(many)), "more than 64 sums are nested"),
    ] {
        let text = format!("group = \"SO3\"\nhamiltonian = \"{energy}\"\n[parameters]\nP = [0]");
        assert!(said(&text).contains(message), "{message}");
    }
}
