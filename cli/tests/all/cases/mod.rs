//! The table of cases: each file of `cli/tests/cases` runs commands in a folder of its own and says what is right.
//!
//! A case is a text. Its first line says where the right values come from. Then come commands, each with what is
//! expected of it, and files, each from its `==` line to the next. Blank lines and lines of `#` before the files are free.
//!
//! ```text
//! # right: closed form
//! > simulate system.toml                       a command line of `coadjoint`; 'one argument' between single quotes
//! exit 1                                       its exit status; 0 if it is not given
//! err has "text" "more"                        also: out has, file NAME has; lacks, or once, in place of has
//! json momentum = [0.1, 0.2] to 1e-9           at most 1e-9 times the largest entry of the right value away
//! json momentum = [0.1, 0.2] to [1e-9, 1e-8]   no nearer and no farther than these
//! json drift.casimirs in [0, 1e-12]            a number between bounds; `laws.name` is a list of the names of all laws
//! json estimated_error = null                  also strings, integers, true; exact without `to`
//! json energy absent                           null, or not there
//! row 1 of ends.csv = [0.1, 0.2] to 1e-9       a record of a file; rows count from 1 and -1 is the last
//! row 1[1..4] of run.npy = whole.momentum      entries of a record; the right value is one of the command `whole`
//! json momentum = tests/known.json:momentum    also of a file of the workspace, and `row 1 of ends.csv`
//! rows of run.npy = 12                         the number of records; `values of run.npy` are all numbers
//! file one.csv = two.csv                       the same bytes
//! file run.csv absent                          also: legible, of a picture
//! > whole = simulate system.toml               a command whose JSON has a name
//! ! simulate system.toml --time -1             bad input: the exit status is 2
//! with "a" -> "b", "c" -> "d": err has "text"  the command above, instead, after these changes of `system.toml`
//! edit system.toml "a" -> "b"                  a change that stays; the new text may be one of a command, `whole.momentum`
//! take step between "a step of " " works"        names what the error stream of the last command has there
//! > simulate system.toml --step {step}          texts and commands may have such a name, and `{whole.truncation}`
//! add 1e-9 to row 3[1] of run.csv              a number of a record is changed; drop row 3 of run.csv
//! cut run.csv after row 20: "# end"            the file ends after a record, with this text
//! copy examples/rigid_body.toml to body.toml   also: save whole to report.json, the JSON of a command
//! for {step} {end} = 0.1 | 2                   the case is run for each of these lines, in files with \n for the end of a line
//! == system.toml
//! group = "SO3"
//! == spins.npy
//! [[60, 3], 2.9]                               an array of this shape with the numbers sin(2.9 i)
//! == wide.toml as UTF-16
//! group = "SO3"                                also: as bytes, of which `\xe9` is one
//! ```

mod judge;
pub(crate) mod legible;
mod text;

use std::collections::BTreeMap;

use coadjoint_learn::npy_header;
use rayon::prelude::*;
use serde_json::Value;

use crate::support::{Folder, Ran, root};
use judge::Outcome;
use text::{Action, Case, Check, Command, Place, Placed, read, runs};

/// A folder in which a case is run, and the JSON of its commands that have names.
struct Course {
    folder: Folder,
    known: BTreeMap<String, Value>,
    /// The error stream of the last command.
    said: String,
    /// Each thing that is not as it should be, with its line.
    failures: Vec<Placed<String>>,
}

impl Course {
    fn new(case: &Case) -> Self {
        let folder = Folder::new();
        for (name, text) in &case.files {
            match name.split_once(" as ") {
                Some((name, "UTF-16")) => folder.write(name, wide(text)),
                Some((name, _)) => folder.write(name, bytes(text)),
                None if name.ends_with(".npy") => folder.write(name, wave(text)),
                None => folder.write(name, text),
            }
        }
        let mut course =
            Self { folder, known: BTreeMap::new(), said: String::new(), failures: Vec::new() };
        let nothing = Ran { code: 0, out: String::new(), error: String::new() };
        for (line, action) in &case.actions {
            let outcome = Outcome { folder: &course.folder, ran: &nothing, known: &course.known };
            let done = match action {
                Action::Run(command) => {
                    course.run(*line, command);
                    continue;
                }
                Action::Copy(from, to) => {
                    course.folder.write(to, course.folder.bytes(from));
                    Ok(())
                }
                Action::Take(name, [before, after]) => {
                    let rest = course.said.split(before.as_str()).nth(1);
                    let found = rest.and_then(|rest| rest.split(after.as_str()).next());
                    let found = found.map(|text| Value::from(text.to_owned()));
                    let missing = format!("{before:?} was not said");
                    course.known.extend(found.clone().map(|text| (name.clone(), text)));
                    found.map(drop).ok_or(missing)
                }
                Action::Save(name, to) => {
                    course.folder.write(to, course.known[name].to_string());
                    Ok(())
                }
                Action::Edit(file, from, to) => outcome.right(to).and_then(|to| {
                    let to = to.as_str().map_or_else(|| to.to_string(), str::to_owned);
                    let text = changed(&course.folder.text(file), from, &to)?;
                    course.folder.write(file, text);
                    Ok(())
                }),
                Action::Add(by, place) => with_record(&course.folder, place, |line, entry| {
                    let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
                    let cell = cells.get_mut(entry).ok_or("there is no such number")?;
                    let value: f64 = cell.parse().map_err(|_| format!("{cell} is no number"))?;
                    *cell = (value + by).to_string();
                    Ok(cells.join(",") + "\n")
                }),
                Action::Drop(place) => with_record(&course.folder, place, |_, _| Ok(String::new())),
                Action::Cut(file, count, text) => {
                    let whole = course.folder.text(file);
                    let mut lines = whole.lines().filter(|line| !line.starts_with('#'));
                    let last = lines.nth(*count).map(|line| line.as_ptr() as usize + line.len());
                    let end = last.map_or(whole.len(), |end| end - whole.as_ptr() as usize);
                    course.folder.write(file, format!("{}\n{text}", &whole[..end]));
                    Ok(())
                }
            };
            course.failures.extend(done.err().map(|text| (*line, text)));
        }
        course
    }

