//! System files: what is read, and what is said about mistakes.

use coadjoint_codegen::lie::Chart;
use coadjoint_codegen::number::ratio;
use coadjoint_codegen::problem::Shape;
use coadjoint_codegen::system::{self, Options, Parameters};

use crate::given::{kept, read};

const RIGID_BODY: &str = r#"
name = "rigid-body"
group = "SO3"
coordinates = ["x", "y", "z"]
hamiltonian = "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)"
[parameters]
I1 = 1.5
I2 = 2
I3 = "5/2"
[integrator]
truncation = 5
chart = "cayley"
step = 0.1
[initial]
momentum = [2.0, 0.5, "1"]
group_element = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
[run]
time = 100.0
every = 2
"#;

#[test]
fn all_of_a_file_is_read() {
    let system = read(RIGID_BODY);
    let problem = &system.problem;
    assert_eq!(problem.name, "rigid-body");
    assert_eq!(problem.coordinates, ["x", "y", "z"]);
    for text in ["\"x y z\"", "\" x, y,z\""] {
        let other = read(&RIGID_BODY.replace("[\"x\", \"y\", \"z\"]", text));
        assert_eq!(other.problem.coordinates, problem.coordinates);
    }
    let terms: Vec<_> = problem.hamiltonian.terms().map(|(_, c)| c).collect();
    assert_eq!(terms, [ratio(1, 3), ratio(1, 4), ratio(1, 5)]);
    assert_eq!((problem.truncation, problem.chart), (5, Chart::Cayley));
    assert!(problem.symbols.is_empty() && problem.parameters.is_empty());
    let run = &system.run;
    assert_eq!((run.step, run.time, run.every), (Some(0.1), Some(100.0), Some(2)));
    assert_eq!(run.momentum.as_deref(), Some(&[2.0, 0.5, 1.0][..]));
    assert_eq!(run.group_element.as_ref().unwrap()[1], [0.0, 1.0, 0.0]);
}

/// Units are kept for each coordinate; one for the momentum is that of all that have none of their own.
#[test]
fn units_are_read_and_change_nothing() {
    let with = format!("{RIGID_BODY}\n[units]\ntime = \" s \"\nmomentum = \"kg m²/s\"\ny = \"1\"");
    let system = read(&with);
    assert_eq!(system.units.time.as_deref(), Some("s"));
    let of = |units: &system::Units| {
        (0..4).map(|i| units.coordinate(i).map(str::to_owned)).collect::<Vec<_>>()
    };
    let unit = |text: &str| Some(text.to_owned());
    assert_eq!(of(&system.units), [unit("kg m²/s"), unit("1"), unit("kg m²/s"), None]);
    let without = read(RIGID_BODY);
    assert_eq!(of(&without.units), [None, None, None, None]);
    assert_eq!(without.problem.hamiltonian, system.problem.hamiltonian);
    assert_eq!(without.run, system.run);

    // Copies share the unit of their coordinate; indexed names need no quotes.
    let copies = "group = \"SO3^2\"\ncoordinates = [\"x\", \"y\", \"z\"]\nhamiltonian = \"x[0]*x[1]\"\n\
        [units]\ny = \"J s\"";
    let units = read(copies).units;
    assert_eq!((units.coordinate(1), units.coordinate(4)), (Some("J s"), Some("J s")));
    assert_eq!((units.coordinate(0), &units.time), (None, &None));
}

#[test]
fn options_replace_what_the_file_says() {
    let options = Options {
        parameters: Parameters::Kept,
        truncation: Some(9),
        chart: Some(Chart::Exponential),
        solver: None,
        frame: None,
        method: None,
    };
    let problem = system::read(RIGID_BODY, options).unwrap().problem;
    assert_eq!((problem.truncation, problem.chart), (9, Chart::Exponential));
    let names: Vec<&str> = problem.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["I1", "I2", "I3"]);
    assert_eq!(problem.parameters[2].default, Some(vec![ratio(5, 2)]));
    let texts: Vec<&str> = problem.symbols.iter().map(|s| s.text.as_str()).collect();
    assert_eq!(texts, ["1/I1", "1/I2", "1/I3"]);
}

#[test]
fn decimals_are_exact_and_arrays_are_indexed() {
    let text = r#"
        group = "SO3"
        hamiltonian = "a[0]*mu[0]^2 + a[1]*mu[1]^2 + b[1][0]*mu[2]"
        [parameters]
        a = [0.1, 1e-3]
        b = [[1, 2], [3.5, 4]]
    "#;
    let problem = read(text).problem;
    let terms: Vec<_> = problem.hamiltonian.terms().map(|(_, c)| c).collect();
    assert_eq!(terms, [ratio(1, 10), ratio(1, 1000), ratio(7, 2)]);
    let problem = kept(text).problem;
    assert_eq!(problem.parameters[1].shape, Shape::Grid(2, 2));
    assert_eq!(problem.symbols[2].text, "b[1][0]");
}

/// so(3) once by the matrices of its basis, once by its brackets: the same constants.
#[test]
fn algebras_are_given_by_basis_or_brackets() {
    let by_basis = r#"
        hamiltonian = "mu[0]^2 + mu[1]"
        [algebra]
        basis = [
            [["0", "0", "0"], ["0", "0", "-1"], ["0", "1", "0"]],
            [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
            [[0, -1.0, 0], [1.0, 0, 0], [0, 0, 0]],
        ]
    "#;
    let by_brackets = r#"
        hamiltonian = "a^2 + b"
        [algebra]
        generators = ["a", "b", "c"]
        brackets = ["[a,b] = c", "[b, c] = 2*a - a", "[a , c]= -4/4*b"]
    "#;
    let basis = read(by_basis).problem.algebra;
    let brackets = read(by_brackets).problem;
    assert_eq!(basis.structure(), brackets.algebra.structure());
    assert_eq!(basis.basis().unwrap().len(), 3);
    assert_eq!(brackets.coordinates, ["a", "b", "c"]);
}

#[test]
fn a_group_is_read_without_a_hamiltonian() {
    let text = "[algebra]\ngenerators = [\"a\", \"b\"]\nbrackets = [\"[a, b] = s*b\"]\n[parameters]\ns = 2\n";
    assert_eq!(system::read_group(text).unwrap().structure().len(), 2);
    assert_eq!(system::read_group("group = \"SU2\"\nhamiltonian = 3\n").unwrap().name(), "SU2");
    let said =
        system::read_group("group = \"S03\"\n").unwrap_err().render("f.toml", "group = \"S03\"\n");
    assert!(said.starts_with("f.toml:1:9: error"), "{said}");
}
