//! Laws that hold for all readings.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use core::f64::consts::PI;
use cotama_floor::{Pose, Vector, Version, embedded};
use cotama_localisation::{
    Chart, ChartError, Localiser, Model, Parameters, ParametersError, Sensor, StartError,
};
use cotama_streams::Streams;
use nalgebra::Matrix3;
use proptest::prelude::*;
use std::sync::LazyLock;

fn chart(model: Model, change: impl Fn(&mut Parameters)) -> Result<Chart, ChartError> {
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Charted, &[]).unwrap();
    let sensor = Sensor::laser(&Pose::identity(), PI, 30, 8.0).unwrap();
    let mut parameters = Parameters {
        laser_model_type: model,
        min_particles: 100,
        max_particles: 1_000,
        recovery_alpha_slow: 0.05,
        recovery_alpha_fast: 0.5,
        resample_interval: 2,
        update_min_d: 0.0,
        ..Parameters::default()
    };
    change(&mut parameters);
    Chart::new(&surface, 0.2, &sensor, &parameters)
}

static CHARTS: LazyLock<[Chart; 3]> = LazyLock::new(|| {
    [Model::Beam, Model::LikelihoodField, Model::LikelihoodFieldProb]
        .map(|it| chart(it, |_| {}).unwrap())
});

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn weights_add_up_to_one_and_particles_are_as_many_as_they_may_be(
        seed in 0_u64..1_000,
        model in 0_usize..3,
        readings in proptest::collection::vec(
            (proptest::collection::vec(-1.0..12.0, 0..40), -3.0..3.0, -3.2..3.2),
            1..6,
        ),
    ) {
        let mut localiser = Localiser::new(&CHARTS[model], &Streams::new(seed), "robot");
        let mut odometry = Pose::identity();
        for (ranges, ahead, turn) in readings {
            odometry *= Pose::new(Vector::new(ahead, 0.0), turn);
            localiser.update(&odometry, &ranges);
            let (mut sum, mut count) = (0.0, 0);
            for (pose, weight) in localiser.particles() {
                prop_assert!(pose.translation.vector.iter().all(|it| it.is_finite()));
                prop_assert!((0.0..=1.0).contains(&weight));
                (sum, count) = (sum + weight, count + 1);
            }
            let it = localiser.estimate();
            prop_assert!((sum - 1.0).abs() < 1e-9, "{}", sum);
            prop_assert!((100..=1_000).contains(&count) && count == it.particles);
            prop_assert!(it.effective >= 1.0 - 1e-9 && it.effective <= 1_000.0 + 1e-6);
            prop_assert!((0.0..=1.0).contains(&it.weight) && it.clusters > 0);
            let least = it.covariance.symmetric_eigenvalues().min();
            prop_assert!(least > -1e-9, "{}", it.covariance);
        }
    }
}

fn ranges() -> Vec<f64> {
    (0..30).map(|it| 1.0 + f64::from(it) * 0.1).collect()
}

#[test]
fn a_reading_that_says_nothing_changes_no_weight() {
    let chart = &CHARTS[1];
    let mut localiser = Localiser::new(chart, &Streams::new(1), "robot");
    localiser.update(&Pose::identity(), &[f64::INFINITY; 30]);
    assert!(localiser.particles().all(|it| (it.1 - 1e-3).abs() < 1e-15));
    assert!((localiser.estimate().effective - 1_000.0).abs() < 1e-6);
}

#[test]
fn a_robot_that_stands_is_not_updated_again() {
    let mut localiser = Localiser::new(&CHARTS[1], &Streams::new(1), "robot");
    assert!(localiser.update(&Pose::identity(), &ranges()));
    let before = localiser.estimate().clone();
    assert!(!localiser.update(&Pose::identity(), &ranges()));
    assert!(!localiser.update(&Pose::rotation(0.2), &ranges()));
    for nowhere in [f64::NAN, f64::INFINITY, 1e9] {
        assert!(!localiser.update(&Pose::translation(nowhere, 0.0), &ranges()));
    }
    assert_eq!(localiser.estimate(), &before);
    assert!(localiser.update(&Pose::rotation(0.21), &ranges()));
    // Between updates it goes as the odometry does.
    let there = localiser.pose_at(&(Pose::rotation(0.21) * Pose::translation(0.5, 0.0)));
    let expected = localiser.estimate().pose * Pose::translation(0.5, 0.0);
    assert!((there.translation.vector - expected.translation.vector).norm() < 1e-12);
}

