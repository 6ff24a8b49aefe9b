//! The requirements of any robot's supervisors, as questions to the checker.
//!
//! Numbers follow the supervisors: GS global, LS local, AS adapters, CS contextual. Texts speak of
//! [`system`](super::supervisors::system) as one net that acts in rounds.

use super::supervisors::{Step, adapter, asks_now, cannot, cannot_run, lost, place_of, word};
use super::{Failure, Mode, Parts, Report, Robot, SubObjective};
use crate::severity::Severity;

/// Something that the supervisors of a robot are required to do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// Short name, for example `AS2.Blind`.
    pub id: String,
    /// The requirement in a sentence.
    pub sentence: String,
    /// The observers that the question needs, each of which may look at those before it.
    pub watches: Vec<Watch>,
    /// The property, in the language of the checker.
    pub text: String,
}

/// Counts in how many rounds a duty lasts; a place of its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Watch {
    /// Name of the observer.
    pub name: String,
    /// Whether it looks at the end of a round, or else when every net has had its turn and what is
    /// outside has not.
    pub at_end: bool,
    /// The condition that begins the interval.
    pub begins: String,
    /// The condition that ends the interval.
    pub ends: String,
    /// Largest count.
    pub most: u32,
}

/// All requirements of a robot.
///
/// ```
/// use cotama_models::robots::{Robot, requirements};
/// let robot = Robot::shipped("transport").unwrap();
/// let all = requirements::of(&robot);
/// assert_eq!(all[1].id, "GS2");
/// assert_eq!(all[1].sentence, "Halted, the robot stays stopped, and holds no permit to move.");
/// ```
pub fn of(robot: &Robot) -> Vec<Requirement> {
    of_mission(robot, &[])
}

/// All requirements of a robot in a mission of these objectives.
pub fn of_mission(robot: &Robot, steps: &[Step]) -> Vec<Requirement> {
    let mut all = Vec::new();
    let mut ask = |id: String, sentence: String, watches: Vec<Watch>, text: String| {
        all.push(Requirement { id, sentence, watches, text });
    };
    let plain = |it: &str| it.to_owned();
    let places: Vec<_> =
        robot.sub_objectives.iter().map(|it| format!("ls.{}", word(&it.name))).collect();
    let driving = format!("ls.Idle + {} + ls.Waits + ls.End", places.join(" + "));

    ask(
        plain("GS1"),
        plain("A global event is answered in the next round: the mission ends."),
        vec![at_end(
            "secured",
            "gs.global_event.waiting | gs.no_way.waiting",
            "gs.Security | gs.Safe",
            2,
        )],
        plain("AG secured <= 1"),
    );
    ask(
        plain("GS2"),
        plain("Halted, the robot stays stopped, and holds no permit to move."),
        Vec::new(),
        plain(
            "AG ((gs.Security | gs.Safe -> ls.Idle & permit.Destroyed) & \
             (gs.Security -> AX (gs.Security | gs.Safe)) & (gs.Safe -> AX gs.Safe))",
        ),
    );
    if steps.is_empty() {
        ask(
            plain("GS3"),
            plain(
                "From everywhere the robot can rest or be stopped for good; and a drive can end.",
            ),
            Vec::new(),
            plain("EF ls.End & AG EF ((gs.Wait | gs.Safe) & ls.Idle)"),
        );
    } else {
        mission(steps, &mut ask);
    }
    ask(
        plain("LS1"),
        plain("A drive is in one place: at most one sub-objective is active."),
        Vec::new(),
        format!("AG {driving} = 1"),
    );
    let moves = |it: &SubObjective| it.moves.then(|| format!("ls.{}", word(&it.name)));
    let moving: Vec<_> = robot.sub_objectives.iter().filter_map(moves).collect();
    if !moving.is_empty() {
        ask(
            plain("LS2"),
            plain("The robot may move exactly in the sub-objectives that have a speed."),
            Vec::new(),
            format!("AG (permit.Granted <-> {})", moving.join(" | ")),
        );
    }
    severe(robot, &mut ask);
    reasons(robot, &mut ask);
    asked_first(robot, &mut ask);
    watched(robot, &mut ask);
    for it in robot.sub_objectives.iter().filter(|it| it.configurations.len() > 1) {
        adapters(robot, it, &mut ask);
    }
    for (number, it) in robot.configurations.iter().enumerate() {
        let (name, place) = (word(&it.name), place_of(robot, number));
        ask(
            format!("AS3.{name}"),
            format!("`{}` can run.", it.name),
            Vec::new(),
            format!("EF {place}"),
        );
        let Some(lost) = cannot_run(robot, number) else { continue };
        let watch = at_end(
            &format!("without_{name}"),
            &format!("{place} & ({lost})"),
            &format!("!{place} | !({lost})"),
            3,
        );
        ask(
            format!("AS4.{name}"),
            format!("`{}` runs at the ends of two rounds at most without what it needs.", it.name),
            vec![watch],
            format!("AG without_{name} <= 2"),
        );
    }
    all
}

