//! Polynomials as MathML, and other functions as they were written.
//!
//! Browsers do not break lines within a formula.

use coadjoint_codegen::number::Rational;
use coadjoint_codegen::poly::Polynomial;
use coadjoint_codegen::step::Origin;
use coadjoint_draw::escaped;
use num_traits::{One, Signed};

/// Longer polynomials are cut.
const MOST_TERMS: usize = 160;

/// A polynomial in the momentum, `name = …`: a formula for each term, so that lines break between them.
pub fn equation(name: &str, polynomial: &Polynomial, origin: &Origin) -> String {
    let coordinates = origin.facts().coordinates;
    let dim = coordinates.len();
    let mut out = math(&format!("{name}<mo>=</mo>"));
    let terms: Vec<(Vec<u32>, Rational)> = polynomial.terms().collect();
    for (number, (exponents, value)) in terms.iter().take(MOST_TERMS).enumerate() {
        let mut term = String::new();
        match (number, value.is_negative()) {
            (0, false) => {}
            // A sign, and not a difference.
            (0, true) => term.push_str("<mo form=\"prefix\">−</mo>"),
            (_, true) => term.push_str("<mo form=\"infix\">−</mo>"),
            (_, false) => term.push_str("<mo form=\"infix\">+</mo>"),
        }
        let (momenta, symbols) = exponents.split_at(dim.min(exponents.len()));
        let size = value.abs();
        if !size.is_one() || exponents.iter().all(|&power| power == 0) {
            term.push_str(&rational(&size));
        }
        for (symbol, &power) in origin.symbols().iter().zip(symbols) {
            let text = escaped(&symbol.text);
            push_power(
                &mut term,
                &format!("<mrow><mo>(</mo><mtext>{text}</mtext><mo>)</mo></mrow>"),
                power,
            );
        }
        for (coordinate, &power) in coordinates.iter().zip(momenta) {
            push_coordinate(&mut term, coordinate, power);
        }
        out.push_str(&math(&term));
    }
    if terms.is_empty() {
        out.push_str(&math("<mn>0</mn>"));
    }
    if terms.len() > MOST_TERMS {
        out.push_str(&format!("+ … {} more terms", terms.len() - MOST_TERMS));
    }
    format!("<p class=\"equation\">{out}</p>")
}

/// A function as its text, `name = …`.
pub fn written(name: &str, text: &str) -> String {
    let lead = math(&format!("{name}<mo>=</mo>"));
    format!("<p class=\"equation\">{lead}<code>{}</code></p>", escaped(text))
}

fn math(row: &str) -> String {
    format!("<math displaystyle=\"true\"><mrow>{row}</mrow></math> ")
}

/// S_k with its order.
pub fn order(k: usize) -> String {
    format!("<msub><mi>S</mi><mn>{k}</mn></msub>")
}

fn push_power(body: &mut String, base: &str, power: u32) {
    match power {
        0 => {}
        1 => body.push_str(base),
        _ => body.push_str(&format!("<msup>{base}<mn>{power}</mn></msup>")),
    }
}

fn rational(value: &Rational) -> String {
    if value.is_integer() {
        return format!("<mn>{}</mn>", value.numer());
    }
    format!("<mfrac><mn>{}</mn><mn>{}</mn></mfrac>", value.numer(), value.denom())
}

fn push_coordinate(body: &mut String, name: &str, power: u32) {
    let (head, index) = name_of(name);
    let (head, index) = (format!("<mi>{head}</mi>"), format!("<mtext>{index}</mtext>"));
    match (power, index.len() > "<mtext></mtext>".len()) {
        (1, true) => body.push_str(&format!("<msub>{head}{index}</msub>")),
        (2.., true) => body.push_str(&format!("<msubsup>{head}{index}<mn>{power}</mn></msubsup>")),
        _ => push_power(body, &head, power),
    }
}

/// `x1` as x and 1, `Pi_x` as Π and x, `mu[0]` as μ and 0: a letter and its index.
fn name_of(name: &str) -> (String, String) {
    let end = name.find(|c: char| !c.is_alphabetic()).unwrap_or(name.len());
    let (head, tail) = name.split_at(end);
    let greek = [
        ("Pi", "Π"),
        ("Gamma", "Γ"),
        ("Omega", "Ω"),
        ("mu", "μ"),
        ("pi", "π"),
        ("gamma", "γ"),
        ("omega", "ω"),
        ("alpha", "α"),
        ("beta", "β"),
        ("xi", "ξ"),
        ("nu", "ν"),
    ];
    let head = greek.iter().find(|(word, _)| *word == head).map_or(head, |(_, letter)| letter);
    let index: String = tail.chars().filter(|c| c.is_alphanumeric()).collect();
    (escaped(head), escaped(&index))
}
