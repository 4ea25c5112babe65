//! Folding in C: the coefficients of a step from its size and the parameters.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use coadjoint_program::{Node, Program};

use super::dialect::decimal;
use super::names::Names;
use super::radius::{LastTerm, last_terms};
use super::template::POWER;
use super::{HeaderError, HeaderOptions, parameter};
use crate::integrator::{Coefficients, Integrator, Products};
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
    bases: Vec<usize>,
    /// The integers that make slots of a base, by base.
    scales: Vec<Vec<u32>>,
    /// (base, degree, weight) of the bound on the Hessian.
    bound: Vec<(usize, u32, f64)>,
    bound_len: usize,
    last: Vec<LastTerm>,
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
    /// What the programs of `step` read.
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
        let degrees = self.degrees();
        if degrees > 0 {
            let zeros = "0.0, ".repeat(degrees);
            let zeros = zeros.trim_end_matches(", ");
            let _ = writeln!(text, "    double last[{degrees}] = {{{zeros}}};");
            let _ = writeln!(text, "    double before[{degrees}] = {{{zeros}}};");
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
                let note = super::names::plain(&symbol.text);
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
            false => "    radius = @p@_internal_radius(last, before);\n".to_owned(),
        };
        text.push_str(&END.replace("/*RADIUS*/", &radius));
        let text = text.replace("/*DEGREES*/", &format!("{degrees}u"));
        names.fill(&text)
    }

    /// How many degrees the polynomials have that bound the last terms.
    fn degrees(&self) -> usize {
        self.last.iter().map(|term| term.degree as usize + 1).max().unwrap_or(0)
    }
}

/// The data of a fold, bases renumbered.
struct Table {
    factors: Vec<f64>,
    product_of: Vec<usize>,
    products: Vec<(usize, usize)>,
    power_of: Vec<usize>,
    term_end: Vec<usize>,
    part_end: Vec<usize>,
    slot_end: Vec<usize>,
    scale: Vec<usize>,
    last_part: Vec<usize>,
    /// One more than the highest power of h.
    powers: usize,
}

impl Table {
    fn new(fold: &Fold, coefficients: &Coefficients) -> Self {
        let mut needed = Coefficients::default();
        for &base in &fold.bases {
            needed.add_base(coefficients.bases().get(base).cloned().unwrap_or_default());
        }
        let products = Products::of(&needed);
        let mut table = Self {
            factors: Vec::new(),
            product_of: Vec::new(),
            products: products.steps().to_vec(),
            power_of: Vec::new(),
            term_end: Vec::new(),
            part_end: Vec::new(),
            slot_end: Vec::new(),
            scale: Vec::new(),
            last_part: Vec::new(),
            powers: 1,
        };
        for ((&base, scales), parts) in fold.bases.iter().zip(&fold.scales).zip(needed.parts()) {
            for part in parts {
                let power = part.first().map_or(0, |term| term.step_power as usize);
                let own = |term: &&LastTerm| term.base == base && term.order == power;
                let found = fold.last.iter().filter(own).count();
                table.last_part.extend(std::iter::repeat_n(table.power_of.len(), found));
                for term in part {
                    table.factors.push(term.rounded_factor());
                    table.product_of.push(products.number(&term.symbol_powers));
                }
                table.power_of.push(power);
                table.term_end.push(table.factors.len());
                table.powers = table.powers.max(power + 1);
            }
            table.part_end.push(table.power_of.len());
            table.scale.extend(scales.iter().map(|&scale| scale as usize));
            table.slot_end.push(table.scale.len());
        }
        table
    }

    /// The doubles that folding puts on the stack.
    fn stack(&self, fold: &Fold) -> usize {
        let products = if self.products.is_empty() { 0 } else { 2 * self.products.len() + 1 };
        products + self.powers + 2 * fold.degrees() + 16
    }

