//! Traces: the same bytes every time, everywhere; read back, run again, and never trusted.
//!
//! `UPDATE_GOLDEN=1 cargo test -p cotama-sim --test runs traces` rewrites the golden files.
#![allow(clippy::unwrap_used, clippy::pedantic)]

use crate::common::{patrol, under, with_period};
use cotama_sim::options::{Options, Planner};
use cotama_sim::trace::{Limits, Record, Trace, replay};
use proptest::prelude::*;
use std::path::Path;
use std::sync::LazyLock;

static SECONDS_30: LazyLock<String> = LazyLock::new(|| text(&with_period(30_000)));

fn text(options: &Options) -> String {
    Trace::record(&patrol(), options).unwrap().0.to_json_lines()
}

/// The lines after the header, which holds the mission file with all its comments.
fn without_header(text: &str) -> &str {
    text.split_once('\n').unwrap().1
}

/// FNV-1a, 64 bits.
fn digest(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3)
    })
}

fn golden(name: &str, found: &str) {
    cotama_golden::compare(Path::new("tests/golden").join(name), found);
}

/// Debug and release builds, and all platforms, agree on these bytes.
#[test]
fn the_patrol_leaves_the_golden_trace() {
    golden("patrol-30s.jsonl", without_header(&SECONDS_30));
    let digest = digest(without_header(&text(&Options::default())));
    golden("patrol-1s.digest", &format!("{digest:016x}\n"));
}

#[test]
fn threads_and_repetitions_leave_the_same_bytes() {
    let random =
        r#"random = [{ name = "people", kind = "obstacle", per_km = 40, delay_ms = 150 }]"#;
    let options = Options { seed: 7, ..under(&patrol(), random) };
    let first = text(&options);
    assert_eq!(text(&options), first);
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(|| text(&options))).collect();
        assert!(threads.into_iter().all(|thread| thread.join().unwrap() == first));
    });
    assert_ne!(text(&Options { seed: 8, ..options }), first);
}

#[test]
fn a_trace_runs_again_from_its_own_text() {
    let random = r#"event = [{ x_mm = 100, kind = "fault", hardware = "laser", units_lost = 1 }]
        random = [{ name = "people", kind = "obstacle", per_km = 40, delay_ms = 150 }]
        power_error_permille = { H2 = -45 }"#;
    let upward = cotama_core::monitor::Upward { growth: [1, 2], reserve: [3, 4] };
    let options = Options {
        seed: u64::MAX,
        planner: Some(Planner::PanoramaThenExact { steps: 1_000 }),
        upward: Some(upward),
        ..under(&patrol(), random)
    };
    for options in [Options::default(), options] {
        let (trace, run) = Trace::record(&patrol(), &options).unwrap();
        let read = Trace::parse("patrol.jsonl", &trace.to_json_lines()).unwrap();
        assert_eq!(read, trace);
        let again = replay(&read).unwrap();
        assert!(again.identical);
        assert_eq!(again.run, run);
        let mut written = Vec::new();
        read.write_to(&mut written).unwrap();
        assert_eq!(String::from_utf8(written).unwrap(), trace.to_json_lines());
    }
}

#[test]
fn a_changed_trace_is_not_identical() {
    let original = &*SECONDS_30;
    // The script draws no random numbers, so another seed is the same run under another header;
    // spaces and line ends are no part of a record.
    let same = [
        original.replacen("\"seed\":0", "\"seed\":1", 1),
        original.replacen("\"replans\":3", "\"replans\": 3.0", 1),
        original.replace('\n', "\r\n"),
        original.trim_end().to_owned(),
        original.clone() + "\n",
    ];
    for (index, changed) in same.iter().enumerate() {
        assert_ne!(changed, original, "change {index}");
        let replayed = replay(&Trace::parse("changed", changed).unwrap()).unwrap();
        assert_eq!(replayed.difference, None, "change {index}");
        assert!(replayed.identical);
    }
    let end = original.lines().count();
    let kind = |line: usize| original.lines().nth(line - 1).unwrap().split('"').nth(3).unwrap();
    let changes = [
        (original.replacen("\"replans\":3", "\"replans\":2", 1), end, "replans"),
        (
            original.replacen("\"path_length_mm\":187000", "\"path_length_mm\":1", 1),
            1,
            "path_length_mm",
        ),
        (original.replacen("\"steps\":", "\"steps\":1", 1), 2, "steps"),
        (original.replacen("\"return_margin\"", "\"other\":[],\"return_margin\"", 1), 2, "other"),
        (
            original.replacen("\"planned_power_mw\":", "\"planned_power_mw\":9", 1),
            3,
            "planned_power_mw",
        ),
    ];
    for (changed, line, field) in changes {
        let replayed = replay(&Trace::parse("changed", &changed).unwrap()).unwrap();
        let found = replayed.difference.unwrap();
        assert!(!replayed.identical);
        let named = found.field.clone().unwrap().field;
        assert_eq!((found.line, named.as_str()), (line, field));
        assert!(line == 1 || kind(line) == found.record, "{found:?}");
    }
    // A script with another number in it is another run, from that event on.
    let other = original.replacen("delay_ms = 3000", "delay_ms = 3001", 1);
    let found = replay(&Trace::parse("changed", &other).unwrap()).unwrap().difference.unwrap();
    assert!(found.line > 10 && found.there == [true, true], "{found:?}");
    // A record that is missing, at the end of what is left.
    let lines: Vec<_> = original.lines().collect();
    let without = [&lines[..end - 2], &lines[end - 1..]].concat().join("\n");
    let found = replay(&Trace::parse("changed", &without).unwrap()).unwrap().difference.unwrap();
    assert_eq!(found.line, end - 1);
}

