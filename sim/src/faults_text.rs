//! Faults as the text of a `panorama-faults/1` file, which reads back to the same faults.

use cotama_models::missions::Definition;
use cotama_models::missions::faults::{EventKind, FORMAT, Faults};
use cotama_models::robots;
use std::fmt::Write;

/// The text of a `panorama-faults/1` file with these faults.
///
/// Zones and hardware that the mission does not have are written with an empty name, which no
/// reader accepts.
///
/// ```
/// use cotama_models::missions::{Mission, embedded, faults::Faults};
/// use cotama_sim::faults_text::faults_text;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let text = faults_text(&mission.run.faults, &mission);
/// assert_eq!(Faults::parse("script", &text, &mission).unwrap(), mission.run.faults);
///
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let text = faults_text(&mission.run.faults, &mission);
/// assert_eq!(Faults::parse("script", &text, &mission).unwrap(), mission.run.faults);
/// ```
pub fn faults_text(faults: &Faults, mission: &Definition) -> String {
    let zone = |index: usize| mission.zones.get(index).map_or("", |zone| zone.id.as_str());
    let mut text = format!("format = \"{FORMAT}\"\n");
    if !faults.power_errors.is_empty() {
        let errors: Vec<_> = faults
            .power_errors
            .iter()
            .map(|error| format!("\"{}\" = {}", zone(error.zone), error.permille))
            .collect();
        text.push_str("power_error_permille = { ");
        text.push_str(&errors.join(", "));
        text.push_str(" }\n");
    }
    for event in &faults.events {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\n[[event]]\nx_mm = {}", event.x.0);
        kind(&mut text, event.kind, mission);
    }
    for incident in &faults.of_robot {
        text.push_str("\n[[event]]\n");
        of_robot(&mut text, incident, mission);
    }
    for random in &faults.random {
        let _ =
            writeln!(text, "\n[[random]]\nname = \"{}\"\nper_km = {}", random.name, random.per_km);
        kind(&mut text, random.kind, mission);
    }
    text
}

/// An incident of a robot that has a file of its own. A number that it does not have is an empty
/// name, which no reader accepts.
fn of_robot(text: &mut String, incident: &robots::Incident, mission: &Definition) {
    let robot = mission.under.as_ref().map(|it| it.file.robot());
    let part = |it: usize| {
        let of = robot.and_then(|robot| robot.sub_objectives.get(it));
        of.map_or("", |it| it.name.as_str())
    };
    let failure = |it: usize| {
        let of = robot.and_then(|robot| robot.failures.get(it));
        of.map_or("", |it| it.id.as_str())
    };
    let moment = |text: &mut String, before: &str, when: robots::Moment| {
        let _ = match when {
            robots::Moment::Place(x) => writeln!(text, "{before}x_mm = {}", x.0),
            robots::Moment::At(time) => writeln!(text, "{before}t_ms = {}", time.0),
            robots::Moment::During(it, after) => {
                let of = part(it);
                writeln!(text, "{before}during = \"{of}\"\n{before}after_ms = {}", after.0)
            }
            robots::Moment::Waiting(after) => {
                writeln!(text, "{before}during = \"Waits\"\n{before}after_ms = {}", after.0)
            }
        };
    };
    moment(text, "", incident.when);
    let _ = match &incident.kind {
        robots::IncidentKind::Failure { failure: it, until } => {
            let _ = writeln!(text, "kind = \"failure\"\nmode = \"{}\"", failure(*it));
            until.iter().for_each(|it| moment(text, "until_", *it));
            Ok(())
        }
        robots::IncidentKind::Repair(it) => {
            writeln!(text, "kind = \"repair\"\nmode = \"{}\"", failure(*it))
        }
        robots::IncidentKind::Door { door, is_open } => {
            let doors = mission.way.as_ref().and_then(|it| it.doors.as_ref().ok());
            let name = doors.and_then(|it| it.get(*door)).map_or("", String::as_str);
            let becomes = if *is_open { "open" } else { "closed" };
            writeln!(text, "kind = \"door\"\ndoor = {name:?}\nbecomes = \"{becomes}\"")
        }
        robots::IncidentKind::Operator { answers, delay } => {
            let name = |it: &robots::Answer| match it {
                robots::Answer::Chooses(it) => part(*it),
                robots::Answer::Done => "done",
                robots::Answer::GivesUp => "give_up",
            };
            let answers: Vec<_> = answers.iter().map(|it| format!("\"{}\"", name(it))).collect();
            let answers = answers.join(", ");
            writeln!(text, "kind = \"operator\"\nanswers = [{answers}]\ndelay_ms = {}", delay.0)
        }
    };
}

fn kind(text: &mut String, kind: EventKind, mission: &Definition) {
    let name = |index: usize| mission.hardware.get(index).map_or("", |it| it.name.as_str());
    let _ = match kind {
        EventKind::Obstacle { delay } => {
            writeln!(text, "kind = \"obstacle\"\ndelay_ms = {}", delay.0)
        }
        EventKind::Odometry { extra } => {
            writeln!(text, "kind = \"odometry\"\nextra_mm = {}", extra.0)
        }
        EventKind::Fault { hardware, units } => {
            writeln!(
                text,
                "kind = \"fault\"\nhardware = \"{}\"\nunits_lost = {units}",
                name(hardware)
            )
        }
        EventKind::Repair { hardware, units } => {
            writeln!(
                text,
                "kind = \"repair\"\nhardware = \"{}\"\nunits_back = {units}",
                name(hardware)
            )
        }
    };
}
