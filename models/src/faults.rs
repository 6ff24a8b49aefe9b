//! What may go wrong during a run: the script of a mission file's `[run]`, or of a
//! `panorama-faults/1` file.

use crate::diagnostic::{Diagnostic, MissionErrors};
use crate::mission::{Definition, Hardware, Zone};
use crate::reader::{self, Entry, Fields, Sink, ids};
use cotama_core::hardware::MAX_UNITS;
use cotama_core::units::{Millimetres, Millis};

mod incidents;

pub use incidents::{Answer, Incident, IncidentKind};

/// The format that a file of faults must name.
pub const FORMAT: &str = "panorama-faults/1";

/// The largest length or duration, in mm or ms.
pub(crate) const MAX_QUANTITY: i64 = 1_000_000_000;

/// How a mission is run by a simulator.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// Margins are checked every such period.
    pub monitor_period: Millis,
    /// What goes wrong.
    pub faults: Faults,
}

impl Default for Run {
    fn default() -> Self {
        Self { monitor_period: Millis(1000), faults: Faults::default() }
    }
}

/// What goes wrong during a run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Faults {
    /// By how much the real power differs from the modelled one, by zone.
    pub power_errors: Vec<PowerError>,
    /// What happens at given places, sorted by place.
    pub events: Vec<Event>,
    /// What happens anywhere.
    pub random: Vec<RandomEvent>,
    /// What the supervisors of a supervised mission have to deal with, sorted by place; in files
    /// these are events of the kinds `failure`, `repair` and `operator`. A plan, and a run without
    /// supervisors, knows nothing of them.
    pub incidents: Vec<Incident>,
}

/// By how much the real power differs from the modelled one inside a zone, whatever the robot does
/// there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PowerError {
    /// The index of the zone.
    pub zone: usize,
    /// The difference, in parts per thousand of the modelled power.
    pub permille: i32,
}

/// Something that happens once, at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// Where, by the path.
    pub x: Millimetres,
    /// What.
    pub kind: EventKind,
}

/// What happens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EventKind {
    /// Something stands in the way; time is lost, at the power of the current alternative.
    Obstacle {
        /// The time lost.
        delay: Millis,
    },
    /// Hardware fails.
    Fault {
        /// The index of the hardware.
        hardware: usize,
        /// How many units are lost.
        units: u8,
    },
    /// Hardware works again.
    Repair {
        /// The index of the hardware.
        hardware: usize,
        /// How many units are back.
        units: u8,
    },
    /// The position was wrong: so much more path to drive before going on at the same place.
    Odometry {
        /// The additional path.
        extra: Millimetres,
    },
}

/// Something that happens at random places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomEvent {
    /// Its name, which also names its stream of random numbers.
    pub name: String,
    /// The number expected on 1000 m of path.
    pub per_km: u16,
    /// What happens: an obstacle or a wrong odometry.
    pub kind: EventKind,
}

