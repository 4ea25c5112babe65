//! Small files in JSON beside an output, which say what it is: whole or not there.

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use super::output::{beside, rename, unwritten};
use crate::error::CliError;

/// What is noted at `path`, a `kind` of file in a word; `None` where there is none.
pub fn read<T: DeserializeOwned>(path: &Path, kind: &str) -> Result<Option<T>, CliError> {
    match fs::read_to_string(path) {
        Ok(text) => serde_json::from_str(&text).map(Some).map_err(|error| {
            CliError::Option(format!(
                "{} is no {kind} of this version ({error}); begin anew with --restart",
                path.display()
            ))
        }),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(source) => Err(CliError::Read { path: path.into(), source }),
    }
}

/// Writes a note: what was there before or the new one, never a piece.
pub fn write<T: Serialize>(note: &T, path: &Path) -> Result<(), CliError> {
    let text = serde_json::to_string(note).map_err(|error| unwritten(path, &error))?;
    let next = beside(path, ".next");
    let write = || -> std::io::Result<()> {
        let mut file = File::create(&next)?;
        file.write_all(text.as_bytes())?;
        file.sync_data()
    };
    write().map_err(|error| unwritten(&next, &error))?;
    rename(&next, path)
}
