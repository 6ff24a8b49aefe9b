//! Prints the numbers of the robot as a header of C: `include/cotama_robot.h` of the delivery.
//!
//! `cargo run --manifest-path firmware/c/Cargo.toml --example robot_header`

fn main() {
    print!("{}", include_str!(concat!(env!("OUT_DIR"), "/cotama_robot.h")));
}
