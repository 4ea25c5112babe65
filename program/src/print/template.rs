//! Fixed text with places and sections.

use alloc::string::String;
use alloc::vec;

/// A place's name and its text.
pub type Value = (&'static str, String);

/// A template with its places filled.
///
/// A place is a name in capitals, `/*NAME*/`; a line that is nothing else is replaced by the lines of its text. Lines from
/// `//? NAME` to `//.` are left out where the text of that name is empty, missing, `0` or `false`, those from `//? !NAME` where
/// it is not.
pub fn fill(template: &str, values: &[Value]) -> String {
    let value =
        |name: &str| values.iter().find(|value| value.0 == name).map_or("", |value| &value.1);
    let mut text = String::new();
    let mut shown = vec![true];
    for line in template.lines() {
        let within = shown.last().copied().unwrap_or(true);
        if let Some(section) = line.strip_prefix("//? ") {
            let (name, missing) = match section.strip_prefix('!') {
                Some(name) => (name, true),
                None => (section, false),
            };
            shown.push(within && matches!(value(name), "" | "0" | "false") == missing);
        } else if line == "//." {
            shown.pop();
        } else if within {
            let start = text.len();
            let mut rest = line;
            while let Some((before, name, after)) = next_place(rest) {
                text.push_str(before);
                text.push_str(value(name));
                rest = after;
            }
            text.push_str(rest);
            let lines_alone = rest.is_empty() && line.starts_with("/*");
            if !(lines_alone && (text.len() == start || text.ends_with('\n'))) {
                text.push('\n');
            }
        }
    }
    text
}

/// The text before the first place of a line, its name, and the text after it.
fn next_place(line: &str) -> Option<(&str, &str, &str)> {
    let mut from = 0;
    while let Some(at) = line.get(from..)?.find("/*") {
        let start = from + at;
        let (name, after) = line.get(start + 2..)?.split_once("*/")?;
        if !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_uppercase() || byte == b'_') {
            return Some((&line[..start], name, after));
        }
        from = start + 2;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_sections_are_filled() {
        let template = "a /* b */ /*ONE*/;\n/*ROWS*/\n//? ONE\nwith\n//? TWO\nboth\n//.\n//.\n//? !TWO\nnone /*TWO*/\n//.\n";
        let values = [("ONE", String::from("1")), ("ROWS", String::from("x\ny\n"))];
        assert_eq!(fill(template, &values), "a /* b */ 1;\nx\ny\nwith\nnone \n");
        let values = [("ONE", String::from("0")), ("TWO", String::from("2"))];
        assert_eq!(fill(template, &values), "a /* b */ 0;\n");
    }
}
