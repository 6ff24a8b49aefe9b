//! Reading a robot's file.

mod body;
mod failures;
mod reactions;
mod sensing;
mod settings;
mod signals;

use super::in_time;
use super::known::{COSTS, FORMAT, MODES, POWERS, RANKS, SPEEDS, TIMES, UNITS, UNWATCHED};
use super::losses::{Losses, TooMany};
use super::masking;
use super::sound::Places;
use super::supervisors::{self, ReadNet};
use super::{
    Configuration, Hardware, MAX_CONFIGURATIONS, MAX_FAILURES, MAX_FLAGS, MAX_LOSSES, MAX_PARTS,
    MAX_REPORTS, Mode, Module, Observer, Parts, Robot, Sensing, SubObjective, sound,
};
use crate::missions::reader::fields::{Fields, Sink, document_of_either};
use crate::missions::{Diagnostic, MissionErrors, Spanned};
use crate::names::quoted;
use cotama_core::net::owned::OwnedNet;
use cotama_core::system::System;
use cotama_core::units::{Micros, MillimetresPerSecond, Millis, Milliwatts};

/// The time of what stands where nothing is said.
const TAKES: Millis = Millis(1_000);

/// Names of a file that others refer to, and the place of each part in the file.
#[derive(Default)]
pub(super) struct Names {
    pub(super) hardware: Vec<String>,
    pub(super) modules: Vec<String>,
    pub(super) flags: Vec<String>,
    pub(super) parameters: Vec<settings::Named>,
    /// The devices by which the robot senses.
    pub(super) sensing: Sensing,
    /// Names under which restarts count together, and how often each.
    pub(super) shared: Vec<(String, u8)>,
    /// The place of each module, configuration, flag and failure.
    pub(super) at: Places,
}

