//! Cases as texts.

use serde_json::Value;

/// With its line in the file of the case.
pub(super) type Placed<T> = (usize, T);

#[derive(Default)]
pub(super) struct Case {
    pub actions: Vec<Placed<Action>>,
    pub files: Vec<(String, String)>,
}

pub(super) enum Action {
    Run(Command),
    /// Replaces the first text in a file by the second.
    Edit(String, String, Right),
    /// Adds to a number of a record.
    Add(f64, Place),
    /// Leaves a record out.
    Drop(Place),
    /// Ends a table after this number of records, with a text.
    Cut(String, usize, String),
    Copy(String, String),
    /// Gives a name to what the last command has said between two texts.
    Take(String, [String; 2]),
    /// Writes the JSON of a command into a file.
    Save(String, String),
}

#[derive(Clone, Default)]
pub(super) struct Command {
    pub name: Option<String>,
    pub arguments: String,
    pub exit: i32,
    /// Changes of `system.toml` for this command alone.
    pub changes: Vec<(String, String)>,
    pub checks: Vec<Placed<Check>>,
    /// It is run only with the changes of the lines below it.
    pub changed: bool,
}

#[derive(Clone)]
pub(super) enum Check {
    /// A stream or a file `has`, `lacks` or has `once` each of the texts.
    Text(String, String, Vec<String>),
    /// A value is this one, up to a relative difference between these bounds.
    Equal(Place, Right, [f64; 2]),
    /// A number lies between bounds.
    Between(Place, [f64; 2]),
    Absent(Place),
    Legible(String),
    SameFiles(String, String),
}

#[derive(Clone)]
pub(super) enum Place {
    Json(String),
    /// The number of a record, from 1 or from the end, its entries, and the file.
    Row(i64, std::ops::Range<usize>, String),
    Rows(String),
    /// All numbers of a file.
    Values(String),
    File(String),
}

#[derive(Clone)]
pub(super) enum Right {
    Value(Value),
    /// A path into the JSON of an earlier command, or of a file of the workspace.
    Of(String, String),
    Record(Place),
}

/// The texts of a case for each of its `for` lines, of which those with other names are combined; other lines keep their numbers.
pub(super) fn runs(text: &str) -> Vec<String> {
    let (mut heads, mut rest) = (Vec::<(&str, Vec<&str>)>::new(), String::new());
    let files = text.find("\n== ").map_or(text.len(), |at| at + 1);
    for line in text[..files].lines() {
        match line.strip_prefix("for ").and_then(|line| line.split_once(" =")) {
            Some((names, values)) => {
                match heads.iter_mut().find(|(known, _)| *known == names) {
                    Some((_, all)) => all.push(values),
                    None => heads.push((names, vec![values])),
                }
                rest += "\n";
            }
            None => rest += &format!("{line}\n"),
        }
    }
    heads
        .iter()
        .fold(vec![(rest, text[files..].to_owned())], |texts, (names, all)| {
            let each = |(commands, files): &(String, String), values: &str| {
                let pairs = names.split_whitespace().zip(values.split('|').map(str::trim));
                pairs.fold((commands.clone(), files.clone()), |(commands, files), (name, value)| {
                    (
                        commands.replace(name, value),
                        files.replace(name, &value.replace("\\n", "\n")),
                    )
                })
            };
            texts.iter().flat_map(|text| all.iter().map(move |values| each(text, values))).collect()
        })
        .into_iter()
        .map(|(commands, files)| commands + &files)
        .collect()
}

/// Reads a case, or says at which line it is not one.
pub(super) fn read(text: &str) -> Result<Case, Placed<String>> {
    let says = text.lines().next().and_then(|first| first.strip_prefix("# right:"));
    if says.is_none_or(|source| source.trim().is_empty()) {
        let needed = "the first line must be `# right: …`: the source of the right values";
        return Err((1, needed.into()));
    }
    let mut case = Case::default();
    for (line, text) in (1..).zip(text.lines()) {
        if let Some(name) = text.strip_prefix("== ") {
            case.files.push((name.trim().to_owned(), String::new()));
        } else if let Some((_, content)) = case.files.last_mut() {
            *content += &format!("{text}\n");
        } else if !text.trim().is_empty() && !text.starts_with('#') {
            add(text.trim(), line, &mut case.actions)
                .map_err(|why| (line, format!("{why}: {text}")))?;
        }
    }
    match case.actions.iter().any(|(_, action)| matches!(action, Action::Run(_))) {
        true => Ok(case),
        false => Err((1, "no command".into())),
    }
}

