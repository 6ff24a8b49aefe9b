//! Runs a mission in which something fails: `cargo run -p cotama-sim --example run_with_fault`.
//!
//! The patrol loses a laser at 60 m, and the first hall costs 4 % more power than was modelled.
//! What the robot does about it is read from the trace of the run.

use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::trace::{Record, Trace, replay};
use std::error::Error;
use std::io::{self, Write};

/// A file of faults, as `cotama run patrol --faults FILE` reads it.
const FAULTS: &str = r#"
format = "panorama-faults/1"
power_error_permille = { "H1-out" = 40 }

[[event]]
x_mm = 60000
kind = "fault"
hardware = "laser"
units_lost = 1

[[event]]
x_mm = 90000
kind = "obstacle"
delay_ms = 5000
"#;

/// Runs the program.
pub(crate) fn run(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    let patrol = embedded::mission("patrol").ok_or("the patrol comes with the program")?;
    let mission = Mission::parse(patrol.name, patrol.text)?;

    // The faults stand for those that the mission file has itself.
    let faults = Faults::parse("faults.toml", FAULTS, &mission)?;
    let faults = FaultChoice::Given { source: "faults.toml".into(), faults };
    let options = Options { faults, ..Options::default() };
    let (trace, _) = Trace::record(&mission, &options)?;

    for record in &trace.records {
        let (at, x) = (record.t_us() / 1_000_000, record.x_mm() / 1_000);
        match record {
            Record::Plan(it) => {
                let energy = it.after.energy_mj / 1_000;
                writeln!(out, "{at:>4} s {x:>4} m  plan: {}, {energy} J to spare", it.cause)?;
            }
            Record::Event(it) => writeln!(out, "{at:>4} s {x:>4} m  {:?}", it.event)?,
            Record::Request(it) => writeln!(out, "{at:>4} s {x:>4} m  asks: {}", it.reason)?,
            Record::End(it) => writeln!(out, "{at:>4} s {x:>4} m  {}", it.outcome.name())?,
            _ => {}
        }
    }

    // A trace holds the mission and the faults: anybody can run it again.
    writeln!(out, "again, the same bytes: {}", replay(&trace)?.identical)?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
