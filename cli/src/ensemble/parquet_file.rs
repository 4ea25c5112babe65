//! Bare numbers become a Parquet file.

use std::fs::File;
use std::io::{BufReader, Read};
use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::{Repetition, Type as PhysicalType};
use ::parquet::data_type::DoubleType;
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::schema::types::Type;

use coadjoint_codegen::file::Output;
use coadjoint_run::ensemble::Layout;

/// Rows of a row group.
const GROUP: usize = 1 << 17;

/// Writes the numbers of `from`, row-major, as the columns of a Parquet file to `to`.
pub fn convert(from: &Path, to: &mut Output, layout: &Layout) -> Result<(), ParquetError> {
    let names = layout.names();
    let column = |name: &String| {
        Type::primitive_type_builder(name, PhysicalType::DOUBLE)
            .with_repetition(Repetition::REQUIRED)
            .build()
            .map(Arc::new)
    };
    let columns = names.iter().map(column).collect::<Result<Vec<_>, _>>()?;
    let schema = Type::group_type_builder("states").with_fields(columns).build()?;
    to.begin(&[])?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(&mut *to, Arc::new(schema), properties)?;
    let mut source = BufReader::new(File::open(from)?);
    let row = names.len() * 8;
    loop {
        let mut raw = Vec::new();
        source.by_ref().take((GROUP * row) as u64).read_to_end(&mut raw)?;
        if raw.is_empty() {
            break;
        }
        let numbers = raw.as_chunks::<8>().0;
        let mut group = writer.next_row_group()?;
        let mut place = 0;
        while let Some(mut column) = group.next_column()? {
            let values: Vec<f64> = numbers
                .iter()
                .skip(place)
                .step_by(names.len())
                .map(|bytes| f64::from_le_bytes(*bytes))
                .collect();
            column.typed::<DoubleType>().write_batch(&values, None, None)?;
            column.close()?;
            place += 1;
        }
        group.close()?;
    }
    writer.close()?;
    Ok(to.sync()?)
}
