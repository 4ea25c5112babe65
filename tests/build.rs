//! Integrators from a build script: those of system files as users write them (`tests/all/front_ends.rs`,
//! `tests/all/emitted_steps.rs` with a potential, `tests/all/parts.rs` for a large one), and those of `src/emitted.rs`.

use std::error::Error;
use std::path::PathBuf;

use coadjoint_codegen::{Build, emit};

#[path = "src/emitted.rs"]
mod emitted;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/emitted.rs");
    Build::new("systems/rigid_body.toml").write("rigid_body.rs")?;
    Build::new("systems/brackets.toml").truncation(3).write("brackets.rs")?;
    Build::new("systems/weighted_body.toml").write("weighted_body.rs")?;
    Build::new("systems/fast_body.toml").write("fast_body.rs")?;
    Build::new("systems/ring_20.toml").write("ring_20.rs")?;
    Build::new("systems/driven_vehicle.toml").write("driven_vehicle.rs")?;
    let folder = PathBuf::from(std::env::var("OUT_DIR")?).join("emitted");
    std::fs::create_dir_all(&folder)?;
    for source in emitted::SYSTEMS {
        let origin = emitted::origin(source)?;
        let name = origin.facts().name;
        let text = emit::file(emit::items_of(&origin, &emit::Options::for_problem(name))?);
        std::fs::write(folder.join(format!("{name}.rs")), text)?;
    }
    Ok(())
}
