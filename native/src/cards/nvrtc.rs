//! NVIDIA's compiler, which needs no card.
//!
//! The type system cannot check here that calls are made with a program that was made by the call before and is ended
//! by none but the last, and lengths that the library gives itself.
#![allow(unsafe_code)]

use std::ffi::{CStr, CString};

use coadjoint_program::Kernel;
use coadjoint_program::print::{DeviceLanguage, device_unit};
use cudarc::nvrtc::result;
use cudarc::nvrtc::sys;

use crate::error::first_errors;

/// A kernel compiled for a kind of card.
#[derive(Clone, Debug)]
pub struct Compiled {
    /// Machine code, as the driver loads it.
    pub code: Vec<u8>,
    /// The compiler's log: registers, memory spilt.
    pub log: String,
}

/// True if the library is installed. (Without it, any other call would end the program.)
pub(crate) fn is_there() -> bool {
    // SAFETY: it only tries to load the library.
    unsafe { sys::is_culib_present() }
}

/// Compiles a kernel with these folded coefficients for cards of an architecture, such as `sm_90`. `None` where NVRTC is
/// not on this machine.
///
/// # Errors
/// The beginning of what the compiler said.
pub fn compile(
    kernel: &Kernel,
    slots: &[f64],
    architecture: &str,
) -> Option<Result<Compiled, String>> {
    let text = device_unit(kernel, slots, DeviceLanguage::Cuda, "Written by coadjoint.");
    is_there().then(|| compile_text(&text, architecture))
}

/// Compiles a text for cards of an architecture; the library has to be there.
pub(crate) fn compile_text(text: &str, architecture: &str) -> Result<Compiled, String> {
    let text = CString::new(text).map_err(|error| error.to_string())?;
    let program = result::create_program(&text, Some(c"coadjoint.cu"));
    let program = Program(program.map_err(|error| error.to_string())?);
    // The functions of the text say how they round; nothing else may be contracted either.
    let options = [
        format!("--gpu-architecture={architecture}"),
        "--fmad=false".into(),
        "--std=c++17".into(),
        "--ptxas-options=-v".into(),
    ];
    // SAFETY: the program was just made.
    let done = unsafe { result::compile_program(program.0, &options) };
    let log = program.log();
    if let Err(error) = done {
        return Err(match log.trim().is_empty() {
            true => error.to_string(),
            false => first_errors(&log),
        });
    }
    let mut length = 0;
    // SAFETY: the program is compiled; the length is written to a number of ours.
    let asked = unsafe { sys::nvrtcGetCUBINSize(program.0, &mut length) };
    asked.result().map_err(|error| error.to_string())?;
    let mut code = vec![0_u8; length];
    // SAFETY: the array is as long as the library has just said.
    let taken = unsafe { sys::nvrtcGetCUBIN(program.0, code.as_mut_ptr().cast()) };
    taken.result().map_err(|error| error.to_string())?;
    Ok(Compiled { code, log })
}

/// A program of the library, ended when it is dropped.
struct Program(sys::nvrtcProgram);

impl Program {
    fn log(&self) -> String {
        // SAFETY: the program lives.
        let log = unsafe { result::get_program_log(self.0) }.unwrap_or_default();
        let bytes: Vec<u8> = log.iter().map(|&letter| letter as u8).collect();
        let text = CStr::from_bytes_until_nul(&bytes).map(CStr::to_string_lossy);
        text.map(std::borrow::Cow::into_owned).unwrap_or_default()
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // SAFETY: the program is ended here alone.
        let _ = unsafe { result::destroy_program(self.0) };
    }
}
