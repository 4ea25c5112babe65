//! The grammar of products.
//!
//! product = semidirect { ("*" | "×") semidirect }
//! semidirect = power { ("|x" | "⋉") space [ "^" count ] }
//! power = ( name | "(" product ")" ) [ "^" count ]

use super::{CatalogueError, groups};
use crate::lie::{LieAlgebra, RationalMatrix, symmetric_square};

/// The most dimensions of a product.
const LARGEST: usize = 8192;

#[derive(Clone, Debug, PartialEq)]
enum Token {
    Name(String),
    Count(usize),
    Times,
    Semidirect,
    Power,
    Open,
    Close,
}

pub(super) fn parse(text: &str) -> Result<LieAlgebra, CatalogueError> {
    let tokens = tokens(text)?;
    let mut parser = Parser { text, tokens, at: 0, depth: 0 };
    let algebra = parser.product()?;
    match parser.next() {
        None => Ok(algebra),
        Some(token) => Err(parser.syntax("`*`, `^`, `|x` or the end", Some(&token))),
    }
}

fn tokens(text: &str) -> Result<Vec<Token>, CatalogueError> {
    let characters: Vec<char> = text.chars().collect();
    let mut tokens = Vec::new();
    let mut at = 0;
    while at < characters.len() {
        let c = characters[at];
        let token = match c {
            c if c.is_whitespace() => {
                at += 1;
                continue;
            }
            '*' | '×' => Token::Times,
            '^' => Token::Power,
            '⋉' => Token::Semidirect,
            // Rust tokens written out may have a space between: `| x`.
            '|' => match end_of(&characters, at + 1, char::is_whitespace) {
                x if characters.get(x) == Some(&'x') => {
                    at = x;
                    Token::Semidirect
                }
                _ => return Err(stray(text, c)),
            },
            '(' => Token::Open,
            ')' => Token::Close,
            c if c.is_ascii_digit() => {
                let end = end_of(&characters, at, |c| c.is_ascii_digit());
                let digits: String = characters[at..end].iter().collect();
                at = end - 1;
                match digits.parse() {
                    Ok(count) if count <= LARGEST => Token::Count(count),
                    _ => return Err(too_large(text)),
                }
            }
            c if c.is_alphanumeric() || c == '_' => {
                let mut end = end_of(&characters, at, |c| c.is_alphanumeric() || c == '_');
                // `SO(3)` and `SL(2,R)`: the parenthesis belongs to the name.
                if characters.get(end) == Some(&'(')
                    && characters.get(end + 1).is_some_and(char::is_ascii_digit)
                    && let Some(length) = characters[end..].iter().position(|&c| c == ')')
                {
                    end += length + 1;
                }
                let name = characters[at..end].iter().collect();
                at = end - 1;
                Token::Name(name)
            }
            other => return Err(stray(text, other)),
        };
        tokens.push(token);
        at += 1;
    }
    Ok(tokens)
}

fn stray(text: &str, found: char) -> CatalogueError {
    CatalogueError::Syntax {
        text: text.into(),
        expected: "a group, `*`, `^`, `|x` or parentheses",
        found: format!("`{found}`"),
    }
}

fn end_of(characters: &[char], from: usize, inside: impl Fn(char) -> bool) -> usize {
    characters[from..]
        .iter()
        .position(|&c| !inside(c))
        .map_or(characters.len(), |length| from + length)
}

