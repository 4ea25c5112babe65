//! Rust as a dialect of programs: a statement for each operation.

use crate::graph::{Node, Program};
use coadjoint_program::print::{Body, C, Dialect, Field, RowOf, Signature, body, tuple};

/// Programs with more operations than this are cut. Shorter ones the compiler takes in its stride, and inlines into a step
/// for lanes, which makes use of wider registers.
const LARGE: usize = 1500;

/// The most operations of one function of a program that is cut.
const LONGEST_FUNCTION: usize = 1000;

/// Code of at most this number of operations is inlined for lanes, and so has the wide instructions of its caller.
const INLINED_IN_LANES: usize = 6000;

/// The head of a function of a program, without its name.
const HEAD: &str = "<T: plumbing::Number, C: plumbing::Coefficients<T>>";

/// Rust over numbers `T`. Items of the runtime's module `plumbing` are in scope by that name.
pub(crate) struct Rust<'a> {
    /// C, which has the same infix operators.
    c: C,
    /// The suffix of the names that are bound.
    suffix: &'a str,
    /// The operations of the step that a program is part of; as many as can be where it is of none.
    operations: usize,
}

impl<'a> Rust<'a> {
    pub(crate) fn new(suffix: &'a str, operations: usize) -> Self {
        Self { c: C::default(), suffix, operations }
    }

    /// The dialect for programs that are of no step.
    pub(crate) fn alone(suffix: &'a str) -> Self {
        Self::new(suffix, usize::MAX)
    }

    /// The text of a program whose inputs have these names.
    pub(crate) fn body(&self, signature: &Signature<'_>) -> Body {
        let cut = signature.program.operations() > LARGE;
        body(self, signature, if cut { LONGEST_FUNCTION } else { usize::MAX })
    }

    /// A block whose last expression is made of the outputs of a program, which reads the array `input`.
    pub(crate) fn block(
        &self,
        program: &Program,
        input: &str,
        result: impl Fn(&[String]) -> String,
    ) -> String {
        let inputs = vec![Field::array(&self.bound(input), program.inputs())];
        let signature = Signature { name: String::new(), program, inputs, outputs: Vec::new() };
        let Body { pieces, statements, outputs } = self.body(&signature);
        pieces + &statements + &result(&outputs)
    }

    fn parameters(&self, signature: &Signature<'_>) -> String {
        let parameters = signature.inputs.iter().map(|Field { name, len }| match len {
            Some(len) => format!(", {name}: &[T; {len}]"),
            None => format!(", {name}: T"),
        });
        format!("{}: C{}", self.bound("c"), parameters.collect::<String>())
    }
}

