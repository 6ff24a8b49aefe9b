//! The schema of the people of a mission.

use super::parts::{flag, id, integer, names, table, tables, with};
use cotama_models::missions::known::{AT_LEAST_ZERO, MAX_PERSONS, MAX_WALKS, WALKING_SPEEDS};
use serde_json::Value;

/// The people whom a mission names.
pub(super) fn person() -> Value {
    let walks =
        "the places between which they walk, or X,Y in mm, round and round; who has one stands";
    let walks = with(with(names(walks), "minItems", 1.into()), "maxItems", MAX_WALKS.into());
    let needs = [("id", id("the name, which also names the random numbers")), ("walks", walks)];
    let can = [
        ("speed_mm_s", integer(&WALKING_SPEEDS, "how fast they walk; drawn from 1,000 to 1,500")),
        ("stays_ms", integer(&AT_LEAST_ZERO, "how long in each place, in ms; drawn")),
        ("from_ms", integer(&AT_LEAST_ZERO, "when they first walk, in ms; 0")),
        ("gives_way", flag("whether they go out of the way of a robot; `true`")),
    ];
    let person = table(&needs, &can, "a person on the floor");
    with(
        tables(&person, 0, "beside `floor`: people and where they walk"),
        "maxItems",
        MAX_PERSONS.into(),
    )
}
