//! Small files in JSON that say how far a run has come or what an output is: whole or not there.

use std::collections::BTreeMap;
use std::io::{Error, ErrorKind};
use std::path::Path;

use coadjoint_codegen::diagnostic::read_text;
use coadjoint_codegen::file;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::error::{CliError, unread, unwritten};

/// The description of a run; one that goes on must agree in every entry.
pub(crate) type Identity = BTreeMap<String, String>;

/// The note at `path`, a `kind` of file in a word; `None` where there is none. `advice` says how to begin anew.
pub(crate) fn read<T: DeserializeOwned>(
    path: &Path,
    kind: &str,
    advice: &str,
) -> Result<Option<T>, CliError> {
    let text = match read_text(path) {
        Ok(text) => text,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(unread(path)(error)),
    };
    let refuse = |what: &dyn std::fmt::Display| {
        CliError::Option(format!(
            "{} is damaged, or is no {kind} of this version ({what}): {advice}",
            path.display()
        ))
    };
    if !file::is_sealed(&text) {
        return Err(refuse(&"its checksum is not that of its content"));
    }
    serde_json::from_str(&text).map(Some).map_err(|error| refuse(&error))
}

/// Writes a note: the old note is there or the new one, never a piece.
pub(crate) fn write<T: Serialize>(note: &T, path: &Path, inputs: &[&Path]) -> Result<(), CliError> {
    let text = serde_json::to_string(note).map_err(Error::other);
    let written = text.and_then(|text| file::write(path, inputs, file::seal(&text).as_bytes()));
    written.map_err(unwritten(path))
}

/// Refuses the note at `path` of a run that `was` another, by the first entry that differs.
pub(crate) fn agree(
    path: &Path,
    was: &Identity,
    is: &Identity,
    advice: &str,
) -> Result<(), CliError> {
    for key in was.keys().chain(is.keys()) {
        let [was, is] = [was, is].map(|identity| identity.get(key));
        if was != is {
            let said = |value: Option<&String>| value.map_or("nothing", String::as_str).to_owned();
            return Err(CliError::Option(format!(
                "{} is of a run with another {key}: {} then, {} now; {advice}",
                path.display(),
                said(was),
                said(is)
            )));
        }
    }
    Ok(())
}
