//! The preprocessor: mdBook asks `supports RENDERER`, or gives `[context, book]` as JSON and takes the book back.

use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

use coadjoint_book::{with_formulas, without_outside};
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
            eprintln!("coadjoint-book: {error}");
            ExitCode::FAILURE
        }
    }
}

fn book() -> Result<Value, Box<dyn std::error::Error>> {
    let mut input = String::new();
    std::io::stdin().read_to_string(&mut input)?;
    let mut input: Value = serde_json::from_str(&input)?;
    let text = |pointer: &str| input.pointer(pointer).and_then(Value::as_str);
    let root = text("/0/root").ok_or("expected [context, book] on the standard input")?;
    let source = Path::new(root).join(text("/0/config/book/src").unwrap_or("src"));
    let book = input.get_mut(1).ok_or("expected [context, book] on the standard input")?;
    convert(book, &source)?;
    Ok(book.take())
}

/// Converts every chapter below a value.
fn convert(value: &mut Value, source: &Path) -> Result<(), Box<dyn std::error::Error>> {
    match value {
        Value::Array(values) => values.iter_mut().try_for_each(|value| convert(value, source)),
        Value::Object(fields) => {
            let path = fields.get("source_path").and_then(Value::as_str).unwrap_or("?").to_owned();
            if let Some(Value::String(content)) = fields.get_mut("content") {
                let inside = without_outside(content, source)
                    .map_err(|error| format!("{path}: a picture cannot be read: {error}"))?;
                *content = with_formulas(&inside).map_err(|error| format!("{path}: {error}"))?;
            }
            fields.values_mut().try_for_each(|value| convert(value, source))
        }
        _ => Ok(()),
    }
}
