//! Threads that work beside Python: starting one costs more than many a call does, so that they are kept for the next one.

use std::cell::Cell;
use std::sync::Mutex;
use std::sync::mpsc::{Sender, channel};
use std::thread::Builder;

/// Work, which calls what it is given before it publishes its result.
pub type Job = Box<dyn FnOnce(&dyn Fn()) + Send>;

/// Idle threads that are kept at most.
const MOST: usize = 4;

/// The idle threads of the process with this number: a fork has none of its parent's threads.
static IDLE: Mutex<(u32, Vec<Sender<Job>>)> = Mutex::new((0, Vec::new()));

/// Does something with the idle threads of this process, unless another thread does; that thread may be gone, after a fork.
fn idle<T>(act: impl FnOnce(&mut Vec<Sender<Job>>) -> T) -> Option<T> {
    let mut idle = IDLE.try_lock().ok()?;
    let (process, threads) = &mut *idle;
    let own = std::process::id();
    if *process != own {
        // Dropping them would wake threads that are not there.
        std::mem::take(threads).into_iter().for_each(std::mem::forget);
        *process = own;
    }
    Some(act(threads))
}

/// Starts work in an idle thread, or in a new one.
///
/// # Errors
/// Fails if no thread can be started.
pub fn start(mut job: Job) -> std::io::Result<()> {
    while let Some(Some(thread)) = idle(Vec::pop) {
        match thread.send(job) {
            Ok(()) => return Ok(()),
            Err(back) => job = back.0,
        }
    }
    let (sender, jobs) = channel();
    let own = sender.clone();
    let run = move || {
        let kept = Cell::new(false);
        let keep = || {
            let push = |threads: &mut Vec<Sender<Job>>| {
                let room = threads.len() < MOST;
                threads.extend(room.then(|| own.clone()));
                room
            };
            kept.set(idle(push).unwrap_or(false));
        };
        while let Ok(job) = jobs.recv() {
            kept.set(false);
            job(&keep);
            if !kept.get() {
                break;
            }
        }
    };
    Builder::new().name("coadjoint".to_owned()).stack_size(16 << 20).spawn(run)?;
    // Its receiver is there as long as the thread is.
    let _ = sender.send(job);
    Ok(())
}
