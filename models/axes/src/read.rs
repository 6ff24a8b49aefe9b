//! Reading a mission with axes: once, at the border; what is read needs no further check. All that
//! is wrong is said at once.

mod judged;
mod keys;
mod over;
mod parts;
mod run;

use crate::course::Course;
use crate::fields::{Faults, Fields, LARGEST, integer, wrong_type};
use crate::mission::{Ask, Attributes, DetectBy, Hardware, Mission};
use crate::speeds::Speeds;
use crate::tree::{Fault, Node, Value, Wrongs};
use crate::{json, toml_text};

pub use keys::Keys;
pub use over::Ground;

/// The format of a mission with axes in TOML.
pub const FORMAT: &str = "cotama-axes/1";
/// The format of a case in JSON: a mission, what is asked, and what is not read here.
pub const CASE_FORMAT: &str = "axes-case/1";
/// The most bytes of a file.
pub const MAX_BYTES: usize = 4 << 20;
/// The robot knows at most so many speeds.
const MAX_SPEEDS: i64 = 1_000;
/// The key of the speeds of a robot that knows a few only.
const LEVELS: &str = "speed_levels_mm_s";
/// Keys of the speeds of a robot that knows all multiples of one.
const STEP: &str = "speed_step_mm_s";
const MOST: &str = "speed_max_mm_s";
const MAX_LEVELS: usize = 64;
/// A robot is no faster, in mm/s.
const FASTEST: i64 = 100_000;
const MAX_HARDWARE: usize = 32;
const MAX_OPTIONS: usize = 64;
const MAX_OBJECTIVES: usize = 128;
const MAX_ZONES: usize = 64;
const MAX_AXES: usize = 16;
const MAX_CONSTRAINTS: usize = 24;

/// A mission and what is asked of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// The mission.
    pub mission: Mission,
    /// Wishes; the first counts most.
    pub ask: Vec<Ask>,
    /// Events on the way, and the return that is asked for.
    pub course: Course,
}

impl Case {
    /// Reads a mission with axes, in TOML or JSON.
    ///
    /// # Errors
    /// All that is wrong, with places, in the order of the file. A text that is no TOML or no JSON
    /// is looked at no further.
    pub fn parse(text: &str) -> Result<Self, Wrongs> {
        let faults = Faults::default();
        let case = read(text, &faults);
        located(case, faults, text)
    }
}

/// Returns what was read, or all that is wrong; places become lines and columns.
fn located(case: Option<Case>, faults: Faults, text: &str) -> Result<Case, Wrongs> {
    let (all, omitted) = faults.into_sorted();
    let Some(mut case) = case.filter(|_| all.is_empty()) else {
        debug_assert!(!all.is_empty());
        let all = all.into_iter().map(|it| it.in_text(text)).collect();
        return Err(Wrongs { all, omitted });
    };
    for it in &mut case.mission.indicators {
        it.travel.iter_mut().chain(&mut it.stand).for_each(|it| it.locate(text));
    }
    Ok(case)
}

/// Reads a file; where there are faults, the case is as if they were not.
fn read(text: &str, faults: &Faults) -> Option<Case> {
    if text.len() > MAX_BYTES {
        faults.say(0, format!("the file has more than {MAX_BYTES} bytes"));
        return None;
    }
    let root = if text.trim_start().starts_with('{') {
        json::parse(text).map_err(|it| faults.add(it)).ok()?
    } else {
        toml_text::parse(text, faults)?
    };
    let mut fields = Fields::of(&root, "the file", faults);
    let (at, format) = fields.text("format")?;
    match format {
        CASE_FORMAT => {
            let name = fields.name("id").1;
            let mut inner = Fields::of(fields.required("mission")?, "the mission", faults);
            let mut reader = Reader::new(&name, false, faults);
            reader.mission(&mut inner);
            inner.finish();
            Some(reader.ask(&mut fields))
        }
        FORMAT => {
            let name = fields.name("name").1;
            let mut reader = Reader::new(&name, true, faults);
            let length = reader.mission(&mut fields);
            let course = reader.run(fields.optional("run"), length);
            let case = reader.ask(&mut fields);
            fields.finish();
            Some(Case { course, ..case })
        }
        _ => {
            let help = format!("there are: {FORMAT}, {CASE_FORMAT}");
            faults.add(Fault::new(at, "unknown format").help(help));
            None
        }
    }
}

