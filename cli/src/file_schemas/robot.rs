//! The schema of a robot's file.

mod sensing;

use self::sensing::sensing;
use super::DRAFT;
use super::parts::{choice, choices, flag, id, integer, named, table, tables, text, with, word};
use cotama_models::robots::known::{
    ASKS, AXLES, BODY_SPEEDS, CELLS, CHARGES, COEFFICIENTS, COSTS, COUNTS, CURRENTS, ERRORS,
    FORMAT, HARM_UNITS, HOLDS, LENGTHENED, MASKS, MAX_PARAMETERS, MODES, MOTIONS, NO_LOADS,
    PERIODS, PERSISTENCES, POSITIVE, POWERS, RADII, RANKS, RESISTANCES, RESTARTS, ROLLINGS,
    SETTINGS, SEVERITIES, SLOWED, SPEEDS, TIMES, TRIES, TURNS, UNITS, UNWATCHED, VALUES, VOLTAGES,
    WHEELS,
};
use cotama_models::robots::signals::{HARMS, ROLES, TOLD, WATCHES};
use cotama_models::robots::{MAX_CONFIGURATIONS, MAX_FAILURES, MAX_FLAGS, MAX_PARTS};
use serde_json::{Value, json};

/// The schema of a robot's file.
pub(crate) fn robot() -> Value {
    let most = |value: Value, keyword: &str, most: usize| with(value, keyword, most.into());
    let parts =
        |value: &Value, meaning: &str| most(named(value, meaning), "maxProperties", MAX_PARTS);
    let lists = |value: &Value, count: usize, meaning: &str| {
        most(tables(value, 0, meaning), "maxItems", count)
    };
    let needs = [
        ("format", word(FORMAT, "how this file is written")),
        ("name", id("the name of the robot")),
        (
            "configuration",
            with(
                lists(&configuration(), MAX_CONFIGURATIONS, "sets of modules that serve a part"),
                "minItems",
                1.into(),
            ),
        ),
    ];
    let can = [
        ("title", text("the robot in a few words")),
        ("body", body()),
        ("hardware", parts(&hardware(), "what modules stand on")),
        ("module", parts(&module(), "programs that sense, compute and act")),
        ("observer", parts(&observer(), "who sees failures")),
        ("operator", operator()),
        ("supervisors", supervisors()),
        ("failure", lists(&failure(), MAX_FAILURES, "rows of the FMECA")),
    ];
    let file = table(&needs, &can, "What a robot is made of, and what can fail on it.");
    with(with(file, "$schema", DRAFT.into()), "title", "A robot of cotama".into())
}

/// A list of names.
fn names(meaning: &str) -> Value {
    json!({ "type": "array", "items": { "type": "string" }, "description": meaning })
}

fn body() -> Value {
    let power = [
        ("c0", integer(&COEFFICIENTS, "mW at rest")),
        ("c1", integer(&COEFFICIENTS, "mW for each m/s")),
        ("c2", integer(&COEFFICIENTS, "mW for each (m/s)²")),
    ];
    let power = table(&power, &[], "power for a speed: c0 + c1 v / 1000 + c2 v² / 1,000,000 mW");
    let needs = [
        ("speed_max_mm_s", integer(&BODY_SPEEDS, "its highest speed, in mm/s")),
        ("acceleration_mm_s2", integer(&POSITIVE, "how fast it speeds up and brakes, in mm/s²")),
        ("motion_power", power),
    ];
    let can = [
        ("period_ms", integer(&PERIODS, "the period of its control loop, in ms; 100")),
        ("radius_mm", integer(&RADII, "the radius of the disc in which it turns, in mm; 260")),
        ("mass_g", integer(&POSITIVE, "its mass, in g")),
        (
            "impact_energy_max_mj",
            integer(&POSITIVE, "this energy of motion, in mJ, and more, would hurt somebody"),
        ),
    ];
    let wheels = [
        ("radius_um", integer(&WHEELS, "radius of the wheels, in µm; 97500")),
        ("axle_mm", integer(&AXLES, "distance between the wheels, in mm; 330")),
        ("turn_mrad_s", integer(&TURNS, "how fast it turns, in thousandths of rad/s; 1745")),
        (
            "turn_acceleration_mrad_s2",
            integer(&TURNS, "how fast it begins and ends to turn, in thousandths of rad/s²; 1745"),
        ),
        ("counts", integer(&COUNTS, "counts of an encoder in a turn of its wheel; 76600")),
        ("left_error_ppm", integer(&ERRORS, "error of the left radius, in millionths; 0")),
        ("right_error_ppm", integer(&ERRORS, "error of the right radius, in millionths; 0")),
        ("axle_error_ppm", integer(&ERRORS, "error of the distance, in millionths; 0")),
    ];
    let wheels = table(&[], &wheels, "two driven wheels on one axle, for runs in the plane");
    let powered = [("wheels", wheels), ("motors", motors()), ("battery", battery())];
    let can = [&can[..], &powered, &sensing()].concat();
    table(&needs, &can, "how it moves; missions need it")
}

