//! Prints the net for the program `cotama`:
//!
//! ```text
//! cargo run --example model > my-net.json
//! cotama check my-net.json
//! cotama check my-net.json --property 'AG (Lost -> missed = 3)'
//! cotama simulate my-net.json start heard@80 +300
//! cargo run && cotama conform my-net.json log.jsonl
//! cotama export my-net.json --output my-net.svg
//! ```

use cotama_verification::formats::json;
use my_net::my_net::NET;

fn main() {
    print!("{}", json::write(&NET));
}
