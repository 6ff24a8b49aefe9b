//! Indicators of a run in the plane.

use crate::ground::Ground;
use crate::{NoRecording, pose, told, true_pose};
use cotama_floor::{Held, Point, metres};
use cotama_indicators::{Moment, NoDrive, follow, to_csv};
use cotama_sim::trace::{LegText, Pose, Record, Trace};

/// The most poses that are followed.
pub const MAX_MOMENTS: usize = 50_000;

/// Returns the ten indicators of Rohrmueller 2011, table 4.1, at each pose of a run from the tenth
/// on, as comma-separated values ([`COLUMNS`](cotama_indicators::COLUMNS)); data for `cotama risk
/// discretise` and `coherence`. Poses are as far apart as samples, `monitor_period_ms`: 500 ms are
/// those of the thesis. Of more than [`MAX_MOMENTS`] it is every second, every third and so on.
///
/// A laser of 180° and 8 m reads at the recorded poses; the robot maps where it believed to be. A
/// robot that does not work that out itself believes what this laser tells. Its path is that of its
/// mission: traces hold no way round a person or a door.
///
/// # Errors
/// A [`NoRecording`]: for a run on a line, or one whose floor cannot be read or is too large.
pub fn indicators(trace: &Trace) -> Result<String, NoRecording> {
    let poses = trace.records.iter().filter(|it| matches!(it, Record::Pose(_))).count();
    if poses == 0 {
        return Err(NoRecording::Line);
    }
    let ground = Ground::of(&trace.header)?;
    let legs = legs(trace);
    let (mut speed, mut last, mut moments) = (0.0, None, Vec::new());
    for record in &trace.records {
        match record {
            // The pose of a sample follows it.
            Record::Sample(it) => speed = it.speed_mm_s as f64 / 1_000.0,
            // Two at one time are the same.
            Record::Pose(it) if last != Some(it.t_us) => {
                last = Some(it.t_us);
                moments.push(moment(it, speed, &legs));
            }
            _ => {}
        }
    }
    let moments: Vec<_> = moments.into_iter().step_by(poses.div_ceil(MAX_MOMENTS)).collect();
    let [real, charted] = [&ground.real, &ground.charted].map(Held::surface);
    let samples = follow(real, charted, &moments, trace.header.options.seed);
    let samples = samples.map_err(|it| match it {
        NoDrive::Large => NoRecording::Floor(it.to_string()),
        _ => NoRecording::Floor("it has no room for the robot where it began".to_owned()),
    })?;
    Ok(to_csv(&samples))
}

fn moment<'l>(it: &Pose, speed: f64, legs: &'l [Leg]) -> Moment<'l> {
    let x_m = it.x_mm as f64 / 1_000.0;
    let leg = legs.iter().find(|leg| it.x_mm < leg.end_mm);
    Moment {
        pose: true_pose(it),
        odometry: told(it),
        believed: it.believed.map(|(at_mm, heading_mrad)| pose(at_mm, heading_mrad)),
        path: leg.map_or(&[], |it| it.ahead_of(x_m)),
        speed,
        people: it.people_mm.iter().map(|at| metres(*at)).collect(),
    }
}

/// The way from one place of a mission to the next.
struct Leg {
    /// Its end, along the path.
    end_mm: u64,
    /// Its corners, and how far along the path each is.
    points: Vec<Point>,
    along_m: Vec<f64>,
}

impl Leg {
    /// The corners beyond so much of the path; the last one is.
    fn ahead_of(&self, x_m: f64) -> &[Point] {
        let passed = self.along_m.iter().filter(|it| **it <= x_m).count();
        let last = self.points.len().saturating_sub(1);
        self.points.get(passed.min(last)..).unwrap_or_default()
    }
}

fn legs(trace: &Trace) -> Vec<Leg> {
    let mut end_mm = 0_u64;
    let mut leg = |it: &LegText| {
        let mut along = end_mm as f64 / 1_000.0;
        end_mm = end_mm.saturating_add(it.length_mm);
        let points: Vec<_> = it.points_mm.iter().map(|at| metres(*at)).collect();
        let mut last = points.first().copied();
        let along_m = points.iter().map(|at| {
            along += last.map_or(0.0, |it| (at - it).norm());
            last = Some(*at);
            along
        });
        Leg { end_mm, along_m: along_m.collect(), points }
    };
    trace.header.floor.iter().flat_map(|it| &it.legs).map(&mut leg).collect()
}
