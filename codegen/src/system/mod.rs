//! System files: a Lie–Poisson system and a run of it, in TOML.
//!
//! ```toml
//! name = "rigid-body"
//! group = "SO3"
//! coordinates = ["x", "y", "z"]
//! hamiltonian = "x^2/(2*I1) + y^2/(2*I2) + z^2/(2*I3)"
//! [parameters]
//! I1 = 1.5
//! I2 = 2.0
//! I3 = "5/2"
//! [integrator]
//! truncation = 7
//! chart = "exp"
//! step = 0.1
//! [initial]
//! momentum = [2.0, 0.5, 1.0]
//! [run]
//! time = 100.0
//! ```
//!
//! Instead of `step`, `tolerance = 1e-9` asks for an error at the end of the run; `truncation` is
//! then picked too unless it is given. `region = 2.5` (a norm of the momentum, or [low, high] for each
//! coordinate) says where it is to hold; without it, along the run from the initial state.
//!
//! In `[integrator]`, `method` is `series` or `collocation` (the default for a Hamiltonian that is no polynomial), `solver` is `newton` or `fixed_point`, and `frame = "comoving"` leaves what is
//! uniform in the motion (the precession in a field, the spin of a symmetric body, multiples of Casimirs) out of the
//! series and lets it follow each step (see [`crate::comoving`]); without `frame`, where a field is such a part or steps
//! that meet a tolerance are cheaper. For a power such as SO3^64, coordinates and
//! momentum may be given for one copy: `x` then stands for `x[0]`, `x[1]`, …, the momentum may be
//! expressions in the copy's number `i`, and `sum(i, 0..64, x[i]*x[(i + 1) % 64])` is a sum over copies.
//!
//! Numbers are read from their decimals, so `0.1` is exactly 1/10. Instead of `group`, an
//! `[algebra]` table gives a `basis` of matrices, or `generators` and `brackets`.
//!
//! `[units]` gives the units that plots and reports show: `time = "s"`, `momentum = "kg m²/s"`, or one for a
//! coordinate by its name. Nothing is computed with them.
//!
//! A force that breaks the symmetry is a `potential = "…"`, a polynomial in the entries `g[0][0]`, …
//! of the group element's matrix; its kicks are composed by the `splitting` of `[integrator]`. A `velocity`, a `torque` and `damping` act
//! within the step, as a potential beside them does, and one that depends on time or inputs. `velocity_in_space` and
//! `torque_in_space` are along the axes of space.
//!
//! `t` in the Hamiltonian is the time. `[inputs]` has functions of it by their values, `u = [0, 0.5, 0.2, 0]` at `times = [0, 1, 2, 3]`,
//! between which they are cubic splines.
//!
//! Each `[[event]]` has a function of the state, `when = "g[2][2]"`, in the momentum, the entries of g and the time t: a run
//! finds where it changes its sign, in the `direction` up, down or both, and ends there with `stop = true`.

mod algebra;
mod definitions;
mod drive;
mod energies;
mod event;
mod initial;
mod inputs;
pub mod lattice;
mod options;
mod parameters;

mod project;
mod run;
mod splitting;
mod table;
mod units;

use toml::de::DeTable;

use crate::diagnostic::{Diagnostics, Mistake, Span, unclosed_quote};
use crate::drive::Drive;
use crate::lie::{LieAlgebra, catalogue};
use crate::parse::Names;
use crate::pass::{
    Choice, Draft, Formula, assemble, assemble_drive, assemble_either, assemble_given,
    assemble_potential,
};
use crate::potential::Potential;
use crate::problem::{Parameter, Problem};
use crate::signal::Signal;
use crate::smooth::{Functions, Hamiltonian, Smooth};
use splitting::Asked;
use table::Table;

pub use coadjoint_program::splitting::Splitting;
pub use event::Event;
pub use lattice::read_lattice;
pub use options::{Options, Parameters};
pub use parameters::with_values;
pub use run::Run;
pub use units::Units;

/// The system of a file that names none.
const DEFAULT_NAME: &str = "system";

/// A system file; its Hamiltonian a polynomial, or either kind.
#[derive(Clone, Debug)]
pub struct System<H = Problem> {
    /// The system.
    pub problem: H,
    /// The potential V(g), if the file has one and it is not a part of the system's drive, and the splitting to compose its kicks by.
    pub potential: Option<(Potential, Splitting)>,
    /// The initial state, the duration and the step, as far as the file gives them.
    pub run: Run,
    /// The units that plots and reports show.
    pub units: Units,
    /// All parameters, also those whose values are put into the Hamiltonian.
    pub parameters: Vec<Parameter>,
}

