//! The command line of coadjoint.
fn main() {}
