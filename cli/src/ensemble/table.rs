//! The columns of a file of names.

use coadjoint_run::ensemble::Rows;

use ::csv::ByteRecord;

/// All columns of a file of names, in its order.
#[derive(Clone, Debug)]
pub struct Table {
    /// The names.
    pub header: Vec<String>,
    /// For each cell of a row, the number of the layout's column, or nothing where it is carried
    /// through as it is.
    pub own: Vec<Option<usize>>,
}

impl Table {
    /// The table of a header in which the layout's columns are at `places`.
    pub fn new(header: Vec<String>, places: &[Option<usize>]) -> Self {
        let mut own = vec![None; header.len()];
        for (column, &place) in places.iter().enumerate() {
            if let Some(place) = place {
                own[place] = Some(column);
            }
        }
        Self { header, own }
    }

    /// The names of the columns that are carried through.
    pub fn others(&self) -> impl Iterator<Item = &str> + '_ {
        let names = self.header.iter().zip(&self.own);
        names.filter(|(_, own)| own.is_none()).map(|(name, _)| name.as_str())
    }
}

/// A piece of an ensemble as it was read.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    /// The states.
    pub rows: Rows,
    /// For each row the cells of the columns that are carried through, where there are any.
    pub others: Vec<ByteRecord>,
}

impl Piece {
    /// Empties it, to begin at row `first`.
    pub fn clear(&mut self, first: u64) {
        self.rows.clear(first);
        self.others.clear();
    }
}
