//! A page as a script: its commands are run in a folder of their own, and what they print is compared with the page.
//!
//! | block | |
//! |---|---|
//! | `console` | `$ command` and what it prints, both streams; `[..]` stands for any text in a line, a line `...` for any lines; a last line `? 1` is the exit code |
//! | `sh` | a script of which every command must succeed |
//! | any other | written to `NAME` where its first line is a comment that begins with `NAME.ext` |
//!
//! With `COADJOINT_BLESS=1` output that differs is written into the page.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use snapbox::IntoData;
use snapbox::assert::Assert;

/// A fenced block.
pub(crate) struct Block<'a> {
    pub language: &'a str,
    pub text: &'a str,
}

/// The page's fenced blocks, in order.
pub(crate) fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut rest = page;
    while let Some(at) = find_fence(rest) {
        let (language, body) = rest[at + 3..].split_once('\n').unwrap();
        let end = find_fence(body).unwrap_or_else(|| panic!("a block without an end: {body}"));
        blocks.push(Block { language: language.trim(), text: &body[..end] });
        rest = &body[end + 3..];
    }
    blocks
}

/// The place of the next line that begins with a fence.
fn find_fence(text: &str) -> Option<usize> {
    if text.starts_with("```") {
        return Some(0);
    }
    text.find("\n```").map(|at| at + 1)
}

/// The file that a block is, by its first line: a comment that begins with the file's name.
pub(crate) fn file_name<'a>(block: &Block<'a>) -> Option<&'a str> {
    let first = block.text.lines().next()?;
    let comment = ["#", "//", "/*"].iter().find_map(|mark| first.strip_prefix(mark))?;
    let name = comment.trim_start().split([':', ' ']).next()?;
    let (stem, extension) = name.rsplit_once('.')?;
    let letters = |text: &str| text.chars().all(|c| c.is_alphanumeric() || "_-".contains(c));
    (!stem.is_empty() && !extension.is_empty() && letters(stem) && letters(extension))
        .then_some(name)
}

/// The outcome of a page's commands.
#[derive(Default)]
pub(crate) struct Outcome {
    pub commands: usize,
    pub failures: String,
}

/// Runs the page at `path`, from the root, in `folder`.
pub(crate) fn run(path: &str, folder: &Path) -> usize {
    let whole = super::root().join(path);
    let page = std::fs::read_to_string(&whole).unwrap();
    let mut outcome = Outcome::default();
    let mut blessed = page.clone();
    for block in blocks(&page) {
        match block.language {
            "sh" => {
                let (code, said) = execute(block.text, folder);
                outcome.commands += block.text.matches("coadjoint ").count();
                if code != 0 {
                    let script = block.text;
                    let _ = writeln!(outcome.failures, "{path}: {script}exit code {code}\n{said}");
                }
            }
            "console" => {
                for (command, expected) in commands(block.text) {
                    let found = report(&command, folder);
                    outcome.commands += 1;
                    if let Err(difference) = same(&found, expected) {
                        let _ = writeln!(outcome.failures, "{path}: $ {command}\n{difference}");
                        let shown = |output: &str| format!("$ {command}\n{output}");
                        let better = shown(&with_wildcards(&found, expected));
                        blessed = blessed.replacen(&shown(expected), &better, 1);
                    }
                }
            }
            _ => {
                if let Some(name) = file_name(&block) {
                    std::fs::write(folder.join(name), block.text).unwrap();
                }
            }
        }
    }
    if std::env::var_os("COADJOINT_BLESS").is_some() && blessed != page {
        std::fs::write(&whole, blessed).unwrap();
    }
    assert!(outcome.failures.is_empty(), "{}", outcome.failures);
    outcome.commands
}

/// Compares an output with the expected one; the error shows the difference.
fn same(found: &str, expected: &str) -> snapbox::assert::Result<()> {
    let assert = Assert::new().normalize_paths(false);
    assert.try_eq(None, found.into_data(), expected.into_data())
}

/// An output with the lines of an earlier one that it still fits.
fn with_wildcards(found: &str, earlier: &str) -> String {
    if found.lines().count() != earlier.lines().count() {
        return found.to_owned();
    }
    let lines = found.lines().zip(earlier.lines());
    lines
        .map(|(new, old)| format!("{}\n", if same(new, old).is_ok() { old } else { new }))
        .collect()
}

/// The commands of a `console` block, each with what it is to print.
fn commands(block: &str) -> Vec<(String, &str)> {
    let mut commands = Vec::new();
    let starts: Vec<usize> =
        block.lines().map(|line| line.as_ptr() as usize - block.as_ptr() as usize).collect();
    let mut at = starts.into_iter().filter(|&start| block[start..].starts_with("$ ")).peekable();
    assert_eq!(at.peek(), Some(&0), "a console block begins with a command: {block}");
    while let Some(start) = at.next() {
        let text = &block[start + 2..at.peek().copied().unwrap_or(block.len())];
        let mut end = text.find('\n').unwrap_or(text.len());
        while text[..end].ends_with('\\') {
            end += 1 + text[end + 1..].find('\n').unwrap();
        }
        commands.push((text[..end].to_owned(), text.get(end + 1..).unwrap_or_default()));
    }
    commands
}

/// The output of the command, as a page shows it.
fn report(command: &str, folder: &Path) -> String {
    let (code, mut said) = execute(command, folder);
    if !said.is_empty() && !said.ends_with('\n') {
        said.push('\n');
    }
    if code != 0 {
        let _ = writeln!(said, "? {code}");
    }
    said
}

/// Exit code and both streams of a command; `coadjoint` is the one under test.
fn execute(command: &str, folder: &Path) -> (i32, String) {
    let program = Path::new(env!("CARGO_BIN_EXE_coadjoint")).parent().unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let output = Command::new("sh")
        .args(["-ec", &format!("exec 2>&1\n{command}")])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", program.display()))
        .output()
        .unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    (output.status.code().unwrap_or(-1), said)
}

/// A folder with the example files in `examples`, as from the root of the repository.
pub(crate) fn with_examples() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for own in ["examples", "examples/lattices"] {
        let copies = folder.path().join(own);
        std::fs::create_dir_all(&copies).unwrap();
        for entry in std::fs::read_dir(super::root().join(own)).unwrap() {
            let file = entry.unwrap().path();
            if file.is_file() {
                std::fs::copy(&file, copies.join(file.file_name().unwrap())).unwrap();
            }
        }
    }
    folder
}
