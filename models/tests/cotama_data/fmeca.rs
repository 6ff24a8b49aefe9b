//! The FMECA against the modules and the rules.

use cotama_models::cotama::{
    Class, Decision, FailureMode, Label, Losses, Module, Modules, Persistence, RULES, Severity,
    Situation, TEXTS, decide, local, path_following,
};

const DRIVING: Situation = Situation {
    local: local::State::Following,
    following: path_following::State::Optimal,
    ..Situation::AT_REST
};

/// The modules that a row names in words are gone when its typed losses are, and whoever is faulty
/// is named.
#[test]
fn words_and_sets_of_a_row_say_the_same() {
    for &mode in FailureMode::ALL {
        let words = mode.description().modules;
        let gone = Modules::ALL.without(mode.health(Modules::NONE).available());
        let named: Modules = words
            .split(' ')
            .filter_map(|word| Module::ALL.iter().find(|it| it.name() == word))
            .fold(Modules::NONE, |set, &it| set.with(it));
        assert!(gone.covers(named), "{}: {words}, but {gone} are gone", mode.name());
        if words.ends_with("all") {
            assert_eq!(gone, Modules::ALL, "{}", mode.name());
        } else {
            assert!(named.covers(mode.rule().faulty), "{}", mode.name());
        }
        assert_eq!(mode.rule().one_module, words == "that module", "{}", mode.name());
    }
}

#[test]
fn two_rows_are_invisible_and_say_why() {
    let silent: Vec<_> = FailureMode::ALL
        .iter()
        .filter(|it| it.description().silent.is_some())
        .map(|it| it.name())
        .collect();
    assert_eq!(silent, ["PWR1", "SW3"]);
}

#[test]
fn one_rate_is_from_a_data_sheet_and_the_rest_assumed() {
    let stated: Vec<_> = FailureMode::ALL
        .iter()
        .filter(|it| it.description().rate_label == Label::Stated)
        .map(|it| it.name())
        .collect();
    assert_eq!(stated, ["BAT1"]);
    assert!(
        TEXTS.iter().all(|it| it.rate_label == Label::Stated || it.rate.starts_with("assumed"))
    );
}

/// The rows whose printed class is not that of the two rules, on the optimal path following.
#[test]
fn rows_whose_class_the_rules_make_worse() {
    let worse: Vec<_> = FailureMode::ALL
        .iter()
        .filter(|it| it.effective(Modules::NONE, DRIVING) != it.rule().class)
        .map(|it| (it.name(), it.rule().class, it.effective(Modules::NONE, DRIVING)))
        .collect();
    // The encoders feed NAV, and every configuration but security needs NAV: there is nothing to
    // ask the operator for.
    assert_eq!(worse, [("ODO1", Class::Local, Class::Global)]);
    for mode in [FailureMode::Rt3, FailureMode::Sw1, FailureMode::Sw2] {
        let fatal: Vec<_> = Module::ALL
            .iter()
            .filter(|&&it| mode.effective(Modules::of(&[it]), DRIVING) != Class::Local)
            .map(|it| it.name())
            .collect();
        assert_eq!(fatal, ["SCH", "P3D", "NAV", "LAN"], "{}", mode.name());
    }
}

/// The decisions on reports of rows, where their class is not the printed one: on the optimal path
/// following, but for the planner, the operator and drift, which fail while planning, in the
/// hand-over and in the degraded set.
#[test]
fn rows_whose_report_is_answered_otherwise_than_printed() {
    let other: Vec<_> = FailureMode::ALL
        .iter()
        .filter_map(|it| {
            let rule = it.rule();
            let place = match it {
                FailureMode::Ppl1 => {
                    Situation { local: local::State::Planning, ..Situation::AT_REST }
                }
                FailureMode::Opr1 => {
                    Situation { local: local::State::HandOver, ..Situation::AT_REST }
                }
                FailureMode::Loc3 => {
                    Situation { following: path_following::State::Degraded, ..DRIVING }
                }
                _ => DRIVING,
            };
            let situation = Situation { lost: Losses::from(it.health(Modules::NONE)), ..place };
            let decision = rule.report.map_or(Decision::Record, |report| decide(report, situation));
            (decision.class() != rule.class)
                .then(|| format!("{} {}: {decision:?}", it.name(), rule.class.name()))
        })
        .collect();
    let (recorded, others): (Vec<_>, Vec<_>) =
        other.iter().map(String::as_str).partition(|it| it.ends_with("adapter: Record"));
    // Camera and link are not used where the robot drives itself, and one late job is tolerated.
    let names: Vec<_> = recorded.iter().map(|it| it.split(' ').next().unwrap()).collect();
    assert_eq!(names, ["CAM1", "RT2", "COM1"]);
    assert_eq!(
        others,
        [
            "ODO1 local: Global",  // every configuration needs NAV
            "PWR1 global: Record", // nobody is left to report it
            "SW3 global: Record",  // the same
            // A unique diagnosis knows that the filter is the cause, and odometry takes over.
            "LOC1 local: AdaptMcl",
            "OPR1 local: Global", // the operator who does not answer cannot be asked
        ]
    );
}

