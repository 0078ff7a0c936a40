//! Work on one matrix, shared by threads.
//!
//! Pieces are cut by sizes alone and each is computed by one thread, so results have the same bits on any number of
//! threads.

use std::cell::Cell;
use std::sync::{Mutex, OnceLock, PoisonError};

/// Starting a thread ends a program that no system is behind: WebAssembly in a browser.
const HAS_THREADS: bool = cfg!(not(target_family = "wasm"));
/// Floating-point operations that are worth a thread: some ten times what starting one costs.
const WORTH_A_THREAD: usize = 1 << 20;

thread_local! {
    /// How many threads this one may use, itself included; none: as many as there are cores.
    static MOST: Cell<Option<usize>> = const { Cell::new(None) };
    /// CPU time of other threads that have worked for this one, s.
    static HELPED: Cell<f64> = const { Cell::new(0.0) };
}

/// Does something without the help of other threads: for a caller who has given each core its own work already.
pub fn alone<R>(work: impl FnOnce() -> R) -> R {
    struct Back(Option<usize>);
    impl Drop for Back {
        fn drop(&mut self) {
            MOST.set(self.0);
        }
    }
    let _back = Back(MOST.replace(Some(1)));
    work()
}

/// CPU time that other threads have worked for this one so far, s; 0 where the system does not tell.
#[must_use]
pub fn helped() -> f64 {
    HELPED.get()
}

fn most() -> usize {
    static CORES: OnceLock<usize> = OnceLock::new();
    let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    if HAS_THREADS { MOST.get().unwrap_or_else(|| *CORES.get_or_init(cores)) } else { 1 }
}

/// Does work on each of some pieces, which take so many floating-point operations together.
pub fn share<T: Send>(operations: usize, pieces: Vec<T>, work: impl Fn(T) + Sync) {
    let count = most().min(pieces.len()).min(1 + operations / WORTH_A_THREAD);
    if count < 2 {
        pieces.into_iter().for_each(work);
        return;
    }
    let pieces = Mutex::new(pieces.into_iter());
    let next = || pieces.lock().unwrap_or_else(PoisonError::into_inner).next();
    let go_on = || {
        while let Some(piece) = next() {
            work(piece);
        }
    };
    let spent: f64 = std::thread::scope(|scope| {
        let help = || {
            alone(go_on);
            thread_seconds()
        };
        let helpers: Vec<_> = (1..count).map(|_| scope.spawn(help)).collect();
        go_on();
        let each = helpers.into_iter().map(|helper| match helper.join() {
            Ok(seconds) => seconds,
            Err(panic) => std::panic::resume_unwind(panic),
        });
        each.sum()
    });
    HELPED.set(HELPED.get() + spent);
}

/// Does one thing, and meanwhile work on pieces where another thread may help; each without further help, so that none
/// waits for a core. In what order they are done is not told.
pub fn beside<A: Send, T: Send>(
    first: impl FnOnce() -> A + Send,
    pieces: Vec<T>,
    work: impl Fn(T) + Sync,
) -> A {
    let mut a = None;
    let mut all: Vec<Box<dyn FnOnce() + Send + '_>> = vec![Box::new(|| a = Some(first()))];
    for piece in pieces {
        let work = &work;
        all.push(Box::new(move || work(piece)));
    }
    share(usize::MAX, all, alone);
    // Each piece is done once.
    a.unwrap_or_else(|| unreachable!("it is done"))
}

/// Does two things at once where another thread may help, as [`beside`] does.
pub fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    let mut b = None;
    let a = beside(first, vec![(second, &mut b)], |(second, b)| *b = Some(second()));
    (a, b.unwrap_or_else(|| unreachable!("both are done")))
}

/// CPU time of this thread, s; 0 where the system does not tell.
#[must_use]
pub fn thread_seconds() -> f64 {
    #[cfg(unix)]
    {
        let t = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
    }
    #[cfg(not(unix))]
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn squares(operations: usize) -> Vec<usize> {
        let mut all: Vec<usize> = (0..100).collect();
        share(operations, all.iter_mut().collect(), |x| *x *= *x);
        all
    }

    #[test]
    fn every_piece_is_done_once_by_one_thread_and_by_many() {
        let expected: Vec<usize> = (0..100).map(|i| i * i).collect();
        assert_eq!(squares(0), expected);
        assert_eq!(squares(usize::MAX), expected);
        assert_eq!(alone(|| squares(usize::MAX)), expected);
        MOST.set(Some(7));
        assert_eq!(squares(usize::MAX), expected);
    }

    #[test]
    fn what_helpers_have_spent_is_told_and_nobody_helps_who_works_alone() {
        let spin = |_: usize| {
            let start = std::time::Instant::now();
            while start.elapsed().as_millis() < 5 {
                std::hint::spin_loop();
            }
        };
        MOST.set(Some(2));
        let before = helped();
        alone(|| share(usize::MAX, (0..8).collect(), spin));
        assert_eq!(helped(), before);
        share(usize::MAX, (0..8).collect(), spin);
        assert!(cfg!(not(unix)) || helped() > before);
        // Helpers have no helpers of their own.
        share(usize::MAX, vec![(); 2], |()| assert!(most() <= 2));
    }

    #[test]
    fn two_things_are_done_whoever_helps() {
        MOST.set(Some(2));
        assert_eq!(both(|| 1 + 1, || "two".len()), (2, 3));
        assert_eq!(alone(|| both(|| 1 + 1, || "two".len())), (2, 3));
    }

    #[test]
    #[should_panic(expected = "a piece that cannot be done")]
    fn a_panic_in_a_helper_is_not_lost() {
        MOST.set(Some(3));
        share(usize::MAX, vec![(); 3], |()| {
            std::thread::sleep(std::time::Duration::from_millis(20));
            panic!("a piece that cannot be done");
        });
    }
}
