//! The names of the columns of records.

use super::outlet::Begun;

/// The drifts of a record, in the order of [`Drift`](super::Drift).
const DRIFTS: [&str; 3] = ["spatial_momentum_drift", "casimir_drift", "energy_drift"];

/// `time`, the coordinates of the momentum as the system file names them (`mu_1`, … where it names none), the entries of
/// the blocks of g, row by row, as `g_11`, … by their places in the whole matrix (`g_1_12` in matrices of more than nine
/// rows), the energy and the drifts that there are.
pub fn columns(coordinates: &[String], begun: &Begun<'_>) -> Vec<String> {
    let Begun { blocks, known, energy, .. } = *begun;
    let drifts = DRIFTS.iter().zip(known).filter_map(|(name, known)| known.then_some(*name));
    let last: Vec<&str> = energy.then_some("energy").into_iter().chain(drifts).collect();
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
    names.extend(last.into_iter().map(str::to_owned));
    names
}

#[cfg(test)]
mod tests {
    use super::super::blocks::{Block, Kind};
    use super::super::recorder::Scales;
    use super::*;

    #[test]
    fn columns_have_the_names_of_the_file_and_none_twice() {
        let blocks =
            [Block { range: 0..1, kind: Kind::Real }, Block { range: 1..2, kind: Kind::Real }];
        let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let scales = Scales::default();
        let whole = Begun { blocks: &blocks, known: [true; 3], energy: true, scales: &scales };
        let found = columns(&names(&["mu[0]", "energy", "x"]), &whole);
        assert_eq!(found[..6], names(&["time", "mu_1", "momentum_energy", "x", "g_11", "g_22"]));
        assert_eq!(found[6], "energy");
        assert_eq!(found[7..], names(&DRIFTS));
        let part = Begun { blocks: &[], known: [false, true, false], energy: false, ..whole };
        assert_eq!(
            columns(&names(&["energy"]), &part),
            names(&["time", "energy", "casimir_drift"])
        );
    }
}
