//! Work that takes long, and that nobody waits for with a robot: its threads leave the processor to whoever asks for less.

use std::panic::resume_unwind;
use std::sync::OnceLock;
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// How far behind others such threads come, as `nice` counts: a quarter is left to them where all cores are wanted.
const BEHIND: i32 = 5;

/// How far behind come those of answers that somebody may like to read by and by: a fifth of what is left to the others.
const LAST: i32 = 12;

/// Has the present thread come after others from now on, where the system has threads do so one by one.
pub fn come_after_others() {
    come_behind(BEHIND);
}

/// Has it come after those, too: a preview is waited for, and how firm a way is is read once it is there.
pub fn come_last() {
    come_behind(LAST);
}

#[cfg_attr(not(target_os = "linux"), allow(unused_variables))]
fn come_behind(by: i32) {
    // its threads would come of this one, and be as late
    rayon::current_num_threads();
    #[cfg(target_os = "linux")]
    rustix::process::setpriority_process(None, by).ok();
}

/// Does something on a thread that comes after others; so do threads that are begun there, and go on.
pub fn apart<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    let apart = || {
        come_after_others();
        work()
    };
    thread::scope(|scope| scope.spawn(apart).join()).unwrap_or_else(|panic| resume_unwind(panic))
}

/// Does two things side by side, the second on the present thread.
pub fn both<A: Send, B>(one: impl FnOnce() -> A + Send, other: impl FnOnce() -> B) -> (A, B) {
    thread::scope(|scope| {
        let one = scope.spawn(one);
        let other = other();
        (one.join().unwrap_or_else(|panic| resume_unwind(panic)), other)
    })
}

/// Does work whose parts go on side by side, on threads that come last.
pub fn side_by_side<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    static POOL: OnceLock<Option<ThreadPool>> = OnceLock::new();
    let pool = POOL.get_or_init(|| {
        let threads = ThreadPoolBuilder::new().thread_name(|number| format!("calm {number}"));
        threads.start_handler(|_| come_last()).build().ok()
    });
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}
