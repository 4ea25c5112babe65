//! The spins and the energy that a system file describes, on the whole lattice or on a cut of it.

use std::array::from_fn;
use std::collections::BTreeMap;
use std::path::Path;

use coadjoint::lattice::{Boundary, GaussStep, Graph, Lattice, LatticeError, RotationStep};
use coadjoint_codegen::diagnostic::Span;
use coadjoint_codegen::system::lattice::{self as text, Coupling, File, Interaction, Start};
use coadjoint_learn::table::array;
use coadjoint_program::Program;
use nalgebra::{Matrix3, Vector3};

use super::method::Algorithm;
use crate::error::RunError;

/// Sites along each axis of a cut, on which steps are chosen and errors are estimated.
const CUT: usize = 16;
/// Sites of a cut of a graph that has no axes.
const MOST_OF_CUT: usize = CUT * CUT * CUT;

/// One spin a site.
pub(super) type Spins = Vec<[f64; 3]>;

/// Arrays that stand for files, by their names: shapes, and numbers row by row.
pub type Arrays = BTreeMap<String, (Vec<usize>, Vec<f64>)>;

/// The places of the arrays of a text: some are given, others stand in files beside that of the system.
#[derive(Clone, Copy)]
pub(super) struct Files<'a> {
    pub system: &'a Path,
    pub given: &'a Arrays,
}

/// A mistake, with its place in the text.
pub(super) struct Misplaced(pub Span, pub String);

type Placed<T> = Result<T, Misplaced>;

/// The reason of an error, at a place of the text.
fn at<E: ToString>(place: Span) -> impl Fn(E) -> Misplaced {
    move |error| Misplaced(place, error.to_string())
}

/// The content of the files of a text.
#[derive(Debug)]
pub(super) struct Contents {
    site: Vec<Vec<f64>>,
    bonds: Vec<Vec<Vec<f64>>>,
    /// Edges with their types.
    edges: Vec<([usize; 2], usize)>,
}

impl Contents {
    /// Reads all files, which are named relative to that of the system.
    pub(super) fn read(files: Files<'_>, text: &text::Lattice) -> Placed<Self> {
        let column = |file: &File| numbers(files, file).map(|(_, numbers)| numbers);
        let columns =
            |energy: &Interaction| energy.tables.iter().map(column).collect::<Placed<_>>();
        let edges = match &text.edges {
            Some(file) => {
                let (shape, numbers) = numbers(files, file)?;
                let &[_, width @ (2 | 3)] = &shape[..] else {
                    let what = format!(
                        "edges are rows (i, j) or (i, j, type): the array has shape {shape:?}"
                    );
                    return Err(at(file.place)(what));
                };
                let whole = |x: &f64| x.fract() == 0.0 && (0.0..1e15).contains(x);
                if let Some(bad) = numbers.iter().position(|x| !whole(x)) {
                    let what =
                        format!("row {}: {} is no number of a site", bad / width, numbers[bad]);
                    return Err(at(file.place)(what));
                }
                let edge = |row: &[f64]| {
                    (
                        [row[0] as usize, row[1] as usize],
                        row.get(2).map_or(0, |kind| *kind as usize),
                    )
                };
                numbers.chunks(width).map(edge).collect()
            }
            None => Vec::new(),
        };
        let bonds = text.bonds.iter().map(|bond| columns(&bond.energy)).collect::<Placed<_>>()?;
        Ok(Self { site: columns(&text.site)?, bonds, edges })
    }

    /// The edges of a bond's type; all of them where it names none.
    fn edges_of(&self, bond: &text::Bond) -> impl Iterator<Item = &([usize; 2], usize)> {
        let kind = bond.kind;
        self.edges.iter().filter(move |(_, own)| kind.is_none_or(|kind| kind == *own))
    }
}

