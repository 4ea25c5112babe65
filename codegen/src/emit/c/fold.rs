//! Folding in C: the coefficients of a step from its size and the parameters.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use coadjoint_program::quoting::c_comment;
use coadjoint_program::{Node, Program};

use super::dialect::decimal;
use super::fold_table::Table;
use super::fold_text::{ABOUT, BEGIN, BOUND, END, LAST, LOOP, POWER, RADIUS, SYMBOLS, WITHIN};
use super::names::Names;
use super::radius::{LastTerm, last_terms};
use super::{HeaderError, HeaderOptions, parameter};
use crate::integrator::Integrator;
use crate::step::Step;

/// The coefficients that the programs of a step read, by base, and where the header has them.
///
/// The array of coefficients has the slots that are read, in the order of their bases; then the bound on the Hessian by
/// degrees; then the square of the radius.
#[derive(Debug)]
pub struct Fold {
    /// For each slot of the programs that is read its place.
    pub places: BTreeMap<usize, usize>,
    /// How many coefficients there are.
    pub len: usize,
    /// The bases that are needed, as they are in the integrator.
    pub bases: Vec<usize>,
    /// The integers that make slots of a base, by base.
    pub scales: Vec<Vec<u32>>,
    /// (base, degree, weight) of the bound on the Hessian.
    pub bound: Vec<(usize, u32, f64)>,
    bound_len: usize,
    /// The last two terms of the series.
    pub last: Vec<LastTerm>,
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

impl Fold {
    /// The coefficients that the programs of `step` read.
    ///
    /// # Errors
    /// [`HeaderError::Degree`], [`HeaderError::Constant`].
    pub fn new(integrator: &Integrator, step: &Step) -> Result<Self, HeaderError> {
        let programs = step.kernel().programs();
        let mut list = vec![&programs.guess, &programs.correct, &programs.accept];
        list.extend([&programs.transport, &programs.sound, &programs.watch]);
        list.extend(&programs.frame);
        let slots = integrator.coefficients.slots();
        let (all, bound_len) = (slots.len(), integrator.defect_len());
        let mut wanted: Vec<(usize, u32, usize)> = read(&list)
            .into_iter()
            .filter_map(|slot| slots.get(slot).map(|&(base, scale)| (base, scale, slot)))
            .collect();
        wanted.sort_unstable();
        let last = last_terms(integrator)?;
        let bound: Vec<(usize, u32, f64)> = integrator
            .defect
            .iter()
            .filter_map(|term| {
                let &(base, scale) = slots.get(term.slot)?;
                Some((base, term.degree, term.weight * f64::from(scale)))
            })
            .collect();
        let mut bases: BTreeSet<usize> = wanted.iter().map(|&(base, ..)| base).collect();
        bases.extend(last.iter().map(|term| term.base));
        bases.extend(bound.iter().map(|&(base, ..)| base));
        let bases: Vec<usize> = bases.into_iter().collect();
        if wanted.is_empty() {
            return Err(HeaderError::Constant);
        }
        let scales = bases.iter().map(|&base| {
            wanted.iter().filter(|of| of.0 == base).map(|&(_, scale, _)| scale).collect()
        });
        let mut places: BTreeMap<usize, usize> =
            wanted.iter().enumerate().map(|(place, &(.., slot))| (slot, place)).collect();
        for extra in 0..=bound_len {
            places.insert(all + extra, wanted.len() + extra);
        }
        let (scales, len) = (scales.collect(), wanted.len() + bound_len + 1);
        Ok(Self { places, len, bases, scales, bound, bound_len, last })
    }

