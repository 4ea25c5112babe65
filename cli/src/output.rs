//! Standard output, whose reader may stop reading: `coadjoint emit … | head`.

use std::fmt::Arguments;
use std::io::{ErrorKind, Write, stdout};

/// As `print!`, by [`write()`].
macro_rules! out {
    ($($argument:tt)*) => { $crate::output::write(format_args!($($argument)*)) };
}

/// As `println!`, by [`write()`].
macro_rules! outln {
    ($($argument:tt)*) => { out!("{}\n", format_args!($($argument)*)) };
}

/// Writes to standard output. Where nobody reads on the work goes on, files are still to be written;
/// any other failure (a full disk) ends the program with a message and exit code 1.
pub(crate) fn write(text: Arguments<'_>) {
    let mut out = stdout().lock();
    match out.write_fmt(text).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            eprintln!("error: standard output cannot be written: {error}");
            std::process::exit(1);
        }
        _ => {}
    }
}
