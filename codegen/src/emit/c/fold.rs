//! Folding in C: the coefficients of a step from its size and the parameters.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use coadjoint_program::fold::{DEGREES, Fold, LastTerm};
use coadjoint_program::print::Value;
use coadjoint_program::quoting::c_comment;
use coadjoint_program::{Node, Program};

use crate::emit::c::HeaderError;
use crate::emit::c::dialect::decimal;
use crate::emit::c::names::Names;
use crate::emit::c::parameter;
use crate::emit::header::when;
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

    /// The data of folding, for the template.
    pub(super) fn values(&self, origin: &Origin, names: &Names) -> Vec<Value> {
        let fold = self.table.lists();
        let (given, own) = (origin.facts().parameters, origin.symbols());
        let scalars = parameter::scalars(given, names);
        let expressions = parameter::symbols(own, &scalars, names);
        let has = |part: &str| expressions.iter().any(|text| text.contains(part));
        let degrees = fold.last.iter().map(|term| term.3 as usize + 1).max().unwrap_or(0);
        let factors = fold.last.iter().map(|term| term.1 as usize + 1).max().unwrap_or(0);
        let (places, products) = (degrees * factors, fold.products.len());
        let powers = fold.parts.iter().map(|part| part.0 as usize + 1).max().unwrap_or(1);
        let stack = if products > 0 { 2 * products + 1 } else { 0 } + powers + 2 * places + 16;
        let mut tables = String::new();
        declare(&fold, degrees, &mut tables);
        let symbols = own.iter().zip(&expressions).enumerate().map(|(i, (symbol, expression))| {
            format!("    symbol[{i}] = {expression}; /* {} */\n", c_comment(&symbol.text))
        });
        let read = products > 0 && has(parameter::MEMBER);
        let mut values = vec![
            ("TABLES", tables),
            ("POWER", has(parameter::POWER_OF).to_string()),
            ("UNREAD", (!read && !given.is_empty()).to_string()),
            (
                "PARAMETER",
                when(!given.is_empty(), &names.fill(", const @p@_parameters *parameters")),
            ),
            ("PASSED", when(!given.is_empty(), ", parameters")),
            ("SET_SYMBOLS", symbols.collect()),
            ("BYTES", (8 * stack).to_string()),
            ("SYMBOLS", own.len().to_string()),
            ("PRODUCTS", products.to_string()),
            ("POWERS", powers.to_string()),
            ("BASES", fold.bases.len().to_string()),
            ("BOUND", fold.bound.len().to_string()),
            ("LAST", fold.last.len().to_string()),
            ("PLACES", places.to_string()),
            ("DEGREES", degrees.to_string()),
        ];
        if let (Some(kick_at), Some(Kicks { splitting, .. })) = (self.kick_at, origin.kicks()) {
            let number = |length: f64| format!("{length:?}");
            // After the last kick there is no flow.
            let flows = splitting.flows().chain(splitting.flows().next());
            values.extend([
                ("KICK", ", double kick".to_owned()),
                ("KICK_AT", format!("{kick_at}u")),
                ("FLOWS", rows_of(flows.map(number), 1)),
                ("KICKS", rows_of(splitting.kicks().map(number), 1)),
            ]);
        }
        values
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
    let number = |value| decimal(value).trim_matches(['(', ')']).to_owned();
    text.push_str(&(rows_of(list.map(number), 4) + "    };\n"));
}

fn integers(name: &str, list: impl ExactSizeIterator<Item = u32> + Clone, text: &mut String) {
    let short = list.clone().all(|value| u16::try_from(value).is_ok());
    let of = if short { "uint16_t" } else { "uint32_t" };
    let _ = writeln!(text, "    static const {of} {name}[{}] = {{", list.len());
    text.push_str(&(rows_of(list.map(|value| format!("{value}u")), 12) + "    };\n"));
}

/// The rows of a table, with as many entries each.
pub(super) fn rows_of(list: impl Iterator<Item = String>, width: usize) -> String {
    let list: Vec<String> = list.collect();
    list.chunks(width).map(|row| format!("        {},\n", row.join(", "))).collect()
}
