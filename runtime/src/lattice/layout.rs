//! The order of sites in memory, and lists of the places that a pack of sites reads.
//!
//! Sites stand in the order of their colours, each colour from a multiple of [`LANES`] on, so that those of one colour are
//! one piece of memory. On lattices most neighbours of eight sites in a row are eight sites in a row, too: then the list
//! has the first of them, else all eight.

use alloc::vec::Vec;
use core::ops::Range;

use super::graph::Edge;
use super::lanes::{LANES, Pack};
use super::threads::share;

/// A list of sites for each site.
pub struct Adjacency {
    first: Vec<u32>,
    others: Vec<u32>,
}

impl Adjacency {
    /// The ends of directed edges (from, to) by their start, in the order of the edges.
    pub fn new<I: Iterator<Item = Edge>>(sites: usize, edges: impl Fn() -> I) -> Self {
        let mut first = alloc::vec![0; sites + 1];
        edges().for_each(|[from, _]| first[from as usize + 1] += 1);
        for site in 0..sites {
            first[site + 1] += first[site];
        }
        let mut next = first.clone();
        let mut others = alloc::vec![0; first[sites] as usize];
        for [from, to] in edges() {
            others[next[from as usize] as usize] = to;
            next[from as usize] += 1;
        }
        Self { first, others }
    }

    pub fn sites(&self) -> usize {
        self.first.len() - 1
    }

    pub fn of(&self, site: usize) -> &[u32] {
        &self.others[self.first[site] as usize..self.first[site + 1] as usize]
    }
}

/// The places of sites.
pub struct Places {
    /// The place of each site.
    of: Vec<u32>,
    /// The places of each colour, whole packs of them.
    pub colours: Vec<Range<usize>>,
}

impl Places {
    /// Places by the colours of sites.
    pub fn new(colours: &[u32], count: u32) -> Self {
        let mut of = alloc::vec![0; colours.len()];
        let mut ranges = Vec::new();
        let mut next: usize = 0;
        for colour in 0..count {
            let begin = next;
            for (place, _) in of.iter_mut().zip(colours).filter(|(_, own)| **own == colour) {
                *place = next as u32;
                next += 1;
            }
            next = next.next_multiple_of(LANES);
            ranges.push(begin..next);
        }
        Self { of, colours: ranges }
    }

    /// The number of places, those without a site included. The place after them is always empty.
    pub fn len(&self) -> usize {
        self.colours.last().map_or(0, |last| last.end)
    }

    pub fn sites(&self) -> usize {
        self.of.len()
    }

    pub fn of(&self, site: u32) -> u32 {
        self.of[site as usize]
    }

    /// Vectors of sites to their places.
    pub fn scatter(&self, from: &[[f64; 3]], to: &mut Spins) {
        let to = to.all_mut();
        for (vector, place) in from.iter().zip(&self.of) {
            for axis in 0..3 {
                to[axis][*place as usize] = vector[axis];
            }
        }
    }

    /// Vectors of sites from their places.
    pub fn gather(&self, from: &Spins, to: &mut [[f64; 3]]) {
        let from = from.all();
        for (vector, place) in to.iter_mut().zip(&self.of) {
            *vector = [0, 1, 2].map(|axis| from[axis][*place as usize]);
        }
    }
}

/// Eight places in memory.
const LISTED: u32 = 1 << 31;

/// Packs of places.
#[derive(Default)]
pub struct Packs {
    /// The first of eight places in a row, or the number of a list and [`LISTED`].
    codes: Vec<u32>,
    lists: Vec<[u32; LANES]>,
}

impl Packs {
    fn push(&mut self, places: [u32; LANES]) {
        let row = (0..).zip(places).all(|(lane, place)| place == places[0] + lane);
        if row {
            self.codes.push(places[0]);
        } else {
            self.codes.push(LISTED | self.lists.len() as u32);
            self.lists.push(places);
        }
    }

    pub fn codes(&self) -> &[u32] {
        &self.codes
    }

    /// The numbers at the places of a code.
    #[inline(always)]
    pub fn read(&self, numbers: impl Numbers, code: u32) -> Pack {
        if code & LISTED == 0 {
            return numbers.row(code as usize);
        }
        let list = self.list(code);
        let mut pack = [0.0; LANES];
        for lane in 0..LANES {
            pack[lane] = numbers.one(list[lane] as usize);
        }
        Pack(pack)
    }

    /// Writes numbers to the places of a code.
    #[inline(always)]
    pub fn write(&self, numbers: &mut [f64], code: u32, pack: Pack) {
        if code & LISTED == 0 {
            return store(numbers, code as usize, pack);
        }
        let list = self.list(code);
        for lane in 0..LANES {
            if let Some(number) = numbers.get_mut(list[lane] as usize) {
                *number = pack.0[lane];
            }
        }
    }

    #[inline(always)]
    fn list(&self, code: u32) -> [u32; LANES] {
        self.lists.get((code & !LISTED) as usize).copied().unwrap_or_default()
    }

    /// The two ends of edges side by side, those without an edge empty.
    pub fn pairs(places: &Places, edges: &[Edge]) -> [Self; 2] {
        let mut sorted: Vec<Edge> = edges.iter().map(|edge| edge.map(|s| places.of(s))).collect();
        sorted.sort_unstable();
        let mut ends = [Self::default(), Self::default()];
        for edges in sorted.chunks(LANES) {
            let mut lists = [[places.len() as u32; LANES]; 2];
            for (lane, edge) in edges.iter().enumerate() {
                lists[0][lane] = edge[0];
                lists[1][lane] = edge[1];
            }
            ends[0].push(lists[0]);
            ends[1].push(lists[1]);
        }
        ends
    }
}

