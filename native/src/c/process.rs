//! Running a compiler that may hang.

use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Why a command has no result.
#[derive(Debug)]
pub(super) enum Fault {
    /// It could not be started.
    Start(std::io::Error),
    /// Its output cannot be kept.
    Output(std::io::Error),
    /// It did not end in time; it and what it had started were ended.
    TimedOut,
}

/// How a command ended, and what it wrote to its outputs, the error output last.
pub(super) struct Finished {
    pub status: ExitStatus,
    pub output: String,
    pub errors: String,
}

/// Runs a command to its end, at most so long. Its outputs go through files in `folder`: a pipe would stay open as long
/// as anything that the command started.
pub(super) fn run(
    command: &mut Command,
    limit: Duration,
    folder: &Path,
) -> Result<Finished, Fault> {
    let (output, errors) = (folder.join("output"), folder.join("errors"));
    let create = |path: &Path| File::create(path).map_err(Fault::Output);
    command.stdin(Stdio::null()).stdout(create(&output)?).stderr(create(&errors)?);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let mut child = command.spawn().map_err(Fault::Start)?;
    let status = wait(&mut child, limit)?;
    let read = |path: &Path| {
        let bytes = std::fs::read(path).map_err(Fault::Output)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    Ok(Finished { status, output: read(&output)?, errors: read(&errors)? })
}

fn wait(child: &mut Child, limit: Duration) -> Result<ExitStatus, Fault> {
    let start = Instant::now();
    let mut pause = Duration::from_micros(500);
    loop {
        if let Some(status) = child.try_wait().map_err(Fault::Start)? {
            return Ok(status);
        }
        let left = limit.saturating_sub(start.elapsed());
        if left.is_zero() {
            end(child);
            return Err(Fault::TimedOut);
        }
        std::thread::sleep(pause.min(left));
        pause = (pause * 3 / 2).min(Duration::from_millis(5));
    }
}

/// Ends a command and, where there are process groups, all that it started.
fn end(child: &mut Child) {
    #[cfg(unix)]
    if let Some(group) = i32::try_from(child.id()).ok().and_then(rustix::process::Pid::from_raw) {
        // The group may be gone already, which is as well.
        let _ = rustix::process::kill_process_group(group, rustix::process::Signal::KILL);
    }
    let _ = child.kill();
    let _ = child.wait();
}
