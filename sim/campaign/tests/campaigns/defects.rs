//! The defects that are planted: in the text of the delivery's robot, and in a local supervisor of
//! its own.

use cotama_campaign::requirement::Requirement;
use cotama_core::net::PlaceId;
use cotama_core::net::owned::{OwnedNet, OwnedTransition};
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::supervisors::system;
use cotama_models::robots::{Robot, RobotFile};

/// The robot whose file the defects are planted in.
const ROBOT: &str = "p3dx-delivery";

/// A defect and the requirement that it should break.
pub(crate) struct Defect {
    pub(crate) name: &'static str,
    change: Change,
    pub(crate) breaks: Requirement,
}

enum Change {
    /// Other words in the tables that begin with a line: table, old words, new words.
    Text(&'static [(&'static str, &'static str, &'static str)]),
    /// A local supervisor of its own: the one that is made, with a change.
    Local(fn(&mut OwnedNet)),
}

/// A text with other words in one of its tables.
fn edited(text: &str, (table, old, new): (&str, &str, &str)) -> String {
    let at = text.find(&format!("{table}\n")).unwrap_or_else(|| panic!("{table}"));
    let end = text[at..].find("\n\n").map_or(text.len(), |it| at + it);
    assert!(text[at..end].contains(old), "{table} does not say {old}");
    format!("{}{}{}", &text[..at], text[at..end].replacen(old, new, 1), &text[end..])
}

impl Change {
    fn robot(&self) -> RobotFile {
        let shipped = cotama_models::robots::embedded(ROBOT).unwrap().text;
        match self {
            Self::Text(edits) => {
                let text = edits.iter().fold(shipped.to_owned(), |text, it| edited(&text, *it));
                RobotFile::parse(ROBOT, &text).unwrap_or_else(|errors| panic!("{errors}"))
            }
            Self::Local(change) => {
                let mut nets = system(&Robot::shipped(ROBOT).unwrap()).nets;
                let at = nets.iter().position(|it| it.0 == "ls").unwrap();
                let made = nets.swap_remove(at).1;
                let mut own = made.clone();
                change(&mut own);
                assert_ne!(own, made);
                let text = format!("{shipped}\n[supervisors]\nlocal = \"local\"\n");
                let read = RobotFile::parse_with(ROBOT, &text, &mut |_| Ok(own.clone()));
                read.unwrap_or_else(|errors| panic!("{errors}"))
            }
        }
    }
}

impl Defect {
    /// Returns the delivery of the robot that has it.
    pub(crate) fn mission(&self) -> Mission {
        let delivery = embedded::mission("delivery").unwrap();
        Mission::parse_under(delivery.name, delivery.text, Some(self.change.robot())).unwrap()
    }
}

fn transition<'n>(net: &'n mut OwnedNet, name: &str) -> &'n mut OwnedTransition {
    net.transitions.iter_mut().find(|it| it.name == name).unwrap()
}

/// Leaves out what a transition asks of.
fn without(net: &mut OwnedNet, name: &str, places: &[&str]) {
    let names: Vec<_> = net.places.iter().map(|it| it.name.clone()).collect();
    let of = |it: PlaceId| names[it.0 as usize].trim_start_matches('!');
    transition(net, name).read.retain(|it| !places.contains(&of(it.place)));
}

/// Leaves out a transition.
fn never(net: &mut OwnedNet, name: &str) {
    net.transitions.retain(|it| it.name != name);
}

/// Takes a step whatever is lost: the first of the transitions with this name and a number.
fn always(net: &mut OwnedNet, name: &str) {
    let numbered = |it: &str| it.strip_prefix(name).is_some_and(|it| it.parse::<u32>().is_ok());
    let first = format!("{name}1");
    net.transitions.retain(|it| it.name == first || !numbered(&it.name));
    transition(net, &first).read.clear();
}

/// Leaves out an output of a transition.
fn unsaid(net: &mut OwnedNet, name: &str, output: &str) {
    let at = net.outputs.iter().position(|it| it.name == output).unwrap();
    transition(net, name).emits.retain(|it| it.0 as usize != at);
}

const NOBODY: &str = "unseen = \"nobody looks\"";

/// The goal is not reached while something is to be answered first.
const ANSWERED_FIRST: &str = "AG (ls.End -> !ls.local_event.waiting)";
/// A mission that is ended is left by the local supervisor.
const LEFT: &str = "AG (gs.Security | gs.Safe -> ls.Idle)";

