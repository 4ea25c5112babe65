//! The processor of this machine, and its code for a function.

use cranelift_codegen::ir::Function;
use cranelift_codegen::isa::OwnedTargetIsa;
use cranelift_codegen::settings::{self, Configurable};
use cranelift_codegen::{Context, FinalizedMachReloc};

/// Errors of making machine code of a kernel.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum JitError {
    /// Cranelift makes no code for this processor, or none that was tried.
    #[error("machine code by Cranelift: {0}")]
    Host(String),
    /// The processor has no instruction for fused products: bits could not agree with the interpreter's.
    #[error("machine code by Cranelift: this processor has no fused product (FMA)")]
    NoFusedProduct,
    /// The kernel's state does not fit a frame of the stack.
    #[error(
        "machine code by Cranelift: a frame of {bytes} bytes is more than the {most} it may take"
    )]
    Large {
        /// Bytes asked for.
        bytes: usize,
        /// Bytes there may be.
        most: usize,
    },
    /// Cranelift refused a function, or the system refused memory for its code.
    #[error("machine code by Cranelift: {0}")]
    Compile(String),
}

/// Machine code of a function, not yet where it runs.
pub(super) struct Assembled {
    pub(super) function: Function,
    pub(super) bytes: Vec<u8>,
    pub(super) alignment: u64,
    pub(super) relocations: Vec<FinalizedMachReloc>,
}

/// Cranelift's description of this processor, with the settings of steps.
pub(super) fn isa() -> Result<OwnedTargetIsa, JitError> {
    let refuse = |reason: &dyn std::fmt::Display| JitError::Host(reason.to_string());
    let mut flags = settings::builder();
    for (name, value) in [
        ("is_pic", "false"),
        ("use_colocated_libcalls", "false"),
        // Programs are hash-consed already: nothing is left to find, and looking costs as much as all the rest.
        ("opt_level", "none"),
        ("regalloc_algorithm", "backtracking"),
        ("enable_verifier", "false"),
        // Frames of large groups take more than a page of the stack.
        ("enable_probestack", "true"),
        ("probestack_strategy", "inline"),
    ] {
        flags.set(name, value).map_err(|error| refuse(&error))?;
    }
    let builder = cranelift_native::builder().map_err(|error| refuse(&error))?;
    let isa = builder.finish(settings::Flags::new(flags)).map_err(|error| refuse(&error))?;
    if cfg!(target_arch = "x86_64") {
        let has = |name: &str| {
            isa.isa_flags().iter().any(|flag| flag.name == name && flag.as_bool() == Some(true))
        };
        // Without, Cranelift would call a function for each fused product; vectors need the instructions of AVX.
        if !has("has_fma") || !has("has_avx") {
            return Err(JitError::NoFusedProduct);
        }
    } else if !cfg!(target_arch = "aarch64") {
        return Err(refuse(&format!("processors of the kind {} are not tried", isa.triple())));
    }
    Ok(isa)
}

/// Machine code of a function.
pub(super) fn assemble(isa: &OwnedTargetIsa, function: Function) -> Result<Assembled, JitError> {
    let mut context = Context::for_function(function);
    context
        .compile(&**isa, &mut Default::default())
        .map_err(|error| JitError::Compile(error.inner.to_string()))?;
    let compiled = context.take_compiled_code();
    let Some(compiled) = compiled else {
        return Err(JitError::Compile("no code came out".into()));
    };
    Ok(Assembled {
        bytes: compiled.buffer.data().to_vec(),
        alignment: u64::from(compiled.buffer.alignment),
        relocations: compiled.buffer.relocs().to_vec(),
        function: context.func,
    })
}
