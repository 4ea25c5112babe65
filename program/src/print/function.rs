//! A program as a function, one operation a line; a long one as several, since a compiler's time grows faster than the
//! length of a function.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::c::{Body, Dialect, RowOf};
use crate::graph::{Id, Node, Program};
use crate::print::c::Signature;

/// The function of a signature; [`body`] says what `longest` means.
pub fn function(dialect: &impl Dialect, signature: &Signature<'_>, longest: usize) -> String {
    dialect.function(signature, &body(dialect, signature, longest))
}

/// The text of a signature's program, where it has more than `longest` operations as pieces. What a piece leaves for later
/// ones and for the outputs is in an array `w`. Operations on numbers side by side count once.
pub fn body(dialect: &impl Dialect, signature: &Signature<'_>, longest: usize) -> Body {
    let plan = Arrangement::new(signature.program, dialect.has_rows(), longest);
    let mut writer = Writer::new(dialect, signature);
    let mut result = Body::default();
    if plan.count == 1 {
        writer.statements(&plan.steps, &mut result.statements);
    } else {
        let (places, size) = plan.places(signature.program);
        for number in 0..plan.count {
            let mut text = String::new();
            let own = |piece: usize| plan.pieces.partition_point(|&own| own < piece);
            let steps = &plan.steps[own(number)..own(number + 1)];
            writer.statements(steps, &mut text);
            for id in steps.iter().flat_map(|step| plan.made(signature.program, *step)) {
                if let Some(&place) = places.get(&id) {
                    let place = dialect.shared(place);
                    text.push_str(&format!("    {place} = {};\n", writer.names[id.index()]));
                    writer.names[id.index()] = place;
                }
            }
            result.pieces.push_str(&dialect.piece(signature, number, size, &text));
        }
        result.statements = dialect.calls(signature, plan.count, size);
    }
    let read = |id: &Id| writer.names[id.index()].clone();
    result.outputs = signature.program.outputs().iter().map(read).collect();
    result
}

/// A statement of a program's text.
#[derive(Clone, Copy, Debug)]
enum Statement {
    /// The operation of this number.
    Node(usize),
    /// The rows of this number.
    Rows(usize),
}

/// The statements of a program, in pieces of about as many operations.
struct Arrangement {
    steps: Vec<Statement>,
    /// The piece of each, ascending.
    pieces: Vec<usize>,
    /// The number of pieces.
    count: usize,
    /// For each node that is a result of rows their number.
    rows_of: Vec<Option<usize>>,
}

impl Arrangement {
    fn new(program: &Program, has_rows: bool, longest: usize) -> Self {
        let nodes = program.nodes();
        let all = if has_rows { program.rows() } else { &[] };
        let mut rows_of = vec![None; nodes.len()];
        let mut first = Vec::new();
        for (number, rows) in all.iter().enumerate() {
            let inputs = rows.inputs.iter().flatten();
            first.push(inputs.map(|id| id.index() + 1).max().unwrap_or(0));
            for id in rows.outputs.iter().flatten().flatten() {
                // Another one was known before.
                if id.index() >= first[number] && nodes[id.index()].is_operation() {
                    rows_of[id.index()] = Some(number);
                }
            }
        }
        // What is inside of rows alone is not written by itself.
        let (mut written, mut called) = (vec![false; nodes.len()], vec![false; all.len()]);
        let mut open: Vec<Id> = program.outputs().to_vec();
        while let Some(id) = open.pop() {
            match rows_of[id.index()] {
                Some(number) if !called[number] => {
                    called[number] = true;
                    open.extend(all[number].inputs.iter().flatten());
                }
                None if !written[id.index()] => {
                    written[id.index()] = true;
                    open.extend(nodes[id.index()].operands());
                }
                _ => {}
            }
        }
        let mut steps = Vec::new();
        for at in 0..nodes.len() {
            let here = (0..all.len()).filter(|&number| called[number] && first[number] == at);
            steps.extend(here.map(Statement::Rows));
            if written[at] && nodes[at].is_operation() {
                steps.push(Statement::Node(at));
            }
        }
        let operations = |step: &Statement| match *step {
            Statement::Node(_) => 1,
            Statement::Rows(number) => all[number].program.operations().max(1),
        };
        let total: usize = steps.iter().map(operations).sum();
        let length = total.div_ceil(total.div_ceil(longest).max(1)).max(1);
        let mut seen = 0;
        let piece = |step: &Statement| {
            let before = seen;
            seen += operations(step);
            before / length
        };
        let pieces: Vec<usize> = steps.iter().map(piece).collect();
        let count = pieces.last().map_or(1, |last| last + 1);
        Self { steps, pieces, count, rows_of }
    }