    fn run(&mut self, line: usize, command: &Command) {
        if command.changed {
            return;
        }
        let before = self.failures.len();
        let plain = (!command.changes.is_empty()).then(|| self.folder.text("system.toml"));
        if let Some(plain) = &plain {
            let text = command
                .changes
                .iter()
                .try_fold(plain.clone(), |text, (from, to)| changed(&text, from, to));
            match text {
                Ok(text) => self.folder.write("system.toml", text),
                Err(failure) => self.failures.push((line, failure)),
            }
        }
        let json = |(_, check): &Placed<Check>| match check {
            Check::Equal(of, ..) | Check::Between(of, _) | Check::Absent(of) => {
                matches!(of, Place::Json(_))
            }
            _ => false,
        };
        let json = command.name.is_some() || command.checks.iter().any(json);
        let json = json && !command.arguments.contains("--format");
        let format = if json { " --format json" } else { "" };
        let arguments = judge::filled(&command.arguments, &self.known);
        let ran = self.folder.run(&format!("{arguments}{format}"));
        if let Some(name) = &command.name {
            let json = serde_json::from_str(&ran.out).unwrap_or_default();
            self.known.insert(name.clone(), json);
        }
        if ran.code != command.exit {
            let failure = format!("exit {} instead of {}", ran.code, command.exit);
            self.failures.push((line, failure));
        }
        let outcome = Outcome { folder: &self.folder, ran: &ran, known: &self.known };
        for (line, check) in &command.checks {
            self.failures.extend(outcome.judge(check).err().map(|text| (*line, text)));
        }
        if self.failures.len() > before {
            let out: String = ran.out.chars().take(1000).collect();
            self.failures.push((line, format!("the command said:\n{}{out}", ran.error)));
        }
        self.said = ran.error;
        if let Some(plain) = plain {
            self.folder.write("system.toml", plain);
        }
    }
}

/// The bytes of an array: of its shape and of a, for the numbers sin(a i).
fn wave(text: &str) -> Vec<u8> {
    let (shape, rate): (Vec<u64>, Option<f64>) = serde_json::from_str(text).unwrap();
    let numbers = (0..shape.iter().product()).map(|i| (rate.unwrap_or(f64::NAN) * i as f64).sin());
    [npy_header(&shape), numbers.flat_map(f64::to_le_bytes).collect()].concat()
}

fn wide(text: &str) -> Vec<u8> {
    "\u{feff}".encode_utf16().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}

/// The bytes of a text in which `\xe9` is one.
fn bytes(text: &str) -> Vec<u8> {
    let (first, rest) = text.split_once("\\x").unwrap_or((text, ""));
    match rest.split_at_checked(2) {
        None => text.into(),
        Some((byte, rest)) => {
            let byte = u8::from_str_radix(byte, 16).unwrap();
            [first.as_bytes(), &[byte], &bytes(rest)].concat()
        }
    }
}

fn changed(text: &str, from: &str, to: &str) -> Result<String, String> {
    match text.contains(from) {
        true => Ok(text.replacen(from, to, 1)),
        false => Err(format!("there is no {from:?} to be changed")),
    }
}