/// Adds one line to the actions.
fn add(text: &str, line: usize, actions: &mut Vec<Placed<Action>>) -> Result<(), &'static str> {
    const UNKNOWN: &str = "not understood";
    let (word, rest) = text.split_once(' ').ok_or(UNKNOWN)?;
    let rest = rest.trim();
    let action = match word {
        ">" | "!" => {
            let (name, arguments) = match rest.split_once(" = ") {
                Some((name, arguments)) if !name.contains(' ') => {
                    (Some(name.to_owned()), arguments)
                }
                _ => (None, rest),
            };
            let (arguments, exit) = (arguments.to_owned(), if word == "!" { 2 } else { 0 });
            Action::Run(Command { name, arguments, exit, ..Command::default() })
        }
        "edit" => {
            let (file, rest) = rest.split_once(' ').ok_or(UNKNOWN)?;
            let (from, rest) = quoted(rest).ok_or(UNKNOWN)?;
            let to = rest.trim().strip_prefix("-> ").and_then(right).ok_or(UNKNOWN)?;
            Action::Edit(file.to_owned(), from, to)
        }
        "add" => {
            let (by, place) = rest.split_once(" to ").ok_or(UNKNOWN)?;
            let (place, _) = record(&format!("{place} ")).ok_or(UNKNOWN)?;
            Action::Add(by.parse().map_err(|_| UNKNOWN)?, place)
        }
        "drop" => Action::Drop(record(&format!("{rest} ")).ok_or(UNKNOWN)?.0),
        "cut" => {
            let (file, rest) = rest.split_once(" after row ").ok_or(UNKNOWN)?;
            let (count, text) = rest.split_once(':').ok_or(UNKNOWN)?;
            let count = count.parse().map_err(|_| UNKNOWN)?;
            Action::Cut(file.to_owned(), count, quoted(text).ok_or(UNKNOWN)?.0)
        }
        "take" => {
            let (name, rest) = rest.split_once(" between ").ok_or(UNKNOWN)?;
            let (before, rest) = quoted(rest).ok_or(UNKNOWN)?;
            Action::Take(name.to_owned(), [before, quoted(rest).ok_or(UNKNOWN)?.0])
        }
        "copy" | "save" => {
            let (from, to) = rest.split_once(" to ").ok_or(UNKNOWN)?;
            let action = if word == "copy" { Action::Copy } else { Action::Save };
            action(from.to_owned(), to.to_owned())
        }
        _ => {
            let pattern = actions.iter_mut().rev().find_map(|(_, action)| match action {
                Action::Run(command) if command.changes.is_empty() => Some(command),
                _ => None,
            });
            let pattern = pattern.ok_or("no command above")?;
            if word == "with" {
                let (changes, rest) = changes(rest).ok_or(UNKNOWN)?;
                let checks = vec![(line, check(rest).ok_or(UNKNOWN)?)];
                pattern.changed = true;
                Action::Run(Command { changes, checks, changed: false, ..pattern.clone() })
            } else {
                match word {
                    "exit" => pattern.exit = rest.parse().map_err(|_| UNKNOWN)?,
                    _ => pattern.checks.push((line, check(text).ok_or(UNKNOWN)?)),
                }
                return Ok(());
            }
        }
    };
    actions.push((line, action));
    Ok(())
}

/// A quoted text, and what follows.
fn quoted(text: &str) -> Option<(String, &str)> {
    let mut texts = serde_json::Deserializer::from_str(text).into_iter::<String>();
    let first = texts.next()?.ok()?;
    Some((first, text[texts.byte_offset()..].trim()))
}

