//! Folding in C: the coefficients of a step from its size and the parameters.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use coadjoint_program::fold::{DEGREES, Fold, LastTerm};
use coadjoint_program::quoting::c_comment;
use coadjoint_program::{Node, Program};

use super::template::{ABOUT, BEGIN, BOUND, END, LAST, LOOP, POWER, RADIUS, STEP, SYMBOLS, WITHIN};
use crate::emit::c::dialect::decimal;
use crate::emit::c::names::Names;
use crate::emit::c::parameter;
use crate::emit::c::{HeaderError, HeaderOptions};
use crate::integrator::{FoldTable, Kicks};
use crate::step::{Origin, Step};

/// The coefficients that the programs of a step read, and where the header has them: the slots that are read, in the
/// order of their bases; then the bound on the Hessian, and the square of the radius.
#[derive(Debug)]
pub(super) struct Folding {
    /// For each coefficient that is read its place.
    pub places: BTreeMap<usize, usize>,
    /// The data that folding reads.
    pub table: FoldTable,
    /// The place of the length of a kick, where there are kicks.
    kick_at: Option<usize>,
    /// The number of places for times, which steps set.
    times: usize,
}

/// The numbers of the slots that programs read.
fn read(programs: &[&Program]) -> BTreeSet<usize> {
    let nodes = programs.iter().flat_map(|program| program.nodes());
    let slot = |node: &Node| match node {
        Node::Slot(i) => Some(*i as usize),
        _ => None,
    };
    nodes.filter_map(slot).collect()
}

impl Folding {
    /// The coefficients that the programs of `step` read.
    pub(super) fn new(origin: &Origin, step: &Step) -> Result<Self, HeaderError> {
        let programs = &step.kernel().programs;
        let mut list = vec![&programs.guess, &programs.correct, &programs.accept];
        list.extend([&programs.transport, &programs.sound, &programs.watch]);
        list.extend(programs.frame.iter().chain(step.kernel().kick()));
        // The length of a kick, which the programs know after the radius.
        let radius_at = step.radius_at();
        let kick = step.kernel().flows().map(|_| radius_at + 1);
        let last = kick.into_iter().chain([radius_at]);
        let read = read(&list);
        let times = step.kernel().clock().map_or(0, |clock| clock.times.len());
        let (places, table): (BTreeMap<usize, usize>, _) = match origin {
            Origin::Series(integrator) => {
                let slots = integrator.coefficients.slots();
                let of_slot =
                    |slot: usize| slots.get(slot).map(|&(base, scale)| (base, scale, slot));
                let mut wanted: Vec<_> = read.into_iter().filter_map(of_slot).collect();
                wanted.sort_unstable();
                if wanted.is_empty() {
                    return Err(HeaderError::Constant);
                }
                let of_step = slots.len()..radius_at;
                let all = wanted.into_iter().map(|(.., slot)| slot).chain(of_step);
                let places: BTreeMap<usize, usize> = all.chain(last).zip(0..).collect();
                let table = FoldTable::placed(integrator, |at| places.get(&at).copied());
                (places, table)
            }
            // The last of these are the times.
            Origin::Collocation(_) => {
                let all = (0..radius_at).chain(last).chain(radius_at + 1..radius_at + 1 + times);
                let places: BTreeMap<usize, usize> = all.zip(0..).collect();
                let place = |at| places.get(&at).copied();
                let table = FoldTable::of_symbols(origin.symbols().len(), origin.kicks(), place);
                (places, table)
            }
        };
        let highest = table.lists().last.iter().map(|term| term.3).max().unwrap_or(0);
        if highest as usize >= DEGREES {
            return Err(HeaderError::Degree { degree: highest + 1, limit: DEGREES as u32 });
        }
        let kick_at = kick.and_then(|at| places.get(&at).copied());
        Ok(Self { places, table, kick_at, times })
    }

    /// The number of folded coefficients.
    pub(super) fn len(&self) -> usize {
        self.places.len() - self.times
    }