/// The shape and the numbers of a file, all of which are finite.
fn numbers(files: Files<'_>, file: &File) -> Placed<(Vec<usize>, Vec<f64>)> {
    let path = files.system.parent().unwrap_or(Path::new("")).join(&file.path);
    let given = files.given.get(&file.path).cloned();
    let (shape, numbers) = given.map_or_else(|| array(&path), Ok).map_err(at(file.place))?;
    if let Some(bad) = numbers.iter().position(|x| !x.is_finite()) {
        let what =
            format!("{}: number {bad} of the array is {}, not finite", file.path, numbers[bad]);
        return Err(at(file.place)(what));
    }
    Ok((shape, numbers))
}

/// An energy that is no quadratic form, of some sites each.
#[derive(Debug)]
struct Cluster {
    /// The sites of each copy, one after the other.
    sites: Vec<usize>,
    /// The spins that it depends on.
    spins: usize,
    programs: [Program; 2],
    slots: Vec<f64>,
}

impl Cluster {
    /// The results of a program for all copies.
    fn run(&self, program: usize, spins: &[[f64; 3]]) -> Vec<f64> {
        let number = |row: usize, i: usize| match i / 3 {
            at if at < self.spins => spins[self.sites[row * self.spins + at]][i % 3],
            // The time, on which it does not depend.
            _ => 0.0,
        };
        self.programs[program].run_each(self.sites.len() / self.spins, number, &self.slots)
    }
}

/// A field that depends on time.
type Driven = Vec<(Coupling, usize)>;

fn field(driven: &Driven, time: f64) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (term, tables) in driven {
        let numbers = [vec![f64::NAN; *tables], vec![time]].concat();
        let factor = term.factor(&numbers);
        (0..3).for_each(|axis| sum[axis] += factor * term.field[axis]);
    }
    sum
}

/// Spins on a graph with their energy.
#[derive(Debug)]
pub(super) struct Magnet {
    pub lattice: Lattice,
    functions: Vec<Cluster>,
    driven: Driven,
    /// True if there is damping, and a velocity.
    moved: [bool; 2],
    /// The sites of the whole lattice that these are; none where they are all.
    pub cut: Option<Vec<usize>>,
}

fn matrix(rows: &[[f64; 3]; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| rows[i][j])
}

/// The factors of a term, by those of the tables.
fn factors(term: &Coupling, tables: &[Vec<f64>], rows: usize) -> Vec<f64> {
    let mut numbers = vec![f64::NAN; tables.len() + 1];
    let factor = |row: usize| {
        numbers.iter_mut().zip(tables).for_each(|(number, table)| *number = table[row]);
        term.factor(&numbers)
    };
    (0..rows).map(factor).collect()
}

/// Refuses tables that do not have this number of entries, or not the shape that a table of sites may have.
fn check(energy: &Interaction, tables: &[Vec<f64>], count: usize, of: &str) -> Placed<()> {
    for (file, table) in energy.tables.iter().zip(tables) {
        if table.len() != count {
            let (path, found) = (&file.path, table.len());
            let what = format!(
                "{path} has {found} numbers, and there are {count} {of}: a table has one number for each"
            );
            return Err(Misplaced(file.place, what));
        }
    }
    Ok(())
}

impl Magnet {
    /// The whole lattice of a text.
    pub(super) fn whole(text: &text::Lattice, tables: &Contents) -> Placed<Self> {
        let graph = match &text.edges {
            Some(file) => {
                let edges: Vec<_> = tables.edges.iter().map(|(edge, _)| *edge).collect();
                let sites = edges.iter().flatten().max().map_or(0, |last| last + 1);
                Graph::from_edges(sites, &edges).map_err(at(file.place))?
            }
            None => graph(text, &text.shape)?,
        };
        check(&text.site, &tables.site, graph.sites(), "sites")?;
        let listed = text.edges.is_some();
        let edges = |bond: &text::Bond| {
            let of_kind = || tables.edges_of(bond).map(|(edge, _)| *edge).collect::<Vec<_>>();
            listed.then(of_kind)
        };
        for (bond, tables) in text.bonds.iter().zip(&tables.bonds) {
            if !bond.energy.tables.is_empty() {
                let count = match edges(bond) {
                    Some(edges) => edges.len(),
                    None => {
                        graph.edges_between(&bond.offset, bond.sites).map_err(at(bond.place))?.len()
                    }
                };
                check(&bond.energy, tables, count, "edges of the bond")?;
            }
        }
        Self::build(text, graph, &tables.site, |at, bond| (edges(bond), tables.bonds[at].clone()))
    }

