//! The table `[lattice]`: spins on a graph, whose energy is one of each site and one of each bond.

use coadjoint_program::{Graph, Program};
use toml::de::{DeTable, DeValue};

use super::drive::{VELOCITY, damping, list};
use super::options::Options;
use super::parameters::Parameters;
use super::run::{self, Run};
use super::table::{Table, Value, span};
use super::{name, read_by};
use crate::diagnostic::{Diagnostics, Mistake, Span, nearest};
use crate::expr::{Arena, ParameterExpr};
use crate::lie::catalogue;
use crate::number::{Rational, nearest_float};
use crate::parse::{Name, Names, text};
use crate::pass::{Choice, OfSites, function, of_sites};
use crate::poly::split_at;
use crate::problem::{Parameter, Shape, Symbol};

const SHAPE: &str = "shape = [64, 64, 64]";
const KIND: &str = "kind = \"kagome\"";
const BOUNDARY: &str = "boundary = \"periodic\"";
const SITE: &str = "site = \"D*z^2 - B*z\"";
const BOND: &str = "[[lattice.bond]] with offset = [1, 0, 0] and energy = \"-J*dot(a, b)\"";
const OFFSET: &str = "offset = [1, 0, 0]";
const ENERGY: &str = "energy = \"-J*dot(a, b)\"";
const MATRIX: &str = "matrix = [[-1, 0, 0], [0, -1, 0], [0, 0, -1]]";
const EDGES: &str = "edges = \"edges.npy\"";
const TABLE: &str = "D = { table = \"D.npy\" }";
const MOMENTUM: &str = "momentum = { table = \"spins.npy\" }";
/// Steps have order 8 at most.
const MOST_TRUNCATION: usize = 7;
const SITES: &str = "sites = [0, 17]";
const SEED: &str = "seed = 1";

/// Spins on a graph and a run of them, as a file describes them.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// The name of the system.
    pub name: String,
    /// Cells along each axis; empty where the graph is by edges.
    pub shape: Vec<usize>,
    /// The kind of the lattice, `cubic` in one to three dimensions, `triangular`, `honeycomb` or `kagome`.
    pub kind: &'static str,
    /// The axes that are open.
    pub open: Vec<bool>,
    /// The file of edges, in place of a shape.
    pub edges: Option<File>,
    /// The place of the shape or the edges.
    pub place: Span,
    /// The energy of a site; its tables have one number a site.
    pub site: Interaction,
    /// The bonds.
    pub bonds: Vec<Bond>,
    /// The diagonal of Γ of the velocity Γ (s × ω) of damping, ω = ∂H/∂s.
    pub damping: Option<Vec<f64>>,
    /// The velocity of a site beside ω: a program of its spin, of ω, of the tables of sites and the time, with its slots.
    pub velocity: Option<(Program, Vec<f64>)>,
    /// The step is by rotations of this family, or by collocation; `auto` where nothing is asked for.
    pub splitting: &'static str,
    /// The truncation K asked for: steps have order K + 1.
    pub truncation: Option<usize>,
    /// The spins at the start.
    pub start: Option<Start>,
    /// The step or the tolerance, the duration, and what is recorded.
    pub run: Run,
    /// The numbers of the sites whose spins are recorded.
    pub sites: Vec<usize>,
    /// The names of the coordinates of a spin.
    pub coordinates: [String; 3],
}

/// A file of an array, with its place in the text.
#[derive(Clone, Debug)]
pub struct File {
    /// The name, relative to the system file.
    pub path: String,
    /// The place of the name.
    pub place: Span,
}

/// The spins at the start.
#[derive(Clone, Debug)]
pub enum Start {
    /// An array (sites, 3).
    Table(File),
    /// Unit vectors in all directions.
    Random(u64),
    /// Programs of the place i, j, k of a cell and the number s of a site in it, with their slots.
    Formulas(Vec<(Program, Vec<f64>)>),
}

