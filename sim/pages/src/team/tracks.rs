//! Places of the robots of a team over time, in pixels of the drawing of their floor.

use crate::svg::fixed;
use cotama_floor::metres;
use cotama_floor::picture::Pixels;
use cotama_models::team::scenario::{Floor, Place, Scenario, Spot};
use cotama_sim::fleet::record::Record;

/// Moments are left out where a straight, even motion comes as near as this, in pixels.
const NEAR: f64 = 0.3;
/// The most moments that one straight, even motion stands for.
const MOST_ALIKE: usize = 200;

/// A robot at a moment: the time in ms, and the pixels.
pub(super) type Moment = (u64, [f64; 2]);

/// Returns the pixels of a spot.
pub(super) fn pixels_of(floor: &Floor, spot: Spot, pixels: &Pixels) -> Option<[f64; 2]> {
    floor.at_mm(spot).map(|it| pixels.at(metres(it)))
}

/// Returns the moments of a robot between which it moves evenly and straight on: along its path, so
/// that each corner is one.
pub(super) fn track(
    scenario: &Scenario,
    records: &[Record],
    robot: usize,
    pixels: &Pixels,
) -> Vec<Moment> {
    let floor = &scenario.floor;
    let Some(start) = scenario.robots.get(robot).map(|it| it.start) else { return Vec::new() };
    let (mut last, mut since) = (Spot::at(start), 0);
    let mut moments: Vec<Moment> = Vec::new();
    moments.extend(pixels_of(floor, last, pixels).map(|it| (0, it)));
    for record in records {
        let Record::At { t_ms, robot: of, from, to, done_mm } = *record else { continue };
        if of != robot {
            continue;
        }
        let spot = Spot { from: Place(from), to: Place(to), done_mm };
        let course = floor.course(last, spot);
        let whole = course.last().map_or(0, |it| it.0).max(1);
        for (way, at) in course {
            let after = t_ms.saturating_sub(since).saturating_mul(way) / whole;
            moments.push((since + after, pixels.at(metres(at))));
        }
        moments.extend(pixels_of(floor, spot, pixels).map(|it| (t_ms, it)));
        (last, since) = (spot, t_ms);
    }
    thinned(&moments)
}

/// Leaves out moments that lie between others, in place and in time.
fn thinned(moments: &[Moment]) -> Vec<Moment> {
    let mut kept: Vec<Moment> = moments.first().copied().into_iter().collect();
    let mut anchor = 0;
    while anchor + 1 < moments.len() {
        let end = moments.len().min(anchor + MOST_ALIKE);
        let mut next = anchor + 1;
        while next + 1 < end && is_even(&moments[anchor..=next + 1]) {
            next += 1;
        }
        kept.push(moments[next]);
        anchor = next;
    }
    kept
}

/// Whether an even, straight motion from the first moment to the last comes near all between them.
fn is_even(moments: &[Moment]) -> bool {
    let [first, between @ .., last] = moments else { return true };
    let span = last.0.saturating_sub(first.0) as f64;
    between.iter().all(|it| {
        let share = if span > 0.0 { (it.0 - first.0) as f64 / span } else { 0.0 };
        let off = |axis: usize| first.1[axis] + (last.1[axis] - first.1[axis]) * share - it.1[axis];
        off(0).abs() <= NEAR && off(1).abs() <= NEAR
    })
}

/// Returns the pixels of a robot at a time.
pub(super) fn at(track: &[Moment], t_ms: u64) -> [f64; 2] {
    let next = track.partition_point(|it| it.0 <= t_ms);
    let (Some(from), Some(to)) =
        (track.get(next.saturating_sub(1)), track.get(next).or(track.last()))
    else {
        return [0.0; 2];
    };
    let span = to.0.saturating_sub(from.0).max(1) as f64;
    let share = (t_ms.saturating_sub(from.0) as f64 / span).clamp(0.0, 1.0);
    [0, 1].map(|axis| from.1[axis] + (to.1[axis] - from.1[axis]) * share)
}

/// Returns a track as JSON.
pub(super) fn json(track: &[Moment]) -> String {
    let row = |(t_ms, at): &Moment| {
        let [x, y] = at.map(fixed);
        format!("[{t_ms},{x},{y}]")
    };
    format!("[{}]", track.iter().map(row).collect::<Vec<_>>().join(","))
}
