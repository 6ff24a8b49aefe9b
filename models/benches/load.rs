//! How long a mission under supervisors takes from its text to what can be run: its robot read, the
//! mission read and cut into activities, and its supervisors made.
//!
//! `cargo bench -p cotama-models --bench load`; with any argument of its own it runs briefly.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::RobotFile;
use cotama_models::robots::supervisors::of_mission;
use std::fmt::Write;
use std::hint::black_box;
use std::time::Instant;

/// The delivery with drives, objects and waits in turn up to so many objectives.
fn text(objectives: usize) -> String {
    let delivery = embedded::mission("delivery").unwrap().text;
    let (head, rest) = delivery.split_once("[[objective]]").unwrap();
    let script = &rest[rest.find("[run]").unwrap()..];
    let mut text = String::new();
    let mut x = 0;
    for number in 0..objectives {
        let (does, length) = match number % 4 {
            1 => ("receive", 0),
            3 => ("deliver", 0),
            _ => ("drive", 80_000 / objectives * 2),
        };
        let end = x + length;
        let _ = writeln!(text, "[[objective]]\nid = \"o{number}\"\ndoes = \"{does}\"");
        let _ = writeln!(text, "x_start_mm = {x}\nx_end_mm = {end}");
        x = end;
    }
    let head = head.replace("path_length_mm = 80000", &format!("path_length_mm = {x}"));
    head.replace("duration_ms = 900000", "duration_ms = 100000000") + &text + script
}

/// The median over several rounds of how many microseconds `work` takes.
fn microseconds(rounds: usize, times: u32, mut work: impl FnMut()) -> f64 {
    let mut taken: Vec<f64> = (0..rounds)
        .map(|_| {
            let start = Instant::now();
            (0..times).for_each(|_| work());
            start.elapsed().as_secs_f64() * 1e6 / f64::from(times)
        })
        .collect();
    taken.sort_by(f64::total_cmp);
    taken[rounds / 2]
}

fn main() {
    let brief = std::env::args().skip(1).any(|argument| argument == "--test");
    let (rounds, times) = if brief { (1, 2) } else { (9, 50) };
    let robot = microseconds(rounds, times, || {
        drop(black_box(RobotFile::shipped("p3dx-delivery").unwrap()));
    });
    println!("the robot alone: {robot:.0} µs\nobjectives   load, µs   supervisors, µs");
    for objectives in [4, 20, 100, 200] {
        let text = text(objectives);
        let mission = Mission::parse("mission", &text).unwrap();
        let (robot, steps) = (mission.robot().unwrap().robot(), mission.steps());
        let load = microseconds(rounds, times, || {
            drop(black_box(Mission::parse("mission", &text).unwrap()));
        });
        let made = microseconds(rounds, times, || {
            drop(black_box(of_mission(robot, &steps)));
        });
        println!("{objectives:>10} {load:>10.0} {made:>17.0}");
    }
}
