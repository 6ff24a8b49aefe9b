//! The decision as a function, over every report and every situation.

use cotama_core::net::{Net, Role};
use cotama_models::cotama::{
    Class, Decision, Loss, Losses, Report, Severity, Situation, by_availability, by_rules,
    contextual, decide, is_settled, judge, local, lost_after, path_following, severity,
    teleoperation,
};
use std::collections::BTreeMap;

const LOCAL: [local::State; 7] = {
    use local::State::{End, Following, HandOver, Idle, Planning, Teleoperated, Teleprogrammed};
    [Idle, Planning, Following, HandOver, Teleprogrammed, Teleoperated, End]
};
const FOLLOWING: [path_following::State; 6] = {
    use path_following::State::{Degraded, Odometric, Off, Optimal, Reactive, Reduced};
    [Off, Optimal, Reduced, Odometric, Reactive, Degraded]
};
const TELEOPERATION: [teleoperation::State; 3] = {
    use teleoperation::State::{Degraded, Full, Off};
    [Off, Full, Degraded]
};

fn situations() -> impl Iterator<Item = Situation> {
    LOCAL.into_iter().flat_map(|local| {
        FOLLOWING.into_iter().flat_map(move |following| {
            TELEOPERATION.into_iter().flat_map(move |teleoperation| {
                (0..3).flat_map(move |level| {
                    (0..128).filter_map(Losses::from_bits).map(move |lost| Situation {
                        local,
                        following,
                        teleoperation,
                        level,
                        lost,
                    })
                })
            })
        })
    })
}

fn cells() -> impl Iterator<Item = (Report, Situation)> {
    situations().flat_map(|situation| Report::ALL.iter().map(move |&report| (report, situation)))
}

fn consistent() -> impl Iterator<Item = (Report, Situation)> {
    cells().filter(|(_, situation)| situation.is_consistent())
}

/// Returns the effect of the net: the signal it emits and the value of `mcl` after it.
fn by_net(report: Report, situation: Situation) -> (Option<&'static str>, bool) {
    let net: &Net<'static> = &contextual::NET;
    let event = match report {
        Report::Mcl => "mcl_lost",
        Report::Wifi => "wifi_lost",
        _ => report.name(),
    };
    let tokens = |name: &str| -> u32 {
        u32::from(match name {
            "Ready" => true,
            "planning" => situation.local == local::State::Planning,
            "following" => situation.local == local::State::Following,
            "hand_over" => situation.local == local::State::HandOver,
            "teleprogrammed" => situation.local == local::State::Teleprogrammed,
            "teleoperated" => situation.local == local::State::Teleoperated,
            "optimal" => situation.following == path_following::State::Optimal,
            "reduced" => situation.following == path_following::State::Reduced,
            "odometric" => situation.following == path_following::State::Odometric,
            "reactive" => situation.following == path_following::State::Reactive,
            "degraded" => situation.following == path_following::State::Degraded,
            "avoiding" => situation.teleoperation == teleoperation::State::Full,
            "wifi" => !situation.lost.has(Loss::Wifi),
            "mcl" => !situation.lost.has(Loss::Mcl),
            "level" => return u32::from(situation.level),
            other => panic!("the net reads {other}, which no situation has"),
        })
    };
    let place_tokens = |place: usize| match net.places[place].role {
        Role::Complement(of) => {
            net.places[of.0 as usize].bound - tokens(net.places[of.0 as usize].name)
        }
        _ => tokens(net.places[place].name),
    };
    let fires = net.transitions.iter().find(|it| {
        it.on.is_some_and(|on| net.events[on.0 as usize].name == event)
            && it
                .take
                .iter()
                .chain(it.read)
                .all(|arc| place_tokens(arc.place.0 as usize) >= arc.weight)
    });
    let mcl = net.places.iter().position(|it| it.name == "mcl").unwrap();
    let takes_mcl = fires.is_some_and(|it| it.take.iter().any(|arc| arc.place.0 as usize == mcl));
    (
        fires.map(|it| net.outputs[it.emits[0].0 as usize].name),
        !situation.lost.has(Loss::Mcl) && !takes_mcl,
    )
}

const fn signal(decision: Decision) -> Option<&'static str> {
    match decision {
        Decision::Record => None,
        Decision::AdaptRt => Some("adapt_rt"),
        Decision::AdaptMcl => Some("adapt_mcl"),
        Decision::AdaptSonar => Some("adapt_sonar"),
        Decision::AdaptBump => Some("adapt_bump"),
        Decision::AdaptSmz => Some("adapt_smz"),
        Decision::AdaptAvoidance => Some("adapt_avoidance"),
        Decision::AdaptMinor => Some("adapt_minor"),
        Decision::AdaptSonarTeleoperation => Some("adapt_sonar_teleoperation"),
        Decision::AdaptMinorTeleoperation => Some("adapt_minor_teleoperation"),
        Decision::Local => Some("local_event"),
        Decision::Global => Some("global_event"),
    }
}

