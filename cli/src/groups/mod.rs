//! `coadjoint groups`: the groups that have a name, and what is known of one of them or of a product.
//!
//! Everything printed is computed from the catalogue of `coadjoint-codegen`.

mod facts;
mod text;

use coadjoint_codegen::lie::{RationalMatrix, StructureConstant, catalogue};
use serde_json::{Value, json};

use crate::arguments::GroupOptions;
use crate::error::CliError;
use crate::named::Format;
use facts::Description;

/// Prints the list of groups, or one group.
pub(crate) fn run(options: &GroupOptions) -> Result<(), CliError> {
    let Some(name) = &options.name else {
        let all: Vec<Description> = catalogue::names()
            .iter()
            .map(|name| Description::new(name))
            .collect::<Result<_, _>>()?;
        match options.format {
            Format::Json => outln!("{:#}", list(&all)),
            Format::Text => out!("{}", text::list(&all)),
        }
        return Ok(());
    };
    let facts = Description::new(name)?.with_casimirs(options.degree)?;
    match options.format {
        Format::Json => outln!("{:#}", group(&facts)),
        Format::Text => out!("{}", text::group(&facts)),
    }
    Ok(())
}

/// The list of groups.
fn list(all: &[Description]) -> Value {
    all.iter()
        .map(|facts| {
            json!({
                "name": facts.algebra.name(),
                "dimension": facts.algebra.dim(),
                "summary": facts.summary,
                "charts": charts(facts).iter().map(|chart| chart["name"].clone()).collect::<Value>(),
            })
        })
        .collect()
}

/// Everything about one group. Indices count from 1, numbers are exact texts.
fn group(facts: &Description) -> Value {
    let algebra = &facts.algebra;
    let dim = algebra.dim();
    let constant = |c: &StructureConstant| json!({ "i": c.i + 1, "j": c.j + 1, "k": c.k + 1, "value": c.value.to_string() });
    // Nonzero entries: the matrices of large products are mostly zeros.
    let matrix = |matrix: &RationalMatrix| {
        matrix
            .entries()
            .map(|(i, j, value)| json!({ "row": i + 1, "column": j + 1, "value": value.to_string() }))
            .collect::<Value>()
    };
    json!({
        "name": algebra.name(),
        "summary": facts.summary,
        "dimension": dim,
        "matrix_size": facts.size(),
        "basis": algebra.basis().map(|basis| basis.iter().map(matrix).collect::<Value>()),
        "structure_constants": algebra.structure().iter().map(constant).collect::<Value>(),
        "ad_star": {
            "convention": "<ad*_xi mu, eta> = <mu, [xi, eta]>; d mu/dt = ad*_xi mu with xi = dH/dmu",
            "in_vectors": facts.ad_star_in_vectors(),
            "components": (0..dim).map(|j| facts.ad_star(j)).collect::<Value>(),
        },
        "casimirs": {
            "degree": facts.degree,
            "generators": facts.casimirs.iter().map(|c| facts.casimir(c)).collect::<Value>(),
        },
        "nilpotent": facts.nilpotent,
        "charts": charts(facts),
    })
}

fn charts(facts: &Description) -> Vec<Value> {
    let mut charts = vec![json!({ "name": "exp", "domain": facts.exp_domain() })];
    if let Ok(domain) = facts.cayley_domain() {
        charts.push(json!({ "name": "cayley", "domain": domain }));
    }
    charts
}