impl Dialect for Rust<'_> {
    fn c(&self) -> &C {
        &self.c
    }

    fn constant(&self, value: f64) -> String {
        format!("{}.of({})", self.bound("c"), float(value))
    }

    fn epsilon(&self) -> String {
        format!("{}.epsilon()", self.bound("c"))
    }

    fn slot(&self, index: usize) -> String {
        format!("{}.at({index})", self.bound("c"))
    }

    fn operation(&self, node: Node, operands: &[&str]) -> String {
        match (node, operands) {
            (Node::TimesPlus(..), [a, b, c]) => format!("{a}.times_plus({b}, {c})"),
            (Node::Abs(_), [a]) => format!("{a}.simd_abs()"),
            (Node::Sqrt(_), [a]) => format!("{a}.simd_sqrt()"),
            (Node::Round(_), [a]) => format!("{a}.simd_round()"),
            // Calls, no methods: a lint looks for the type of what a method of one argument is called on, through
            // all statements before it, and would not end.
            (Node::Scale(..), [a, k]) => format!("plumbing::scale({a}, {k})"),
            (Node::Exponent(_), [a]) => format!("plumbing::exponent({a})"),
            (Node::Select(..), [a, b, c, d]) => format!("plumbing::select({a}, {b}, {c}, {d})"),
            _ => self.c.operation(node, operands),
        }
    }

    fn bound(&self, name: &str) -> String {
        format!("{name}{}", self.suffix)
    }

    /// Where a call belongs to many operations the function is not inlined for a single number, since
    /// the compiler's time grows faster than their count; where they are very many, not for lanes either.
    fn apart(&self, call: &str) -> String {
        let called = format!("plumbing::called(|| {call})");
        if self.operations <= LARGE {
            call.to_owned()
        } else if self.operations <= INLINED_IN_LANES {
            format!("if T::SINGLE {{ {called} }} else {{ {call} }}")
        } else {
            called
        }
    }

    fn row(&self, name: &str, row: RowOf<'_>, count: usize) -> [String; 2] {
        let row = match row {
            RowOf::Same(one) => format!("plumbing::Row([{one}; {count}])"),
            RowOf::Strided(array, first, distance) => {
                format!("plumbing::row::<_, {count}>({array}, {first}, {distance})")
            }
            RowOf::Result(rows, result) => {
                return [String::new(), format!("{}[{result}]", self.bound(&format!("n{rows}")))];
            }
            RowOf::List(list) => format!("plumbing::Row([{}])", list.join(", ")),
        };
        [self.declare(name, &row), name.to_owned()]
    }

    fn open_rows(&self, rows: usize, count: usize, _: usize) -> String {
        let [rows, c] = [&format!("n{rows}"), "c"].map(|name| self.bound(name));
        format!(
            "let {rows} = {{\nuse plumbing::Number as _;\nlet {c} = plumbing::RowOf::<_, {count}>({c});\n"
        )
    }

    fn close_rows(&self, _: usize, _: usize, results: &[&str]) -> String {
        format!("[{}]\n}};\n", results.join(", "))
    }

    fn result(&self, rows: usize, result: usize, row: usize, _: usize) -> String {
        format!("{}[{result}].0[{row}]", self.bound(&format!("n{rows}")))
    }

    fn declare(&self, name: &str, expression: &str) -> String {
        format!("let {name} = {expression};\n")
    }

    fn shared(&self, place: usize) -> String {
        format!("{}[{place}]", self.bound("shared"))
    }

    fn piece(
        &self,
        signature: &Signature<'_>,
        number: usize,
        size: usize,
        statements: &str,
    ) -> String {
        let (parameters, shared) = (self.parameters(signature), self.bound("shared"));
        format!(
            "#[inline(always)] fn part{number}{HEAD}({parameters}, {shared}: &mut [T; {size}]) {{ {statements} }}\n"
        )
    }

    fn calls(&self, signature: &Signature<'_>, count: usize, size: usize) -> String {
        let (c, shared) = (self.bound("c"), self.bound("shared"));
        let inputs: String =
            signature.inputs.iter().map(|field| format!(", {}", field.name)).collect();
        let call =
            |number| self.apart(&format!("part{number}({c}{inputs}, &mut {shared})")) + ";\n";
        let calls: String = (0..count).map(call).collect();
        format!("let mut {shared} = [{}; {size}];\n{calls}", self.constant(0.0))
    }

    fn function(&self, signature: &Signature<'_>, body: &Body) -> String {
        let Body { pieces, statements, outputs } = body;
        let mut outputs = outputs.iter();
        let (kinds, results): (Vec<_>, Vec<_>) = signature
            .outputs
            .iter()
            .map(|field| match field.len {
                Some(len) => (format!("[T; {len}]"), list(outputs.by_ref().take(len))),
                None => ("T".to_owned(), outputs.next().cloned().unwrap_or_default()),
            })
            .unzip();
        format!(
            "#[inline(always)] fn {}{HEAD}({}) -> {} {{ {pieces}{statements}{} }}\n",
            signature.name,
            self.parameters(signature),
            tuple(&kinds),
            tuple(&results)
        )
    }
}

/// Texts as an array.
pub(crate) fn list<'t>(texts: impl IntoIterator<Item = &'t String>) -> String {
    let texts: Vec<&str> = texts.into_iter().map(String::as_str).collect();
    format!("[{}]", texts.join(", "))
}

/// A literal; numbers beyond the range of `f64` by name, for folding to refuse.
pub(crate) fn float(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { "f64::NAN".to_owned() }
}
