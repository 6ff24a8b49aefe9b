//! JSON schemas of the files that users write, for editors of TOML: missions and faults.
//!
//! Numbers and words are those of the reader; that the keys are, too, is a test
//! (`tests/file_schemas.rs`). A schema knows the shape of a file, not what its numbers say
//! together: that objectives follow each other, say, only the reader finds out.

mod events;
mod parts;
mod people;
mod robot;

use events::happenings;
pub(crate) use robot::robot as robot_file;

use cotama_core::hardware::{MAX_KINDS, MAX_UNITS};
use cotama_models::missions::faults::{self, Adapts, FIDELITIES, OUTCOMES};
use cotama_models::missions::known::{
    ALLOCATORS, AT_LEAST_ZERO, CLEARANCE_MM, COUNTS, ENERGIES, EVENTS, NAME_LENGTHS, NEEDED_UNITS,
    OBJECTIVES, PEOPLE, PERIODS, POSITIVE, QUALITIES, ROUNDINGS, SEARCHES, SPEEDS, UNITS,
};
use cotama_models::missions::{self, AXES};
use parts::{
    absent, both, choice, choices, id, integer, named, names, says, table, tables, text, when,
    with, word,
};
use serde_json::{Value, json};

const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

const CLEARANCE: &str = "beside `floor`: room that the path keeps beyond the robot's radius, in mm";

/// The schema of a mission file: that of a robot with a file, or of a plain mission.
pub(crate) fn mission() -> Value {
    let file = json!({
        "type": "object",
        "if": says("format", &[missions::FORMAT_2]),
        "then": mission_of_robot(),
        "else": {
            "if": says("format", &[missions::FORMAT_3]),
            "then": mission_with_axes(),
            "else": plain_mission(),
        },
    });
    with(with(file, "$schema", DRAFT.into()), "title", "A mission of cotama".into())
}

/// A mission whose robot has a file: body, hardware and options of moving are the robot's.
fn mission_of_robot() -> Value {
    let needs = [
        ("format", word(missions::FORMAT_2, "how this file is written")),
        ("name", name()),
        ("robot", text("the robot: its name, or the path of its file")),
        ("limits", limits()),
        ("objective", tables(&objective(true), 1, "what is to be done where, in this order")),
    ];
    let can = [
        ("path_length_mm", integer(&POSITIVE, "how long the path is, in mm; without a floor")),
        ("floor", text("the floor: its name, or the path of a drawing or of a map of ROS")),
        ("from", text("beside `floor`: the place at which the mission starts, or X,Y in mm")),
        ("open", names("beside `floor`: doors that are open")),
        ("close", names("beside `floor`: doors that are closed")),
        ("clearance_mm", integer(&CLEARANCE_MM, CLEARANCE)),
        ("people", integer(&PEOPLE, "beside `floor`: how many people the seed draws")),
        ("person", people::person()),
        ("tio", tables(&tio(false), 0, "ways to do a task for which the robot stands")),
        ("zone", tables(&zone(true), 0, "what holds in a part of the path")),
        ("plan", plan()),
        ("run", run()),
    ];
    let file = table(&needs, &can, "The path, the robot, what is to be done, and the limits.");
    let lengths = absent(&["x_start_mm", "x_end_mm"]);
    let on_floor = json!({
        "required": ["from"], "properties": { "objective": { "items": lengths } },
    });
    let line = json!({
        "required": ["path_length_mm"],
        "properties": {
            "objective": { "items": { "required": ["x_start_mm", "x_end_mm"] } },
            "zone": { "items": { "required": ["x_start_mm"] } },
        },
    });
    let on_floor = both(&on_floor, &absent(&["path_length_mm"]));
    let line = both(&line, &absent(&["from", "open", "close", "clearance_mm", "people", "person"]));
    let rule = json!({ "if": { "required": ["floor"] }, "then": on_floor, "else": line });
    with(file, "allOf", json!([rule]))
}

/// A mission whose limits are constraints on axes; its other keys are those of the other formats,
/// and numbers of its own.
fn mission_with_axes() -> Value {
    let lists = ["axis", "constraint", "tio", "objective", "zone"];
    let lists = lists.map(|it| (it.to_owned(), json!({ "type": "array" })));
    let properties: serde_json::Map<_, _> = lists.into_iter().collect();
    let meaning = "A mission with axes: `cotama help plan`, and the page on axes.";
    json!({
        "type": "object", "description": meaning, "properties": properties,
        "required": ["format", "name", "axis", "objective"],
        "not": { "required": ["limits"] },
    })
}

