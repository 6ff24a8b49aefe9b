//! The people whom a mission names, as they walk over its floor.

use cotama_core::units::{MillimetresPerSecond, Millis};
use cotama_devices::{Goes, Habits, Routes, SettingsError, Walker};
use cotama_floor::{PERSON_RADIUS_M, Path, Point, metres};
use cotama_models::missions::{self, Leg};

/// Returns a person who walks as a mission says.
pub(crate) fn walker(of: &missions::Walker) -> Result<Walker, SettingsError> {
    let usual = Habits::default();
    let speed_m_s = of.speed.map(|MillimetresPerSecond(it)| it as f64 / 1_000.0);
    let habits = Habits {
        radius_m: PERSON_RADIUS_M,
        speed_m_s: speed_m_s.map_or(usual.speed_m_s, |it| it..=it),
        stays: of.stays.map_or(usual.stays, |it| it..=it),
        stops: 0.0,
        patience: if of.gives_way { usual.patience } else { Millis(u64::MAX) },
        ..usual
    };
    let goes = Goes::round(habits, routes(&of.ways)?)?;
    Ok(Walker { name: of.id.clone(), goes: goes.into(), from: of.from })
}

/// Returns the ways of a round; back on the same one.
fn routes(ways: &[Leg]) -> Result<Routes, SettingsError> {
    let ends = ways.iter().filter_map(|it| it.points.last());
    let places: Vec<Point> = ends.map(|it| metres(*it)).collect();
    Routes::by(&places, |from, to| {
        let path = |it: &Leg| {
            let points: Vec<_> = it.points.iter().map(|it| metres(*it)).collect();
            let is_between =
                |points: &[Point]| points.first() == Some(&from) && points.last() == Some(&to);
            if is_between(&points) {
                return Path::new(points);
            }
            let back: Vec<_> = points.into_iter().rev().collect();
            if is_between(&back) { Path::new(back) } else { None }
        };
        ways.iter().find_map(path)
    })
}
