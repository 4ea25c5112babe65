//! The formats in which runs and ensembles write rows of numbers.

use std::path::Path;

#[cfg(feature = "parquet")]
use coadjoint_codegen::file;
use coadjoint_codegen::file::Output;
use coadjoint_learn::npy_header;
use coadjoint_learn::table::csv_lines;
use coadjoint_run::number::shortest;

use crate::error::CliError;

/// The format of a file, by the ending of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// Names, then a line per row, in the shortest decimals that read back as the same numbers.
    Csv,
    /// An array of 64-bit floats.
    Npy,
    /// Columns of 64-bit floats; bare numbers until all are there.
    #[cfg(feature = "parquet")]
    Parquet,
}

impl Form {
    /// Chooses the form by the ending of the name that `option` gives.
    pub(crate) fn of(path: &Path, option: &str) -> Result<Self, CliError> {
        let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
        match ending.as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            #[cfg(feature = "parquet")]
            Some("parquet") => Ok(Self::Parquet),
            _ => Err(CliError::Option(format!(
                "{option} {}: the name must end in .csv or .npy, or in .parquet where the program was built with \
                 `--features parquet`",
                path.display()
            ))),
        }
    }

    /// The bytes before the rows: the names of columns in text, the shape of an array.
    pub(crate) fn head(self, names: &[String], shape: &[u64]) -> Vec<u8> {
        match self {
            Self::Csv => csv_lines([names]),
            Self::Npy => npy_header(shape),
            #[cfg(feature = "parquet")]
            Self::Parquet => Vec::new(),
        }
    }

    /// Appends the bytes of rows, each of this many numbers.
    pub(crate) fn append(self, values: &[f64], width: usize, bytes: &mut Vec<u8>) {
        if self != Self::Csv {
            bytes.reserve(8 * values.len());
            return values.iter().for_each(|value| bytes.extend_from_slice(&value.to_le_bytes()));
        }
        for (place, &value) in values.iter().enumerate() {
            bytes.extend_from_slice(shortest(value).as_bytes());
            bytes.push(if (place + 1) % width.max(1) == 0 { b'\n' } else { b',' });
        }
    }

    /// Gives a file of rows its name. The bare numbers of columns with these names become Parquet before.
    #[cfg_attr(not(feature = "parquet"), allow(unused_variables))]
    pub(crate) fn publish(
        self,
        output: &mut Output,
        path: &Path,
        names: &[String],
        inputs: &[&Path],
    ) -> std::io::Result<()> {
        #[cfg(feature = "parquet")]
        if self == Self::Parquet {
            let passing = file::passing(&file::beside(path, ".parquet"));
            let mut whole = Output::open_as(path, &passing, inputs)?;
            to_parquet(&file::passing(path), names, &mut whole)?;
            whole.publish()?;
            // The numbers have served.
            output.discard();
            return Ok(());
        }
        output.publish()
    }
}

/// Writes a Parquet file of columns with these names, of a file that has the bare numbers of their rows.
#[cfg(feature = "parquet")]
fn to_parquet(from: &Path, names: &[String], to: &mut Output) -> std::io::Result<()> {
    use std::io::Read;
    /// Rows of a row group.
    const GROUP: usize = 1 << 17;
    let mut source = std::io::BufReader::new(std::fs::File::open(from)?);
    to.begin(&[])?;
    let next = || {
        let mut raw = Vec::new();
        source.by_ref().take((GROUP * names.len() * 8) as u64).read_to_end(&mut raw)?;
        Ok(raw.as_chunks::<8>().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect())
    };
    coadjoint_learn::table::write_parquet(&mut *to, names, next).map_err(std::io::Error::other)?;
    to.sync()
}
