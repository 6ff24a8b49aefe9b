//! Reading a mission with axes: once, at the border; what is read needs no further check.

use crate::fields::{Fields, LARGEST, distinct, index_of, integer, text, wrong_type};
use crate::formula::{Formula, Inducer};
use crate::mission::{
    Ask, Attributes, Axis, Constraint, DetectBy, Hardware, Indicator, Kind, Mission, Objective,
    Relation, Sense, Tio, Zone,
};
use crate::speeds::Speeds;
use crate::tree::{Fault, Node, Value, Wrong};
use crate::{json, toml_text};

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
const MAX_LEVELS: usize = 64;
/// A robot is no faster, in mm/s.
const FASTEST: i64 = 100_000;
const MAX_HARDWARE: usize = 32;
const MAX_OPTIONS: usize = 64;
const MAX_OBJECTIVES: usize = 128;
const MAX_TASKS: usize = 4;
const MAX_ZONES: usize = 64;
const MAX_AXES: usize = 16;
const MAX_INDICATORS: usize = 32;
const MAX_CONSTRAINTS: usize = 24;

/// A mission and what is asked of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// The mission.
    pub mission: Mission,
    /// Wishes; the first counts most.
    pub ask: Vec<Ask>,
}

impl Case {
    /// Reads a mission with axes, in TOML or JSON.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place.
    pub fn parse(text: &str) -> Result<Self, Wrong> {
        let read = || {
            if text.len() > MAX_BYTES {
                return Err(Fault::new(0, format!("the file has more than {MAX_BYTES} bytes")));
            }
            let is_json = text.trim_start().starts_with('{');
            let root = if is_json { json::parse(text) } else { toml_text::parse(text) }?;
            case(&root)
        };
        let mut case = read().map_err(|it| it.in_text(text))?;
        for it in &mut case.mission.indicators {
            it.travel.iter_mut().chain(&mut it.stand).for_each(|it| it.locate(text));
        }
        Ok(case)
    }
}

fn case(root: &Node) -> Result<Case, Fault> {
    let mut fields = Fields::of(root, "the file")?;
    let (at, format) = fields.text("format")?;
    let (mission, mut fields) = match format {
        CASE_FORMAT => {
            let name = fields.name("id")?.1;
            let mut inner = Fields::of(fields.required("mission")?, "the mission")?;
            let read = mission(&mut inner, name)?;
            inner.finish()?;
            (read, fields)
        }
        FORMAT => {
            let name = fields.name("name")?.1;
            (mission(&mut fields, name)?, fields)
        }
        _ => {
            let message = format!("unknown format; there are: {FORMAT}, {CASE_FORMAT}");
            return Err(Fault::new(at, message));
        }
    };
    let ask = asked(&mut fields, &mission)?;
    if format == FORMAT {
        fields.finish()?;
    }
    Ok(Case { mission, ask })
}

fn asked(fields: &mut Fields<'_>, mission: &Mission) -> Result<Vec<Ask>, Fault> {
    let node = fields.required("ask")?;
    let Value::List(items) = &node.value else { return Err(wrong_type(node, "ask", "a list")) };
    let form = "`ask` is a list of wishes as `[\"min\", \"energy.RC\"]`, the first counts most";
    if items.is_empty() || items.len() > MAX_INDICATORS {
        return Err(Fault::new(node.at, form));
    }
    let mut wishes: Vec<Ask> = Vec::new();
    for item in items {
        let Value::List(pair) = &item.value else { return Err(Fault::new(item.at, form)) };
        let [sense, indicator] = &pair[..] else { return Err(Fault::new(item.at, form)) };
        let (at, word) = text(sense, "ask")?;
        let sense = match index_of(at, "sense", word, ["min", "max"].into_iter())? {
            0 => Sense::Min,
            _ => Sense::Max,
        };
        let (at, word) = text(indicator, "ask")?;
        let indicator = indicator_of(at, word, mission)?;
        if !mission.indicators.get(indicator).is_some_and(|it| it.adds_up) {
            let message = format!("`{word}` does not add up over the mission: ask for a sum");
            return Err(Fault::new(at, message));
        }
        if wishes.iter().any(|it| it.indicator == indicator) {
            return Err(Fault::new(at, format!("`{word}` is asked for twice")));
        }
        wishes.push(Ask { sense, indicator });
    }
    Ok(wishes)
}

fn indicator_of(at: usize, name: &str, mission: &Mission) -> Result<usize, Fault> {
    index_of(at, "indicator", name, mission.indicators.iter().map(|it| it.id.as_str()))
}