#[test]
fn every_plan_is_followed_by_its_sample() {
    let trace = Trace::parse("patrol", &SECONDS_30).unwrap();
    let mut plans = 0;
    for pair in trace.records.windows(2) {
        if let Record::Plan(plan) = &pair[0] {
            let Record::Sample(sample) = pair[1] else { panic!("{:?}", pair[1]) };
            assert_eq!(
                (sample.t_us, sample.margins, sample.used),
                (plan.t_us, plan.after, plan.used)
            );
            let total: u64 = plan.plan.iter().map(|row| row.energy_mj).sum();
            assert_eq!(8_640_000 - plan.used.energy_mj as i64 - total as i64, plan.after.energy_mj);
            assert!(plan.return_margin.end.is_some() && plan.return_margin.start.is_some());
            plans += 1;
        }
    }
    assert_eq!(plans, 4);
}

#[test]
fn errors_give_position_and_cause() {
    let original = &*SECONDS_30;
    let lines: Vec<_> = original.lines().collect();
    let error = |text: &str| Trace::parse("t.jsonl", text).unwrap_err().to_string();
    assert_eq!(error(""), "t.jsonl:1:1: the trace is empty");
    assert!(error("{}").starts_with("t.jsonl:1:2: `schema` is missing"), "{}", error("{}"));
    let other = original.replacen("cotama-trace/1", "cotama-trace/9", 1);
    assert_eq!(
        error(&other),
        "t.jsonl:1:1: the schema is \"cotama-trace/9\", only \"cotama-trace/1\" is read"
    );
    let broken = format!("{}\n{{\"record\":\"sample\",\"t_us\":-1}}\n", lines[0]);
    assert!(error(&broken).starts_with("t.jsonl:2:"), "{}", error(&broken));
    let cut = lines[..lines.len() - 1].join("\n");
    let expected =
        format!("t.jsonl:{}:1: the trace stops before the end of the mission", lines.len());
    assert_eq!(error(&cut), expected);
    let twice = format!("{original}{}\n", lines.last().unwrap());
    assert!(error(&twice).ends_with("a record after the end of the mission"));
    let mut swapped = lines.clone();
    swapped.swap(5, lines.len() - 3);
    assert!(error(&swapped.join("\n")).contains("before that of the last"));
    let parse = |limits| Trace::parse_within("t.jsonl", original, limits).unwrap_err().to_string();
    assert!(parse(Limits { bytes: 10, ..Limits::default() }).contains("at most 10 are read"));
    assert!(parse(Limits { line_bytes: 10, ..Limits::default() }).contains("at most 10 are read"));
    // Time runs on where the robot stands, too.
    let records = Trace::parse("t.jsonl", original).unwrap().records;
    let stands = |it: &[Record]| it[0].x_mm() == it[1].x_mm() && it[0].t_us() < it[1].t_us();
    let at = records.windows(2).position(stands).unwrap();
    let mut swapped = lines.clone();
    swapped.swap(at + 1, at + 2);
    assert!(error(&swapped.join("\n")).contains("before that of the last"));
    // A text just within the limits is read.
    let longest = lines.iter().map(|it| it.len()).max().unwrap();
    let just = Limits { bytes: original.len(), line_bytes: longest, records: lines.len() - 1 };
    assert!(Trace::parse_within("t.jsonl", original, just).is_ok());
    assert!(parse(Limits { line_bytes: longest - 1, ..just }).contains("bytes, at most"));
    assert!(parse(Limits { bytes: original.len() - 1, ..just }).contains("bytes, at most"));
    assert_eq!(
        parse(Limits { records: 3, ..Limits::default() }),
        "t.jsonl:5:1: more than 3 records"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn garbage_is_an_error_and_never_a_panic(text in ".{0,200}") {
        prop_assert!(Trace::parse("garbage", &text).is_err());
    }

    /// Whatever is changed in a good trace, reading and replaying it ends with an answer.
    #[test]
    fn damaged_traces_are_survived(
        at in 0usize..60_000,
        byte in any::<u8>(),
        cut in any::<bool>(),
    ) {
        let mut bytes = SECONDS_30.clone().into_bytes();
        let at = at % bytes.len();
        if cut { bytes.truncate(at) } else { bytes[at] = byte }
        let text = String::from_utf8_lossy(&bytes);
        if let Ok(trace) = Trace::parse("damaged", &text)
            && let Ok(replayed) = replay(&trace)
        {
            prop_assert!(
                !replayed.identical
                    || text == *SECONDS_30
                    || trace.header != Trace::parse("", &SECONDS_30).unwrap().header
            );
        }
    }
}
