//! The worked example of integrators from a build script: see `tests/front_ends.rs`, and
//! `tests/parts.rs` for the large one.

fn main() -> Result<(), coadjoint_codegen::BuildError> {
    // Several steps at once are tried whatever the width of registers: see `tests/at_once.rs`.
    println!("cargo:rustc-check-cfg=cfg(coadjoint_at_once)");
    println!("cargo:rustc-cfg=coadjoint_at_once");
    coadjoint_codegen::Build::new("systems/rigid_body.toml").write("rigid_body.rs")?;
    coadjoint_codegen::Build::new("systems/brackets.toml").truncation(3).write("brackets.rs")?;
    coadjoint_codegen::Build::new("systems/ring_20.toml").write("ring_20.rs")?;
    Ok(())
}