fn plain_mission() -> Value {
    let needs = [
        ("format", word(missions::FORMAT, "how this file is written")),
        ("name", name()),
        ("path_length_mm", integer(&POSITIVE, "how long the path is, in mm")),
        ("limits", limits()),
        ("robot", robot()),
        ("motion_power", motion_power()),
        ("hardware", hardware()),
        ("tio", tables(&tio(true), 1, "task implementation options: ways to do a task")),
        ("objective", tables(&objective(false), 1, "what is to be done where, in this order")),
    ];
    let can = [
        ("zone", tables(&zone(false), 0, "what holds in a part of the path")),
        ("fixed", fixed()),
        ("rounding", rounding()),
        ("plan", plan()),
        ("run", run()),
    ];
    let file = table(&needs, &can, "The path, the robot, its ways to do things, and the limits.");
    let event = both(&json!({ "properties": { "kind": { "enum": EVENTS } } }), &absent(&["mode"]));
    let plain =
        json!({ "properties": { "run": { "properties": { "event": { "items": event } } } } });
    with(file, "allOf", json!([plain, needs_fixed("TUR", "turn"), needs_fixed("DET", "detect")]))
}

/// The schema of a file of faults.
pub(crate) fn faults() -> Value {
    let format = word(faults::FORMAT, "how this file is written");
    let can = [&happenings()[..], &[("planner", planner()), ("expected", expected())]].concat();
    let file = table(&[("format", format)], &can, "What goes wrong while a mission runs.");
    with(with(file, "$schema", DRAFT.into()), "title", "Faults of a mission of cotama".into())
}

fn planner() -> Value {
    let objective = choice(&OBJECTIVES.map(|it| it.0), "what plans are chosen for");
    let needs = [
        ("objective", objective),
        ("allocator", choice(&ALLOCATORS, "who plans: the rule, or a complete search")),
    ];
    let can = [
        ("steps", integer(&SEARCHES, "the most steps of a search; 50,000,000")),
        ("policy", choice(&Adapts::NAMES.map(|it| it.0), "how plans are adapted; `\"usual\"`")),
        ("fidelity", choice(&FIDELITIES, "how closely the robot was modelled; `\"line\"`")),
    ];
    table(&needs, &can, "who plans when `cotama replay` runs it")
}

fn expected() -> Value {
    let count = |meaning: &str| integer(&COUNTS, meaning);
    let needs = [
        ("requirement", text("the requirement that broke, as in `cotama campaign --require`")),
        ("outcome", choice(&OUTCOMES, "how the run ended")),
        ("time_ms", count("the time used, in ms")),
        ("energy_mj", count("the energy used, in mJ")),
        ("x_mm", count("how far the robot came, in mm")),
    ];
    let can = [
        ("mission", text("the mission: its name, or the path of its file")),
        ("robot", text("the robot that supervises it, where it names none")),
        ("seed", count("the seed of the run; 0")),
        ("replans", count("how often plans were made again")),
        ("requests", count("how often the operator was asked")),
        ("exposed_ms", count("the longest motion without a required module, in ms")),
        ("broken_ms", count("when the requirement was broken, in ms, if that ended the run")),
    ];
    table(&needs, &can, "the failure that it records, which `cotama replay` compares with")
}

fn name() -> Value {
    let lengths = format!(
        "^[^\\u0000-\\u001f\\u007f-\\u009f]{{{},{}}}$",
        NAME_LENGTHS.start(),
        NAME_LENGTHS.end()
    );
    with(text("the name of the mission"), "pattern", lengths.into())
}

fn limits() -> Value {
    let order = choices(&AXES, "which limit the rule treats first: `[\"duration\", \"energy\"]`");
    let order = with(with(order, "minItems", 2.into()), "maxItems", 2.into());
    let needs = [
        ("order", with(order, "uniqueItems", true.into())),
        ("duration_ms", integer(&POSITIVE, "the mission takes at most so long, in ms")),
        ("energy_mj", integer(&ENERGIES, "and at most so much, in mJ")),
    ];
    table(&needs, &[], "what every plan must keep")
}