impl Faults {
    /// Reads a file of faults for a mission. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// # use cotama_models::{embedded, faults::Faults, mission::Mission};
    /// # let patrol = embedded::mission("patrol").unwrap();
    /// # let mission = Mission::parse(patrol.name, patrol.text).unwrap();
    /// let text = "format = \"panorama-faults/1\"\nevent = [{ x_mm = 5, kind = \"obstacl\", delay_ms = 9 }]";
    /// let errors = Faults::parse("faults.toml", text, &mission).unwrap_err();
    /// let first = "faults.toml:2:29: unknown event `obstacl`; did you mean `obstacle`?";
    /// assert_eq!(errors.to_string().lines().next(), Some(first));
    /// ```
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
        let (path_length, supervised) =
            (Some(mission.path_length), Some(mission.supervision.is_some()));
        let names = Names { path_length, zones: &zones, hardware: &hardware, supervised };
        let faults = reader::document(text, &sink, FORMAT, |mut root| {
            let faults = read(&mut root, &names);
            root.finish();
            faults
        });
        match faults {
            Some(faults) if sink.is_empty() => Ok(faults),
            _ => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

/// What faults refer to, as far as it could be read.
pub(crate) struct Names<'n> {
    pub(crate) path_length: Option<Millimetres>,
    pub(crate) zones: &'n [Entry<Zone>],
    pub(crate) hardware: &'n [Entry<Hardware>],
    /// Whether the mission is supervised; `None` when that could not be read.
    pub(crate) supervised: Option<bool>,
}

/// Reads `[run]`; its absence is a run in which nothing goes wrong.
pub(crate) fn read_run(run: Option<Fields<'_>>, names: &Names<'_>) -> Option<Run> {
    let Some(mut run) = run else { return Some(Run::default()) };
    let period = run.optional_integer("monitor_period_ms", 1..=3_600_000);
    let faults = read(&mut run, names);
    run.finish();
    let monitor_period = period.ok()?.map_or(Run::default().monitor_period, Millis);
    Some(Run { monitor_period, faults: faults? })
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
    let (mut events, mut incidents) = (Vec::new(), Vec::new());
    for happening in events_read?? {
        match happening {
            Scripted::Event(event) => events.push(event),
            Scripted::Incident(incident) => incidents.push(incident),
        }
    }
    events.sort_by_key(|event| event.x);
    incidents.sort_by_key(|incident| incident.x);
    Some(Faults { power_errors: power_errors?, events, random: random??, incidents })
}

fn power_errors(fields: &mut Fields<'_>, names: &Names<'_>) -> Option<Vec<PowerError>> {
    let Some(table) = fields.optional_table("power_error_permille").ok()? else {
        return Some(Vec::new());
    };
    let errors = table.named_integers::<i32>(&(-999..=10_000))?;
    let errors = errors.into_iter().map(|(zone, permille)| {
        let zone = fields.index_of(&zone, "zone", ids(names.zones))?;
        Some(PowerError { zone, permille })
    });
    let errors: Vec<_> = errors.collect();
    errors.into_iter().collect()
}

fn delay(fields: &mut Fields<'_>) -> Option<EventKind> {
    Some(EventKind::Obstacle { delay: Millis(fields.integer("delay_ms", 1..=MAX_QUANTITY)?) })
}

fn extra(fields: &mut Fields<'_>) -> Option<EventKind> {
    Some(EventKind::Odometry { extra: Millimetres(fields.integer("extra_mm", 1..=MAX_QUANTITY)?) })
}

/// The hardware of a fault or repair, and how many units of it.
fn units(fields: &mut Fields<'_>, key: &'static str, names: &Names<'_>) -> Option<(usize, u8)> {
    let hardware = fields.text("hardware");
    let units = fields.integer(key, 1..=i64::from(MAX_UNITS));
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
    Incident(Incident),
}

fn event(mut fields: Fields<'_>, names: &Names<'_>) -> Option<Scripted> {
    let x = fields.integer("x_mm", 0..=MAX_QUANTITY).map(Millimetres);
    let kinds = [&["obstacle", "fault", "repair", "odometry"], &incidents::KINDS[..]].concat();
    let Some(kind) = fields.choice("kind", "event", &kinds) else {
        fields.abandon();
        return None;
    };
    if incidents::is_incident(&fields, kind) {
        let found = incidents::incident(&mut fields, kind, names);
        on_the_path(&fields, x, names);
        fields.finish();
        return Some(Scripted::Incident(Incident { x: x?, kind: found? }));
    }
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
    on_the_path(&fields, x, names);
    fields.finish();
    Some(Scripted::Event(Event { x: x?, kind: kind? }))
}

fn on_the_path(fields: &Fields<'_>, x: Option<Millimetres>, names: &Names<'_>) {
    if let (Some(x), Some(end)) = (x, names.path_length)
        && x > end
    {
        let message = format!("the event at {x} lies behind the end of the path, {end}");
        let help = format!("place it between 0 and {}", end.0);
        fields
            .report(Diagnostic::new(fields.span_of("x_mm"), message, "not on the path").help(help));
    }
}

fn random_event(mut fields: Fields<'_>, seen: &mut Vec<String>) -> Option<RandomEvent> {
    let name = fields.id("name");
    let per_km = fields.integer("per_km", 1..=1000);
    let Some(kind) = fields.choice("kind", "random event", &["obstacle", "odometry"]) else {
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
