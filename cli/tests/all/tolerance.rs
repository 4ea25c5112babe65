//! `--tolerance`: every verb makes the same choice; cases `tolerance_*` show the rest.

use crate::support::Folder;

/// One function chooses K and h, for every verb and every language.
#[test]
fn all_verbs_choose_the_same_truncation_and_step() {
    let folder = Folder::with(
        "name = \"body\"\ngroup = \"SO3\"\nhamiltonian = \"mu[0]^2/3 + mu[1]^2/4 + mu[2]^2/5\"\n[integrator]\ntolerance = 1e-9\n\
         [initial]\nmomentum = [2, 0.5, 1]\n[run]\ntime = 100\n",
    );
    folder.write("states.csv", "mu_1,mu_2,mu_3\n2,0.5,1\n");
    let report = folder.json("simulate system.toml");
    let (truncation, step) = (&report["truncation"], &report["step"]);
    assert_ne!(truncation, 7, "the default");
    for other in
        ["check system.toml --points 1", "ensemble system.toml --initial states.csv --out ends.csv"]
    {
        let found = folder.json(other);
        assert_eq!((&found["truncation"], &found["step"]), (truncation, step), "{other}");
    }
    let chosen = format!("K = {truncation}, step h = {step}");
    for language in ["rust", "c", "cpp", "opencl", "cuda"] {
        folder.run(&format!("emit system.toml --language {language}")).ok().prints(&[&chosen]);
    }
    let series = folder.run("derive system.toml").ok();
    series.prints(&[&format!("truncation {truncation}")]);
}
