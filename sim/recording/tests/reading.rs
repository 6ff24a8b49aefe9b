//! Recordings of the delivery, read back.
#![allow(clippy::pedantic, clippy::unwrap_used, clippy::indexing_slicing)]

mod reader;

use cotama_models::missions::{Mission, embedded};
use cotama_recording::{NoRecording, csv, indicators, mcap, tum};
use cotama_sim::options::{Fidelity, Options};
use cotama_sim::trace::{Pose, Record, Trace};
use reader::{Cdr, File};
use std::sync::LazyLock;

fn record(fidelity: Fidelity) -> Trace {
    let delivery = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    let options = Options { fidelity, ..Options::default() };
    Trace::record(&mission, &options).unwrap().0
}

static PLANE: LazyLock<Trace> = LazyLock::new(|| record(Fidelity::Plane));
static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| mcap(&PLANE).unwrap());

/// The poses of a trace, each time once.
fn poses(trace: &Trace) -> Vec<Pose> {
    let poses = trace.records.iter().filter_map(|it| match it {
        Record::Pose(it) => Some(it.clone()),
        _ => None,
    });
    let mut poses: Vec<_> = poses.collect();
    poses.dedup_by_key(|it| it.t_us);
    poses
}

fn count(trace: &Trace, of: fn(&Record) -> bool) -> usize {
    trace.records.iter().filter(|it| of(it)).count()
}

#[test]
fn a_file_holds_a_message_for_each_record_and_pose_in_the_order_of_time() {
    let file = File::read(&FILE);
    let (poses, samples) =
        (poses(&PLANE).len(), count(&PLANE, |it| matches!(it, Record::Sample(_))));
    let of = |topic: &str| file.of(topic).count();
    for topic in ["/tf", "/pose", "/odom", "/scan", "/sonars", "/sonar_0", "/sonar_15"] {
        assert_eq!(of(topic), poses, "{topic}");
    }
    for topic in ["/battery", "/speed_m_s", "/power_w", "/margins/duration_s"] {
        assert_eq!(of(topic), samples, "{topic}");
    }
    assert_eq!(["/map", "/path", "/tf_static"].map(of), [1; 3]);
    let told = count(&PLANE, |it| matches!(it, Record::Failure(_) | Record::Diagnosis(_)));
    assert_eq!(of("/diagnostics"), told);
    let nets: usize = file.topics().filter(|it| it.starts_with("/supervisors/")).map(of).sum();
    assert_eq!(nets, count(&PLANE, |it| matches!(it, Record::Fired(_))));
    assert!(file.messages.is_sorted_by_key(|it| it.time_ns));
    assert_eq!(file.messages.last().unwrap().time_ns, PLANE.records.last().unwrap().t_us() * 1_000);
}

#[test]
fn its_index_leads_to_the_messages_that_a_reader_finds_without_it() {
    let file = File::read(&FILE);
    assert_eq!(File::read_by_index(&FILE).messages, file.messages);
    assert!(FILE.len() > 2 << 20, "more than one chunk: {}", FILE.len());
    assert_eq!(file.statistics, (file.messages.len() as u64, file.channels.len() as u32));
}

#[test]
fn transforms_lead_from_the_map_to_where_the_robot_was() {
    let file = File::read(&FILE);
    for (message, pose) in file.of("/tf").zip(poses(&PLANE)) {
        assert_eq!(message.time_ns, pose.t_us * 1_000);
        let mut cdr = Cdr::of(&message.data);
        assert_eq!(cdr.u32(), 2);
        let [first, second] = [(); 2].map(|()| {
            assert_eq!(
                u64::from(cdr.u32()) * 1_000_000_000 + u64::from(cdr.u32()),
                message.time_ns
            );
            let names = (cdr.text(), cdr.text());
            let [x, y, z, qx, qy, qz, qw] = [(); 7].map(|()| cdr.f64());
            assert_eq!([z, qx, qy], [0.0; 3]);
            (names, x, y, 2.0 * libm::atan2(qz, qw))
        });
        assert_eq!(first.0, ("map".into(), "odom".into()));
        assert_eq!(second.0, ("odom".into(), "base_link".into()));
        assert!(cdr.is_at_end());
        let (sin, cos) = libm::sincos(first.3);
        let x = first.1 + cos * second.1 - sin * second.2;
        let y = first.2 + sin * second.1 + cos * second.2;
        let turn = libm::remainder(first.3 + second.3, core::f64::consts::TAU);
        let true_mm = pose.at_mm.map(f64::from);
        let off =
            libm::remainder(turn - f64::from(pose.heading_mrad) / 1_000.0, core::f64::consts::TAU);
        assert!((x * 1_000.0 - true_mm[0]).abs() < 1e-6 && (y * 1_000.0 - true_mm[1]).abs() < 1e-6);
        assert!(off.abs() < 1e-9);
    }
}