    /// The nodes that a statement makes.
    fn made(&self, program: &Program, step: Statement) -> Vec<Id> {
        match step {
            Statement::Node(at) => vec![Id(at as u32)],
            Statement::Rows(number) => {
                let outputs = program.rows()[number].outputs.iter().flatten().flatten();
                let own = outputs.filter(|id| self.rows_of[id.index()] == Some(number));
                own.copied().collect()
            }
        }
    }

    /// For each operation that a later piece or an output reads its place in `w`, and the length of `w`. A place is free again
    /// in the piece after the last that reads it.
    fn places(&self, program: &Program) -> (BTreeMap<Id, usize>, usize) {
        let mut last = vec![0; program.nodes().len()];
        for (step, &piece) in self.steps.iter().zip(&self.pieces) {
            let mut read = |id: Id| last[id.index()] = piece.max(last[id.index()]);
            match *step {
                Statement::Node(at) => program.nodes()[at].operands().for_each(&mut read),
                Statement::Rows(number) => {
                    program.rows()[number].inputs.iter().flatten().copied().for_each(&mut read);
                }
            }
        }
        for output in program.outputs() {
            last[output.index()] = self.count;
        }
        let mut places = BTreeMap::new();
        let mut ends: Vec<Vec<usize>> = vec![Vec::new(); self.count + 1];
        let mut free: Vec<usize> = Vec::new();
        let mut size = 0;
        let mut current = 0;
        for (step, &piece) in self.steps.iter().zip(&self.pieces) {
            while current < piece {
                free.append(&mut ends[current]);
                current += 1;
            }
            for id in self.made(program, *step) {
                if last[id.index()] > piece && !places.contains_key(&id) {
                    let place = free.pop().unwrap_or_else(|| {
                        size += 1;
                        size - 1
                    });
                    places.insert(id, place);
                    ends[last[id.index()]].push(place);
                }
            }
        }
        (places, size)
    }
}

/// Writes nodes. Inputs, coefficients and numbers stand where they are used.
struct Writer<'a, D> {
    dialect: &'a D,
    signature: &'a Signature<'a>,
    /// For each node written so far, and for those without operands, the text that reads it.
    names: Vec<String>,
}

impl<'a, D: Dialect> Writer<'a, D> {
    fn new(dialect: &'a D, signature: &'a Signature<'a>) -> Self {
        let leaf = |node: &Node| leaf(dialect, signature, *node).unwrap_or_default();
        let names = signature.program.nodes().iter().map(leaf).collect();
        Self { dialect, signature, names }
    }

    fn statements(&mut self, steps: &[Statement], text: &mut String) {
        for step in steps {
            match *step {
                Statement::Node(at) => {
                    let name = self.dialect.bound(&format!("t{at}"));
                    let node = self.signature.program.nodes()[at];
                    text.push_str(&operation(self.dialect, node, &name, &self.names));
                    self.names[at] = name;
                }
                Statement::Rows(number) => self.rows(number, text),
            }
        }
    }

