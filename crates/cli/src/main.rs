//! The program `trilith` with the built-in elements and links.

fn main() {
    trilith_cli::main_with(trilith::registry())
}
