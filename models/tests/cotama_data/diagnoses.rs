//! The meaning of flags, and the questions they leave open.

use cotama_models::cotama::{
    Diagnosis, FailureMode, FailureModes, Flag, Flags, Health, Modules, Probes, Resource,
    Resources, ambiguity_groups, are_confusable, available, confusable_pairs, diagnose,
    is_detectable, shared_flags, undetectable,
};
use proptest::prelude::*;

fn groups(status: Modules) -> Vec<String> {
    ambiguity_groups(status).map(|it| it.to_string()).collect()
}

fn without(lost: Resource) -> Modules {
    available(Modules::NONE, Resources::of(&[lost]))
}

#[test]
fn no_flag_is_no_fault_and_an_unknown_mix_is_unexplained() {
    assert_eq!(diagnose(Flags::NONE, Modules::ALL), Diagnosis::None);
    let mix = Flags::of(&[Flag::Bumper, Flag::BatteryLow]);
    assert_eq!(diagnose(mix, Modules::ALL), Diagnosis::Unexplained);
}

/// Point 3 of the published run: two flags, three explanations, localisation and odometry under
/// suspicion.
#[test]
fn growing_distance_and_backward_motion_leave_three_candidates() {
    let found = diagnose(Flags::of(&[Flag::PoseGrowth, Flag::Backward]), Modules::ALL);
    assert_eq!(
        found,
        Diagnosis::Ambiguous(FailureModes::of(&[
            FailureMode::Odo2,
            FailureMode::Loc1,
            FailureMode::Loc2
        ]))
    );
    let status = found.health(Modules::NONE).status_vector();
    assert_eq!(status.suspect().to_string(), "MCL ODO");
    assert_eq!(status.available(), Modules::ALL);
}

/// A bump is an obstacle that avoidance did not see, or, without localisation, drift into a wall;
/// without sonars a stuck bumper looks the same.
#[test]
fn the_same_bump_means_something_else_in_another_status() {
    let bump = Flags::of(&[Flag::Bumper]);
    assert_eq!(diagnose(bump, Modules::ALL), Diagnosis::Unique(FailureMode::Col1));
    let no_sonar = without(Resource::SonarArrays);
    let wall_or_bumper = FailureModes::of(&[FailureMode::Bmp2, FailureMode::Loc3]);
    assert_eq!(diagnose(bump, no_sonar), Diagnosis::Ambiguous(wall_or_bumper));
    let no_map = without(Resource::Map);
    let either = FailureModes::of(&[FailureMode::Loc3, FailureMode::Col1]);
    assert_eq!(diagnose(bump, no_map), Diagnosis::Ambiguous(either));
}

#[test]
fn three_groups_cannot_be_told_apart_on_a_sound_robot() {
    assert_eq!(groups(Modules::ALL), ["ODO2 LOC1 LOC2", "BMP1 MOT3", "CAM2 COM2"]);
    assert_eq!(undetectable(Modules::ALL).to_string(), "PWR1 SW3");
}

/// After each single loss that leaves the robot running: the failure modes that nobody sees, those
/// that look alike, and the fewest probes against that.
#[test]
fn a_loss_blinds_observers() {
    let after = |lost| {
        let least = Probes::least(without(lost)).map(|it| it.to_string());
        (undetectable(without(lost)).to_string(), groups(without(lost)).join(", "), least)
    };
    let expect = |unseen: &str, alike: &str, probes: Option<&str>| {
        (unseen.to_owned(), alike.to_owned(), probes.map(str::to_owned))
    };
    // Without localisation drift is unseen; without sonars it is too, their observer looks at the
    // camera as before, and no probe tells a stall against an obstacle from one on a carpet edge.
    assert_eq!(
        after(Resource::SonarArrays),
        expect("ODO2 ODO3 ODO4 PWR1 SW3", "BMP1 MOT3, BMP2 LOC3, CAM2 COM2", None)
    );
    assert_eq!(
        after(Resource::Map),
        expect(
            "ODO2 ODO3 ODO4 PWR1 SW3",
            "BMP1 MOT3, CAM2 COM2, LOC3 COL1",
            Some("obstacle at stall frame time at source reckoning limit")
        )
    );
    let without_video = expect(
        "PWR1 SW3",
        "ODO2 LOC1 LOC2, BMP1 MOT3",
        Some("spread limit unmapped obstacle obstacle at stall"),
    );
    assert_eq!(after(Resource::WifiCard), without_video);
    assert_eq!(after(Resource::Camera), without_video);
}

#[test]
fn each_confusable_pair_has_its_probes() {
    use FailureMode::{Bmp1, Cam2, Col1, Com2, Loc1, Loc2, Loc3, Mot3, Odo2};
    let separating = |a, b| Probes::that_separate(a, b, Modules::ALL).to_string();
    assert_eq!(separating(Odo2, Loc1), "spread limit gyroscope");
    assert_eq!(separating(Odo2, Loc2), "unmapped obstacle gyroscope");
    assert_eq!(separating(Loc1, Loc2), "spread limit unmapped obstacle");
    assert_eq!(separating(Bmp1, Mot3), "obstacle at stall");
    assert_eq!(separating(Cam2, Com2), "frame time at source");
    assert_eq!(separating(Loc3, Col1), "reckoning limit");
}

