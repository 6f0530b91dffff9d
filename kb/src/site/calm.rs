//! Work that takes long, and that nobody waits for with a robot: its threads leave the processor to whoever asks for less.

use std::panic::resume_unwind;
use std::sync::OnceLock;
use std::thread;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// How far behind others such threads come, as `nice` counts: a quarter is left to them where all cores are wanted.
#[cfg(target_os = "linux")]
const BEHIND: i32 = 5;

/// Has the present thread come after others from now on, where the system has threads do so one by one.
pub fn come_after_others() {
    // its threads would come of this one, and be as late
    rayon::current_num_threads();
    #[cfg(target_os = "linux")]
    rustix::process::setpriority_process(None, BEHIND).ok();
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

/// Does work whose parts go on side by side, on threads that come after others.
pub fn side_by_side<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    static POOL: OnceLock<Option<ThreadPool>> = OnceLock::new();
    let pool = POOL.get_or_init(|| {
        let threads = ThreadPoolBuilder::new().thread_name(|number| format!("calm {number}"));
        threads.start_handler(|_| come_after_others()).build().ok()
    });
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}
