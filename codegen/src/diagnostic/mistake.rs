//! The catalogue of mistakes: one place for every message and its advice.

use thiserror::Error;

use crate::lie::{ChartError, LieAlgebraError};

/// A mistake in the input. The message is its `Display`; [`Mistake::help`] says what to
/// write instead.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum Mistake {
    // --- expressions in text
    /// The expression stops after an operator or an opening parenthesis.
    #[error("the expression ends too early")]
    Unfinished,
    /// A token that cannot stand here.
    #[error("`{0}` cannot stand here")]
    Unexpected(String),
    /// A number or a closing parenthesis directly before a name: a forgotten `*`.
    #[error("an operator is missing before `{0}`")]
    MissingOperator(String),
    /// `(` without `)`.
    #[error("this parenthesis is never closed")]
    Unclosed,
    /// A character that no token begins with.
    #[error("the character `{0}` has no meaning here")]
    Character(char),
    /// A number that cannot be read.
    #[error("`{0}` is not a number")]
    Number(String),
    /// A number with too many digits or too large an exponent.
    #[error("the number `{0}` is too long or too large")]
    NumberSize(String),
    /// A name that is neither a coordinate nor a parameter: name, nearest, all known.
    #[error("unknown variable `{0}`{did}", did = did_you_mean(.1))]
    UnknownVariable(String, Option<String>, Vec<String>),
    /// A name that is read as time.
    #[error("unknown variable `{0}`: a system file cannot depend on time")]
    Time(String),
    /// The inverse of something that has none: the name.
    #[error("`{0}` is not known")]
    Inverse(String),
    /// An index that is not an integer.
    #[error("the index `{0}` is not an integer known here")]
    Index(String),
    /// A function that does not exist: name, nearest.
    #[error("unknown function `{0}`{did}", did = did_you_mean(.1))]
    UnknownFunction(String, Option<String>),
    /// A function's name without an argument.
    #[error("`{0}` is a function and needs an argument")]
    FunctionWithoutArgument(String),
    /// A function with more or fewer than one argument: name, number of arguments.
    #[error("`{0}` takes one argument, not {1}")]
    ArgumentCount(String, usize),

    /// A sum over an index that cannot be read: the reason.
    #[error("this sum cannot be read: {0}")]
    Sum(String),

    // --- polynomials
    /// A function, other than a polynomial, of the momentum.
    #[error("`{0}` of the momentum is not a polynomial: the Hamiltonian must be one")]
    NotPolynomial(&'static str),
    /// The momentum in a denominator.
    #[error("division by the momentum: the Hamiltonian must be a polynomial in it")]
    DivisionByMomentum,
    /// A negative power of the momentum.
    #[error("the momentum has the negative power {0}: the Hamiltonian must be a polynomial in it")]
    NegativePower(String),
    /// A power of the momentum that is no whole number.
    #[error(
        "the momentum has the fractional power {0}: the Hamiltonian must be a polynomial in it"
    )]
    FractionalPower(String),
    /// A power of the momentum that is known only at run time.
    #[error("the power of the momentum is not a number known here")]
    UnknownPower,
    /// The momentum in an exponent.
    #[error("the momentum stands in an exponent: the Hamiltonian must be a polynomial in it")]
    MomentumInExponent,
    /// A power beyond the limit: power, limit.
    #[error("the power {0} is too large; at most {1} is allowed")]
    LargePower(String, u32),
    /// Division by a number that is zero.
    #[error("division by zero")]
    DivisionByZero,
    /// A function of a number that is not real or not finite.
    #[error("`{0}` is not a real number")]
    NotReal(String),
    /// A polynomial beyond the limit: terms so far, limit.
    #[error("the Hamiltonian is too large: at least {0} terms, more than the limit of {1}")]
    TooManyTerms(usize, usize),
    /// Exact numbers that grow beyond the limit.
    #[error("the exact coefficients grow beyond {0} bits here")]
    LargeCoefficient(u64),
    /// H does not depend on the momentum.
    #[error("the Hamiltonian does not depend on the momentum, so nothing would move")]
    NoDependence,

    // --- the problem as a whole
    /// Truncation 0.
    #[error("truncation 0 keeps no term of the generating function")]
    TruncationZero,
    /// An even truncation.
    #[error(
        "truncation {0} is even: the even terms S₂, S₄, … of the generating function vanish \
         identically, so {0} would give the very integrator of {below}", below = .0.saturating_sub(1)
    )]
    TruncationEven(usize),
    /// A truncation beyond the limit: truncation, limit.
    #[error("truncation {0} is too large; at most {1} is allowed")]
    TruncationLarge(usize, usize),
    /// A truncation that is no whole number.
    #[error("the truncation must be a whole number")]
    TruncationNumber,
    /// A chart nobody knows: name, nearest.
    #[error("unknown chart `{0}`{did}", did = did_you_mean(.1))]
    UnknownChart(String, Option<String>),
    /// A solver nobody knows: name, nearest.
    #[error("unknown solver `{0}`{did}", did = did_you_mean(.1))]
    UnknownSolver(String, Option<String>),
    /// A frame nobody knows: name, nearest.
    #[error("unknown frame `{0}`{did}", did = did_you_mean(.1))]
    UnknownFrame(String, Option<String>),
    /// A comoving frame is asked for where none makes the series shorter.
    #[error(
        "there is no comoving frame: neither a coordinate that is an integral nor a quadratic Casimir takes terms from the series"
    )]
    NoFrame,
    /// A chart the group does not have.
    #[error(transparent)]
    Chart(#[from] ChartError),
    /// The group is not in the catalogue.
    #[error("{0}")]
    Group(String),
    /// Data that defines no Lie algebra.
    #[error(transparent)]
    Algebra(#[from] LieAlgebraError),
    /// The momentum has not as many coordinates as the group has dimensions: found, group,
    /// expected.
    #[error("the momentum has {0} coordinates, but the dual of the Lie algebra of {1} has {2}")]
    Dimension(usize, String, usize),
    /// A name used twice: name, what has it already.
    #[error("the name `{0}` is already taken by {1}")]
    NameTaken(String, String),
    /// A name that is not a word.
    #[error("`{0}` is not usable as a name")]
    BadName(String),

    // --- the attribute and its function
    /// Anything the reader of Rust functions does not understand: what, what to write instead.
    #[error("{0}")]
    Unsupported(String, String),
    /// A value known only at run time where one is needed to unroll.
    #[error("{0} must be known when the integrator is generated")]
    NotConstant(&'static str),
    /// A loop that does not end within the limit.
    #[error("the loops of this function run through more than {0} operations")]
    LongLoop(usize),
    /// An index beyond an array: index, length.
    #[error("index {0} is out of range: there are {1} entries, counted from 0")]
    IndexRange(String, usize),

    // --- files and arguments
    /// A key nobody knows: key, what it was found in, nearest, all known.
    #[error("unknown key `{0}` in {1}{did}", did = did_you_mean(.2))]
    UnknownKey(String, String, Option<String>, Vec<String>),
    /// A key that must be given: key, in what, an example.
    #[error("`{0}` is missing in {1}")]
    MissingKey(String, String, String),
    /// A key given twice.
    #[error("`{0}` is given twice")]
    RepeatedKey(String),
    /// A value of the wrong kind: key, what was expected, what was found, an example.
    #[error("`{0}` must be {1}, not {2}")]
    WrongKind(String, String, String, String),
    /// A quote that opens a text which nothing closes.
    #[error("this quote has no partner: the text that it opens is never closed")]
    UnclosedQuote,
    /// The file is not TOML.
    #[error("not readable as TOML: {0}")]
    Toml(String),
    /// Input that could not be read although nothing particular was found wrong.
    #[error("the input could not be read")]
    Unreadable,
    /// Anything else: message, help.
    #[error("{0}")]
    Other(String, Option<String>),
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!("; did you mean `{name}`?")).unwrap_or_default()
}

impl Mistake {
    /// The same mistake in a potential, which is a polynomial in the group element's matrix where a
    /// Hamiltonian is one in the momentum.
    #[must_use]
    pub fn in_potential(self) -> Self {
        let words = |text: &str| {
            text.replace("the momentum's coordinates", "entries of the group element's matrix")
                .replace("the momentum", "the group element")
                .replace("Hamiltonian", "potential")
        };
        let (message, help) = (self.to_string(), self.help());
        let said = words(&message);
        if said == message && help.as_deref().map(words) == help {
            return self;
        }
        Self::Other(said, help.as_deref().map(words))
    }

    /// Whether a name is wrong wherever it stands, so that one place is enough.
    pub(super) fn is_of_a_name(&self) -> bool {
        matches!(
            self,
            Self::UnknownVariable(..)
                | Self::UnknownFunction(..)
                | Self::Time(_)
                | Self::Inverse(_)
                | Self::Index(..)
        )
    }

    /// A correction, where there is more to say than the message does.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let text = match self {
            Self::Unfinished => "write a number, a name or a parenthesis here",
            Self::Unexpected(_) => {
                "an expression is built from numbers, names, + - * / ^ (or **), parentheses and \
                 functions such as sqrt(m)"
            }
            Self::MissingOperator(next) => {
                return Some(format!("products are written with `*`: `… * {next}`"));
            }
            Self::Unclosed => "add the missing `)`",
            Self::Character(_) => {
                "names are letters, digits and `_`; powers are written `^` or `**`"
            }
            Self::Number(_) => "write decimals as 1.5 or 1e-3, fractions as 2/3",
            Self::NumberSize(_) => "numbers have at most 400 digits and exponents up to 400",
            Self::UnknownVariable(_, _, known) if known.is_empty() => return None,
            Self::UnknownVariable(_, _, known) => {
                return Some(format!("known here: {}", list(known)));
            }
            Self::Time(_) => {
                "drive the system from Rust or Python: kicks between steps or parameters changed from step to step, \
                 see docs/book/src/forces.md; a constant torque is a potential that is linear on R1"
            }
            Self::Inverse(_) => {
                "inv(J) is the inverse of a square matrix J under [parameters] and needs indices: \
                 inv(J)[0][1]"
            }
            Self::Index(..) => {
                "an index is made of integers, indices of sums and parameters that are integers, with + - * % and \
                 parentheses"
            }
            Self::UnknownFunction(..) => "known functions: sqrt, sin, cos, tan, exp, ln, abs",
            Self::FunctionWithoutArgument(name) => {
                return Some(format!("write `{name}(…)` with parentheses"));
            }
            Self::Sum(_) => "write for example sum(i, 0..64, x[i]*x[(i + 1) % 64])",
            Self::NotPolynomial(_) => {
                "functions may be applied to parameters only; expand the Hamiltonian in powers of \
                 the momentum first"
            }
            Self::DivisionByMomentum => "only numbers and parameters may stand in a denominator",
            Self::NegativePower(_) | Self::FractionalPower(_) => {
                "powers of the momentum are whole numbers from 0"
            }
            Self::UnknownPower | Self::MomentumInExponent => {
                "write the power as a whole number, such as x^2"
            }
            Self::NotReal(_) => "numbers must be real and finite",
            Self::LargeCoefficient(_) => "write large powers of numbers out as decimals",
            Self::NoDependence => "the momentum's coordinates must occur in it",
            Self::TooManyTerms(..) => "lower the degree, or split the Hamiltonian",
            Self::TruncationZero => {
                "use an odd truncation: 1, 3, 5, 7, … give order of accuracy 2, 4, 6, 8, …"
            }
            Self::TruncationEven(k) => {
                return Some(format!(
                    "use {} (order of accuracy {k}) or {} (order {})",
                    k.saturating_sub(1),
                    k + 1,
                    k + 2
                ));
            }
            Self::TruncationNumber => "write for example truncation = 7",
            Self::UnknownChart(..) => "charts: exp (the default) and cayley",
            Self::UnknownSolver(..) => "solvers: newton and fixed_point",
            Self::UnknownFrame(..) => "frames: fixed (the default) and comoving",
            Self::NoFrame => {
                "for a symmetric body, write both transverse moments of inertia as one parameter and \
                 choose coordinates with the axis of symmetry among them; otherwise leave `frame` out"
            }
            Self::Dimension(_, group, expected) => {
                return Some(format!("give {expected} coordinates for {group}"));
            }
            Self::BadName(_) => "names begin with a letter and continue with letters, digits and _",
            Self::NameTaken(..) => "rename one of the two",
            Self::Unsupported(_, help) if help.is_empty() => return None,
            Self::Unsupported(_, help) => help,
            Self::NotConstant(_) => "use a literal, a `const` of the body or a loop variable",
            Self::LongLoop(_) => "write the sum with fewer terms",
            Self::UnknownKey(_, _, _, known) => {
                return Some(format!("known keys: {}", list(known)));
            }
            Self::MissingKey(_, _, example) | Self::WrongKind(_, _, _, example) => {
                return Some(format!("write for example {example}"));
            }
            Self::RepeatedKey(_) => "keep one of them",
            Self::UnclosedQuote => {
                "texts begin and end with the same quote on one line, as in name = \"rigid-body\""
            }
            Self::Other(_, help) => return help.clone(),
            _ => return None,
        };
        Some(text.to_owned())
    }
}

/// Names separated by commas; long lists are cut.
fn list(names: &[String]) -> String {
    const SHOWN: usize = 24;
    let mut text = names.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > SHOWN {
        text.push_str(&format!(", … ({} in all)", names.len()));
    }
    text
}
