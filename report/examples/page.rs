use coadjoint_learn::experiment::{NAMES, RunOptions, run};
use coadjoint_report::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let o = RunOptions { quick: a[1] == "quick", seed: 0, out: Some(a[2].clone().into()) };
    let mut reports = Vec::new();
    for n in NAMES {
        if std::path::Path::new(&format!("{}/{n}.json", a[2])).exists() {
            let t = std::fs::read_to_string(format!("{}/{n}.json", a[2])).unwrap();
            let mut r: coadjoint_learn::experiment::Report = serde_json::from_str(&t).unwrap();
            for c in &mut r.curves {
                let t = std::fs::read_to_string(format!("{}/{}.csv", a[2], c.name)).unwrap();
                let mut l = t.lines();
                c.columns = l.next().unwrap().split(',').map(str::to_owned).collect();
                c.rows = l.map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect();
            }
            reports.push(r);
        }
    }
    let _ = (o, run);
    let benchmarks =
        a.get(4).map(|d| read_benchmarks(std::path::Path::new(d)).unwrap()).unwrap_or_default();
    std::fs::write(&a[3], page(&Page { reports, benchmarks, gallery: vec![] })).unwrap();
}
