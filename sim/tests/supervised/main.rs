//! Missions under COTAMA's supervisors.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

mod seven_points;

use cotama_models::mission::Mission;

fn delivery() -> Mission {
    let delivery = cotama_models::embedded::mission("delivery").unwrap();
    Mission::parse(delivery.name, delivery.text).unwrap()
}
