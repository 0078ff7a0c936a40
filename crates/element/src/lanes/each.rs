//! Work for each of a few numbers, written out.
//!
//! A law is one function into which every operation of its numbers goes. With a loop in each of them it has thousands of
//! loops, and the compiler, which unrolls one after the other and looks at all the others each time, takes minutes for it.

/// `each!(N, i => work)`: the work for `i` from 0 to N − 1, where N is a constant of 24 at most that a type brings, or 8. What is
/// beyond N is left out before it is compiled.
macro_rules! each {
    (8, $i:ident => $work:expr) => {
        each!(@all $i, $work, 0 1 2 3 4 5 6 7)
    };
    ($n:ident, $i:ident => $work:expr) => {
        each!(($n, $i, $work) 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23)
    };
    (($n:ident, $i:ident, $work:expr) $($k:literal)*) => {{
        const { assert!($n <= 24) };
        $(each!(@one $n, $i, $work, $k);)*
    }};
    (@all $i:ident, $work:expr, $($k:literal)*) => {{
        $({
            let $i: usize = $k;
            $work
        };)*
    }};
    (@one $n:ident, $i:ident, $work:expr, $k:literal) => {
        if const { $n > $k } {
            let $i: usize = $k;
            $work
        }
    };
}
pub(super) use each;