/// Edges with an energy.
#[derive(Clone, Debug)]
pub struct Bond {
    /// The offset of the cell of b from that of a; none of edges in a file.
    pub offset: Vec<isize>,
    /// The sites of the cells.
    pub sites: [usize; 2],
    /// The type of the edges of a file, where they have types.
    pub kind: Option<usize>,
    /// The energy; its tables have one number an edge.
    pub energy: Interaction,
    /// The place of the bond.
    pub place: Span,
}

/// An energy of a site s, or of two sites a and b.
#[derive(Clone, Debug, Default)]
pub struct Interaction {
    /// Quadratic forms, with their factors.
    pub terms: Vec<Coupling>,
    /// The part that is no quadratic form: its value, its gradient, and their slots.
    pub function: Option<Box<([Program; 2], Vec<f64>)>>,
    /// The tables that factors are made of.
    pub tables: Vec<File>,
}

/// factor·(f·s + s·M s) of a site, or factor·a·M b of two.
#[derive(Clone, Debug, Default)]
pub struct Coupling {
    /// The factor: a product of powers of expressions in tables, and in the time after them. Empty for 1.
    pub factor: Vec<(ParameterExpr, u32)>,
    /// True if the factor depends on tables, and on time.
    pub varies: [bool; 2],
    /// f; zero of a bond.
    pub field: [f64; 3],
    /// M.
    pub matrix: [[f64; 3]; 3],
}

impl Coupling {
    /// The factor, for the numbers of tables with the time after them.
    #[must_use]
    pub fn factor(&self, numbers: &[f64]) -> f64 {
        self.factor.iter().map(|(own, power)| own.evaluate(numbers).powi(*power as i32)).product()
    }
}

impl Lattice {
    /// The mistake of something that shows only when the graph and the tables are there.
    #[must_use]
    pub fn mistake(place: Span, what: &str) -> Diagnostics {
        let diagnostics = Diagnostics::new();
        diagnostics.report(place, Mistake::Other(what.to_owned(), None));
        diagnostics
    }
}

/// Reads the text of a system file that has a table `[lattice]`; `None` of any other.
///
/// # Errors
/// All mistakes, each at its place in `text`.
pub fn read_lattice(text: &str) -> Result<Option<Lattice>, Diagnostics> {
    read_by(text, |document, diagnostics| match document.contains_key("lattice") {
        true => system(document, text, diagnostics).map(Some),
        false => Some(None),
    })
}