fn mission(fields: &mut Fields<'_>, name: &str) -> Result<Mission, Fault> {
    let length = fields.integer("path_length_mm", 0, LARGEST)?;
    let node = fields.required("robot")?;
    let speeds = speeds(node)?;
    let mut robot = Fields::of(node, "`robot`")?;
    robot.optional(LEVELS);
    let robot = robot.attributes()?;
    let laptop = match fields.optional("laptop") {
        Some(node) => Fields::of(node, "`laptop`")?.attributes()?,
        None => Attributes::default(),
    };
    let mut power = Fields::of(fields.required("motion_power")?, "`motion_power`")?;
    let mut coefficient = |key| power.integer(key, 0, 1_000_000_000);
    let motion_power = [coefficient("c0")?, coefficient("c1")?, coefficient("c2")?];
    power.finish()?;
    let mut detection = Fields::of(fields.required("detection")?, "`detection`")?;
    let (at, word) = detection.text("detect_by")?;
    let detect_by = match index_of(at, "way to detect", word, ["zone", "option"].into_iter())? {
        0 => DetectBy::Zone,
        _ => DetectBy::Option,
    };
    detection.finish()?;
    let mut mission = Mission {
        name: name.to_owned(),
        robot,
        speeds,
        laptop,
        motion_power,
        detect_by,
        hardware: Vec::new(),
        options: Vec::new(),
        objectives: Vec::new(),
        zones: Vec::new(),
        axes: Vec::new(),
        indicators: Vec::new(),
        constraints: Vec::new(),
    };
    for entry in fields.named("hardware", MAX_HARDWARE)? {
        let mut own = Fields::of(&entry.node, &format!("the hardware `{}`", entry.key))?;
        let units = own.integer("units", 1, 255)?;
        let id = entry.key.clone();
        mission.hardware.push(Hardware { id, units, attributes: own.attributes()? });
    }
    for node in fields.list("tio", MAX_OPTIONS)? {
        let it = tio(node, &mission)?;
        mission.options.push(it);
    }
    for node in fields.list("objective", MAX_OBJECTIVES)? {
        let it = objective(node, &mission, length)?;
        mission.objectives.push(it);
    }
    if mission.objectives.is_empty() {
        return Err(Fault::new(fields.place(), "`objective` is missing: nothing is to be done"));
    }
    for node in fields.list("zone", MAX_ZONES)? {
        let it = zone(node, &mission, length)?;
        mission.zones.push(it);
    }
    for node in fields.list("axis", MAX_AXES)? {
        axis(node, &mut mission)?;
    }
    for node in fields.list("constraint", MAX_CONSTRAINTS)? {
        let it = constraint(node, &mission)?;
        mission.constraints.push(it);
    }
    Ok(mission)
}

/// The speeds of a robot; its step and its most stay attributes, too: a formula may read them.
fn speeds(node: &Node) -> Result<Speeds, Fault> {
    let mut robot = Fields::of(node, "`robot`")?;
    let Some(list) = robot.optional(LEVELS) else {
        let step_mm_s = robot.integer("speed_step_mm_s", 1, FASTEST)?;
        let most = (MAX_SPEEDS * step_mm_s).min(FASTEST);
        let most_mm_s = robot.integer("speed_max_mm_s", step_mm_s, most)?;
        return Ok(Speeds::Step { step_mm_s, most_mm_s });
    };
    if let Some(it) = robot.optional("speed_step_mm_s") {
        let message = format!("`speed_step_mm_s` and `{LEVELS}` exclude each other");
        return Err(Fault::new(it.at, message));
    }
    let most = robot.integer("speed_max_mm_s", 1, FASTEST)?;
    let Value::List(items) = &list.value else { return Err(wrong_type(list, LEVELS, "a list")) };
    let mut levels = Vec::new();
    for item in items.iter().take(MAX_LEVELS + 1) {
        let level = integer(item, LEVELS, 1, FASTEST)?;
        if levels.last().is_some_and(|it| *it >= level) {
            let message = format!("`{LEVELS}` must rise, and {level} does not");
            return Err(Fault::new(item.at, message));
        }
        levels.push(level);
    }
    if levels.is_empty() || levels.len() > MAX_LEVELS {
        let message = format!("`{LEVELS}` has 1 to {MAX_LEVELS} speeds, not {}", items.len());
        return Err(Fault::new(list.at, message));
    }
    levels.retain(|it| *it <= most);
    if levels.is_empty() {
        let message = format!("all of `{LEVELS}` are above `speed_max_mm_s`, {most}");
        return Err(Fault::new(list.at, message));
    }
    Ok(Speeds::Levels(levels))
}

