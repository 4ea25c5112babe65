//! Compilers and checkers of the machine.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::process::Command;

/// The flags of the C compiler.
pub const FLAGS_C: [&str; 6] =
    ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror"];

/// The flags of the C++ compiler.
pub const FLAGS_CPP: [&str; 6] =
    ["-std=c++11", "-pedantic", "-Wall", "-Wextra", "-Wconversion", "-Werror"];

/// A program of the machine.
pub struct Tool(String);

impl Tool {
    /// The program of this name. Where there is none, a line says what is left out, or the test fails.
    pub fn find(name: &str) -> Option<Self> {
        let found =
            Command::new(name).arg("--version").output().is_ok_and(|out| out.status.success());
        assert!(
            found || std::env::var_os("COADJOINT_REQUIRE_TOOLS").is_none(),
            "{name} is missing, and COADJOINT_REQUIRE_TOOLS is set"
        );
        if !found {
            eprintln!("no {name}: what needs it was left out");
        }
        found.then(|| Self(name.to_owned()))
    }

    /// Runs it with these arguments and gives what it printed; the test fails where it does.
    pub fn run(&self, arguments: &[&str]) -> String {
        let outcome = Command::new(&self.0).args(arguments).output().unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        let (out, err) = (text(&outcome.stdout), text(&outcome.stderr));
        assert!(outcome.status.success(), "{} {}:\n{out}{err}", self.0, arguments.join(" "));
        out
    }

    /// Compiles one file to a program.
    pub fn compile(&self, flags: &[&str], source: &Path, program: &Path, libraries: &[&str]) {
        let (source, program) = (source.to_str().unwrap(), program.to_str().unwrap());
        let arguments = [flags, &[source, "-o", program], libraries].concat();
        self.run(&arguments);
    }

    /// Looks for warnings, of a large file without making code.
    pub fn check(&self, flags: &[&str], source: &Path, large: bool) {
        let with = if large { "-fsyntax-only" } else { "-O1" };
        let object = source.with_extension("o");
        let paths = [source.to_str().unwrap(), "-c", "-o", object.to_str().unwrap()];
        self.run(&[flags, &[with], &paths].concat());
    }
}

/// The output of a program: one text, so that it can be compared with others.
pub fn output(program: &Path, arguments: &[&str]) -> Vec<String> {
    let tool = Tool(program.to_str().unwrap().to_owned());
    vec![tool.run(arguments)]
}

/// An empty folder for a test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("c_header").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// A finite number as C's `%a` prints it.
pub fn hexadecimal(value: f64) -> String {
    let bits = value.to_bits();
    let sign = if value.is_sign_negative() { "-" } else { "" };
    let (exponent, mantissa) = ((bits >> 52) & 0x7ff, bits & ((1 << 52) - 1));
    if exponent == 0 && mantissa == 0 {
        return format!("{sign}0x0p+0");
    }
    let digits = format!("{mantissa:013x}");
    let digits = digits.trim_end_matches('0');
    let point = if digits.is_empty() { "" } else { "." };
    format!("{sign}0x1{point}{digits}p{:+}", exponent as i64 - 1023)
}
