//! The examples run to their end.

macro_rules! example {
    ($name:ident, $file:literal) => {
        #[path = $file]
        mod $name;

        #[test]
        fn $name() {
            $name::main().expect("an end without an error");
        }
    };
}

example!(read_and_run, "../examples/read_and_run.rs");
example!(own_observer, "../examples/own_observer.rs");
example!(sweep, "../examples/sweep.rs");
example!(optimisation, "../examples/optimisation.rs");
example!(model_in_rust, "../examples/model_in_rust.rs");