fn hardware_of(at: usize, name: &str, mission: &Mission) -> Result<usize, Fault> {
    index_of(at, "hardware", name, mission.hardware.iter().map(|it| it.id.as_str()))
}

fn tio(node: &Node, mission: &Mission) -> Result<Tio, Fault> {
    let mut own = Fields::of(node, "a `tio`")?;
    let (at, id) = own.name("id")?;
    distinct(at, "option", id, mission.options.iter().map(|it| it.id.as_str()))?;
    let task = own.name("task")?.1;
    if let Some(software) = own.optional("software") {
        text(software, "software")?;
    }
    let mut needs = vec![0; mission.hardware.len()];
    for entry in own.named("needs", MAX_HARDWARE)? {
        let kind = hardware_of(entry.key_at, &entry.key, mission)?;
        let units = mission.hardware.get(kind).map_or(0, |it| it.units);
        if let Some(need) = needs.get_mut(kind) {
            *need = integer(&entry.node, &entry.key, 1, units)?;
        }
    }
    Ok(Tio { id: id.to_owned(), task: task.to_owned(), needs, attributes: own.attributes()? })
}

fn objective(node: &Node, mission: &Mission, length: i64) -> Result<Objective, Fault> {
    let mut own = Fields::of(node, "an `objective`")?;
    let (at, id) = own.name("id")?;
    distinct(at, "objective", id, mission.objectives.iter().map(|it| it.id.as_str()))?;
    let x_start_mm = own.integer("x_start_mm", 0, length)?;
    let x_end_mm = own.integer("x_end_mm", x_start_mm, length)?;
    let mut tasks = Vec::new();
    let mut names = Vec::new();
    let mut leads = false;
    for node in own.list("tasks", MAX_TASKS)? {
        let (at, task) = text(node, "tasks")?;
        distinct(at, "task of the objective", task, names.iter().copied())?;
        names.push(task);
        let options = mission.options.iter().enumerate().filter(|it| it.1.task == task);
        let options: Vec<_> = options.map(|it| it.0).collect();
        let Some(first) = options.first().and_then(|&it| mission.options.get(it)) else {
            return Err(Fault::new(at, format!("no option implements the task `{task}`")));
        };
        leads |= first.leads();
        tasks.push(options);
    }
    own.finish()?;
    if !leads {
        let message = "`tasks` needs a task besides `LOC`: something that the robot does";
        return Err(Fault::new(node.at, message));
    }
    Ok(Objective { id: id.to_owned(), x_start_mm, x_end_mm, tasks })
}

fn zone(node: &Node, mission: &Mission, length: i64) -> Result<Zone, Fault> {
    let mut own = Fields::of(node, "a `zone`")?;
    let (at, id) = own.name("id")?;
    distinct(at, "zone", id, mission.zones.iter().map(|it| it.id.as_str()))?;
    let x_start_mm = own.integer("x_start_mm", 0, length)?;
    let x_end_mm = own.integer("x_end_mm", x_start_mm, length)?;
    let mut blind = Vec::new();
    for node in own.list("blind", MAX_HARDWARE)? {
        let (at, name) = text(node, "blind")?;
        blind.push(hardware_of(at, name, mission)?);
    }
    let require_tio = match own.optional("require_tio") {
        None => None,
        Some(node) => {
            let (at, name) = text(node, "require_tio")?;
            let known = mission.options.iter().map(|it| it.id.as_str());
            Some(index_of(at, "option", name, known)?)
        }
    };
    let require_hardware = match own.optional("require_hardware") {
        None => None,
        Some(node) => {
            let (at, name) = text(node, "require_hardware")?;
            Some(hardware_of(at, name, mission)?)
        }
    };
    let (id, attributes) = (id.to_owned(), own.attributes()?);
    Ok(Zone { id, x_start_mm, x_end_mm, blind, require_tio, require_hardware, attributes })
}