impl System<Hamiltonian> {
    /// The inputs u(t).
    #[must_use]
    pub fn signals(&self) -> &[Signal] {
        self.problem.smooth().map_or(&[], |smooth| &smooth.signals)
    }

    /// True if the equations depend on time, by inputs too.
    #[must_use]
    pub fn depends_on_time(&self) -> bool {
        self.problem.smooth().is_some_and(Smooth::depends_on_time)
    }

    /// The velocity and the torque beside the Hamiltonian, where there are any.
    #[must_use]
    pub fn drive(&self) -> Option<&Drive> {
        self.problem.smooth()?.drive.as_deref()
    }

    /// Checks that it can be written as code.
    ///
    /// # Errors
    /// Refuses inputs and breaks; the text says so.
    pub fn writable(&self) -> Result<(), String> {
        if self.problem.smooth().is_some_and(|smooth| !smooth.breaks.is_empty()) {
            return Err(
                "no code is written of a system with `breaks`: its steps would pass over them"
                    .to_owned(),
            );
        }
        self.signals().first().map_or(Ok(()), |signal| {
            Err(format!(
                "no code is written of a system with the input `{}`, whose values it would not have: `simulate`, \
                 `ensemble` and Python make its steps",
                signal.name
            ))
        })
    }
}

impl From<System> for System<Hamiltonian> {
    fn from(system: System) -> Self {
        let System { problem, potential, run, units, parameters } = system;
        Self { problem: problem.into(), potential, run, units, parameters }
    }
}

/// Reads the text of a system file.
///
/// # Errors
/// All mistakes, each at its place in `text`; [`Diagnostics::render`] writes them out.
pub fn read(text: &str, options: Options) -> Result<System, Diagnostics> {
    read_varying(text, options, &[])
}

/// Reads the text of a system file in which the parameters with these names stay parameters, whatever the options say.
///
/// # Errors
/// As [`read`], and where other numbers of the file follow from one of them.
pub(crate) fn read_varying(
    text: &str,
    options: Options,
    varied: &[String],
) -> Result<System, Diagnostics> {
    let given = &Functions::default();
    let kind = Adapter {
        assemble: &assemble,
        gradient: |problem, _| initial::of_polynomial(problem),
        moves: |_| false,
        quadratic: Problem::is_quadratic,
        given,
    };
    read_by(text, |document, diagnostics| {
        system((document, text), (options, varied), &kind, diagnostics)
    })
}

/// Reads a system whose Hamiltonian need not be a polynomial.
///
/// # Errors
/// As [`read`], and where other numbers of the file follow from a parameter that stays one.
pub fn read_either(
    text: &str,
    options: Options,
    varied: &[String],
) -> Result<System<Hamiltonian>, Diagnostics> {
    read_given(text, options, varied, &Functions::default())
}

/// Reads a text in which these functions stand for `hamiltonian` or for entries of `[inputs]`.
///
/// # Errors
/// As [`read`], and where other numbers of the file follow from a parameter that stays one.
pub fn read_given(
    text: &str,
    options: Options,
    varied: &[String],
    given: &Functions,
) -> Result<System<Hamiltonian>, Diagnostics> {
    let assemble = |draft, diagnostics: &_| match &given.energy {
        Some((_, function)) => assemble_given(draft, function.clone(), diagnostics),
        None => assemble_either(draft, diagnostics),
    };
    fn gradient(system: &Hamiltonian, time: f64) -> initial::Gradient<'_> {
        match system {
            Hamiltonian::Polynomial(problem, _) => initial::of_polynomial(problem),
            Hamiltonian::Smooth(smooth) => initial::of_smooth(smooth, time),
        }
    }
    let quadratic = Hamiltonian::is_quadratic;
    let moves = |system: &Hamiltonian| system.smooth().is_some_and(Smooth::depends_on_time);
    let kind = Adapter { assemble: &assemble, gradient, moves, quadratic, given };
    read_by(text, |document, diagnostics| {
        system((document, text), (options, varied), &kind, diagnostics)
    })
}

/// Reads the group of a system file alone, `group` or `[algebra]`; there may be no Hamiltonian.
///
/// # Errors
/// As [`read`], of these parts of the file.
pub fn read_group(text: &str) -> Result<LieAlgebra, Diagnostics> {
    read_by(text, |document, diagnostics| {
        let nothing = Names::default();
        let root = Table::root(document, text, &nothing, diagnostics);
        let parameters = parameters::Parameters::read(&root, Options::default(), &[]);
        let root = root.with(&parameters.constants);
        group(&root, &name(&root))
    })
}

