//! A mission of a robot from a file: on a line, or over a floor.
#![allow(clippy::cast_precision_loss)] // a radius in mm needs no more than 14 bits

use crate::exit::Failure;
use crate::floor;
use crate::mission;
use cotama_floor::{Floor, Ground, Needs, embedded};
use cotama_models::missions::Asked;
use std::fs;
use std::path::{Path, PathBuf};

const TEMPLATE: &str = include_str!("../../templates/robot_mission.toml");

/// The text of a mission of this robot, in a file of that folder.
pub(super) fn text(
    name: &str,
    floor: Option<&str>,
    folder: Option<&Path>,
) -> Result<String, Failure> {
    let file = mission::robot(name, None)?;
    let robot = file.robot();
    let Some(body) = &robot.body else {
        let message = format!("the robot `{}` has no [body], so nothing moves it", robot.name);
        return Err(Failure::new(message).help("add one: `cotama new robot NAME` writes one"));
    };
    let path = if file.source() == robot.name { name.to_owned() } else { beside(name, folder) };
    let failure = robot.failures.first().map(|it| it.id.as_str());
    let (text, events) = TEMPLATE.split_once("[run]\n").unwrap_or((TEMPLATE, ""));
    let text = text.replace("ROBOT", &path);
    let events = failure.map(|it| format!("[run]\n{}", events.replace("FAILURE", it)));
    let text = text + &events.unwrap_or_default();
    let Some(name) = floor else { return Ok(text) };
    let is_ours = embedded::named(name).is_some();
    let path = if is_ours { name.to_owned() } else { beside(name, folder) };
    let needs = Needs { radius_m: body.radius.0 as f64 / 1_000.0, ..Needs::default() };
    over(&text, &path, &floor::drawing(name)?, needs)
}

/// A file as the mission names it: whole where it stands in another folder.
fn beside(name: &str, folder: Option<&Path>) -> String {
    if folder.is_none_or(|it| it.as_os_str().is_empty()) {
        return name.to_owned();
    }
    let whole = fs::canonicalize(name).unwrap_or_else(|_| PathBuf::from(name));
    whole.display().to_string()
}

/// The mission on a line, over a floor: from its first docking station or place to two others.
fn over(text: &str, path: &str, floor: &Floor, needs: Needs) -> Result<String, Failure> {
    let places: Vec<&String> = floor.docks.iter().chain(&floor.places).map(|it| &it.name).collect();
    let length = |stops: &[&String]| -> Option<u64> {
        let (from, to) = stops.split_first()?;
        let to = to.iter().map(|it| (*it).clone()).collect();
        let asked = Asked { from: (*from).clone(), to, ..Asked::default() };
        let way = Ground::Drawing(floor).way(path, "", asked, needs);
        way.legs.iter().all(Result::is_ok).then(|| way.length().0)
    };
    let found = places.iter().enumerate().find_map(|(at, from)| {
        let others = places.iter().enumerate().filter(|it| it.0 != at);
        let (at, there) = others.clone().find(|it| length(&[*from, it.1]).is_some())?;
        let mut last = others.filter(|it| it.0 != at).map(|it| it.1).chain([from]);
        let last = last.find(|it| length(&[*from, there, *it]).is_some())?;
        Some([*from, there, last])
    });
    let Some(stops) = found else {
        let message = "no two places of this floor have a way between them for this robot";
        return Err(Failure::new(message).help("add places, open a door, or take a smaller robot"));
    };
    let middle = length(&stops).unwrap_or(2) / 2;
    let [from, there, last] = stops.map(|it| format!("{it:?}"));
    let zone = floor.zones.first().map(|it| format!("on_floor = {:?}", it.name));
    let mut lines: Vec<String> = Vec::new();
    let (mut to, mut is_zone) = ([there, last].into_iter(), false);
    for line in text.lines() {
        is_zone = if line.starts_with("[[") { line == "[[zone]]" } else { is_zone };
        let is_length = line.starts_with("x_start_mm") || line.starts_with("x_end_mm");
        match line {
            _ if is_zone && zone.is_none() && !line.starts_with('#') => {}
            _ if line.starts_with("path_length_mm") => {
                lines.push(format!(
                    "floor = {path:?}                # lengths are those of its paths"
                ));
                lines.push(format!("from = {from}"));
            }
            _ if line.starts_with("x_start_mm") && is_zone => lines.extend(zone.clone()),
            _ if is_length => {}
            "does = \"drive\"" => {
                lines.push(line.to_owned());
                lines.extend(to.next().map(|it| format!("to = {it}")));
            }
            _ if line.starts_with("x_mm = ") => lines.push(format!("x_mm = {middle}")),
            _ => lines.push(line.to_owned()),
        }
    }
    Ok(lines.join("\n") + "\n")
}
