use super::*;
use crate::measured::{Measured, normal};
use cotama_devices::Streams;

fn promise(per_hour: f64) -> FalseAlarms {
    FalseAlarms::per_hour(per_hour).unwrap()
}

fn place(now: u64, along_m: f64, lateral_m: f64) -> Option<Sensed<OnPath>> {
    Some(Sensed { taken: Millis(now), value: OnPath { along_m, lateral_m } })
}

/// Sixty spells an hour of 2 s on average, driven through both observers of spells.
#[test]
fn robots_behind_and_waiting_alarm_as_often_as_promised() {
    let (tail, promise) = (Tail::new(0.0, 60.0, 2.0).unwrap(), promise(1.0));
    let mut luck = Streams::new(6).stream("spells");
    let mut backward = Backward::new(tail, 0.0, Millis(100), promise).unwrap();
    let mut progress = Progress::new(tail, 0.01, promise).unwrap();
    let (mut now, mut along) = (0, 0.0);
    // One decision per spell: a rate of 1 in 60.
    let [mut behind, mut waits] = [1.0 / 60.0; 2].map(Measured::of);
    for _ in 0..20_000 {
        let length = (-2_000.0 * libm::log(1.0 - luck.part())) as u64;
        let from = now;
        let mut raised = [false; 2];
        while now < from + length {
            now += 10;
            raised[0] |= backward.observe(place(now, along - 0.5, 0.0)) == Flag::Raised;
            raised[1] |= progress.observe(place(now, along, 0.0), true) == Flag::Raised;
        }
        for _ in 0..3 {
            now += 10;
            along += 0.1;
            backward.observe(place(now, along, 0.0));
            progress.observe(place(now, along, 0.0), true);
        }
        behind.decision(Flag::raised_if(raised[0]));
        waits.decision(Flag::raised_if(raised[1]));
    }
    behind.is_as_promised("backward");
    waits.is_as_promised("progress");
}

/// A robot beside its path, which the control law leads back, read with noise.
#[test]
fn converging_robots_alarm_as_often_as_promised() {
    let promise = promise(36.0); // 0.0198 per 2 s
    let mut noise = Streams::new(6).stream("lateral");
    let mut observer = Convergence::new(Millis(2_000), Millis(4_000), 0.02, promise).unwrap();
    let mut measured = Measured::of(promise.per_decision(Millis(2_000)));
    let mut real = 1.0_f64;
    observer.observe(place(0, 0.0, real));
    for window in 1..=50_000_u64 {
        real *= libm::exp(-0.5);
        let flag = observer.observe(place(window * 2_000, 0.0, real + 0.02 * normal(&mut noise)));
        measured.decision(flag);
        // Avoidance leads it aside, when no window is open.
        if real < 0.2 {
            real = 1.0;
            observer.restart();
            observer.observe(place(window * 2_000, 0.0, real + 0.02 * normal(&mut noise)));
        }
    }
    // Far from the path one of two sides can alarm: half of the promise.
    measured.is_as_computed("convergence", promise.per_decision(Millis(2_000)) / 2.0);
}

#[test]
fn obedient_robots_alarm_as_often_as_promised() {
    let promise = promise(36.0); // 0.00995 per s
    let times = [Millis(100), Millis(1_000)];
    let mut observer = Coherence::new([0.3, 1.7], [0.02, 0.05], times, promise).unwrap();
    let mut measured = Measured::of(promise.per_decision(Millis(1_000)));
    let mut noise = Streams::new(6).stream("motion");
    let mut speeds = [0.0_f64; 2];
    for period in 0..300_000_u64 {
        let told = if period / 50 % 2 == 0 { [0.3, 0.0] } else { [0.1, 0.4] };
        if period == 0 {
            speeds = told;
        }
        for (at, most) in [0.03, 0.17].into_iter().enumerate() {
            speeds[at] += (told[at] - speeds[at]).clamp(-most, most);
        }
        let [way, turn] = [0.02, 0.05].map(|it| it * normal(&mut noise));
        let value = Motion { told, measured: [speeds[0] + way, speeds[1] + turn] };
        let flag = observer.observe(Some(Sensed { taken: Millis(period * 100), value }));
        if period % 10 == 9 {
            measured.decision(flag);
        }
    }
    measured.is_as_promised("coherence");
}

