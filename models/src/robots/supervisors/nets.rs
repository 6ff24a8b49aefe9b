//! The supervisors of a robot, net by net.

use super::cubes::{Cube, cubes};
use super::draft::{Draft, Line};
use super::{told, told_alone, told_as, word};
use crate::robots::{
    Decision, Mode, Report, Robot, Situation, SubObjective, Where, ask_first, decide,
};
use cotama_core::net::owned::OwnedNet;

/// A sub-objective with its number and its name in nets.
pub(super) struct Part<'r> {
    pub(super) number: usize,
    pub(super) name: String,
    pub(super) is: &'r SubObjective,
}

/// The sub-objectives, the autonomous ones in the order in which they follow one another.
pub(super) fn parts(robot: &Robot, mode: Mode) -> Vec<Part<'_>> {
    let all = robot.sub_objectives.iter().enumerate().filter(|it| it.1.mode == mode);
    all.map(|(number, is)| Part { number, name: word(&is.name), is }).collect()
}

/// Whether an adapter chooses among configurations of a sub-objective.
pub(super) fn has_adapter(it: &SubObjective) -> bool {
    it.configurations.len() > 1
}

/// The flag of a loss in every net.
pub(in crate::robots) fn lost(robot: &Robot, loss: usize) -> String {
    format!("lost_{}", robot.losses.losses.get(loss).map_or_else(String::new, |it| word(&it.name)))
}

pub(super) fn configuration(robot: &Robot, it: usize) -> String {
    robot.configurations.get(it).map_or_else(String::new, |it| word(&it.name))
}

/// Adds the losses of a case to the conditions of a line.
fn case(robot: &Robot, line: Line, cube: Cube) -> Line {
    let all = 0..robot.losses.losses.len();
    all.fold(line, |line, loss| match (cube.lost >> loss & 1, cube.kept >> loss & 1) {
        (1, _) => line.when(&lost(robot, loss), true),
        (_, 1) => line.when(&lost(robot, loss), false),
        _ => line,
    })
}

/// Declares the losses of which a net may ask.
fn losses(robot: &Robot, net: &mut Draft) {
    for loss in 0..robot.losses.losses.len() {
        net.shared(&lost(robot, loss));
    }
}

/// Step of the local supervisor when a sub-objective is to start.
#[derive(Clone, Copy, PartialEq)]
enum Entry {
    Starts,
    Asks,
    GivesUp,
}

/// Lines that start a sub-objective, or ask the operator where it cannot run, or give up.
fn enter(robot: &Robot, net: &mut Draft, to: &Part<'_>, line: &dyn Fn(&str, &str) -> Line) {
    let entry = |lost: u32| match robot.best(to.number, lost) {
        Some(_) => Entry::Starts,
        None if robot.can_ask(lost) => Entry::Asks,
        None => Entry::GivesUp,
    };
    for (number, (cube, entry)) in cubes(robot.losses.all(), 0, &entry).into_iter().enumerate() {
        let case_of = |it| case(robot, it, cube);
        net.line(match entry {
            Entry::Starts => case_of(line(&format!("{}", number + 1), &to.name))
                .emits(format!("start_{}", to.name)),
            Entry::Asks => case_of(line(&format!("{}", number + 1), "Waits")).emits("op_request"),
            Entry::GivesUp => case_of(line(&format!("{}", number + 1), "Waits")).emits("no_way"),
        });
    }
}

