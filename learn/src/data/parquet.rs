//! Parquet with columns of 64- or 32-bit floats (uncompressed or Snappy).

use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::{Repetition, Type as PhysicalType};
use ::parquet::data_type::DoubleType;
use ::parquet::errors::ParquetError;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::reader::{FileReader, SerializedFileReader};
use ::parquet::file::writer::SerializedFileWriter;
use ::parquet::record::Field;
use ::parquet::schema::types::Type;

use coadjoint_codegen::file;

use super::columns::Columns;
use crate::error::LearnError;

/// Reads every column of numbers; others are left out.
pub(super) fn read(path: &Path) -> Result<Columns, LearnError> {
    let format = |e: ParquetError| LearnError::format(path, "Parquet", e);
    let file = file::open_whole(path).map_err(LearnError::file(path))?;
    let reader = SerializedFileReader::new(file).map_err(format)?;
    let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
    for row in reader.get_row_iter(None).map_err(format)? {
        let row = row.map_err(format)?;
        let mut numbers = 0;
        for (name, field) in row.get_column_iter() {
            let value = match field {
                Field::Double(v) => *v,
                Field::Float(v) => f64::from(*v),
                Field::Null => f64::NAN,
                _ => continue,
            };
            if columns.len() <= numbers {
                columns.push((name.clone(), Vec::new()));
            }
            columns[numbers].1.push(value);
            numbers += 1;
        }
    }
    Columns::new(columns)
}

/// The columns as required 64-bit floats, in one row group.
pub(super) fn bytes(columns: &Columns) -> Result<Vec<u8>, ParquetError> {
    let fields = columns.names().iter().map(|name| {
        Type::primitive_type_builder(name, PhysicalType::DOUBLE)
            .with_repetition(Repetition::REQUIRED)
            .build()
            .map(Arc::new)
    });
    let fields: Vec<_> = fields.collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("pairs").with_fields(fields).build()?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(Vec::new(), Arc::new(schema), properties)?;
    let mut group = writer.next_row_group()?;
    for column in columns.values() {
        if let Some(mut out) = group.next_column()? {
            out.typed::<DoubleType>().write_batch(column, None, None)?;
            out.close()?;
        }
    }
    group.close()?;
    writer.into_inner()
}