fn system(document: &DeTable<'_>, text: &str, diagnostics: &Diagnostics) -> Option<Lattice> {
    let nothing = Names::default();
    let root = Table::root(document, text, &nothing, diagnostics);
    let numbers = Parameters::read_those(&root, Options::default(), &[], |value| !value.is_table());
    let root = root.with(&numbers.constants);
    root.check_keys(&[
        "name",
        "group",
        "coordinates",
        "parameters",
        "lattice",
        "damping",
        "velocity",
        "integrator",
        "initial",
        "run",
    ]);
    match root.string("group", "group = \"SO3\"") {
        Some((group, place)) if group != "SO3" => {
            root.refuse(
                place,
                "the sites of a lattice are spins: the group is SO3",
                "group = \"SO3\"",
            );
        }
        None if !root.has("group") => root.missing("group", "group = \"SO3\""),
        _ => {}
    }
    let coordinates = coordinates(&root);
    let lattice = root.table("lattice")?;
    lattice.check_keys(&["shape", "kind", "boundary", "edges", "site", "bond"]);
    let edges = lattice.string("edges", EDGES);
    let edges = edges.map(|(path, place)| File { path: path.to_owned(), place });
    let (shape, kind, place) = match &edges {
        Some(edges) => {
            for key in ["shape", "kind", "boundary"].into_iter().filter(|key| lattice.has(key)) {
                let what = format!("`{key}` and `edges` are both given: edges have no cells");
                lattice.refuse(edges.place, &what, EDGES);
            }
            (Vec::new(), "edges", edges.place)
        }
        None => shape(&lattice),
    };
    let open = if edges.is_none() { boundary(&lattice, shape.len()) } else { Vec::new() };
    let own = tables(&root);
    let site = match lattice.string("site", SITE) {
        Some(_) => {
            let spin = [("", &coordinates), ("s", &coordinates)];
            energy(&lattice, "site", SITE, &spin, &own).unwrap_or_default()
        }
        None => Interaction { tables: files(&own), ..Interaction::default() },
    };
    let damping = damping(&root, catalogue::lookup("SO3").ok().as_ref());
    let damping =
        damping.map(|rates| rates.iter().map(|rate| nearest_float(&rate.value)).collect());
    let damping = damping.filter(|rates: &Vec<f64>| rates.iter().any(|rate| *rate > 0.0));
    let velocity = velocity(&root, &coordinates, &own);
    let mut bonds = Vec::new();
    if let Some((list, _)) = lattice.array("bond", BOND) {
        for value in list {
            let Some(table) = lattice.entry("lattice.bond", value, BOND) else { continue };
            bonds.extend(bond(&table, edges.is_some(), &coordinates));
        }
    }
    let still = bonds.is_empty() && site.terms.is_empty() && site.function.is_none();
    if still && !root.has("velocity") {
        let what = "[lattice] has no energy: neither `site` nor a bond";
        lattice.refuse(lattice.span, what, BOND);
    }
    let integrator = root.table("integrator");
    let run = run::read(&root, integrator.as_ref(), &["sites"]);
    let recorded = root.table("run");
    let sites = recorded.as_ref().and_then(|run| run.array("sites", SITES)).map(|(list, _)| list);
    let number = |value: &&Value<'_>| whole(recorded.as_ref()?, ("sites", SITES), value);
    let sites = sites.unwrap_or_default().iter().filter_map(number).collect();
    let (splitting, truncation) = integrator.map_or(("auto", None), |table| method(&table));
    let mut lattice = Lattice {
        name: name(&root),
        shape,
        kind,
        open,
        edges,
        place,
        site,
        bonds,
        damping,
        velocity,
        splitting,
        truncation,
        start: None,
        run,
        sites,
        coordinates,
    };
    if let Some(initial) = root.table("initial") {
        initial.check_keys(&["momentum", "seed", "time"]);
        lattice.run.initial_time = initial.number("time", "time = 5.0").map_or(0.0, |(t, _)| t);
        lattice.start = start(&initial);
    }
    Some(lattice)
}

/// The names of the three coordinates of a site.
fn coordinates(root: &Table<'_>) -> [String; 3] {
    const COORDINATES: &str = "coordinates = [\"x\", \"y\", \"z\"]";
    let default = ["x", "y", "z"].map(str::to_owned);
    let Some((list, whole)) = root.names("coordinates", COORDINATES) else { return default };
    // A name that is none, or is there twice, is a mistake.
    Names::of_coordinates(&list, root.diagnostics);
    let names: Vec<String> = list.into_iter().map(|(name, _)| name).collect();
    names.try_into().unwrap_or_else(|names: Vec<String>| {
        root.diagnostics.report(whole, Mistake::Dimension(names.len(), "SO3".to_owned(), 3));
        default
    })
}

/// The kinds of lattices, and the axes of each; 0 for one to three.
const KINDS: [(&str, usize); 4] =
    [("cubic", 0), ("triangular", 2), ("honeycomb", 2), ("kagome", 2)];

/// One of several names, the first if none is given.
fn one_of<const N: usize>(table: &Table<'_>, key: &str, names: [&'static str; N]) -> &'static str {
    let example = format!("{key} = \"{}\"", names[0]);
    let Some((given, place)) = table.string(key, &example) else { return names[0] };
    names.into_iter().find(|name| *name == given).unwrap_or_else(|| {
        let did = nearest(given, names).map(|near| format!("; did you mean `{near}`?"));
        let what = format!("unknown {key} `{given}`{}", did.unwrap_or_default());
        table.diagnostics.report_other(place, what, &format!("there are {}", names.join(", ")));
        names[0]
    })
}