/// A mission can be accomplished, and its objectives come one after the other.
fn mission(steps: &[Step], ask: &mut Ask<'_>) {
    ask(
        "GS3".to_owned(),
        "The mission can be accomplished; from everywhere it can be, or the robot can be stopped \
         for good."
            .to_owned(),
        Vec::new(),
        "EF gs.Done & AG EF ((gs.Done | gs.Safe) & ls.Idle)".to_owned(),
    );
    let places = steps.iter().map(|it| format!("gs.{}", it.place()));
    let places: Vec<_> =
        ["gs.Wait".to_owned()].into_iter().chain(places).chain(["gs.Done".to_owned()]).collect();
    let in_order = places.iter().enumerate().map(|(at, place)| {
        let next = places.get(at + 1).map_or_else(String::new, |next| format!(" | {next}"));
        format!("({place} -> AX ({place}{next} | gs.Security))")
    });
    ask(
        "GS4".to_owned(),
        "The objectives come in their order, each once; nothing else follows but security."
            .to_owned(),
        Vec::new(),
        format!("AG ({})", in_order.collect::<Vec<_>>().join(" & ")),
    );
}

fn at_end(name: &str, begins: &str, ends: &str, most: u32) -> Watch {
    let (begins, ends) = (begins.to_owned(), ends.to_owned());
    Watch { name: name.to_owned(), at_end: true, begins, ends, most }
}

type Ask<'a> = dyn FnMut(String, String, Vec<Watch>, String) + 'a;

/// Adds: a fatal report ends the mission; a hard one asks the operator, or ends it.
fn severe(robot: &Robot, ask: &mut Ask<'_>) {
    let told = |least: Severity| {
        let all = robot.losses.reports.iter().filter(|it| it.is_told_at_once());
        let severe = all.filter(|it| it.autonomous.min(it.operator) >= least);
        severe.map(|it| format!("gom.flag_{}.waiting", word(&it.name))).collect::<Vec<_>>()
    };
    let fatal = told(Severity::Fatal);
    if !fatal.is_empty() {
        let watch = at_end("fatal", &fatal.join(" | "), "gs.Security | gs.Safe", 3);
        ask(
            "CS1".to_owned(),
            "What is fatal ends the mission after two rounds.".to_owned(),
            vec![watch],
            "AG fatal <= 2".to_owned(),
        );
    }
    let alone = places(robot, Some(Mode::Autonomous)).join(" | ");
    let at_once = robot.losses.reports.iter().filter(|it| it.is_told_at_once());
    // A local supervisor of one's own may answer by itself what does not need the operator.
    let needs_him = |it: &&Report| it.operator >= Severity::Hard || robot.local.is_none();
    let hard = at_once.filter(|it| it.autonomous >= Severity::Hard).filter(needs_him).map(|it| {
        let flag = format!("gom.flag_{}.waiting", word(&it.name));
        // A robot that drives itself goes on doing so until it is stopped.
        if it.operator >= Severity::Hard { flag } else { format!("{flag} & ({alone})") }
    });
    let hard: Vec<_> = hard.collect();
    let own = places(robot, None);
    if hard.len() > fatal.len() {
        let told = hard.join(" | ");
        let hard = at_end("hard", &told, &format!("!({told})"), 1);
        // The operator may answer in the round in which he is asked.
        let answer = Watch {
            at_end: false,
            ..at_end(
                "answer",
                &format!("hard & ({})", own.join(" | ")),
                "ls.Waits | ls.Idle | ls.End | gs.Security | gs.Safe",
                2,
            )
        };
        ask(
            "CS2".to_owned(),
            "What is hard stops what runs after two rounds: the operator is asked, or the mission \
             ends."
                .to_owned(),
            vec![hard, answer],
            "AG answer <= 1".to_owned(),
        );
    }
}

