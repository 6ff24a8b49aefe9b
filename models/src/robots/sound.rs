//! Checks of a robot that was read: a part that makes no sense is an error.

use super::supervisors::word;
use super::{Failure, Mode, Parts, Robot, members, reached};
use crate::missions::Diagnostic;
use crate::missions::reader::fields::Sink;
use crate::names::quoted;
use crate::severity::Severity;
use std::collections::BTreeSet;
use std::ops::Range;

/// The places of what can make no sense.
#[derive(Default)]
pub(super) struct Places {
    pub(super) modules: Vec<Range<usize>>,
    pub(super) configurations: Vec<Range<usize>>,
    pub(super) flags: Vec<Range<usize>>,
    pub(super) failures: Vec<Range<usize>>,
    /// The masks, and where the operator is asked first; of a failure without, that of its name.
    pub(super) masks: Vec<Range<usize>>,
    pub(super) asks: Vec<Range<usize>>,
}

/// Names of nets and places that every robot has.
pub(super) const RESERVED: [&str; 13] = [
    "gs", "ls", "gom", "cs", "permit", "faults", "operator", "at_rest", "Idle", "Waits", "End",
    "Off", "Ready",
];

/// Returns a set of modules with all that they need.
pub(super) fn with_needs(robot: &Robot, modules: u64) -> u64 {
    let mut all = modules;
    loop {
        let needed = members(all).filter_map(|it| robot.modules.get(it));
        let more = needed.fold(all, |all, it| all | it.needs.modules);
        if more == all {
            return all;
        }
        all = more;
    }
}

/// Whether each module stands on hardware in the end, and needs no module that needs it: reports
/// those that do not.
pub(super) fn is_grounded(robot: &Robot, at: &Places, sink: &Sink) -> bool {
    for (number, it) in robot.modules.iter().enumerate() {
        let span = || at.modules.get(number).cloned().unwrap_or_default();
        let own = 1_u64 << number;
        if with_needs(robot, it.needs.modules) & own != 0 {
            let message = format!("{} needs itself, through what it needs", quoted(&it.name));
            let it = Diagnostic::new(span(), message, "a circle");
            sink.report(it.help("leave one of the needs out"));
        } else if members(with_needs(robot, own) | it.one_of)
            .filter_map(|it| robot.modules.get(it))
            .all(|it| it.needs.hardware == 0)
        {
            let message = format!("{} stands on no hardware", quoted(&it.name));
            let it = Diagnostic::new(span(), message, "nothing that can fail under it");
            sink.report(it.help("say in `hardware`, here or in what it needs, on what it runs"));
        }
    }
    sink.is_empty()
}

/// Whether the robot makes sense as a whole: reports what does not.
pub(super) fn makes_sense(robot: &Robot, at: &Places, sink: &Sink) -> bool {
    let place = |all: &[Range<usize>], number: usize| all.get(number).cloned().unwrap_or_default();
    let wrong = |span: Range<usize>, message: String, label: &str, help: &str| {
        sink.report(Diagnostic::new(span, message, label).help(help));
    };
    let configuration = |number| place(&at.configurations, number);
    if robot.sub_objectives.iter().all(|it| it.mode == Mode::Operator) {
        let help = "give one the mode `autonomous`";
        let message = "the robot does nothing by itself".to_owned();
        wrong(configuration(0), message, "no autonomous configuration", help);
    }
    names(robot, at, sink);
    let served = robot.sub_objectives.iter().find(|it| it.mode == Mode::Operator);
    if let (Some(it), None) = (served, robot.operator) {
        let number = it.configurations.first().copied().unwrap_or(0);
        let message = format!("the operator decides in {}, but is not reached", quoted(&it.name));
        let help = "say in `[operator]` which modules he is reached by: `needs = [\"lan\"]`";
        wrong(configuration(number), message, "no `operator`", help);
    }
    let reached = reached::configurations(robot);
    for (number, it) in robot.configurations.iter().enumerate() {
        let best = |lost| robot.best(it.sub_objective, lost) == Some(number);
        if !(0..=robot.losses.all()).any(best) {
            let message = format!(
                "{} never runs: whatever is lost, a better one runs, or it cannot either",
                quoted(&it.name)
            );
            let help = "let a failure lose what the better ones need, or change the ranks";
            wrong(configuration(number), message, "never reached", help);
        } else if reached >> number & 1 == 0 {
            let message =
                format!("{} never runs: nothing leads there while it can run", quoted(&it.name));
            let help = "let a failure that would lead there be less severe, or, for the operator, \
                        let one be hard; or leave it out";
            wrong(configuration(number), message, "never reached", help);
        }
    }
    let mut ids = BTreeSet::new();
    let raised: BTreeSet<_> =
        robot.failures.iter().flat_map(|it| it.flags.iter().chain(&it.sometimes)).collect();
    for (number, (_, flag)) in robot.flags().enumerate() {
        if !raised.contains(&number) {
            let message = format!("no failure raises the flag {}", quoted(flag));
            let help = "name it in `flags` of a failure, or leave it out";
            wrong(place(&at.flags, number), message, "raised by nothing", help);
        }
    }
    for (number, it) in robot.failures.iter().enumerate() {
        let span = || place(&at.failures, number);
        if !ids.insert(&it.id) {
            let message = format!("two failures are called {}", quoted(&it.id));
            wrong(span(), message, "twice", "give each a short name of its own");
        }
        let blind = robot.flags().enumerate().filter(|flag| it.flags.contains(&flag.0)).all(
            |(_, (observer, _))| {
                let needs = robot.observers.get(observer).map_or(Parts::NONE, |it| it.needs);
                let available = robot.available(it.loses);
                needs.hardware & it.loses.hardware != 0 || needs.modules & !available != 0
            },
        );
        if blind && it.unseen.is_none() && !it.no_plan {
            let message =
                format!("{} takes what each observer needs that would see it", quoted(&it.id));
            let help = "let an observer see it that does not need what is lost";
            wrong(span(), message, "never seen", help);
        }
        let works = |module: usize| robot.available(it.loses) >> module & 1 == 1;
        if let Some(again) =
            it.restarts.filter(|again| it.loses != Parts::NONE && works(again.module))
        {
            let module = robot.modules.get(again.module).map_or("", |it| it.name.as_str());
            let (id, module) = (quoted(&it.id), quoted(module));
            let message = format!("{id} starts {module} anew, which works without what it loses");
            let help = "start a module that needs what is lost, or leave `restart` out";
            wrong(span(), message, "does not help", help);
        }
        let fatal = [it.autonomous, it.operator] == [Severity::Fatal; 2];
        if fatal && it.sets.as_ref().is_some_and(|it| it.times.is_none()) {
            let message = format!("{} ends the mission, and sets something", quoted(&it.id));
            let help = "leave `set` out, or say with `times` how often it is tried first";
            wrong(span(), message, "of no use", help);
        }
        if it.autonomous == Severity::Hard && robot.operator.is_none() {
            let message = format!("{} is hard, and there is nobody to ask", quoted(&it.id));
            let help = "call it `fatal`, or add an `[operator]` and a configuration for him";
            wrong(span(), message, "nobody to ask", help);
        }
    }
    sink.is_empty()
}