    /// The problem on at most 16 cells an axis, or on as many sites of a graph by edges as a cube of these has. A lattice that has no
    /// more, or a bond too long for the cut, is left whole.
    pub(super) fn cut(text: &text::Lattice, tables: &Contents, whole: &Graph) -> Placed<Self> {
        let shape: Vec<usize> = text.shape.iter().map(|length| (*length).min(CUT)).collect();
        let small =
            if text.edges.is_some() { whole.sites() <= MOST_OF_CUT } else { shape == text.shape };
        let of_edges = |cut: &[usize]| {
            let inside = |edge: &[usize; 2]| edge.iter().all(|site| *site < cut.len());
            let edges: Vec<_> = tables.edges.iter().map(|(edge, _)| *edge).filter(inside).collect();
            Graph::from_edges(cut.len(), &edges).map_err(at(text.place))
        };
        let cut = match small {
            true => return Self::whole(text, tables),
            false if text.edges.is_some() => (0..MOST_OF_CUT).collect(),
            false => places(&text.shape, &shape, whole.cell()),
        };
        let graph = if text.edges.is_some() { of_edges(&cut)? } else { graph(text, &shape)? };
        let pick =
            |table: &Vec<f64>, places: &[usize]| places.iter().map(|at| table[*at]).collect();
        let site: Vec<Vec<f64>> = tables.site.iter().map(|table| pick(table, &cut)).collect();
        let cells = |sites: [usize; 2], edge: &[usize; 2]| (edge[0] - sites[0]) / whole.cell();
        let bonds = |number: usize, bond: &text::Bond| {
            let own = &tables.bonds[number];
            if text.edges.is_some() {
                let inside = tables
                    .edges_of(bond)
                    .enumerate()
                    .filter(|(_, (edge, _))| edge.iter().all(|s| *s < cut.len()));
                let (places, edges): (Vec<usize>, Vec<_>) =
                    inside.map(|(at, (edge, _))| (at, *edge)).unzip();
                return (Some(edges), own.iter().map(|table| pick(table, &places)).collect());
            }
            if own.is_empty() {
                return (None, Vec::new());
            }
            // Each cell has one edge of a bond at most.
            let edges =
                |graph: &Graph| graph.edges_between(&bond.offset, bond.sites).unwrap_or_default();
            let mut number = vec![0; whole.sites() / whole.cell()];
            for (at, edge) in edges(whole).iter().enumerate() {
                number[cells(bond.sites, edge)] = at;
            }
            let place = |edge: &[usize; 2]| number[cells(bond.sites, &[cut[edge[0]], 0])];
            let places: Vec<usize> = edges(&graph).iter().map(place).collect();
            (None, own.iter().map(|table| pick(table, &places)).collect())
        };
        match Self::build(text, graph.clone(), &site, bonds) {
            Ok(problem) => Ok(Self { cut: Some(cut), ..problem }),
            Err(_) => Self::whole(text, tables),
        }
    }