fn motors() -> Value {
    let needs = [
        ("voltage_mv", integer(&VOLTAGES, "the voltage for which they are made, in mV")),
        (
            "no_load_mrad_s",
            integer(&NO_LOADS, "how fast a wheel turns at it without load, in mrad/s"),
        ),
        ("resistance_mohm", integer(&RESISTANCES, "resistance of a winding, in mΩ")),
        ("limit_ma", integer(&CURRENTS, "the current that a motor never exceeds, in mA")),
        (
            "rolling_permille",
            integer(&ROLLINGS, "the force that rolling takes, in thousandths of its weight"),
        ),
        (
            "stall_ms",
            integer(&TIMES, "how long a wheel is held before its motor is stalled, in ms"),
        ),
    ];
    table(&needs, &[], "a motor on each wheel, with its gear, for runs in the plane")
}

fn battery() -> Value {
    let needs = [
        ("capacity_mah", integer(&CHARGES, "its charge when it is full, in mAh")),
        ("full_mv", integer(&VOLTAGES, "its voltage without load when it is full, in mV")),
        ("empty_mv", integer(&VOLTAGES, "the same when it is empty, in mV")),
        ("cutoff_mv", integer(&VOLTAGES, "the robot goes off below this voltage, in mV")),
        ("resistance_mohm", integer(&RESISTANCES, "internal resistance, in mΩ")),
        ("cells", integer(&CELLS, "cells in series")),
    ];
    table(&needs, &[], "what feeds motors and hardware, for runs in the plane")
}

fn hardware() -> Value {
    let can = [
        ("title", text("what it is")),
        ("units", integer(&UNITS, "how many there are; 1")),
        ("power_mw", integer(&POWERS, "what each takes while it is on, in mW; 0")),
        ("kind", text("the hardware of missions that it is a unit of; its name")),
    ];
    table(&[], &can, "a kind of hardware")
}

fn module() -> Value {
    let needs = [("default", integer(&VALUES, "its value where nothing has failed"))];
    let can = [
        ("title", text("what it is")),
        ("least", integer(&VALUES, "the least that it can be; 0")),
        ("most", integer(&VALUES, "the most that it can be")),
        ("cost_us", integer(&COSTS, "the time that each unit of it adds, in µs")),
    ];
    let parameters = named(&table(&needs, &can, "a number"), "numbers that can be set");
    let parameters = with(parameters, "maxProperties", MAX_PARAMETERS.into());
    let can = [
        ("title", text("what it does")),
        ("hardware", names("hardware that it needs, all of it")),
        ("needs", names("modules that it needs, all of them")),
        ("one_of", names("modules of which it needs one")),
        ("period_ms", integer(&TIMES, "how often it runs, in ms")),
        ("deadline_ms", integer(&TIMES, "when it has to be done, in ms; its period")),
        ("cost_us", integer(&COSTS, "how long it computes, in µs")),
        (
            "priority",
            integer(&RANKS, "whose turn is first, 0 before all; by deadline among equals"),
        ),
        ("parameter", parameters),
        ("serves", text("the option of missions that needs it")),
        ("roles", choices(&ROLES.map(|it| it.0), "the algorithms that it runs in the plane")),
    ];
    table(&[], &can, "a program")
}

fn observer() -> Value {
    let flags = with(names("the flags that it raises"), "maxItems", MAX_FLAGS.into());
    let signals: Vec<_> = WATCHES.iter().map(|it| it.0).chain([TOLD]).collect();
    let signals = choices(&signals, "the signal in the plane of each flag; all are told");
    let can = [
        ("title", text("what it looks at")),
        ("needs", names("hardware and modules without which it sees nothing")),
        ("watches", signals),
        (
            "unwatched",
            choice(
                &UNWATCHED,
                "what counts of what it alone watches while it is blind; `\"kept\"`",
            ),
        ),
    ];
    table(&[("flags", with(flags, "minItems", 1.into()))], &can, "who sees failures")
}

fn operator() -> Value {
    table(&[("needs", names("the modules by which he is reached"))], &[], "who can be asked")
}

fn supervisors() -> Value {
    let local = text("a net in JSON in place of the local supervisor, as a path from this file");
    table(&[("local", local)], &[], "nets of one's own in place of those that are made")
}