/// Bits that were found once, and are the same on every machine.
#[test]
fn the_estimate_of_a_seed_is_fixed_to_the_last_bit() {
    let found = [0, 1, 2].map(|model: usize| {
        let mut localiser = Localiser::new(&CHARTS[model], &Streams::new(7), "robot");
        let mut odometry = Pose::identity();
        for _ in 0..10 {
            odometry *= Pose::new(Vector::new(0.3, 0.0), 0.1);
            localiser.update(&odometry, &ranges());
        }
        let it = localiser.estimate();
        [it.pose.translation.x.to_bits(), it.pose.rotation.angle().to_bits()]
    });
    let expected = [
        [4_624_957_653_621_462_597, 13_836_353_643_933_099_984],
        [4_622_745_797_379_167_547, 13_836_707_912_223_516_460],
        [4_617_627_687_312_094_487, 4_607_652_872_967_305_664],
    ];
    assert_eq!(found, expected);
}

#[test]
fn a_start_spreads_as_its_covariance_says() {
    let mut localiser = Localiser::new(&CHARTS[1], &Streams::new(1), "robot");
    let start = Pose::new(Vector::new(11.0, 10.0), 3.0);
    let spread = Matrix3::new(0.04, 0.018, 0.0, 0.018, 0.01, 0.0, 0.0, 0.0, 0.0025);
    localiser.start_at(&start, &spread).unwrap();
    let it = localiser.estimate();
    assert!((it.pose.translation.vector - start.translation.vector).norm() < 0.02);
    assert!((it.covariance - spread).norm() < 0.1 * spread.norm(), "{}", it.covariance);
    let refused = |it: Matrix3<f64>| localiser.clone().start_at(&start, &it).unwrap_err();
    assert_eq!(refused(Matrix3::from_diagonal_element(-0.1)), StartError::Covariance);
    assert_eq!(refused(Matrix3::from_element(f64::NAN)), StartError::Covariance);
    let more = Matrix3::new(0.01, 0.02, 0.0, 0.02, 0.01, 0.0, 0.0, 0.0, 0.01);
    assert_eq!(refused(more), StartError::Covariance);
    let far = Pose::translation(f64::INFINITY, 0.0);
    assert_eq!(localiser.start_at(&far, &spread), Err(StartError::Pose));
}

#[test]
fn parameters_that_make_no_sense_are_refused() {
    let refused = |change: fn(&mut Parameters)| chart(Model::Beam, change).unwrap_err();
    let error = refused(|it| it.sigma_hit = 0.0);
    assert_eq!(error.to_string(), "`sigma_hit` is 0; give a number from 0.001 to 10");
    let error = refused(|it| it.alpha1 = f64::NAN);
    assert_eq!(error.to_string(), "`alpha1` is NaN; give a number from 0 to 100");
    let error = refused(|it| it.min_particles = 1_001);
    let expected = ParametersError::Particles { min: 1_001, max: 1_000 };
    assert_eq!(error, ChartError::Parameters(expected));
    let error = refused(|it| (it.z_hit, it.z_rand) = (0.0, 0.0));
    assert_eq!(error, ChartError::Parameters(ParametersError::Impossible));
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Charted, &[]).unwrap();
    let sensor = Sensor::laser(&Pose::identity(), PI, 30, 8.0).unwrap();
    let error = Chart::new(&surface, 0.01, &sensor, &Parameters::default()).unwrap_err();
    assert_eq!(error.to_string(), "6000000 cells; at most 4194304: use larger ones");
}
