//! Work for each of a few numbers, written out.
//!
//! A law is one function into which every operation of its numbers goes. With a loop in each of them it has thousands of
//! loops, and the compiler, which unrolls one after the other and looks at all the others each time, takes minutes for it.

/// `each!(N, i => work)`: the work for `i` from 0 to N − 1, where N is a constant of 24 at most.
macro_rules! each {
    ($n:ident, $i:ident => $work:expr) => {
        each!(($n, $i, $work) 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23)
    };
    (($n:ident, $i:ident, $work:expr) $($k:literal)*) => {{
        const { assert!($n <= 24) };
        $(each!(@one $n, $i, $work, $k);)*
    }};
    (@one $n:ident, $i:ident, $work:expr, $k:literal) => {
        if $n > $k {
            let $i: usize = $k;
            $work
        }
    };
}
/// The same for two registers at most.
#[cfg(target_arch = "x86_64")]
macro_rules! each_of_two {
    ($n:ident, $i:ident => $work:expr) => {{
        const { assert!($n <= 2) };
        each!(@one $n, $i, $work, 0);
        each!(@one $n, $i, $work, 1);
    }};
}
pub(super) use each;
#[cfg(target_arch = "x86_64")]
pub(super) use each_of_two;
