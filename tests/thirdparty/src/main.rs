//! The program `trilith` with the links of this crate beside the built-in kinds.

fn main() {
    let mut kinds = trilith::registry();
    trilith_thirdparty_example::register(&mut kinds);
    trilith_cli::main_with(kinds)
}
