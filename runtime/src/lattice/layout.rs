//! The order of sites in memory, and lists of the places that a pack of sites reads.
//!
//! Sites stand in the order of their colours, each colour from a multiple of [`LANES`] on, so that those of one colour are
//! one piece of memory. On lattices most neighbours of eight sites in a row are eight sites in a row, too, and are read where
//! they stand; others are copied into a row first.

use alloc::vec::Vec;
use core::ops::Range;

use coadjoint_geometry::number::Number;
use coadjoint_geometry::row::Tuple;
use coadjoint_geometry::vector::V3;

use super::graph::Edge;
use super::lanes::{LANES, Pack, largest};
use super::threads::{self, share};

/// A list of sites, or of something else of them, for each site.
pub struct Adjacency<T = u32> {
    first: Vec<u32>,
    others: Vec<T>,
}

impl<T: Copy + Default> Adjacency<T> {
    /// The ends of directed edges (from, to) by their start, in the order of the edges.
    pub fn new<I: Iterator<Item = (u32, T)>>(sites: usize, edges: impl Fn() -> I) -> Self {
        let mut first = alloc::vec![0; sites + 1];
        edges().for_each(|(from, _)| first[from as usize + 1] += 1);
        for site in 0..sites {
            first[site + 1] += first[site];
        }
        let mut next = first.clone();
        let mut others = alloc::vec![T::default(); first[sites] as usize];
        for (from, to) in edges() {
            others[next[from as usize] as usize] = to;
            next[from as usize] += 1;
        }
        Self { first, others }
    }

    pub fn sites(&self) -> usize {
        self.first.len() - 1
    }