fn configuration() -> Value {
    let needs = [
        ("name", id("its name")),
        ("sub_objective", id("the part of a drive that it serves")),
        ("mode", choice(&MODES, "whose part it is")),
        ("required", with(names("modules that it needs"), "minItems", 1.into())),
    ];
    let can = [
        ("optional", names("modules that it uses where they work")),
        ("rank", integer(&RANKS, "lower is better; the order of the file")),
        ("speed_mm_s", integer(&SPEEDS, "how fast it goes, in mm/s; it stands")),
        ("takes_ms", integer(&TIMES, "how long it takes where it stands, in ms; 1,000")),
    ];
    table(&needs, &can, "modules that serve a part of a drive")
}

fn failure() -> Value {
    let severity = |meaning: &str| choice(&SEVERITIES, meaning);
    let severity = table(
        &[("autonomous", severity("while the robot drives by itself"))],
        &[("operator", severity("while the operator leads it; the same"))],
        "how severe it is",
    );
    let restart = [
        ("module", text("the module that is started anew; of `each`, that one")),
        ("times", integer(&RESTARTS, "how often, before anything counts as lost")),
        ("shared", id("rows of one name count together; else each counts alone")),
        ("mends", flag("whether the failure is over by it, though it does not pass by itself")),
    ];
    let [module, times, shared, mends] = restart;
    let can = [module, shared, mends];
    let restart = table(&[times], &can, "a module that is started anew first");
    let values = with(
        json!({ "type": "object", "additionalProperties": integer(&VALUES, "the value") }),
        "description",
        "new values, as `\"MODULE.PARAMETER\" = 3`".into(),
    );
    let set = [
        ("values", values),
        ("speed_permille", integer(&SLOWED, "the part of the speed that it leaves")),
        ("mode", choice(&MODES, "the mode in which it is slower; both")),
        ("holds_ms", integer(&HOLDS, "how long it outlasts the failure, in ms; 5,000")),
        ("mends", flag("whether the failure is over by it")),
        ("times", integer(&SETTINGS, "how often it is tried before the failure is told")),
    ];
    let ask = [("times", integer(&ASKS, "how often, before severity and what is left decide"))];
    let mask = [
        ("on", choice(&MASKS, "when: with what is told, or on the operator's order; `\"told\"`")),
        ("lasts_ms", integer(&TIMES, "how long, in ms; to the end of the mission")),
    ];
    let masked = with(names("flags of this failure"), "minItems", 1.into());
    let tries = TRIES.map(|it| it.0);
    let order = json!({
        "type": "array", "minItems": 1, "uniqueItems": true,
        "items": { "type": "string", "enum": tries },
        "description": "in which order these are tried; `restart`, `set` with `times`, `ask`",
    });
    let needs = [
        ("id", id("its short name")),
        ("mode", text("what fails, and how")),
        ("severity", severity),
    ];
    let motions = MOTIONS.map(|it| it.0);
    let harms = HARMS.map(|it| it.0);
    let is = [("is", choice(&harms, "what happens to the device"))];
    let harm = [
        ("module", text("the module, where one is harmed and the failure has no `each`")),
        ("unit", integer(&HARM_UNITS, "the sonar, the laser, or the side, 0 left, 1 right; 0")),
        (
            "permille",
            integer(&LENGTHENED, "how much is lost, wrong or longer, in thousandths; 500"),
        ),
    ];
    let can = [
        ("function", text("the function that is lost")),
        ("item", text("the part that fails")),
        ("cause", text("why")),
        ("effect", text("what comes of it")),
        ("persistence", choice(&PERSISTENCES, "how long it stays; `\"permanent\"`")),
        ("each", names("modules: one failure for each")),
        ("flags", names("the flags that it raises always")),
        ("sometimes", names("the flags that it may raise")),
        ("unseen", text("why no flag shows it")),
        ("latency_ms", integer(&TIMES, "how long observers take to see it, in ms")),
        ("loses", names("hardware and modules that are lost with it")),
        ("motion", choice(&motions, "what it does to the motion of a mission")),
        ("slowed_permille", integer(&SLOWED, "or the part of the speed that it leaves")),
        ("harm", table(&is, &harm, "what it does to a device in the plane")),
        ("ends_ms", integer(&TIMES, "after so long it is over, in ms")),
        ("helped", flag("whether it is over when the operator has helped")),
        ("no_plan", flag("whether it is that no plan keeps the limits of the mission")),
        ("unanswered", flag("whether the operator answers nothing while it lasts")),
        ("restart", restart),
        ("set", table(&[], &set, "a setting that answers it")),
        ("ask", table(&ask, &[], "the operator is asked first")),
        ("mask", table(&[("flags", masked)], &mask, "flags that are not diagnosed from then on")),
        ("order", order),
        (
            "mean_hours",
            json!({
                "type": "number", "exclusiveMinimum": 0,
                "description": "the mean hours between two of them",
            }),
        ),
    ];
    table(&needs, &can, "a row of the FMECA")
}
