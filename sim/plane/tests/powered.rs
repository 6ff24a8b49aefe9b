//! Motors, batteries and faults of the drive, as laws.

#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]
#![allow(clippy::float_cmp)] // to the last bit

use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis};
use cotama_floor::{Bounds, Point, Pose, Segments};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::Robot;
use cotama_plane::{
    Battery, Command, Course, Defect, Disc, DriveFault, Drivetrain, Effect, Rover, Side, Slip,
    Vehicle,
};
use proptest::prelude::*;
use std::sync::LazyLock;

static DELIVERY: LazyLock<Course> = LazyLock::new(|| {
    let known = embedded::mission("delivery").unwrap();
    Course::of(&Mission::parse(known.name, known.text).unwrap(), 0).unwrap()
});

fn fault(defect: Defect) -> DriveFault {
    DriveFault::new(defect).unwrap()
}

/// A robot of the delivery with faults.
fn rover(faults: &[DriveFault]) -> Rover<'static> {
    let mut rover = Rover::new(&DELIVERY, 7);
    rover.set_drive_faults(faults).unwrap();
    rover
}

/// Drives for so many periods of a length.
fn go(rover: &mut Rover<'_>, periods: u64, ms: u64) {
    for _ in 0..periods {
        rover.go(MillimetresPerSecond(300), Millimetres(50_000), Millis(ms));
    }
}

fn body() -> cotama_models::robots::Body {
    Robot::shipped("p3dx-delivery").unwrap().body.unwrap()
}

fn hall() -> Segments {
    let bounds = Bounds { least: Point::new(-400.0, -400.0), most: Point::new(400.0, 400.0) };
    Segments::new(bounds, &[], &[]).unwrap()
}

fn mirrored(it: Effect) -> Effect {
    let swap = |[left, right]: [f64; 2]| [right, left];
    Effect { turns: swap(it.turns), grips: swap(it.grips), reads: swap(it.reads), ..it }
}

fn pair() -> impl Strategy<Value = [f64; 2]> {
    [0.0..=1.0, 0.0..=1.0]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_jammed_wheel_makes_the_robot_turn_about_it(
        commands in prop::collection::vec((-1.0_f64..1.0, -2.0_f64..2.0), 1..60),
        left: bool,
    ) {
        let (of, floor) = (Drivetrain::of(&body()), hall());
        let turns = if left { [0.0, 1.0] } else { [1.0, 0.0] };
        let wheel = Point::new(0.0, if left { 0.165 } else { -0.165 });
        let mut vehicle = Vehicle::new(Pose::identity());
        for (speed, turn) in commands {
            let effect = Effect { turns, ..Effect::default() };
            vehicle.step_under(&of, &floor, Command { speed, turn }, 0.1, &effect);
        }
        prop_assert!((vehicle.pose() * wheel - wheel).norm() < 1e-9);
        prop_assert_eq!(vehicle.counts(&of)[usize::from(!left)], 0);
    }

    #[test]
    fn faults_of_the_left_mirror_those_of_the_right(
        commands in prop::collection::vec((-1.0_f64..1.0, -2.0_f64..2.0), 1..60),
        (turns, grips, reads) in (pair(), pair(), pair()),
        most in 0.5_f64..20.0,
    ) {
        let (of, floor) = (Drivetrain::of(&body()), hall());
        let effect = Effect { turns, most, grips, reads };
        let mut both = [Vehicle::new(Pose::identity()), Vehicle::new(Pose::identity())];
        for (speed, turn) in commands {
            let [it, other] = &mut both;
            let step = it.step_under(&of, &floor, Command { speed, turn }, 0.1, &effect);
            let back = Command { speed, turn: -turn };
            let image = other.step_under(&of, &floor, back, 0.1, &mirrored(effect));
            prop_assert_eq!(step.turned, [image.turned[1], image.turned[0]]);
        }
        let [it, other] = &both;
        prop_assert_eq!(it.pose().translation.x, other.pose().translation.x);
        prop_assert_eq!(it.pose().translation.y, -other.pose().translation.y);
        let [left, right] = other.counts(&of);
        prop_assert_eq!(it.counts(&of), [right, left]);
    }

    /// And the energy that is drawn is the time integral of voltage times current: that of the
    /// load, as long as the battery is on.
    #[test]
    fn charge_falls_and_never_below_0(
        loads in prop::collection::vec((0.0_f64..500.0, 0.001_f64..200.0), 1..60),
        part in 0.0_f64..=1.0,
        dead in 0_u8..3,
    ) {
        let mut battery = Battery::of(&body().battery.unwrap()).charged(part);
        let full = battery.charge();
        let (mut drawn, mut asked, mut taken) = (0.0, 0.0, 0.0);
        for (watts, time) in loads {
            let before = battery;
            battery.draw(watts, time, dead);
            prop_assert!((0.0..=before.charge()).contains(&battery.charge()));
            prop_assert!(battery.energy() >= before.energy());
            prop_assert!(battery.is_off() || !before.is_off());
            drawn += battery.voltage() * battery.current() * time;
            taken += battery.current() * time;
            if !battery.is_off() {
                asked += watts * time;
                prop_assert!((battery.energy() - asked).abs() < 1e-6 * (1.0 + asked));
            }
        }
        prop_assert!((battery.energy() - drawn).abs() < 1e-6 * (1.0 + drawn));
        let lost = (full - battery.charge()) * 21.6 * 3_600.0;
        prop_assert!((lost - taken).abs() < 1e-6 * (1.0 + taken));
    }

    /// Steps of 10 ms, whatever the period of the loop.
    #[test]
    fn a_drive_with_faults_is_the_same_to_the_last_bit_in_periods_of_any_length(
        seed: u64,
        (least, more) in (0.0_f64..0.3, 0.0_f64..0.3),
        weak in 0.7_f64..1.0,
        (there, away) in (1_u64..2_000, 1_u64..2_000),
    ) {
        let slip = Slip { least, most: least + more, patch: None };
        let faults = [
            fault(Defect::Slip(slip)).intermittent(Millis(there), Millis(away)).unwrap(),
            fault(Defect::Weak(Side::Right, weak)).from(Millis(1_000)).until(Millis(2_000)),
        ];
        let run = |ms: u64| {
            let mut rover = Rover::new(&DELIVERY, seed);
            rover.set_drive_faults(&faults).unwrap();
            rover.power_hardware(20.0);
            go(&mut rover, 4_000 / ms, ms);
            (rover.signals(), *rover.pose())
        };
        let first = run(100);
        prop_assert_eq!(first, run(100));
        prop_assert_eq!(first, run(20));
    }
}

