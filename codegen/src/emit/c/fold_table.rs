//! The data of a fold as tables of C.

use std::fmt::Write;

use super::dialect::decimal;
use super::fold::Fold;
use super::radius::LastTerm;
use crate::integrator::{Coefficients, Products};

/// The data of a fold, bases renumbered.
pub struct Table {
    factors: Vec<f64>,
    product_of: Vec<usize>,
    /// Of which product and by which symbol each is made.
    pub products: Vec<(usize, usize)>,
    power_of: Vec<usize>,
    term_end: Vec<usize>,
    part_end: Vec<usize>,
    slot_end: Vec<usize>,
    scale: Vec<usize>,
    last_part: Vec<usize>,
    /// One more than the highest power of h.
    pub powers: usize,
}

impl Table {
    /// The data for these coefficients.
    pub fn new(fold: &Fold, coefficients: &Coefficients) -> Self {
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
    pub fn stack(&self, fold: &Fold) -> usize {
        let products = if self.products.is_empty() { 0 } else { 2 * self.products.len() + 1 };
        products + self.powers + 2 * fold.last_places() + 16
    }

    /// The tables.
    pub fn declare(&self, fold: &Fold, text: &mut String) {
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
            let degrees = fold.degrees();
            let place = |term: &LastTerm| term.factor as usize * degrees + term.degree as usize;
            integers("last_place", &fold.last.iter().map(place).collect::<Vec<_>>(), text);
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
