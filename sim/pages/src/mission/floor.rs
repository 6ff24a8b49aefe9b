//! The run on its floor: the way from above, the points of the story on it, and a robot that a
//! slider moves through time.

use super::MAX_POINTS;
use super::sight::Sight;
use super::view::View;
use crate::format::{metres as in_metres, moment};
use crate::player::Player;
use crate::svg::fixed;
use cotama_core::text::markup;
use cotama_floor::picture::{self, Pixels};
use cotama_floor::{Floor, Grid, Path, metres};
use cotama_models::missions::Way;
use cotama_sim::trace::Record;
use std::fmt::Write;

/// The most moments at which the robot is placed; between two of them it moves evenly.
const MOST: usize = 4_000;

/// The radius of a person, in metres.
const PERSON_M: f64 = 0.25;

/// The section; nothing for a mission on a line.
pub(super) fn section(view: &View<'_>) -> String {
    let Some(way) = view.way.as_ref() else { return String::new() };
    let floor = Floor::parse(&way.source, &way.text).ok();
    let grid = Grid::parse(&way.text);
    let path = Path::new(way.points().iter().map(|it| metres(*it)).collect());
    let corners = corners(way);
    let radius = view.mission.as_ref().ok().and_then(|it| it.robot()?.robot().body.as_ref());
    let radius_m = radius.map_or(0.26, |it| it.radius.0 as f64 / 1_000.0);
    let mut data = String::new();
    let over = |pixels: &Pixels| {
        let at = |corner: &Corner| pixels.at(metres(corner.at)).map(fixed);
        let all: Vec<_> = corners
            .iter()
            .map(|it| {
                let [x, y] = at(it);
                format!("[{},{x},{y}]", it.along_mm)
            })
            .collect();
        let (poses, rays, tracks) = poses(view, pixels);
        let all = all.join(",");
        data = format!("\"way\":[{all}],\"poses\":[{poses}],\"rays\":[{rays}],{}", moments(view));
        let mut over = format!("{tracks}<g class=\"points\">");
        for point in view.points.iter().take(MAX_POINTS) {
            let number = point.number;
            let [x, y] = place(&corners, point.x_mm, |it| pixels.at(metres(it)));
            let title = format!("{}, {}", markup(&point.title()), moment(point.t_us));
            let [x, y] = [fixed(x), fixed(y)];
            let _ = write!(
                over,
                "<g><title>{title}</title><circle class=\"pin\" cx=\"{x}\" cy=\"{y}\" r=\"9\"/>\
                 <text class=\"pin\" x=\"{x}\" y=\"{y}\" dy=\"4\">{number}</text></g>"
            );
        }
        let radius = radius_m * pixels.scale;
        let [r, ahead] = [fixed(radius), fixed(radius * 1.6)];
        let [x, y] = corners.first().map_or([0.0; 2], |it| pixels.at(metres(it.at))).map(fixed);
        let _ = write!(
            over,
            "</g><g class=\"robot\" transform=\"translate({x} {y})\"><circle r=\"{r}\"/>\
             <path d=\"M0 0H{ahead}\"/></g>"
        );
        over
    };
    let (name, drawn) = match (&floor, &grid) {
        (Some(it), _) => (it.name.as_str(), picture::floor_under(it, path.as_ref(), over)),
        (None, Some(it)) => {
            let name = way.source.rsplit('/').next().unwrap_or_default();
            (name, picture::grid_under(name, it, path.as_ref(), over))
        }
        (None, None) => return String::new(),
    };
    let note = format!(
        "{name}, {} from place to place{}. The slider moves the robot through the run; numbers are \
         points of the story.",
        in_metres(way.length().0),
        longer(view, way)
    );
    let player = Player {
        class: "onfloor",
        note: &note,
        drawn: &drawn,
        below: "",
        end_ms: view.last().1 / 1_000,
        speed: 20,
        data: &data,
        script: include_str!("floor.js"),
    };
    player.section()
}

/// Says why corridors are longer than the path of the mission, where they are.
fn longer(view: &View<'_>, way: &Way) -> String {
    let path = view.mission.as_ref().map_or(0, |it| it.path_length.0);
    match way.length().0.checked_sub(path).filter(|more| path > 0 && *more > 0) {
        None => String::new(),
        Some(more) => {
            let (path, more) = (in_metres(path), in_metres(more));
            format!(": {path} of the mission and {more} that wrong positions add to its path")
        }
    }
}

/// A corner of the way, with the length along it.
struct Corner {
    at: [i32; 2],
    along_mm: u64,
}

/// The corners of a way. Lengths of a leg are in proportion, so that they end where missions say.
fn corners(way: &Way) -> Vec<Corner> {
    let (mut corners, mut before) = (Vec::new(), 0);
    for leg in way.legs.iter().flatten() {
        let lengths = leg.points.iter().zip(leg.points.iter().skip(1));
        let lengths: Vec<f64> =
            lengths.map(|(from, to)| (metres(*to) - metres(*from)).norm()).collect();
        let (whole, mut gone) = (lengths.iter().sum::<f64>(), 0.0);
        for (at, length) in leg.points.iter().zip(std::iter::once(&0.0).chain(&lengths)) {
            gone += length;
            let share = if whole > 0.0 { gone / whole } else { 1.0 };
            let along_m = share * leg.length.0 as f64 / 1_000.0;
            corners.push(Corner { at: *at, along_mm: before + millimetres(along_m) });
        }
        before += leg.length.0;
    }
    corners
}