impl Robot {
    /// Reads a `cotama-robot/1` file, in TOML, or in JSON with the same keys. `source_name` is its
    /// name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places: what cannot be read, and what makes no sense.
    ///
    /// ```
    /// use cotama_models::robots::Robot;
    /// let text = "format = 'cotama-robot/1'\nname = 'x'\n[modul.drive]\n";
    /// let errors = Robot::parse("x.toml", text).unwrap_err().to_string();
    /// let first = "x.toml:3:2: unknown key `modul` in the file; did you mean `module`?";
    /// assert!(errors.contains(first), "{errors}");
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        Self::parse_with(source_name, text, &mut |_| Err("no other file is read here".to_owned()))
    }

    /// The same of a robot that may name nets of its own; `own` reads them.
    ///
    /// # Errors
    /// As [`parse`](Self::parse); a net that cannot be read, or has not the interface of the
    /// supervisor that it replaces, too.
    pub fn parse_with(
        source_name: &str,
        text: &str,
        own: &mut ReadNet<'_>,
    ) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let robot = document_of_either(text, &sink, FORMAT, |fields| robot(fields, own));
        match robot.filter(|_| sink.is_empty()) {
            Some(robot) => Ok(robot),
            None => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

fn robot(mut fields: Fields<'_>, own: &mut ReadNet<'_>) -> Option<Robot> {
    let mut names = Names::default();
    let name = fields.id("name");
    let title = words(&mut fields, "title");
    let hardware = named(&mut fields, "hardware", MAX_PARTS);
    names.hardware = hardware.iter().map(|it| it.0.value.clone()).collect();
    let body = fields.optional_table("body").ok();
    let body = body.map(|it| it.map(|it| body::body(it, &names.hardware)));
    let sensing = body.iter().flatten().flatten().next().map(|it| it.sensing.clone());
    names.sensing = sensing.unwrap_or_default();
    let modules = named(&mut fields, "module", MAX_PARTS);
    names.modules = modules.iter().map(|it| it.0.value.clone()).collect();
    names.at.modules = modules.iter().map(|it| it.0.span.clone()).collect();
    for (it, _) in &modules {
        if names.hardware.contains(&it.value) && !it.value.is_empty() {
            let message = format!("{} names hardware and a module", quoted(&it.value));
            let it = Diagnostic::new(it.span.clone(), message, "twice");
            fields.report(it.help("give each a name of its own"));
        }
    }
    let hardware: Vec<_> = hardware.into_iter().map(self::hardware).collect();
    let modules: Vec<_> = modules.into_iter().map(|it| module(it, &names)).collect();
    names.parameters = settings::named(modules.iter().map(Option::as_ref));
    let observers = named(&mut fields, "observer", MAX_PARTS);
    let observers: Vec<_> = observers.into_iter().map(|it| observer(it, &mut names)).collect();
    let operator = fields.optional_table("operator").ok();
    let operator = operator.map(|it| it.map(|it| self::operator(it, &names)));
    let configurations = fields.tables_up_to("configuration", true, MAX_CONFIGURATIONS);
    let configurations: Vec<_> =
        configurations.into_iter().flatten().map(|it| configuration(it, &mut names)).collect();
    let failures = fields.tables_up_to("failure", false, MAX_FAILURES);
    let failures: Vec<_> =
        failures.into_iter().flatten().map(|it| failures::failures(it, &mut names)).collect();
    let local = match fields.optional_table("supervisors") {
        Ok(Some(mut it)) => {
            let local = it.text("local");
            it.finish();
            local
        }
        _ => None,
    };
    let sink = fields.sink();
    if let Some(one_too_many) = names.at.failures.get(MAX_FAILURES) {
        let message = format!("a robot has at most {MAX_FAILURES} failures");
        let it = Diagnostic::new(one_too_many.clone(), message, "one too many");
        fields.report(it.help("leave some out"));
    }
    fields.finish();

    let operator = match operator? {
        Some(link) => Some(link?),
        None => None,
    };
    let body = match body? {
        Some(body) => Some(body?),
        None => None,
    };
    let written: Vec<Written> = configurations.into_iter().collect::<Option<_>>()?;
    let mut robot = Robot {
        name: name?.value,
        title,
        body,
        hardware: hardware.into_iter().collect::<Option<_>>()?,
        modules: modules.into_iter().collect::<Option<_>>()?,
        sub_objectives: Vec::new(),
        configurations: Vec::new(),
        operator,
        observers: observers.into_iter().collect::<Option<_>>()?,
        failures: failures.into_iter().collect::<Option<Vec<_>>>()?.concat(),
        shared: names.shared.iter().map(|it| it.0.clone()).collect(),
        losses: Losses::default(),
        local: None,
    };
    if !sink.is_empty() || !sound::is_grounded(&robot, &names.at, sink) {
        return None;
    }
    sub_objectives(&mut robot, written, sink)?;
    robot.losses = match Losses::of(&robot) {
        Ok(losses) => losses,
        Err((failure, what)) => {
            let span = names.at.failures.get(failure).cloned().unwrap_or_default();
            let (message, help) = match what {
                TooMany::Losses => (
                    format!("more than {MAX_LOSSES} losses make a difference"),
                    "let failures that take nearly the same take the same",
                ),
                TooMany::Reports => (
                    format!("failures differ in more than {MAX_REPORTS} ways"),
                    "let failures that take the same be as severe",
                ),
            };
            sink.report(Diagnostic::new(span, message, "one too many").help(help));
            return None;
        }
    };
    masking::makes_sense(&robot, &names.at, sink);
    if !sound::makes_sense(&robot, &names.at, sink) || !in_time::is(&robot, &names.at, sink) {
        return None;
    }
    let Some(path) = local else { return Some(robot) };
    robot.local = Some(local_supervisor(&robot, &path, own, sink)?);
    // What places hold and lines change is seen only where the net stands among the others.
    if let Some(it) = supervisors::system(&robot).with(|it: &System<'_>| it.defect()) {
        let message = format!("{} does not fit the other supervisors: {it}", quoted(&path.value));
        let it = Diagnostic::new(path.span, message, "another interface");
        sink.report(it.help("`cotama export ROBOT --net ls` shows the interface"));
        return None;
    }
    Some(robot)
}

/// Reads the local supervisor that a file names, and holds it against the interface.
fn local_supervisor(
    robot: &Robot,
    path: &Spanned<String>,
    own: &mut ReadNet<'_>,
    sink: &Sink,
) -> Option<OwnedNet> {
    let wrong = |message: String, label: &str, help: &str| {
        sink.report(Diagnostic::new(path.span.clone(), message, label).help(help.to_owned()));
    };
    let net = match own(&path.value) {
        Ok(net) => net,
        Err(why) => {
            wrong(why, "cannot be read", "`cotama export ROBOT --net ls --format json` writes one");
            return None;
        }
    };
    let defects = supervisors::defects(robot, &net);
    for it in &defects {
        let message = format!("{} is no local supervisor of this robot: {it}", quoted(&path.value));
        wrong(message, "another interface", "`cotama export ROBOT --net ls` shows the interface");
    }
    defects.is_empty().then_some(net)
}

/// A text that may be left out.
fn words(fields: &mut Fields<'_>, key: &'static str) -> String {
    fields.optional_text(key).ok().flatten().map_or_else(String::new, |it| it.value)
}

type Named<'t> = (Spanned<String>, Option<Fields<'t>>);