    /// The energy on a graph, by the tables of sites, and the edges and tables of each bond.
    fn build(
        text: &text::Lattice,
        graph: Graph,
        of_sites: &[Vec<f64>],
        bond: impl Fn(usize, &text::Bond) -> (Option<Vec<[usize; 2]>>, Vec<Vec<f64>>),
    ) -> Placed<Self> {
        let sites = graph.sites();
        let mut lattice = Lattice::new(graph);
        let (mut functions, mut driven) = (Vec::new(), Driven::new());
        for term in &text.site.terms {
            let (field, square) = (Vector3::from(term.field), matrix(&term.matrix));
            lattice = match term.varies {
                [_, true] => {
                    driven.push((term.clone(), text.site.tables.len()));
                    Ok(lattice)
                }
                [true, false] => lattice.site_each(&factors(term, of_sites, sites), field, square),
                [false, false] => lattice.site(field, square),
            }
            .map_err(at(text.place))?;
        }
        if !driven.is_empty() {
            let driven = driven.clone();
            lattice = lattice.driven(move |time| field(&driven, time));
        }
        if let Some(damping) = &text.damping {
            let damping = from_fn(|axis| damping.get(axis).copied().unwrap_or(0.0));
            lattice = lattice.damped(damping).map_err(at(text.place))?;
        }
        if let Some((program, slots)) = text.velocity.clone() {
            let tables = of_sites.to_vec();
            lattice = lattice.moved(move |time, site, spin, omega| {
                let tables = tables.iter().map(|table| table[site]);
                let numbers = spin.into_iter().chain(omega).chain(tables).chain([time]);
                let found = program.run(&numbers.collect::<Vec<_>>(), &slots);
                from_fn(|axis| found.get(axis).copied().unwrap_or(f64::NAN))
            });
        }
        let mut function = |energy: &Interaction, sites: Vec<usize>, spins: usize| {
            if let Some(function) = &energy.function {
                let (programs, slots) = (**function).clone();
                functions.push(Cluster { sites, spins, programs, slots });
            }
        };
        function(&text.site, (0..sites).collect(), 1);
        for (number, own) in text.bonds.iter().enumerate() {
            let refuse = at(own.place);
            let (edges, tables) = bond(number, own);
            for term in &own.energy.terms {
                let matrix = matrix(&term.matrix);
                let factors = |count: usize| factors(term, &tables, count);
                lattice = match (&edges, term.varies[0]) {
                    (Some(edges), true) => lattice.edges_each(edges, matrix, factors(edges.len())),
                    (Some(edges), false) => lattice.edges(edges, matrix),
                    (None, true) => {
                        let count = tables.first().map_or(0, Vec::len);
                        lattice.bond_each(&own.offset, own.sites, matrix, factors(count))
                    }
                    (None, false) => lattice.bond_between(&own.offset, own.sites, matrix),
                }
                .map_err(&refuse)?;
            }
            if own.energy.function.is_some() {
                let edges =
                    edges.map_or_else(|| lattice.graph().edges_between(&own.offset, own.sites), Ok);
                function(&own.energy, edges.map_err(&refuse)?.into_flattened(), 2);
            }
        }
        let moved = [text.damping.is_some(), text.velocity.is_some()];
        Ok(Self { lattice, functions, driven, moved, cut: None })
    }