#[test]
fn a_lost_encoder_misleads_odometry_and_not_the_robot() {
    let at = |side| fault(Defect::EncoderDead(side)).from(Millis(2_000));
    let mut sound = rover(&[at(Side::Left).until(Millis(2_000))]); // never due
    let mut both = [Side::Left, Side::Right].map(|side| rover(&[at(side)]));
    go(&mut sound, 20, 100);
    let stopped = sound.signals().counts;
    go(&mut sound, 30, 100);
    both.iter_mut().for_each(|it| go(it, 50, 100));
    for (side, it) in both.iter().enumerate() {
        assert_eq!(it.pose(), sound.pose());
        let (counts, others) = (it.signals().counts, sound.signals().counts);
        assert_eq!((counts[side], counts[1 - side]), (stopped[side], others[1 - side]));
        let off = it.odometry().translation.vector - it.pose().translation.vector;
        assert!(off.norm() > 0.3, "{off}");
    }
    let mut lossy = rover(&[fault(Defect::EncoderLossy(Side::Left, 0.25))]);
    go(&mut lossy, 50, 100);
    let share = lossy.signals().counts[0] as f64 / sound.signals().counts[0] as f64;
    assert!(lossy.pose() == sound.pose() && (share - 0.75).abs() < 1e-4, "{share}");
}

#[test]
fn a_jammed_wheel_stalls_its_motor_alone_and_the_other_side_mirrors_it() {
    let run = |side| {
        let mut rover = rover(&[fault(Defect::Jam(side)).from(Millis(1_000))]);
        go(&mut rover, 13, 100);
        (rover.signals(), *rover.pose())
    };
    let ((left, at), (right, other)) = (run(Side::Left), run(Side::Right));
    let (motors, image) = (left.motors.unwrap(), right.motors.unwrap());
    assert_eq!((motors.stalled, motors.current_a[0]), ([true, false], 8.0));
    assert_eq!((image.stalled, image.current_a[1]), ([false, true], 8.0));
    assert!((motors.current_a[1] - image.current_a[0]).abs() < 1e-9);
    assert!(
        at.rotation.angle() > 0.1 && (at.rotation.angle() + other.rotation.angle()).abs() < 1e-9
    );
}

#[test]
fn a_robot_that_slips_on_a_patch_counts_a_way_that_it_does_not_go() {
    let slip = |patch| fault(Defect::Slip(Slip { least: 0.5, most: 0.5, patch }));
    let start = Rover::new(&DELIVERY, 7).pose().translation.vector.into();
    let far = Disc { centre: Point::new(-900.0, 0.0), radius: 1.0 };
    let near = Disc { centre: start, radius: 0.5 };
    let way = |patch| {
        let mut rover = rover(&[slip(patch)]);
        go(&mut rover, 60, 100);
        let gone = (rover.pose().translation.vector - start.coords).norm();
        (gone, (rover.odometry().translation.vector - start.coords).norm())
    };
    let [grips, slips, leaves] = [Some(far), None, Some(near)].map(way);
    assert!((grips.0 - grips.1).abs() < 1e-3 && (slips.0 * 2.0 - slips.1).abs() < 1e-3);
    assert!((slips.1 - grips.1).abs() < 1e-3);
    assert!((leaves.1 - leaves.0 - 0.5).abs() < 0.01, "{leaves:?}"); // half of twice 0.5 m
}

#[test]
fn voltage_sags_under_the_load_of_hardware_and_an_empty_battery_leaves_the_robot_standing() {
    let mut loaded = rover(&[]);
    loaded.power_hardware(120.0);
    loaded.go(MillimetresPerSecond(0), Millimetres(50_000), Millis(100));
    let it = loaded.signals().battery.unwrap();
    assert!((it.voltage_v * it.current_a - 120.0).abs() < 1e-9 && it.voltage_v < 12.91, "{it:?}");
    let mut rover = rover(&[]);
    rover.charge(0.000_5); // 39 C
    rover.power_hardware(60.0);
    go(&mut rover, 200, 100);
    let (it, at) = (rover.signals().battery.unwrap(), *rover.pose());
    assert!(it.is_off && it.charge < 0.000_5 && it.charge >= 0.0, "{it:?}");
    go(&mut rover, 20, 100);
    assert!(rover.stands() && *rover.pose() == at);
    assert_eq!(rover.signals().battery.unwrap().energy_j, it.energy_j);
}

#[test]
fn a_dead_cell_of_six_switches_a_lead_acid_robot_off() {
    let mut rover = rover(&[fault(Defect::DeadCell).from(Millis(3_000))]);
    go(&mut rover, 30, 100);
    assert!(!rover.signals().battery.unwrap().is_off && rover.pose().translation.x > 0.0);
    go(&mut rover, 2, 100);
    assert!(rover.signals().battery.unwrap().is_off && rover.stands());
}
