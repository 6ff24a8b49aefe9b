//! Which failure modes cannot be told apart in which status, why, and which probes would tell them.

use super::names::{flags, modes, modules, probes};
use crate::answers::fmeca::{
    AmbiguousCase, Diagnosability, GroupRow, PairRow, ProbeRow, StatusRow, UndetectableRow,
};
use cotama_models::cotama::{
    Class, Diagnosis, FailureMode, FailureModes, Flag, Flags, Loss, Losses, Modules, Probe, Probes,
    Report, Resource, Resources, Situation, ambiguity_groups, available, confusable_pairs, decide,
    diagnose, is_detectable, local, path_following, shared_flags, undetectable,
};

/// The statuses that are looked at: the sound robot, and each single loss that leaves it running.
const STATUSES: [(&str, Option<Resource>); 5] = [
    ("sound", None),
    ("sonar lost", Some(Resource::SonarArrays)),
    ("map lost", Some(Resource::Map)),
    ("WiFi lost", Some(Resource::WifiCard)),
    ("camera lost", Some(Resource::Camera)),
];

/// Every status, every probe, and point 3 of the published run.
pub(crate) fn of_all() -> Diagnosability {
    Diagnosability {
        statuses: STATUSES.iter().map(|&(name, lost)| status(name, lost)).collect(),
        probes: Probe::ALL.iter().map(|&it| probe(it)).collect(),
        ambiguous_case: ambiguous_case(),
    }
}

fn status(name: &'static str, lost: Option<Resource>) -> StatusRow {
    let resources = lost.map_or(Resources::NONE, |it| Resources::of(&[it]));
    let status = available(Modules::NONE, resources);
    let all = || FailureMode::ALL.iter().copied();
    let unseen = undetectable(status);
    let impossible = all().filter(|&it| !is_detectable(it, status) && !unseen.has(it));
    let separating = |(a, b)| Probes::that_separate(a, b, status);
    StatusRow {
        status: name,
        lost: lost.map(Resource::name),
        modules_unavailable: modules(Modules::ALL.without(status)),
        detectable: all().filter(|&it| is_detectable(it, status)).count(),
        undetectable: unseen.iter().map(unseen_row).collect(),
        impossible: impossible.map(FailureMode::name).collect(),
        groups: ambiguity_groups(status).map(|it| group(it, status)).collect(),
        pairs: confusable_pairs(status)
            .map(|(a, b)| PairRow {
                shared: group(FailureModes::of(&[a, b]), status),
                probes: probes(separating((a, b))),
            })
            .collect(),
        separable: confusable_pairs(status).all(|pair| !separating(pair).is_empty()),
        least_probes: probes(Probes::least_that_help(status)),
    }
}

fn unseen_row(mode: FailureMode) -> UndetectableRow {
    let blind = |flag: Flag| {
        let observers = flag.observers();
        let verb = if observers.len() == 1 { "is" } else { "are" };
        format!("`{}` is raised by {observers} alone, which {verb} unavailable", flag.name())
    };
    let silent = mode.description().silent;
    let reason = silent.map_or_else(
        || mode.rule().signature.always.iter().map(blind).collect::<Vec<_>>().join("; "),
        str::to_owned,
    );
    UndetectableRow { id: mode.name(), declared: silent.is_some(), reason }
}

fn group(set: FailureModes, status: Modules) -> GroupRow {
    let (least, most) = shared_flags(set, status).unwrap_or_default();
    GroupRow { modes: modes(set), flags: flags(least), flags_optional: flags(most.without(least)) }
}

fn probe(it: Probe) -> ProbeRow {
    ProbeRow {
        name: it.name(),
        doc: it.doc(),
        shows: modes(it.shows()),
        needs: modules(it.needs()),
    }
}

/// Point 3 of the published run (Durand et al., TAROS 2010, Section VI.A.2): avoidance drives the
/// robot back along its path, in front of an obstacle that the map does not have.
fn ambiguous_case() -> AmbiguousCase {
    let raised = Flags::of(&[Flag::PoseGrowth, Flag::Backward]);
    let found = diagnose(raised, Modules::ALL);
    let candidates = match found {
        Diagnosis::Ambiguous(modes) => modes,
        Diagnosis::Unique(mode) => FailureModes::of(&[mode]),
        Diagnosis::None | Diagnosis::Unexplained => FailureModes::NONE,
    };
    let suspect = found.health(Modules::NONE).status_vector().suspect();
    let driving = Situation {
        local: local::State::Following,
        following: path_following::State::Optimal,
        ..Situation::AT_REST
    };
    let alone = Situation { lost: Losses::of(&[Loss::Wifi]), ..driving };
    let decided = decide(Report::Ambiguous, driving).class();
    let decided_alone = decide(Report::Ambiguous, alone).class();
    let helps = Probes::least_that_help(Modules::ALL)
        .iter()
        .filter(|probe| !probe.shows().common(candidates).is_empty())
        .fold(Probes::NONE, Probes::with);
    let seen: Vec<_> = raised
        .iter()
        .map(|it| format!("`{}` ({})", it.name(), it.doc().trim_end_matches('.')))
        .collect();
    let explained: Vec<_> = candidates.iter().map(|it| explanation(it, raised)).collect();
    let text = vec![
        format!(
            "Avoidance drives the robot back along its path, in front of an obstacle that the map \
             does not have. Two flags are raised: {}.",
            and(&seen)
        ),
        format!(
            "Each of {} failure modes explains just these flags: {}.",
            candidates.len(),
            explained.join("; ")
        ),
        format!(
            "So nothing is declared lost: {} are suspect until the matter is settled, and stay \
             available. The report is `{}`: while a path is followed, {}; when the operator cannot \
             be reached, {}.",
            and(&modules(suspect)),
            Report::Ambiguous.name(),
            consequence(decided),
            consequence(decided_alone),
        ),
        format!(
            "What would tell them apart without the operator: the probes {}.",
            and(&probes(helps))
        ),
    ];
    AmbiguousCase {
        flags: flags(raised),
        candidates: modes(candidates),
        modules_suspect: modules(suspect),
        decision: decided.name(),
        decision_without_operator: decided_alone.name(),
        probes: probes(helps),
        text,
    }
}

/// What a decision of a class does.
const fn consequence(class: Class) -> &'static str {
    match class {
        Class::Record => "it is recorded only",
        Class::Adapter => "the running configuration is adapted",
        Class::Local => "the robot stops and asks the operator, who looks with the camera",
        Class::Global => "the mission ends safely",
    }
}

/// How a failure mode explains the flags.
fn explanation(mode: FailureMode, raised: Flags) -> String {
    let (text, signature) = (mode.description(), mode.rule().signature);
    let always = and(&flags(signature.always.common(raised)));
    let sometimes = signature.sometimes.common(raised);
    let sometimes = if sometimes.is_empty() {
        String::new()
    } else {
        format!(", sometimes {}", and(&flags(sometimes)))
    };
    format!(
        "{} ({}: {}) always raises {always}{sometimes}",
        mode.name(),
        text.component,
        text.failure
    )
}

/// A list in words.
fn and(items: &[impl AsRef<str>]) -> String {
    match items {
        [] => "nothing".to_owned(),
        [one] => one.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<_> = first.iter().map(AsRef::as_ref).collect();
            format!("{} and {}", first.join(", "), last.as_ref())
        }
    }
}
