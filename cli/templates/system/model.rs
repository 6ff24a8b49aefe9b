//! Prints the system as one net for the program `cotama`:
//!
//! ```text
//! cargo run --example model > my-system.json
//! cotama check my-system.json --property 'AG !(drive.Running & link.Silent)'
//! cotama export my-system.json --output my-system.svg
//! ```

use cotama_verification::formats::json;
use cotama_verification::flat::flat;

fn main() {
    match flat(&my_system::my_system::SYSTEM) {
        Ok(net) => print!("{}", json::write(&net.view().net())),
        Err(error) => eprintln!("the system is no net: {error}"),
    }
}
