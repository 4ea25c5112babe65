//! Standard output, whose reader may stop reading: `coadjoint emit … | head`.

use std::fmt::Arguments;
use std::io::{ErrorKind, Write, stdout};

use coadjoint_codegen::diagnostic::visible;

/// As `print!`, by [`write()`].
macro_rules! out {
    ($($argument:tt)*) => { $crate::output::write(format_args!($($argument)*)) };
}

/// As `println!`, by [`write()`].
macro_rules! outln {
    ($($argument:tt)*) => { out!("{}\n", format_args!($($argument)*)) };
}

/// As `eprint!`, of visible characters alone.
macro_rules! err {
    ($($argument:tt)*) => { eprint!("{}", coadjoint_codegen::diagnostic::visible(&format!($($argument)*))) };
}

/// As `eprintln!`, of visible characters alone.
macro_rules! errln {
    ($($argument:tt)*) => { err!("{}\n", format_args!($($argument)*)) };
}

/// Writes to standard output. Where nobody reads on the work goes on, files are still to be written;
/// any other failure (a full disk) ends the program with a message and exit code 1.
pub(crate) fn write(text: Arguments<'_>) {
    let mut out = stdout().lock();
    let text = text.to_string();
    match out.write_all(visible(&text).as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            eprintln!("error: standard output cannot be written: {error}");
            std::process::exit(1);
        }
        _ => {}
    }
}
