//! Poses in the format of the TUM RGB-D benchmark.

use crate::messages::quaternion;
use crate::{NoRecording, told, true_pose};
use cotama_floor::Pose;
use cotama_sim::trace::{self, Record, Trace};
use std::fmt::Write;

/// Poses of a run as text: those that were, and those that odometry told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tum {
    /// Poses where the robot was.
    pub truth: String,
    /// The poses that its encoders told.
    pub odometry: String,
}

/// Returns the poses of a run as lines of `timestamp tx ty tz qx qy qz qw`, in seconds and metres:
/// the format of trajectories of Sturm et al., "A Benchmark for the Evaluation of RGB-D SLAM
/// Systems", IROS 2012, which evo reads.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::{Fidelity, Options};
/// use cotama_sim::trace::Trace;
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let options = Options { fidelity: Fidelity::Plane, ..Options::default() };
/// let (trace, _) = Trace::record(&mission, &options).unwrap();
/// let files = cotama_recording::tum(&trace).unwrap();
/// let start = "0.100000 4.000 2.000 0.000 0.000000000 0.000000000 0.000000000 1.000000000\n";
/// assert!(files.truth.starts_with(start) && files.odometry.starts_with(start));
/// ```
///
/// # Errors
/// [`NoRecording::Line`] for a run on a line.
pub fn tum(trace: &Trace) -> Result<Tum, NoRecording> {
    let mut files = Tum { truth: String::new(), odometry: String::new() };
    let mut last = None;
    for record in &trace.records {
        // Two at one time are the same, and times have to grow.
        let Record::Pose(it) = record else { continue };
        if last.replace(it.t_us) == Some(it.t_us) {
            continue;
        }
        line(&mut files.truth, it, &true_pose(it));
        line(&mut files.odometry, it, &told(it));
    }
    if last.is_none() { Err(NoRecording::Line) } else { Ok(files) }
}

fn line(text: &mut String, it: &trace::Pose, pose: &Pose) {
    let (s, us) = (it.t_us / 1_000_000, it.t_us % 1_000_000);
    let (at, [z, w]) = (pose.translation, quaternion(pose));
    // A zero has no sign, whatever the turn.
    let none = 0.0;
    let _ = writeln!(
        text,
        "{s}.{us:06} {:.3} {:.3} {none:.3} {none:.9} {none:.9} {:.9} {w:.9}",
        at.x,
        at.y,
        z + none
    );
}