/// Words of Rust, in which supervisors are printed.
const KEYWORDS: &str = "abstract as async await become box break const continue crate do dyn else \
    enum extern false final fn for gen if impl in let loop macro match mod move mut override priv \
    pub ref return self static struct super trait true try type typeof unsafe unsized use virtual \
    where while yield";

/// Reports names that the supervisors have already, or cannot have.
fn names(robot: &Robot, at: &Places, sink: &Sink) {
    let place = |all: &[Range<usize>], number: usize| all.get(number).cloned().unwrap_or_default();
    let wrong = |span: Range<usize>, message: String| {
        sink.report(Diagnostic::new(span, message, "taken").help("choose another name"));
    };
    let new = |taken: &mut BTreeSet<String>, name: &str, span: Range<usize>| {
        let word = word(name).to_lowercase();
        if !name.starts_with(|it: char| it.is_ascii_alphabetic()) {
            wrong(span, format!("{} does not begin with a letter", quoted(name)));
        } else if KEYWORDS.split_whitespace().any(|it| it == word) {
            wrong(span, format!("{} is a word of Rust", quoted(name)));
        } else if !taken.insert(word) {
            wrong(span, format!("the supervisors have another {}", quoted(name)));
        }
    };
    let mut places: BTreeSet<String> = RESERVED.iter().map(|it| it.to_lowercase()).collect();
    for it in &robot.sub_objectives {
        let first = it.configurations.first().copied().unwrap_or(0);
        new(&mut places, &it.name, place(&at.configurations, first));
    }
    for (number, it) in robot.configurations.iter().enumerate() {
        new(&mut places, &it.name, place(&at.configurations, number));
    }
    let restarts = robot.modules.iter().map(|it| format!("restart_{}", word(&it.name)));
    let own = ["refusal", "global_event", "local_event"].map(str::to_owned);
    let ids = robot.failures.iter().filter(|it| it.sets.is_some());
    let sets = ids.map(|it| format!("set_{}", word(&it.id)));
    let of = |it: &&Failure| it.asks.is_some() || it.masks.is_some();
    let more = robot.failures.iter().filter(of);
    let more = more.flat_map(|it| ["ask", "mask"].map(|of| format!("{of}_{}", word(&it.id))));
    let made = restarts.chain(sets).chain(more).map(|it| it.to_lowercase());
    let mut told: BTreeSet<_> = made.chain(own).collect();
    // A short name that is there twice is told apart from one that only looks so.
    let mut ids = BTreeSet::new();
    for (number, it) in robot.failures.iter().enumerate().filter(|it| ids.insert(&it.1.id)) {
        new(&mut told, &it.id, place(&at.failures, number));
    }
}
