//! Likelihoods of one beam, worked out by hand: a wall at x = 5 m, and a robot at 2.05 m that all
//! particles agree on, so that the mean likelihood is that of the beam.
#![allow(clippy::unwrap_used)]

use core::f64::consts::PI;
use cotama_floor::{Bounds, Kind, Point, Pose, Segment, Segments, Vector};
use cotama_localisation::{Chart, Localiser, Model, Parameters, Sensor};
use cotama_streams::Streams;
use nalgebra::Matrix3;

fn hall() -> Segments {
    let bounds = Bounds { least: Point::new(0.0, 0.0), most: Point::new(10.0, 6.0) };
    let ends = [[5.0, 0.0], [5.0, 6.0]].map(Point::from);
    Segments::new(bounds, &[Segment { from: ends[0], to: ends[1], kind: Kind::Wall }], &[]).unwrap()
}

fn start(heading: f64) -> Pose {
    Pose::new(Vector::new(2.05, 3.05), heading)
}

/// The likelihood of a reading, with Nav2's defaults.
fn likelihood(model: Model, sensor: &Sensor, heading: f64, ranges: &[f64]) -> f64 {
    let parameters = Parameters { laser_model_type: model, ..Parameters::default() };
    let chart = Chart::new(&hall(), 0.1, sensor, &parameters).unwrap();
    let mut localiser = Localiser::new(&chart, &Streams::new(1), "robot");
    localiser.start_at(&start(heading), &Matrix3::zeros()).unwrap();
    assert!(localiser.update(&Pose::identity(), ranges));
    localiser.estimate().likelihood
}

/// One ray straight ahead that sees 8 m.
fn ray() -> Sensor {
    Sensor::laser(&Pose::identity(), PI, 1, 8.0).unwrap()
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-6, "{found}, expected {expected}");
}

/// 2.7 m end at x = 4.75 m, the centre of a cell that is 0.25 m from the wall:
/// p = 0.5 exp(-0.25² / (2 · 0.2²)) + 0.5 / 8.
const FIELD: f64 = 0.291_416_480_5;

#[test]
fn a_beam_in_a_likelihood_field_counts_as_the_cube_of_its_likelihood() {
    let found = likelihood(Model::LikelihoodField, &ray(), 0.0, &[2.7]);
    assert_near(found, 1.0 + FIELD * FIELD * FIELD);
    // A product tells the geometric mean over its beams, of which there is one.
    let found = likelihood(Model::LikelihoodFieldProb, &ray(), 0.0, &[2.7]);
    assert_near(found, FIELD);
}

/// The wall is 2.95 m away, so a reading of 2.7 m is short by 0.25 m:
/// p = 0.5 exp(-0.25² / (2 · 0.2²)) + 0.05 · 0.1 exp(-0.1 · 2.7) + 0.5 / 8.
#[test]
fn a_beam_of_the_beam_model_is_a_mixture() {
    const SHORT: f64 = FIELD + 0.003_816_897_5;
    assert_near(likelihood(Model::Beam, &ray(), 0.0, &[2.7]), 1.0 + SHORT * SHORT * SHORT);
    // As much too long: nothing is early.
    assert_near(likelihood(Model::Beam, &ray(), 0.0, &[3.2]), 1.0 + FIELD * FIELD * FIELD);
    // Nothing is seen: 0.05, and a hit at 8 m is not likely.
    let nothing = likelihood(Model::Beam, &ray(), 0.0, &[f64::INFINITY]);
    assert_near(nothing, 1.0 + 0.05 * 0.05 * 0.05);
}

#[test]
fn a_range_at_the_end_of_the_sensor_says_nothing_in_a_likelihood_field() {
    for nothing in [8.0, f64::INFINITY, f64::NAN] {
        assert_near(likelihood(Model::LikelihoodField, &ray(), 0.0, &[nothing]), 0.0);
    }
    // A range that is missing is none, and one more than there are beams is not read.
    assert_near(likelihood(Model::LikelihoodField, &ray(), 0.0, &[]), 0.0);
    let more = likelihood(Model::LikelihoodField, &ray(), 0.0, &[2.7, 0.1]);
    assert_near(more, 1.0 + FIELD * FIELD * FIELD);
}

/// A cone of 30° that looks 15° to the left: its right ray ends just before the wall, in a cell
/// whose centre is 0.05 m from it. A ray alone ends at x = 4.899 m, in a cell 0.15 m from it.
#[test]
fn a_sonar_takes_the_likeliest_place_on_its_arc() {
    let p = |distance: f64| 0.5 * libm::exp(-distance * distance / 0.08) + 0.5 / 8.0;
    let cube = |it: f64| it * it * it;
    let turned = PI / 12.0;
    let mounts = [Pose::identity()];
    let cone = Sensor::sonars(&mounts, 2.0 * turned, 3, 8.0).unwrap();
    let found = likelihood(Model::LikelihoodField, &cone, turned, &[2.949]);
    assert_near(found, 1.0 + cube(p(0.05)));
    let found = likelihood(Model::LikelihoodField, &ray(), turned, &[2.949]);
    assert_near(found, 1.0 + cube(p(0.15)));
    // The beam model expects the shortest ray of the cone, to the nearest of 128 directions: at
    // 0° the wall is 2.95 m away.
    let found = likelihood(Model::Beam, &cone, turned, &[2.95]);
    assert_near(found, 1.0 + cube(0.5 + 0.5 / 8.0));
}

/// A robot that looks west: headings of its particles lie on both sides of half a turn.
#[test]
fn headings_on_both_sides_of_half_a_turn_are_as_sure_as_others() {
    let chart = Chart::new(&hall(), 0.1, &ray(), &Parameters::default()).unwrap();
    let sure = Matrix3::from_diagonal(&nalgebra::Vector3::new(0.0, 0.0, 0.01));
    let deviation = |heading: f64| {
        let mut localiser = Localiser::new(&chart, &Streams::new(1), "robot");
        localiser.start_at(&start(heading), &sure).unwrap();
        localiser.estimate().covariance[(2, 2)].sqrt()
    };
    let [east, west] = [0.0, PI].map(deviation);
    assert!((0.05..0.15).contains(&east) && (0.05..0.15).contains(&west), "{east} {west}");
}
