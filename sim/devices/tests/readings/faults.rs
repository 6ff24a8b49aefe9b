//! Stories of faults, a reading every 100 ms that counts up.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Fault, Faults, Mode, Streams};

/// Returns what arrives of 0, 1, 2 and so on.
fn read(faults: &[Fault], count: u64) -> Vec<Option<f64>> {
    let streams = Streams::new(7);
    let mut faults = Faults::new(faults, 1, Millis(100), &streams, "counter").unwrap();
    let reading = |at: u64| {
        let mut frame = [at as f64];
        faults.apply(Millis(100 * at), &mut frame).then_some(frame[0])
    };
    (0..count).map(reading).collect()
}

/// Returns what arrives of 0 to 7 with a fault from 200 ms until 500 ms.
fn during(mode: Mode) -> Vec<f64> {
    let fault = Fault::new(mode).unwrap().from(Millis(200)).until(Millis(500));
    read(&[fault], 8).into_iter().map(|it| it.unwrap_or(f64::NAN)).collect()
}

#[test]
fn each_effect_lasts_from_its_begin_to_its_end() {
    let of = |from_2: [f64; 3]| [&[0.0, 1.0], &from_2[..], &[5.0, 6.0, 7.0]].concat();
    assert_eq!(during(Mode::Stuck(9.0)), of([9.0, 9.0, 9.0]));
    assert_eq!(during(Mode::Frozen), of([1.0, 1.0, 1.0]));
    assert_eq!(during(Mode::Bias(-0.5)), of([1.5, 2.5, 3.5]));
    assert_eq!(during(Mode::Drift { per_s: 10.0, most: 1.5 }), of([2.0, 4.0, 5.5]));
    assert_eq!(during(Mode::Delay(Millis(150))), of([0.0, 1.0, 2.0]));
    assert_eq!(during(Mode::Saturation { least: 3.5, most: 3.75 }), of([3.5, 3.5, 3.75]));
    let lost: Vec<_> = during(Mode::DropOut(1.0)).iter().map(|it| it.is_nan()).collect();
    assert_eq!(lost, [false, false, true, true, true, false, false, false]);
}

#[test]
fn a_reading_that_is_frozen_from_the_beginning_is_the_first_one() {
    assert_eq!(read(&[Fault::new(Mode::Frozen).unwrap()], 3), [Some(0.0); 3]);
}

#[test]
fn a_delayed_reading_does_not_arrive_before_there_is_one() {
    let late = Fault::new(Mode::Delay(Millis(200))).unwrap();
    assert_eq!(read(&[late], 4), [None, None, Some(0.0), Some(1.0)]);
}

#[test]
fn faults_change_readings_in_their_order() {
    let [bias, most] = [Mode::Bias(2.0), Mode::Saturation { least: 0.0, most: 3.0 }]
        .map(|it| Fault::new(it).unwrap());
    assert_eq!(read(&[bias, most], 3), [2.0, 3.0, 3.0].map(Some));
    assert_eq!(read(&[most, bias], 5), [2.0, 3.0, 4.0, 5.0, 5.0].map(Some));
}

#[test]
fn an_intermittent_fault_is_there_for_its_share_of_the_time() {
    let loose = Fault::new(Mode::DropOut(1.0)).unwrap();
    let loose = loose.intermittent(Millis(500), Millis(1_500)).unwrap();
    let all = read(&[loose], 40_000);
    let lost = all.iter().filter(|it| it.is_none()).count();
    let begins = all.windows(2).filter(|it| it[0].is_some() && it[1].is_none()).count();
    assert!((9_500..10_500).contains(&lost), "{lost}"); // a quarter
    assert!((1_500..2_000).contains(&begins), "{begins}"); // every 2 s, less those between readings
}

#[test]
fn noise_has_its_deviation_and_no_mean() {
    let noisy = read(&[Fault::new(Mode::Noise(3.0)).unwrap()], 20_000);
    let errors = noisy.iter().enumerate().map(|(at, it)| it.unwrap() - at as f64);
    let (sum, squares) = errors.fold((0.0, 0.0), |it, error| (it.0 + error, it.1 + error * error));
    assert!((sum / 20_000.0_f64).abs() < 0.06, "{sum}");
    assert!((squares / 20_000.0 - 9.0_f64).abs() < 0.3, "{squares}");
}

#[test]
fn a_fault_whose_numbers_make_no_sense_is_refused() {
    let refused = |mode| Fault::new(mode).unwrap_err().to_string();
    assert_eq!(
        refused(Mode::Saturation { least: 2.0, most: 1.0 }),
        "the largest reading is 1; give a number from 2 to inf"
    );
    assert!(refused(Mode::Stuck(f64::NAN)).starts_with("the stuck value is NaN"));
    assert!(refused(Mode::Delay(Millis(600_001))).contains("from 0 to 600000"));
}

#[test]
fn a_reading_after_millions_of_years_does_not_hang() {
    let loose = Fault::new(Mode::DropOut(1.0)).unwrap();
    let loose = loose.intermittent(Millis(1), Millis(1)).unwrap();
    let mut faults = Faults::new(&[loose], 1, Millis(1), &Streams::new(7), "a").unwrap();
    let _ = faults.apply(Millis(u64::MAX), &mut [0.0]);
}