    /// The reason why rotations cannot make its steps, if there is one.
    pub(super) fn is_beyond_rotations(&self) -> Option<&'static str> {
        match (self.functions.is_empty(), self.moved) {
            (true, [false, false]) => None,
            (false, _) => Some(
                "rotations are of energies of degree two, a·M b of bonds and f·s + s·A s of sites, and one here is none",
            ),
            _ => {
                Some("rotations are of the energy alone, and damping or a velocity acts beside it")
            }
        }
    }

    /// True if its steps depend on the time.
    pub(super) fn is_timed(&self) -> bool {
        !self.driven.is_empty() || self.moved[1]
    }

    /// The energy at a time.
    pub(super) fn energy(&self, time: f64, spins: &[[f64; 3]]) -> Result<f64, LatticeError> {
        let mut energy = self.lattice.energy(spins)?;
        if !self.driven.is_empty() {
            let total = self.lattice.total_spin(spins)?;
            let field = field(&self.driven, time);
            energy += (0..3).map(|axis| field[axis] * total[axis]).sum::<f64>();
        }
        let functions = self.functions.iter().map(|function| function.run(0, spins));
        Ok(energy + functions.flatten().sum::<f64>())
    }

    /// The largest |∂H/∂s| of a site, or 1 where there is none.
    pub(super) fn speed(&self, time: f64, spins: &Spins) -> Result<f64, LatticeError> {
        let mut gradient = self.lattice.gradient(spins)?;
        self.further(spins, &mut gradient);
        let field = Vector3::from(field(&self.driven, time));
        let speeds = gradient.iter().map(|rate| (Vector3::from(*rate) + field).norm());
        let most = speeds.fold(0.0, f64::max);
        Ok(if most > 0.0 && most.is_finite() { most } else { 1.0 })
    }

    /// Adds ∂H/∂s of the energies that are no quadratic forms.
    fn further(&self, spins: &[[f64; 3]], out: &mut [[f64; 3]]) {
        for function in &self.functions {
            let gradient = function.run(1, spins);
            let width = 3 * function.spins;
            for (row, own) in gradient.chunks(width).enumerate() {
                for (at, rate) in own.chunks(3).enumerate() {
                    let sum = &mut out[function.sites[row * function.spins + at]];
                    (0..3).for_each(|axis| sum[axis] += rate[axis]);
                }
            }
        }
    }

    /// Steps of this size.
    pub(super) fn steps(
        &self,
        method: Algorithm,
        step: f64,
    ) -> Result<Box<dyn Evolve + '_>, LatticeError> {
        match method {
            Algorithm::Rotations(family, order) => {
                Ok(Box::new(self.lattice.rotations(family, order, step)?))
            }
            Algorithm::Gauss(1) => self.gauss::<1>(step),
            Algorithm::Gauss(2) => self.gauss::<2>(step),
            Algorithm::Gauss(3) => self.gauss::<3>(step),
            Algorithm::Gauss(_) => self.gauss::<4>(step),
        }
    }

    fn gauss<const M: usize>(&self, step: f64) -> Result<Box<dyn Evolve + '_>, LatticeError> {
        let gradient = |spins: &[[f64; 3]], out: &mut [[f64; 3]]| {
            out.fill([0.0; 3]);
            self.further(spins, out);
        };
        let gradient = (!self.functions.is_empty()).then_some(gradient);
        Ok(Box::new(self.lattice.gauss_with::<M, _>(step, gradient)?))
    }
}

/// Steps of one size.
pub(super) trait Evolve {
    /// Advances spins by some steps from this time on.
    fn advance(&mut self, spins: &mut Spins, time: f64, steps: u64) -> Result<(), LatticeError>;

    /// Makes what comes by the state alone.
    fn forget(&mut self) {}
}

impl Evolve for RotationStep {
    fn advance(&mut self, spins: &mut Spins, time: f64, steps: u64) -> Result<(), LatticeError> {
        self.advance_from(spins, time, steps)
    }
}

impl<const M: usize, F: Fn(&[[f64; 3]], &mut [[f64; 3]])> Evolve for GaussStep<M, F> {
    fn forget(&mut self) {
        self.forget();
    }

    fn advance(&mut self, spins: &mut Spins, time: f64, steps: u64) -> Result<(), LatticeError> {
        self.advance_from(spins, time, steps)
    }
}

/// The graph of a text with this shape.
fn graph(text: &text::Lattice, shape: &[usize]) -> Placed<Graph> {
    let graph = match (text.kind, shape) {
        ("triangular", &[a, b]) => Graph::triangular([a, b]),
        ("honeycomb", &[a, b]) => Graph::honeycomb([a, b]),
        ("kagome", &[a, b]) => Graph::kagome([a, b]),
        (_, &[a]) => Graph::chain(a),
        (_, &[a, b]) => Graph::square([a, b]),
        (_, &[a, b, c]) => Graph::cubic([a, b, c]),
        // The reader has seen to the number of axes.
        _ => Err(LatticeError::NoEdges),
    };
    let boundary = |open: &bool| if *open { Boundary::Open } else { Boundary::Periodic };
    let boundary: Vec<Boundary> = text.open.iter().map(boundary).collect();
    graph.and_then(|graph| graph.bounded(&boundary)).map_err(at(text.place))
}

