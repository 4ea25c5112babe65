//! Running a compiler that may hang.

use std::fs::File;
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Why a command has no result.
#[derive(Debug)]
pub(super) enum Fault {
    /// It could not be started.
    Start(std::io::Error),
    /// Its output cannot be kept.
    Output(std::io::Error),
    /// It exceeded its time limit; it and the processes it had started were ended.
    TimedOut,
    /// It was stopped on request, with the processes it had started.
    Stopped,
}

/// How a command ended, and what it wrote to its outputs, the error output last.
pub(super) struct Finished {
    pub status: ExitStatus,
    pub output: String,
    pub errors: String,
}

/// Runs a command until it ends, the time limit passes or `stop` is set. Neither it nor its children outlive this process.
/// Its outputs go through files in `folder`: a pipe would stay open as long
/// as anything that the command started.
pub(super) fn run(
    command: &mut Command,
    limit: Duration,
    stop: &AtomicBool,
    folder: &Path,
) -> Result<Finished, Fault> {
    let (output, errors) = (folder.join("output"), folder.join("errors"));
    let create = |path: &Path| File::create(path).map_err(Fault::Output);
    command.stdin(Stdio::null()).stdout(create(&output)?).stderr(create(&errors)?);
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    let mut child = command.spawn().map_err(Fault::Start)?;
    let watcher = Watcher::new(child.id());
    let status = wait(&mut child, limit, stop);
    drop(watcher);
    let status = status?;
    let read = |path: &Path| {
        let bytes = std::fs::read(path).map_err(Fault::Output)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    Ok(Finished { status, output: read(&output)?, errors: read(&errors)? })
}

/// A shell that ends a group of processes when this process ends, in whatever way: its input is closed then.
struct Watcher(Child);

impl Watcher {
    /// The watcher of the group that this process leads; `None` where there are no groups or no shell.
    fn new(leader: u32) -> Option<Self> {
        if !cfg!(unix) {
            return None;
        }
        let mut command = Command::new("sh");
        command.args(["-c", "read _; kill -KILL \"-$1\"", "sh", &leader.to_string()]);
        command.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
        // Signals that a terminal sends to this process must not end the watcher.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        command.spawn().ok().map(Self)
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn wait(child: &mut Child, limit: Duration, stop: &AtomicBool) -> Result<ExitStatus, Fault> {
    let start = Instant::now();
    let mut pause = Duration::from_micros(500);
    loop {
        if let Some(status) = child.try_wait().map_err(Fault::Start)? {
            return Ok(status);
        }
        let left = limit.saturating_sub(start.elapsed());
        let stopped = stop.load(Ordering::Relaxed);
        if left.is_zero() || stopped {
            end(child);
            return Err(if stopped { Fault::Stopped } else { Fault::TimedOut });
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