    pub(super) fn init(&self, origin: &Origin, names: &Names, options: &HeaderOptions) -> String {
        let fold = self.table.lists();
        let (given, own) = (origin.facts().parameters, origin.symbols());
        let scalars = parameter::scalars(given, names);
        let symbols: Vec<String> =
            own.iter().map(|symbol| parameter::expression(&symbol.expr, &scalars, names)).collect();
        let mut text = String::new();
        if symbols.iter().any(|text| text.contains(parameter::POWER_OF)) {
            text.push_str(POWER);
        }
        if !fold.last.is_empty() {
            text.push_str(WITHIN);
        }
        let parameters = match given.is_empty() {
            true => String::new(),
            false => ", const @p@_parameters *parameters".to_owned(),
        };
        let degrees = fold.last.iter().map(|term| term.3 as usize + 1).max().unwrap_or(0);
        let factors = fold.last.iter().map(|term| term.1 as usize + 1).max().unwrap_or(0);
        let bounds = degrees * factors;
        let products = fold.products.len();
        let powers = fold.parts.iter().map(|part| part.0 as usize + 1).max().unwrap_or(1);
        let stack = if products > 0 { 2 * products + 1 } else { 0 } + powers + 2 * bounds + 16;
        let about = ABOUT.replace("/*BYTES*/", &(8 * stack).to_string());
        let begin = text.len();
        if self.kick_at.is_none() {
            text.push_str(&about);
        }
        text.push_str(&format!(
            "static inline @p@_status @p@_init(@p@_map *map, double h{parameters})\n{{\n"
        ));
        declare(&fold, degrees, &mut text);
        if products > 0 {
            let _ = writeln!(text, "    double symbol[{}];", symbols.len());
            let _ = writeln!(text, "    double product[{}];", products + 1);
        }
        let _ = writeln!(text, "    double power[{powers}];");
        if bounds > 0 {
            let zeros = vec!["0.0"; bounds].join(", ");
            let _ = writeln!(text, "    double last[{bounds}] = {{{zeros}}};");
            let _ = writeln!(text, "    double before[{bounds}] = {{{zeros}}};");
        }
        let mut next = String::new();
        if !fold.bound.is_empty() {
            next.push_str("    uint32_t next_bound = 0u;\n");
        }
        if !fold.last.is_empty() {
            next.push_str("    uint32_t next_last = 0u;\n");
        }
        text.push_str(&BEGIN.replace("/*NEXT*/", &next));
        if let Some(step) = options.only_step {
            let step = decimal(step);
            let _ = writeln!(text, "    if (!((h >= {step}) && (h <= {step}))) {{");
            text.push_str("        status = @P@_BAD_STEP;\n    }\n");
        }
        let read = products > 0 && symbols.iter().any(|text| text.contains(parameter::MEMBER));
        if !read && !given.is_empty() {
            text.push_str("    (void)parameters;\n");
        }
        if products > 0 {
            for (i, (expression, symbol)) in symbols.iter().zip(own).enumerate() {
                let note = c_comment(&symbol.text);
                let _ = writeln!(text, "    symbol[{i}] = {expression}; /* {note} */");
            }
            text.push_str(
                &SYMBOLS
                    .replace("/*SYMBOLS*/", &format!("{}u", symbols.len()))
                    .replace("/*PRODUCTS*/", &format!("{products}u")),
            );
        }
        let summand = match products {
            0 => "factor[term]",
            _ => "(factor[term] * product[product_of[term]])",
        };
        let text = text
            + &LOOP
                .replace("/*BOUND*/", if fold.bound.is_empty() { "" } else { BOUND })
                .replace("/*LAST*/", if fold.last.is_empty() { "" } else { LAST })
                .replace("/*SUMMAND*/", summand)
            + &END.replace("/*RADIUS*/", if fold.last.is_empty() { "" } else { RADIUS });
        let text = match (self.kick_at, origin.kicks()) {
            (Some(kick_at), Some(kicks)) => {
                let passed = if parameters.is_empty() { "" } else { ", parameters" };
                let step = of_step(kicks, &parameters, passed);
                text[..begin].to_owned() + &of_flow(&text[begin..], kick_at) + &about + &step
            }
            _ => text,
        };
        let sizes = [
            ("/*POWERS*/", powers),
            ("/*BASES*/", fold.bases.len()),
            ("/*BOUNDS*/", fold.bound.len()),
            ("/*LASTS*/", fold.last.len()),
            ("/*PLACES*/", bounds),
            ("/*DEGREES*/", degrees),
        ];
        let fill =
            |text: String, (name, size): (&str, usize)| text.replace(name, &format!("{size}u"));
        names.fill(&sizes.into_iter().fold(text, fill))
    }
}