/// The places of the sub-objectives of a mode, or of all.
fn places(robot: &Robot, mode: Option<Mode>) -> Vec<String> {
    let all = robot.sub_objectives.iter().filter(|it| mode.is_none_or(|mode| it.mode == mode));
    all.map(|it| format!("ls.{}", word(&it.name))).collect()
}

/// Adds, of a robot with an operator: who gives up ends the mission; and nothing ends it, or asks
/// him, without a reason.
fn reasons(robot: &Robot, ask: &mut Ask<'_>) {
    if !robot.can_ask(0) {
        return;
    }
    let told = |least: Severity| {
        let all = robot.losses.reports.iter();
        let severe = all.filter(move |it| it.autonomous.max(it.operator) >= least);
        severe.map(|it| format!("gom.flag_{}.waiting", word(&it.name)))
    };
    let refusal = "cs.refusal.waiting".to_owned();
    let watch = at_end("refused", &refusal, "gs.Security | gs.Safe", 3);
    ask(
        "CS3".to_owned(),
        "An operator who gives up, or is silent, ends the mission after two rounds.".to_owned(),
        vec![watch],
        "AG refused <= 2".to_owned(),
    );
    let helpless = cannot(robot, |lost| robot.can_ask(lost));
    let ends: Vec<_> = told(Severity::Fatal).chain([refusal]).collect();
    let reason = at_end("reason", &ends.join(" | "), "gs.Wait & gs.Safe", 1);
    let or_helpless = helpless.map_or_else(String::new, |it| format!(" | {it}"));
    ask(
        "GS5".to_owned(),
        "The mission ends only by something fatal, by the operator, or where nobody can be asked."
            .to_owned(),
        vec![reason],
        format!("AG (gs.global_event.waiting | gs.no_way.waiting -> reason >= 1{or_helpless})"),
    );
    let asks = robot.losses.reports.iter().filter(|it| it.asks.is_some());
    let asks = asks.map(|it| format!("gom.flag_{}.waiting", word(&it.name)));
    let asks_first = asks.clone().next().is_some();
    let hard: Vec<_> = told(Severity::Hard).chain(asks).collect();
    let hard = or_never(&hard);
    let hard = at_end("hard", &hard, &format!("!({hard})"), 1);
    let stuck = robot.configurations.iter().enumerate().filter_map(|(number, _)| {
        Some(format!(" | {} & ({})", place_of(robot, number), cannot_run(robot, number)?))
    });
    let stuck: String = stuck.collect();
    let called = format!("ls.local_event.waiting & !(hard >= 1{stuck})");
    let called = Watch { at_end: false, ..at_end("called", &called, &format!("!({called})"), 1) };
    ask(
        "CS4".to_owned(),
        if asks_first {
            "The operator is called only by something hard, by a row that asks him first, or where \
             what runs cannot go on."
        } else {
            "The operator is called only by something hard, or where what runs cannot go on."
        }
        .to_owned(),
        vec![hard, called],
        "AG called = 0".to_owned(),
    );
}