/// The shape, the kind and the place of the shape.
fn shape(lattice: &Table<'_>) -> (Vec<usize>, &'static str, Span) {
    let kind = one_of(lattice, "kind", KINDS.map(|(name, _)| name));
    let Some((list, place)) = lattice.array("shape", SHAPE) else {
        if !lattice.has("shape") {
            lattice.missing("shape", &format!("{SHAPE}, or {EDGES}"));
        }
        return (Vec::new(), kind, lattice.span);
    };
    let shape: Vec<usize> =
        list.iter().filter_map(|value| whole(lattice, ("shape", SHAPE), value)).collect();
    let axes = KINDS.iter().find(|(name, _)| *name == kind).map_or(0, |(_, axes)| *axes);
    if !(axes == list.len() || axes == 0 && (1..=3).contains(&list.len())) {
        let needed =
            if axes == 0 { "one to three axes".to_owned() } else { format!("{axes} axes") };
        let what = format!("`shape` has {} lengths: a {kind} lattice has {needed}", list.len());
        lattice.refuse(place, &what, if axes == 0 { SHAPE } else { KIND });
    }
    (shape, kind, place)
}

/// A whole number from 0.
fn whole(table: &Table<'_>, (key, example): (&str, &str), value: &Value<'_>) -> Option<usize> {
    let found = integer(value).and_then(|n| usize::try_from(n).ok());
    if found.is_none() {
        table.wrong_kind(key, "whole numbers from 0", value, example);
    }
    found
}

fn integer(value: &Value<'_>) -> Option<isize> {
    match value.get_ref() {
        DeValue::Integer(n) => isize::from_str_radix(n.as_str(), n.radix()).ok(),
        _ => None,
    }
}

/// The axes that are open, by one word or one an axis.
fn boundary(lattice: &Table<'_>, axes: usize) -> Vec<bool> {
    if !lattice.get("boundary").is_some_and(|value| value.get_ref().is_array()) {
        return vec![one_of(lattice, "boundary", ["periodic", "open"]) == "open"; axes];
    }
    let Some((list, place)) = lattice.strings("boundary", "a list of words", BOUNDARY) else {
        return vec![false; axes];
    };
    let words = list.iter().all(|(word, _)| ["periodic", "open"].contains(&&**word));
    if !words || list.len() != axes {
        let what =
            format!("`boundary` is periodic or open, one word or {axes} in a list, one an axis");
        lattice.refuse(place, &what, BOUNDARY);
    }
    list.iter().map(|(word, _)| word == "open").collect()
}