/// A mission while it is read.
struct Reader<'n, 'f> {
    mission: Mission,
    /// Keys of each owner of attributes, with their places.
    seen: Vec<(Keys, Vec<(&'n str, usize)>)>,
    /// Whether what has no effect is a fault; in cases a missing key counts as zero.
    is_strict: bool,
    faults: &'f Faults,
}

impl<'n, 'f> Reader<'n, 'f> {
    fn new(name: &str, is_strict: bool, faults: &'f Faults) -> Self {
        let mission = Mission::empty(name);
        Self { mission, seen: Vec::new(), is_strict, faults }
    }

    /// Reads the mission; returns the length of its path.
    fn mission(&mut self, fields: &mut Fields<'n, 'f>) -> i64 {
        // Where the length is not known, no place is beyond it.
        let length = fields.integer("path_length_mm", 0, LARGEST).unwrap_or(LARGEST);
        match fields.required("robot") {
            Some(node) => self.robot(node),
            // An empty name stands for all that could not be read.
            None => self.mission.robot = Attributes(vec![(String::new(), 0)]),
        }
        self.laptop(fields);
        if let Some(node) = fields.required("motion_power") {
            let mut power = Fields::of(node, "`motion_power`", self.faults);
            self.mission.motion_power =
                ["c0", "c1", "c2"].map(|key| power.integer(key, 0, 1_000_000_000).unwrap_or(0));
            power.finish();
        }
        if let Some(node) = fields.required("detection") {
            self.detection(node);
        }
        for entry in fields.named("hardware", MAX_HARDWARE) {
            let what = format!("the hardware `{}`", entry.key);
            let mut own = Fields::of(&entry.node, &what, self.faults);
            let units = own.integer("units", 1, 255).unwrap_or(1);
            self.seen.push((Keys::Hardware, own.left()));
            let (id, attributes) = (entry.key.clone(), own.attributes());
            self.mission.hardware.push(Hardware { id, units, attributes });
        }
        fields.list("tio", MAX_OPTIONS).iter().for_each(|it| self.tio(it));
        let objectives = fields.list("objective", MAX_OBJECTIVES);
        objectives.iter().for_each(|it| self.objective(it, length));
        if objectives.is_empty() {
            self.faults.say(fields.place(), "`objective` is missing: nothing is to be done");
        }
        fields.list("zone", MAX_ZONES).iter().for_each(|it| self.zone(it, length));
        self.axes(fields.list("axis", MAX_AXES));
        if self.is_strict && self.faults.is_empty() {
            self.misspelt();
        }
        fields.list("constraint", MAX_CONSTRAINTS).iter().for_each(|it| self.constraint(it));
        length
    }

    /// Reads the robot; its step and its most stay attributes, too: a formula may read them.
    fn laptop(&mut self, fields: &mut Fields<'n, 'f>) {
        let Some(node) = fields.optional("laptop") else { return };
        let laptop = Fields::of(node, "`laptop`", self.faults);
        self.seen.push((Keys::Laptop, laptop.left()));
        self.mission.laptop = laptop.attributes();
    }

    fn detection(&mut self, node: &Node) {
        let mut detection = Fields::of(node, "`detection`", self.faults);
        let word = detection.word("detect_by", "way to detect", &["zone", "option"]);
        if word.is_some_and(|it| it.1 == 0) {
            self.mission.detect_by = DetectBy::Zone;
        }
        detection.finish();
    }

    fn robot(&mut self, node: &'n Node) {
        let mut robot = Fields::of(node, "`robot`", self.faults);
        let speeds = self.speeds(&mut robot);
        self.seen.push((Keys::Robot, robot.left()));
        let Attributes(mut all) = robot.attributes();
        if let Some(Speeds::Step { step_mm_s, most_mm_s }) = speeds {
            all.push((STEP.into(), step_mm_s));
            all.push((MOST.into(), most_mm_s));
        }
        self.mission.robot = Attributes(all);
        self.mission.speeds = speeds.unwrap_or(Speeds::Levels(Vec::new()));
    }

    fn speeds(&self, robot: &mut Fields<'_, '_>) -> Option<Speeds> {
        let Some(list) = robot.optional(LEVELS) else {
            // Both are taken before one is missed: the other is not meant for it.
            let (step, most) = (robot.optional(STEP), robot.optional(MOST));
            let step = step.or_else(|| robot.required(STEP));
            let most = most.or_else(|| robot.required(MOST));
            let step_mm_s = step.and_then(|it| integer(it, STEP, 1, FASTEST, self.faults));
            let least = step_mm_s.unwrap_or(1);
            let highest = step_mm_s.map_or(FASTEST, |it| (MAX_SPEEDS * it).min(FASTEST));
            let most_mm_s = most.and_then(|it| integer(it, MOST, least, highest, self.faults));
            return Some(Speeds::Step { step_mm_s: step_mm_s?, most_mm_s: most_mm_s? });
        };
        if let Some(it) = robot.optional(STEP) {
            let message = format!("`{STEP}` and `{LEVELS}` exclude each other");
            self.faults.add(Fault::new(it.at, message).help("leave one of them out"));
        }
        let most = robot.integer(MOST, 1, FASTEST).unwrap_or(FASTEST);
        let Value::List(items) = &list.value else {
            self.faults.add(wrong_type(list, LEVELS, "a list"));
            return None;
        };
        if items.is_empty() || items.len() > MAX_LEVELS {
            let message = format!("`{LEVELS}` has 1 to {MAX_LEVELS} speeds, not {}", items.len());
            self.faults.say(list.at, message);
            return None;
        }
        let mut levels: Vec<i64> = Vec::new();
        for item in items {
            let level = integer(item, LEVELS, 1, FASTEST, self.faults)?;
            if levels.last().is_some_and(|it| *it >= level) {
                self.faults.say(item.at, format!("`{LEVELS}` must rise, and {level} does not"));
            }
            levels.push(level);
        }
        levels.retain(|it| *it <= most);
        if levels.is_empty() {
            let message = format!("all of `{LEVELS}` are above `{MOST}`, {most}");
            self.faults.say(list.at, message);
        }
        Some(Speeds::Levels(levels))
    }
}
