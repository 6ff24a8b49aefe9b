//! Traces of supervised runs: read back, run again, and what the story says.

use super::{delivery, golden};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{Diagnosis, FailureMode};
use cotama_models::missions::faults::{Answer, Faults, Incident, IncidentKind, Moment};
use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Script, Supervised, story};
use cotama_sim::trace::{Record, Trace, replay};
use proptest::prelude::*;
use std::fmt::Write;
use std::sync::LazyLock;

static GOLDEN: LazyLock<String> = LazyLock::new(|| record(FaultChoice::Script).to_json_lines());

fn record(faults: FaultChoice) -> Trace {
    let options = Options { faults, ..Options::default() };
    let delivery = embedded::mission("delivery").unwrap();
    let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    Trace::record(&mission, &options).unwrap().0
}

#[test]
fn the_delivery_leaves_the_golden_trace_and_tells_the_golden_story() {
    let trace = record(FaultChoice::Script);
    let sparse: Vec<_> =
        trace.records.iter().filter(|it| !matches!(it, Record::Sample(_))).cloned().collect();
    let sparse = Trace { records: sparse, ..trace.clone() }.to_json_lines();
    // Without the header, which holds the mission file with all its comments.
    golden("delivery.jsonl", sparse.split_once('\n').unwrap().1);
    let mut text = String::new();
    for point in story::points(&trace.records) {
        writeln!(
            text,
            "{}  {} mm  {} ms  {}",
            point.number,
            point.x_mm,
            point.t_us / 1000,
            point.title()
        )
        .unwrap();
        for line in [point.found(), point.decided(), point.done()].into_iter().flatten() {
            writeln!(text, "   {line}").unwrap();
        }
    }
    golden("delivery_story.txt", &text);
}

#[test]
fn a_sample_a_second_and_one_for_each_plan() {
    let trace = record(FaultChoice::Script);
    let samples: Vec<_> = trace
        .records
        .iter()
        .filter_map(|it| match it {
            Record::Sample(it) => Some(it),
            _ => None,
        })
        .collect();
    let plans = trace.records.iter().filter(|it| matches!(it, Record::Plan(_))).count();
    // 413 whole seconds after the start, the start, and both plans.
    assert_eq!((samples.len(), plans), (413 + 1 + 2, 2));
    for sample in samples {
        let [duration, energy] = [sample.used.duration_ms, sample.used.energy_mj];
        assert_eq!(sample.t_us, duration * 1000);
        assert!(energy <= 7_200_000 && sample.speed_mm_s <= 300 && sample.x_mm <= 80_000);
    }
}

#[test]
fn recording_changes_nothing() {
    let mission = delivery();
    let (ready, script) = (Supervised::new(&mission).unwrap(), Script::from(&mission.run.faults));
    let mut records: Vec<Record> = Vec::new();
    let recorded = ready.run_recorded(&script, Millis(1_000), &mut records).unwrap();
    assert_eq!(recorded, ready.run(&script).unwrap());
    let conduct = recorded.conduct.iter().map(|it| it.exposed.0).collect::<Vec<_>>();
    // The sonars were gone for five seconds before anyone could know.
    assert_eq!((conduct, recorded.exposed), (vec![0, 0, 5_200, 0], Millis(5_200)));
}

#[test]
fn a_changed_trace_is_not_identical() {
    let text = record(FaultChoice::Script).to_json_lines();
    for (from, to) in
        [("\"slow1\"", "\"slow2\""), ("\"SON1\"", "\"SON2\""), ("\"round\":1793", "\"round\":1794")]
    {
        let changed = Trace::parse("changed", &text.replacen(from, to, 1)).unwrap();
        assert!(!replay(&changed).unwrap().identical, "{from}");
    }
}

fn incident() -> impl Strategy<Value = Incident> {
    let failure = prop::sample::select(FailureMode::ALL).prop_map(|mode| IncidentKind::Failure {
        mode,
        part: None,
        until: None,
    });
    (0u64..80_000, failure)
        .prop_map(|(x, kind)| Incident { when: Moment::Place(Millimetres(x)), kind })
}