/// Reads a bond.
fn bond(table: &Table<'_>, listed: bool, coordinates: &[String; 3]) -> Option<Bond> {
    table.check_keys(&["offset", "from", "to", "type", "energy", "matrix", "parameters"]);
    let others: &[&str] = if listed { &["offset", "from", "to"] } else { &["type"] };
    for key in others.iter().filter(|key| table.has(key)) {
        let what = match listed {
            true => format!("`{key}`: a lattice by `edges` has no cells"),
            false => {
                "`type` is one of the edges in a file: without `edges` there is none".to_owned()
            }
        };
        table.refuse(table.span, &what, BOND);
    }
    if !listed && !table.has("offset") {
        table.missing("offset", OFFSET);
    }
    let (offset, _) = table.array("offset", OFFSET).unwrap_or_default();
    let signed = |value: &&Value<'_>| {
        let found = integer(value);
        if found.is_none() {
            table.wrong_kind("offset", "whole numbers", value, OFFSET);
        }
        found
    };
    let offset = offset.iter().map(signed).collect::<Option<_>>();
    let site = |key: &str| table.get(key).map_or(Some(0), |value| whole(table, (key, BOND), value));
    let kind = table.get("type").and_then(|value| whole(table, ("type", BOND), value));
    let numbers = Parameters::read_those(table, Options::default(), &[], |value| !value.is_table());
    let mut constants = numbers.constants.clone();
    constants.include(table.constants);
    let known = table.with(&constants);
    let energy = match (table.get("matrix"), table.has("energy")) {
        (Some(value), false) => {
            let rows = known.matrix("matrix", value, MATRIX)?;
            let square: Option<Vec<[Rational; 3]>> =
                rows.into_iter().map(|row| row.try_into().ok()).collect();
            let Some(Ok([x, y, z])) = square.map(<[[Rational; 3]; 3]>::try_from) else {
                table.refuse(span(value), "`matrix` has three rows of three numbers", MATRIX);
                return None;
            };
            let matrix = [x, y, z].map(|row| row.map(|entry| nearest_float(&entry)));
            Interaction {
                terms: vec![Coupling { matrix, ..Coupling::default() }],
                ..Interaction::default()
            }
        }
        (None, true) => {
            let spins = [("a", coordinates), ("b", coordinates)];
            energy(&known, "energy", ENERGY, &spins, &tables(&known))?
        }
        (matrix, _) => {
            let what = match matrix {
                Some(_) => "`energy` and `matrix` are both given: keep one",
                None => "a bond has neither `energy` nor `matrix`",
            };
            table.refuse(table.span, what, ENERGY);
            return None;
        }
    };
    Some(Bond {
        offset: offset?,
        sites: [site("from")?, site("to")?],
        kind,
        energy,
        place: table.span,
    })
}

/// The tables among the parameters of a file or a bond, with their names.
fn tables(owner: &Table<'_>) -> Vec<(String, File)> {
    let mut found = Vec::new();
    let Some(parameters) = owner.table("parameters") else { return found };
    for (name, place, value) in parameters.entries() {
        let Some(entry) =
            value.get_ref().is_table().then(|| parameters.entry(name, value, TABLE)).flatten()
        else {
            continue;
        };
        entry.check_keys(&["table"]);
        match entry.string("table", TABLE) {
            Some((path, place)) => {
                found.push((name.to_owned(), File { path: path.to_owned(), place }))
            }
            None if !entry.has("table") => {
                owner.refuse(place, &format!("`{name}` names no file"), TABLE)
            }
            None => {}
        }
    }
    found
}

fn files(tables: &[(String, File)]) -> Vec<File> {
    tables.iter().map(|(_, file)| file.clone()).collect()
}

/// Reads `velocity`: expressions in the spin of a site, ω = ∂H/∂s as `omega`, tables and the time.
fn velocity(
    root: &Table<'_>,
    coordinates: &[String; 3],
    tables: &[(String, File)],
) -> Option<(Program, Vec<f64>)> {
    let omega = [0, 1, 2].map(|axis| format!("omega[{axis}]"));
    let own = tables.iter().map(|(name, _)| name.clone());
    let inputs: Vec<String> = coordinates.iter().cloned().chain(omega).chain(own).collect();
    let mut names = Names::default();
    for (at, name) in inputs.iter().enumerate() {
        names.known(name, Name::Coordinate(at));
    }
    for (axis, name) in coordinates.iter().enumerate() {
        names.alias(format!("s.{name}"), Name::Coordinate(axis));
        names.alias(format!("s[{axis}]"), Name::Coordinate(axis));
    }
    names.include(root.constants);
    names.known("t", Name::Time);
    let (texts, place) = list(root, "velocity", VELOCITY, (&names, 3))?;
    if texts.len() != 3 {
        let what = format!("`velocity` has {} components, and a spin 3", texts.len());
        root.refuse(place, &what, VELOCITY);
        return None;
    }
    let mut arena = Arena::new();
    let mut parse = |(own, place): &(String, Span)| {
        text::parse(own, root.offset(*place, own), &[], &names, &mut arena, root.diagnostics)
    };
    let roots: Vec<_> = texts.iter().map(&mut parse).collect();
    function((&arena, &roots), &inputs, root.diagnostics)
}