    /// The tables.
    fn declare(&self, fold: &Fold, text: &mut String) {
        text.push_str("    /* Summands factor * product * h^power of each coefficient. */\n");
        numbers("factor", &self.factors, text);
        if !self.products.is_empty() {
            integers("product_of", &self.product_of, text);
            let (of, by): (Vec<_>, Vec<_>) = self.products.iter().copied().unzip();
            text.push_str(
                "    /* Product i + 1 is product made_of[i] times symbol[made_by[i]]. */\n",
            );
            integers("made_of", &of, text);
            integers("made_by", &by, text);
        }
        integers("power_of", &self.power_of, text);
        text.push_str("    /* Where the summands of a power, the powers and the places of a coefficient end. */\n");
        integers("term_end", &self.term_end, text);
        integers("part_end", &self.part_end, text);
        integers("slot_end", &self.slot_end, text);
        integers("scale", &self.scale, text);
        if !fold.bound.is_empty() {
            text.push_str("    /* The bound on what is left out of the Hessian. */\n");
            let number = |base| fold.bases.iter().position(|&known| known == base).unwrap_or(0);
            let (bases, degrees): (Vec<_>, Vec<_>) =
                fold.bound.iter().map(|&(base, degree, _)| (number(base), degree as usize)).unzip();
            let weights: Vec<f64> = fold.bound.iter().map(|of| of.2).collect();
            integers("bound_base", &bases, text);
            integers("bound_degree", &degrees, text);
            numbers("bound_weight", &weights, text);
        }
        if !fold.last.is_empty() {
            text.push_str("    /* The last two terms of the series, which tell how far it can be trusted. */\n");
            let highest = fold.last.iter().map(|term| term.order).max().unwrap_or(0);
            let of = |read: fn(&LastTerm, usize) -> usize| {
                fold.last.iter().map(|term| read(term, highest)).collect::<Vec<_>>()
            };
            integers("last_part", &self.last_part, text);
            integers("last_degree", &of(|term, _| term.degree as usize), text);
            integers("last_is_highest", &of(|term, k| usize::from(term.order == k)), text);
            let weights: Vec<f64> = fold.last.iter().map(|term| term.weight).collect();
            numbers("last_weight", &weights, text);
        }
    }
}

/// A table of numbers.
fn numbers(name: &str, list: &[f64], text: &mut String) {
    let _ = writeln!(text, "    static const double {name}[{}] = {{", list.len());
    rows(
        list.iter().map(|&value| if value < 0.0 { format!("{value:?}") } else { decimal(value) }),
        4,
        text,
    );
}

/// A table of integers that are not negative.
fn integers(name: &str, list: &[usize], text: &mut String) {
    let short = list.iter().all(|&value| u16::try_from(value).is_ok());
    let of = if short { "uint16_t" } else { "uint32_t" };
    let _ = writeln!(text, "    static const {of} {name}[{}] = {{", list.len());
    rows(list.iter().map(|value| format!("{value}u")), 12, text);
}

fn rows(list: impl Iterator<Item = String>, width: usize, text: &mut String) {
    let list: Vec<String> = list.collect();
    for row in list.chunks(width) {
        let _ = writeln!(text, "        {},", row.join(", "));
    }
    text.push_str("    };\n");
}

const WITHIN: &str = "
/* Internal: the value of a polynomial. */
static inline double @p@_internal_polynomial(const double *coefficients, double r)
{
    double sum = 0.0;
    uint32_t i;
    for (i = /*DEGREES*/; i > 0u; i--) {
        sum = (sum * r) + coefficients[i - 1u];
    }
    return sum;
}

/* Internal: whether the last term of the series is at most half the one before for |p| up to r. */
static inline bool @p@_internal_within(const double *last, const double *before, double r)
{
    const double size = @p@_internal_polynomial(last, r);
    const double whole = @p@_internal_polynomial(before, r);
    /* Without a term to compare with there is no ratio, and rounding's own is none. */
    const bool nothing = (whole <= 0.0) || (size <= (16.0 * DBL_EPSILON));
    return ((size <= (0.5 * whole)) || nothing) && (size <= DBL_MAX);
}

