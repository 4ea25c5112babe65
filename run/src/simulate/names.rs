//! The names of the columns of records.

use super::blocks::Block;

/// What a record ends with.
const LAST: [&str; 4] = ["energy", "spatial_momentum_drift", "casimir_drift", "energy_drift"];
/// The same where no energy is known.
const LAST_WITHOUT_ENERGY: [&str; 2] = ["spatial_momentum_drift", "casimir_drift"];

/// `time`, the coordinates of the momentum as the system file names them (`mu_1`, … where it names none),
/// the entries of the blocks of g, row by row, as `g_11`, … by their places in the whole matrix
/// (`g_1_12` in matrices of more than nine rows), the energy and the three drifts; without energy the other two.
pub fn columns(coordinates: &[String], blocks: &[Block], energy: bool) -> Vec<String> {
    let last: &[&str] = if energy { &LAST } else { &LAST_WITHOUT_ENERGY };
    let size = blocks.last().map_or(0, |block| block.range.end);
    let separator = if size > 9 { "_" } else { "" };
    let elements: Vec<String> = blocks
        .iter()
        .flat_map(|block| {
            let indices = block.range.start + 1..=block.range.end;
            let name = move |i, j| format!("g_{i}{separator}{j}");
            indices.clone().flat_map(move |i| indices.clone().map(move |j| name(i, j)))
        })
        .collect();
    let taken =
        |name: &String| name == "time" || last.contains(&name.as_str()) || elements.contains(name);
    let momentum = coordinates.iter().enumerate().map(|(i, name)| {
        if *name == format!("mu[{i}]") {
            format!("mu_{}", i + 1)
        } else if taken(name) {
            format!("momentum_{name}")
        } else {
            name.clone()
        }
    });
    let mut names = vec!["time".to_owned()];
    names.extend(momentum);
    names.extend(elements.iter().cloned());
    names.extend(last.iter().map(|&name| name.to_owned()));
    names
}

#[cfg(test)]
mod tests {
    use super::super::blocks::Kind;
    use super::*;

    #[test]
    fn columns_have_the_names_of_the_file_and_none_twice() {
        let blocks =
            [Block { range: 0..1, kind: Kind::Real }, Block { range: 1..2, kind: Kind::Real }];
        let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let found = columns(&names(&["mu[0]", "energy", "x"]), &blocks, true);
        assert_eq!(found[..6], names(&["time", "mu_1", "momentum_energy", "x", "g_11", "g_22"]));
        assert_eq!(found[6..], names(&LAST));
        let found = columns(&names(&["energy"]), &[], false);
        assert_eq!(found, names(&["time", "energy", "spatial_momentum_drift", "casimir_drift"]));
    }
}