    pub fn of(&self, site: usize) -> &[T] {
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

    /// The sites at all places.
    pub fn sites_at(&self) -> Vec<Option<usize>> {
        let mut sites = alloc::vec![None; self.len()];
        for (site, place) in self.of.iter().enumerate() {
            sites[*place as usize] = Some(site);
        }
        sites
    }

    /// Numbers of sites at their places, and zeros.
    pub fn column(&self, numbers: &[f64], number: usize) -> Column {
        let mut column = Column::new(self.len() + LANES, number);
        let all = column.all_mut();
        for (number, place) in numbers.iter().zip(&self.of) {
            all[*place as usize] = *number;
        }
        column
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

/// The places of the neighbours of each pack of sites: as many packs as the site with the most neighbours has.
#[derive(Default)]
pub struct Neighbours {
    /// The first place of each pack of neighbours, and where those of each pack of sites begin.
    starts: Vec<u32>,
    begin: Vec<u32>,
    /// The factors of each pack of neighbours, where there are any.
    factors: Vec<Pack>,
}

impl Neighbours {
    /// The largest size of a factor.
    pub fn largest(&self) -> f64 {
        largest_factor(&self.factors)
    }

    /// Calls for each neighbour of a pack, by the first place of a pack, with its factors if there are any.
    #[inline(always)]
    pub fn each(&self, pack: usize, mut call: impl FnMut(usize, Option<Pack>)) {
        if self.factors.is_empty() {
            return self.of(pack).iter().for_each(|start| call(*start as usize, None));
        }
        let first = self.begin.get(pack).map_or(0, |first| *first as usize);
        for (start, factor) in self.of(pack).iter().zip(&self.factors[first..]) {
            call(*start as usize, Some(*factor));
        }
    }

    /// The most neighbours of a pack.
    pub fn most(&self) -> u32 {
        let counts = self.begin.windows(2).map(|pair| pair[1] - pair[0]);
        counts.max().unwrap_or_default()
    }

    /// The neighbours of a pack, each by the first place of a pack.
    #[inline(always)]
    pub fn of(&self, pack: usize) -> &[u32] {
        let (Some(&from), Some(&to)) = (self.begin.get(pack), self.begin.get(pack + 1)) else {
            return &[];
        };
        self.starts.get(from as usize..to as usize).unwrap_or_default()
    }
}

/// Packs of neighbours that do not stand in a row: columns have copies of their numbers behind the places.
pub struct Copies {
    lists: Vec<[u32; LANES]>,
    /// The lists that each colour reads.
    pub of_colour: Vec<Range<usize>>,
    /// The place of the first copy.
    start: usize,
}

impl Copies {
    /// The neighbours of all packs of sites, for each of some lists of neighbours, and what must be copied.
    pub fn new(
        places: &Places,
        adjacency: &[(Adjacency, Option<Adjacency<f64>>)],
    ) -> (Self, Vec<Neighbours>) {
        let sites = places.sites_at();
        let mut found: Vec<_> = adjacency.iter().map(|_| Neighbours::default()).collect();
        let start = places.len() + LANES;
        let mut copies = Self { lists: Vec::new(), of_colour: Vec::new(), start };
        let mut begun = 0;
        for colour in &places.colours {
            for pack in sites[colour.clone()].chunks_exact(LANES) {
                for (neighbours, (adjacency, factors)) in found.iter_mut().zip(adjacency) {
                    neighbours.begin.push(neighbours.starts.len() as u32);
                    let of = |site: &Option<usize>| site.map_or(&[][..], |site| adjacency.of(site));
                    let most = pack.iter().map(|site| of(site).len()).max().unwrap_or_default();
                    for slot in 0..most {
                        let place = |site| of(site).get(slot).map(|other| places.of(*other));
                        let list = core::array::from_fn(|lane| {
                            place(&pack[lane]).unwrap_or(places.len() as u32)
                        });
                        neighbours.starts.push(copies.start_of(list));
                        if let Some(factors) = factors {
                            let of = |site: Option<usize>| factors.of(site?).get(slot).copied();
                            let own = core::array::from_fn(|lane| of(pack[lane]).unwrap_or(0.0));
                            neighbours.factors.push(Tuple(own));
                        }
                    }
                }
            }
            copies.of_colour.push(begun..copies.lists.len());
            begun = copies.lists.len();
        }
        for neighbours in &mut found {
            neighbours.begin.push(neighbours.starts.len() as u32);
        }
        (copies, found)
    }

    /// The first of eight places in a row, or that of a copy.
    fn start_of(&mut self, list: [u32; LANES]) -> u32 {
        if is_row(list) {
            return list[0];
        }
        self.lists.push(list);
        (self.start + (self.lists.len() - 1) * LANES) as u32
    }

    /// The length of a column with copies.
    pub fn length(&self) -> usize {
        self.start + self.lists.len() * LANES
    }

    pub fn all(&self) -> Range<usize> {
        0..self.lists.len()
    }

    /// Copies the numbers of some lists.
    pub fn refresh(&self, column: &mut [f64], lists: Range<usize>) {
        let (sites, copies) = column.split_at_mut(self.start);
        let sites = &*sites;
        let copies = &mut copies[lists.start * LANES..lists.end * LANES];
        let count = copies.len();
        threads::each(
            pieces([[copies]], count),
            #[inline(always)]
            |(first, [[copies]])| {
                let lists = &self.lists[lists.start + first / LANES..];
                for (copy, list) in copies.as_chunks_mut::<LANES>().0.iter_mut().zip(lists) {
                    for lane in 0..LANES {
                        copy[lane] = sites[list[lane] as usize];
                    }
                }
            },
        );
    }
}

/// The largest size of factors, or 1 where there are none.
fn largest_factor(factors: &[Pack]) -> f64 {
    let sizes = factors.iter().map(|own| largest(own.abs()));
    if factors.is_empty() { 1.0 } else { sizes.fold(0.0, f64::max) }
}

/// True for eight places in a row.
fn is_row(list: [u32; LANES]) -> bool {
    (0..).zip(list).all(|(lane, place)| place == list[0] + lane)
}

/// Edges, none of which share a site.
#[derive(Default)]
pub struct Pairs {
    /// The first places of eight edges whose ends stand in rows.
    rows: Vec<[u32; 2]>,
    /// The places of eight edges; that after all sites where there is no edge.
    lists: Vec<[[u32; LANES]; 2]>,
    /// The factors of rows, then of lists, where there are any.
    factors: Vec<Pack>,
}

impl Pairs {
    /// Edges by their numbers among all edges, which may have factors.
    pub fn new(places: &Places, of: &[u32], edges: &[Edge], factors: Option<&[f64]>) -> Self {
        let place = |at: &u32| (edges[*at as usize].map(|site| places.of(site)), *at);
        let mut sorted: Vec<(Edge, u32)> = of.iter().map(place).collect();
        sorted.sort_unstable();
        let mut pairs = Self::default();
        let mut of_lists = Vec::new();
        for edges in sorted.chunks(LANES) {
            let mut lists = [[places.len() as u32; LANES]; 2];
            let mut own = Tuple([0.0; LANES]);
            for (lane, (edge, at)) in edges.iter().enumerate() {
                (lists[0][lane], lists[1][lane]) = (edge[0], edge[1]);
                own.0[lane] = factors.map_or(0.0, |factors| factors[*at as usize]);
            }
            let row = lists.into_iter().all(is_row);
            match row {
                true => pairs.rows.push(lists.map(|list| list[0])),
                false => pairs.lists.push(lists),
            }
            if factors.is_some() {
                if row { &mut pairs.factors } else { &mut of_lists }.push(own);
            }
        }
        pairs.factors.extend(of_lists);
        pairs
    }

    /// The largest size of a factor.
    pub fn largest(&self) -> f64 {
        largest_factor(&self.factors)
    }

    /// Replaces the spins at both ends of all edges, by their factors.
    #[inline(always)]
    pub fn replace(
        &self,
        mut columns: Piece<'_>,
        change: impl Fn(V3<Pack>, V3<Pack>, Pack) -> [V3<Pack>; 2],
    ) {
        let factor = |at: usize| self.factors.get(at).copied().unwrap_or(Pack::of(1.0));
        for (at, [a, b]) in self.rows.iter().enumerate() {
            let own = factor(at);
            let [a, b] = [*a as usize, *b as usize];
            let [s, t] = change(read(&columns, a), read(&columns, b), own);
            write(&mut columns, a, s);
            write(&mut columns, b, t);
        }
        let [x, y, z] = columns;
        for (at, ends) in self.lists.iter().enumerate() {
            let own = factor(self.rows.len() + at);
            let mut spins = [[Tuple([0.0; LANES]); 3]; 2];
            for end in 0..2 {
                for lane in 0..LANES {
                    let place = ends[end][lane] as usize;
                    spins[end][0].0[lane] = x[place];
                    spins[end][1].0[lane] = y[place];
                    spins[end][2].0[lane] = z[place];
                }
            }
            let spins = change(spins[0], spins[1], own);
            for end in 0..2 {
                for lane in 0..LANES {
                    let place = ends[end][lane] as usize;
                    x[place] = spins[end][0].0[lane];
                    y[place] = spins[end][1].0[lane];
                    z[place] = spins[end][2].0[lane];
                }
            }
        }
    }
}

/// Vectors of places.
pub trait Vectors: Copy {
    /// Those of eight places in a row.
    fn row(self, place: usize) -> V3<Pack>;
}

impl Vectors for [&[f64]; 3] {
    #[inline(always)]
    fn row(self, place: usize) -> V3<Pack> {
        [row(self[0], place), row(self[1], place), row(self[2], place)]
    }
}

/// Eight numbers in a row.
// A copy of slices stays a call.
#[allow(clippy::manual_memcpy)]
#[inline(always)]
pub fn row(numbers: &[f64], place: usize) -> Pack {
    let numbers = &numbers[place..place + LANES];
    let mut pack = [0.0; LANES];
    for lane in 0..LANES {
        pack[lane] = numbers[lane];
    }
    Tuple(pack)
}

/// The vectors of all places outside a range, which others may write.
#[derive(Clone, Copy)]
pub struct Around<'a> {
    before: [&'a [f64]; 3],
    after: [&'a [f64]; 3],
    /// The end of the range.
    end: usize,
}

impl Vectors for &Around<'_> {
    #[inline(always)]
    fn row(self, place: usize) -> V3<Pack> {
        let ahead = place < self.end;
        let columns = if ahead { &self.before } else { &self.after };
        columns.row(if ahead { place } else { place - self.end })
    }
}

/// The vectors of eight places in a row.
#[inline(always)]
pub fn read(columns: &Piece<'_>, place: usize) -> V3<Pack> {
    [&*columns[0], &*columns[1], &*columns[2]].row(place)
}

/// Writes the vectors of eight places in a row.
#[inline(always)]
pub fn write(columns: &mut Piece<'_>, place: usize, vectors: V3<Pack>) {
    for axis in 0..3 {
        if let Some(row) = columns[axis].get_mut(place..).and_then(<[f64]>::first_chunk_mut) {
            *row = vectors[axis].0;
        }
    }
}

/// A number for each place, zeros after them, and copies.
#[derive(Clone, Debug)]
pub struct Column {
    numbers: Vec<f64>,
    /// The first number used, at the start of a line of the processor's memory.
    start: usize,
    length: usize,
}

impl Column {
    /// Columns that are read together have different numbers: else those of one place share a set of the processor's cache.
    pub fn new(length: usize, number: usize) -> Self {
        let ahead = 7 * LANES * (number % 32);
        let numbers = alloc::vec![0.0; length + LANES + ahead];
        let start = numbers.as_ptr().align_offset(64).min(LANES) + ahead;
        Self { numbers, start, length }
    }

    fn range(&self) -> Range<usize> {
        self.start..self.start + self.length
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

/// Pieces of columns that one thread writes.
pub type Piece<'a, const K: usize = 3> = [&'a mut [f64]; K];

impl Spins {
    /// Columns of this length, at least a pack longer than places, with different numbers for vectors that are read together.
    pub fn new(length: usize, number: usize) -> Self {
        Self([0, 1, 2].map(|axis| Column::new(length, 3 * number + axis)))
    }

    pub fn all(&self) -> [&[f64]; 3] {
        self.0.each_ref().map(Column::all)
    }

    pub fn all_mut(&mut self) -> Piece<'_> {
        self.0.each_mut().map(Column::all_mut)
    }
}

/// The columns in parts for threads, with the first place of each part.
pub fn pieces<'a, const K: usize, const M: usize>(
    mut columns: [Piece<'a, K>; M],
    places: usize,
) -> Vec<(usize, [Piece<'a, K>; M])> {
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

/// Columns as one range of places is written: the vectors around it to read, and the range.
pub fn split<'a>(spins: &'a mut Spins, range: &Range<usize>) -> (Around<'a>, Piece<'a>) {
    let parts = spins.0.each_mut().map(|column| {
        let (before, rest) = column.all_mut().split_at_mut(range.start);
        let (own, after) = rest.split_at_mut(range.len());
        (&*before, own, &*after)
    });
    let [x, y, z] = parts;
    let (before, after) = ([x.0, y.0, z.0], [x.2, y.2, z.2]);
    (Around { before, after, end: range.end }, [x.1, y.1, z.1])
}

/// Replaces every pack of some columns.
#[inline(always)]
pub fn each_pack<const K: usize>(
    columns: Piece<'_, K>,
    places: usize,
    work: impl Fn(usize, [Pack; K]) -> [Pack; K] + Sync,
) {
    threads::each(
        pieces([columns], places),
        #[inline(always)]
        |(first, [columns])| {
            let [first, count] = [first, columns[0].len()].map(|places| places / LANES);
            // Packs by number, in plain loops: iterators over several columns stay calls.
            let columns = columns.map(|column| column.as_chunks_mut::<LANES>().0);
            for at in 0..count {
                let mut packs = [Pack::of(0.0); K];
                for k in 0..K {
                    packs[k] = Tuple(columns[k][at]);
                }
                let packs = work(first + at, packs);
                for k in 0..K {
                    columns[k][at] = packs[k].0;
                }
            }
        },
    );
}