/// The local supervisor: one autonomous sub-objective after another, and the operator when the
/// robot needs help (Durand et al., TAROS 2010, Fig. 3).
pub(super) fn local(robot: &Robot) -> OwnedNet {
    let (own, operator) = (parts(robot, Mode::Autonomous), parts(robot, Mode::Operator));
    let mut net = Draft::new("local", "Local supervisor: which sub-objective of a drive runs.");
    net.place("Idle", 1, "No drive.");
    for it in own.iter().chain(&operator) {
        net.place(&it.name, 0, &it.is.name);
    }
    net.place("Waits", 0, "The robot stands and waits for the operator, or for its end.");
    net.place("End", 0, "The goal is reached.");
    losses(robot, &mut net);
    net.shared("local_pending");
    net.shared("global_pending");
    net.event("local_event", "The sub-objective needs the operator.");
    net.event("start_drive", "A drive begins.");
    net.event("tick", "The next round.");
    net.event("gs_abort", "The mission ends.");
    for it in own.iter().chain(&operator) {
        net.event(&format!("{}_done", it.name), "The sub-objective is reached.");
        net.output(&format!("start_{}", it.name), "");
        net.output(&format!("stop_{}", it.name), "");
    }
    for it in &operator {
        net.event(&format!("op_{}", it.name), "The operator chooses it.");
    }
    for it in ["op_request", "no_way", "ended", "drive_done"] {
        net.output(it, "");
    }

    if let Some(first) = own.first() {
        enter(robot, &mut net, first, &|number, to| {
            Line::on(format!("start{number}"), "start_drive").goes("Idle", to)
        });
    }
    for pair in own.windows(2) {
        let done = format!("{}_done", pair[0].name);
        enter(robot, &mut net, &pair[1], &|number, to| {
            let line = Line::on(format!("{done}{number}"), &done).goes(&pair[0].name, to);
            line.emits(format!("stop_{}", pair[0].name))
        });
    }
    let ends = own.last().into_iter().chain(operator.iter().filter(|it| it.is.moves));
    for it in ends {
        let done = format!("{}_done", it.name);
        // What may take the goal back is answered first.
        let line = Line::on(&done, &done).goes(&it.name, "End").when("local_pending", false);
        let line = line.when("global_pending", false);
        net.line(line.emits(format!("stop_{}", it.name)).emits("ended"));
    }
    net.line(Line::on("next", "tick").goes("End", "Idle").emits("drive_done"));
    for it in operator.iter().filter(|it| !it.is.moves) {
        let (done, stop) = (format!("{}_done", it.name), format!("stop_{}", it.name));
        let Some(first) = own.first() else { continue };
        enter(robot, &mut net, first, &|number, to| {
            Line::on(format!("{done}{number}"), &done).goes(&it.name, to).emits(&stop)
        });
    }
    for it in own.iter().chain(&operator) {
        let line = Line::on(format!("ask_{}", it.name), "local_event").goes(&it.name, "Waits");
        net.line(line.emits(format!("stop_{}", it.name)).emits("op_request"));
    }
    for it in &operator {
        let others = operator.iter().filter(|other| other.number != it.number);
        let from = others.map(|it| it.name.as_str()).chain(["Waits"]);
        let runs = |lost: u32| robot.best(it.number, lost).is_some();
        for from in from {
            let chosen = cubes(robot.losses.all(), 0, &runs);
            for (number, (cube, _)) in chosen.into_iter().filter(|it| it.1).enumerate() {
                let name = format!("{}_to_{}{}", from, it.name, number + 1);
                let line = Line::on(name, format!("op_{}", it.name)).goes(from, &it.name);
                let line = case(robot, line, cube);
                let stops = (from != "Waits").then(|| format!("stop_{from}"));
                let line = stops.into_iter().fold(line, Line::emits);
                net.line(line.emits(format!("start_{}", it.name)));
            }
        }
    }
    for it in own.iter().chain(&operator) {
        let line = Line::on(format!("abort_{}", it.name), "gs_abort").goes(&it.name, "Idle");
        net.line(line.emits(format!("stop_{}", it.name)));
    }
    for from in ["Waits", "End"] {
        net.line(Line::on(format!("abort_{from}"), "gs_abort").goes(from, "Idle"));
    }
    net.done()
}

