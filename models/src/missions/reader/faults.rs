//! Reading what may go wrong: `[run]` of a mission file, or a `panorama-faults/1` file.

use super::entry::{Entry, Names, ids};
use super::fields::{self, Fields, Sink};
use super::moments::on_the_path;
use super::recorded;
use super::under;
use crate::missions::definition::{Definition, Hardware, Zone};
use crate::missions::diagnostic::{Diagnostic, MissionErrors};
use crate::missions::faults::{
    Event, EventKind, FORMAT, Faults, FaultsFile, PowerError, RandomEvent, Run,
};
use crate::missions::known::{
    AT_LEAST_ZERO, EVENTS, PER_KM, PERIODS, POSITIVE, POWER_ERRORS, RANDOM_EVENTS, UNITS,
};
use crate::robots;
use cotama_core::units::{Millimetres, Millis};

impl Faults {
    /// Reads the faults of a file for a mission; what else it notes, [`FaultsFile::parse`] reads.
    /// `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// # use cotama_models::missions::{Mission, embedded, faults::Faults};
    /// # let patrol = embedded::mission("patrol").unwrap();
    /// # let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    /// let text = "format = 'panorama-faults/1'
    /// event = [{ x_mm = 5, kind = 'obstacl', delay_ms = 9 }]";
    /// let errors = Faults::parse("faults.toml", text, &mission).unwrap_err();
    /// let first = "faults.toml:2:29: unknown event `obstacl`; did you mean `obstacle`?";
    /// assert_eq!(errors.to_string().lines().next(), Some(first));
    /// ```
    pub fn parse(
        source_name: &str,
        text: &str,
        mission: &Definition,
    ) -> Result<Self, MissionErrors> {
        FaultsFile::parse(source_name, text, mission).map(|it| it.faults)
    }
}

impl FaultsFile {
    /// The mission that a file names, without which nothing else of it can be read.
    pub fn mission_of(text: &str) -> Option<String> {
        Self::named(text, "mission")
    }

    /// The robot that a file names for a mission that names none.
    pub fn robot_of(text: &str) -> Option<String> {
        Self::named(text, "robot")
    }

    fn named(text: &str, key: &str) -> Option<String> {
        let file: toml::Table = text.parse().ok()?;
        Some(file.get("expected")?.get(key)?.as_str()?.to_owned())
    }

