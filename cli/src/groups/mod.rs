//! `coadjoint groups`: the groups that have a name, and what is known of one of them or of a product.
//!
//! Everything printed is computed from the catalogue of `coadjoint-codegen`.

mod facts;
mod json;
mod text;

use coadjoint_codegen::lie::catalogue;

use crate::arguments::GroupOptions;
use crate::error::CliError;
use crate::named::Format;
use facts::Facts;

/// Prints the list of groups, or one group.
pub(crate) fn run(options: &GroupOptions) -> Result<(), CliError> {
    let json = options.json || options.format == Format::Json;
    let Some(name) = &options.name else {
        let all: Vec<Facts> =
            catalogue::names().iter().map(|name| Facts::new(name)).collect::<Result<_, _>>()?;
        match json {
            true => outln!("{:#}", json::list(&all)),
            false => out!("{}", text::list(&all)),
        }
        return Ok(());
    };
    let facts = Facts::new(name)?.with_casimirs(options.degree)?;
    match json {
        true => outln!("{:#}", json::group(&facts)),
        false => out!("{}", text::group(&facts)),
    }
    Ok(())
}
