//! The preprocessor: mdBook asks `supports RENDERER`, or gives `[context, book]` as JSON and takes the book back.

use std::io::Read;
use std::process::ExitCode;

use serde_json::Value;

fn main() -> ExitCode {
    if std::env::args().nth(1).as_deref() == Some("supports") {
        return ExitCode::SUCCESS;
    }
    match book() {
        Ok(book) => {
            println!("{book}");
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("formulas: {error}");
            ExitCode::FAILURE
        }
    }
}

fn book() -> Result<Value, Box<dyn std::error::Error>> {
    let mut input = String::new();
    std::io::stdin().read_to_string(&mut input)?;
    let mut input: Value = serde_json::from_str(&input)?;
    let book = input.get_mut(1).ok_or("expected [context, book] on the standard input")?;
    convert(book)?;
    Ok(book.take())
}

/// Converts every chapter below a value.
fn convert(value: &mut Value) -> Result<(), Box<dyn std::error::Error>> {
    match value {
        Value::Array(values) => values.iter_mut().try_for_each(convert),
        Value::Object(fields) => {
            let path = fields.get("source_path").and_then(Value::as_str).unwrap_or("?").to_owned();
            if let Some(Value::String(content)) = fields.get_mut("content") {
                *content = coadjoint_book::with_formulas(content)
                    .map_err(|error| format!("{path}: {error}"))?;
            }
            fields.values_mut().try_for_each(convert)
        }
        _ => Ok(()),
    }
}