/// The sites of the whole lattice that are in a corner of this shape.
fn places(whole: &[usize], shape: &[usize], cell: usize) -> Vec<usize> {
    let count: usize = shape.iter().product();
    let place = |mut number: usize| {
        let (mut place, mut stride) = (0, 1);
        for (own, all) in shape.iter().zip(whole).rev() {
            place += number % own * stride;
            number /= own;
            stride *= all;
        }
        place
    };
    (0..count).flat_map(|at| (0..cell).map(move |site| place(at) * cell + site)).collect()
}

/// The spins at the start.
pub(super) fn start(
    files: Files<'_>,
    text: &text::Lattice,
    graph: &Graph,
) -> Result<Spins, StartError> {
    let sites = graph.sites();
    let start = text.start.as_ref().ok_or(StartError::Missing)?;
    let spins: Spins = match start {
        Start::Table(file) => {
            let (shape, numbers) = numbers(files, file).map_err(StartError::Misplaced)?;
            if shape.last() != Some(&3) || numbers.len() != 3 * sites {
                let what = format!(
                    "{} has the shape {shape:?}, and the lattice {sites} sites: write ({sites}, 3)",
                    file.path
                );
                return Err(StartError::Misplaced(Misplaced(file.place, what)));
            }
            numbers.as_chunks::<3>().0.to_vec()
        }
        Start::Random(seed) => (0..sites as u64).map(|site| random(*seed, site)).collect(),
        Start::Formulas(formulas) => {
            let cell = graph.cell();
            let number = |row: usize, input: usize| match input {
                3 => (row % cell) as f64,
                4 => 0.0,
                axis => {
                    let faster: usize =
                        graph.shape()[(axis + 1).min(graph.shape().len())..].iter().product();
                    let length = graph.shape().get(axis).copied().unwrap_or(1);
                    (row / cell / faster % length) as f64
                }
            };
            let columns: Vec<Vec<f64>> = formulas
                .iter()
                .map(|(program, slots)| program.run_each(sites, number, slots))
                .collect();
            (0..sites).map(|site| [0, 1, 2].map(|axis| columns[axis][site])).collect()
        }
    };
    match spins.iter().position(|spin| spin.iter().any(|x| !x.is_finite())) {
        Some(site) => {
            let what = format!("[initial] momentum: the spin of site {site} is not finite");
            Err(StartError::Misplaced(Misplaced(text.place, what)))
        }
        None => Ok(spins),
    }
}

/// A start that cannot be made.
pub(super) enum StartError {
    Missing,
    Misplaced(Misplaced),
}

impl StartError {
    pub(super) fn placed(self, system: &Path, at: impl Fn(Misplaced) -> RunError) -> RunError {
        match self {
            Self::Misplaced(mistake) => at(mistake),
            Self::Missing => RunError::Missing {
                file: system.into(),
                key: "[initial] momentum",
                example: "momentum = { table = \"spins.npy\" }",
                option: "another file",
            },
        }
    }
}

/// A unit vector for a site, evenly distributed, by roots alone: the same bits on every machine.
///
/// Numbers from −1 to 1 are those of SplitMix64 for the states G·(G·seed + 2³²·site + k), k = 1, 2, …, G = 2⁶⁴/φ. The first pair
/// (u, v) of them in the unit disc, r = u² + v², makes the vector (2u√(1 − r), 2v√(1 − r), 1 − 2r): G. Marsaglia, Ann. Math. Statist.
/// 43 (1972) 645–646.
fn random(seed: u64, site: u64) -> [f64; 3] {
    const GOLDEN: u64 = 0x9e37_79b9_7f4a_7c15;
    let number = |k: u64| {
        let mut z =
            seed.wrapping_mul(GOLDEN).wrapping_add(site << 32).wrapping_add(k).wrapping_mul(GOLDEN);
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 * 2.0_f64.powi(-52) - 1.0
    };
    let mut k = 1;
    loop {
        let [u, v] = [number(k), number(k + 1)];
        let r = u * u + v * v;
        if r < 1.0 {
            let factor = 2.0 * (1.0 - r).sqrt();
            return [u * factor, v * factor, 1.0 - 2.0 * r];
        }
        k += 2;
    }
}
