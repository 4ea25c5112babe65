//! The table of cases: each file of `cli/tests/cases` runs commands in a folder of its own and says what is right.
//!
//! A case is a text. Its first line says where the right values come from. Then come commands, each with what is
//! expected of it, and files, each from its `==` line to the next. Blank lines and lines of `#` before the files are free.
//!
//! ```text
//! # right: closed form
//! > simulate system.toml --format json        a command line of `coadjoint`; 'one argument' between single quotes
//! exit 1                                      its exit status; 0 if it is not given
//! err has "text"                              also: out has, out lacks, err lacks, file NAME has, file NAME lacks
//! json momentum = [0.1, 0.2] to 1e-9          at most 1e-9 times the largest entry of the right value away
//! json drift.casimirs in [0, 1e-12]           a number between bounds
//! json estimated_error = null                 also strings, integers, true; exact without `to`
//! row 1 of ends.csv = [0.1, 0.2] to 1e-9      a record of a file; rows count from 1 and -1 is the last
//! == system.toml
//! group = "SO3"
//! ```

use std::path::Path;

use rayon::prelude::*;
use serde_json::Value;

use crate::support::{Folder, Ran, root, table};

/// A text with its place in the file of the case.
type Placed<T> = (usize, T);

#[derive(Default)]
struct Case {
    commands: Vec<Placed<Command>>,
    files: Vec<(String, String)>,
}

struct Command {
    arguments: String,
    exit: i32,
    checks: Vec<Placed<Check>>,
}

enum Check {
    /// A stream or a file has (or lacks) a text.
    Text { of: String, has: bool, text: String },
    /// A value is this one, up to a relative difference.
    Equal { of: Place, right: Value, within: f64 },
    /// A number lies between bounds.
    Between { of: Place, low: f64, high: f64 },
}

enum Place {
    Json(String),
    Row(i64, String),
}

/// Reads a case, or says at which line it is not one.
fn read(text: &str) -> Result<Case, Placed<String>> {
    let says = text.lines().next().and_then(|first| first.strip_prefix("# right:"));
    if says.is_none_or(|source| source.trim().is_empty()) {
        return Err((
            1,
            "the first line must be `# right: …`: the source of the right values".into(),
        ));
    }
    let mut case = Case::default();
    for (line, text) in (1..).zip(text.lines()) {
        if let Some(name) = text.strip_prefix("== ") {
            case.files.push((name.trim().to_owned(), String::new()));
        } else if let Some((_, content)) = case.files.last_mut() {
            *content += &format!("{text}\n");
        } else if let Some(arguments) = text.strip_prefix("> ") {
            let arguments = arguments.trim().to_owned();
            case.commands.push((line, Command { arguments, exit: 0, checks: Vec::new() }));
        } else if !text.trim().is_empty() && !text.starts_with('#') {
            let command = case.commands.last_mut().ok_or((line, "no command above".to_owned()))?;
            expect(text.trim(), line, &mut command.1)
                .ok_or((line, format!("not understood: {text}")))?;
        }
    }
    if case.commands.is_empty() {
        return Err((1, "no command".into()));
    }
    Ok(case)
}

/// Adds one expectation to a command.
fn expect(text: &str, line: usize, command: &mut Command) -> Option<()> {
    let (word, rest) = text.split_once(' ')?;
    let check = match word {
        "exit" => {
            command.exit = rest.trim().parse().ok()?;
            return Some(());
        }
        "out" | "err" => of_text(word, rest)?,
        "file" => {
            let (name, rest) = rest.trim().split_once(' ')?;
            of_text(name, rest)?
        }
        "json" => {
            let (path, rest) = rest.trim().split_once(' ')?;
            of_value(Place::Json(path.to_owned()), rest)?
        }
        "row" => {
            let (number, rest) = rest.trim().split_once(" of ")?;
            let (file, rest) = rest.trim().split_once(' ')?;
            of_value(Place::Row(number.trim().parse().ok()?, file.to_owned()), rest)?
        }
        _ => return None,
    };
    command.checks.push((line, check));
    Some(())
}

