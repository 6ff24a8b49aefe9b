//! Missions, faults, FMECAs, teams, robots, traces, requirements.

use super::checks::{errors, is_place, text};
use cotama_campaign::requirement::Requirement;
use cotama_models::fmeca::Analysis;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{self, Robot};
use cotama_models::team::instance::Instance;
use cotama_models::team::scenario::Scenario;
use cotama_sim::trace::Trace;
use std::sync::LazyLock;

super::readers! {
    missions: mission, [
        "[[zone]]\n", "[[tio]]\n", "[[objective]]\n", "[hardware.x]\n", "[limits]\n",
        "source = \"\"\n",
        "\"\"\"", "'''", " = ", "{}", "[]", "true", "x_end_mm = ", "\"MOV\"", "\"LOC\"",
    ];
    faults: faults, [
        "[[event]]\n", "[[random]]\n", "kind = 'fault'\n", "kind = 'obstacle'\n",
        "units_lost = 1\n",
        "power_error_permille = {}\n", "x_mm = 1\n", "per_km = ", "{}", "[]", "'''",
    ];
    fmeca: fmeca, [
        "[[mode]]\n", "[[flag]]\n", "[[probe]]\n", "severity = \"hard\"\n", "flags = []\n",
        "shows = [",
        "sometimes = ", "silent = ", "mtbf_h = 1\n", "\"\"\"", "\"fatal\"", "period_h = ",
    ];
    fmeca_csv: fmeca_csv, [
        ",", ";", "\"\"", "\",\"", "\n", "severity", "flags", "mtbf_h", "hard", "\"a\nb\"", ",,,,,",
    ];
    teams: teams, [
        "null", "[]", "{}", "\"max\"", "\"mean\"", "\"coalition\"", "\"single\"",
        "\"simultaneous\"",
        "\"cost\":", "\"plans\":", "\"skip_cost\":", "\\u0000",
    ];
    teams_at_work: teams_at_work, [
        "[[robot]]\n", "[[task]]\n", "[[task.plan]]\n", "[[task.plan.role]]\n", "[[fault]]\n",
        "[[floor.way]]\n", "[auction]\n", "{ name = \"grasp\", fails_permille = 1 }", "permille = ",
        "succeeded = ", "failed = ", "trust = ", "after = ", "needs = [", "0+0", "1000/1000", " | ",
        "{}", "[]", "'''", "floor = \"office\"\n",
    ];
    robots: robots, [
        "[[configuration]]\n", "[[failure]]\n", "[module.x]\n", "[hardware.x]\n", "[observer.x]\n",
        "needs = []\n", "one_of = [", "loses = [", "each = [", "\"fatal\"", "\"hard\"",
        "rank = 0\n", "unseen = \"\"\n", "restart = {}\n", "{}", "[]", "'''",
    ];
    traces: traces, [
        "null", "[]", "{}", "\"kind\":", "\"end\"", "\"t_us\":0", "\n{}", "true", "\\u0000",
    ];
    requirements: requirement, [
        "completed", "in-time", "never ", "gs.abort", "AG ", "<=", "time", "energy", "requests",
        "18446744073709551615", ".", "\"", " ",
    ];
}

fn mission(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Mission::parse("file", &text) {
        Ok(mission) => {
            let activities = mission.scenario().activities();
            let length: u64 = activities.iter().map(|it| it.length().0).sum();
            assert_eq!(length, mission.path_length.0);
            true
        }
        Err(found) => {
            errors(&text, &found);
            false
        }
    }
}

fn faults(bytes: &[u8]) -> bool {
    /// One mission with supervisors and one without.
    static MISSIONS: LazyLock<[Mission; 2]> = LazyLock::new(|| {
        ["patrol", "delivery"].map(|name| {
            let mission = embedded::mission(name).expect("it is shipped");
            Mission::parse(mission.name, mission.text).expect("it is right")
        })
    });
    let text = text(bytes);
    let read = |mission: &Mission| match Faults::parse("file", &text, mission) {
        Ok(_) => true,
        Err(found) => {
            errors(&text, &found);
            false
        }
    };
    let [patrol, delivery] = MISSIONS.each_ref().map(read);
    patrol || delivery
}

/// An analysis that was read is written as comma-separated values and read again. They have all of
/// it but the time of operation, on which criticality stands.
fn is_written_again(analysis: &Analysis) -> String {
    let csv = analysis.to_csv();
    let again = Analysis::parse_csv("again", &csv).unwrap_or_else(|it| panic!("{it}\n{csv}"));
    assert_eq!(again.modes().len(), analysis.modes().len());
    let written = again.to_csv();
    assert_eq!(Analysis::parse_csv("once more", &written).unwrap().to_csv(), written);
    written
}

fn fmeca(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Analysis::parse("file", &text) {
        Ok(analysis) => {
            let _ = is_written_again(&analysis);
            true
        }
        Err(found) => {
            errors(&text, &found);
            false
        }
    }
}

fn fmeca_csv(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Analysis::parse_csv("file", &text) {
        Ok(analysis) => {
            assert_eq!(is_written_again(&analysis), analysis.to_csv());
            true
        }
        Err(found) => {
            errors(&text, &found);
            false
        }
    }
}

fn teams(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Instance::parse("file", &text) {
        Ok(instance) => {
            let _ = instance.solve(1_000);
            true
        }
        Err(found) => {
            errors(&text, &found);
            false
        }
    }
}

/// A team that was read is written as what reads as the same, and has its bids and figures.
fn teams_at_work(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Scenario::parse("file", &text) {
        Ok(team) => {
            let again = Scenario::parse("again", &team.to_toml());
            assert_eq!(again.unwrap_or_else(|it| panic!("{it}")), team);
            let instance = Instance::from(&team);
            assert_eq!(instance.tasks.len(), team.tasks.len());
            let _ = team.figures();
            true
        }
        Err(found) => {
            errors(&text, &found);
            false
        }
    }
}

/// The supervisors of a robot that was read fit together.
fn robots(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Robot::parse("file", &text) {
        Ok(robot) => {
            let system = robots::supervisors::system(&robot);
            system.with(|it| assert_eq!(it.defect(), None, "{text}"));
            assert!(!robots::requirements::of(&robot).is_empty());
            true
        }
        Err(found) => {
            errors(&text, &found);
            false
        }
    }
}

fn traces(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match Trace::parse("file", &text) {
        Ok(trace) => {
            let written = trace.to_json_lines();
            let again = Trace::parse("again", &written).unwrap_or_else(|it| panic!("{it}"));
            assert_eq!(again.to_json_lines(), written);
            true
        }
        Err(found) => {
            is_place(&text, found.line, found.column);
            assert!(!found.message.is_empty());
            false
        }
    }
}

/// A requirement is written as it was read; a text that cannot be read has no lines, so the text
/// itself is its place.
fn requirement(bytes: &[u8]) -> bool {
    let text = text(bytes);
    match text.parse::<Requirement>() {
        Ok(requirement) => {
            let written = requirement.to_string();
            assert_eq!(written.parse::<Requirement>().as_ref(), Ok(&requirement));
            assert!(!requirement.words().is_empty());
            true
        }
        Err(error) => {
            let error = error.to_string();
            assert!(error.starts_with(&format!("`{}`", text.escape_debug())), "{error}");
            assert!(!error.contains(char::is_control), "{error}");
            false
        }
    }
}