#[allow(clippy::cast_sign_loss)] // lengths are at least 0
fn millimetres(length_m: f64) -> u64 {
    (length_m * 1_000.0).round() as u64
}

/// Returns the pixels of a place along the way.
fn place(corners: &[Corner], x_mm: u64, at: impl Fn([i32; 2]) -> [f64; 2]) -> [f64; 2] {
    let next = corners.partition_point(|it| it.along_mm < x_mm).min(corners.len() - 1);
    let (Some(to), Some(from)) = (corners.get(next), corners.get(next.saturating_sub(1))) else {
        return [0.0; 2];
    };
    let span = (to.along_mm - from.along_mm).max(1) as f64;
    let share = (x_mm.saturating_sub(from.along_mm) as f64 / span).clamp(0.0, 1.0);
    let (from, to) = (at(from.at), at(to.at));
    [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

/// Poses of the robot over time as JSON, each with a turn in degrees clockwise, the place where it
/// believed to be, and the places of the people; the ends of its rays at each; and people, rays,
/// and where it was and believed to be, as drawings. Empty for a run on a line.
fn poses(view: &View<'_>, pixels: &Pixels) -> (String, String, String) {
    let poses = view.trace.records.iter().filter_map(|it| match it {
        Record::Pose(it) => Some(it),
        _ => None,
    });
    let poses: Vec<_> = poses.collect();
    let every = poses.len().div_ceil(MOST).max(1);
    let last = poses.len().saturating_sub(1);
    let poses = poses.iter().enumerate().filter(|it| it.0 % every == 0 || it.0 == last);
    let sight = Sight::of(view);
    let mut rays = Vec::new();
    let (mut json, mut lines, mut count) = (Vec::new(), [Vec::new(), Vec::new()], 0);
    for (_, it) in poses {
        let told = it.believed.map_or(it.odometry_mm, |it| it.0);
        let [at, told] = [it.at_mm, told].map(|it| pixels.at(metres(it)).map(fixed));
        let turn = f64::from(-it.heading_mrad) * 0.18 / core::f64::consts::PI;
        let [x, y] = &at;
        let people = it.people_mm.iter().flat_map(|it| pixels.at(metres(*it)).map(fixed));
        let [told_x, told_y] = &told;
        let t_ms = (it.t_us / 1_000).to_string();
        let row = [t_ms, x.clone(), y.clone(), fixed(turn), told_x.clone(), told_y.clone()];
        rays.extend(sight.as_ref().map(|sight| sight.ends(it.at_mm, it.heading_mrad, pixels)));
        let row: Vec<_> = row.into_iter().chain(people).collect();
        json.push(format!("[{}]", row.join(",")));
        count = count.max(it.people_mm.len());
        let [driven, believed] = &mut lines;
        driven.push(at.join(","));
        believed.push(told.join(","));
    }
    if json.is_empty() {
        return Default::default();
    }
    let [driven, believed] = lines.map(|it| it.join(" "));
    let lines = format!(
        "<polyline class=\"believed\" points=\"{believed}\"><title>where the encoders say it \
         is</title></polyline><polyline class=\"driven\" points=\"{driven}\"><title>where it \
         drove</title></polyline>"
    );
    let radius = fixed(PERSON_M * pixels.scale);
    let person = format!(
        "<circle class=\"person\" visibility=\"hidden\" r=\"{radius}\"><title>a person, or a \
         thing on no map</title></circle>"
    );
    let moving = "<path class=\"rays\"><title>how far its devices could see</title></path>\
                  <circle class=\"told\" r=\"4\" visibility=\"hidden\"><title>where it believes to \
                  be</title></circle>";
    let lines = lines + moving + &person.repeat(count);
    (json.join(","), rays.join(","), lines)
}

/// Places of the robot over time, and the configurations that run: as JSON.
fn moments(view: &View<'_>) -> String {
    let every = view.samples.len().div_ceil(MOST).max(1);
    let last = view.samples.len().saturating_sub(1);
    let samples = view.samples.iter().enumerate();
    let samples = samples.filter(|it| it.0 % every == 0 || it.0 == last);
    let samples: Vec<_> = samples
        .map(|(_, it)| {
            let margins = (it.margins.duration_ms, it.margins.energy_mj);
            let t_ms = it.t_us / 1_000;
            format!("[{t_ms},{},{},{},{}]", it.x_mm, it.speed_mm_s, margins.0, margins.1)
        })
        .collect();
    let runs = view.trace.records.iter().filter_map(|it| match it {
        Record::Configuration(it) => {
            let name = it.configuration.as_deref().unwrap_or("");
            // No name of a file can end the script.
            let name = name.replace(['"', '\\', '<'], "?");
            Some(format!("[{},\"{name}\"]", it.t_us / 1_000))
        }
        _ => None,
    });
    let runs: Vec<_> = runs.collect();
    format!("\"samples\":[{}],\"runs\":[{}]", samples.join(","), runs.join(","))
}
