//! A program written out with its values held in few registers.
//!
//! Programs are long and their values live long: left to themselves, thousands would be alive at once, and Cranelift's
//! allocation of registers would take time by the square of that. Here a value has a register only until its next use
//! is farther away than those of the others (Belady's rule); then it waits in the frame, and whoever uses it reads it
//! there, as a rule in the same instruction. What Cranelift sees fits its registers.

use coadjoint_program::schedule::Part;
use coadjoint_program::{Id, Kernel, Node, Program};
use cranelift_codegen::ir::Value;

use super::coder::Coder;

/// Registers given to values; the processor has sixteen or more.
const REGISTERS: usize = 13;

/// A value read from memory keeps its register if it is used again within this number of operations.
const NEAR: usize = 16;

/// When the values of a program are used.
struct Uses {
    /// The operations that use a node, one node's after the other's; those of results come after all operations.
    times: Vec<usize>,
    /// Where those of a node begin that are still to come, and where they end.
    next: Vec<usize>,
    end: Vec<usize>,
}

impl Uses {
    fn of(program: &Program) -> Self {
        let nodes = program.nodes();
        let mut end = program.uses();
        let mut sum = 0;
        for count in &mut end {
            sum += *count;
            *count = sum;
        }
        let mut next: Vec<usize> =
            (0..nodes.len()).map(|i| if i == 0 { 0 } else { end[i - 1] }).collect();
        let begin = next.clone();
        let mut times = vec![0; sum];
        let operands =
            nodes.iter().enumerate().flat_map(|(t, node)| node.operands().map(move |id| (t, id)));
        let outputs = program.outputs().iter().enumerate().map(|(i, &id)| (nodes.len() + i, id));
        for (t, id) in operands.chain(outputs) {
            times[next[id.index()]] = t;
            next[id.index()] += 1;
        }
        Self { times, next: begin, end }
    }

    /// The next use of a node, if there is one.
    fn next(&self, node: usize) -> Option<usize> {
        (self.next[node] < self.end[node]).then(|| self.times[self.next[node]])
    }

    /// Forgets the uses of a node up to this time.
    fn pass(&mut self, node: usize, time: usize) {
        while self.next(node).is_some_and(|next| next <= time) {
            self.next[node] += 1;
        }
    }
}

/// Where the values of a program are.
struct Held<'p> {
    part: Part,
    nodes: &'p [Node],
    uses: Uses,
    /// Values in registers.
    held: Vec<(usize, Value)>,
    /// Places of the frame in which values wait.
    places: Vec<Option<usize>>,
    free: Vec<usize>,
}

impl Held<'_> {
    fn get(&mut self, coder: &mut Coder<'_>, node: usize) -> Value {
        if let Some(&(_, value)) = self.held.iter().find(|&&(held, _)| held == node) {
            return value;
        }
        match self.places[node] {
            Some(place) => coder.load(place),
            None => coder.leaf(self.part, self.nodes[node]),
        }
    }

    /// A place of the frame that nothing waits in.
    fn place(&mut self, coder: &mut Coder<'_>) -> usize {
        self.free.pop().unwrap_or_else(|| coder.frame.scratch())
    }

    /// After a use: gives up the value if it was the last one, or keeps it in a register if the next one is near.
    fn used(&mut self, node: usize, value: Value, time: usize) {
        self.uses.pass(node, time);
        let at = self.held.iter().position(|&(held, _)| held == node);
        match (self.uses.next(node), at) {
            (None, at) => {
                if let Some(at) = at {
                    self.held.swap_remove(at);
                }
                self.free.extend(self.places[node].take());
            }
            (Some(next), None) if next <= time + NEAR => self.held.push((node, value)),
            _ => {}
        }
    }

    /// Frees registers until there are no more values in them than registers.
    fn fit(&mut self, coder: &mut Coder<'_>) {
        while self.held.len() > REGISTERS {
            let later = |&at: &usize| self.uses.next(self.held[at].0);
            let Some(at) = (0..self.held.len()).max_by_key(later) else {
                return;
            };
            let (node, value) = self.held.swap_remove(at);
            if self.places[node].is_none() && !is_leaf(self.nodes[node]) {
                let place = self.place(coder);
                coder.store(place, value);
                self.places[node] = Some(place);
            }
        }
    }
}

impl Coder<'_> {
    /// Writes out a program of the step; its results go to `sink`, in order and all after the last input was read.
    pub(super) fn evaluate(
        &mut self,
        kernel: &Kernel,
        part: Part,
        mut sink: impl FnMut(&mut Self, usize, Value),
    ) {
        let Some(program) = part.program(kernel) else {
            return;
        };
        self.frame.clear();
        let nodes = program.nodes();
        let mut held = Held {
            part,
            nodes,
            uses: Uses::of(program),
            held: Vec::new(),
            places: vec![None; nodes.len()],
            free: Vec::new(),
        };
        for (time, &node) in nodes.iter().enumerate() {
            if is_leaf(node) || held.uses.next(time).is_none() {
                continue;
            }
            let mut operands = [self.base; 4];
            let ids: Vec<Id> = node.operands().collect();
            for (at, id) in ids.iter().enumerate() {
                operands[at] = match ids[..at].iter().position(|other| other == id) {
                    Some(same) => operands[same],
                    None => held.get(self, id.index()),
                };
            }
            let value = self.operation(node, operands);
            for (id, value) in ids.iter().zip(operands) {
                held.used(id.index(), value, time);
            }
            held.held.push((time, value));
            held.fit(self);
        }
        // Inputs may lie where results go.
        let mut moved = vec![None; program.outputs().len()];
        for (place, output) in moved.iter_mut().zip(program.outputs()) {
            if let Node::Input(_) = nodes[output.index()] {
                let value = held.get(self, output.index());
                let to = held.place(self);
                self.store(to, value);
                *place = Some(to);
            }
        }
        for (i, output) in program.outputs().iter().enumerate() {
            let value = match moved[i] {
                Some(place) => self.load(place),
                None => held.get(self, output.index()),
            };
            sink(self, i, value);
            held.used(output.index(), value, nodes.len() + i);
        }
    }
}

fn is_leaf(node: Node) -> bool {
    node.operands().next().is_none()
}
