//! Findings of campaigns: defects planted in supervisors, observers, planning and the robot.
//!
//! `cargo test --release -p cotama-campaign --test campaigns -- --ignored --nocapture` measures how
//! many runs each strategy takes; `UPDATE_GOLDEN=1` writes the table anew.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

#[path = "campaigns/defects.rs"]
mod defects;
#[path = "campaigns/margins.rs"]
mod margins;
#[path = "campaigns/measured.rs"]
mod measured;
#[path = "campaigns/methods.rs"]
mod methods;
#[path = "campaigns/own.rs"]
mod own;
#[path = "campaigns/policies.rs"]
mod policies;
#[path = "campaigns/returns.rs"]
mod returns;
#[path = "campaigns/statistics.rs"]
mod statistics;
#[path = "campaigns/teams.rs"]
mod teams;

use cotama_models::missions::Mission;

fn mission(name: &str) -> Mission {
    let it = cotama_models::missions::embedded::mission(name).unwrap();
    Mission::parse(it.name, it.text).unwrap()
}