/* Internal: how far, in |p|, the series can be trusted. */
static inline double @p@_internal_radius(const double *last, const double *before)
{
    static const double longer[13] = {
        1.3407807929942597e154, 1.157920892373162e77, 3.402823669209385e38, 18446744073709551616.0,
        4294967296.0, 65536.0, 256.0, 16.0, 4.0, 2.0,
        1.4142135623730951, 1.189207115002721, 1.0905077326652577,
    };
    double r = DBL_MAX;
    const double size = @p@_internal_polynomial(last, 1.0);
    if ((size > 0.0) || (size < 0.0) || !(fabs(size) <= DBL_MAX)) {
        const double smallest = 1.1754943508222875e-38;
        uint32_t i;
        r = @p@_internal_within(last, before, smallest) ? smallest : 0.0;
        for (i = 0u; i < 13u; i++) {
            const double next = r * longer[i];
            if (@p@_internal_within(last, before, next)) {
                r = next;
            }
        }
    }
    return r;
}
";

const ABOUT: &str = "
/**
 * Folds the coefficients for steps of size h (negative: backwards in time). Call it once, and again whenever h or
 * a parameter changes; steps only read the map. It needs about /*BYTES*/ bytes of stack.
 *
 * Returns @P@_OK, @P@_BAD_STEP (h is zero or not finite) or @P@_BAD_PARAMETER (a coefficient is not
 * finite: a parameter is not, or one that is divided by is zero). The map keeps the status: steps with a map that
 * could not be made return it and do nothing.
 */
";

const BEGIN: &str = "    double radius;
    @p@_status status = @P@_OK;
    uint32_t term = 0u;
    uint32_t part = 0u;
    uint32_t slot = 0u;
    uint32_t base;
    uint32_t i;
/*NEXT*/    if ((!(fabs(h) <= DBL_MAX)) || (!(fabs(h) > 0.0))) {
        status = @P@_BAD_STEP;
    }
";

const SYMBOLS: &str = "    for (i = 0u; i < /*SYMBOLS*/; i++) {
        if ((status == @P@_OK) && (!(fabs(symbol[i]) <= DBL_MAX))) {
            status = @P@_BAD_PARAMETER;
        }
    }
    product[0] = 1.0;
    for (i = 0u; i < /*PRODUCTS*/; i++) {
        product[i + 1u] = product[made_of[i]] * symbol[made_by[i]];
    }
";

const BOUND: &str = "        if ((next_bound < /*BOUNDS*/) && (bound_base[next_bound] == base)) {
            i = /*BOUND_AT*/ + (uint32_t)bound_degree[next_bound];
            map->c[i] = map->c[i] + (fabs(value) * bound_weight[next_bound]);
            next_bound++;
        }
";

const LAST: &str = "            if ((next_last < /*LASTS*/) && (last_part[next_last] == part)) {
                const double size = fabs(sum) * last_weight[next_last];
                i = last_degree[next_last];
                if (last_is_highest[next_last] == 1u) {
                    last[i] = last[i] + size;
                } else {
                    before[i] = before[i] + size;
                }
                next_last++;
            }
";

const LOOP: &str = "    power[0] = 1.0;
    for (i = 1u; i < /*POWERS*/; i++) {
        power[i] = power[i - 1u] * h;
    }
    for (i = 0u; i < @P@_COEFFICIENTS; i++) {
        map->c[i] = 0.0;
    }
    for (base = 0u; base < /*BASES*/; base++) {
        double value = 0.0;
        for (; part < part_end[base]; part++) {
            double sum = 0.0;
            for (; term < term_end[part]; term++) {
                sum = sum + /*SUMMAND*/;
            }
            sum = sum * power[power_of[part]];
/*LAST*/            value = value + sum;
        }
        for (; slot < slot_end[base]; slot++) {
            map->c[slot] = value * (double)scale[slot];
        }
/*BOUND*/    }
";

const END: &str = "/*RADIUS*/    for (i = 0u; i < (@P@_COEFFICIENTS - 1u); i++) {
        if ((status == @P@_OK) && (!(fabs(map->c[i]) <= DBL_MAX))) {
            status = @P@_BAD_PARAMETER;
        }
    }
    map->c[@P@_COEFFICIENTS - 1u] = radius * radius;
    if (status != @P@_OK) {
        for (i = 0u; i < @P@_COEFFICIENTS; i++) {
            map->c[i] = (double)NAN;
        }
    }
    map->status = status;
    return status;
}
";
