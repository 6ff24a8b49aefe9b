//! The program `cotama`, which is the library of this package: so it compiles beside the crates
//! that it calls, and waits for them only here.

fn main() -> std::process::ExitCode {
    cotama_cli::main()
}
