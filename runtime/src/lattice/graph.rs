//! Sites and the edges between them.

use alloc::vec::Vec;

use super::error::LatticeError;

/// The most sites, and the most edges: places, and copies of eight for each end of an edge, are numbered in 32 bits.
pub(super) const MOST: usize = 1 << 27;

/// Two sites that an edge joins.
pub type Edge = [u32; 2];

/// One end of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// The axis closes to a ring.
    Periodic,
    /// The axis ends.
    Open,
}

/// The sites of a lattice: cells in a box, each with some sites, and the edges between nearest neighbours.
///
/// Sites are numbered in C order of the shape, the last axis fastest, the sites of a cell innermost.
#[derive(Clone, Debug)]
pub struct Graph {
    shape: Vec<usize>,
    boundary: Vec<Boundary>,
    /// Sites of a cell.
    cell: usize,
    nearest: Nearest,
}

/// The edges between nearest neighbours.
#[derive(Clone, Debug)]
enum Nearest {
    Offsets(&'static [Offset<'static>]),
    Listed(Vec<Edge>),
}

/// Edges from a site of each cell to a site of the cell at an offset.
#[derive(Clone, Copy, Debug)]
pub(super) struct Offset<'a> {
    pub by: &'a [isize],
    /// The sites of the cells.
    pub sites: [usize; 2],
}

const fn offset(by: &[isize], from: usize, to: usize) -> Offset<'_> {
    Offset { by, sites: [from, to] }
}