fn plan() -> Value {
    let meaning =
        "`\"quality\"` (where nothing is said), `\"min-energy\"`, or `\"paper\"`: the rule";
    let objective = choice(&OBJECTIVES.map(|it| it.0), meaning);
    table(&[("objective", objective)], &[], "what plans are for")
}

fn rounding() -> Value {
    let formulas =
        ROUNDINGS.map(|(key, formula)| (key, word(formula, "the formula, word by word")));
    table(&[], &formulas, "repeats the two formulas that the program computes with")
}

fn robot() -> Value {
    let hurts = "this energy of motion, in mJ, and more, would hurt somebody";
    let needs = [
        ("mass_g", integer(&POSITIVE, "its mass, in g")),
        ("speed_max_mm_s", integer(&SPEEDS, "its highest speed, in mm/s")),
        ("impact_energy_max_mj", integer(&POSITIVE, hurts)),
    ];
    let harmless = "the speed that follows from both, in mm/s; checked";
    table(&needs, &[("speed_harmless_mm_s", integer(&SPEEDS, harmless))], "the robot's body")
}

fn motion_power() -> Value {
    let needs = [
        ("c0", integer(&AT_LEAST_ZERO, "mW at rest")),
        ("c1", integer(&AT_LEAST_ZERO, "mW for each m/s")),
        ("c2", integer(&AT_LEAST_ZERO, "mW for each (m/s)²")),
    ];
    let point = [
        ("speed_mm_s", integer(&SPEEDS, "a speed, in mm/s")),
        ("power_mw", integer(&AT_LEAST_ZERO, "the power at this speed, in mW")),
    ];
    let point = table(&point, &[], "a point of the curve");
    let at = tables(&point, 0, "`{ speed_mm_s, power_mw }`: points of the curve, checked");
    table(&needs, &[("at", at)], "power for a speed: c0 + c1 v / 1000 + c2 v² / 1,000,000 mW")
}

fn hardware() -> Value {
    let needs = [
        ("units", integer(&UNITS, &format!("how many there are, at most {MAX_UNITS}"))),
        ("power_mw", integer(&AT_LEAST_ZERO, "what each takes while it is on, in mW")),
    ];
    let kind = table(&needs, &[], "a kind of hardware");
    with(named(&kind, "what the robot has"), "maxProperties", MAX_KINDS.into())
}

fn fixed() -> Value {
    let power = integer(&AT_LEAST_ZERO, "what it takes, in mW");
    let can = [
        ("turn_ms", integer(&POSITIVE, "how long a turn takes, in ms")),
        ("turn_power_mw", power.clone()),
        ("detect_ms", integer(&POSITIVE, "how long a detection takes, in ms")),
        (
            "detect_power_mw",
            named(&power, "what it takes, in mW, for each option of the task `DET`"),
        ),
    ];
    let pairs = json!({
        "turn_ms": ["turn_power_mw"], "turn_power_mw": ["turn_ms"],
        "detect_ms": ["detect_power_mw"], "detect_power_mw": ["detect_ms"],
    });
    with(table(&[], &can, "needed where the robot turns or detects"), "dependencies", pairs)
}

/// A mission with an option for a task that is done standing says what that takes.
fn needs_fixed(task: &str, what: &str) -> Value {
    let options = json!({ "contains": says("task", &[task]) });
    let has = json!({ "properties": { "tio": options }, "required": ["tio"] });
    let keys = [format!("{what}_ms"), format!("{what}_power_mw")];
    when(&has, &json!({ "properties": { "fixed": { "required": keys } }, "required": ["fixed"] }))
}

/// The tasks whose options do not say what they take.
const KNOWN: [&str; 4] = ["MOV", "TUR", "DET", "LOC"];

/// The tasks.
const TASKS: &str =
    "`MOV`, `LOC`, `TUR`, `DET`, `RCV`, `DLV`, `WAI`, or one of your own in capitals";

/// A task by its name.
fn task_name(meaning: &str) -> Value {
    with(text(meaning), "pattern", "^[A-Z][A-Z0-9_]{1,15}$".into())
}

