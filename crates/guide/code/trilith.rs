//! The program `trilith`, built with the guide so that its tests can run it.

fn main() {
    trilith_cli::main_with(trilith::registry())
}
