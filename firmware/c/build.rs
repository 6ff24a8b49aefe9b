//! Prints the decisional level of a robot in its mission as Rust, and its numbers as a header of C.
//!
//! The mission is that of the environment variable `COTAMA_MISSION`: the name of one that comes
//! with the project, or the path of a file; else the delivery.

use cotama_core::player::size;
use cotama_models::level::Decider;
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{self, Robot, RobotFile, supervisors, to_rust};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};

const VARIABLE: &str = "COTAMA_MISSION";

fn main() -> ExitCode {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed={VARIABLE}");
    let Err(why) = print() else { return ExitCode::SUCCESS };
    why.lines().for_each(|it| println!("cargo::error={it}"));
    ExitCode::FAILURE
}

fn print() -> Result<(), String> {
    let name = env::var(VARIABLE).unwrap_or_else(|_| "delivery".to_owned());
    let mission = mission(&name)?;
    let Some(robot) = mission.robot().map(RobotFile::robot) else {
        return Err(format!("{VARIABLE}: the mission `{name}` names no robot: add `robot = ...`"));
    };
    let steps = mission.steps();
    let system = supervisors::of_mission(robot, &steps);
    let size = system.with(size::size_of);
    // A slot carries two bytes, and fields are aligned: the library compares it.
    let varies = 8 * size.words + 4 * size.clocks + 2 * size.slots;
    let level = (size_of::<u64>() + size_of::<Decider<'_, (), 0, 0, 0>>() + varies + 16)
        .next_multiple_of(16);
    let stored = varies + 12;

    let mut numbers = Numbers::default();
    numbers.bytes(level, stored);
    numbers.of(robot, steps.iter().map(|it| it.name.as_str()));
    let header = numbers.header(robot, &mission);

    let mut source = to_rust(robot, &steps);
    let module = format!("net_{}", system.name).to_lowercase();
    let _ = write!(
        source,
        "
pub use {module} as system;
pub const ROBOT: u64 = {:#018x};
pub const LEVEL_BYTES: usize = {level};
pub const LEVEL_STORED_BYTES: usize = {stored};
",
        numbers.hash(),
    ); // a text takes all
    let folder = PathBuf::from(env::var_os("OUT_DIR").ok_or("cargo names no folder")?);
    let put = |file: &str, text| {
        fs::write(folder.join(file), text).map_err(|why| format!("cannot write {file}: {why}"))
    };
    put("robot.rs", source)?;
    put("cotama_robot.h", header)
}

/// The mission of this name, or of the file at this path.
fn mission(name: &str) -> Result<Mission, String> {
    let (text, folder) = if let Some(it) = embedded::mission(name) {
        (it.text.to_owned(), None)
    } else {
        println!("cargo::rerun-if-changed={name}");
        let text = fs::read_to_string(name).map_err(|why| {
            let known: Vec<_> = embedded::embedded().iter().map(|it| it.name).collect();
            format!(
                "{VARIABLE}: no mission `{name}` comes with the project, and no such file can be \
                 read: {why}\n  help: name one of {}, or a file by its absolute path or from \
                 firmware/c",
                known.join(", ")
            )
        })?;
        (text, Path::new(name).parent())
    };
    let robot = Mission::robot_of(&text).map(|it| robot(&it, folder)).transpose()?.flatten();
    Mission::parse_under(name, &text, robot).map_err(|why| why.to_string())
}

/// The robot of this name that comes with the project, or of the file beside the mission; `None`
/// where there is neither, which the reader of missions tells with its place.
fn robot(name: &str, folder: Option<&Path>) -> Result<Option<RobotFile>, String> {
    if robots::embedded(name).is_some() {
        return Ok(RobotFile::shipped(name));
    }
    let Some(path) = folder.map(|it| it.join(name)).filter(|it| it.exists()) else {
        return Ok(None);
    };
    println!("cargo::rerun-if-changed={}", path.display());
    let text = fs::read_to_string(&path).map_err(|why| format!("{}: {why}", path.display()))?;
    let file = RobotFile::parse(&path.display().to_string(), &text);
    file.map(Some).map_err(|why| why.to_string())
}

/// The numbers of a robot, as constants of C.
#[derive(Default)]
struct Numbers {
    lines: String,
    taken: BTreeSet<String>,
}

impl Numbers {
    fn bytes(&mut self, level: usize, stored: usize) {
        let _ = write!(
            self.lines,
            "
/* The bytes of a `cotama_level`, at an address that is a multiple of 8. */
#define COTAMA_LEVEL_BYTES {level}
/* The bytes of a stored one. */
#define COTAMA_LEVEL_STORED_BYTES {stored}
"
        );
    }

    fn of<'n>(&mut self, robot: &'n Robot, steps: impl Iterator<Item = &'n str>) {
        let set = |count: usize| format!("UINT64_C({:#x})", (1_u128 << count) - 1);
        self.group("Flags: flag `n` is bit `n` of a set.", "FLAG", robot.flags().map(|it| it.1));
        self.constant("COTAMA_FLAGS_ALL", &set(robot.flags().count()));
        let modules = robot.modules.iter().map(|it| it.name.as_str());
        self.group("Modules: module `n` is bit `n` of a set.", "MODULE", modules);
        self.constant("COTAMA_MODULES_ALL", &set(robot.modules.len()));
        let all = robot.sub_objectives.iter().map(|it| it.name.as_str());
        self.group("Sub-objectives.", "SUB_OBJECTIVE", all);
        let all = robot.configurations.iter().map(|it| it.name.as_str());
        self.group("Configurations.", "CONFIGURATION", all);
        self.group("Objectives of the mission, in their order.", "STEP", steps);
        let all = robot.failures.iter().map(|it| it.id.as_str());
        self.group("Failures.", "FAILURE", all);
        let all = robot.losses.reports.iter().map(|it| it.name.as_str());
        self.group("Reports: report `n` is bit `n` of a set of settings.", "REPORT", all);
        let all = robot.losses.losses.iter().map(|it| it.name.as_str());
        self.group("Losses that stay.", "LOSS", all);
    }

    fn group<'n>(&mut self, title: &str, of: &str, names: impl Iterator<Item = &'n str>) {
        let _ = write!(self.lines, "\n/* {title} */\n");
        for (number, name) in names.enumerate() {
            let name = name.chars().map(|it| if it.is_ascii_alphanumeric() { it } else { '_' });
            let name: String = name.map(|it| it.to_ascii_uppercase()).collect();
            self.constant(&format!("COTAMA_{of}_{name}"), &number.to_string());
        }
    }

    /// Adds a constant, whose name is made another one where it is taken.
    fn constant(&mut self, name: &str, value: &str) {
        let others = (2..).map(|number| format!("{name}_{number}"));
        let mut all = std::iter::once(name.to_owned()).chain(others);
        let Some(name) = all.find(|it| !self.taken.contains(it)) else { return };
        let _ = writeln!(self.lines, "#define {name} {value}");
        self.taken.insert(name);
    }

    /// Returns a number that other constants do not have: FNV-1a of their lines.
    fn hash(&self) -> u64 {
        let add = |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        self.lines.bytes().fold(0xcbf2_9ce4_8422_2325, add)
    }

    fn header(&self, robot: &Robot, mission: &Mission) -> String {
        let title = |text: &str| text.replace("*/", "* /").replace(char::is_control, " ");
        format!(
            "/* Numbers of the robot {} in the mission {}, for cotama.h.
 *
 * Made by the build script of firmware/c; `cargo run --example robot_header` prints it. */

#ifndef COTAMA_ROBOT_H
#define COTAMA_ROBOT_H

#include <stdint.h>

/* Tells these numbers from those of another robot or mission: for `cotama_level_start`. */
#define COTAMA_ROBOT UINT64_C({:#018x})
{}
#endif /* COTAMA_ROBOT_H */
",
            title(&robot.name),
            title(&mission.name),
            self.hash(),
            self.lines,
        )
    }
}
