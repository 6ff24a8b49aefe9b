//! Indicators of a run that was made elsewhere, and recorded.

use crate::no_drive::NoDrive;
use crate::sample::{OfPath, Sample};
use crate::watch::{Watch, chart};
use cotama_core::units::Millis;
use cotama_devices::{Disc, Scene};
use cotama_floor::{Needs, Planner, Point, Pose, Surface};
use cotama_streams::Streams;

/// Radius of a person, in metres.
const PERSON_M: f64 = 0.25;

/// A moment of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Moment<'p> {
    /// Position of the robot.
    pub pose: Pose,
    /// Position by its odometry.
    pub odometry: Pose,
    /// Position that it believes in, if it works that out itself.
    pub believed: Option<Pose>,
    /// Corners of its path that are before it, the last of which is its goal; none after the last
    /// goal.
    pub path: &'p [Point],
    /// Speed, in metres a second.
    pub speed: f64,
    /// People around it.
    pub people: Vec<Point>,
}

/// Samples the indicators of a run at each of its moments with a goal, as [`drive`](crate::drive)
/// does on the way: a laser reads where the robot was, and it localises itself and maps by that.
///
/// ```
/// use cotama_floor::{Point, Pose, Version};
/// use cotama_indicators::{Moment, SIDEWALK, follow};
/// let floor = SIDEWALK.floor().unwrap();
/// let [real, known] = [Version::Real, Version::Charted].map(|it| floor.surface(it, &[]).unwrap());
/// let path = [Point::new(30.0, 3.0)];
/// let moment = |at: u32| {
///     let pose = Pose::new([5.0 + 0.25 * f64::from(at), 3.0].into(), 0.0);
///     let believed = Some(pose);
///     Moment { pose, odometry: pose, believed, path: &path, speed: 0.5, people: Vec::new() }
/// };
/// let samples = follow(&real, &known, &(0..12).map(moment).collect::<Vec<_>>(), 1).unwrap();
/// assert_eq!(samples.len(), 3); // the first has the variance of ten
/// assert_eq!((samples[0].0[3], samples[0].0[8]), (22.75, 0.5)); // metres left, speed
/// ```
///
/// # Errors
/// When the floor is too large, or has no room for the robot where it began.
pub fn follow(
    real: &dyn Surface,
    charted: &dyn Surface,
    moments: &[Moment<'_>],
    seed: u64,
) -> Result<Vec<Sample>, NoDrive> {
    let Some(first) = moments.first() else { return Ok(Vec::new()) };
    let planner = Planner::new(charted, Needs { cell_m: 0.2, ..Needs::default() });
    let planner = planner.map_err(|_| NoDrive::Large)?;
    let (chart, streams) = (chart(charted)?, Streams::new(seed));
    // Each moment has a scan, so that time counts them.
    let mut watch = Watch::new(&chart, &charted.bounds(), Millis(1), &first.odometry, streams)?;
    let mut goal = None;
    let mut samples = Vec::new();
    for (now, it) in (0..).map(Millis).zip(moments) {
        let person = |at: &Point| Disc { centre: *at, radius: PERSON_M };
        let people: Vec<_> = it.people.iter().map(person).collect();
        watch.sense(now, &it.pose, &it.odometry, it.believed.as_ref(), &Scene::of(real, &people));
        let believed = it.believed.unwrap_or_else(|| watch.localiser.pose_at(&it.odometry));
        if goal != it.path.last() {
            goal = it.path.last();
            watch.set_out();
        }
        if goal.is_some() {
            let at = Point::from(believed.translation.vector);
            let ahead: Vec<_> = [at].iter().chain(it.path).copied().collect();
            let of_path = OfPath::new(&ahead, &believed, planner.room());
            samples.extend(watch.sample(&of_path, &believed, it.speed));
        }
    }
    Ok(samples)
}