#[test]
fn the_map_is_closed_around_the_robot_and_free_where_it_drove() {
    let file = File::read(&FILE);
    let message = file.of("/map").next().unwrap();
    let mut cdr = Cdr::of(&message.data);
    assert_eq!([(); 2].map(|()| cdr.u32()), [0; 2]);
    assert_eq!(cdr.text(), "map");
    assert_eq!([(); 2].map(|()| cdr.u32()), [0; 2]);
    assert_eq!(cdr.f32(), 0.05);
    let (width, height) = (cdr.u32() as usize, cdr.u32() as usize);
    assert_eq!([(); 7].map(|()| cdr.f64()), [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let cells = cdr.bytes();
    assert!(cdr.is_at_end());
    assert_eq!(cells.len(), width * height);
    let at = |x: usize, y: usize| cells[y * width + x];
    assert!((0..width).all(|x| at(x, 0) == 100 && at(x, height - 1) == 100));
    for pose in poses(&PLANE) {
        let [x, y] = pose.at_mm.map(|it| it as usize / 50);
        assert_eq!(at(x, y), 0, "{pose:?}");
    }
}

#[test]
fn a_map_of_the_largest_floor_has_wider_cells() {
    let mut trace = PLANE.clone();
    let floor = trace.header.floor.as_mut().unwrap();
    floor.text = "format = \"cotama-floor/1\"\nname = \"field\"\nsize_mm = [500_000, 500_000]\n\
                  [[wall]]\npoints_mm = [[0, 0], [500_000, 0]]\n"
        .into();
    let file = File::read(&mcap(&trace).unwrap());
    let mut cdr = Cdr::of(&file.of("/map").next().unwrap().data);
    let _stamp_and_frame = ([(); 2].map(|()| cdr.u32()), cdr.text(), [(); 2].map(|()| cdr.u32()));
    assert_eq!((cdr.f32(), cdr.u32(), cdr.u32()), (0.4, 1_250, 1_250));
    // A floor that cannot be read is refused.
    trace.header.floor.as_mut().unwrap().text.truncate(20);
    assert!(matches!(mcap(&trace), Err(NoRecording::Floor(_))));
}

#[test]
fn a_scan_sees_the_walls_of_the_corridor() {
    let file = File::read(&FILE);
    let mut cdr = Cdr::of(&file.of("/scan").next().unwrap().data);
    let _stamp = [(); 2].map(|()| cdr.u32());
    assert_eq!(cdr.text(), "laser");
    let [first, last, between] = [(); 3].map(|()| cdr.f32());
    assert!((first + 179.0 * between - last).abs() < 1e-4);
    assert_eq!([(); 4].map(|()| cdr.f32()), [0.0, 0.0, 0.02, 5.6]);
    let ranges: Vec<f32> = (0..cdr.u32()).map(|_| cdr.f32()).collect();
    assert_eq!((ranges.len(), cdr.u32(), cdr.is_at_end()), (180, 0, true));
    // It starts in the middle of a corridor of 4 m: its walls are 2 m to both sides.
    let aside = |angle: f32| ranges[((angle - first) / between).round() as usize];
    let right_angle = core::f32::consts::FRAC_PI_2;
    for angle in [-right_angle, right_angle] {
        assert!((aside(angle) - 2.0).abs() < 0.05, "{}", aside(angle));
    }
}

/// Three batteries of 12 V feed a computer and two motors.
#[test]
fn a_battery_tells_the_voltage_and_the_current_of_the_pose_beside_the_sample() {
    let file = File::read(&FILE);
    let known = poses(&PLANE);
    let told: Vec<_> = file
        .of("/battery")
        .skip(1) // before the first pose nothing is known
        .map(|message| {
            let mut cdr = Cdr::of(&message.data);
            let _stamp_and_frame = ([(); 2].map(|()| cdr.u32()), cdr.text());
            let [voltage, temperature, current] = [(); 3].map(|()| cdr.f32());
            assert!(temperature.is_nan() && (11.0..14.0).contains(&voltage), "{voltage}");
            [voltage, -current].map(|it| (it * 1_000.0).round() as u32)
        })
        .collect();
    assert!(told.len() > 400 && told.iter().any(|it| it[1] > 500));
    assert!(told.iter().all(|it| known.iter().any(|pose| pose.battery_mv_ma == Some(*it))));
}

#[test]
fn the_log_tells_the_seven_points() {
    let file = File::read(&FILE);
    let lines = file.of("/log").map(|it| {
        let mut cdr = Cdr::of(&it.data);
        let _stamp = (cdr.u32(), cdr.u32(), cdr.u8());
        (cdr.text(), cdr.text()).1
    });
    let lines: Vec<_> = lines.collect();
    let points = lines.iter().filter(|it| it.starts_with("point ") && !it.contains(", found"));
    let points: Vec<_> = { points }.filter(|it| it[..9].contains(": ")).collect();
    assert_eq!(points.len(), 7);
    assert_eq!(points[0], "point 1: the object is received");
    assert_eq!(points[1], "point 2: RT1: MCL, deadline missed again and again");
    assert_eq!(lines.last().unwrap(), "completed");
}

#[test]
fn the_same_run_gives_the_same_bytes_and_another_seed_another_noise() {
    assert!(*FILE == mcap(&record(Fidelity::Plane)).unwrap());
    let mut other = PLANE.clone();
    other.header.options.seed = 1;
    let differing = File::read(&mcap(&other).unwrap()).messages.into_iter();
    let differing = differing.zip(File::read(&FILE).messages).filter(|it| it.0 != it.1);
    let topics: std::collections::BTreeSet<_> = differing.map(|it| it.0.topic).collect();
    assert!(topics.iter().all(|it| it == "/scan" || it.starts_with("/sonar")), "{topics:?}");
}

#[test]
fn comma_separated_values_have_a_line_for_each_sample() {
    let text = csv(&PLANE);
    let lines: Vec<Vec<&str>> = text.lines().map(|it| it.split(',').collect()).collect();
    assert_eq!(lines.len(), 1 + count(&PLANE, |it| matches!(it, Record::Sample(_))));
    assert!(lines.iter().all(|it| it.len() == lines[0].len()));
    let last = lines.last().unwrap();
    let Record::End(end) = PLANE.records.last().unwrap() else { panic!("no end") };
    assert_eq!(last[1].replace('.', ""), end.x_mm.to_string());
}

#[test]
fn a_run_on_a_line_has_samples_and_no_poses() {
    let line = record(Fidelity::Line);
    assert_eq!(mcap(&line), Err(NoRecording::Line));
    assert_eq!(tum(&line), Err(NoRecording::Line));
    assert!(csv(&line).lines().skip(1).all(|it| it.contains(",,,,,,,,,")));
}

#[test]
fn poses_of_both_kinds_have_the_same_times() {
    let files = tum(&PLANE).unwrap();
    let times = |text: &str| -> Vec<String> {
        text.lines().map(|it| it.split(' ').next().unwrap().to_owned()).collect()
    };
    assert_eq!(times(&files.truth), times(&files.odometry));
    assert_eq!(times(&files.truth).len(), poses(&PLANE).len());
    for (line, pose) in files.truth.lines().zip(poses(&PLANE)) {
        let values: Vec<f64> = line.split(' ').map(|it| it.parse().unwrap()).collect();
        let mm = [1, 2].map(|it| (values[it] * 1_000.0).round() as i32);
        assert_eq!(mm, pose.at_mm);
        assert!((values[6] * values[6] + values[7] * values[7] - 1.0).abs() < 1e-8);
    }
}

#[test]
fn indicators_are_a_row_for_each_pose_before_the_goal_from_the_tenth_on() {
    let text = indicators(&PLANE).unwrap();
    let rows: Vec<Vec<f64>> = text.lines().skip(1).map(numbers).collect();
    let on_the_way = poses(&PLANE).iter().filter(|it| it.x_mm < 80_000).count();
    assert_eq!(rows.len(), on_the_way - 9);
    assert!(rows.iter().flatten().all(|it| it.is_finite()));
    // The robot has driven some of 80 m by then; it comes nearer to its goal, at up to 0.41 m/s.
    let lengths: Vec<_> = rows.iter().map(|it| it[3]).collect();
    assert!(lengths[0] < 80.0 && lengths[0] > 76.0, "{}", lengths[0]);
    assert!(lengths.windows(2).all(|it| it[1] < it[0] + 0.5));
    assert!(lengths.last().unwrap() < &1.0);
    assert_eq!(indicators(&PLANE).unwrap(), text);
    assert_eq!(indicators(&record(Fidelity::Line)), Err(NoRecording::Line));
}

fn numbers(line: &str) -> Vec<f64> {
    line.split(',').map(|it| it.parse().unwrap()).collect()
}