struct Adapter<'a, H> {
    /// Turns a draft into a system.
    assemble: &'a dyn Fn(Draft, &Diagnostics) -> Option<H>,
    /// Its gradient at the start.
    gradient: fn(&H, f64) -> initial::Gradient<'_>,
    /// True if it depends on time.
    moves: fn(&H) -> bool,
    /// True if it is known to be of degree at most two.
    quadratic: fn(&H) -> bool,
    /// Functions given in place of keys.
    given: &'a Functions,
}

/// The result of reading the tables of `text`.
fn read_by<T>(
    text: &str,
    read: impl FnOnce(&DeTable<'_>, &Diagnostics) -> Option<T>,
) -> Result<T, Diagnostics> {
    let diagnostics = Diagnostics::new();
    let (document, errors) = DeTable::parse_recoverable(text);
    // After an unclosed quote the rest parses as nonsense: only the quote is reported.
    if let Some(at) = unclosed_quote(text).filter(|_| !errors.is_empty()) {
        diagnostics.report(Span::text(at..at + 1), Mistake::UnclosedQuote);
        return Err(diagnostics);
    }
    // A table that is given twice has all its keys once more: that is one mistake.
    let mut twice = None;
    for error in errors {
        let span = error.span().map_or(Span::Whole, Span::text);
        let start = error.span().map_or(0, |span| span.start);
        let header = text[..start].rfind("\n[").filter(|_| error.message() == "duplicate key");
        if header.is_some() && header == twice {
            continue;
        }
        twice = header.filter(|at| text[*at..start].trim_matches(['\n', '[']).is_empty());
        // One line: more would repeat the source, which is shown anyway.
        let message = error.message().lines().collect::<Vec<_>>().join("; ");
        diagnostics.report(span, Mistake::Toml(message));
    }
    if !diagnostics.is_empty() {
        return Err(diagnostics);
    }
    let result = read(document.get_ref(), &diagnostics);
    diagnostics.into_result(result)
}

fn system<H>(
    (document, text): (&DeTable<'_>, &str),
    (options, varied): (Options, &[String]),
    kind: &Adapter<'_, H>,
    diagnostics: &Diagnostics,
) -> Option<System<H>> {
    let nothing = Names::default();
    let root = Table::root(document, text, &nothing, diagnostics);
    if let Some(table) = root.get("lattice") {
        let what = "a lattice runs by `coadjoint simulate` and by `System.lattice` of Python: other commands are not made for one";
        let help = "without [lattice], and with the group of all sites such as SO3^64, the file is an ordinary system";
        diagnostics.report_other(table::span(table), what, help);
        return None;
    }
    let parameters = parameters::Parameters::read(&root, options, varied);
    let root = root.with(&parameters.constants);
    root.check_keys(&[
        "name",
        "group",
        "algebra",
        "coordinates",
        "hamiltonian",
        "velocity",
        "velocity_in_space",
        "potential",
        "torque",
        "torque_in_space",
        "damping",
        "parameters",
        "inputs",
        "let",
        "breaks",
        "units",
        "integrator",
        "initial",
        "run",
        "event",
    ]);
    let name = name(&root);
    let algebra = group(&root, &name);
    let (coordinates, coordinates_span) = energies::coordinates(&root, algebra.as_ref());
    let inputs = inputs::read(&root, &kind.given.inputs);
    let hamiltonian = match &kind.given.energy {
        None => {
            let alone = kind.given.acting[0].is_some();
            let algebra = algebra.as_ref();
            energies::hamiltonian(&root, algebra, &coordinates, &parameters, &inputs, alone)
        }
        Some((name, _)) => {
            let parameters = parameters.all();
            Formula { source: name.clone(), parameters, ..Formula::default() }
        }
    };
    let called = kind.given.acting.iter().any(Option::is_some);
    let driven = drive::is_given(&root) || called;
    let read = || drive::read(&root, algebra.as_ref(), &coordinates, &parameters, &inputs);
    let acting = if driven { read() } else { None };
    let of_potential = energies::potential(&root, algebra.as_ref(), &parameters, &inputs);
    let moving = of_potential.as_ref().is_some_and(Formula::moves);
    // Of a wrong drive it is not known.
    if acting.is_some() || !driven {
        let drive = acting.as_ref().map(|read| &read.energy);
        let energies: Vec<_> =
            drive.into_iter().chain(&of_potential).chain([&hamiltonian]).collect();
        energies::check_inputs(&root, &inputs, &energies);
    }
    let coordinates: Vec<String> = coordinates.into_iter().map(|(name, _)| name).collect();
    let units = units::read(&root, &coordinates);
    let integrator = root.table("integrator");
    let choice = choice(integrator.as_ref(), options, diagnostics);
    let mut run = run::read(&root, integrator.as_ref(), &[]);
    run.events = event::read(&root, algebra.as_ref(), &coordinates);
    let velocity = initial::read(&root, algebra.as_ref(), &mut run);
    if integrator.as_ref().is_some_and(|table| table.has("truncation")) {
        run.truncation = choice.truncation;
    }
    let splitting = Asked::read(&root, integrator.as_ref(), moving || called);
    // Mistakes of both energies at once.
    let potential = of_potential.as_ref().filter(|_| !moving).and_then(|energy| {
        assemble_potential("potential".to_owned(), algebra.clone(), None, energy, diagnostics)
    });
    let signals: Vec<Signal> = inputs.into_iter().map(|(signal, _)| signal).collect();
    // Beside a velocity or a torque a potential has no kicks, nor one that depends on time, nor where none are asked for.
    let joined = driven || moving || matches!(splitting, Asked::None);
    let drive = match (&algebra, acting.is_some() || potential.is_some() || moving) {
        (Some(algebra), true) if joined => {
            let of_potential = of_potential.as_ref().filter(|_| moving || potential.is_some());
            let called = kind.given.acting.clone();
            let names = (&coordinates[..], &signals[..]);
            assemble_drive(algebra, names, acting, called, of_potential, diagnostics)
        }
        _ => None,
    };
    let potential = potential.filter(|_| !joined);
    let breaks = inputs::breaks(&root);
    let draft = Draft {
        name,
        algebra,
        coordinates,
        coordinates_span,
        hamiltonian,
        signals,
        drive,
        breaks,
        choice,
    };
    let problem = (kind.assemble)(draft, diagnostics)?;
    if let Some(stated) = velocity {
        let gradient = (kind.gradient)(&problem, run.initial_time);
        run.momentum = initial::momentum(&gradient, &stated, &root);
        run.velocity_time = (kind.moves)(&problem).then_some(run.initial_time);
    }
    let quadratic = (kind.quadratic)(&problem);
    let potential = potential.map(|potential| {
        let splitting = splitting.choose(quadratic, diagnostics);
        (potential, splitting)
    });
    Some(System { problem, potential, run, units, parameters: parameters.all() })
}

fn name(root: &Table<'_>) -> String {
    let name = root.string("name", "name = \"rigid-body\"");
    name.map_or(DEFAULT_NAME.to_owned(), |(name, _)| name.to_owned())
}

/// The Lie algebra: `group = "…"` or the table `[algebra]`.
fn group(root: &Table<'_>, name: &str) -> Option<LieAlgebra> {
    let example = "group = \"SO3\"";
    match (root.string("group", example), root.table("algebra")) {
        (Some((_, span)), Some(_)) => {
            let message = "both `group` and [algebra] are given";
            let help = "keep `group` for a known group, [algebra] for one of your own";
            root.diagnostics.report_other(span, message, help);
            None
        }
        (Some((text, span)), None) => {
            let found = catalogue::lookup(text);
            root.diagnostics.check(span, found.map_err(|error| Mistake::Group(error.to_string())))
        }
        (None, Some(table)) => algebra::read(&table, name),
        (None, None) => {
            if !root.has("group") && !root.has("algebra") {
                root.missing("group", example);
            }
            None
        }
    }
}

/// The method that `[integrator]` gives, as far as the options do not replace it.
fn choice(table: Option<&Table<'_>>, options: Options, diagnostics: &Diagnostics) -> Choice {
    let mut choice = Choice::default();
    if let Some(table) = table {
        table.check_keys(&[
            "truncation",
            "chart",
            "solver",
            "frame",
            "method",
            "step",
            "tolerance",
            "region",
            "splitting",
        ]);
        if table.has("truncation") && options.truncation.is_none() {
            let given = table.integer("truncation", "truncation = 7");
            choice.truncation = None;
            given.into_iter().for_each(|(k, place)| choice.set_truncation(k, place, diagnostics));
        }
        let examples = [
            ("chart", "chart = \"exp\""),
            ("solver", "solver = \"fixed_point\""),
            ("frame", "frame = \"comoving\""),
            ("method", "method = \"collocation\""),
        ];
        for (key, example) in examples {
            if let Some((name, place)) = table.string(key, example)
                && (key != "chart" || options.chart.is_none())
                && (key != "frame" || options.frame.is_none())
                && (key != "method" || options.method.is_none())
            {
                choice.set_named(key, name, place, diagnostics);
            }
        }
    }
    if let Some(k) = options.truncation {
        choice.set_truncation(k, Span::Whole, diagnostics);
    }
    if let Some(chart) = options.chart {
        choice.chart = (chart, Span::Whole);
    }
    choice.solver = options.solver.or(choice.solver);
    choice.method = options.method.map(|method| (method, Span::Whole)).or(choice.method);
    if let Some(frame) = options.frame {
        choice.frame = (frame, Span::Whole);
    }
    choice
}
