//! A short run of the stress program: no accepted step is wrong, and none is refused that must not be.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use coadjoint_tests::stress::{Campaign, report, run};

#[test]
fn no_wrong_step_is_accepted() {
    let options = Campaign {
        steps: 2_688,
        seed: 20,
        only: String::new(),
        threads: 2,
        instance: None,
        even: true,
    };
    let tallies = run(&options);
    assert!(tallies.len() > 20);
    // Every family has both kinds: the draws lie around the boundary of acceptance.
    for (name, tally) in &tallies {
        // Most steps of a motion that comes to a pole or an edge must be refused: these are counted together.
        assert!(
            tally.accepted > 20 || name.starts_with("edge-"),
            "{name} accepts {} steps",
            tally.accepted
        );
    }
    let edges = tallies.iter().filter(|(name, _)| name.starts_with("edge-"));
    assert!(edges.map(|(_, tally)| tally.accepted).sum::<u64>() > 20);
    assert!(tallies.iter().map(|t| t.1.refused).sum::<u64>() > 1000);
    // Some steps were spoilt, and told.
    assert!(tallies.iter().map(|t| t.1.spoilt).sum::<u64>() > 4);
    assert!(tallies.iter().all(|(_, tally)| tally.wrong() == 0), "{}", report(&tallies));
}

#[test]
fn the_result_does_not_depend_on_threads() {
    let with = |threads| {
        let only = "so3-cayley".to_owned();
        let tallies =
            run(&Campaign { steps: 600, seed: 3, only, threads, instance: None, even: true });
        report(&tallies)
    };
    assert_eq!(with(1), with(3));
}