/// The neighbours of packs of sites: as many packs for each as the site with the most neighbours has.
pub struct Neighbours {
    /// Where the codes of each pack begin.
    first: Vec<u32>,
    pub packs: Packs,
}

impl Neighbours {
    pub fn new(places: &Places, adjacency: &Adjacency) -> Self {
        let mut sites = alloc::vec![u32::MAX; places.len()];
        for (site, place) in (0..).zip(&places.of) {
            sites[*place as usize] = site;
        }
        let (mut first, mut packs) = (alloc::vec![0], Packs::default());
        for pack in sites.chunks_exact(LANES) {
            let of = |site: &u32| match *site {
                u32::MAX => &[],
                site => adjacency.of(site as usize),
            };
            let most = pack.iter().map(|site| of(site).len()).max().unwrap_or_default();
            for slot in 0..most {
                let mut list = [places.len() as u32; LANES];
                for (place, site) in list.iter_mut().zip(pack) {
                    if let Some(other) = of(site).get(slot) {
                        *place = places.of(*other);
                    }
                }
                packs.push(list);
            }
            first.push(packs.codes.len() as u32);
        }
        Self { first, packs }
    }

    /// The codes of a pack.
    #[inline(always)]
    pub fn of(&self, pack: usize) -> &[u32] {
        let (Some(&from), Some(&to)) = (self.first.get(pack), self.first.get(pack + 1)) else {
            return &[];
        };
        self.packs.codes.get(from as usize..to as usize).unwrap_or_default()
    }
}

/// Numbers of places.
pub trait Numbers: Copy {
    /// Those of eight places in a row.
    fn row(self, place: usize) -> Pack;
    /// That of one place; zero where there is none.
    fn one(self, place: usize) -> f64;
}

impl Numbers for &[f64] {
    #[inline(always)]
    fn row(self, place: usize) -> Pack {
        let row = self.get(place..).and_then(<[f64]>::first_chunk);
        row.map_or(Pack([0.0; LANES]), |row| Pack(*row))
    }
    #[inline(always)]
    fn one(self, place: usize) -> f64 {
        self.get(place).copied().unwrap_or_default()
    }
}

/// The numbers of all places outside a range, which others may write.
#[derive(Clone, Copy)]
pub struct Around<'a> {
    before: &'a [f64],
    after: &'a [f64],
    /// The end of the range.
    end: usize,
}

impl Numbers for Around<'_> {
    #[inline(always)]
    fn row(self, place: usize) -> Pack {
        if place < self.end { self.before.row(place) } else { self.after.row(place - self.end) }
    }
    #[inline(always)]
    fn one(self, place: usize) -> f64 {
        if place < self.end { self.before.one(place) } else { self.after.one(place - self.end) }
    }
}

/// Writes eight numbers in a row.
#[inline(always)]
pub fn store(numbers: &mut [f64], place: usize, pack: Pack) {
    if let Some(row) = numbers.get_mut(place..).and_then(<[f64]>::first_chunk_mut) {
        *row = pack.0;
    }
}

/// A number for each place, and zeros in the place after them.
#[derive(Clone, Debug)]
pub struct Column {
    numbers: Vec<f64>,
    /// The first number used, at the start of a line of the processor's memory.
    start: usize,
}

impl Column {
    pub fn new(places: &Places) -> Self {
        let numbers = alloc::vec![0.0; places.len() + 2 * LANES];
        let start = numbers.as_ptr().align_offset(64).min(LANES);
        Self { numbers, start }
    }

    fn range(&self) -> Range<usize> {
        self.start..self.start + self.numbers.len() - LANES
    }

    pub fn all(&self) -> &[f64] {
        &self.numbers[self.range()]
    }

    pub fn all_mut(&mut self) -> &mut [f64] {
        let range = self.range();
        &mut self.numbers[range]
    }
}

/// A vector for each place, by components.
#[derive(Clone, Debug)]
pub struct Spins(pub [Column; 3]);

/// Pieces of three columns that one thread writes.
pub type Piece<'a> = [&'a mut [f64]; 3];

impl Spins {
    pub fn new(places: &Places) -> Self {
        Self([0; 3].map(|_| Column::new(places)))
    }

    pub fn all(&self) -> [&[f64]; 3] {
        self.0.each_ref().map(Column::all)
    }

    pub fn all_mut(&mut self) -> Piece<'_> {
        self.0.each_mut().map(Column::all_mut)
    }
}

/// The columns in parts for threads, with the first place of each part.
pub fn pieces<'a, const M: usize>(
    mut columns: [Piece<'a>; M],
    places: usize,
) -> Vec<(usize, [Piece<'a>; M])> {
    let share = share(places);
    let take = |column: &mut &'a mut [f64], count: usize| {
        let list = core::mem::take(column);
        let at = count.min(list.len());
        let (taken, rest) = list.split_at_mut(at);
        *column = rest;
        taken
    };
    let part = |first: usize| {
        let count = share.min(places - first);
        let part = columns.each_mut().map(|piece| piece.each_mut().map(|c| take(c, count)));
        (first, part)
    };
    (0..places).step_by(share).map(part).collect()
}

/// Columns as one range of places is written: the numbers around it to read, and the range.
pub fn split<'a>(spins: &'a mut Spins, range: &Range<usize>) -> ([Around<'a>; 3], Piece<'a>) {
    let parts = spins.0.each_mut().map(|column| {
        let (before, rest) = column.all_mut().split_at_mut(range.start);
        let (own, after) = rest.split_at_mut(range.len());
        (Around { before, after, end: range.end }, own)
    });
    (parts.each_ref().map(|part| part.0), parts.map(|part| part.1))
}