fn changes(text: &str) -> Option<(Vec<(String, String)>, &str)> {
    let (mut rest, mut changes) = (text, Vec::new());
    loop {
        let (from, after) = quoted(rest)?;
        let (to, after) = quoted(after.strip_prefix("->")?)?;
        changes.push((from, to));
        match after.strip_prefix(',') {
            Some(more) => rest = more,
            None => return Some((changes, after.strip_prefix(':')?.trim())),
        }
    }
}

fn check(text: &str) -> Option<Check> {
    let (word, rest) = text.split_once(' ')?;
    match word {
        "out" | "err" => of_text(word, rest),
        "file" => {
            let (name, rest) = rest.trim().split_once(' ').unwrap_or((rest, ""));
            match (rest.trim(), rest.trim().strip_prefix("= ")) {
                ("legible", _) => Some(Check::Legible(name.to_owned())),
                ("absent", _) => Some(Check::Absent(Place::File(name.to_owned()))),
                (_, Some(other)) => Some(Check::SameFiles(name.to_owned(), other.to_owned())),
                _ => of_text(name, rest),
            }
        }
        "json" => {
            let (path, rest) = rest.trim().split_once(' ')?;
            of_value(Place::Json(path.to_owned()), rest.trim())
        }
        "row" | "rows" | "values" => {
            let (place, rest) = record(text)?;
            of_value(place, rest)
        }
        _ => None,
    }
}

/// `row N of FILE`, `row N[a..b] of FILE`, `rows of FILE` or `values of FILE`, and what follows.
fn record(text: &str) -> Option<(Place, &str)> {
    let (which, rest) = text.split_once(" of ")?;
    let (file, rest) = rest.split_once(' ').unwrap_or((rest, ""));
    let (file, rest) = (file.to_owned(), rest.trim());
    match which {
        "rows" => return Some((Place::Rows(file), rest)),
        "values" => return Some((Place::Values(file), rest)),
        _ => {}
    }
    let (number, entries) = which
        .strip_prefix("row ")?
        .split_once('[')
        .unwrap_or_else(|| (which.trim_start_matches("row "), ""));
    let entries = match entries.strip_suffix(']') {
        None => 0..usize::MAX,
        Some(entries) => match entries.split_once("..") {
            Some((start, end)) => start.parse().ok()?..end.parse().ok()?,
            None => entries.parse().ok()?..entries.parse::<usize>().ok()? + 1,
        },
    };
    Some((Place::Row(number.trim().parse().ok()?, entries, file), rest))
}

fn of_text(of: &str, rest: &str) -> Option<Check> {
    let (word, mut rest) = rest.trim().split_once(' ')?;
    let mut texts = Vec::new();
    while !rest.is_empty() {
        let (text, more) = quoted(rest)?;
        texts.push(text);
        rest = more;
    }
    let known = ["has", "lacks", "once"].contains(&word) && !texts.is_empty();
    known.then(|| Check::Text(of.to_owned(), word.to_owned(), texts))
}

fn of_value(of: Place, rest: &str) -> Option<Check> {
    if rest == "absent" {
        return Some(Check::Absent(of));
    }
    if let Some(bounds) = rest.strip_prefix("in ") {
        return Some(Check::Between(of, serde_json::from_str(bounds).ok()?));
    }
    let (text, bounds) = match rest.strip_prefix("= ")?.rsplit_once(" to ") {
        Some((text, bounds)) => {
            let most = || bounds.trim().parse().ok().map(|most| [0.0, most]);
            (text, serde_json::from_str(bounds).ok().or_else(most)?)
        }
        None => (rest.strip_prefix("= ")?, [0.0, 0.0]),
    };
    Some(Check::Equal(of, right(text)?, bounds))
}

/// A JSON value, `row N of FILE`, or `command.path`.
fn right(text: &str) -> Option<Right> {
    if let Ok(value) = serde_json::from_str(text) {
        return Some(Right::Value(value));
    }
    if text.contains(" of ") {
        return record(text).map(|(place, _)| Right::Record(place));
    }
    let (of, path) = text.trim().split_once(':').or_else(|| text.trim().split_once('.'))?;
    (!of.is_empty()).then(|| Right::Of(of.to_owned(), path.to_owned()))
}
