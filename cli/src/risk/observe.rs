//! `cotama risk observe`: indicators of a robot at work.

use crate::args::ObserveArgs;
use crate::exit::{Exit, Failure};
use crate::floor;
use crate::output::Screen;
use cotama_indicators::{NoDrive, Options, PLAZA, SIDEWALK, drive_on, to_csv};

/// Drives and prints the samples.
pub(super) fn observe(args: &ObserveArgs) -> Result<Exit, Failure> {
    let floor = match args.floor.as_str() {
        "sidewalk" => SIDEWALK.floor()?,
        "plaza" => PLAZA.floor()?,
        other => floor::drawing(other)?,
    };
    let people = usize::try_from(args.people).unwrap_or(usize::MAX);
    let options = Options { seed: args.seed, people, seconds: args.seconds };
    let samples = drive_on(&floor, &options).map_err(|it| {
        let failure = Failure::of(&args.floor, it.to_string());
        match it {
            NoDrive::Places => failure.help("draw two places that a robot can go between"),
            NoDrive::Large => failure.help("draw a part of it"),
            NoDrive::Options => failure,
        }
    })?;
    Screen::raw(to_csv(&samples).as_bytes())?;
    Ok(Exit::Success)
}
