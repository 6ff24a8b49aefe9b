//! A run as MCAP.

use crate::container::Container;
use crate::ground::Ground;
use crate::messages::{self, Level, Message};
use crate::schema::schema;
use crate::sensors::Sensors;
use crate::{NoRecording, told, true_pose};
use cotama_devices::SettingsError;
use cotama_floor::Pose;
use cotama_sim::trace::supervised::{Configured, Diagnosis, Failure, Status};
use cotama_sim::trace::{self, Record, Sample, Trace, Used};

/// The most poses at which sensors read: of more it is every second, every third and so on.
pub const MAX_SCANS: usize = 50_000;

impl From<SettingsError> for NoRecording {
    fn from(it: SettingsError) -> Self {
        Self::Sensors(it.to_string())
    }
}

/// Returns a run as an MCAP file of ROS 2 messages that Foxglove, Lichtblick and PlotJuggler draw.
/// Times are those of the run, from 0.
///
/// | topic | type | at |
/// | --- | --- | --- |
/// | `/map`, `/path` | `OccupancyGrid`, `Path` | the start |
/// | `/tf_static` | `TFMessage` | the start: the laser and the sonars on the robot |
/// | `/tf` | `TFMessage` | each pose: `map` to `odom` to `base_link` |
/// | `/pose`, `/odom` | `PoseWithCovarianceStamped` | each pose: the true one, that of odometry |
/// | `/scan`, `/sonars`, `/sonar_N` | `LaserScan`, `MarkerArray`, `Range` | each pose |
/// | `/battery` | `BatteryState` | each sample: voltage, current, part of the energy limit left |
/// | `/speed_m_s`, `/power_w`, `/margins/..` | `Float64` | each sample |
/// | `/diagnostics` | `DiagnosticArray` | each failure and diagnosis |
/// | `/supervisors/NET` | `String` | each firing: the place that the net is in |
/// | `/configuration` | `String` | each change: the modules that run, and who decides |
/// | `/log` | `Log` | plans, activities, the points of the story, the end |
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::{Fidelity, Options};
/// use cotama_sim::trace::Trace;
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let options = Options { fidelity: Fidelity::Plane, ..Options::default() };
/// let (trace, _) = Trace::record(&mission, &options).unwrap();
/// let file = cotama_recording::mcap(&trace).unwrap();
/// assert!(file.starts_with(b"\x89MCAP0\r\n") && file.ends_with(b"\x89MCAP0\r\n"));
/// ```
///
/// # Errors
/// A [`NoRecording`]: for a run on a line, or one whose floor cannot be read.
pub fn mcap(trace: &Trace) -> Result<Vec<u8>, NoRecording> {
    let poses = trace.records.iter().filter(|it| matches!(it, Record::Pose(_))).count();
    if poses == 0 {
        return Err(NoRecording::Line);
    }
    let ground = Ground::of(&trace.header)?;
    let mut sensors = Sensors::new(trace.header.options.seed)?;
    let version = format!("cotama {}", trace.header.version);
    let mut file = File(Container::new("ros2", &version));
    file.fixed(&ground, &sensors);
    let every = poses.div_ceil(MAX_SCANS);
    let mut number = 0;
    let mut last = None;
    let mut lines = crate::log::lines(trace).into_iter().peekable();
    let mut battery = None;
    for (at, record) in trace.records.iter().enumerate() {
        let t_us = record.t_us();
        while let Some(it) = lines.next_if(|it| it.t_us <= t_us) {
            file.put("/log", it.t_us, &messages::log(it.t_us, it.weight, &it.text));
        }
        match record {
            Record::Sample(it) => {
                // The pose of a sample follows it.
                if let Some(Record::Pose(next)) = trace.records.get(at + 1) {
                    battery = next.battery_mv_ma;
                }
                file.sample(it, trace.header.limits, battery);
            }
            // Two at one time are the same.
            Record::Pose(it) if last != Some(t_us) => {
                last = Some(t_us);
                if number % every == 0 {
                    file.pose(it, &ground, &mut sensors);
                }
                number += 1;
            }
            Record::Fired(it) => {
                let net = |it: char| if it.is_ascii_alphanumeric() { it } else { '_' };
                let net: String = it.net.chars().map(net).collect();
                file.put(&format!("/supervisors/{net}"), t_us, &messages::text(&it.place));
            }
            Record::Failure(it) => file.put("/diagnostics", t_us, &failure(it)),
            Record::Diagnosis(it) => file.put("/diagnostics", t_us, &diagnosis(it)),
            Record::Configuration(it) => file.put("/configuration", t_us, &configuration(it)),
            Record::Status(it) => file.put("/status", t_us, &status(it)),
            _ => {}
        }
    }
    Ok(file.0.finish())
}

