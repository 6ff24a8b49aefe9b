//! Every rule of the contextual supervisor, each with a simulated run that comes to it, or why none
//! does: the page `docs/rules.md` is written from here.

use cotama_core::net::{Arc, Net, Role, Transition};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::FailureMode::{
    self, Bat3, Bmp1, Cam1, Col1, Com1, Com2, Loc2, Loc3, Mot2, Opr1, Ppl1, Rt1, Son1, Son2, Sw1,
    Sw2,
};
use cotama_models::cotama::local::State::{HandOver, Planning, Teleoperated, Teleprogrammed};
use cotama_models::cotama::{Module, contextual, local, recovering_contextual};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::Answer::{self, GiveUp, Path, Teleoperate, Teleprogram};
use cotama_sim::supervised::{Answers, Injection, Script, Supervised, When};
use std::fmt::Write;

/// The situation shown to a rule.
enum Shown {
    /// A run in which these fail and the operator answers so; in it a rule of this name fires.
    Run(Vec<Injection>, Vec<Answers>),
    /// A run of a mission in which only 400 s are left for everything.
    Tight(Vec<Injection>),
    /// No run does.
    Never(&'static str),
}

fn at(m: u64, mode: FailureMode) -> Injection {
    Injection::new(When::Place(Millimetres(m * 1_000)), mode)
}

fn of(part: Module, it: Injection) -> Injection {
    Injection { part, ..it }
}

/// Half a second after a place is reached for the first time.
fn during(place: local::State, mode: FailureMode) -> Injection {
    Injection::new(When::During(place, Millis(500)), mode)
}

fn after(s: u64, mode: FailureMode) -> Injection {
    Injection::new(When::At(Millis(s * 1_000)), mode)
}

fn until(m: u64, it: Injection) -> Injection {
    Injection { until: Some(When::Place(Millimetres(m * 1_000))), ..it }
}

/// Returns the failure with an end once the operator was asked.
fn until_asked(it: Injection) -> Injection {
    Injection { until: Some(When::During(HandOver, Millis(0))), ..it }
}

fn run(injections: impl Into<Vec<Injection>>) -> Shown {
    Shown::Run(injections.into(), Vec::new())
}

fn asked(injections: impl Into<Vec<Injection>>, s: u64, answers: &[Answer]) -> Shown {
    let answers =
        Answers { x: Millimetres(0), answers: answers.to_vec(), delay: Millis(s * 1_000) };
    Shown::Run(injections.into(), vec![answers])
}

const STANDS: &str = "the robot stands while it plans, and touches nothing";
const NO_LINK: &str = "a lost link ends what the operator drives before anything else is read";

/// How each rule is shown.
fn shown(rule: &str) -> Shown {
    match rule {
        "slow1" => run([at(3, Rt1)]),
        "slow2" => run([at(3, Rt1), at(6, Rt1)]),
        "slow3" => run([at(3, Rt1), at(6, Rt1), at(9, Rt1)]),
        "mcl1" => run([of(Module::Mcl, at(3, Sw1))]),
        "mcl2" => run([at(3, Rt1), of(Module::Mcl, at(6, Sw1))]),
        "slow4" => run([of(Module::Smz, at(3, Sw1)), at(15, Rt1)]),
        "slow5" => run([of(Module::Smz, at(3, Sw1)), at(15, Rt1), at(18, Rt1), at(21, Rt1)]),
        "mcl3" => run([of(Module::Smz, at(3, Sw1)), of(Module::Mcl, at(15, Sw1))]),
        "smz1" => run([of(Module::Smz, at(3, Sw1))]),
        "avoidance2" => run([of(Module::Smz, at(3, Sw1)), of(Module::Dvz, at(15, Sw1))]),
        "sonar1" => run([at(3, Son1)]),
        "sonar2" => run([at(3, Loc2), during(Teleoperated, Son2)]),
        "avoidance1" => run([at(3, Loc2), of(Module::Dvz, during(Teleoperated, Sw1))]),
        "ambiguous1" => run([during(Planning, Sw2)]),
        "ambiguous2" => run([at(3, Com1), after(167, Sw2)]),
        "ambiguous3" => run([at(3, Loc2)]),
        "ambiguous4" => run([at(3, Com1), at(6, Loc2)]),
        "collision1" | "collision2" => Shown::Never(STANDS),
        "collision3" => run([at(3, Son1), at(6, Loc3)]),
        "collision4" => run([at(3, Son1), at(3, Com1), at(6, Loc3)]),
        "collision5" => run([at(3, Col1)]),
        "hard1" => Shown::Tight(vec![after(0, Son2)]),
        "hard2" => Shown::Tight(vec![at(3, Com1), after(166, Son2)]),
        "hard3" => Shown::Tight(vec![at(45, Son2)]),
        "hard4" => Shown::Tight(vec![at(3, Com1), at(45, Son2)]),
        "hard5" => run([at(3, Loc2), during(Teleoperated, Bmp1)]),
        "hard6" | "camera2" => Shown::Never(NO_LINK),
        "minor1" => run([at(3, Mot2)]),
        "minor2" => run([at(3, Loc2), during(Teleoperated, Com2)]),
        "planner1" => run([during(Planning, Ppl1)]),
        "planner2" => run([after(0, Com1), during(Planning, Ppl1)]),
        "camera1" => run([at(3, Loc2), during(Teleoperated, Cam1)]),
        "wifi1" => run([at(3, Loc2), during(HandOver, Com1)]),
        "wifi2" => asked([at(3, Loc2), during(Teleprogrammed, Com1)], 8, &[Teleprogram, Path]),
        "wifi3" => run([at(3, Loc2), during(Teleoperated, Com1)]),
        "vital" => run([at(3, Bat3)]),
        "refusal1" => run([at(3, Loc2), during(HandOver, Opr1)]),
        "refusal2" => asked([at(3, Loc2)], 8, &[Teleprogram, GiveUp]),
        "refusal3" => asked([at(3, Loc2)], 8, &[Teleoperate, GiveUp]),
        "better1" => run([until(10, at(3, Son2))]),
        "better2" => run([until_asked(at(3, Son2)), at(6, Loc3)]),
        "better3" => run([until(10, of(Module::Mcl, at(3, Sw1)))]),
        other => panic!("{other}: neither a run nor a reason"),
    }
}

/// The delivery, with these lines in place of others.
fn mission(lines: &[(&str, &str)]) -> Mission {
    let delivery = cotama_models::missions::embedded::mission("delivery").unwrap();
    let changed = |text: String, (from, to): &(&str, &str)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    let text = lines.iter().fold(delivery.text.to_owned(), changed);
    Mission::parse(delivery.name, &text).unwrap()
}

const DECIDES: &str = "decides = \"cotama\"";
const RETURNS: (&str, &str) = (DECIDES, "decides = \"cotama\"\nrecovery = true");
const TIGHT: (&str, &str) = ("duration_ms = 900000", "duration_ms = 400000");

/// Returns the failures in words.
fn words(script: &Script) -> String {
    let one = |it: &Injection| {
        let part = if it.mode.rule().one_module {
            format!(" of {}", it.part.name())
        } else {
            String::new()
        };
        let when = match it.when {
            When::At(time) => format!("at {} s", time.0 / 1_000),
            When::Place(place) => format!("at {} m", place.0 / 1_000),
            When::During(place, _) => format!("in {place:?}"),
            When::Fired(act, _) => format!("after {act}"),
        };
        let until = match it.until {
            Some(When::Place(place)) => format!(" to {} m", place.0 / 1_000),
            Some(_) => " until it asks".to_owned(),
            None => String::new(),
        };
        format!("{}{part} {when}{until}", it.mode.name())
    };
    let failures = script.injections.iter().map(one).collect::<Vec<_>>().join(", ");
    let answer = |it: &Answers| {
        let last = if it.answers.last() == Some(&GiveUp) { ", then nothing" } else { "" };
        format!("; answers after {} s{last}", it.delay.0 / 1_000)
    };
    failures + &script.answers.first().map_or_else(String::new, answer)
}

/// Returns the guard of a transition in words.
fn guard(net: &Net<'_>, it: &Transition<'_>) -> String {
    let one = |arc: &Arc| {
        let place = &net.places[arc.place.0 as usize];
        match place.role {
            Role::Complement(of) if net.places[of.0 as usize].bound == 1 => {
                format!("not {}", net.places[of.0 as usize].name)
            }
            Role::Complement(_) => "at the floor".to_owned(),
            _ if place.bound > 1 => "above the floor".to_owned(),
            _ => place.name.to_owned(),
        }
    };
    // A flag that distinguishes the variants of a rule is no condition.
    let varies = |arc: &&Arc| {
        let place = &net.places[arc.place.0 as usize];
        let place = if let Role::Complement(of) = place.role { of } else { arc.place };
        it.name.contains(&format!(".{}_", net.places[place.0 as usize].name))
    };
    if it.read.is_empty() {
        return "anywhere".to_owned();
    }
    it.read
        .iter()
        .filter(|arc| !varies(arc))
        .map(one)
        .collect::<Vec<_>>()
        .join(", ")
        .replace('_', " ")
}

fn rule(name: &str) -> &str {
    name.split('.').next().unwrap()
}

/// A run in which it fires, and when it does so first.
fn by_run(name: &str, mission: &Mission, script: &Script) -> String {
    let run = Supervised::new(mission).unwrap().run(script).unwrap();
    let fired = run.fired.iter().find(|it| it.net == "cs" && rule(&it.transition) == name);
    let when = |time: Millis| format!("{}.{} s", time.0 / 1_000, time.0 / 100 % 10);
    format!("{}: {}", words(script), fired.map_or("does not fire".into(), |it| when(it.at)))
}

/// The lines of the rules of a net, but for those of another one.
fn lines(net: &Net<'_>, but: &Net<'_>, changed: &[(&str, &str)]) -> String {
    let mission = mission(changed);
    let tight = self::mission(&[TIGHT]);
    let mut lines = String::new();
    let mut before = "";
    for it in net.transitions {
        let name = rule(it.name);
        if name == before || but.transitions.iter().any(|other| rule(other.name) == name) {
            continue; // the variants of a rule that sets a flag
        }
        before = name;
        let event = net.events[it.on.unwrap().0 as usize].name;
        let says = net.outputs[it.emits[0].0 as usize].name;
        let by = match shown(name) {
            Shown::Never(why) => format!("never: {why}"),
            Shown::Run(injections, answers) => {
                by_run(name, &mission, &Script { injections, answers })
            }
            Shown::Tight(injections) => {
                let script = Script { injections, answers: Vec::new() };
                format!("400 s for all: {}", by_run(name, &tight, &script))
            }
        };
        let (event, says) = (event.replace('_', " "), says.replace('_', " "));
        writeln!(lines, "- `{name}`: {event}; {} → {says}.\n  *{by}*", guard(net, it)).unwrap();
    }
    lines
}

#[test]
fn every_rule_of_the_contextual_supervisor_is_reached_by_a_run_or_says_why_not() {
    const NONE: Net<'static> = Net { transitions: &[], ..contextual::NET };
    let mut page = String::from(HEAD);
    page += &lines(&contextual::NET, &NONE, &[]);
    page += "\n## Where modules may return\n\nAssumed, and off unless a mission asks for it.\n\n";
    page += &lines(&recovering_contextual::NET, &contextual::NET, &[RETURNS]);
    let long = page.lines().filter(|it| it.chars().count() > 100).collect::<Vec<_>>();
    assert_eq!(long, [] as [&str; 0]);
    let unreached = page.lines().filter(|it| it.contains("does not fire")).collect::<Vec<_>>();
    assert_eq!(unreached, [] as [&str; 0]);
    cotama_golden::compare("../docs/rules.md", &page);
}

const HEAD: &str = "# Rules of decision

What the contextual supervisor decides on a report, rule by rule, as the net `contextual` has them:
its name, the report, where it holds, and what is said to whom. Below each is a simulated run of the
delivery in which it fires, with the time of its first firing, or why there is none. The test
`sim/tests/supervised/rules.rs` runs them all and writes this page. What is not listed is recorded
only. `global event` ends the mission safely, `local event` asks the operator, the others change
what runs.

";