/// Reads an energy of spins with these names and coordinates, with the tables of its owner.
fn energy(
    table: &Table<'_>,
    key: &str,
    example: &str,
    spins: &[(&str, &[String; 3])],
    tables: &[(String, File)],
) -> Option<Interaction> {
    // A spin without a name is the same one as that after it.
    let alone = spins[0].0.is_empty();
    let mut names = Names::default();
    let mut coordinates = Vec::new();
    for (at, (spin, own)) in spins.iter().enumerate() {
        for (axis, name) in own.iter().enumerate() {
            let coordinate = Name::Coordinate(if alone { axis } else { 3 * at + axis });
            let full = if spin.is_empty() { name.clone() } else { format!("{spin}.{name}") };
            if !(alone && at > 0) {
                names.known(&full, coordinate.clone());
                coordinates.push(full.clone());
            }
            names.alias(full, coordinate.clone());
            names.alias(format!("{spin}[{axis}]"), coordinate);
        }
    }
    let numbers = tables.iter().map(|(name, _)| name.as_str()).chain(["t"]);
    let mut parameters = Vec::new();
    for (at, name) in numbers.clone().enumerate() {
        let place = tables.get(at).map_or(Span::Whole, |(_, file)| file.place);
        if name == "t" {
            // Anything else called t comes first.
            names.include(table.constants);
            names.known("t", Name::Parameter(at));
        } else {
            names.add(name, Name::Parameter(at), place, table.diagnostics);
        }
        parameters.push(Parameter { name: name.to_owned(), shape: Shape::Scalar, default: None });
    }
    let found = table.energy(key, example, &names, parameters)?;
    let (_, place) = found.root?;
    let refuse = |what: &str| table.refuse(place, what, example);
    let files = files(tables);
    let depends = |symbol: &Symbol| {
        // What depends on a number that is none is none.
        let all = |of_tables: f64, time: f64| {
            let numbers = [vec![of_tables; files.len()], vec![time]].concat();
            symbol.expr.evaluate(&numbers).is_nan()
        };
        [all(f64::NAN, 1.0), all(1.0, f64::NAN)]
    };
    match of_sites(&found, &coordinates, table.diagnostics)? {
        OfSites::Quadratic(polynomial, symbols) => {
            let mut terms: Vec<Coupling> = Vec::new();
            for (factors, value) in polynomial.factors() {
                let (own, factors) = split_at(&factors, coordinates.len());
                let mut term = Coupling::default();
                let mut value = nearest_float(&value);
                for &(variable, power) in factors {
                    let symbol = &symbols[variable as usize - coordinates.len()];
                    let depends = depends(symbol);
                    if depends == [false; 2] {
                        value *= symbol.expr.evaluate(&[]).powi(power as i32);
                        continue;
                    }
                    term.varies = [0, 1].map(|i| term.varies[i] || depends[i]);
                    term.factor.push((symbol.expr.clone(), power));
                }
                let at = terms.iter().position(|other| other.factor == term.factor);
                let at = at.unwrap_or_else(|| {
                    terms.push(term);
                    terms.len() - 1
                });
                let Coupling { field, matrix, .. } = &mut terms[at];
                match *own {
                    [] => {}
                    [(i, 1)] if alone => field[i as usize] += value,
                    [(i, 2)] if alone => matrix[i as usize][i as usize] += value,
                    [(i, 1), (j, 1)] if alone => {
                        matrix[i as usize][j as usize] += 0.5 * value;
                        matrix[j as usize][i as usize] += 0.5 * value;
                    }
                    [(i @ 0..3, 1), (j @ 3..6, 1)] => matrix[i as usize][j as usize - 3] += value,
                    _ => {
                        let what = "the energy of a bond has both of its spins in each term: that of one spin is given by `site`";
                        refuse(what);
                        return None;
                    }
                }
            }
            let held = |term: &Coupling| alone && !term.varies[0] && term.matrix == [[0.0; 3]; 3];
            if terms.iter().any(|term| term.varies[1] && !held(term)) {
                refuse(
                    "`t` stands in the field on all sites alone, as in -B*cos(t)*z: not in a bond, before a square, nor beside a \
                     table",
                );
                return None;
            }
            Some(Interaction { terms, function: None, tables: files })
        }
        OfSites::Programs(programs, symbols) => {
            if symbols.iter().any(|symbol| depends(symbol) != [false; 2]) {
                refuse(
                    "an energy with tables or the time in it is of degree two in the spins, whose coefficients they are",
                );
                return None;
            }
            let slots = symbols.iter().map(|symbol| symbol.expr.evaluate(&[])).collect();
            let function = Some(Box::new((*programs, slots)));
            Some(Interaction { terms: Vec::new(), function, tables: files })
        }
    }
}

