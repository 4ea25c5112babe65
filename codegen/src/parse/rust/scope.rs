//! Variables by name, innermost block last.

use super::value::Value;

/// The visible variables.
#[derive(Clone, Debug, Default)]
pub(super) struct Scopes {
    variables: Vec<(String, Value)>,
    /// Where each open block begins.
    marks: Vec<usize>,
}

impl Scopes {
    pub(super) fn enter(&mut self) {
        self.marks.push(self.variables.len());
    }

    pub(super) fn leave(&mut self) {
        if let Some(mark) = self.marks.pop() {
            self.variables.truncate(mark);
        }
    }

    /// Binds a name; one bound before under it is shadowed.
    pub(super) fn bind(&mut self, name: String, value: Value) {
        self.variables.push((name, value));
    }

    pub(super) fn get(&self, name: &str) -> Option<&Value> {
        self.variables.iter().rev().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    pub(super) fn get_mut(&mut self, name: &str) -> Option<&mut Value> {
        self.variables.iter_mut().rev().find(|(known, _)| known == name).map(|(_, value)| value)
    }

    /// All visible names.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for (name, _) in &self.variables {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        names
    }
}