const CHAIN: &[Offset<'static>] = &[offset(&[1], 0, 0)];
const SQUARE: &[Offset<'static>] = &[offset(&[1, 0], 0, 0), offset(&[0, 1], 0, 0)];
const CUBIC: &[Offset<'static>] =
    &[offset(&[1, 0, 0], 0, 0), offset(&[0, 1, 0], 0, 0), offset(&[0, 0, 1], 0, 0)];
const TRIANGULAR: &[Offset<'static>] =
    &[offset(&[1, 0], 0, 0), offset(&[0, 1], 0, 0), offset(&[1, -1], 0, 0)];
const HONEYCOMB: &[Offset<'static>] =
    &[offset(&[0, 0], 0, 1), offset(&[1, 0], 1, 0), offset(&[0, 1], 1, 0)];
const KAGOME: &[Offset<'static>] = &[
    offset(&[0, 0], 0, 1),
    offset(&[0, 0], 0, 2),
    offset(&[0, 0], 1, 2),
    offset(&[1, 0], 1, 0),
    offset(&[0, 1], 2, 0),
    offset(&[-1, 1], 2, 1),
];

impl Graph {
    /// A chain of sites, periodic.
    ///
    /// # Errors
    /// [`LatticeError::EmptyAxis`], [`LatticeError::TooLarge`]; so for the others, too.
    pub fn chain(length: usize) -> Result<Self, LatticeError> {
        Self::new(&[length], 1, CHAIN)
    }

    /// A square lattice, periodic, of this shape.
    ///
    /// # Errors
    /// As [`Graph::chain`].
    pub fn square(shape: [usize; 2]) -> Result<Self, LatticeError> {
        Self::new(&shape, 1, SQUARE)
    }

    /// A simple cubic lattice, periodic, of this shape.
    ///
    /// # Errors
    /// As [`Graph::chain`].
    pub fn cubic(shape: [usize; 3]) -> Result<Self, LatticeError> {
        Self::new(&shape, 1, CUBIC)
    }

    /// A triangular lattice, periodic: the axes are at 60°, and each site has six neighbours.
    ///
    /// # Errors
    /// As [`Graph::chain`].
    pub fn triangular(shape: [usize; 2]) -> Result<Self, LatticeError> {
        Self::new(&shape, 1, TRIANGULAR)
    }

    /// A honeycomb lattice, periodic: cells of two sites on a triangular lattice.
    ///
    /// # Errors
    /// As [`Graph::chain`].
    pub fn honeycomb(shape: [usize; 2]) -> Result<Self, LatticeError> {
        Self::new(&shape, 2, HONEYCOMB)
    }

    /// A kagome lattice, periodic: cells of three sites, at 0, a/2 and b/2, on the axes a and b of a triangular lattice.
    ///
    /// # Errors
    /// As [`Graph::chain`].
    pub fn kagome(shape: [usize; 2]) -> Result<Self, LatticeError> {
        Self::new(&shape, 3, KAGOME)
    }

    /// Sites that these edges join.
    ///
    /// # Errors
    /// [`LatticeError::NoSite`], [`LatticeError::SelfEdge`], [`LatticeError::DuplicateEdge`] for edges; else as [`Graph::chain`].
    pub fn from_edges(sites: usize, edges: &[[usize; 2]]) -> Result<Self, LatticeError> {
        let mut graph = Self::new(&[sites], 1, &[])?;
        graph.nearest = Nearest::Listed(graph.listed(edges)?);
        Ok(graph)
    }

    fn new(
        shape: &[usize],
        cell: usize,
        nearest: &'static [Offset<'static>],
    ) -> Result<Self, LatticeError> {
        if let Some(axis) = shape.iter().position(|length| *length == 0) {
            return Err(LatticeError::EmptyAxis { axis });
        }
        let sites = shape.iter().try_fold(cell, |n, length| n.checked_mul(*length));
        if sites.is_none_or(|sites| sites > MOST) {
            return Err(LatticeError::TooLarge { most: MOST });
        }
        Ok(Self {
            shape: shape.to_vec(),
            boundary: alloc::vec![Boundary::Periodic; shape.len()],
            cell,
            nearest: Nearest::Offsets(nearest),
        })
    }

    /// The graph with these boundaries, one an axis.
    ///
    /// # Errors
    /// [`LatticeError::Offset`] for another number of them.
    pub fn bounded(mut self, boundary: &[Boundary]) -> Result<Self, LatticeError> {
        self.has_axes(boundary.len())?;
        self.boundary = boundary.to_vec();
        Ok(self)
    }

    /// The number of sites.
    #[must_use]
    pub fn sites(&self) -> usize {
        self.cell * self.shape.iter().product::<usize>()
    }

    /// The cells along each axis.
    #[must_use]
    pub fn shape(&self) -> &[usize] {
        &self.shape
    }

    /// The sites of a cell.
    #[must_use]
    pub fn cell(&self) -> usize {
        self.cell
    }

    /// The edges from a site of every cell to a site of the cell at an offset, in the order of the cells; `sites` are their
    /// numbers in the cells.
    ///
    /// # Errors
    /// As [`Lattice::bond_between`](super::Lattice::bond_between).
    pub fn edges_between(
        &self,
        offset: &[isize],
        sites: [usize; 2],
    ) -> Result<Vec<[usize; 2]>, LatticeError> {
        let edges = self.edges(Offset { by: offset, sites })?;
        Ok(edges.into_iter().map(|edge| edge.map(|site| site as usize)).collect())
    }

    /// The edges between nearest neighbours, a list for each direction.
    pub(super) fn nearest(&self) -> Result<Vec<Vec<Edge>>, LatticeError> {
        match &self.nearest {
            Nearest::Listed(edges) if edges.is_empty() => Err(LatticeError::NoEdges),
            Nearest::Listed(edges) => Ok(alloc::vec![edges.clone()]),
            Nearest::Offsets(offsets) => offsets.iter().map(|offset| self.edges(*offset)).collect(),
        }
    }

    fn has_axes(&self, found: usize) -> Result<(), LatticeError> {
        let expected = self.shape.len();
        if found == expected { Ok(()) } else { Err(LatticeError::Offset { expected, found }) }
    }

    /// The edges from one site of every cell to one of the cell at an offset.
    pub(super) fn edges(
        &self,
        Offset { by, sites }: Offset<'_>,
    ) -> Result<Vec<Edge>, LatticeError> {
        self.has_axes(by.len())?;
        if let Some(&site) = sites.iter().find(|site| **site >= self.cell) {
            return Err(LatticeError::NoSite { site, sites: self.cell });
        }
        let mut edges = Vec::new();
        let mut at = alloc::vec![0; by.len()];
        let cells = self.sites() / self.cell;
        for cell in 0..cells {
            if let Some(other) = self.moved(&at, by) {
                let [from, to] = [cell * self.cell + sites[0], other * self.cell + sites[1]];
                if from == to {
                    return Err(LatticeError::SelfEdge { site: from });
                }
                edges.push([from as u32, to as u32]);
            }
            for (place, length) in at.iter_mut().zip(&self.shape).rev() {
                *place += 1;
                if *place < *length {
                    break;
                }
                *place = 0;
            }
        }
        // Twice the offset leads back everywhere, or nowhere.
        let twice: Vec<isize> = by.iter().map(|d| 2 * d).collect();
        let origin = alloc::vec![0; by.len()];
        match edges.first() {
            None => Err(LatticeError::NoEdges),
            Some(edge) if sites[0] == sites[1] && self.moved(&origin, &twice) == Some(0) => {
                Err(LatticeError::DuplicateEdge { edge: edge.map(|site| site as usize) })
            }
            Some(_) => Ok(edges),
        }
    }

    /// The number of the cell at an offset from another, unless it is outside.
    fn moved(&self, at: &[usize], by: &[isize]) -> Option<usize> {
        let mut cell = 0;
        for (axis, length) in self.shape.iter().enumerate() {
            let place = at[axis] as isize + by[axis];
            let inside = match self.boundary[axis] {
                Boundary::Periodic => place.rem_euclid(*length as isize),
                Boundary::Open if (0..*length as isize).contains(&place) => place,
                Boundary::Open => return None,
            };
            cell = cell * length + inside as usize;
        }
        Some(cell)
    }

    /// Edges given one by one.
    pub(super) fn listed(&self, edges: &[[usize; 2]]) -> Result<Vec<Edge>, LatticeError> {
        let sites = self.sites();
        let mut sorted = Vec::with_capacity(edges.len());
        for &[a, b] in edges {
            if let Some(site) = [a, b].into_iter().find(|site| *site >= sites) {
                return Err(LatticeError::NoSite { site, sites });
            }
            if a == b {
                return Err(LatticeError::SelfEdge { site: a });
            }
            sorted.push([a.min(b), a.max(b)]);
        }
        sorted.sort_unstable();
        match sorted.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(LatticeError::DuplicateEdge { edge: pair[0] }),
            None => Ok(edges.iter().map(|edge| edge.map(|site| site as u32)).collect()),
        }
    }
}
