//! Small files in JSON beside an output, which say what it is: whole or not there.

use std::io::{Error, ErrorKind};
use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::file;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{CliError, unread, unwritten};

/// The note at `path`, a `kind` of file in a word; `None` where there is none.
pub fn read<T: DeserializeOwned>(path: &Path, kind: &str) -> Result<Option<T>, CliError> {
    let text = match read_text(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unread(path)(error)),
    };
    let refuse = |what: &dyn std::fmt::Display| {
        CliError::Option(format!(
            "{} is damaged, or is no {kind} of this version ({what}); begin anew with --restart",
            path.display()
        ))
    };
    if !file::is_sealed(&text) {
        return Err(refuse(&"its checksum is not that of its content"));
    }
    serde_json::from_str(&text).map(Some).map_err(|error| refuse(&error))
}

/// Writes a note: what was there before or the new one, never a piece.
pub fn write<T: Serialize>(note: &T, path: &Path, inputs: &[&Path]) -> Result<(), CliError> {
    let text = serde_json::to_string(note).map_err(Error::other);
    let written = text.and_then(|text| file::write(path, inputs, file::seal(&text).as_bytes()));
    written.map_err(unwritten(path))
}