/// Adds, for each report that asks the operator first: it does, where he can help.
fn asked_first(robot: &Robot, ask: &mut Ask<'_>) {
    let own = places(robot, None).join(" | ");
    let helps = cannot(robot, |lost| robot.can_ask(lost));
    let helps = helps.map_or_else(String::new, |it| format!(" & !({it})"));
    for (number, it) in robot.losses.reports.iter().enumerate().filter(|it| it.1.asks.is_some()) {
        let told = format!("gom.flag_{}.waiting & {}", word(&it.name), asks_now(robot, number));
        let asking = at_end("asking", &told, &format!("!({told})"), 1);
        // The operator may answer in the round in which he is asked.
        let answer = at_end(
            "answer",
            &format!("asking & ({own}){helps}"),
            "ls.Waits | ls.Idle | ls.End | gs.Security | gs.Safe",
            2,
        );
        ask(
            format!("CS5.{}", word(&it.name)),
            format!(
                "`{}` stops what runs and asks the operator first, where he can help.",
                it.name
            ),
            vec![asking, Watch { at_end: false, ..answer }],
            "AG answer <= 1".to_owned(),
        );
    }
}

/// Adds, for each observer without whom what he alone watches counts as lost: none of it is used
/// while he is known to see nothing.
fn watched(robot: &Robot, ask: &mut Ask<'_>) {
    let names: Vec<_> = robot.flags().map(|it| it.0).collect();
    for (number, it) in robot.observers.iter().enumerate().filter(|it| it.1.closes) {
        let is_his = |flag: &usize| names.get(*flag) == Some(&number);
        let his = |it: &&Failure| !it.flags.is_empty() && it.flags.iter().all(is_his);
        let watched =
            robot.failures.iter().filter(his).fold(0, |all, it| {
                all | (robot.available(Parts::NONE) & !robot.available(it.loses))
            });
        let users =
            robot.configurations.iter().enumerate().filter(|it| it.1.required & watched != 0);
        let users: Vec<_> = users.map(|it| place_of(robot, it.0)).collect();
        let blinds = |loss: &usize| {
            robot.losses.losses.get(*loss).is_some_and(|of| of.modules & it.needs.modules != 0)
        };
        let blind = (0..robot.losses.losses.len()).filter(blinds);
        let blind: Vec<_> = blind.map(|it| format!("gom.{}", lost(robot, it))).collect();
        let begins = format!("({}) & ({})", or_never(&users), or_never(&blind));
        let watch = at_end("unwatched", &begins, &format!("!({begins})"), 3);
        ask(
            format!("OB1.{}", word(&it.name)),
            format!("While `{}` sees nothing, nothing runs that it alone watches.", it.name),
            vec![watch],
            "AG unwatched <= 2".to_owned(),
        );
    }
}

/// Any of these conditions; of none, one that never holds.
fn or_never(all: &[String]) -> String {
    if all.is_empty() { "gs.Wait & gs.Safe".to_owned() } else { all.join(" | ") }
}

/// One configuration at a time, and only worse ones until the sub-objective ends.
fn adapters(robot: &Robot, of: &SubObjective, ask: &mut Ask<'_>) {
    let (name, adapter) = (word(&of.name), adapter(of));
    let places: Vec<_> = of.configurations.iter().map(|it| place_of(robot, *it)).collect();
    ask(
        format!("AS1.{name}"),
        format!("`{}` runs one configuration at a time, and only where it is active.", of.name),
        Vec::new(),
        format!("AG ({adapter}.Off + {} = 1 & {adapter}.Off + ls.{name} = 1)", places.join(" + ")),
    );
    let returns = robot.losses.losses.iter().any(|it| it.returns);
    let mut worse = Vec::new();
    for (at, better) in of.configurations.iter().enumerate() {
        let below = places[at + 1..].join(" | ");
        match (below.as_str(), cannot_run(robot, *better).filter(|_| returns)) {
            ("", _) => {}
            // What has come back may be taken where nothing else is left.
            (_, Some(lost)) => {
                worse.push(format!("(({below}) & ({lost}) -> AX !{})", places[at]));
            }
            (_, None) => worse.push(format!("(({below}) -> AX !{})", places[at])),
        }
    }
    let sentence = if returns {
        format!("Until it ends, `{}` takes nothing better that is known to be lost.", of.name)
    } else {
        format!("Until it ends, `{}` only degrades.", of.name)
    };
    ask(format!("AS2.{name}"), sentence, Vec::new(), format!("AG ({})", worse.join(" & ")));
    debug_assert!(of.mode == Mode::Autonomous || robot.operator.is_some(), "a robot makes sense");
}