    /// The function that folds.
    pub fn init(&self, integrator: &Integrator, names: &Names, options: &HeaderOptions) -> String {
        let table = Table::new(self, &integrator.coefficients);
        let problem = &integrator.problem;
        let scalars = parameter::scalars(&problem.parameters, names);
        let symbols: Vec<String> = problem
            .symbols
            .iter()
            .map(|symbol| parameter::expression(&symbol.expr, &scalars, names))
            .collect();
        let mut text = String::new();
        if problem.symbols.iter().any(|symbol| parameter::has_power(&symbol.expr)) {
            text.push_str(POWER);
        }
        if !self.last.is_empty() {
            text.push_str(WITHIN);
        }
        let parameters = match problem.parameters.is_empty() {
            true => String::new(),
            false => ", const @p@_parameters *parameters".to_owned(),
        };
        text.push_str(&ABOUT.replace("/*BYTES*/", &(8 * table.stack(self)).to_string()));
        text.push_str(&format!(
            "static inline @p@_status @p@_init(@p@_map *map, double h{parameters})\n{{\n"
        ));
        table.declare(self, &mut text);
        let with_symbols = !table.products.is_empty();
        if with_symbols {
            let count = symbols.len();
            let _ = writeln!(text, "    double symbol[{count}];");
            let _ = writeln!(text, "    double product[{}];", table.products.len() + 1);
        }
        let _ = writeln!(text, "    double power[{}];", table.powers);
        let places = self.last_places();
        if places > 0 {
            let _ = writeln!(text, "    double last[{places}] = {{0.0}};");
            let _ = writeln!(text, "    double before[{places}] = {{0.0}};");
        }
        let mut next = String::new();
        if !self.bound.is_empty() {
            next.push_str("    uint32_t next_bound = 0u;\n");
        }
        if !self.last.is_empty() {
            next.push_str("    uint32_t next_last = 0u;\n");
        }
        text.push_str(&BEGIN.replace("/*NEXT*/", &next));
        if let Some(step) = options.only_step {
            let step = decimal(step);
            let _ = writeln!(text, "    if (!((h >= {step}) && (h <= {step}))) {{");
            text.push_str("        status = @P@_BAD_STEP;\n    }\n");
        }
        let read = with_symbols && symbols.iter().any(|text| text.contains("parameters->"));
        if !read && !problem.parameters.is_empty() {
            text.push_str("    (void)parameters;\n");
        }
        if with_symbols {
            for (i, (expression, symbol)) in symbols.iter().zip(&problem.symbols).enumerate() {
                let note = c_comment(&symbol.text);
                let _ = writeln!(text, "    symbol[{i}] = {expression}; /* {note} */");
            }
            let count = symbols.len();
            let products = table.products.len();
            text.push_str(
                &SYMBOLS
                    .replace("/*SYMBOLS*/", &format!("{count}u"))
                    .replace("/*PRODUCTS*/", &format!("{products}u")),
            );
        }
        let summand = match with_symbols {
            true => "(factor[term] * product[product_of[term]])",
            false => "factor[term]",
        };
        let bound = if self.bound.is_empty() { "" } else { BOUND };
        let last = if self.last.is_empty() { "" } else { LAST };
        text.push_str(
            &LOOP
                .replace("/*BOUND*/", bound)
                .replace("/*LAST*/", last)
                .replace("/*POWERS*/", &format!("{}u", table.powers))
                .replace("/*BASES*/", &format!("{}u", self.bases.len()))
                .replace("/*SUMMAND*/", summand)
                .replace("/*BOUND_AT*/", &format!("{}u", self.len - 1 - self.bound_len))
                .replace("/*BOUNDS*/", &format!("{}u", self.bound.len()))
                .replace("/*LASTS*/", &format!("{}u", self.last.len())),
        );
        let radius = match self.last.is_empty() {
            true => "    radius = DBL_MAX;\n".to_owned(),
            false => RADIUS.replace("/*PLACES*/", &format!("{places}u")),
        };
        text.push_str(&END.replace("/*RADIUS*/", &radius));
        let text = text.replace("/*DEGREES*/", &format!("{}u", self.degrees()));
        names.fill(&text)
    }

    /// How many coefficients the polynomials have that bound the last terms, of all factors of the group.
    pub fn last_places(&self) -> usize {
        let factors = self.last.iter().map(|term| term.factor as usize + 1).max().unwrap_or(0);
        factors * self.degrees()
    }

    /// How many degrees the polynomials have that bound the last terms.
    pub fn degrees(&self) -> usize {
        self.last.iter().map(|term| term.degree as usize + 1).max().unwrap_or(0)
    }
}
