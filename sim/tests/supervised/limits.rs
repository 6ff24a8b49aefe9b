//! The limits under supervisors: what draws power, when margins are looked at, and how a run ends
//! that is beyond one.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::FailureMode;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::run::Outcome;
use cotama_sim::supervised::{Injection, Script, Supervised, When};
use cotama_sim::trace::{Record, Sample, Trace};
use proptest::prelude::*;

fn delivery(limits: [u64; 2]) -> Mission {
    let text = embedded::mission("delivery").unwrap().text;
    let text = text
        .replace("duration_ms = 900000", &format!("duration_ms = {}", limits[0]))
        .replace("energy_mj = 7200000", &format!("energy_mj = {}", limits[1]));
    Mission::parse("delivery", &text).unwrap()
}

fn answers() -> impl Strategy<Value = &'static str> {
    prop_oneof![
        Just("\"teleoperate\", \"goal\""),
        Just("\"teleprogram\", \"waypoints\""),
        Just("\"teleprogram\", \"path\""),
        Just("\"give_up\""),
        Just("\"teleoperate\", \"teleprogram\", \"path\""),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(120))]

    /// Whatever fails and however long the operator takes.
    #[test]
    fn no_run_beyond_a_limit_is_safe_or_completed_and_samples_come_in_time(
        limits in (290_000u64..900_000, 1_600_000u64..3_000_000),
        modes in prop::collection::vec((0..FailureMode::ALL.len(), 0u64..80_000), 0..4),
        answers in prop::collection::vec((0u64..80_000, answers(), 0u64..90_000), 0..3),
        period in prop_oneof![Just(100u64), Just(1_000), 100u64..5_000],
    ) {
        let mission = delivery([limits.0, limits.1]);
        let mut body = String::from("format = 'panorama-faults/1'\n");
        for (mode, x) in modes {
            let mode = FailureMode::ALL[mode];
            let module = if mode.rule().one_module { "module = \"SMZ\"\n" } else { "" };
            body += &format!(
                "[[event]]\nx_mm = {x}\nkind = \"failure\"\nmode = \"{}\"\n{module}",
                mode.name()
            );
        }
        for (x, answers, delay) in answers {
            body += &format!(
                "[[event]]\nx_mm = {x}\nkind = \"operator\"\nanswers = [{answers}]\ndelay_ms = \
                 {delay}\n"
            );
        }
        let faults = Faults::parse("f", &body, &mission).unwrap();
        let faults = FaultChoice::Given { source: "f".into(), faults };
        let options =
            Options { faults, monitor_period: Some(Millis(period)), ..Options::default() };
        let Ok((trace, run)) = Trace::record(&mission, &options) else { return Ok(()) };
        let within = run.used.iter().zip(mission.limits).all(|(used, limit)| *used <= limit);
        prop_assert!(within || run.outcome == Outcome::Failed, "{:?}", run.used);
        let samples = trace.records.iter().filter_map(|it| match it {
            Record::Sample(it) => Some(it),
            _ => None,
        });
        // A supervised robot is looked at in whole rounds of 100 ms.
        let (most, mut last) = (period.div_ceil(100) * 100_000 + 100_000, 0);
        for it in samples {
            prop_assert!(it.t_us.saturating_sub(last) <= most, "{last} to {} µs", it.t_us);
            last = last.max(it.t_us);
            prop_assert!(it.real_power_mw > 0);
        }
        // The margins are looked at every second: a plan, or the operator, follows at once.
        let short = trace.records.iter().find_map(|it| match it {
            Record::Sample(it) if it.margins.duration_ms < 0 => Some(it.t_us),
            _ => None,
        });
        let answered = |from: u64| trace.records.iter().any(|it| match it {
            Record::Plan(it) => it.cause.contains("margin") && it.t_us + 1_200_000 >= from,
            Record::Told(it) => it.event == "faults.fail_hard" || it.event == "operator.give_up",
            Record::End(it) => it.t_us <= from + 1_200_000,
            Record::Fired(it) => it.net == "gs" && it.transition.starts_with("abort"),
            _ => false,
        });
        if let Some(from) = short {
            prop_assert!(answered(from), "short at {from} µs, and nobody says so\n{body}");
        }
    }
}

/// 4.6 W and the sonars of the configuration, where driving takes more.
#[test]
fn a_robot_that_waits_for_the_operator_draws_the_power_of_rest() {
    let mission = delivery([900_000, 7_200_000]);
    for delay in [1_000u64, 10_000, 20_000, 40_000, 60_000] {
        let body = format!(
            "format = 'panorama-faults/1'\n[[event]]\nx_mm = 20000\nkind = \"failure\"\nmode = \
             \"BMP2\"\n[[event]]\nx_mm = 0\nkind = \"operator\"\nanswers = [\"teleprogram\", \
             \"path\"]\ndelay_ms = {delay}\n"
        );
        let faults = Faults::parse("f", &body, &mission).unwrap();
        let faults = FaultChoice::Given { source: "f".into(), faults };
        let options = Options { faults, ..Options::default() };
        let (trace, _) = Trace::record(&mission, &options).unwrap();
        let samples = trace.records.iter().filter_map(|it| match it {
            Record::Sample(it) => Some(it),
            _ => None,
        });
        let drives = |it: &&Sample| (1..40_000).contains(&it.x_mm);
        let (stands, moves): (Vec<&Sample>, Vec<&Sample>) =
            samples.filter(drives).partition(|it| it.speed_mm_s == 0);
        assert!(!stands.is_empty() && !moves.is_empty(), "{delay}");
        let most = stands.iter().map(|it| it.real_power_mw).max().unwrap();
        let least = moves.iter().map(|it| it.real_power_mw).min().unwrap();
        assert!(most < least, "{delay} ms: standing {most} mW, driving {least} mW");
        assert!(most >= mission.motion_power.c0);
    }
}

/// A link that is lost, and a camera, are used by no plan of the delivery (Lambert et al. 2024,
/// 7.3.2): nothing is planned again. Sonars are.
#[test]
fn only_what_the_plan_uses_is_planned_again() {
    use FailureMode::{Cam1, Com1, Com2, Son2};
    let mission = delivery([900_000, 7_200_000]);
    let supervised = Supervised::new(&mission).unwrap();
    let plans = |modes: &[FailureMode], x: u64| {
        let at = When::Place(Millimetres(x));
        let injections = modes.iter().map(|it| Injection::new(at, *it)).collect();
        let run = supervised.run(&Script { injections, ..Script::default() }).unwrap();
        let causes = run.plans.iter().map(|it| it.cause.text(&mission));
        causes.collect::<Vec<_>>()
    };
    for x in [1_000, 10_000, 39_000, 45_000, 70_000] {
        for mode in [Com1, Com2, Cam1] {
            assert_eq!(plans(&[mode], x), ["start"], "{} at {x}", mode.name());
        }
        assert_eq!(plans(&[Com1, Cam1], x), ["start"], "{x}");
        assert_eq!(plans(&[Son2], x)[..2], ["start", "sonar arrays lost"], "{x}");
    }
}