/// The data as tables of C.
fn declare(fold: &Fold<'_>, degrees: usize, text: &mut String) {
    text.push_str("    /* Summands factor * product * h^power of each coefficient. */\n");
    numbers("factor", fold.terms.iter().map(|term| term.0), text);
    if !fold.products.is_empty() {
        integers("product_of", fold.terms.iter().map(|term| term.1), text);
        text.push_str("    /* Product i + 1 is product made_of[i] times symbol[made_by[i]]. */\n");
        integers("made_of", fold.products.iter().map(|made| made.0), text);
        integers("made_by", fold.products.iter().map(|made| made.1), text);
    }
    integers("power_of", fold.parts.iter().map(|part| part.0), text);
    text.push_str(
        "    /* Where the summands of a power, the powers and the places of a coefficient end. */\n",
    );
    integers("term_end", fold.parts.iter().map(|part| part.1), text);
    integers("part_end", fold.bases.iter().copied(), text);
    let before = |base: u32| fold.slots.partition_point(|slot| slot.0 <= base) as u32;
    integers("slot_end", (0..fold.bases.len() as u32).map(before), text);
    integers("scale", fold.slots.iter().map(|slot| slot.1), text);
    if !fold.bound.is_empty() {
        text.push_str("    /* The bound on what is left out of the Hessian. */\n");
        integers("bound_base", fold.bound.iter().map(|term| term.0), text);
        integers("bound_place", fold.bound.iter().map(|term| term.2), text);
        numbers("bound_weight", fold.bound.iter().map(|term| term.1), text);
    }
    if !fold.last.is_empty() {
        text.push_str(
            "    /* The last two terms of the series, which tell how far it can be trusted. */\n",
        );
        let last = || fold.last.iter();
        integers("last_part", last().map(|term| term.0), text);
        let place = |&(_, factor, _, degree, _): &LastTerm| factor * degrees as u32 + degree;
        integers("last_place", last().map(place), text);
        integers("last_is_highest", last().map(|term| u32::from(term.2)), text);
        numbers("last_weight", last().map(|term| term.4), text);
    }
}

fn numbers(name: &str, list: impl ExactSizeIterator<Item = f64>, text: &mut String) {
    let _ = writeln!(text, "    static const double {name}[{}] = {{", list.len());
    let number = |value: f64| match value < 0.0 {
        true => format!("{value:?}"),
        false => decimal(value),
    };
    rows(list.map(number), 4, text);
}

fn integers(name: &str, list: impl ExactSizeIterator<Item = u32> + Clone, text: &mut String) {
    let short = list.clone().all(|value| u16::try_from(value).is_ok());
    let of = if short { "uint16_t" } else { "uint32_t" };
    let _ = writeln!(text, "    static const {of} {name}[{}] = {{", list.len());
    rows(list.map(|value| format!("{value}u")), 12, text);
}

fn rows(list: impl Iterator<Item = String>, width: usize, text: &mut String) {
    let list: Vec<String> = list.collect();
    for row in list.chunks(width) {
        let _ = writeln!(text, "        {},", row.join(", "));
    }
    text.push_str("    };\n");
}

/// The function that folds for a flow and the kick before it, from that which folds for a step.
fn of_flow(text: &str, kick_at: usize) -> String {
    text.replace(
        "@p@_init(@p@_map *map, double h",
        "@p@_internal_fold(double *c, double h, double kick",
    )
    .replace("map->c", "c")
    .replace("    map->status = status;\n", "")
    .replace(
        "    if (status != @P@_OK) {\n",
        &format!("    c[{kick_at}u] = kick;\n    if (status != @P@_OK) {{\n"),
    )
}

/// The function that folds for all flows and kicks of a step.
fn of_step(kicks: &Kicks, parameters: &str, passed: &str) -> String {
    let list = |lengths: Vec<f64>| {
        let lengths: Vec<String> = lengths.iter().map(|length| format!("{length:?}")).collect();
        format!("{{\n        {},\n    }}", lengths.join(",\n        "))
    };
    // After the last kick there is no flow.
    let flows = kicks.splitting.flows().chain(kicks.splitting.flows().next());
    STEP.replace("/*FLOWS*/", &list(flows.collect()))
        .replace("/*KICKS*/", &list(kicks.splitting.kicks().collect()))
        .replace("/*PARAMETERS*/", parameters)
        .replace("/*PASSED*/", passed)
}
