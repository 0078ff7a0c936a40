//! What a system may be without: WebAssembly alone, in a browser, has neither threads nor a clock.

/// Asking for the time ends a program that no system is behind.
pub(crate) const HAS_CLOCK: bool = cfg!(not(all(target_family = "wasm", target_os = "unknown")));

/// Starting a thread does, too. What goes beside a run comes after it there, with the same results: it gives nothing back.
pub(crate) const HAS_THREADS: bool = cfg!(not(target_family = "wasm"));