#[test]
fn a_robot_that_does_not_converge_is_raised_on_either_side() {
    for side in [-1.0, 1.0] {
        let promise = promise(0.1);
        let mut observer = Convergence::new(Millis(2_000), Millis(4_000), 0.02, promise).unwrap();
        assert_eq!(observer.observe(place(0, 0.0, side * 0.5)), Flag::Clear);
        assert_eq!(observer.observe(place(1_900, 0.0, side * 0.5)), Flag::Clear);
        assert_eq!(observer.observe(place(2_000, 0.0, side * 0.5)), Flag::Raised);
        // To be nearer than the law says is no fault.
        assert_eq!(observer.observe(place(4_000, 0.0, 0.0)), Flag::Clear);
        // Through the path and out on the other side is.
        assert_eq!(observer.observe(place(6_000, 0.0, -side * 0.3)), Flag::Raised);
    }
}

#[test]
fn a_robot_that_is_led_back_is_raised_after_its_limit() {
    let tail = Tail::new(2.0, 6.0, 1.5).unwrap();
    let mut back = Backward::new(tail, 0.02, Millis(100), promise(0.01)).unwrap();
    assert_eq!(format!("{:.2}", back.limit_s()), "11.60");
    let mut flags = vec![];
    for step in 0..300_u64 {
        let time = step * 100;
        let along = if time < 5_000 { time as f64 * 3e-4 } else { 1.0 };
        flags.push(back.observe(place(time, along, 0.0)) == Flag::Raised);
    }
    // Behind since 4.9 s, when it was furthest; 11.6 s are more than 2 + 1.5 ln 600 = 11.595 s.
    assert_eq!(flags.iter().position(|it| *it), Some(165));
    back.restart();
    assert_eq!(back.observe(place(30_000, 0.0, 0.0)), Flag::Clear);
}

#[test]
fn an_old_place_adds_no_time() {
    let tail = Tail::new(2.0, 1.0, 1.0).unwrap();
    let mut back = Backward::new(tail, 0.0, Millis(100), promise(1.0)).unwrap();
    let mut progress = Progress::new(tail, 0.01, promise(1.0)).unwrap();
    back.observe(place(0, 1.0, 0.0));
    for _ in 0..1_000 {
        assert_eq!(back.observe(place(100, 0.0, 0.0)), Flag::Clear);
        assert_eq!(progress.observe(place(100, 0.0, 0.0), true), Flag::Clear);
    }
    assert_eq!(back.observe(None), Flag::Missing);
    assert_eq!(back.observe(place(200, f64::NAN, 0.0)), Flag::Missing);
}

#[test]
fn a_robot_that_is_told_to_stand_makes_no_progress_and_no_alarm() {
    let tail = Tail::new(2.0, 1.0, 1.0).unwrap();
    let mut progress = Progress::new(tail, 0.01, promise(1.0)).unwrap();
    for time in 0..100 {
        assert_eq!(progress.observe(place(time * 1_000, 0.0, 0.0), false), Flag::Clear);
    }
    let flags = [100, 101, 102].map(|it| progress.observe(place(it * 1_000, 0.0, 0.0), true));
    assert_eq!(flags, [Flag::Clear, Flag::Clear, Flag::Raised]);
}

#[test]
fn an_old_motion_counts_once() {
    let times = [Millis(100), Millis(1_000)];
    let mut observer = Coherence::new([0.3, 1.7], [0.02, 0.05], times, promise(0.1)).unwrap();
    let value = Motion { told: [0.3, 0.0], measured: [0.3, 5.0] };
    for _ in 0..100 {
        assert_eq!(observer.observe(Some(Sensed { taken: Millis(0), value })), Flag::Clear);
    }
    assert_eq!(observer.observe(None), Flag::Missing);
}

#[test]
fn a_wheel_that_turns_the_robot_aside_is_no_motion_that_was_told() {
    let times = [Millis(100), Millis(1_000)];
    let mut observer = Coherence::new([0.3, 1.7], [0.02, 0.05], times, promise(0.1)).unwrap();
    let mut raised = vec![];
    for period in 0..20_u64 {
        let value = Motion { told: [0.3, 0.0], measured: [0.3, 0.3] };
        let flag = observer.observe(Some(Sensed { taken: Millis(period * 100), value }));
        raised.push(flag == Flag::Raised);
    }
    assert_eq!(raised.iter().position(|it| *it), Some(9));
}