    /// A program on numbers side by side.
    fn rows(&mut self, number: usize, text: &mut String) {
        let rows = &self.signature.program.rows()[number];
        let (dialect, inner, count) = (self.dialect, &rows.program, rows.inputs.len());
        let mut names = vec![String::new(); inner.nodes().len()];
        for (at, node) in inner.nodes().iter().enumerate() {
            names[at] = match *node {
                Node::Input(input) => {
                    let [declaration, read] = self.row(number, input as usize);
                    text.push_str(&declaration);
                    read
                }
                node => leaf(dialect, self.signature, node).unwrap_or_default(),
            };
        }
        let outputs = inner.outputs();
        text.push_str(&dialect.open_rows(number, count, outputs.len()));
        for (at, &node) in inner.nodes().iter().enumerate() {
            if node.is_operation() {
                let name = dialect.bound(&format!("r{at}"));
                text.push_str(&operation(dialect, node, &name, &names));
                names[at] = name;
            }
        }
        let results: Vec<&str> = outputs.iter().map(|id| names[id.index()].as_str()).collect();
        text.push_str(&dialect.close_rows(number, count, &results));
        for (row, outputs) in rows.outputs.iter().enumerate() {
            for (result, id) in outputs.iter().enumerate() {
                if let Some(id) = id
                    && self.names[id.index()].is_empty()
                {
                    self.names[id.index()] = dialect.result(number, result, row, count);
                }
            }
        }
    }

    /// The declaration of an input of rows, where it needs one, and the text that reads it.
    fn row(&self, number: usize, input: usize) -> [String; 2] {
        let (dialect, all) = (self.dialect, self.signature.program.rows());
        let ids: Vec<Id> = all[number].inputs.iter().map(|row| row[input]).collect();
        let list: Vec<&str> = ids.iter().map(|id| self.names[id.index()].as_str()).collect();
        let name = dialect.bound(&format!("a{number}_{input}"));
        let row = |row| dialect.row(&name, row, ids.len());
        if ids.iter().all(|id| *id == ids[0]) {
            return row(RowOf::Same(list[0]));
        }
        if let Some((array, first, distance)) = self.strided(&ids) {
            return row(RowOf::Strided(&array, first, distance));
        }
        for (earlier, rows) in all[..number].iter().enumerate() {
            for result in 0..rows.program.outputs().len() {
                let own = |(row, name): (usize, &&str)| {
                    **name == dialect.result(earlier, result, row, ids.len())
                };
                if list.iter().enumerate().all(own) {
                    return row(RowOf::Result(earlier, result));
                }
            }
        }
        row(RowOf::List(&list))
    }

    /// The array, first place and distance of inputs at equal distances.
    fn strided(&self, ids: &[Id]) -> Option<(String, usize, usize)> {
        let place = |id: &Id| match self.signature.program.nodes()[id.index()] {
            Node::Input(index) => Signature::find(&self.signature.inputs, index as usize),
            _ => None,
        };
        let (field, first) = place(ids.first()?)?;
        let (_, second) = place(ids.get(1)?)?;
        let distance = second.checked_sub(first).filter(|_| field.len.is_some())?;
        let own = |(row, id): (usize, &Id)| {
            place(id)
                .is_some_and(|(other, at)| other.name == field.name && at == first + row * distance)
        };
        let name = field.name.clone();
        ids.iter().enumerate().all(own).then_some((name, first, distance))
    }
}

/// The statement of an operation by this name.
fn operation(dialect: &impl Dialect, node: Node, name: &str, names: &[String]) -> String {
    let operands: Vec<&str> = node.operands().map(|id| names[id.index()].as_str()).collect();
    dialect.declare(name, &dialect.operation(node, &operands))
}

/// The text of a node without operands; `None` for an operation.
fn leaf(dialect: &impl Dialect, signature: &Signature<'_>, node: Node) -> Option<String> {
    match node {
        Node::Zero => Some(dialect.constant(0.0)),
        Node::Constant(bits) => Some(dialect.constant(f64::from_bits(bits))),
        Node::Epsilon => Some(dialect.epsilon()),
        Node::Slot(index) => Some(dialect.slot(index as usize)),
        Node::Input(index) => {
            let found = Signature::find(&signature.inputs, index as usize);
            let place = found.map(|(field, at)| field.place(at, |name| name.into()));
            Some(place.unwrap_or_else(|| dialect.constant(0.0)))
        }
        _ => None,
    }
}