/// The family of rotations, `collocation` or `auto`, and the truncation.
fn method(table: &Table<'_>) -> (&'static str, Option<usize>) {
    table.check_keys(&["step", "tolerance", "splitting", "method", "truncation"]);
    let splitting = one_of(table, "splitting", ["auto", "axes", "bonds", "sublattices"]);
    let method = one_of(table, "method", ["splitting", "collocation"]);
    if let (true, Some((_, place))) = (table.has("splitting"), table.string("method", ""))
        && method == "collocation"
    {
        table.refuse(
            place,
            "`method` and `splitting` are both given: keep one",
            "splitting = \"auto\"",
        );
    }
    let splitting = if method == "collocation" { method } else { splitting };
    let mut choice = Choice::default();
    let given = table.integer("truncation", "truncation = 5");
    let Some((k, place)) = given else { return (splitting, None) };
    choice.set_truncation(k, place, table.diagnostics);
    if k > MOST_TRUNCATION {
        table.diagnostics.report(place, Mistake::TruncationLarge(k, MOST_TRUNCATION));
    }
    (splitting, choice.truncation)
}

/// The spins at the start.
fn start(initial: &Table<'_>) -> Option<Start> {
    let value = initial.get("momentum")?;
    match value.get_ref() {
        DeValue::Table(_) => {
            let table = initial.entry("initial.momentum", value, MOMENTUM)?;
            table.check_keys(&["table"]);
            let file = table.string("table", MOMENTUM);
            if !table.has("table") {
                table.missing("table", MOMENTUM);
            }
            file.map(|(path, place)| Start::Table(File { path: path.to_owned(), place }))
        }
        DeValue::String(word) if word == "random" => {
            if !initial.has("seed") {
                initial.missing("seed", SEED);
            }
            Some(Start::Random(initial.integer("seed", SEED)?.0 as u64))
        }
        DeValue::Array(list) if list.len() == 3 => {
            let inputs = ["i", "j", "k", "s"].map(str::to_owned);
            let mut names = Names::default();
            for (at, name) in inputs.iter().enumerate() {
                names.known(name, Name::Coordinate(at));
            }
            names.include(initial.constants);
            let formula = |value: &Value<'_>| {
                let DeValue::String(text) = value.get_ref() else {
                    let number = nearest_float(&initial.exact("momentum", value, MOMENTUM)?);
                    let graph = Graph::new();
                    let number = graph.constant(number);
                    return Some((graph.finish(inputs.len(), &[number]), Vec::new()));
                };
                let formula = initial.formula(text, span(value), &names);
                let (root, _) = formula.root?;
                function((&formula.arena, &[root]), &inputs, initial.diagnostics)
            };
            list.iter().map(formula).collect::<Option<Vec<_>>>().map(Start::Formulas)
        }
        _ => {
            let expected = "{ table = \"spins.npy\" }, \"random\", or three formulas in i, j, k";
            initial.wrong_kind("momentum", expected, value, MOMENTUM);
            None
        }
    }
}