    /// Reads a file of faults for a mission, with all that it says.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    pub fn parse(
        source_name: &str,
        text: &str,
        mission: &Definition,
    ) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let zone = |it: &Zone| Entry { id: it.id.clone(), item: Some(it.clone()) };
        let zones: Vec<_> = mission.zones.iter().map(zone).collect();
        let kind = |it: &Hardware| Entry { id: it.name.clone(), item: Some(it.clone()) };
        let hardware: Vec<_> = mission.hardware.iter().map(kind).collect();
        let robot = mission.under.as_ref().map(|it| it.file.robot());
        let path_length = Some(mission.path_length);
        let doors = mission.way.as_ref().and_then(|it| it.doors.as_deref().ok());
        let names = Names { path_length, zones: &zones, hardware: &hardware, robot, doors };
        let file = fields::document(text, &sink, FORMAT, |mut root| {
            let faults = read(&mut root, &names);
            let planner = root.optional_table("planner").map(|it| it.map(recorded::planner));
            let expected = root.optional_table("expected").map(|it| it.map(recorded::expected));
            root.finish();
            // Tables that cannot be read were reported.
            let (planner, expected) = (planner.ok()?.flatten(), expected.ok()?.flatten());
            Some(Self { faults: faults?, planner, expected })
        });
        match file {
            Some(file) if sink.is_empty() => Ok(file),
            _ => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

/// Reads `[run]`; its absence is a run in which nothing goes wrong.
pub(super) fn run(run: Option<Fields<'_>>, names: &Names<'_>) -> Option<Run> {
    let Some(mut run) = run else { return Some(Run::default()) };
    let period = run.optional_integer("monitor_period_ms", PERIODS);
    let seed = run.optional_integer::<u64>("seed", AT_LEAST_ZERO);
    let margins = run.optional_text("margins");
    let faults = read(&mut run, names);
    run.finish();
    let monitor_period = period.ok()?.map_or(Run::default().monitor_period, Millis);
    let margins = margins.ok()?.map(|it| it.value);
    Some(Run { monitor_period, seed: seed.ok()?.unwrap_or(0), margins, faults: faults? })
}

fn read(fields: &mut Fields<'_>, names: &Names<'_>) -> Option<Faults> {
    let power_errors = power_errors(fields, names);
    let events_read = fields.tables("event", false).map(|tables| {
        let events: Vec<_> = tables.into_iter().map(|table| event(table, names)).collect();
        events.into_iter().collect::<Option<Vec<_>>>()
    });
    let random = fields.tables("random", false).map(|tables| {
        let mut seen = Vec::new();
        let random: Vec<_> =
            tables.into_iter().map(|table| random_event(table, &mut seen)).collect();
        random.into_iter().collect::<Option<Vec<_>>>()
    });
    let (mut events, mut of_robot) = (Vec::new(), Vec::new());
    for happening in events_read?? {
        match happening {
            Scripted::Event(event) => events.push(event),
            Scripted::OfRobot(incident) => of_robot.push(incident),
        }
    }
    events.sort_by_key(|event| event.x);
    of_robot.sort_by_key(|incident| incident.when);
    Some(Faults { power_errors: power_errors?, events, random: random??, of_robot })
}

fn power_errors(fields: &mut Fields<'_>, names: &Names<'_>) -> Option<Vec<PowerError>> {
    let Some(table) = fields.optional_table("power_error_permille").ok()? else {
        return Some(Vec::new());
    };
    let errors = table.named_integers::<i32>(&POWER_ERRORS)?;
    let errors = errors.into_iter().map(|(zone, permille)| {
        let zone = fields.index_of(&zone, "zone", ids(names.zones))?;
        Some(PowerError { zone, permille })
    });
    let errors: Vec<_> = errors.collect();
    errors.into_iter().collect()
}

fn delay(fields: &mut Fields<'_>) -> Option<EventKind> {
    Some(EventKind::Obstacle { delay: Millis(fields.integer("delay_ms", POSITIVE)?) })
}

fn extra(fields: &mut Fields<'_>) -> Option<EventKind> {
    Some(EventKind::Odometry { extra: Millimetres(fields.integer("extra_mm", POSITIVE)?) })
}

/// The hardware of a fault or repair, and how many units of it.
fn units(fields: &mut Fields<'_>, key: &'static str, names: &Names<'_>) -> Option<(usize, u8)> {
    let hardware = fields.text("hardware");
    let units = fields.integer(key, UNITS);
    let hardware = fields.index_of(&hardware?, "hardware", ids(names.hardware))?;
    let units: u8 = units?;
    let kind = names.hardware.get(hardware)?.item.as_ref()?;
    if units > kind.units {
        let message =
            format!("`{key}` is {units}, but the robot has only {} of `{}`", kind.units, kind.name);
        let help = format!("write {} or less", kind.units);
        fields.report(
            Diagnostic::new(fields.span_of(key), message, "more than there are").help(help),
        );
        return None;
    }
    Some((hardware, units))
}

/// An entry of a script.
enum Scripted {
    Event(Event),
    OfRobot(robots::Incident),
}

/// How a mission gets supervisors.
pub(super) const TO_A_ROBOT: &str =
    "leave it out, or write `format = \"panorama-mission/2\"` and name a `robot`";

fn event(mut fields: Fields<'_>, names: &Names<'_>) -> Option<Scripted> {
    if let Some(robot) = names.robot
        && under::is_incident(&fields)
    {
        return under::incident(fields, robot, names).map(Scripted::OfRobot);
    }
    if names.robot.is_none() && under::is_incident(&fields) {
        let message = "this event is for missions under the supervisors of a robot";
        let it = Diagnostic::new(fields.whole(), message, "no supervisors");
        fields.report(it.help(TO_A_ROBOT));
        fields.abandon();
        return None;
    }
    let x = place(&mut fields);
    let Some(kind) = fields.choice("kind", "event", &EVENTS) else {
        fields.abandon();
        return None;
    };
    let kind = match kind {
        "obstacle" => delay(&mut fields),
        "odometry" => extra(&mut fields),
        "fault" => {
            let lost = units(&mut fields, "units_lost", names);
            lost.map(|(hardware, units)| EventKind::Fault { hardware, units })
        }
        _ => {
            let back = units(&mut fields, "units_back", names);
            back.map(|(hardware, units)| EventKind::Repair { hardware, units })
        }
    };
    on_the_path(&fields, "x_mm", x, names);
    fields.finish();
    Some(Scripted::Event(Event { x: x?, kind: kind? }))
}

fn place(fields: &mut Fields<'_>) -> Option<Millimetres> {
    fields.integer("x_mm", AT_LEAST_ZERO).map(Millimetres)
}

fn random_event(mut fields: Fields<'_>, seen: &mut Vec<String>) -> Option<RandomEvent> {
    let name = fields.id("name");
    let per_km = fields.integer("per_km", PER_KM);
    let Some(kind) = fields.choice("kind", "random event", &RANDOM_EVENTS) else {
        fields.abandon();
        return None;
    };
    let kind = if kind == "obstacle" { delay(&mut fields) } else { extra(&mut fields) };
    if let Some(name) = &name {
        if seen.contains(&name.value) {
            let message = format!("the random event `{}` is defined twice", name.value);
            fields.report(
                Diagnostic::new(name.span.clone(), message, "again").help("rename one of them"),
            );
        }
        seen.push(name.value.clone());
    }
    fields.finish();
    Some(RandomEvent { name: name?.value, per_km: per_km?, kind: kind? })
}
