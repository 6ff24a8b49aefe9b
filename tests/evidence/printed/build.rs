//! Prints the decisional level of the delivery robot, as `cotama table p3dx delivery` does.

use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::to_rust;
use std::path::PathBuf;
use std::{env, fs};

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let mission = embedded::mission("delivery").expect("it is shipped");
    let mission = Mission::parse(mission.name, mission.text).expect("it is sound");
    let robot = mission.robot().expect("it names a robot").robot();
    let source = to_rust(robot, &mission.steps());
    fs::write(folder.join("delivery.rs"), source).expect("cargo made the folder");
}