/// The tables of a table, each with its name.
fn named<'t>(fields: &mut Fields<'t>, key: &'static str, most: usize) -> Vec<Named<'t>> {
    let Ok(Some(table)) = fields.optional_table(key) else { return Vec::new() };
    let span = table.whole();
    let all = table.named_tables().unwrap_or_default();
    if all.len() > most {
        let message = format!("`{key}` has {} entries; at most {most} are allowed", all.len());
        let it = Diagnostic::new(span, message, "too many");
        fields.report(it.help("leave some out"));
        return Vec::new();
    }
    all
}

fn hardware((name, fields): Named<'_>) -> Option<Hardware> {
    let mut fields = fields?;
    let title = words(&mut fields, "title");
    let units = fields.optional_integer("units", UNITS);
    let power = fields.optional_integer("power_mw", POWERS);
    let kind = words(&mut fields, "kind");
    let source = words(&mut fields, "source");
    fields.finish();
    Some(Hardware {
        kind: if kind.is_empty() { name.value.clone() } else { kind },
        name: name.value,
        title,
        units: units.ok()?.unwrap_or(1),
        power: Milliwatts(power.ok()?.unwrap_or(0)),
        source,
    })
}

/// The position of a name among hardware and modules.
pub(super) fn part(fields: &Fields<'_>, name: &Spanned<String>, names: &Names) -> Option<Parts> {
    let all = names.hardware.iter().chain(&names.modules).map(String::as_str);
    let at = fields.index_of(name, "hardware or module", all)?;
    Some(match at.checked_sub(names.hardware.len()) {
        None => Parts { hardware: 1 << at, modules: 0 },
        Some(module) => Parts { hardware: 0, modules: 1 << module },
    })
}

/// The hardware and modules of a list.
pub(super) fn parts(fields: &mut Fields<'_>, key: &'static str, names: &Names) -> Option<Parts> {
    let all = fields.optional_texts(key).ok()?;
    let all: Vec<_> = all.iter().map(|it| part(fields, it, names)).collect();
    Some(all.into_iter().collect::<Option<Vec<_>>>()?.into_iter().fold(Parts::NONE, Parts::union))
}

/// The modules of a list, a bit each.
fn modules(fields: &Fields<'_>, all: &[Spanned<String>], names: &Names) -> Option<u64> {
    let known = || names.modules.iter().map(String::as_str);
    let all: Vec<_> = all.iter().map(|it| fields.index_of(it, "module", known())).collect();
    Some(all.into_iter().collect::<Option<Vec<_>>>()?.into_iter().fold(0, |set, it| set | 1 << it))
}

