//! Loading a library that a compiler wrote: the one place where it happens.
//!
//! Loading runs code that the type system has not checked. It is sound for these reasons: the library was compiled from the
//! text of this very kernel, by a compiler that the user chose, into a folder that nobody else can write to (one of a store has
//! that text beside it); its sizes
//! are compared with the kernel's before a function is called; and it stays loaded as long as an [`Entry`] needs it.
#![allow(unsafe_code)]

use std::error::Error;
use std::path::Path;
use std::sync::Arc;

use coadjoint_program::print::ABI;
use coadjoint_program::{Kernel, Trajectories};
use libloading::Library;

use crate::entry::{AdvanceFunction, Entry, LanesFunction};
use crate::error::NativeError;

/// The entry of a library compiled from [`native_unit`](coadjoint_program::print::native_unit) of this kernel with these
/// functions.
///
/// # Errors
/// [`NativeError::Load`] where it is no library, lacks a function, or has other sizes.
pub(crate) fn load(
    kernel: &Kernel,
    trajectories: Trajectories,
    path: &Path,
) -> Result<Entry, NativeError> {
    let fault = |message: String| NativeError::Load { path: path.to_owned(), message };
    let library = open(path).map_err(|error| fault(told(&error)))?;
    // SAFETY: the array is exported with this type by every version of the printed unit.
    let sizes = unsafe { library.get::<*const [u64; 4]>(b"coadjoint_sizes") };
    let sizes = sizes.map_err(|error| fault(told(&error)))?;
    // SAFETY: the symbol is the address of an array of four numbers, in memory that stays as long as the library.
    let found = unsafe { **sizes };
    let expected = [ABI, kernel.dim as u64, kernel.element as u64, kernel.slots() as u64];
    if found != expected {
        return Err(fault(format!("it has the sizes {found:?}, the step has {expected:?}")));
    }
    let mut advance = None;
    if trajectories.one() {
        // SAFETY: units of this version export the function with this type.
        let found = unsafe { library.get::<AdvanceFunction>(b"coadjoint_advance") };
        advance = Some(*found.map_err(|error| fault(told(&error)))?);
    }
    let mut lanes = None;
    if trajectories.lanes() {
        // SAFETY: as above.
        let found = unsafe { library.get::<LanesFunction>(b"coadjoint_advance_lanes") };
        lanes = Some(*found.map_err(|error| fault(told(&error)))?);
    }
    // SAFETY: the functions were compiled from the kernel's text and touch only what they are given; the library stays
    // loaded until the entry drops it.
    Ok(unsafe { Entry::new(kernel, advance, lanes, Arc::new(library)) })
}

/// An error with its causes: what the system says stands in them.
fn told(error: &libloading::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        text = format!("{text}: {error}");
        cause = error.source();
    }
    text
}

/// Opens a library, all its symbols resolved at once: one that is missing is an error here and not the end of the
/// process later.
fn open(path: &Path) -> Result<Library, libloading::Error> {
    #[cfg(unix)]
    {
        use libloading::os::unix::{Library as Unix, RTLD_LOCAL, RTLD_NOW};
        // SAFETY: the printed unit has no initialisers.
        unsafe { Unix::open(Some(path), RTLD_NOW | RTLD_LOCAL) }.map(Library::from)
    }
    #[cfg(not(unix))]
    // SAFETY: as above.
    unsafe {
        Library::new(path)
    }
}
