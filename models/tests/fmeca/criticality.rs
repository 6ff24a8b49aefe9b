//! Ranks, numbers and classes by hand.

use super::{small, with};
use cotama_models::fmeca::{Analysis, CriticalityClass, OccurrenceClass, SeverityClass};

/// In 10 h: LID1 fails 10/500 = 0.02 times, LID2 (20,000 in a million hours: every 50 h) 0.2 times,
/// LID3 20 times, GRP1 a quarter of every 100,000 h: 10/400,000 = 0.000025 times.
#[test]
fn the_small_file() {
    use CriticalityClass::{Intolerable, Tolerable, Undesirable};
    use OccurrenceClass::{Frequent, Improbable, Occasional};
    use SeverityClass::{Catastrophic, Critical, Insignificant, Marginal};
    let small = small();
    let told: Vec<_> = small
        .modes()
        .iter()
        .map(|it| {
            let it = small.criticality(it);
            let ranks = [it.severity, it.occurrence, it.detection];
            (ranks, it.rpn(), it.severity_class, it.occurrence_class, it.class(), it.number_e9)
        })
        .collect();
    let expected = [
        ([8, 7, 2], 112, Critical, Occasional, Undesirable, None),
        ([5, 8, 9], 360, Marginal, Frequent, Intolerable, None),
        ([3, 10, 4], 120, Insignificant, Frequent, Undesirable, None),
        // β α λ t = 0.4 * 0.25 * 10 / 100,000 = 0.00001.
        ([10, 4, 10], 400, Catastrophic, Improbable, Tolerable, Some(10_000)),
    ];
    assert_eq!(told, expected);
}

/// 0.4 * 0.25 * 10 / 150,000 is 6,666.67 in parts of 10^9.
#[test]
fn a_criticality_number_is_rounded_half_up() {
    let number = |mtbf: &str| {
        let read = Analysis::parse("small.toml", &with(&[("mtbf_h = 1e5", mtbf)])).unwrap();
        read.criticality(&read.modes()[3]).number_e9
    };
    assert_eq!(number("mtbf_h = 150000"), Some(6_667));
    assert_eq!(number("mtbf_h = 300000"), Some(3_333));
}

#[test]
fn a_detection_rank_in_the_file_replaces_the_table() {
    let text = with(&[("latency_ms = 100\n", "latency_ms = 100\ndetection_rank = 6\n")]);
    let read = Analysis::parse("small.toml", &text).unwrap();
    assert_eq!(read.criticality(&read.modes()[0]).rpn(), 8 * 7 * 6);
}

/// Each bound of the three tables, from both sides.
#[test]
fn the_bounds_of_the_tables() {
    use OccurrenceClass::{Frequent, Improbable, Occasional, Probable, Remote};
    let read = |mtbf: &str, latency: &str| {
        let latency = format!("latency_ms = {latency}");
        let text = with(&[("latency_ms = 100", &latency), ("mtbf_h = 500", mtbf)]);
        let read = Analysis::parse("small.toml", &text).unwrap();
        read.criticality(&read.modes()[0])
    };
    for (rank, decade) in (1..=9).rev().zip(["1", "10", "100", "1e3", "1e4", "1e5", "1e6"]) {
        assert_eq!(read(&format!("mtbf_h = {decade}"), "5").occurrence, rank, "{decade}");
    }
    assert_eq!(read("mtbf_h = 0.999", "5").occurrence, 10);
    assert_eq!(read("mtbf_h = 9.999", "5").occurrence, 9);
    assert_eq!(read("mtbf_h = 99999999", "5").occurrence, 2);
    assert_eq!(read("mtbf_h = 100000000", "5").occurrence, 1);
    for (rank, most) in [10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000].iter().enumerate() {
        assert_eq!(usize::from(read("mtbf_h = 5", &most.to_string()).detection), rank + 1);
        let more = (most + 1).to_string();
        assert_eq!(usize::from(read("mtbf_h = 5", &more).detection), rank + 2);
    }
    // In 10 h: 0.2, 0.1, 0.01, 0.001 failures, and a little less.
    for (at, below, one, other) in [
        ("50", "50.001", Frequent, Probable),
        ("100", "100.001", Probable, Occasional),
        ("1000", "1000.001", Occasional, Remote),
        ("10000", "10000.001", Remote, Improbable),
    ] {
        assert_eq!(read(&format!("mtbf_h = {at}"), "5").occurrence_class, one);
        assert_eq!(read(&format!("mtbf_h = {below}"), "5").occurrence_class, other);
    }
}

/// The whole matrix; it never gets better to the right or down.
#[test]
fn the_criticality_matrix() {
    let letters = |occurrence: &OccurrenceClass| -> String {
        let field = |severity: &SeverityClass| {
            CriticalityClass::of(*occurrence, *severity).name().chars().next().unwrap()
        };
        SeverityClass::ALL.iter().map(field).collect()
    };
    let rows: Vec<_> = OccurrenceClass::ALL.iter().rev().map(letters).collect();
    assert_eq!(rows, ["uiii", "tuii", "ttui", "nttu", "nntt"]);
    for pair in OccurrenceClass::ALL.windows(2) {
        for severity in SeverityClass::ALL.windows(2) {
            let field = CriticalityClass::of(pair[0], severity[0]);
            assert!(field <= CriticalityClass::of(pair[1], severity[0]));
            assert!(field <= CriticalityClass::of(pair[0], severity[1]));
        }
    }
}

/// Every row of the delivery robot: RPN and class.
#[test]
fn the_delivery_robot() {
    let robot = Analysis::shipped("p3dx-delivery").unwrap();
    let mut lines: Vec<_> = robot
        .modes()
        .iter()
        .map(|mode| {
            let it = robot.criticality(mode);
            let ranks = format!("{} x {} x {}", it.severity, it.occurrence, it.detection);
            let (class, id) = (it.class().name(), &mode.id);
            (1000 - it.rpn(), format!("{id} {} = {ranks}, {class}\n", it.rpn()))
        })
        .collect();
    lines.sort_by_key(|it| it.0);
    let text: String = lines.into_iter().map(|it| it.1).collect();
    cotama_golden::compare("tests/golden/fmeca_criticality.txt", &text);
}
