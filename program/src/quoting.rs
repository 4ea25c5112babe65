//! Texts of users inside other languages: one function a language. XML has its own in `coadjoint-draw`.

use alloc::string::String;

/// Letters that comments are likely to have, in ASCII.
const LETTERS: [(char, &str); 34] = [
    ('²', "^2"),
    ('³', "^3"),
    ('⁻', "^-"),
    ('¹', "1"),
    ('·', "*"),
    ('×', "x"),
    ('°', "deg"),
    ('½', "1/2"),
    ('−', "-"),
    ('–', "-"),
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "epsilon"),
    ('η', "eta"),
    ('θ', "theta"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('µ', "micro"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('φ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('Γ', "Gamma"),
    ('Π', "Pi"),
    ('Ω', "Omega"),
];

/// Text on one line of ASCII, for a comment of C, C++, OpenCL or CUDA.
pub fn c_comment(text: &str) -> String {
    let mut result = String::new();
    for letter in line(text).chars() {
        match LETTERS.iter().find(|(known, _)| *known == letter) {
            Some((_, ascii)) => result.push_str(ascii),
            // At the end of a line it would continue it.
            None if letter == '\\' => result.push('_'),
            None if letter.is_ascii_graphic() || letter == ' ' => {
                // Neither comments nor trigraphs begin or end in it.
                let before = result.chars().next_back();
                if matches!(
                    (before, letter),
                    (Some('*'), '/') | (Some('/'), '*') | (Some('?'), '?')
                ) {
                    result.push(' ');
                }
                result.push(letter);
            }
            None => result.push('_'),
        }
    }
    result
}

/// Text on one line, for a comment of Rust; backticks, which quote it there, become quotes.
pub fn rust_comment(text: &str) -> String {
    line(text).replace('`', "'")
}

/// Text on one line that shows what it is: characters that move others, or end lines, become spaces, and spaces one.
pub fn line(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    for word in text.split(|c: char| c.is_whitespace() || is_hidden(c)).filter(|w| !w.is_empty()) {
        if !result.is_empty() {
            result.push(' ');
        }
        result.push_str(word);
    }
    result
}

/// Control characters, and those that change the direction of text.
fn is_hidden(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_end_where_they_should() {
        assert_eq!(c_comment("a */ b /* c"), "a * / b / * c");
        assert_eq!(c_comment("kg m²/s\n\\ ???/ é"), "kg m^2/s _ ? ? ?/ _");
        assert_eq!(c_comment("*//*\u{202e}"), "* // *");
        assert_eq!(rust_comment(" `a`\r\n\tb\u{2028}c\u{2066} \u{85}"), "'a' b c");
    }
}