fn axis(node: &Node, mission: &mut Mission) -> Result<(), Fault> {
    let mut own = Fields::of(node, "an `axis`")?;
    let (at, id) = own.name("id")?;
    distinct(at, "axis", id, mission.axes.iter().map(|it| it.id.as_str()))?;
    let is_major = match own.optional("class") {
        None => None,
        Some(node) => {
            let (at, word) = text(node, "class")?;
            Some(index_of(at, "class of axis", word, ["minor", "major"].into_iter())? == 1)
        }
    };
    let number = mission.axes.len();
    for node in own.list("indicator", MAX_INDICATORS)? {
        let it = indicator(node, mission, id, number)?;
        if mission.indicators.len() == MAX_INDICATORS {
            let message = format!("all axes together have at most {MAX_INDICATORS} indicators");
            return Err(Fault::new(node.at, message));
        }
        mission.indicators.push(it);
    }
    own.finish()?;
    mission.axes.push(Axis { id: id.to_owned(), is_major });
    Ok(())
}

fn indicator(
    node: &Node,
    mission: &Mission,
    axis_id: &str,
    axis: usize,
) -> Result<Indicator, Fault> {
    let mut own = Fields::of(node, "an `indicator`")?;
    let (at, name) = own.name("id")?;
    let id = format!("{axis_id}.{name}");
    distinct(at, "indicator", &id, mission.indicators.iter().map(|it| it.id.as_str()))?;
    let unit = own.name("unit")?.1.to_owned();
    let (at, word) = own.text("combine")?;
    let adds_up = index_of(at, "way to combine", word, ["each", "sum"].into_iter())? == 1;
    let mut formula = |key: &str| {
        let Some(node) = own.optional(key) else { return Ok(None) };
        let (at, words) = text(node, key)?;
        let formula = Formula::parse(words, at + 1)?;
        for inducer in formula.inducers() {
            let (whose, attributes, key) = match inducer {
                Inducer::Robot(key) => ("robot", &mission.robot, key),
                Inducer::Laptop(key) => ("laptop", &mission.laptop, key),
                _ => continue,
            };
            if attributes.get(key).is_none() {
                let message = format!("the formula reads `{whose}.{key}`, which is not there");
                return Err(Fault::new(at + 1, message));
            }
        }
        Ok(Some(formula))
    };
    let (travel, stand) = (formula("travel")?, formula("stand")?);
    if travel.is_none() && stand.is_none() {
        let message = format!("`{id}` has no formula: `travel`, `stand` or both are needed");
        return Err(Fault::new(node.at, message));
    }
    own.finish()?;
    Ok(Indicator { id, axis, unit, adds_up, travel, stand })
}

fn constraint(node: &Node, mission: &Mission) -> Result<Constraint, Fault> {
    let mut own = Fields::of(node, "a `constraint`")?;
    let (at, id) = own.name("id")?;
    distinct(at, "constraint", id, mission.constraints.iter().map(|it| it.id.as_str()))?;
    let (indicator_at, name) = own.text("indicator")?;
    let indicator = indicator_of(indicator_at, name, mission)?;
    let (kind_at, word) = own.text("kind")?;
    let kinds = [Kind::Core, Kind::End, Kind::Running];
    let kind = index_of(kind_at, "kind", word, kinds.iter().map(|it| it.word()))?;
    let kind = kinds.get(kind).copied().unwrap_or(Kind::End);
    let (at, word) = own.text("op")?;
    let relation = index_of(at, "operator", word, Relation::ALL.iter().map(|it| it.sign()))?;
    let relation = Relation::ALL.get(relation).copied().unwrap_or(Relation::Equal);
    let goal = own.integer("goal", -LARGEST, LARGEST)?;
    let mut goals = Vec::new();
    let list = own.list("at", MAX_ZONES)?;
    for node in list {
        let mut own = Fields::of(node, "a goal of `at`")?;
        let (at, name) = own.text("zone")?;
        let zone = index_of(at, "zone", name, mission.zones.iter().map(|it| it.id.as_str()))?;
        goals.push((zone, own.integer("goal", -LARGEST, LARGEST)?));
        own.finish()?;
    }
    own.finish()?;
    let adds_up = mission.indicators.get(indicator).is_some_and(|it| it.adds_up);
    let wrong = match kind {
        Kind::Core if adds_up => Some("adds up over the mission: limit it at its `end`"),
        Kind::End | Kind::Running if !adds_up => {
            Some("is of each activity and has no sum: limit it as `core`")
        }
        _ => None,
    };
    if let Some(wrong) = wrong {
        return Err(Fault::new(kind_at, format!("`{name}` {wrong}")));
    }
    if let (Kind::End, Some(first)) = (kind, list.first()) {
        let message = "a goal at the end is one number: leave `at` out, or limit it as `running`";
        return Err(Fault::new(first.at, message));
    }
    Ok(Constraint { id: id.to_owned(), indicator, kind, relation, goal, at: goals })
}