fn of_text(of: &str, rest: &str) -> Option<Check> {
    let (word, text) = rest.trim().split_once(' ')?;
    let has = match word {
        "has" => true,
        "lacks" => false,
        _ => return None,
    };
    Some(Check::Text { of: of.to_owned(), has, text: serde_json::from_str(text).ok()? })
}

fn of_value(of: Place, rest: &str) -> Option<Check> {
    if let Some(bounds) = rest.trim().strip_prefix("in ") {
        let [low, high] = serde_json::from_str(bounds).ok()?;
        return Some(Check::Between { of, low, high });
    }
    let right = rest.trim().strip_prefix("= ")?;
    let (right, within) = match right.rsplit_once(" to ") {
        Some((right, within)) => (right, within.trim().parse().ok()?),
        None => (right, 0.0),
    };
    Some(Check::Equal { of, right: serde_json::from_str(right).ok()?, within })
}

/// Runs a case; each thing that is not as it should be, with its line.
fn failures(case: &Case) -> Vec<Placed<String>> {
    let folder = Folder::new();
    case.files.iter().for_each(|(name, text)| folder.write(name, text));
    let mut failures = Vec::new();
    for (line, command) in &case.commands {
        let ran = folder.run(&command.arguments);
        let before = failures.len();
        if ran.code != command.exit {
            failures.push((*line, format!("exit {} instead of {}", ran.code, command.exit)));
        }
        for (line, check) in &command.checks {
            failures.extend(judge(check, &ran, &folder).err().map(|text| (*line, text)));
        }
        if failures.len() > before {
            let out: String = ran.out.chars().take(1000).collect();
            failures.push((*line, format!("the command said:\n{}{out}", ran.error)));
        }
    }
    failures
}

fn judge(check: &Check, ran: &Ran, folder: &Folder) -> Result<(), String> {
    match check {
        Check::Text { of, has, text } => {
            let content = match of.as_str() {
                "out" => ran.out.clone(),
                "err" => ran.error.clone(),
                name if folder.has(name) => folder.text(name),
                name => return Err(format!("there is no file {name}")),
            };
            match content.contains(text) == *has {
                true => Ok(()),
                false => Err(format!("{of} {} {text:?}", if *has { "lacks" } else { "has" })),
            }
        }
        Check::Equal { of, right, within } => {
            let found = value(of, ran, folder)?;
            let away = away(&found, right).unwrap_or(f64::INFINITY);
            match away <= *within || found == *right {
                true => Ok(()),
                false => Err(format!("{found} instead of {right}: {away:.2e} away")),
            }
        }
        Check::Between { of, low, high } => {
            let found = value(of, ran, folder)?;
            match found.as_f64().is_some_and(|x| *low <= x && x <= *high) {
                true => Ok(()),
                false => Err(format!("{found} instead of a number from {low:e} to {high:e}")),
            }
        }
    }
}

fn value(of: &Place, ran: &Ran, folder: &Folder) -> Result<Value, String> {
    match of {
        Place::Json(path) => {
            let all: Value = serde_json::from_str(&ran.out).map_err(|e| format!("no JSON: {e}"))?;
            let pointer = format!("/{}", path.replace(']', "").replace(['.', '['], "/"));
            all.pointer(&pointer).cloned().ok_or_else(|| format!("there is no {path}"))
        }
        Place::Row(number, file) => {
            if !folder.has(file) {
                return Err(format!("there is no file {file}"));
            }
            let rows = table(&folder.text(file));
            let index = if *number < 0 { rows.len() as i64 + number } else { *number };
            let cells = usize::try_from(index).ok().filter(|i| *i > 0).and_then(|i| rows.get(i));
            let cells = cells.ok_or_else(|| format!("{file} has {} rows", rows.len() - 1))?;
            Ok(cells.iter().map(|cell| serde_json::from_str(cell).unwrap_or(Value::Null)).collect())
        }
    }
}