/// A file with topics.
struct File(Container);

impl File {
    fn put(&mut self, topic: &str, t_us: u64, it: &Message) {
        self.0.message(topic, it.kind, schema, t_us.saturating_mul(1_000), &it.data);
    }

    /// Writes all that does not change.
    fn fixed(&mut self, ground: &Ground, sensors: &Sensors) {
        self.put("/map", 0, &messages::map(0, "map", &ground.raster()));
        self.put("/path", 0, &messages::path(0, "map", &ground.path));
        let names: Vec<_> = (0..sensors.sonar_mounts().len()).map(sonar).collect();
        let mounts = names.iter().zip(sensors.sonar_mounts());
        let mounts = mounts.map(|(name, mount)| ("base_link", name.as_str(), *mount));
        let laser = ("base_link", "laser", sensors.laser_mount);
        let all: Vec<_> = std::iter::once(laser).chain(mounts).collect();
        self.put("/tf_static", 0, &messages::transforms(0, &all));
    }

    fn pose(&mut self, it: &trace::Pose, ground: &Ground, sensors: &mut Sensors) {
        let (t_us, truth, odometry) = (it.t_us, true_pose(it), told(it));
        let origin: Pose = truth * odometry.inverse();
        let frames = [("map", "odom", origin), ("odom", "base_link", odometry)];
        self.put("/tf", t_us, &messages::transforms(t_us, &frames));
        self.put("/pose", t_us, &messages::pose(t_us, "map", &truth));
        self.put("/odom", t_us, &messages::pose(t_us, "odom", &odometry));
        let (scan, cones) = sensors.sense(&truth, ground.real.surface());
        let scan = messages::scan(t_us, "laser", &sensors.laser, sensors.laser_m, &scan);
        self.put("/scan", t_us, &scan);
        self.put("/sonars", t_us, &messages::cones(t_us, "base_link", &cones));
        for (number, cone) in cones.iter().enumerate() {
            let name = sonar(number);
            self.put(&format!("/{name}"), t_us, &messages::range(t_us, &name, cone));
        }
    }

    fn sample(&mut self, it: &Sample, limits: Used, known: Option<[u32; 2]>) {
        let left = 1.0 - it.used.energy_mj as f64 / limits.energy_mj.max(1) as f64;
        let battery = messages::battery(it.t_us, "base_link", left.clamp(0.0, 1.0), known);
        self.put("/battery", it.t_us, &battery);
        let numbers = [
            ("/speed_m_s", it.speed_mm_s as f64),
            ("/power_w", it.real_power_mw as f64),
            ("/margins/duration_s", it.margins.duration_ms as f64),
            ("/margins/energy_j", it.margins.energy_mj as f64),
        ];
        for (topic, thousandths) in numbers {
            self.put(topic, it.t_us, &messages::number(thousandths / 1_000.0));
        }
    }
}

/// Returns the name of a sonar, of its frame and its topic.
fn sonar(number: usize) -> String {
    format!("sonar_{number}")
}

fn failure(it: &Failure) -> Message {
    let values = [("failure", it.failure.to_string()), ("during", it.during.clone())];
    let text = it.what.as_deref().unwrap_or(&it.mode);
    messages::diagnostics(it.t_us, Level::Error, [&it.mode, text], &values)
}

fn diagnosis(it: &Diagnosis) -> Message {
    let failures: Vec<_> = it.failures.iter().map(u16::to_string).collect();
    let values = [
        ("failures", failures.join(", ")),
        ("flags", it.flags.join(", ")),
        ("candidates", it.candidates.join(", ")),
        ("severity", it.severity.name().to_owned()),
        ("by severity", it.by_severity.name().to_owned()),
        ("by availability", it.by_availability.name().to_owned()),
    ];
    let report = it.report.as_deref().unwrap_or("recorded only");
    messages::diagnostics(it.t_us, Level::Warn, ["diagnosis", report], &values)
}

fn status(it: &Status) -> Message {
    let (lost, without) = (it.lost.join(", "), it.without.join(", "));
    let values = [("lost", lost), ("without it", without)];
    messages::diagnostics(it.t_us, Level::Warn, ["status", "modules"], &values)
}

fn configuration(it: &Configured) -> Message {
    let runs = it.configuration.as_deref().unwrap_or("none");
    messages::text(&format!("{runs}, {}", it.mode.name()))
}