fn tio(is_plain: bool) -> Value {
    let units = integer(&NEEDED_UNITS, "units of this hardware");
    let hardware = ("needs", named(&units, "how many units of which hardware"));
    let needs = [("id", id("its name")), ("task", task_name(TASKS))];
    let can = [
        ("speed_max_mm_s", integer(&SPEEDS, "not faster this way, in mm/s")),
        ("quality_per_dm", integer(&QUALITIES, "how good it is, for each 100 mm of way")),
        ("quality", integer(&QUALITIES, "how good it is where the robot stands")),
        (
            "duration_ms",
            integer(
                &POSITIVE,
                "needed by tasks but `MOV`, `LOC`, `TUR`, `DET`: how long it takes, in ms",
            ),
        ),
        (
            "power_mw",
            integer(
                &AT_LEAST_ZERO,
                "needed by tasks but `MOV`, `LOC`, `TUR`, `DET`: what it takes, in mW",
            ),
        ),
    ];
    let own = ["duration_ms", "power_mw"];
    let rules = json!([
        { "if": says("task", &KNOWN), "then": absent(&own), "else": { "required": own } },
    ]);
    let (first, last) = if is_plain { (Some(hardware), None) } else { (None, Some(hardware)) };
    let needs: Vec<_> = needs.into_iter().chain(first).collect();
    let can: Vec<_> = can.into_iter().chain(last).collect();
    with(table(&needs, &can, "a way to do a task"), "allOf", rules)
}

fn zone(may_be_of_floor: bool) -> Value {
    let ends = [
        ("x_start_mm", integer(&AT_LEAST_ZERO, "where it begins, in mm")),
        ("x_end_mm", integer(&POSITIVE, "where it ends, in mm")),
    ];
    let of = ("on_floor", text("the zone of the floor that it is; its own name"));
    let (needs, first) = if may_be_of_floor {
        (vec![("id", id("its name"))], [&ends[..], &[of]].concat())
    } else {
        ([&[("id", id("its name"))][..], &ends].concat(), Vec::new())
    };
    let can = [
        ("speed_max_mm_s", integer(&SPEEDS, "not faster here, in mm/s")),
        ("require_tio", text("this option must be used here")),
        ("require_hardware", text("the option that moves must use this")),
        ("require_units", integer(&UNITS, "beside `require_hardware`: so many units of it")),
    ];
    let can = [&first[..], &can].concat();
    let rule = json!({
        "require_units": ["require_hardware"],
        "x_start_mm": ["x_end_mm"], "x_end_mm": ["x_start_mm"],
    });
    with(table(&needs, &can, "a part of the path"), "dependencies", rule)
}

fn objective(under_supervisors: bool) -> Value {
    let meaning = "what is done at the same time, as `[\"MOV\", \"LOC\"]`";
    let tasks = json!({
        "type": "array", "items": task_name(TASKS), "minItems": 1, "description": meaning,
    });
    let ends = "where it ends, in mm; the same place where the robot stands";
    let lengths = [
        ("x_start_mm", integer(&AT_LEAST_ZERO, "where it begins, in mm")),
        ("x_end_mm", integer(&AT_LEAST_ZERO, ends)),
    ];
    let to = ("to", text("on a floor: the place to which it drives, or X,Y in mm"));
    let tasks = ("tasks", with(tasks, "uniqueItems", true.into()));
    let meaning = "`drive`, `receive`, `deliver`, `wait`, or a task of your own in small letters";
    let does = ("does", with(text(meaning), "pattern", "^[a-z][a-z0-9_]{1,15}$".into()));
    let name = ("id", id("its name"));
    let (needs, can) = if under_supervisors {
        (vec![name, does], [&lengths[..], &[to, tasks]].concat())
    } else {
        ([&[name][..], &lengths, &[tasks]].concat(), Vec::new())
    };
    table(&needs, &can, "a part of what is to be done")
}

fn run() -> Value {
    let period = integer(&PERIODS, "how often margins are looked at, in ms; 1,000");
    let seed =
        integer(&AT_LEAST_ZERO, "the seed of random numbers, unless `--seed` says another; 0");
    let margins =
        text("a file of `cotama risk calibrate`, held back for what remains, beside this one");
    let own = [("monitor_period_ms", period), ("seed", seed), ("margins", margins)];
    let can = [&own[..], &happenings()].concat();
    table(&[], &can, "what goes wrong in this mission")
}