/// Four on a sound robot; no three of them would do.
#[test]
fn the_least_probes_separate_all() {
    let least = Probes::least(Modules::ALL).unwrap();
    assert_eq!(
        least.to_string(),
        "spread limit unmapped obstacle obstacle at stall frame time at source"
    );
    let separate = |set: Probes| {
        FailureMode::ALL.iter().all(|&a| {
            FailureMode::ALL.iter().all(|&b| {
                !are_confusable(a, b, Modules::ALL) || set.iter().any(|probe| probe.separates(a, b))
            })
        })
    };
    for bits in 0..=Probes::ALL.bits() {
        let set = Probes::from_bits(bits).unwrap();
        assert!(set.len() >= 4 || !separate(set), "{set}");
    }
    assert!(separate(least));
}

/// Without a probe for a stall against an obstacle or on a carpet edge, the rest can still be told
/// apart.
#[test]
fn failure_modes_that_no_probe_separates_do_not_hide_separable_ones() {
    let no_sonar = without(Resource::SonarArrays);
    assert!(Probes::that_separate(FailureMode::Bmp1, FailureMode::Mot3, no_sonar).is_empty());
    assert_eq!(
        Probes::least_that_help(no_sonar).to_string(),
        "frame time at source reckoning limit"
    );
    assert_eq!(Some(Probes::least_that_help(Modules::ALL)), Probes::least(Modules::ALL));
}

/// The shared flags of two failure modes are flags that both explain, the fewest and the most.
#[test]
fn shared_flags_leave_both_failure_modes_open() {
    for status in [Modules::ALL, without(Resource::SonarArrays), without(Resource::Map)] {
        let pairs: Vec<_> = confusable_pairs(status).collect();
        for (a, b) in
            FailureMode::ALL.iter().flat_map(|&a| FailureMode::ALL.iter().map(move |&b| (a, b)))
        {
            let shared = shared_flags(FailureModes::of(&[a, b]), status);
            assert_eq!(shared.is_some() && a != b, are_confusable(a, b, status));
            assert_eq!(pairs.contains(&(a, b)), a < b && are_confusable(a, b, status));
            for raised in
                shared.into_iter().filter(|_| a != b).flat_map(|(least, most)| [least, most])
            {
                let found = diagnose(raised, status);
                assert!(
                    matches!(found, Diagnosis::Ambiguous(set) if set.has(a) && set.has(b)),
                    "{found:?}"
                );
            }
        }
    }
}

#[test]
fn a_flag_says_its_observation_in_words() {
    assert_eq!(Flag::Backward.doc(), "O-PF: backward for too long.");
}

/// GM3: what was told once is not told again.
#[test]
fn the_same_flags_twice_change_nothing() {
    for &mode in FailureMode::ALL {
        let raised = mode.rule().signature.always;
        let once = Health::SOUND.union(diagnose(raised, Modules::ALL).health(Modules::NONE));
        let twice = once.union(diagnose(raised, Modules::ALL).health(Modules::NONE));
        assert_eq!(once, twice, "{}", mode.name());
        assert_eq!(once.status_vector(), twice.status_vector());
        let silent = diagnose(Flags::NONE, Modules::ALL).health(Modules::NONE);
        assert_eq!(once.union(silent), once);
    }
}

fn flags() -> impl Strategy<Value = Flags> {
    prop::collection::vec(0..Flag::ALL.len(), 0..4)
        .prop_map(|list| list.into_iter().fold(Flags::NONE, |set, at| set.with(Flag::ALL[at])))
}

proptest! {
    /// A mode with the flags it always raises, and some it sometimes does, is always among the
    /// candidates.
    #[test]
    fn the_failure_that_happened_is_among_the_candidates(
        at in 0..FailureMode::ALL.len(),
        bits: u64,
        lost in 0..Resource::ALL.len(),
    ) {
        let mode = FailureMode::ALL[at];
        let status = without(Resource::ALL[lost]);
        let sometimes = mode.rule().signature.sometimes;
        let some = Flags::from_bits(sometimes.bits() & bits).unwrap();
        let found = diagnose(mode.rule().signature.always.union(some), status);
        if is_detectable(mode, status) {
            let named = match found {
                Diagnosis::Unique(it) => it == mode,
                Diagnosis::Ambiguous(set) => set.has(mode),
                Diagnosis::None | Diagnosis::Unexplained => false,
            };
            prop_assert!(named);
        }
    }

    /// Every ambiguous diagnosis lies in a group.
    #[test]
    fn no_diagnosis_is_more_ambiguous_than_a_group(raised in flags()) {
        if let Diagnosis::Ambiguous(set) = diagnose(raised, Modules::ALL) {
            prop_assert!(ambiguity_groups(Modules::ALL).any(|group| group.covers(set)));
        }
    }
}
