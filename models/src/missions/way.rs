//! The way of a mission over a floor: what the mission asks for by name, and what the floor
//! answers.
//!
//! A mission of [`FORMAT_2`](super::FORMAT_2) may name a floor and say places in place of lengths
//! along its path. [`Asked::of`] reads the names, whoever has the floor plans the [`Way`] between
//! them, and the reader of missions makes lengths of it: all that follows stays on the path.

use super::known::{CLEARANCE_MM, MAX_PERSONS};
use super::under::of_robot;
use cotama_core::units::Millimetres;
use std::ops::Range;
use std::sync::Arc;

/// The names that a mission asks a floor for, in the order of its file.
///
/// ```
/// use cotama_models::missions::Asked;
/// let text = r#"
/// format = "panorama-mission/2"
/// floor = "office"
/// from = "dock"
/// objective = [{ id = "There", does = "drive", to = "lab" }, { id = "Stay", does = "wait" }]
/// zone = [{ id = "corridor" }]
/// "#;
/// let asked = Asked::of(text).unwrap();
/// assert_eq!((asked.floor.as_str(), asked.from.as_str()), ("office", "dock"));
/// assert_eq!((&asked.to[..], &asked.zones[..]), (&["lab".into()][..], &["corridor".into()][..]));
/// assert_eq!(Asked::of(&text.replace("mission/2", "mission/1")), None);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// The floor: a name, or the path of a file.
    pub floor: String,
    /// The place at which the mission starts.
    pub from: String,
    /// The places to which objectives drive.
    pub to: Vec<String>,
    /// Doors that are open, other than the floor says.
    pub open: Vec<String>,
    /// Doors that are closed.
    pub close: Vec<String>,
    /// Zones of the floor that the mission names.
    pub zones: Vec<String>,
    /// The places between which each person walks.
    pub people: Vec<Vec<String>>,
    /// Room that the path keeps beyond the radius of the robot.
    pub clearance: Millimetres,
}

impl Asked {
    /// Reads the names; `None` of a mission that names no floor, as one of another format than
    /// [`FORMAT_2`](super::FORMAT_2). Values that are no names are left out: the reader of missions
    /// reports them.
    pub fn of(text: &str) -> Option<Self> {
        let file = of_robot(text)?;
        let word = |table: &toml::Table, key: &str| Some(table.get(key)?.as_str()?.to_owned());
        let words_of = |table: &toml::Table, key: &str| {
            let all = table.get(key).and_then(|it| it.as_array());
            let all = all.into_iter().flatten();
            all.filter_map(|it| it.as_str().map(str::to_owned)).collect::<Vec<_>>()
        };
        let words = |key: &str| words_of(&file, key);
        let clearance = file.get("clearance_mm").and_then(toml::Value::as_integer);
        let clearance = clearance.filter(|it| CLEARANCE_MM.contains(it)).unwrap_or(0);
        let tables = |key: &str| {
            let all = file.get(key).and_then(|it| it.as_array());
            all.into_iter().flatten().filter_map(|it| it.as_table())
        };
        let of_floor = |it: &&toml::Table| !it.contains_key("x_start_mm");
        Some(Self {
            floor: word(&file, "floor")?,
            from: word(&file, "from").unwrap_or_default(),
            to: tables("objective").filter_map(|it| word(it, "to")).collect(),
            open: words("open"),
            close: words("close"),
            zones: tables("zone")
                .filter(of_floor)
                .filter_map(|it| word(it, "on_floor").or_else(|| word(it, "id")))
                .collect(),
            people: tables("person").take(MAX_PERSONS).map(|it| words_of(it, "walks")).collect(),
            clearance: Millimetres(clearance.unsigned_abs()),
        })
    }
}

/// A refusal of a floor: the cause, and a remedy where there is one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The cause.
    pub message: String,
    /// The remedy, in words.
    pub help: Option<String>,
}

impl Refusal {
    /// A refusal without a remedy yet.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None }
    }

    /// The same refusal with a remedy.
    #[must_use]
    pub fn help(self, help: impl Into<String>) -> Self {
        Self { help: Some(help.into()), ..self }
    }
}

/// A way over a floor, or the reasons why there is none: an answer to each name that is asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Way {
    /// The name of the floor's file, as in messages.
    pub source: String,
    /// The whole text of the file.
    pub text: Arc<str>,
    /// The names that this is the answer to.
    pub asked: Asked,
    /// The problem of the place at which it starts, if there is one.
    pub start: Result<(), Refusal>,
    /// The names of the doors that the floor has; the problem of those that the mission names, if
    /// there is one.
    pub doors: Result<Vec<String>, Refusal>,
    /// The way to each place of [`Asked::to`].
    pub legs: Vec<Result<Leg, NoLeg>>,
    /// The parts of the whole path, in mm, inside each zone of [`Asked::zones`].
    pub zones: Vec<Result<Vec<Range<u64>>, Refusal>>,
    /// The way to each place of each person of [`Asked::people`] from the one before; to the first
    /// one from the last.
    pub people: Vec<Vec<Result<Leg, NoLeg>>>,
}

/// The way from one place to the next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leg {
    /// The corners of the way in mm, from the left lower corner of the floor.
    pub points: Vec<[i32; 2]>,
    /// Length of the way.
    pub length: Millimetres,
}

/// The reason why there is no way from one place to the next.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoLeg {
    /// The place where it starts is refused: at [`Way::start`], or as the goal of a leg before.
    Start,
    /// The floor has no such goal.
    Goal(Refusal),
    /// No way over this floor can be planned.
    Floor(Refusal),
    /// Nothing leads from the start to the goal.
    Path {
        /// The cause.
        message: String,
        /// The doors that are closed, one of which may stand in the way.
        closed: Vec<String>,
    },
}

impl NoLeg {
    /// Returns the refusal that belongs to the goal; `None` where the start has it. `open` is the
    /// key or the option that opens a door.
    ///
    /// ```
    /// use cotama_models::missions::NoLeg;
    /// let none = NoLeg::Path { message: "no way".into(), closed: vec!["door D".into()] };
    /// let help = none.refusal("--open").unwrap().help.unwrap();
    /// assert_eq!(help, "closed are door D: `--open` opens one");
    /// assert_eq!(NoLeg::Start.refusal("open"), None);
    /// ```
    pub fn refusal(&self, open: &str) -> Option<Refusal> {
        match self {
            Self::Start => None,
            Self::Goal(it) | Self::Floor(it) => Some(it.clone()),
            Self::Path { message, closed } if closed.is_empty() => Some(Refusal::new(message)),
            Self::Path { message, closed } => {
                let closed = closed.join(", ");
                let help = format!("closed are {closed}: `{open}` opens one");
                Some(Refusal::new(message).help(help))
            }
        }
    }
}

impl Way {
    /// Returns the corners of the whole way in mm.
    pub fn points(&self) -> Vec<[i32; 2]> {
        let all = self.legs.iter().flatten().flat_map(|it| it.points.iter().copied());
        let mut points: Vec<_> = all.collect();
        points.dedup();
        points
    }

    /// Returns the length of the whole way.
    pub fn length(&self) -> Millimetres {
        Millimetres(self.legs.iter().flatten().map(|it| it.length.0).sum())
    }
}