fn answers() -> impl Strategy<Value = Incident> {
    use Answer::{GiveUp, Goal, Path, Teleoperate, Teleprogram, Waypoints};
    let answers = prop::sample::select(vec![
        vec![Teleoperate, Goal],
        vec![Teleoperate, Teleprogram, Path],
        vec![Teleprogram, Waypoints],
        vec![GiveUp],
    ]);
    (0u64..80_000, answers, 100u64..30_000).prop_map(|(x, answers, delay)| Incident {
        when: Moment::Place(Millimetres(x)),
        kind: IncidentKind::Operator { answers, delay: Millis(delay) },
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    /// Whatever fails, the trace suffices: read back it is the same, and run again it comes out the
    /// same. Each failure is a point, and what the records say is what the run says.
    #[test]
    fn a_trace_read_back_is_the_same_run(
        failures in prop::collection::vec(incident(), 0..=3),
        answers in prop::option::of(answers()),
    ) {
        let mut incidents: Vec<_> = failures.into_iter().chain(answers).collect();
        incidents.sort_by_key(|it| match it.when {
            Moment::Place(x) => x,
            _ => unreachable!(),
        });
        let faults = Faults { incidents, ..Faults::default() };
        let mission = delivery();
        let run = Supervised::new(&mission).unwrap().run(&Script::from(&faults)).unwrap();
        let trace = record(FaultChoice::Given { source: "random.toml".into(), faults });
        let read = Trace::parse("random.jsonl", &trace.to_json_lines()).unwrap();
        prop_assert_eq!(&read, &trace);
        let again = replay(&read).unwrap();
        prop_assert!(again.identical);
        prop_assert_eq!(&again.run, &run.summary(&mission));

        let count = |kind: fn(&Record) -> bool| trace.records.iter().filter(|it| kind(it)).count();
        prop_assert_eq!(count(|it| matches!(it, Record::Fired(_))), run.fired.len());
        prop_assert_eq!(count(|it| matches!(it, Record::Told(_))), run.told.len());
        prop_assert_eq!(
            count(|it| matches!(it, Record::Configuration(_))),
            run.configurations.len()
        );
        prop_assert_eq!(count(|it| matches!(it, Record::Request(_))) as u64, run.operator_requests);
        let decided = run.conduct.iter().filter(|it| it.decided.is_some()).count();
        prop_assert_eq!(count(|it| matches!(it, Record::Decision(_))), decided);

        let points = story::points(&trace.records);
        let chains: Vec<_> = points.iter().filter_map(|it| it.chain()).collect();
        prop_assert_eq!(chains.len(), run.conduct.len());
        for chain in chains {
            let conduct = &run.conduct[usize::from(chain.failure.failure) - 1];
            // A failure that no available observer sees is diagnosed as nothing.
            let found = conduct.detected.filter(|it| it.1 != Diagnosis::None);
            prop_assert_eq!(chain.diagnosis.map(|it| it.t_us / 1000), found.map(|it| it.0.0));
            prop_assert_eq!(
                chain.reaction.first().map(|it| it.t_us / 1000),
                conduct.answered.map(|it| it.0)
            );
            prop_assert_eq!(chain.exposed_ms, conduct.exposed.0);
            prop_assert_eq!(conduct.judged.is_some(), found.is_some());
        }
        let reason = matches!(trace.records.last(), Some(Record::End(it)) if it.reason.is_some());
        prop_assert_eq!(reason, run.outcome != Outcome::Completed);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// Whatever is changed in a good trace, reading it, replaying it and reporting it ends with an
    /// answer.
    #[test]
    fn damaged_traces_are_survived(
        at in 0usize..200_000,
        byte in any::<u8>(),
        line in any::<bool>(),
    ) {
        let text = GOLDEN.clone();
        let at = at % text.len();
        let damaged = if line {
            let gone = at % text.lines().count();
            text.lines()
                .enumerate()
                .filter(|(number, _)| *number != gone)
                .map(|(_, it)| format!("{it}\n"))
                .collect()
        } else {
            let mut bytes = text.into_bytes();
            bytes[at] = byte;
            String::from_utf8_lossy(&bytes).into_owned()
        };
        if let Ok(trace) = Trace::parse("damaged", &damaged) {
            let _ = cotama_pages::mission::html(&trace);
            let identical = replay(&trace).is_ok_and(|it| it.identical);
            let header = |text: &str| text.lines().next().unwrap_or_default().to_owned();
            prop_assert!(!identical || damaged == *GOLDEN || header(&damaged) != header(&GOLDEN));
        }
    }
}
