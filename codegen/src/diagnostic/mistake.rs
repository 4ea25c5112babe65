//! The catalogue of mistakes: one place for every message and its advice.

use coadjoint_symbolic::nearest::nearest;
use thiserror::Error;

use crate::lie::{ChartError, LieAlgebraError};

/// A mistake in the input. The message is its `Display`; [`Mistake::help`] says what to
/// write instead. The fields are those of the message, then what only the help needs: all names known, an example.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
// Some are those of files alone.
#[cfg_attr(not(feature = "system"), allow(dead_code))]
pub(crate) enum Mistake {
    // --- expressions in text
    #[error("the expression ends too early")]
    Unfinished,
    #[error("`{0}` cannot stand here")]
    Unexpected(String),
    #[error("an operator is missing before `{0}`")]
    MissingOperator(String),
    #[error("this parenthesis is never closed")]
    Unclosed,
    #[error("the character `{0}` has no meaning here")]
    Character(char),
    #[error("`{0}` is not a number")]
    Number(String),
    #[error("the number `{}` is too long or too large", .0.chars().take(24).collect::<String>())]
    NumberSize(String),
    #[error("unknown variable `{0}`{did}", did = did_you_mean(.1))]
    UnknownVariable(String, Option<String>, Vec<String>),
    #[error(
        "unknown variable `{0}`: only Hamiltonians, potentials, torques and events of files depend on time, which is called t"
    )]
    Time(String),
    #[error("`{0}` is not known")]
    Inverse(String),
    #[error("`{0}` has no inverse: {1}")]
    NoInverse(String, String),
    #[error("`{0}` is a list of {1}, and no number")]
    List(String, usize),
    #[error("the index `{0}` is not an integer known here")]
    Index(String),
    #[error("`{0}` is {1}, and an index must be a whole number")]
    IndexNumber(String, String),
    #[error("`{0}` is no list, so it has no length")]
    NoList(String),
    #[error("unknown function `{0}`{did}", did = did_you_mean(.1))]
    UnknownFunction(String, Option<String>),
    #[error("`{0}` is a function and needs an argument")]
    FunctionWithoutArgument(String),
    #[error("`{0}` takes {1}, not {2}")]
    ArgumentCount(String, &'static str, usize),

    #[error("this sum cannot be read: {0}")]
    Sum(String),

    // --- polynomials
    #[error("`{0}` of the momentum is not a polynomial: the Hamiltonian must be one")]
    NotPolynomial(&'static str),
    #[error("division by the momentum: the Hamiltonian must be a polynomial in it")]
    DivisionByMomentum,
    #[error("the momentum has the negative power {0}: the Hamiltonian must be a polynomial in it")]
    NegativePower(String),
    #[error(
        "the momentum has the fractional power {0}: the Hamiltonian must be a polynomial in it"
    )]
    FractionalPower(String),
    #[error("the power of the momentum is not a number known here")]
    UnknownPower,
    #[error("the momentum stands in an exponent: the Hamiltonian must be a polynomial in it")]
    MomentumInExponent,
    #[error("the Hamiltonian depends on time")]
    MovesInTime,
    #[error("the power {0} is too large; at most {1} is allowed")]
    LargePower(String, u32),
    #[error("division by zero")]
    DivisionByZero,
    #[error("`{0}` is not a real number")]
    NotReal(String),
    #[error("the Hamiltonian is too large: at least {0} terms, more than the limit of {1}")]
    TooManyTerms(usize, usize),
    #[error("the exact coefficients grow beyond {0} bits here")]
    LargeCoefficient(u64),
    #[error("the Hamiltonian does not depend on the momentum, so nothing would move")]
    NoDependence,

    // --- the problem as a whole
    #[error("truncation 0 keeps no term of the generating function")]
    TruncationZero,
    #[error(
        "truncation {0} is even: the even terms S₂, S₄, … of the generating function vanish \
         identically, so {0} would give the very integrator of {below}", below = .0.saturating_sub(1)
    )]
    TruncationEven(usize),
    #[error("truncation {0} is too large; at most {1} is allowed")]
    TruncationLarge(usize, usize),
    #[error("the truncation must be a whole number")]
    TruncationNumber,
    #[error("unknown chart `{0}`{did}", did = did_you_mean(.1))]
    UnknownChart(String, Option<String>),
    #[error("unknown solver `{0}`{did}", did = did_you_mean(.1))]
    UnknownSolver(String, Option<String>),
    #[error("unknown method `{0}`{did}", did = did_you_mean(.1))]
    UnknownMethod(String, Option<String>),
    #[error("unknown frame `{0}`{did}", did = did_you_mean(.1))]
    UnknownFrame(String, Option<String>),
    #[error(
        "there is no comoving frame: neither a linear integral nor a quadratic Casimir takes terms from the series"
    )]
    NoFrame,
    #[error(transparent)]
    Chart(#[from] ChartError),
    #[error("{0}")]
    Group(String),
    #[error(transparent)]
    Algebra(#[from] LieAlgebraError),
    #[error("the momentum has {0} coordinates, but the dual of the Lie algebra of {1} has {2}")]
    Dimension(usize, String, usize),
    #[error("the name `{0}` is already taken by {1}")]
    NameTaken(String, String),
    #[error("`{0}` is not usable as a name")]
    BadName(String),

    // --- the attribute and its function
    #[error("{0} must be known when the integrator is generated")]
    NotConstant(&'static str),
    #[error("the loops of this function run through more than {0} operations")]
    LongLoop(usize),
    #[error("index {0} is out of range: there are {1} entries, counted from 0")]
    IndexRange(String, usize),

    // --- files and arguments
    #[error("unknown key `{0}` in {1}{did}", did = did_you_mean(.2))]
    UnknownKey(String, String, Option<String>, Vec<String>),
    #[error("`{0}` is missing in {1}")]
    MissingKey(String, String, String),
    #[error("`{0}` is given twice")]
    RepeatedKey(String),
    #[error("`{0}` must be {1}, not {2}")]
    WrongKind(String, String, String, String),
    #[error("this quote has no partner: the text that it opens is never closed")]
    UnclosedQuote,
    #[error("not readable as TOML: {0}")]
    Toml(String),
    #[error("the input could not be read")]
    Unreadable,
    #[error("{0}")]
    Other(String, Option<String>),
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|name| format!("; did you mean `{name}`?")).unwrap_or_default()
}

impl Mistake {
    /// A key of `owner` that is not among `known`.
    pub(crate) fn unknown_key(key: &str, owner: &str, known: &[&str]) -> Self {
        let near = nearest(key, known.iter().copied()).map(str::to_owned);
        let known = known.iter().map(|&key| key.to_owned()).collect();
        Self::UnknownKey(key.to_owned(), owner.to_owned(), near, known)
    }

    /// A key that must be given in `owner`.
    pub(crate) fn missing_key(key: &str, owner: &str, example: &str) -> Self {
        Self::MissingKey(key.to_owned(), owner.to_owned(), example.to_owned())
    }

    /// This mistake in another function than H, which depends on something else than the momentum.
    pub(crate) fn in_formula(self, [function, of]: [&str; 2]) -> Self {
        let words = |text: &str| {
            text.replace("the momentum's coordinates", "entries of the group element's matrix")
                .replace("the momentum", of)
                .replace("Hamiltonian", function)
        };
        let (message, help) = (self.to_string(), self.correction());
        let said = words(&message);
        if said == message && help.as_deref().map(words) == help {
            return self;
        }
        Self::Other(said, help.as_deref().map(words))
    }

    /// True if it is a mistake only because a series needs a polynomial in the momentum; collocation does not.
    pub(crate) fn is_of_series(&self) -> bool {
        matches!(
            self,
            Self::NotPolynomial(_)
                | Self::DivisionByMomentum
                | Self::NegativePower(_)
                | Self::FractionalPower(_)
                | Self::UnknownPower
                | Self::MomentumInExponent
                | Self::MovesInTime
        )
    }

    /// True if a name is wrong in every place, so that it is reported in one place only.
    pub(super) fn is_of_a_name(&self) -> bool {
        matches!(
            self,
            Self::UnknownVariable(..)
                | Self::UnknownFunction(..)
                | Self::Time(_)
                | Self::Inverse(_)
                | Self::NoInverse(..)
                | Self::List(..)
                | Self::Index(..)
        )
    }

    /// A correction, where there is more to say than the message does.
    pub(crate) fn help(&self) -> Option<String> {
        if self.is_of_series() {
            let lacks = match self {
                Self::MovesInTime => "depends on time",
                _ => "is no polynomial",
            };
            return Some(format!(
                "a Hamiltonian that {lacks} has no series: without `method = \"series\"`, the command coadjoint, Python and the \
                 attribute lie_poisson of Rust make its steps by collocation"
            ));
        }
        self.correction()
    }

    /// The corrected input, in words.
    fn correction(&self) -> Option<String> {
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
                "write `t` in the Hamiltonian, a potential, a torque or an event of a file; in Rust give `Kicked` a torque of the time; a \
                 constant torque is a potential that is linear on R1, see docs/book/src/forces.md"
            }
            Self::Inverse(_) => {
                "inv(J) is the inverse of a square matrix J under [parameters] and needs indices: \
                 inv(J)[0][1]"
            }
            Self::List(name, _) => return Some(format!("write an entry of it, such as {name}[0]")),
            Self::Index(..) | Self::IndexNumber(..) => {
                "an index is made of integers, indices of sums and parameters that are integers, with + - * % and \
                 parentheses"
            }
            Self::NoList(_) => "give it as a list under [parameters], such as P = [0, 1, 2]",
            Self::UnknownFunction(..) => {
                "known functions: sqrt, sin, cos, tan, asin, acos, atan, atan2, sinh, cosh, tanh, exp, ln, abs, sign, min, max"
            }
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
            Self::UnknownMethod(..) => {
                "methods: series (the default for polynomials) and collocation (for any smooth Hamiltonian)"
            }
            Self::UnknownFrame(..) => "frames: auto (the default), fixed and comoving",
            Self::NoFrame => {
                "for a symmetric body, write both transverse moments of inertia as one parameter, and the axis \
                 of symmetry in numbers; otherwise leave `frame` out"
            }
            Self::Dimension(_, group, expected) => {
                return Some(format!("give {expected} coordinates for {group}"));
            }
            Self::BadName(_) => "names begin with a letter and continue with letters, digits and _",
            Self::NameTaken(..) => "rename one of the two",
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
