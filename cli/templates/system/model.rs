//! Prints the system for the program `cotama`:
//!
//! ```text
//! cargo run --example model > my-system.json
//! cotama check my-system.json --property 'AG !(drive.Running & link.Silent)'
//! cotama export my-system.json --output my-system.svg
//! ```

use cotama_verification::formats::json;

fn main() {
    print!("{}", json::write_system(&my_system::my_system::SYSTEM));
}