/// The adapter of a sub-objective: which of its configurations runs (Durand et al., TAROS 2010,
/// Fig. 4).
pub(super) fn adapter(robot: &Robot, of: &Part<'_>) -> OwnedNet {
    let doc = format!("Adapter of {}: which modules run.", of.is.name);
    let mut net = Draft::new(&super::adapter(of.is), &doc);
    net.place("Off", 1, "Not running.");
    let all = &of.is.configurations;
    for &it in all {
        let doc = robot.configurations.get(it).map_or("", |it| it.name.as_str());
        net.place(&configuration(robot, it), 0, doc);
        net.output(&format!("run_{}", configuration(robot, it)), "");
    }
    losses(robot, &mut net);
    net.event("adapt", "The configuration that runs is not available any more.");
    net.event("start", "The sub-objective starts.");
    net.event("stop", "The sub-objective ends.");
    let best = |lost: u32| robot.best(of.number, lost);
    for (number, (cube, to)) in cubes(robot.losses.all(), 0, &best).into_iter().enumerate() {
        let Some(to) = to.map(|it| configuration(robot, it)) else { continue };
        let line = Line::on(format!("start{}", number + 1), "start").goes("Off", &to);
        net.line(case(robot, line, cube).emits(format!("run_{to}")));
    }
    for &it in all {
        let from = configuration(robot, it);
        let next = |lost: u32| {
            let stays = robot.running(lost) >> it & 1 == 1;
            if stays { None } else { robot.next(it, lost) }
        };
        for (number, (cube, to)) in cubes(robot.losses.all(), 0, &next).into_iter().enumerate() {
            let Some(to) = to.map(|it| configuration(robot, it)) else { continue };
            let line = Line::on(format!("{from}_adapts{}", number + 1), "adapt").goes(&from, &to);
            net.line(case(robot, line, cube).emits(format!("run_{to}")));
        }
        net.line(Line::on(format!("{from}_stops"), "stop").goes(&from, "Off"));
    }
    net.done()
}

/// A decision on a report, by its number.
type Decides = fn(&Robot, usize, Situation) -> Decision;

/// The reports that ask the operator first, by number.
fn asking(robot: &Robot) -> impl Iterator<Item = (usize, &Report)> {
    robot.losses.reports.iter().enumerate().filter(|it| it.1.asks.is_some())
}

/// The contextual supervisor: [`decide`] and [`ask_first`] as a net.
pub(super) fn contextual(robot: &Robot) -> OwnedNet {
    let doc = "Contextual supervisor: what a report means where the robot is.";
    let mut net = Draft::new("contextual", doc);
    net.place("Ready", 1, "Decides at once.");
    let all: Vec<_> =
        parts(robot, Mode::Autonomous).into_iter().chain(parts(robot, Mode::Operator)).collect();
    for it in &all {
        net.shared(&format!("in_{}", it.name));
    }
    net.shared("waits");
    for &it in all.iter().filter(|it| has_adapter(it.is)).flat_map(|it| &it.is.configurations) {
        net.shared(&format!("runs_{}", configuration(robot, it)));
    }
    losses(robot, &mut net);
    for (number, failures) in told_alone(robot) {
        net.event(&told_as(robot, number), &told(robot, &failures));
    }
    for it in asking(robot) {
        let doc = format!("{}: the operator is asked first.", told(robot, &it.1.failures));
        net.event(&format!("ask_{}", word(&it.1.name)), &doc);
    }
    net.output("global_event", "");
    net.output("local_event", "");
    let adapters = all.iter().filter(|it| has_adapter(it.is));
    adapters.for_each(|it| net.output(&format!("adapt_{}", it.name), ""));

    let alone = robot.losses.reports.iter().enumerate();
    let alone = alone.filter(|it| robot.losses.told_as(it.0) == it.0);
    let alone = alone.map(|(number, it)| (number, it, word(&it.name), decide as Decides));
    let asking = asking(robot)
        .map(|(number, it)| (number, it, format!("ask_{}", word(&it.name)), ask_first as Decides));
    for (number, report, event, decide) in alone.chain(asking) {
        let given = report.loss.map_or(0, |it| 1 << it);
        let mut place = |at: Where, wheres: &[(String, bool)], adapter: &str, name: &str| {
            let of = |lost: u32| decide(robot, number, Situation { at, lost });
            let cases = cubes(robot.losses.all(), given, &of).into_iter();
            let cases = cases.filter(|it| it.1 != Decision::Record).enumerate();
            for (variant, (cube, decision)) in cases {
                let name = format!("{event}_{name}{}", variant + 1);
                let line = Line::on(name, &event).goes("Ready", "Ready");
                let line = wheres.iter().fold(line, |line, it| line.when(&it.0, it.1));
                let line = case(robot, line, cube);
                net.line(match decision {
                    Decision::Stop => line.emits("global_event"),
                    Decision::Ask => line.emits("local_event"),
                    Decision::Adapt | Decision::Record => line.emits(format!("adapt_{adapter}")),
                });
            }
        };
        let decides = |at, lost| decide(robot, number, Situation { at, lost });
        let losses = || (0..=robot.losses.all()).filter(|it| it & given == given);
        let alike = |one, other| losses().all(|it| decides(one, it) == decides(other, it));
        let runs =
            |it: &Part<'_>, configuration| Where::Runs { sub_objective: it.number, configuration };
        let mut everywhere = all.iter().flat_map(|it| {
            it.is.configurations.iter().map(move |configuration| runs(it, *configuration))
        });
        if alike(Where::Rests, Where::Waits) && everywhere.all(|it| alike(Where::Rests, it)) {
            place(Where::Rests, &[], "", "");
            continue;
        }
        let at_rest: Vec<_> = all.iter().map(|it| (format!("in_{}", it.name), false)).collect();
        let at_rest = [at_rest, vec![("waits".to_owned(), false)]].concat();
        place(Where::Rests, &at_rest, "", "at_rest");
        place(Where::Waits, &[("waits".to_owned(), true)], "", "waits");
        for it in &all {
            let here = (format!("in_{}", it.name), true);
            let mut others = it.is.configurations.iter().map(|of| runs(it, *of));
            if let (true, Some(first)) = (has_adapter(it.is), others.next())
                && others.all(|it| alike(first, it))
            {
                place(first, &[here], &it.name, &it.name);
                continue;
            }
            for &of in &it.is.configurations {
                let name = configuration(robot, of);
                let own = has_adapter(it.is).then(|| (format!("runs_{name}"), true));
                let wheres: Vec<_> = [here.clone()].into_iter().chain(own).collect();
                place(runs(it, of), &wheres, &it.name, &name);
            }
        }
    }
    if robot.operator.is_some() {
        net.event("refusal", "The operator gives up, or does not answer in time.");
        let waits = parts(robot, Mode::Operator).into_iter().map(|it| format!("in_{}", it.name));
        for at in waits.chain(["waits".to_owned()]) {
            let line = Line::on(format!("refusal_{at}"), "refusal").goes("Ready", "Ready");
            net.line(line.when(&at, true).emits("global_event"));
        }
    }
    net.done()
}

