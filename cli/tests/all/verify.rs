//! `verify`: changes of arrays and of reports; cases `verify_*` show the rest.

use crate::support::{BODY, Folder};

/// The file is right.
fn right(folder: &Folder, arguments: &str) {
    assert_eq!(folder.json(&format!("verify {arguments}"))["verdict"], "no row is wrong");
}

/// The file is wrong, which is said by these words.
fn wrong(folder: &Folder, arguments: &str, words: &str) {
    folder.run(&format!("verify {arguments}")).fails(1, &[words]);
}

#[test]
fn changes_of_reports_and_arrays_are_found() {
    let folder = Folder::new();
    let mut report = folder.json(&format!("simulate {BODY} --time 10"));
    folder.write("report.json", format!("{report}\n{report}\n"));
    assert_eq!(folder.json("verify report.json").as_array().unwrap().len(), 2);
    for (pointer, change) in [("/momentum/2", 1e-10), ("/group_element_blocks/0/matrix/1/2", 1e-9)]
    {
        let number = report.pointer_mut(pointer).unwrap();
        let before = number.clone();
        *number = (before.as_f64().unwrap() + change).into();
        folder.write("report.json", report.to_string());
        wrong(&folder, "report.json", "row 2, time 10");
        *report.pointer_mut(pointer).unwrap() = before;
    }
    // A matrix without names.
    folder.run(&format!("simulate {BODY} --time 3 --out run.npy")).ok();
    right(&folder, "run.npy");
    let mut bytes = folder.bytes("run.npy");
    let place = 128 + 8 * (12 * 17 + 2);
    let value = f64::from_le_bytes(bytes[place..place + 8].try_into().unwrap());
    bytes[place..place + 8].copy_from_slice(&(value * (1.0 + 1e-11)).to_le_bytes());
    folder.write("run.npy", &bytes);
    wrong(&folder, "run.npy", "row 13, time 1.2");
    folder.write("run.npy", &bytes[..1000]);
    folder.refused(&[("verify run.npy", "its shape [31, 17] needs more than the 872 bytes")]);
}

#[cfg(feature = "parquet")]
#[test]
fn parquet_files_are_judged_too() {
    let folder = Folder::new();
    let judged = format!("{BODY} ends.parquet --input states.csv --steps 50 --step 0.1");
    // The ends of the starts, and of others.
    for (file, last) in [("states.csv", "-1.0"), ("other.csv", "-1.0000000001")] {
        folder.write(file, format!("mu_1,mu_2,mu_3\n2.0,0.5,1.0\n1.0,0.5,{last}\n"));
        folder.run(&format!("ensemble {BODY} --initial {file} --out ends.parquet --time 5")).ok();
        match file {
            "states.csv" => right(&folder, &judged),
            _ => wrong(&folder, &judged, "row 2: "),
        }
    }
}

#[cfg(not(feature = "parquet"))]
#[test]
fn parquet_files_need_the_feature() {
    let folder = Folder::new();
    folder.write("ends.parquet", "");
    let verify = format!("verify {BODY} ends.parquet");
    folder.refused(&[(&verify, "without the feature `parquet`")]);
}
