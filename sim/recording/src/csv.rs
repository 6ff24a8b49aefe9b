//! A run as comma-separated values.

use cotama_sim::trace::{Pose, Record, Trace};
use std::fmt::Write;

/// The columns of [`csv`].
pub const COLUMNS: &str = "t_s,x_m,speed_m_s,used_s,used_j,margin_s,margin_j,planned_power_w,\
    real_power_w,true_x_m,true_y_m,true_heading_rad,odometry_x_m,odometry_y_m,\
    odometry_heading_rad,battery_v,battery_a,configuration";

/// Returns a run as comma-separated values: a heading, and a line for each sample, with the
/// configuration that runs. Numbers are as exact as in the trace. Poses and battery are empty where
/// the robot had none at that time, as on a line.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::options::Options;
/// use cotama_sim::trace::Trace;
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let (trace, _) = Trace::record(&mission, &Options::default()).unwrap();
/// let csv = cotama_recording::csv(&trace);
/// assert!(csv.starts_with("t_s,x_m,speed_m_s,"));
/// assert!(csv.lines().skip(1).all(|it| it.ends_with(",,,,,,,,,"))); // on a line, unsupervised
/// ```
pub fn csv(trace: &Trace) -> String {
    let mut poses = trace.records.iter().filter_map(|it| match it {
        Record::Pose(it) => Some(it),
        _ => None,
    });
    let mut text = format!("{COLUMNS}\n");
    let mut pose: Option<&Pose> = poses.next();
    let mut configuration = String::new();
    for record in &trace.records {
        match record {
            Record::Configuration(it) => {
                configuration = it.configuration.as_deref().map_or_else(String::new, quoted);
            }
            Record::Sample(it) => {
                while pose.is_some_and(|pose| pose.t_us < it.t_us) {
                    pose = poses.next();
                }
                let _ = write!(text, "{}.{:06}", it.t_us / 1_000_000, it.t_us % 1_000_000);
                let numbers: [i128; 8] = [
                    it.x_mm.into(),
                    it.speed_mm_s.into(),
                    it.used.duration_ms.into(),
                    it.used.energy_mj.into(),
                    it.margins.duration_ms.into(),
                    it.margins.energy_mj.into(),
                    it.planned_power_mw.into(),
                    it.real_power_mw.into(),
                ];
                numbers.into_iter().for_each(|it| thousandths(&mut text, it));
                match pose.filter(|pose| pose.t_us == it.t_us) {
                    Some(it) => {
                        let [x, y] = it.at_mm;
                        let [told_x, told_y] = it.odometry_mm;
                        for it in [x, y, it.heading_mrad, told_x, told_y, it.odometry_mrad] {
                            thousandths(&mut text, it.into());
                        }
                        match it.battery_mv_ma {
                            Some(it) => {
                                it.into_iter().for_each(|it| thousandths(&mut text, it.into()));
                            }
                            None => text += ",,",
                        }
                    }
                    None => text += ",,,,,,,,",
                }
                let _ = writeln!(text, ",{configuration}");
            }
            _ => {}
        }
    }
    text
}

/// Writes a comma, and a number of thousandths as a decimal fraction.
fn thousandths(text: &mut String, it: i128) {
    let sign = if it < 0 { "-" } else { "" };
    let it = it.unsigned_abs();
    let _ = write!(text, ",{sign}{}.{:03}", it / 1_000, it % 1_000);
}

/// Returns a field, quoted where it must be (RFC 4180).
fn quoted(it: &str) -> String {
    if it.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", it.replace('"', "\"\""))
    } else {
        it.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_below_zero_keep_their_sign_and_names_their_commas() {
        let mut text = String::new();
        [-7, -1_234, 0, 60_005].into_iter().for_each(|it| thousandths(&mut text, it));
        assert_eq!(text, ",-0.007,-1.234,0.000,60.005");
        assert_eq!(quoted("a,\"b\""), "\"a,\"\"b\"\"\"");
    }
}
