//! C, and languages that write a straight-line program as C does.

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::graph::{Node, Program};
use crate::kernel::Kernel;
use crate::schedule::{Kind, Part, Variable};

/// The syntax of a language. What a dialect does not say itself is as in C.
///
/// Every operation is rounded once; a dialect whose compiler might contract or reorder operations has to forbid it.
pub trait Dialect {
    /// The dialect of C that it builds on.
    fn c(&self) -> &C;

    /// A number of the program. It stands alone or as an operand: a negative one has to be in parentheses.
    fn constant(&self, value: f64) -> String {
        self.c().literal(value)
    }

    /// The rounding unit of the numbers: the distance from 1 to the next larger one.
    fn epsilon(&self) -> String {
        self.constant(f64::EPSILON)
    }

    /// Folded coefficient number `index`.
    fn slot(&self, index: usize) -> String {
        format!("c[{index}]")
    }

    /// An operation on operands as they are written, as many as `node` has. Leaves are never asked for.
    fn operation(&self, node: Node, operands: &[&str]) -> String {
        let [fma, sqrt, abs, rint, scaled, exponent] = &self.c().functions;
        match (node, operands) {
            (Node::Add(..), [a, b]) => format!("{a} + {b}"),
            (Node::Sub(..), [a, b]) => format!("{a} - {b}"),
            (Node::Mul(..), [a, b]) => format!("{a} * {b}"),
            (Node::Div(..), [a, b]) => format!("{a} / {b}"),
            (Node::TimesPlus(..), [a, b, c]) => format!("{fma}({a}, {b}, {c})"),
            (Node::Neg(_), [a]) => format!("-{a}"),
            (Node::Abs(_), [a]) => format!("{abs}({a})"),
            (Node::Sqrt(_), [a]) => format!("{sqrt}({a})"),
            (Node::Round(_), [a]) => format!("{rint}({a})"),
            (Node::Scale(..), [a, k]) => format!("{scaled}({a}, {k})"),
            (Node::Exponent(_), [a]) => format!("{exponent}({a})"),
            (Node::Select(..), [a, b, c, d]) => format!("({a} <= {b}) ? {c} : {d}"),
            // Leaves are written where they are used.
            _ => String::new(),
        }
    }

    /// A name that is bound.
    fn bound(&self, name: &str) -> String {
        name.to_owned()
    }

    /// A call of a program in the loop.
    fn apart(&self, call: &str) -> String {
        call.to_owned()
    }

    /// The statement that declares `name` as the value of `expression`.
    fn declare(&self, name: &str, expression: &str) -> String {
        format!("    const {} {name} = {expression};\n", self.c().number)
    }

    /// True if a program on rows of numbers is written once.
    fn has_rows(&self) -> bool {
        true
    }

    /// The declaration of numbers side by side by this name, where it needs one, and the text that reads them between
    /// [`Dialect::open_rows`] and [`Dialect::close_rows`].
    fn row(&self, name: &str, row: RowOf<'_>, count: usize) -> [String; 2] {
        let read = match row {
            RowOf::Same(one) => one.to_owned(),
            RowOf::Strided(array, first, distance) => {
                format!("{array}[{}]", along(first, distance))
            }
            RowOf::Result(rows, result) => format!("n{rows}[{}]", along(result * count, 1)),
            RowOf::List(list) => {
                let (number, list) = (&self.c().number, list.join(", "));
                let declaration = format!("    const {number} {name}[{count}] = {{{list}}};\n");
                return [declaration, format!("{name}[i]")];
            }
        };
        [String::new(), read]
    }

    /// The beginning of statements about as many numbers side by side: the rows of this number, with as many results.
    fn open_rows(&self, rows: usize, count: usize, results: usize) -> String {
        format!("    {} n{rows}[{}];\n{}", self.c().number, results * count, each(count))
    }

    /// Their end, with these results.
    fn close_rows(&self, rows: usize, count: usize, results: &[&str]) -> String {
        let set = |(result, name): (usize, &&str)| {
            format!("    n{rows}[{}] = {name};\n", along(result * count, 1))
        };
        results.iter().enumerate().map(set).collect::<String>() + "    }\n"
    }

    /// The number of a result in one of the rows.
    fn result(&self, rows: usize, result: usize, row: usize, count: usize) -> String {
        format!("n{rows}[{}]", result * count + row)
    }

    /// The number at a place of the array that the pieces of a function share.
    fn shared(&self, place: usize) -> String {
        format!("w[{place}]")
    }

    /// Piece number `number` of a function, with an array of `size` numbers to share.
    fn piece(
        &self,
        signature: &Signature<'_>,
        number: usize,
        _size: usize,
        statements: &str,
    ) -> String {
        let c = self.c();
        let inputs = Signature { outputs: Vec::new(), ..signature.clone() };
        let (parameters, _) = c.parameters(&inputs);
        let mut text = format!(
            "{} {}_{number}({parameters}, {} {}w)\n{{\n",
            c.head, signature.name, c.number, c.pointer
        );
        // Which of them a piece reads is the compiler's business.
        for argument in c.arguments(signature) {
            text.push_str(&format!("    (void){argument};\n"));
        }
        text + statements + "}\n\n"
    }