#[test]
fn the_rows_counted() {
    let with = |persistence| RULES.iter().filter(|it| it.persistence == persistence).count();
    assert_eq!(
        [Persistence::Permanent, Persistence::Transient, Persistence::Intermittent].map(with),
        [26, 13, 1]
    );
    let severe = |severity| RULES.iter().filter(|it| it.autonomous == severity).count();
    assert_eq!(
        [Severity::Weak, Severity::Medium, Severity::Hard, Severity::Fatal].map(severe),
        [10, 7, 15, 8]
    );
}

#[test]
fn of_several_settings_the_slowest_and_the_poorest_hold() {
    use cotama_models::cotama::{Adjusted, Adjustment, Adjustments, Mode};
    let both = Adjustments::of(&[Adjustment::TrustLocalisation, Adjustment::WidenTolerance]);
    assert_eq!(both.effect(Mode::Autonomous), Adjusted { speed: 700, quality: 900 });
    let none = Adjusted { speed: 1_000, quality: 1_000 };
    assert_eq!(Adjustments::NONE.effect(Mode::Autonomous), none);
    // Frames count where the operator drives.
    let frames = Adjustments::of(&[Adjustment::FewerFrames]);
    assert_eq!(frames.effect(Mode::Autonomous), none);
    assert_eq!(frames.effect(Mode::Teleoperated), Adjusted { speed: 500, quality: 800 });
}

#[test]
fn several_candidates_change_a_setting_only_if_they_agree() {
    use cotama_models::cotama::FailureMode::{Cam2, Com2, Odo2, Odo3};
    use cotama_models::cotama::{Adjustment, Diagnosis, FailureModes};
    let of = |modes: &[_]| Diagnosis::Ambiguous(FailureModes::of(modes)).adjustment();
    assert_eq!(of(&[Cam2, Com2]), Some(Adjustment::FewerFrames));
    assert_eq!(of(&[Odo2, Odo3]), None);
}

/// The worst of what it may be, and the report that all of it has.
#[test]
fn an_ambiguous_diagnosis_is_judged_by_its_worst_candidate() {
    use cotama_models::cotama::FailureMode::{Cam1, Cam2, Mot1, Mot2, Odo2, Odo4, Son1};
    use cotama_models::cotama::{Diagnosis, FailureModes, Flag, Flags, Mode, Report, Severity};
    let judged = |modes: &[_], flags: &[_]| {
        let diagnosis = Diagnosis::Ambiguous(FailureModes::of(modes));
        diagnosis.judged(Flags::of(flags), Mode::Autonomous)
    };
    // Medium and weak, both minor.
    assert_eq!(judged(&[Odo2, Odo4], &[]), (Some(Report::Minor), Severity::Medium));
    assert_eq!(judged(&[Son1, Cam2], &[]), (Some(Report::Ambiguous), Severity::Hard));
    assert_eq!(judged(&[Cam1, Mot2], &[Flag::Bumper]), (Some(Report::Collision), Severity::Hard));
    assert_eq!(judged(&[Mot1], &[]), (Some(Report::Vital), Severity::Fatal));
}

#[test]
fn a_module_that_makes_or_reads_sonar_values_is_lost_as_the_sonars_are() {
    use cotama_models::cotama::{Health, Loss, Resource, Resources};
    let faulty = |it| Losses::from(Health { faulty: Modules::of(&[it]), ..Health::SOUND });
    assert!([Module::Sim, Module::Ust].into_iter().all(|it| faulty(it).has(Loss::Sonar)));
    assert!(!faulty(Module::Mcl).has(Loss::Sonar) && faulty(Module::Mcl).has(Loss::Mcl));
    let lost = |it| Losses::from(Health { lost: Resources::of(&[it]), ..Health::SOUND });
    assert!(lost(Resource::SonarArrays).has(Loss::Sonar) && lost(Resource::Map).has(Loss::Mcl));
    assert!(lost(Resource::Camera).has(Loss::Camera) && lost(Resource::LaptopCpu).has(Loss::Vital));
}