fn too_large(name: &str) -> CatalogueError {
    CatalogueError::TooLarge { name: name.into(), what: "the dimension", limit: LARGEST }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

impl Parser<'_> {
    fn next(&mut self) -> Option<Token> {
        let token = self.tokens.get(self.at).cloned();
        self.at += 1;
        token
    }

    fn take(&mut self, token: &Token) -> bool {
        let found = self.tokens.get(self.at) == Some(token);
        self.at += usize::from(found);
        found
    }

    fn syntax(&self, expected: &'static str, found: Option<&Token>) -> CatalogueError {
        let found = match found {
            None => "the end".to_owned(),
            Some(Token::Name(name)) => format!("`{name}`"),
            Some(Token::Count(count)) => format!("`{count}`"),
            Some(Token::Times) => "`*`".to_owned(),
            Some(Token::Semidirect) => "`|x`".to_owned(),
            Some(Token::Power) => "`^`".to_owned(),
            Some(Token::Open) => "`(`".to_owned(),
            Some(Token::Close) => "`)`".to_owned(),
        };
        CatalogueError::Syntax { text: self.text.into(), expected, found }
    }

    fn product(&mut self) -> Result<LieAlgebra, CatalogueError> {
        let mut factors = vec![self.semidirect()?];
        while self.take(&Token::Times) {
            factors.push(self.semidirect()?);
        }
        if factors.iter().map(LieAlgebra::dim).sum::<usize>() > LARGEST {
            return Err(too_large(self.text));
        }
        match <[LieAlgebra; 1]>::try_from(factors) {
            Ok([single]) => Ok(single),
            Err(factors) => Ok(LieAlgebra::direct_product(&factors)),
        }
    }

    fn semidirect(&mut self) -> Result<LieAlgebra, CatalogueError> {
        let mut algebra = self.power()?;
        while self.take(&Token::Semidirect) {
            let space = match self.next() {
                Some(Token::Name(name)) => name,
                other => return Err(self.syntax("a space such as R3 or Sym3", other.as_ref())),
            };
            let copies = self.exponent()?.unwrap_or(1);
            algebra = self.extend(&algebra, &space, copies)?;
        }
        Ok(algebra)
    }

    /// G ⋉ V^copies for the matrices of G acting on columns or on symmetric matrices.
    fn extend(
        &self,
        group: &LieAlgebra,
        space: &str,
        copies: usize,
    ) -> Result<LieAlgebra, CatalogueError> {
        let none = |instead: String| CatalogueError::NoAction {
            group: group.name().into(),
            space: space.into(),
            instead,
        };
        let Some(basis) = group.basis() else {
            return Err(none("it is known by its brackets alone; give the brackets".into()));
        };
        let size = basis.first().map_or(0, RationalMatrix::rows);
        let representation: Vec<RationalMatrix> = if space == format!("R{size}") {
            basis.to_vec()
        } else if space == format!("Sym{size}") {
            basis.iter().map(symmetric_square).collect()
        } else {
            let instead = format!("its matrices act on R{size} and Sym{size}");
            return Err(none(instead));
        };
        let dimension = representation.first().map_or(0, RationalMatrix::rows);
        let total = dimension.checked_mul(copies).and_then(|d| d.checked_add(group.dim()));
        if total.is_none_or(|total| total > LARGEST) {
            return Err(too_large(self.text));
        }
        let suffix = if copies == 1 { String::new() } else { format!("^{copies}") };
        let name = format!("{} |x {space}{suffix}", group.name());
        LieAlgebra::semidirect_product(name, group, &representation, copies)
            .map_err(|error| none(error.to_string()))
    }

    fn power(&mut self) -> Result<LieAlgebra, CatalogueError> {
        let base = match self.next() {
            Some(Token::Name(name)) => groups::group(&name)?,
            Some(Token::Open) if self.depth < 32 => {
                self.depth += 1;
                let inner = self.product()?;
                self.depth -= 1;
                match self.next() {
                    Some(Token::Close) => inner,
                    other => return Err(self.syntax("`)`", other.as_ref())),
                }
            }
            other => return Err(self.syntax("a group such as SO3", other.as_ref())),
        };
        match self.exponent()? {
            None => Ok(base),
            Some(count) if base.dim().saturating_mul(count) > LARGEST => Err(too_large(self.text)),
            Some(count) => Ok(base.power(count)),
        }
    }

    fn exponent(&mut self) -> Result<Option<usize>, CatalogueError> {
        if !self.take(&Token::Power) {
            return Ok(None);
        }
        match self.next() {
            Some(Token::Count(count)) if count > 0 => Ok(Some(count)),
            other => Err(self.syntax("a positive whole number", other.as_ref())),
        }
    }
}