/// The operator: answers as long as he is reached; gives up, or is silent for too long, at any
/// time.
pub(super) fn operator(robot: &Robot) -> OwnedNet {
    let all = parts(robot, Mode::Operator);
    let mut net = Draft::new("operator", "The operator: may do anything, at any time.");
    net.place("Ready", 1, "May do anything.");
    net.shared("waits");
    for it in &all {
        net.shared(&format!("in_{}", it.name));
    }
    losses(robot, &mut net);
    net.event("gives_up", "He gives up, or is silent for too long.");
    net.output("refusal", "");
    let reached = |lost: u32| robot.reaches_operator(lost);
    let reached = cubes(robot.losses.all(), 0, &reached);
    let reached: Vec<_> = reached.into_iter().filter(|it| it.1).map(|it| it.0).collect();
    for it in &all {
        let (choose, done) = (format!("choose_{}", it.name), format!("finish_{}", it.name));
        net.event(&choose, "He chooses it.");
        net.event(&done, "He is done with it.");
        net.output(&format!("op_{}", it.name), "");
        net.output(&format!("{}_done", it.name), "");
        let others = all.iter().filter(|other| other.number != it.number);
        let from: Vec<_> = others.map(|it| format!("in_{}", it.name)).collect();
        for (number, cube) in reached.iter().enumerate() {
            for at in from.iter().map(String::as_str).chain(["waits"]) {
                let name = format!("{choose}_{at}{}", number + 1);
                let line = Line::on(name, &choose).goes("Ready", "Ready").when(at, true);
                net.line(case(robot, line, *cube).emits(format!("op_{}", it.name)));
            }
            let line = Line::on(format!("{done}{}", number + 1), &done).goes("Ready", "Ready");
            let line = line.when(&format!("in_{}", it.name), true);
            net.line(case(robot, line, *cube).emits(format!("{}_done", it.name)));
        }
    }
    let everywhere = all.iter().map(|it| format!("in_{}", it.name));
    for at in everywhere.chain(["waits".to_owned()]) {
        let line = Line::on(format!("gives_up_{at}"), "gives_up").goes("Ready", "Ready");
        net.line(line.when(&at, true).emits("refusal"));
    }
    net.done()
}
