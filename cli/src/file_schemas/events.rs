//! The schema of what happens in a run.

use super::parts::{
    absent, both, choice, id, integer, named, only, says, table, tables, text, when, with,
};
use cotama_models::missions::known::{
    AT_LEAST_ZERO, DOOR_STATES, EVENTS, INCIDENTS, PER_KM, POSITIVE, POWER_ERRORS, RANDOM_EVENTS,
    UNITS,
};
use serde_json::{Value, json};

/// The keys of a file of faults, and of `[run]`.
pub(super) fn happenings() -> [(&'static str, Value); 3] {
    let error = integer(&POWER_ERRORS, "difference in parts per thousand");
    let error = named(&error, "by zone, real power against that of the model, in ‰");
    let events = tables(&event(), 0, "what happens where");
    let random = tables(&random_event(), 0, "what happens at places drawn from `--seed`");
    [("power_error_permille", error), ("event", events), ("random", random)]
}

/// Returns the fields of an event beside its place and its kind.
fn details() -> [(&'static str, Value); 16] {
    let (place, time) = ("where it ends, in mm", "when it ends, in ms after the start");
    let state = "the robot comes to this sub-objective, or to `Waits`, for the first time";
    let answers = json!({
        "type": "array", "items": { "type": "string" }, "minItems": 1,
        "description": "what the operator does when asked: his sub-objectives, `done`, `give_up`",
    });
    [
        ("t_ms", integer(&AT_LEAST_ZERO, "in place of `x_mm`: when it fails, in ms")),
        ("during", text(&format!("in place of `x_mm`: {state}"))),
        ("after_ms", integer(&AT_LEAST_ZERO, "beside `during`: so long after, in ms")),
        ("until_x_mm", integer(&AT_LEAST_ZERO, place)),
        ("until_t_ms", integer(&AT_LEAST_ZERO, time)),
        ("until_during", text(&format!("it ends when {state}"))),
        ("until_after_ms", integer(&AT_LEAST_ZERO, "so long after `until_during`")),
        ("delay_ms", integer(&AT_LEAST_ZERO, "how long the robot or the operator waits, in ms")),
        ("extra_mm", integer(&POSITIVE, "so much more path to drive, in mm")),
        ("hardware", text("what fails or works again")),
        ("units_lost", integer(&UNITS, "how many units fail")),
        ("units_back", integer(&UNITS, "how many units work again")),
        ("mode", text("a failure of the robot's file, by its id")),
        ("answers", answers),
        ("door", text("a door of the floor")),
        ("becomes", choice(&DOOR_STATES, "how it stands from then on")),
    ]
}

fn event() -> Value {
    let kinds = [&EVENTS[..], &INCIDENTS].concat();
    let needs = [("kind", choice(&kinds, "what happens; it says which other keys there are"))];
    let details = details();
    let keys = details.each_ref().map(|it| it.0);
    let place = [("x_mm", integer(&AT_LEAST_ZERO, "where it happens, in mm"))];
    let can: Vec<_> = place.into_iter().chain(details).collect();
    let has_mode = json!({ "required": ["mode"] });
    let repairs = says("kind", &["repair"]);
    let rules = [
        (says("kind", &["obstacle"]), &["delay_ms"][..]),
        (says("kind", &["odometry"]), &["extra_mm"]),
        (says("kind", &["fault"]), &["hardware", "units_lost"]),
        (both(&repairs, &absent(&["mode"])), &["hardware", "units_back"]),
        (both(&repairs, &has_mode), &["mode"]),
        (says("kind", &["operator"]), &["answers", "delay_ms"]),
    ];
    let rules = rules.map(|(kind, needs)| when(&kind, &only(needs, &keys)));
    let moments = [
        fails("failure", &["mode"], &["until_"], &keys),
        fails("door", &["door", "becomes"], &[], &keys),
    ];
    let rules = rules.into_iter().chain([obstacles_last(), placed()]).chain(moments).collect();
    with(table(&needs, &can, "something that happens once"), "allOf", rules)
}

/// A failure names its mode, and when it begins and ends; a door how it stands, and from when on.
fn fails(kind: &str, needs: &[&str], also: &[&str], keys: &[&str]) -> Value {
    let own = |key: &&str| {
        ["t_ms", "during", "after_ms"].contains(key)
            || needs.contains(key)
            || also.iter().any(|it| key.starts_with(it))
    };
    let others: Vec<_> = keys.iter().copied().filter(|it| !own(it)).collect();
    let once = json!({ "oneOf": [
        { "required": ["x_mm"] }, { "required": ["t_ms"] }, { "required": ["during"] },
    ] });
    let then = both(&json!({ "required": needs }), &both(&absent(&others), &once));
    let since = json!({ "dependencies": {
        "after_ms": ["during"],
        "until_after_ms": ["until_during"],
    } });
    when(&says("kind", &[kind]), &both(&then, &since))
}

/// Everything else happens at a place.
fn placed() -> Value {
    let kinds: Vec<_> = EVENTS
        .iter()
        .chain(&INCIDENTS)
        .copied()
        .filter(|it| !["failure", "door"].contains(it))
        .collect();
    when(&says("kind", &kinds), &json!({ "required": ["x_mm"] }))
}

/// An obstacle costs time, while an operator may answer at once.
fn obstacles_last() -> Value {
    let delay = json!({ "properties": { "delay_ms": { "minimum": POSITIVE.start() } } });
    when(&says("kind", &["obstacle"]), &delay)
}

fn random_event() -> Value {
    let needs = [
        ("name", id("its name, which also names its random numbers")),
        ("per_km", integer(&PER_KM, "how many on a kilometre")),
        ("kind", choice(&RANDOM_EVENTS, "what happens")),
    ];
    let keys = ["delay_ms", "extra_mm"];
    let details: Vec<_> = details().into_iter().filter(|it| keys.contains(&it.0)).collect();
    let rules = [("obstacle", "delay_ms"), ("odometry", "extra_mm")];
    let rules = rules.map(|(kind, key)| when(&says("kind", &[kind]), &only(&[key], &keys)));
    let rules = rules.into_iter().chain([obstacles_last()]).collect();
    with(table(&needs, &details, "something that happens at random places"), "allOf", rules)
}