/// The largest difference, relative to the largest right number, of numbers in any shape; none where shapes differ.
fn away(found: &Value, right: &Value) -> Option<f64> {
    let (found, right) = (numbers(found)?, numbers(right)?);
    let largest = right.iter().map(|x| x.abs()).fold(0.0, f64::max);
    let difference = found.iter().zip(&right).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    (found.len() == right.len()).then(|| if difference == 0.0 { 0.0 } else { difference / largest })
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    match value {
        Value::Array(entries) => {
            Some(entries.iter().map(numbers).collect::<Option<Vec<_>>>()?.concat())
        }
        other => Some(vec![other.as_f64()?]),
    }
}

/// Every failure of a case, as `NAME:LINE: …`.
fn report(name: &str, text: &str) -> Vec<String> {
    let failures = read(text).map_or_else(|mistake| vec![mistake], |case| failures(&case));
    failures.into_iter().map(|(line, text)| format!("{name}:{line}: {text}")).collect()
}

#[test]
fn every_case_gives_its_right_values() {
    let folder = root().join("cli/tests/cases");
    let mut names: Vec<String> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    let strangers: Vec<&String> = names.iter().filter(|name| !name.ends_with(".case")).collect();
    assert!(strangers.is_empty(), "not cases: {strangers:?}");
    let read = |name: &String| std::fs::read_to_string(Path::new(&folder).join(name)).unwrap();
    let failures: Vec<String> =
        names.par_iter().flat_map(|name| report(name, &read(name))).collect();
    assert!(failures.is_empty(), "{} cases, and:\n{}", names.len(), failures.join("\n"));
    assert!(!names.is_empty());
}

const SOUND: &str = "# right: the body of the examples\n> simulate examples/rigid_body.toml --time 1 --format json --out \
                     rows.csv\njson conserved_casimirs = 1\n";

/// A wrong expectation fails at its line, whatever its kind, and a right one does not.
#[test]
fn a_wrong_expectation_fails() {
    assert_eq!(report("sound", SOUND), Vec::<String>::new());
    for wrong in [
        "exit 1",
        "out lacks \"SO3\"",
        "err has \"error\"",
        "file rows.csv has \"mu_9\"",
        "file nowhere.csv lacks \"mu_9\"",
        "json nowhere = null",
        "json coordinates[0] = \"SO4\"",
        "json momentum = [1, 2]",
        "json momentum = [1, 2, 4] to 1e-3",
        "json momentum[0] in [7, 8]",
        "row 1 of rows.csv = [1, 2] to 1e9",
        "row 99999 of rows.csv = [1]",
    ] {
        let failures = report("wrong", &format!("{SOUND}{wrong}\n"));
        let line = if wrong.starts_with("exit") { 2 } else { 4 };
        assert!(
            failures.first().is_some_and(|text| text.starts_with(&format!("wrong:{line}: "))),
            "{wrong}: {failures:?}"
        );
    }
}

/// A file that is no case is named with its line.
#[test]
fn a_malformed_case_fails() {
    for (text, place) in [
        ("> casimirs examples/rigid_body.toml\n", "bad:1: the first line"),
        ("# right:\n> casimirs examples/rigid_body.toml\n", "bad:1: the first line"),
        ("# right: nothing\n", "bad:1: no command"),
        ("# right: nothing\nexit 1\n", "bad:2: no command above"),
        (&format!("{SOUND}json momentum ~ 1\n"), "bad:4: not understood"),
        (&format!("{SOUND}out has text\n"), "bad:4: not understood"),
        (&format!("{SOUND}json a = [1, to 2\n"), "bad:4: not understood"),
    ] {
        let failures = report("bad", text);
        assert!(failures.len() == 1 && failures[0].starts_with(place), "{text}: {failures:?}");
    }
}
