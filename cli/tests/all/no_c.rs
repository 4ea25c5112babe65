//! Nothing that the default build compiles is C: whoever builds the command needs no C compiler, and
//! does not wait for one.

/// Crates that compile C, C++ or assembly, or look for such libraries, while building.
const COMPILERS: [&str; 7] =
    ["bindgen", "cc", "cmake", "nasm-rs", "pkg-config", "vcpkg", "zstd-sys"];

#[test]
fn nothing_in_the_default_build_compiles_c() {
    let output = std::process::Command::new(env!("CARGO"))
        .current_dir(crate::support::root())
        .args(["tree", "--offline", "--locked", "-p", "coadjoint-cli", "-p", "coadjoint-learn"])
        .args(["-e", "normal,build", "--prefix", "none", "-f", "{p}"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    let names: Vec<&str> = tree.lines().filter_map(|line| line.split(' ').next()).collect();
    assert!(names.contains(&"coadjoint-cli") && names.contains(&"zip"), "{tree}");
    let found: Vec<&&str> = names.iter().filter(|name| COMPILERS.contains(name)).collect();
    assert!(
        found.is_empty(),
        "{found:?}: `cargo tree -e normal,build -i` shows what brings them in. If it is `pest` from \
         2.9 on, keep it at 2.8.6 (`cargo update -p pest --precise 2.8.6`) or leave `npyz` out"
    );
}
