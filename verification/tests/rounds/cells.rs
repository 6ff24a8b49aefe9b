//! The decisions of the contextual supervisor of a system, cell by cell, beside the function: also
//! in cells that are reached only when two things are reported in one round.

use cotama_core::net::{Net, Role};
use cotama_core::system::System;
use cotama_models::cotama::{
    Decision, Loss, Losses, Report, Situation, decide, local, path_following, teleoperation,
};

/// Whether it decides otherwise somewhere, which breaks CS1.
pub(crate) fn differ(system: &System<'_>) -> bool {
    let net = system.components.iter().find(|it| it.name == "cs").unwrap().net;
    situations().any(|at| {
        let reported = Report::ALL.iter().map(|&it| (event(it), decide(it, at)));
        let others = [("hard", hard(at)), ("avoidance", avoidance(at))];
        reported.chain(others).any(|(event, decision)| decided(net, event, at) != emits(decision))
    })
}

/// Iterates over the situations whose places fit together, with the losses that the net reads.
fn situations() -> impl Iterator<Item = Situation> {
    use local::State::{End, Following, HandOver, Idle, Planning, Teleoperated, Teleprogrammed};
    use path_following::State::{Degraded, Odometric, Off, Optimal, Reactive, Reduced};
    use teleoperation::State as To;
    let quiet =
        [Idle, Planning, HandOver, Teleprogrammed, End].map(|local| (local, Off, To::Off, 2));
    let following = [(Optimal, 2), (Reduced, 1), (Reduced, 0), (Odometric, 2), (Degraded, 2)];
    let following = following.into_iter().chain([2, 1, 0].map(|it| (Reactive, it)));
    let following = following.map(|(following, level)| (Following, following, To::Off, level));
    let teleoperated = [To::Full, To::Degraded].map(|it| (Teleoperated, Off, it, 2));
    let all = quiet.into_iter().chain(following).chain(teleoperated);
    let losses = [&[][..], &[Loss::Mcl], &[Loss::Wifi], &[Loss::Mcl, Loss::Wifi]];
    all.flat_map(move |(local, following, teleoperation, level)| {
        losses.map(|lost| Situation {
            local,
            following,
            teleoperation,
            level,
            lost: Losses::of(lost),
        })
    })
}

const fn event(report: Report) -> &'static str {
    match report {
        Report::Mcl => "mcl_lost",
        Report::Wifi => "wifi_lost",
        _ => report.name(),
    }
}

/// Any other hard failure: for the operator, or for nobody who can be reached.
fn hard(at: Situation) -> Decision {
    use local::State::{Following, Planning, Teleoperated};
    match at.local {
        Planning | Following | Teleoperated if at.lost.has(Loss::Wifi) => Decision::Global,
        Planning | Following | Teleoperated => Decision::Local,
        _ => Decision::Record,
    }
}

fn avoidance(at: Situation) -> Decision {
    match at.teleoperation {
        teleoperation::State::Full => Decision::AdaptSonarTeleoperation,
        _ if at.following == path_following::State::Reactive => Decision::AdaptAvoidance,
        _ => Decision::Record,
    }
}

const fn emits(decision: Decision) -> Option<&'static str> {
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

/// Returns the output of the first transition that is enabled.
fn decided<'n>(net: &Net<'n>, event: &str, at: Situation) -> Option<&'n str> {
    let tokens = |name: &str| match name {
        "planning" => u32::from(at.local == local::State::Planning),
        "following" => u32::from(at.local == local::State::Following),
        "hand_over" => u32::from(at.local == local::State::HandOver),
        "teleprogrammed" => u32::from(at.local == local::State::Teleprogrammed),
        "teleoperated" => u32::from(at.local == local::State::Teleoperated),
        "optimal" => u32::from(at.following == path_following::State::Optimal),
        "reduced" => u32::from(at.following == path_following::State::Reduced),
        "odometric" => u32::from(at.following == path_following::State::Odometric),
        "reactive" => u32::from(at.following == path_following::State::Reactive),
        "degraded" => u32::from(at.following == path_following::State::Degraded),
        "avoiding" => u32::from(at.teleoperation == teleoperation::State::Full),
        "wifi" => u32::from(!at.lost.has(Loss::Wifi)),
        "mcl" => u32::from(!at.lost.has(Loss::Mcl)),
        "level" => u32::from(at.level),
        _ => 1,
    };
    let holds = |place: usize| match net.places[place].role {
        Role::Complement(of) => {
            net.places[of.0 as usize].bound - tokens(net.places[of.0 as usize].name)
        }
        _ => tokens(net.places[place].name),
    };
    let fires = net.transitions.iter().find(|it| {
        it.on.is_some_and(|on| net.events[on.0 as usize].name == event)
            && it.take.iter().chain(it.read).all(|arc| holds(arc.place.0 as usize) >= arc.weight)
    });
    fires?.emits.first().map(|it| net.outputs[it.0 as usize].name)
}

#[test]
fn the_shipped_one_decides_as_the_function() {
    assert!(!differ(&cotama_models::cotama::delivery::SYSTEM));
    assert_eq!(situations().filter(|it| it.is_consistent()).count(), 60);
}
