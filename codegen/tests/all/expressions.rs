//! One evaluator: every number of a system file knows parameters, `pi`, roots and functions.

use coadjoint_codegen::number::{Rational, ratio};
use coadjoint_codegen::system::System;

use crate::given::{kept, read, said};

fn terms(system: &System) -> Vec<Rational> {
    system.problem.hamiltonian.terms().map(|(_, value)| value).collect()
}

#[test]
fn the_same_expressions_stand_everywhere() {
    let text = r#"
        hamiltonian = "m*a^2 + 8^(1/3)*b^2 + c*inv(J)[0][1]"
        [algebra]
        generators = ["a", "b", "c"]
        brackets = ["[a, b] = 1/m*c", "[b, c] = sqrt(4)/m*a", "[c, a] = list[1]*b"]
        [parameters]
        K = "inv(J)"
        list = ["m/3", "-m^3", "sqrt(2)"]
        J = [[1, "m"], [0, "1/m"]]
        m = 2
        [integrator]
        step = "m*pi/100"
        [initial]
        momentum = ["m*cos(0)", "list[2]", "K[0][1]"]
        group_element = [["1/m + 1/2", 0, 0], [0, 1, 0], [0, 0, 1]]
        [run]
        time = "10*m"
    "#;
    let system = read(text);
    assert_eq!(terms(&system), [ratio(2, 1), ratio(2, 1), ratio(-4, 1)]);
    let structure = system.problem.algebra.structure();
    let values: Vec<_> = structure.iter().filter(|s| s.i < s.j).map(|s| s.value.clone()).collect();
    assert_eq!(values, [ratio(1, 2), ratio(8, 1), ratio(1, 1)]);
    let run = &system.run;
    assert_eq!(run.step, Some(std::f64::consts::PI / 50.0));
    assert_eq!(run.momentum.as_deref(), Some(&[2.0, 2_f64.sqrt(), -4.0][..]));
    assert_eq!(run.group_element.as_ref().map(|rows| rows[0][0]), Some(1.0));
    assert_eq!(run.time, Some(20.0));
    // A parameter that the brackets use is a number, whatever is kept.
    let problem = kept(text).problem;
    let names: Vec<&str> = problem.parameters.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["K"]);
}

/// Parameters that stand where only numbers can are numbers, whatever is kept.
#[test]
fn inverses_and_indices_are_numbers() {
    let text = r#"
        group = "SO3"
        coordinates = ["x", "y", "z"]
        hamiltonian = "k*sum(i, 0..3, sum(j, 0..3, mu[P[i]]*inv(J)[i][j]*mu[P[j]]))"
        [parameters]
        J = [[4, 1, -1], [1, 5, 2], [-1, 2, 6]]
        P = [0, 1, 2]
        k = "89/2"
    "#;
    let expected = [(26, 2), (-8, 1), (7, 1), (23, 2), (-9, 1), (19, 2)].map(|(n, d)| ratio(n, d));
    assert_eq!(terms(&read(text)), expected);
    let problem = kept(text).problem;
    assert_eq!(problem.parameters.len(), 1);
}

#[test]
fn roots_are_exact_where_they_are_rational() {
    let h = |text: &str| {
        let file =
            format!("group = \"SO3\"\nhamiltonian = \"mu[0]*({text})\"\n[parameters]\nm = 3");
        let problem = read(&file).problem;
        let symbols = problem.symbols.iter().map(|symbol| symbol.expr.evaluate(&[]));
        let point: Vec<f64> = [1.0, 0.0, 0.0].into_iter().chain(symbols).collect();
        problem.hamiltonian.evaluate(&point)
    };
    assert_eq!(h("27^(1/3)"), 3.0);
    assert_eq!(h("(4/9)^(3/2)"), 8.0 / 27.0);
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-15, "{a} {b}");
    near(h("2^(1/3)"), 2_f64.cbrt());
    near(h("m^0.3"), 3_f64.powf(0.3));
    near(h("2^sqrt(m)"), 2_f64.powf(3_f64.sqrt()));
    near(h("sin(pi/5)*pi^3"), (std::f64::consts::PI / 5.0).sin() * std::f64::consts::PI.powi(3));
}

/// A velocity, a quaternion as reports print it, and a matrix of six digits stand for what they stand for elsewhere.
#[test]
fn the_state_at_the_start_is_given_as_people_have_it() {
    let body = |group: &str, initial: &str| {
        read(&format!(
            "group = \"{group}\"\nhamiltonian = \"(mu[0] - h)^2/(2*I) + mu[1]^2/4 + mu[2]^2/6 + mu[1]*mu[2]\"\n\
             [parameters]\nI = 2\nh = 1\n[initial]\n{initial}"
        ))
        .run
    };
    let run = body("SO3", "angular_velocity = [0.5, \"I/2\", 0]");
    let momentum = run.momentum.unwrap();
    for (found, right) in momentum.iter().zip([2.0, -0.4, 1.2]) {
        assert!((found - right).abs() < 1e-15, "{momentum:?}");
    }
    let element = |group: &str, initial: &str| body(group, initial).group_element.unwrap();
    let half = "[0.5, 0.5, 0.5, 0.5]";
    let cyclic = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(element("SO3", &format!("quaternion = {half}")), cyclic);
    let twice = element("SO3^2", "project = true\nquaternion = [[1, 0, 0, 0], [2, 2, 2, 2]]");
    assert_eq!((twice[0][0], twice[3][5], twice[0][3]), (1.0, 1.0, 0.0));
    let moved = element("SE3", &format!("quaternion = {half}\ntranslation = [1, 2, \"pi\"]"));
    assert_eq!(moved[2], [0.0, 1.0, 0.0, std::f64::consts::PI]);
    assert_eq!(moved[3], [0.0, 0.0, 0.0, 1.0]);
    // As SU2 writes w − i(xσ₁ + yσ₂ + zσ₃).
    let spin = element("SU2", "quaternion = [0.5, 0.1, \"sqrt(0.49)\", 0.5]");
    assert_eq!((spin[0][0], -spin[2][1], -spin[0][1], -spin[2][0]), (0.5, 0.1, 0.7, 0.5));
    assert_eq!((spin[1][0], spin[0][2], spin[3][3]), (0.7, 0.5, 0.5));

    let short = "[[0.36, 0.48, -0.8], [-0.8, 0.600001, 0], [0.480001, 0.64, 0.6]]";
    let rotation = element("SO3", &format!("group_element = {short}\nproject = true"));
    for i in 0..3 {
        for j in 0..3 {
            let product: f64 = (0..3).map(|k| rotation[i][k] * rotation[j][k]).sum();
            assert!((product - f64::from(i == j)).abs() < 4e-16, "{rotation:?}");
        }
    }
    assert!((rotation[1][1] - 0.6).abs() < 2e-6);
    let motion = "[[0.6, -0.8, 0, 3], [0.8, 0.600001, 0, 4], [0, 0, 1, 5], [0, 0, 0, 1]]";
    let motion = element("SE3", &format!("group_element = {motion}\nproject = true"));
    assert_eq!((motion[0][3], motion[2][3], motion[3][3]), (3.0, 5.0, 1.0));
    assert!((motion[0][0].powi(2) + motion[1][0].powi(2) - 1.0).abs() < 4e-16);
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
