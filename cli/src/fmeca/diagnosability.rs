//! Which failure modes cannot be told apart in which status, why, and which probes would tell them.

use crate::answers::fmeca::{
    Diagnosability, GroupRow, PairRow, ProbeRow, StatusRow, UndetectableRow,
};
use cotama_models::fmeca::{Analysis, Mode, Status};
use cotama_models::robots::{Observer, Parts, Robot, members};

/// Every status, and every probe: of a robot the sound one, and each single loss that leaves it
/// moving and takes something that an observer needs.
pub(crate) fn of<'a>(analysis: &'a Analysis, robot: Option<&'a Robot>) -> Diagnosability<'a> {
    let unseen = |mode: &Mode| match analysis.names(&mode.sometimes).as_slice() {
        [] => "it raises no flag, and no reason is stated".to_owned(),
        flags => format!("it raises {} only sometimes", or(flags)),
    };
    let sound = status(analysis, &analysis.sound(), unseen);
    let losses = robot.into_iter().flat_map(|robot| {
        let all = 0..robot.losses.losses.len();
        let all = all.filter(|it| moves(robot, *it) && blinds(robot, *it));
        all.map(|it| after(analysis, robot, it))
    });
    Diagnosability {
        statuses: std::iter::once(sound).chain(losses).collect(),
        probes: analysis.probes().iter().map(|it| probe(analysis, it)).collect(),
    }
}

/// Whether a robot that has lost this goes on by itself.
fn moves(robot: &Robot, loss: usize) -> bool {
    let own = robot.sub_objectives.iter().enumerate().filter(|it| it.1.moves);
    own.into_iter().any(|it| robot.best(it.0, 1 << loss).is_some())
}

/// Whether an observer lacks something then.
fn blinds(robot: &Robot, loss: usize) -> bool {
    let gone = robot.losses.losses.get(loss).map_or(0, |it| it.modules);
    robot.observers.iter().any(|it| it.needs.modules & gone != 0)
}

/// The robot after a loss.
fn after<'a>(analysis: &'a Analysis, robot: &'a Robot, loss: usize) -> StatusRow<'a> {
    let of = robot.losses.losses.get(loss);
    let gone = of.map_or(0, |it| it.modules);
    let told = status(analysis, &Status::after(robot, loss), |mode| {
        let blind = robot.observers.iter().filter(|it| it.needs.modules & gone != 0);
        let blind = blind.filter(|it| raises(it, analysis, mode));
        let why = |it: &Observer| {
            let lacks = it.needs.modules & gone;
            let lacks = robot.names_of(Parts { hardware: 0, modules: lacks });
            format!("{} needs {}", it.name, or(&lacks))
        };
        blind.map(why).collect::<Vec<_>>().join("; ")
    });
    StatusRow {
        lost: of.map(|it| it.name.as_str()),
        modules_unavailable: members(gone)
            .filter_map(|it| robot.modules.get(it).map(|it| it.name.as_str()))
            .collect(),
        ..told
    }
}

fn raises(observer: &Observer, analysis: &Analysis, mode: &Mode) -> bool {
    analysis.names(&mode.flags).iter().any(|flag| observer.flags.iter().any(|it| it == flag))
}

fn status<'a>(
    analysis: &'a Analysis,
    status: &Status,
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
        status: status.name.clone(),
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

fn probe<'a>(analysis: &'a Analysis, it: &'a cotama_models::fmeca::Probe) -> ProbeRow<'a> {
    ProbeRow { name: &it.name, doc: &it.doc, shows: analysis.ids(it.shows.iter()) }
}

/// A list in words.
fn or(items: &[impl AsRef<str>]) -> String {
    match items {
        [] => "nothing".to_owned(),
        [one] => one.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<_> = first.iter().map(AsRef::as_ref).collect();
            format!("{} or {}", first.join(", "), last.as_ref())
        }
    }
}
