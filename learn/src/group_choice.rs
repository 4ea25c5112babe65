//! The group of a model, as requests and model files name it.

use std::collections::BTreeMap;
use std::str::FromStr;

use coadjoint_codegen::lie::{LieAlgebra, RationalMatrix, catalogue};
use coadjoint_codegen::number::Rational;
use serde::{Deserialize, Serialize};

use crate::error::LearnError;

/// A group: one of the catalogue by its name, or one by its algebra, such as that of a system file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum GroupChoice {
    /// A name of the catalogue.
    Named(String),
    /// An algebra that is not in the catalogue.
    Own(OwnAlgebra),
}

/// The components (k, c_ij^k) of a bracket.
type Components = Vec<(usize, String)>;

/// An algebra as model files have it; numbers are fractions as texts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OwnAlgebra {
    name: String,
    generators: Vec<String>,
    /// \[e_i, e_j\] for i < j.
    brackets: Vec<(usize, usize, Components)>,
    /// The matrices of the basis row by row; none where the algebra is known by its brackets alone.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    basis: Vec<Vec<Vec<String>>>,
}

impl Default for GroupChoice {
    fn default() -> Self {
        Self::Named(String::new())
    }
}

impl<T: Into<String>> From<T> for GroupChoice {
    fn from(name: T) -> Self {
        Self::Named(name.into())
    }
}

impl GroupChoice {
    /// The group of this algebra, by its name where the catalogue has it.
    #[must_use]
    pub fn of(algebra: &LieAlgebra) -> Self {
        let name = algebra.name().to_owned();
        if catalogue::lookup(&name).is_ok_and(|known| known == *algebra) {
            return Self::Named(name);
        }
        let mut brackets: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for c in algebra.structure().iter().filter(|c| c.i < c.j) {
            brackets.entry((c.i, c.j)).or_default().push((c.k, c.value.to_string()));
        }
        let rows = |m: &RationalMatrix| {
            let row = |i| (0..m.columns()).map(|j| m.get(i, j).to_string()).collect();
            (0..m.rows()).map(row).collect()
        };
        Self::Own(OwnAlgebra {
            name,
            generators: algebra.generators().to_vec(),
            brackets: brackets.into_iter().map(|((i, j), terms)| (i, j, terms)).collect(),
            basis: algebra.basis().unwrap_or_default().iter().map(rows).collect(),
        })
    }

    /// The group's name.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Named(name) => name,
            Self::Own(own) => &own.name,
        }
    }

    /// The algebra.
    ///
    /// # Errors
    /// [`LearnError::UnknownGroup`] for a name that the catalogue has not, or brackets and matrices that are no algebra.
    pub fn algebra(&self) -> Result<LieAlgebra, LearnError> {
        let found = match self {
            Self::Named(name) => catalogue::lookup(name).map_err(|error| error.to_string()),
            Self::Own(own) => own.algebra(),
        };
        found.map_err(|reason| LearnError::UnknownGroup { name: self.name().to_owned(), reason })
    }
}

impl OwnAlgebra {
    fn algebra(&self) -> Result<LieAlgebra, String> {
        let number = |text: &String| {
            Rational::from_str(text).map_err(|error| format!("`{text}` is no fraction: {error}"))
        };
        if catalogue::lookup(&self.name).is_ok() {
            return Err("it has the name of another group".to_owned());
        }
        let (name, generators) = (self.name.clone(), self.generators.clone());
        let algebra = if self.basis.is_empty() {
            let component = |(k, value): &(usize, String)| Ok((*k, number(value)?));
            let bracket = |(i, j, terms): &(usize, usize, Vec<_>)| {
                Ok((*i, *j, terms.iter().map(component).collect::<Result<Vec<_>, String>>()?))
            };
            let brackets = self.brackets.iter().map(bracket).collect::<Result<Vec<_>, String>>()?;
            LieAlgebra::from_brackets(name, generators, brackets)
        } else {
            let row = |row: &Vec<String>| row.iter().map(number).collect();
            let matrix = |rows: &Vec<Vec<String>>| {
                let rows = rows.iter().map(row).collect::<Result<Vec<_>, String>>()?;
                Ok(RationalMatrix::from_rows(rows))
            };
            let basis = self.basis.iter().map(matrix).collect::<Result<Vec<_>, String>>()?;
            LieAlgebra::from_named_basis(name, generators, basis)
        };
        algebra.map_err(|error| error.to_string())
    }
}
