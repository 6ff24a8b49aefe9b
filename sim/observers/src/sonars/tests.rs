use super::*;
use crate::measured::interval;
use cotama_devices::{Fault, Mode, Ring, RingSettings, Scene, Stream, Streams};
use cotama_floor::{Point, Pose, Segments, Surface, Version, embedded};

fn read(taken: u64, value: f64) -> Option<Sensed<f64>> {
    Some(Sensed { taken: Millis(taken), value })
}

/// One sonar with a limit of 1 m.
fn one() -> FarSonars {
    let mut all = [Far::new(f64::INFINITY); MAX_SONARS];
    all[0] = Far::new(1.0);
    FarSonars { range_m: 5.0, sonars: all }
}

#[test]
fn a_robot_that_stands_learns_nothing_of_a_far_sonar() {
    let mut far = one();
    for at in 0..1_000 {
        assert_eq!(far.observe(&[read(at * 100, 5.0)], 7.0), Flag::Clear);
    }
}

#[test]
fn an_old_reading_counts_for_no_way() {
    let mut far = one();
    for step in 0..100 {
        assert_eq!(far.observe(&[read(500, 5.0)], f64::from(step)), Flag::Clear);
    }
    assert_eq!(far.observe(&[None], 100.0), Flag::Missing);
}

#[test]
fn a_nearer_reading_ends_the_spell() {
    let mut far = one();
    let ways = [(0, 5.0, 0.0), (1, 5.0, 0.9), (2, 4.99, 1.0), (3, 5.0, 1.9), (4, 5.0, 2.1)];
    let flags = ways.map(|(taken, value, way)| far.observe(&[read(taken, value)], way));
    assert_eq!(flags[..4], [Flag::Clear; 4]);
    assert_eq!(flags[4], Flag::Raised); // 0.9 m and 0.2 m since the near one at 1.0 m
}

#[test]
fn a_reading_that_is_no_number_ends_no_spell() {
    let mut far = one();
    let ways = [(0, 5.0, 0.0), (1, f64::NAN, 0.9), (2, f64::INFINITY, 1.1)];
    let flags = ways.map(|(taken, value, way)| far.observe(&[read(taken, value)], way));
    assert_eq!(flags, [Flag::Clear, Flag::Clear, Flag::Raised]);
}

/// A robot that goes ahead where there is room, else turns aside.
struct Wanderer {
    pose: Pose,
    way: f64,
    now: u64,
    turns: u32,
    luck: Stream,
}

impl Wanderer {
    fn new(seed: u64) -> Self {
        let pose = Pose::new(Point::new(12.0, 10.0).coords, 0.3);
        Self { pose, way: 0.0, now: 0, turns: 0, luck: Streams::new(seed).stream("wanderer") }
    }

    /// Goes on by 100 ms; returns whether it moved ahead.
    fn step(&mut self, floor: &Segments) -> bool {
        self.now += 100;
        if self.turns > 0 {
            self.turns -= 1;
            self.pose *= Pose::rotation(0.1);
            return false;
        }
        let turn = 0.02 * (self.luck.part() - 0.5);
        let next = self.pose * Pose::new([0.03, 0.0].into(), turn);
        if floor.clearance(next.translation.vector.into(), 0.4) < 0.35 {
            self.turns = 5 + self.luck.below(40) as u32;
            return false;
        }
        self.pose = next;
        self.way += 0.03;
        true
    }
}

/// Drives over the office for some hours.
fn drive(seed: u64, hours: u64, ring: &mut Ring, mut each: impl FnMut(&Ring, &Wanderer, bool)) {
    let office = embedded::OFFICE.floor().unwrap();
    let floor = office.surface(Version::Real, &[]).unwrap();
    let mut robot = Wanderer::new(seed);
    while robot.now < hours * 3_600_000 {
        let moves = robot.step(&floor);
        ring.sense(Millis(robot.now), &robot.pose, &Scene::of(&floor, &[]));
        each(ring, &robot, moves);
    }
}

fn ring(seed: u64) -> Ring {
    let settings = RingSettings::pioneer().all_at_once(Millis(100));
    Ring::new(&settings, &Streams::new(seed), "sonar").unwrap()
}

fn surveyed(hours: u64) -> SonarSurvey {
    let mut survey = SonarSurvey::new(5.0, 2.0).unwrap();
    drive(1, hours, &mut ring(1), |ring, robot, moves| {
        let Some(readings) = ring.latest(Millis(robot.now)) else { return };
        survey.look(readings, robot.way, Millis(if moves { 100 } else { 0 }));
    });
    survey
}

/// A survey of an hour in the office holds its promise over the next hours, and a sonar that hears
/// nothing is found.
#[test]
fn a_survey_of_the_office_holds_over_other_ways_there() {
    let (survey, promise) = (surveyed(1), FalseAlarms::per_hour(20.0).unwrap());
    let mut far = FarSonars::new(&survey, 16, promise).unwrap();
    let limits: Vec<_> = (0..16).map(|it| format!("{:.1}", far.limit_m(it).unwrap())).collect();
    let (mut alarms, mut before, mut moved) = (0, 0, 0);
    drive(2, 3, &mut ring(2), |ring, robot, moves| {
        let Some(readings) = ring.latest(Millis(robot.now)) else { return };
        far.observe(readings, robot.way);
        alarms += u64::from((far.far() & !before).count_ones());
        before = far.far();
        moved += u64::from(moves);
    });
    let [low, high] = interval(alarms, moved).map(|it| it * 36_000.0);
    let hours = moved as f64 / 36_000.0;
    println!(
        "limits {limits:?} m; promised 20/h; {alarms} in {hours:.2} h [{low:.1}, {high:.1}]/h"
    );
    assert!(high <= 20.0, "{alarms} alarms in {hours} h");
    // The fourth sonar hears nothing from a minute on.
    let (mut ring, mut found) = (ring(3), None);
    let deaf = Fault::new(Mode::Stuck(5.0)).unwrap().from(Millis(60_000));
    ring.set_faults(3, &[deaf], &Streams::new(3), "sonar").unwrap();
    let mut far = FarSonars::new(&survey, 16, promise).unwrap();
    let mut began = 0.0;
    drive(3, 1, &mut ring, |ring, robot, _| {
        let Some(readings) = ring.latest(Millis(robot.now)) else { return };
        far.observe(readings, robot.way);
        if robot.now <= 60_000 {
            began = robot.way;
        }
        if found.is_none() && far.far() & 0b1000 != 0 {
            found = Some(robot.way - began);
        }
    });
    let way = found.unwrap();
    println!("sonar 3 is found after {way:.2} m");
    assert!(way <= far.limit_m(3).unwrap() + 0.1);
}