/// Replaces a record by the text that is made of it and of the entry that is named.
fn with_record(
    folder: &Folder,
    place: &Place,
    change: impl Fn(&str, usize) -> Result<String, String>,
) -> Result<(), String> {
    let Place::Row(number, entries, file) = place else { return Err("no record".to_owned()) };
    let text = folder.text(file);
    let mut records = text.lines().filter(|line| !line.starts_with('#'));
    let line = records.nth(*number as usize).ok_or("there is no such record")?;
    let whole = format!("{line}\n");
    folder.write(file, text.replacen(&whole, &change(line, entries.start)?, 1));
    Ok(())
}

/// Every failure of a case, as `NAME:LINE: …`.
fn report(name: &str, text: &str) -> Vec<String> {
    let failures = runs(text).into_iter().flat_map(|text| {
        read(&text).map_or_else(|mistake| vec![mistake], |case| Course::new(&case).failures)
    });
    failures.map(|(line, text)| format!("{name}:{line}: {text}")).collect()
}

/// The variable `COADJOINT_CASES` chooses those whose names contain it.
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
    let only = std::env::var("COADJOINT_CASES").unwrap_or_default();
    names.retain(|name| name.contains(&only));
    let read = |name: &String| std::fs::read_to_string(folder.join(name)).unwrap();
    let failures: Vec<String> =
        names.par_iter().flat_map(|name| report(name, &read(name))).collect();
    assert!(failures.is_empty(), "{} cases, and:\n{}", names.len(), failures.join("\n"));
    assert!(!names.is_empty());
}

const SOUND: &str = "# right: the body of the examples\nfor {t} = 1 | 2\ncopy examples/rigid_body.toml to system.toml\n\
                     > one = simulate system.toml --time {t} --out rows.csv --plot p.svg\njson conserved_casimirs = 1\n\
                     row -1[1..4] of rows.csv = one.momentum\n";

/// A wrong expectation fails at its line, whatever its kind, and a right one does not.
#[test]
fn a_wrong_expectation_fails() {
    let right = "file p.svg legible\nfile rows.csv = rows.csv\nfile no.csv absent\nrows of rows.csv = 11\n\
                 with \"1.5\" -> \"-1.5\": json nowhere absent\nadd 1 to row 2[1] of rows.csv\n";
    let sound = format!("{SOUND}{right}! verify rows.csv --step\n");
    assert_eq!(report("sound", &sound), Vec::<String>::new());
    for wrong in [
        "exit 1",
        "out lacks \"SO3\"",
        "err has \"error\"",
        "file rows.csv has \"time\" \"mu_9\"",
        "file nowhere.csv lacks \"mu_9\"",
        "file rows.csv absent",
        "file rows.csv once \"0\"",
        "file rows.csv = p.svg",
        "file rows.csv legible",
        "json nowhere = null",
        "json momentum absent",
        "json coordinates[0] = \"SO4\"",
        "json momentum = [1, 2]",
        "json momentum = [1, 2, 4] to 1e-3",
        "json momentum = one.momentum to [1e-9, 1]",
        "json momentum = two.momentum",
        "json momentum[0] in [7, 8]",
        "rows of rows.csv = 12",
        "values of rows.csv = row 1 of rows.csv",
        "json momentum = tests/reference/satellite.json:momentum to 1e-3",
        "row 1 of rows.csv = [1, 2] to 1e9",
        "row 1[1..4] of rows.csv = one.momentum to 1e-9",
        "row 99999 of rows.csv = [1]",
        "with \"nothing\" -> \"else\": out has \"SO3\"",
        "with \"1.5\" -> \"x\": out has \"SO3\"",
        "edit system.toml \"nothing\" -> \"else\"",
        "add 1 to row 99[1] of rows.csv",
    ] {
        let failures = report("wrong", &format!("{SOUND}{wrong}\n"));
        let line = if wrong.starts_with("exit") { 4 } else { 7 };
        assert!(
            failures.first().is_some_and(|text| text.starts_with(&format!("wrong:{line}: "))),
            "{wrong}: {failures:?}"
        );
    }
}

/// A file that is no case is named with its line.
#[test]
fn a_malformed_case_fails() {
    let sound = SOUND.replace("for {t} = 1 | 2\n", "");
    for (text, place) in [
        ("> casimirs examples/rigid_body.toml\n", "bad:1: the first line"),
        ("# right:\n> casimirs examples/rigid_body.toml\n", "bad:1: the first line"),
        ("# right: nothing\n", "bad:1: no command"),
        ("# right: nothing\nexit 1\n", "bad:2: no command above"),
        (&format!("{sound}json momentum ~ 1\n"), "bad:6: not understood"),
        (&format!("{sound}out has text\n"), "bad:6: not understood"),
        (&format!("{sound}json a = [1, to 2\n"), "bad:6: not understood"),
        (&format!("{sound}with \"a\" -> b: out has \"a\"\n"), "bad:6: not understood"),
    ] {
        let failures = report("bad", text);
        assert!(failures.len() == 1 && failures[0].starts_with(place), "{text}: {failures:?}");
    }
}
