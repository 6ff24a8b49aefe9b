//! Which failure modes cannot be told apart in which status, why, and which probes would tell them.

use super::names::{flags, modes, modules, probes};
use crate::answers::fmeca::{
    AmbiguousCase, Diagnosability, GroupRow, PairRow, ProbeRow, StatusRow, UndetectableRow,
};
use cotama_models::cotama::{
    Class, Diagnosis, FailureMode, FailureModes, Flag, Flags, Loss, Losses, Modules, Probe, Probes,
    Report, Resource, Resources, Situation, available, decide, diagnose, local, path_following,
};
use cotama_models::fmeca::{Analysis, Mode, Status};

/// The statuses that are looked at: the sound robot, and each single loss that leaves it running.
const STATUSES: [(&str, Option<Resource>); 5] = [
    ("sound", None),
    ("sonar lost", Some(Resource::SonarArrays)),
    ("map lost", Some(Resource::Map)),
    ("WiFi lost", Some(Resource::WifiCard)),
    ("camera lost", Some(Resource::Camera)),
];

/// Every status, every probe, and point 3 of the published run.
pub(crate) fn of_the_robot(robot: &Analysis) -> Diagnosability<'_> {
    let needs = |at: usize| Probe::ALL.get(at).map_or_else(Vec::new, |it| modules(it.needs()));
    Diagnosability {
        statuses: STATUSES.iter().map(|&(name, lost)| after(robot, name, lost)).collect(),
        probes: probe_rows(robot, needs),
        ambiguous_case: Some(ambiguous_case()),
    }
}

/// Returns the diagnosability of the file's analysis.
pub(crate) fn of_a_file(analysis: &Analysis) -> Diagnosability<'_> {
    let unseen = |mode: &Mode| match analysis.names(&mode.sometimes).as_slice() {
        [] => "it raises no flag, and no reason is stated".to_owned(),
        flags => format!("it raises {} only sometimes", or(flags)),
    };
    Diagnosability {
        statuses: vec![status(analysis, &analysis.sound(), "sound", unseen)],
        probes: probe_rows(analysis, |_| Vec::new()),
        ambiguous_case: None,
    }
}

/// The robot after a loss, or without.
fn after<'a>(robot: &'a Analysis, name: &'static str, lost: Option<Resource>) -> StatusRow<'a> {
    let resources = lost.map_or(Resources::NONE, |it| Resources::of(&[it]));
    let left = available(Modules::NONE, resources);
    let told = status(robot, &Status::of_the_robot(name, left), name, |mode| {
        let flags = FailureMode::named(&mode.id).map(|it| it.rule().signature.always);
        let why = |flag| blind(flag, left);
        flags.into_iter().flat_map(Flags::iter).map(why).collect::<Vec<_>>().join("; ")
    });
    StatusRow {
        lost: lost.map(Resource::name),
        modules_unavailable: modules(Modules::ALL.without(left)),
        ..told
    }
}

/// Why a flag is not raised while these modules are left.
fn blind(flag: Flag, left: Modules) -> String {
    let (observers, missing) = (flag.observers(), flag.observed().without(left));
    if !missing.is_empty() {
        return format!(
            "`{}` is a check of what {missing} tells, which is unavailable",
            flag.name()
        );
    }
    let verb = if observers.len() == 1 { "is" } else { "are" };
    format!("`{}` is raised by {observers} alone, which {verb} unavailable", flag.name())
}

fn status<'a>(
    analysis: &'a Analysis,
    status: &Status,
    name: &'static str,
    unseen: impl Fn(&Mode) -> String,
) -> StatusRow<'a> {
    let told = analysis.diagnose(status);
    let unseen = |at: usize| {
        let mode = &analysis.modes()[at];
        let reason = mode.silent.clone().unwrap_or_else(|| unseen(mode));
        UndetectableRow { id: &mode.id, declared: mode.silent.is_some(), reason }
    };
    let group = |modes: &[usize]| {
        let shared = analysis.shared(modes, status);
        let (least, most) = shared.unwrap_or_else(|| (status.flags.clone(), status.flags.clone()));
        GroupRow {
            modes: analysis.ids(modes.iter().copied()),
            flags: analysis.names(&least),
            flags_optional: analysis.names(&most.without(&least)),
        }
    };
    let probes = |places: &[usize]| -> Vec<&str> {
        let named = places.iter().filter_map(|&at| analysis.probes().get(at));
        named.map(|it| it.name.as_str()).collect()
    };
    StatusRow {
        status: name,
        lost: None,
        modules_unavailable: Vec::new(),
        detectable: told.detectable.len(),
        undetectable: told.undetectable.iter().map(|&at| unseen(at)).collect(),
        impossible: analysis.ids(told.impossible),
        groups: told.groups.list.iter().map(|it| group(it)).collect(),
        groups_complete: told.groups.complete,
        pairs: told
            .pairs
            .iter()
            .map(|it| PairRow { shared: group(&it.modes), probes: probes(&it.probes) })
            .collect(),
        pairs_left_out: told.pairs_left_out,
        separable: told.separable,
        least_probes: probes(&told.least_probes),
    }
}

fn probe_rows<'a>(
    analysis: &'a Analysis,
    needs: impl Fn(usize) -> Vec<&'static str>,
) -> Vec<ProbeRow<'a>> {
    let row = |(at, it): (usize, &'a cotama_models::fmeca::Probe)| ProbeRow {
        name: &it.name,
        doc: &it.doc,
        shows: analysis.ids(it.shows.iter()),
        needs: needs(at),
    };
    analysis.probes().iter().enumerate().map(row).collect()
}

/// Point 3 of the published run (Durand et al., TAROS 2010, Section VI.A.2): avoidance drives the
/// robot back along its path, in front of an obstacle that the map does not have.
fn ambiguous_case() -> AmbiguousCase<'static> {
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

/// Returns the consequence of a decision of a class.
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
    listed(items, "and")
}

fn or(items: &[impl AsRef<str>]) -> String {
    listed(items, "or")
}

fn listed(items: &[impl AsRef<str>], word: &str) -> String {
    match items {
        [] => "nothing".to_owned(),
        [one] => one.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<_> = first.iter().map(AsRef::as_ref).collect();
            format!("{} {word} {}", first.join(", "), last.as_ref())
        }
    }
}