fn optional_modules(fields: &mut Fields<'_>, key: &'static str, names: &Names) -> Option<u64> {
    let all = fields.optional_texts(key).ok()?;
    modules(fields, &all, names)
}

fn module((name, fields): Named<'_>, names: &Names) -> Option<Module> {
    let mut fields = fields?;
    let title = words(&mut fields, "title");
    let needs = optional_modules(&mut fields, "needs", names);
    let one_of = optional_modules(&mut fields, "one_of", names);
    let hardware = fields.optional_texts("hardware").ok().and_then(|all| {
        let known = || names.hardware.iter().map(String::as_str);
        let all: Vec<_> = all.iter().map(|it| fields.index_of(it, "hardware", known())).collect();
        let all = all.into_iter().collect::<Option<Vec<_>>>()?;
        Some(all.into_iter().fold(0, |set, it| set | 1 << it))
    });
    let period = fields.optional_integer("period_ms", TIMES);
    let deadline = fields.optional_integer("deadline_ms", TIMES);
    let cost = fields.optional_integer("cost_us", COSTS);
    let priority = fields.optional_integer("priority", RANKS);
    let parameters = settings::parameters(&mut fields);
    let serves = words(&mut fields, "serves");
    let roles = signals::roles(&mut fields);
    let source = words(&mut fields, "source");
    let (deadline, period) = (deadline.ok()?.map(Millis), period.ok()?.map(Millis));
    let cost = cost.ok()?.map(Micros);
    if period.is_none() && (deadline.is_some() || cost.is_some()) {
        let message = "a deadline and a cost are those of a module that runs in a period";
        let it = Diagnostic::new(fields.whole(), message, "no `period_ms`");
        fields.report(it.help("add `period_ms`, or leave both out"));
    }
    fields.finish();
    Some(Module {
        name: name.value,
        title,
        needs: Parts { hardware: hardware?, modules: needs? },
        one_of: one_of?,
        period,
        deadline: deadline.or(period),
        cost,
        priority: priority.ok()?.unwrap_or(u8::MAX),
        parameters: parameters?,
        serves,
        roles: roles?,
        source,
    })
}

fn observer((name, fields): Named<'_>, names: &mut Names) -> Option<Observer> {
    let mut fields = fields?;
    let title = words(&mut fields, "title");
    let needs = parts(&mut fields, "needs", names);
    let unwatched = fields.optional_text("unwatched").ok().map(|it| {
        let known = UNWATCHED.into_iter();
        it.map_or(Some(0), |it| fields.index_of(&it, "word for what is unwatched", known))
    });
    let flags = fields.texts("flags");
    for it in flags.iter().flatten() {
        if names.flags.contains(&it.value) || it.value.is_empty() {
            let message = format!("the flag {} is there twice, or has no name", quoted(&it.value));
            let it = Diagnostic::new(it.span.clone(), message, "not a new flag");
            fields.report(it.help("one observer raises a flag"));
        }
        names.flags.push(it.value.clone());
        names.at.flags.push(it.span.clone());
    }
    let own = flags.as_ref().map_or(0, Vec::len);
    let watches = signals::watches(&mut fields, own, &names.sensing);
    if names.flags.len() > MAX_FLAGS && names.flags.len() - own <= MAX_FLAGS {
        let message = format!("a robot has at most {MAX_FLAGS} flags");
        let it = Diagnostic::new(fields.span_of("flags"), message, "too many");
        fields.report(it.help("let one flag show what is answered alike"));
    }
    let closes = unwatched.flatten().map(|at| UNWATCHED.get(at) == Some(&"lost"));
    if closes == Some(true) && needs.is_some_and(|it| it.modules == 0 || it.hardware != 0) {
        let message = format!("{} is never blind by the loss of a module", quoted(&name.value));
        let it = Diagnostic::new(fields.span_of("unwatched"), message, "needs no module, or more");
        fields.report(
            it.help("say in `needs` without which modules it sees nothing, and no hardware"),
        );
    }
    fields.finish();
    let flags = flags?.into_iter().map(|it| it.value).collect();
    let watches = watches?;
    Some(Observer { name: name.value, title, needs: needs?, flags, watches, closes: closes? })
}

