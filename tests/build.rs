//! Integrators from a build script, of system files as users write them: for `tests/all/emitted_steps.rs` with all of
//! `systems/emitted`, and `tests/all/parts.rs` with a large one.

use std::error::Error;
use std::path::PathBuf;

use coadjoint_codegen::Build;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=systems/emitted");
    Build::new("systems/weighted_body.toml").write("weighted_body.rs")?;
    Build::new("systems/fast_body.toml").write("fast_body.rs")?;
    Build::new("systems/ring_20.toml").write("ring_20.rs")?;
    Build::new("systems/driven_vehicle.toml").write("driven_vehicle.rs")?;
    let folder = PathBuf::from(std::env::var("OUT_DIR")?).join("emitted");
    std::fs::create_dir_all(&folder)?;
    for entry in std::fs::read_dir("systems/emitted")? {
        let file = entry?.path();
        let name = file.file_stem().ok_or("a file without a name")?;
        Build::new(&file).write_to(&folder.join(name).with_extension("rs"))?;
    }
    Ok(())
}
