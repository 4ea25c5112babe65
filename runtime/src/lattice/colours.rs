//! Colours of edges and of sites, each the first that is free.

use alloc::vec::Vec;

use super::graph::Edge;
use super::layout::Adjacency;

/// The edges, by their numbers, of each colour: those of one colour share no site.
pub fn edges(sites: usize, edges: &[Edge]) -> Vec<Vec<u32>> {
    let mut colours: Vec<Vec<u32>> = Vec::new();
    // The colours of the edges of each site, 64 to a word; few sites need a second word.
    let mut used: Vec<Vec<u64>> = Vec::new();
    for (at, &[a, b]) in edges.iter().enumerate() {
        let mut word = 0;
        let (word, bit) = loop {
            if word == used.len() {
                used.push(alloc::vec![0; sites]);
            }
            let taken = used[word][a as usize] | used[word][b as usize];
            if taken != u64::MAX {
                break (word, taken.trailing_ones());
            }
            word += 1;
        };
        used[word][a as usize] |= 1 << bit;
        used[word][b as usize] |= 1 << bit;
        let colour = 64 * word + bit as usize;
        if colour == colours.len() {
            colours.push(Vec::new());
        }
        colours[colour].push(at as u32);
    }
    colours
}

/// The colour of each site, which none of its neighbours has, and the number of colours.
pub fn sites(neighbours: &Adjacency) -> (Vec<u32>, u32) {
    let (mut colours, mut count) = (Vec::with_capacity(neighbours.sites()), 0);
    let mut taken: Vec<u32> = Vec::new();
    for site in 0..neighbours.sites() {
        taken.clear();
        // Sites that come later have no colour yet.
        taken.extend(neighbours.of(site).iter().filter_map(|other| colours.get(*other as usize)));
        taken.sort_unstable();
        let mut colour = 0;
        for other in &taken {
            colour += u32::from(*other == colour);
        }
        colours.push(colour);
        count = count.max(colour + 1);
    }
    (colours, count)
}
