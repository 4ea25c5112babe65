//! Why there is no machine code of a kernel.

/// Why there is no machine code of a kernel.
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