    /// The statements that call the pieces of a function.
    fn calls(&self, signature: &Signature<'_>, count: usize, size: usize) -> String {
        let c = self.c();
        let arguments = c.arguments(signature).collect::<Vec<_>>().join(", ");
        let mut text = format!("    {} w[{}];\n", c.number, size.max(1));
        for number in 0..count {
            text.push_str(&format!("    {}_{number}({arguments});\n", signature.name));
        }
        text
    }

    /// The function of a signature. Outputs are written in the order of their numbers.
    fn function(&self, signature: &Signature<'_>, body: &Body) -> String {
        let c = self.c();
        let (parameters, unused) = c.parameters(signature);
        let mut text = format!(
            "{}{} {}({parameters})\n{{\n{unused}{}",
            body.pieces, c.head, signature.name, body.statements
        );
        let mut number = 0;
        while let Some(value) = body.outputs.get(number) {
            let Some((field, at)) = Signature::find(&signature.outputs, number) else { break };
            let most = field.len.map_or(1, |len| len - at);
            let copied = copied(&body.outputs[number..body.outputs.len().min(number + most)]);
            if copied < LEAST_COPIED {
                let place = field.place(at, |name| format!("*{name}"));
                text.push_str(&format!("    {place} = {value};\n"));
                number += 1;
            } else if let Some((array, first)) = entry(value) {
                let name = &field.name;
                text.push_str(&format!(
                    "{}        {name}[{}] = {array}[{}];\n    }}\n",
                    each(copied),
                    along(at, 1),
                    along(first, 1)
                ));
                number += copied;
            }
        }
        text + "}\n"
    }
}

/// The dialect of C: infix operators, `fma`, `sqrt`, `fabs`, `rint` and the conditional operator. Arrays and coefficients are
/// reached by pointers, single inputs are values, single outputs are pointers.
#[derive(Clone, Debug)]
pub struct C {
    /// The head of a function: `static void`.
    pub head: String,
    /// The type of a number: `double`.
    pub number: String,
    /// The type of the array of folded coefficients: `const double *restrict`. Where it is empty functions are not given
    /// the array.
    pub slots: String,
    /// The text between the type of an array and its name: `*restrict `.
    pub pointer: String,
    /// The names of the functions a·b + c, √a, |a|, the nearest integer, the even one of two, a·2ᵏ and the exponent of a.
    pub functions: [String; 6],
    /// The suffix of a number: empty, or `f` for 32 bits.
    pub suffix: String,
}

impl Default for C {
    fn default() -> Self {
        Self {
            head: "static void".into(),
            number: "double".into(),
            slots: "const double *restrict".into(),
            pointer: "*restrict ".into(),
            functions: ["fma", "sqrt", "fabs", "rint", "scaled", "exponent"].map(String::from),
            suffix: String::new(),
        }
    }
}

impl C {
    /// The parameters of a function, and statements for those that it does not read.
    fn parameters(&self, signature: &Signature<'_>) -> (String, String) {
        let mut unused = String::new();
        let program = signature.program;
        let mut parameters = Vec::new();
        if !self.slots.is_empty() {
            parameters.push(format!("{} c", self.slots));
            if !program.nodes().iter().any(|node| matches!(node, Node::Slot(_))) {
                unused.push_str("    (void)c;\n");
            }
        }
        let mut first = 0;
        for Field { name, len } in &signature.inputs {
            let last = first + len.unwrap_or(1);
            let reads = |node: &Node| matches!(*node, Node::Input(i) if (first..last).contains(&(i as usize)));
            if !program.nodes().iter().any(reads) {
                unused.push_str(&format!("    (void){name};\n"));
            }
            let number = &self.number;
            parameters.push(match len {
                Some(_) => format!("const {number} {}{name}", self.pointer),
                None => format!("{number} {name}"),
            });
            first = last;
        }
        for Field { name, len } in &signature.outputs {
            if *len == Some(0) {
                unused.push_str(&format!("    (void){name};\n"));
            }
            parameters.push(format!("{} {}{name}", self.number, self.pointer));
        }
        (parameters.join(", "), unused)
    }

    /// The arguments of the pieces of a function.
    fn arguments<'s>(&self, signature: &'s Signature<'_>) -> impl Iterator<Item = &'s str> {
        let slots = (!self.slots.is_empty()).then_some("c");
        let inputs = signature.inputs.iter().map(|field| field.name.as_str());
        slots.into_iter().chain(inputs).chain(["w"])
    }

    /// The shortest decimals that are read as this number, in parentheses where it is negative.
    pub fn literal(&self, value: f64) -> String {
        match value.abs() {
            size if size.is_nan() => "NAN".into(),
            size if size.is_infinite() && value > 0.0 => "INFINITY".into(),
            size if size.is_infinite() => "(-INFINITY)".into(),
            size if value.is_sign_negative() => format!("(-{size:?}{})", self.suffix),
            size => format!("{size:?}{}", self.suffix),
        }
    }
}

