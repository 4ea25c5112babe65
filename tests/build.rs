//! The worked example of integrators from a build script: see `tests/front_ends.rs`, and
//! `tests/parts.rs` for the large one.

fn main() -> Result<(), coadjoint_codegen::BuildError> {
    coadjoint_codegen::Build::new("systems/rigid_body.toml").write("rigid_body.rs")?;
    coadjoint_codegen::Build::new("systems/brackets.toml").truncation(3).write("brackets.rs")?;
    coadjoint_codegen::Build::new("systems/ring_20.toml").write("ring_20.rs")?;
    Ok(())
}
