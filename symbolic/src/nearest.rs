//! "Did you mean …?": the nearest of the known names.

/// The known name nearest to `name`, if one is near enough to be meant.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    let allowed = if lower.chars().count() < 5 { 1 } else { 2 };
    known
        .into_iter()
        .map(|candidate| (distance(&lower, &candidate.to_lowercase()), candidate))
        .filter(|&(distance, candidate)| {
            // Short names are all within a few edits of each other: something must be shared.
            distance <= allowed && distance < candidate.chars().count().max(lower.chars().count())
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// The edit distance in which a swap of neighbours counts once (optimal string alignment).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) =
        (a.chars().take(64).collect(), b.chars().take(64).collect());
    let mut before: Vec<usize> = Vec::new();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut next = vec![i + 1];
        for j in 0..b.len() {
            let substituted = row[j] + usize::from(a[i] != b[j]);
            let mut best = substituted.min(row[j + 1] + 1).min(next[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                best = best.min(before[j - 1] + 1);
            }
            next.push(best);
        }
        before = row;
        row = next;
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_swap_or_a_missing_letter_is_near() {
        assert_eq!(distance("truncation", "trucnation"), 1);
        assert_eq!(nearest("tuncation", ["truncation", "chart"]), Some("truncation"));
        assert_eq!(nearest("hamitlonian", ["hamiltonian", "coordinates"]), Some("hamiltonian"));
        assert_eq!(nearest("so3", ["SO3", "SE3"]), Some("SO3"));
    }

    #[test]
    fn what_shares_nothing_is_not_suggested() {
        assert_eq!(nearest("w", ["x", "y", "z"]), None);
        assert_eq!(nearest("banana", ["truncation", "chart"]), None);
        assert_eq!(nearest("log", ["cos", "ln"]), None);
    }
}
