//! Machine code in executable memory, and how long it stays there.
#![allow(unsafe_code)]

use std::sync::{Arc, Mutex};

use coadjoint_program::Kernel;
use cranelift_codegen::isa::OwnedTargetIsa;
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{FuncId, Linkage, Module, ModuleError, ModuleReloc, default_libcall_names};

use crate::entry::{AdvanceFunction, Entry, LanesFunction};
use crate::jit::host::{Assembled, JitError};

/// Executable memory, freed when the last entry to it is dropped.
struct Code(Mutex<Option<JITModule>>);

impl Drop for Code {
    fn drop(&mut self) {
        let module = match self.0.get_mut() {
            Ok(module) => module.take(),
            Err(poisoned) => poisoned.into_inner().take(),
        };
        if let Some(module) = module {
            // SAFETY: entries call their code through a shared reference only, and each holds this memory by an `Arc`:
            // none is left that could be running or could run.
            unsafe { module.free_memory() }
        }
    }
}

fn failed(error: ModuleError) -> JitError {
    JitError::Compile(error.to_string())
}

/// Copies functions of a kernel to executable memory.
pub(super) fn load(
    kernel: &Kernel,
    isa: OwnedTargetIsa,
    advance: Option<&Assembled>,
    lanes: Option<&Assembled>,
) -> Result<Entry, JitError> {
    // Owned at once, so that memory is freed on every way out.
    let module = JITModule::new(JITBuilder::with_isa(isa, default_libcall_names()));
    let mut code = Code(Mutex::new(Some(module)));
    let Ok(Some(module)) = code.0.get_mut() else {
        return Err(JitError::Compile("no memory for code".into()));
    };
    let advance = advance.map(|assembled| define(module, "advance", assembled)).transpose()?;
    let lanes = lanes.map(|assembled| define(module, "lanes", assembled)).transpose()?;
    module.finalize_definitions().map_err(failed)?;
    // SAFETY: code that `steps::build` makes for one trajectory has this signature and the system's calling convention.
    let advance = advance.map(|id| unsafe {
        std::mem::transmute::<*const u8, AdvanceFunction>(module.get_finalized_function(id))
    });
    // SAFETY: so has the code that it makes for pairs.
    let lanes = lanes.map(|id| unsafe {
        std::mem::transmute::<*const u8, LanesFunction>(module.get_finalized_function(id))
    });
    // SAFETY: both are compiled from this kernel, touch nothing but what they are given and their own stack, and stay as
    // long as `code`.
    Ok(unsafe { Entry::new(kernel, advance, lanes, Arc::new(code)) })
}

/// Adds a function to the memory.
fn define(module: &mut JITModule, name: &str, assembled: &Assembled) -> Result<FuncId, JitError> {
    let Assembled { function, bytes, alignment, relocations } = assembled;
    let id = module.declare_function(name, Linkage::Export, &function.signature).map_err(failed)?;
    let relocations: Vec<ModuleReloc> = relocations
        .iter()
        .map(|relocation| ModuleReloc::from_mach_reloc(relocation, function, id))
        .collect();
    module.define_function_bytes(id, *alignment, bytes, &relocations).map_err(failed)?;
    Ok(id)
}