/// CS1, and the function and the net are one: in all 14 * 7 * 6 * 3 * 3 * 128 cells, consistent or
/// not.
#[test]
fn the_function_decides_as_the_net() {
    let mut compared = 0;
    for (report, situation) in cells() {
        let (emitted, mcl) = by_net(report, situation);
        assert_eq!(signal(decide(report, situation)), emitted, "{report:?} {situation:?}");
        // The net changes `mcl` only at the floor; its own loss is in the situation before the
        // report comes.
        let told = report
            .loss()
            .map_or(situation, |loss| Situation { lost: situation.lost.with(loss), ..situation });
        if told == situation {
            assert_eq!(
                !lost_after(report, situation).has(Loss::Mcl),
                mcl,
                "{report:?} {situation:?}"
            );
        }
        compared += 1;
    }
    assert_eq!(compared, 677_376);
    assert_eq!(consistent().count(), 26_880);
}

/// The cells where the two rules say something else than the table, with every earlier loss
/// answered.
#[test]
fn the_table_follows_from_the_two_rules_but_for_seven_cells() {
    let mut deviating = BTreeMap::new();
    let (mut settled, mut unsettled) = (0, 0);
    for (report, situation) in consistent() {
        // A loss is in the status vector when its report is read.
        if report.loss().is_some_and(|loss| !situation.lost.has(loss)) {
            continue;
        }
        let (rules, table) = (by_rules(report, situation), decide(report, situation));
        if !is_settled(report, situation) {
            assert!(
                rules.class() >= table.class(),
                "{report:?} {situation:?}: {rules:?} {table:?}"
            );
            unsettled += 1;
            continue;
        }
        settled += 1;
        if rules != table {
            let cell =
                format!("{} in {:?}: {rules:?}, table {table:?}", report.name(), situation.local);
            *deviating.entry(cell).or_insert(0) += 1;
        }
    }
    let cells: Vec<_> = deviating.iter().map(|(cell, count)| format!("{cell} ({count})")).collect();
    assert_eq!(
        cells,
        [
            "camera in HandOver: Local, table Record (16)",
            "camera in Teleprogrammed: Local, table Record (16)",
            "hard in HandOver: Local, table Record (32)",
            "hard in Teleprogrammed: Local, table Record (32)",
            "planner in Following: Global, table Record (64)",
            "planner in Following: Local, table Record (64)",
            "refusal in Following: Global, table Record (128)",
            "refusal in Planning: Global, table Record (64)",
        ]
    );
    assert_eq!((settled, unsettled), (5_868, 14_292));
}

/// CS2.
#[test]
fn a_higher_severity_never_gives_a_weaker_event() {
    const SEVERITIES: [Severity; 4] =
        [Severity::Weak, Severity::Medium, Severity::Hard, Severity::Fatal];
    for (report, situation) in cells() {
        let classes = SEVERITIES.map(|it| judge(report, it, situation).class());
        assert!(classes.is_sorted(), "{report:?} {situation:?}: {classes:?}");
        assert_eq!(
            by_rules(report, situation),
            judge(report, severity(report, situation), situation)
        );
    }
}

/// CS4. The cells without one are those in which an earlier loss, which asked for more, is not
/// answered yet.
#[test]
fn no_adapter_event_is_sent_when_no_configuration_of_the_sub_objective_is_left() {
    let (mut adapted, mut without) = (0, 0);
    for (report, situation) in consistent() {
        if decide(report, situation).class() != Class::Adapter {
            continue;
        }
        adapted += 1;
        let operator = !situation.lost.has(Loss::Wifi);
        if by_availability(situation, situation.lost.available(), operator) > Class::Adapter {
            assert!(!is_settled(report, situation), "{report:?} {situation:?}");
            without += 1;
        }
    }
    assert_eq!((adapted, without), (6_144, 3_264));
}

/// CS5.
#[test]
fn an_operator_out_of_reach_is_not_asked() {
    let mut asked = 0;
    for (report, situation) in cells() {
        if decide(report, situation) == Decision::Local {
            assert!(!situation.lost.has(Loss::Wifi), "{report:?} {situation:?}");
            asked += 1;
        }
        let waits = matches!(
            situation.local,
            local::State::HandOver | local::State::Teleprogrammed | local::State::Teleoperated
        );
        if waits && report == Report::Wifi {
            assert_eq!(decide(report, situation), Decision::Global);
        }
    }
    assert_eq!(asked, 31_104);
}

/// Withdrawals of a plan lead the adapter to the path following that the plan has chosen.
#[test]
fn the_adapter_comes_to_every_path_following_that_can_be_planned() {
    use cotama_models::cotama::Configuration::{
        FollowingDegraded, FollowingDvz, FollowingOdometric, FollowingOptimal,
    };
    let mut planned_for = [0; 4];
    for lost in (0..=u8::MAX).filter_map(Losses::from_bits) {
        let left = lost.available();
        let lacking = Losses::lacking(left);
        let followings = [FollowingOptimal, FollowingOdometric, FollowingDvz, FollowingDegraded];
        for (count, planned) in planned_for.iter_mut().zip(followings) {
            if planned.runs_on(left) {
                let withdrawn = lacking.beside(planned);
                assert_eq!(lacking.union(withdrawn).following(), planned, "{lacking}: {planned:?}");
                *count += 1;
            }
        }
    }
    assert_eq!(planned_for, [8, 16, 8, 64]);
}