fn operator(mut fields: Fields<'_>, names: &Names) -> Option<u64> {
    let needs = fields.texts("needs");
    let link = needs.and_then(|all| modules(&fields, &all, names));
    fields.finish();
    link
}

/// A configuration with the name of its sub-objective, as it is written.
struct Written {
    configuration: Configuration,
    sub_objective: Spanned<String>,
    mode: Mode,
    rank: Option<u64>,
}

fn configuration(mut fields: Fields<'_>, names: &mut Names) -> Option<Written> {
    names.at.configurations.push(fields.span_of("name"));
    let name = fields.id("name");
    let sub_objective = fields.id("sub_objective");
    let mode = fields.choice("mode", "mode", &MODES);
    let rank = fields.optional_integer("rank", RANKS);
    let required = fields.texts("required").and_then(|all| modules(&fields, &all, names));
    let optional = optional_modules(&mut fields, "optional", names);
    let speed = fields.optional_integer("speed_mm_s", SPEEDS);
    let takes = fields.optional_integer("takes_ms", TIMES);
    let source = words(&mut fields, "source");
    fields.finish();
    let mode = if mode? == "operator" { Mode::Operator } else { Mode::Autonomous };
    Some(Written {
        configuration: Configuration {
            name: name?.value,
            sub_objective: 0,
            required: required?,
            optional: optional?,
            speed: MillimetresPerSecond(speed.ok()?.unwrap_or(0)),
            takes: takes.ok()?.map_or(TAKES, Millis),
            source,
        },
        sub_objective: sub_objective?,
        mode,
        rank: rank.ok()?,
    })
}

/// Makes the sub-objectives: in the order in which configurations name them; the configurations of
/// each by rank, or else in their order.
fn sub_objectives(robot: &mut Robot, written: Vec<Written>, sink: &Sink) -> Option<()> {
    let mut ranks: Vec<u64> = Vec::new();
    for (at, it) in written.into_iter().enumerate() {
        let Written { mut configuration, sub_objective: name, mode, rank } = it;
        // All that a required module needs is required.
        configuration.required = sound::with_needs(robot, configuration.required);
        let known = robot.sub_objectives.iter().position(|it| it.name == name.value);
        let number = known.unwrap_or(robot.sub_objectives.len());
        if known.is_none() {
            let (name, configurations) = (name.value.clone(), Vec::new());
            robot.sub_objectives.push(SubObjective { name, mode, moves: false, configurations });
        }
        let objective = robot.sub_objectives.get_mut(number)?;
        if objective.mode != mode {
            let message = format!("{} is served in two modes", quoted(&name.value));
            let it = Diagnostic::new(name.span.clone(), message, "another mode than before");
            sink.report(it.help("give the sub-objective of the operator a name of its own"));
        }
        let rank = rank.unwrap_or(objective.configurations.len() as u64);
        if objective.configurations.iter().any(|it| ranks.get(*it) == Some(&rank)) {
            let message =
                format!("two configurations of {} have the rank {rank}", quoted(&name.value));
            let it = Diagnostic::new(name.span, message, "the same rank");
            sink.report(it.help("0 is the best; give each a rank of its own"));
        }
        ranks.push(rank);
        objective.moves |= configuration.speed.0 > 0;
        objective.configurations.push(at);
        objective.configurations.sort_by_key(|it| ranks.get(*it).copied());
        configuration.sub_objective = number;
        robot.configurations.push(configuration);
    }
    sink.is_empty().then_some(())
}