/// All of them. F1, F3, F4 and F5 are findings of the reconstruction.
pub(crate) fn defects() -> Vec<Defect> {
    use Change::{Local, Text};
    let of = |name, change, breaks: &str| Defect { name, change, breaks: breaks.parse().unwrap() };
    vec![
        // A drive declared finished while a report waits leaves the place of the mission wrong.
        of(
            "F1 completion race",
            Local(|net| without(net, "Following_done", &["local_pending", "global_pending"])),
            ANSWERED_FIRST,
        ),
        of(
            "F3 a noisy sonar hides lost ones",
            Text(&[("id = \"SON4\"", "[\"sonar", "[\"sonar silent\", \"sonar")]),
            "in-time",
        ),
        of(
            "F4 operator out of reach",
            Text(&[
                ("[operator]", "[\"LAN\"]", "[\"NAV\"]"),
                (
                    "name = \"TP\"",
                    "\"NAV\", \"LAN\"]\noptional = [",
                    "\"NAV\"]\noptional = [\"LAN\", ",
                ),
            ]),
            "AG (ls.local_event.waiting -> !gom.lost_WiFi_card)",
        ),
        of(
            "F5 driven without a camera",
            Text(&[("name = \"TO.DEG\"", ", \"CAM\"]", "]")]),
            "AG (gom.lost_camera & ls.Teleoperation -> AF<=300ms !ls.Teleoperation)",
        ),
        of("abort while he is asked is not heard", Local(|net| never(net, "abort_Waits")), LEFT),
        of(
            "asks and does not stop",
            Local(|net| unsaid(net, "ask_Following", "stop_Following")),
            "AG (permit.Granted <-> ls.Following | ls.Teleoperation)",
        ),
        of(
            "follows whatever is lost",
            Local(|net| always(net, "Planning_done")),
            "AG (ls.Following -> !following.Off)",
        ),
        of(
            "plans whatever is lost",
            Local(|net| always(net, "Teleprogramming_done")),
            "AG (gom.lost_PPL & ls.Planning -> AF<=300ms !ls.Planning)",
        ),
        of(
            "SON1 is seen by nobody",
            Text(&[("id = \"SON1\"", "flags = [\"sonar far\"]", NOBODY)]),
            "in-time",
        ),
        of(
            "ODO1 is seen by nobody",
            Text(&[("id = \"ODO1\"", "flags = [\"wheel residual\", \"pose distance\"]", NOBODY)]),
            "in-time",
        ),
        of(
            "BAT2 is seen by nobody",
            Text(&[
                ("id = \"BAT2\"", "flags = [\"battery critical\"]", NOBODY),
                ("id = \"BAT1\"", "low\"]", "low\"]\nsometimes = [\"battery critical\"]"),
            ]),
            "not-failed",
        ),
        of(
            "MOT4 is seen by nobody",
            Text(&[
                ("id = \"MOT4\"", "flags = [\"runaway\"]", NOBODY),
                ("id = \"MOT1\"", "stall\"]", "stall\"]\nsometimes = [\"runaway\"]"),
            ]),
            "in-time",
        ),
        of(
            "ODO1 is seen 20 s late",
            Text(&[("id = \"ODO1\"", "latency_ms = 1500", "latency_ms = 21500")]),
            "exposed<=20000",
        ),
        of(
            "SON2 is seen 20 s late",
            Text(&[("id = \"SON2\"", "latency_ms = 1000", "latency_ms = 21000")]),
            "exposed<=20000",
        ),
        of(
            "a lost link hides ODO1",
            Text(&[
                ("[observer.O-EFF]", "flags", "needs = [\"LAN\"]\nflags"),
                ("[observer.O-LOC]", "flags", "needs = [\"LAN\"]\nflags"),
            ]),
            "in-time",
        ),
        of(
            "a lost link hides sensor data",
            Text(&[("[observer.O-SEN]", "flags", "needs = [\"LAN\"]\nflags")]),
            "seen-in-time",
        ),
        of(
            "MOT3 hides MOT1",
            Text(&[
                ("id = \"MOT1\"", "flags = [\"wheel disobeys\", \"stall\"]", "flags = [\"stall\"]"),
                ("id = \"MOT3\"", "flags = [\"stall\"]", "flags = [\"wheel disobeys\", \"stall\"]"),
            ]),
            "in-time",
        ),
        of("LOC2 hides LOC1", Text(&[("id = \"LOC1\"", "helped = true\n", "")]), "in-time"),
        of("MOT3 is not let go", Text(&[("id = \"MOT3\"", "helped = true\n", "")]), "not-failed"),
        of(
            "a lost link is called fatal",
            Text(&[("id = \"COM1\"", "autonomous = \"weak\"", "autonomous = \"fatal\"")]),
            "completed",
        ),
        of(
            "a person in the way is called hard",
            Text(&[("id = \"HUM1\"", "autonomous = \"weak\"", "autonomous = \"hard\"")]),
            "requests<=0",
        ),
        blind(),
    ]
}

/// The observers as they were: a lost sonar blinded the observer of the camera too, so that the
/// operator drove on without an image.
pub(crate) fn blind() -> Defect {
    Defect {
        name: "a lost sonar hides a dead camera",
        change: Change::Text(&[(
            "[observer.O-SEN]",
            ", \"no frame\", \"old frame\", \"value outside\"]",
            ", \"value outside\"]\n[observer.O-CAM]\nneeds = [\"sonar_arrays\"]\nflags = [\"no \
             frame\", \"old frame\"]",
        )]),
        breaks: Requirement::InTime,
    }
}