/// The beginning of a loop over rows.
fn each(count: usize) -> String {
    format!("    for (unsigned int i = 0u; i < {count}u; i++) {{\n")
}

/// The place of row `i` in an array, by that of the first and their distance.
fn along(first: usize, distance: usize) -> String {
    let way = if distance == 1 { "i".to_owned() } else { format!("({distance}u * i)") };
    if first == 0 { way } else { format!("{first}u + {way}") }
}

/// Outputs that are this many entries of an array are copied in a loop.
const LEAST_COPIED: usize = 8;

/// The array and the place of an entry.
fn entry(text: &str) -> Option<(&str, usize)> {
    let (array, place) = text.strip_suffix(']')?.split_once('[')?;
    Some((array, place.parse().ok()?))
}

/// The number of texts, from the first on, that are entries of an array one after the other.
fn copied(texts: &[String]) -> usize {
    let Some((array, first)) = texts.first().and_then(|text| entry(text)) else { return 0 };
    let next = |(at, text): &(usize, &String)| entry(text) == Some((array, first + at));
    texts.iter().enumerate().take_while(next).count()
}

impl Dialect for C {
    fn c(&self) -> &C {
        self
    }
}

/// Numbers side by side, as they are read.
#[derive(Clone, Copy, Debug)]
pub enum RowOf<'a> {
    /// One number, in all rows.
    Same(&'a str),
    /// The numbers of an array from a place on, with a distance from row to row.
    Strided(&'a str, usize, usize),
    /// The result of this number of the rows of that number.
    Result(usize, usize),
    /// A number for each row.
    List(&'a [&'a str]),
}

/// A part of a program's inputs or outputs: an array or a single number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// The number of entries; `None` for a single number that is no array.
    pub len: Option<usize>,
}

impl Field {
    /// An array of this length.
    pub fn array(name: &str, len: usize) -> Self {
        Self { name: name.to_owned(), len: Some(len) }
    }

    /// A single number.
    pub fn number(name: &str) -> Self {
        Self { name: name.to_owned(), len: None }
    }

    /// The text of the number at `index`; `one` gives the form of a single number.
    pub(super) fn place(&self, index: usize, one: impl Fn(&str) -> String) -> String {
        match self.len {
            Some(_) => format!("{}[{index}]", self.name),
            None => one(&self.name),
        }
    }
}

/// The name of a program, and names of its inputs and outputs in the order of their numbers.
///
/// Inputs beyond the fields, of which a well-made signature has none, read as the number 0; outputs beyond them are not
/// written.
#[derive(Clone, Debug)]
pub struct Signature<'a> {
    /// The name of the function.
    pub name: String,
    /// The program.
    pub program: &'a Program,
    /// The inputs.
    pub inputs: Vec<Field>,
    /// The outputs.
    pub outputs: Vec<Field>,
}

impl Signature<'_> {
    /// The field with a number, and the number's place in the field.
    pub(super) fn find(fields: &[Field], number: usize) -> Option<(&Field, usize)> {
        let mut left = number;
        for field in fields {
            let len = field.len.unwrap_or(1);
            if left < len {
                return Some((field, left));
            }
            left -= len;
        }
        None
    }
}

/// The text of a program.
#[derive(Clone, Debug, Default)]
pub struct Body {
    /// Functions that the statements call.
    pub pieces: String,
    /// A line for each operation, or the calls of the pieces.
    pub statements: String,
    /// For each output the expression that reads it.
    pub outputs: Vec<String>,
}

/// The signatures of the programs that the loop of a kernel calls; names of functions begin with `prefix`. An output that
/// is an input as well has a name of its own.
pub fn signatures<'a>(kernel: &'a Kernel, prefix: &str) -> impl Iterator<Item = Signature<'a>> {
    Part::ALL.into_iter().filter_map(move |(part, name)| {
        let (inputs, outputs) = part.variables(kernel);
        let field = |variable: Variable, end: &str| {
            let len = match variable.kind(kernel) {
                Kind::Array(len) => Some(len),
                Kind::Number | Kind::Count => None,
            };
            Field { name: format!("{}{end}", variable.name()), len }
        };
        let output = |&variable: &Variable| {
            field(variable, if inputs.contains(&variable) { "_next" } else { "" })
        };
        Some(Signature {
            name: format!("{prefix}{name}"),
            program: part.program(kernel)?,
            inputs: inputs.iter().map(|&variable| field(variable, "")).collect(),
            outputs: outputs.iter().map(output).collect(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_back_to_the_bit() {
        let c = C::default();
        for value in [0.1, 1.0 / 3.0, f64::MAX, f64::MIN_POSITIVE, 5e-324, 1e300] {
            assert_eq!(c.literal(value).parse(), Ok(value));
        }
        assert_eq!(c.literal(3.0), "3.0");
        assert_eq!(c.literal(1e-17), "1e-17");
        assert_eq!(c.literal(-0.0), "(-0.0)");
        assert_eq!(c.literal(f64::NEG_INFINITY), "(-INFINITY)");
        assert_eq!(c.literal(f64::NAN), "NAN");
        assert_eq!(C { suffix: "f".into(), ..c }.literal(-0.5), "(-0.5f)");
    }
}
