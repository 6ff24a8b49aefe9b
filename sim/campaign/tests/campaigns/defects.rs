//! The defects that are planted.

use cotama_campaign::requirement::Requirement;
use cotama_campaign::subject::Subject;
use cotama_core::net::{Arc, Net, OutputId, PlaceId, Role, Transition};
use cotama_core::system::{Clear, Component, System};
use cotama_core::units::Millis;
use cotama_models::cotama::FailureMode::{Bat2, Cam1, Com1, Loc2, Mot1, Mot4, Odo1, Son1, Son2};
use cotama_models::cotama::{FailureMode, REQUIREMENTS, delivery};
use cotama_models::missions::Mission;
use cotama_sim::supervised::{Planted, Supervised};

/// A defect and the requirement that it should break.
pub(crate) struct Defect {
    pub(crate) name: &'static str,
    change: Change,
    pub(crate) breaks: Requirement,
}

enum Change {
    /// A transition says nothing.
    Silent(&'static str),
    /// The transition does not read these flags.
    Without(&'static str, &'static [&'static str]),
    /// Neither the local supervisor nor the operator looks at whether there is a camera.
    Blind,
    /// The transition emits this in place of its outputs.
    Says(&'static str, &'static str),
    /// The transition goes from a place to another one.
    Moved(&'static str, &'static str, &'static str),
    /// There is one more like it, from a place to another one.
    Also(&'static str, &'static str, &'static str),
    /// An event leaves what waits in a mailbox: the system's own empties it.
    Keeps(&'static str),
    Planted(Planted),
}

/// The shipped system with one transition, `net.transition`, and its variants changed; test data,
/// which lives to the end.
fn with(
    name: &str,
    change: impl Fn(&'static Net<'static>, &mut Transition<'static>),
) -> System<'static> {
    let (net, transition) = name.split_once('.').unwrap();
    let mut components = delivery::SYSTEM.components.to_vec();
    let it = components.iter_mut().find(|it| it.name == net).unwrap();
    let mut transitions = it.net.transitions.to_vec();
    let named = transitions.iter_mut().filter(|it| it.name.split('.').next() == Some(transition));
    assert_ne!(named.map(|of| change(it.net, of)).count(), 0, "{name}");
    let net = Box::leak(Box::new(Net { transitions: transitions.leak(), ..*it.net }));
    *it = Component { name: it.name, net };
    System { components: components.leak(), ..delivery::SYSTEM }
}

fn without(name: &str, flags: &[&str]) -> System<'static> {
    with(name, |net, it| {
        let is_it = |arc: &&Arc| {
            let place = &net.places[arc.place.0 as usize];
            let of = if let Role::Complement(of) = place.role { of } else { arc.place };
            !flags.contains(&net.places[of.0 as usize].name)
        };
        let kept: Vec<_> = it.read.iter().filter(is_it).copied().collect();
        assert_ne!(kept.len(), it.read.len(), "{name} does not look at {flags:?}");
        it.read = kept.leak();
    })
}

impl Change {
    fn system(&self) -> System<'static> {
        match *self {
            Self::Silent(name) => with(name, |_, it| it.emits = &[]),
            Self::Without(name, flags) => without(name, flags),
            Self::Blind => {
                let without = |name| without(name, &["camera"]).components;
                let (supervisor, operator) = (without("ls.l7"), without("operator.teleoperate"));
                let mut components = supervisor.to_vec();
                let at = components.iter().position(|it| it.name == "operator").unwrap();
                components[at] = operator[at];
                System { components: components.leak(), ..delivery::SYSTEM }
            }
            Self::Also(name, from, to) => {
                let system = Self::Moved(name, from, to).system();
                let (net, transition) = name.split_once('.').unwrap();
                let mut components = system.components.to_vec();
                let at = components.iter().position(|it| it.name == net).unwrap();
                let moved = components[at].net;
                let of = |it: &&Transition| it.name.split('.').next() == Some(transition);
                let shipped = delivery::SYSTEM.components[at].net.transitions;
                let more = moved.transitions.iter().filter(of).copied();
                let more = more.map(|it| Transition { name: "stale", ..it });
                let transitions = shipped.iter().copied().chain(more).collect::<Vec<_>>().leak();
                components[at].net = Box::leak(Box::new(Net { transitions, ..*moved }));
                System { components: components.leak(), ..delivery::SYSTEM }
            }
            Self::Keeps(mailbox) => {
                let kept = |it: &&Clear| {
                    let component = &delivery::SYSTEM.components[usize::from(it.on.component)];
                    let event = component.net.events[it.mailbox.0 as usize].name;
                    format!("{}.{event}", component.name) != mailbox
                };
                let clears: Vec<_> = delivery::SYSTEM.clears.iter().filter(kept).copied().collect();
                assert_ne!(clears.len(), delivery::SYSTEM.clears.len(), "{mailbox}");
                System { clears: clears.leak(), ..delivery::SYSTEM }
            }
            Self::Says(name, output) => with(name, |net, it| {
                let output = net.outputs.iter().position(|it| it.name == output).unwrap();
                it.emits = vec![OutputId(output as u32)].leak();
            }),
            Self::Moved(name, from, to) => with(name, |net, it| {
                let arc = |name| {
                    let place = net.places.iter().position(|it| it.name == name).unwrap();
                    Arc { place: PlaceId(place as u32), weight: 1 }
                };
                (it.take, it.give) = (vec![arc(from)].leak(), vec![arc(to)].leak());
            }),
            Self::Planted(_) => delivery::SYSTEM,
        }
    }
}

impl Defect {
    /// Returns the subject, ready to be run, and watched for the requirements that the defect
    /// breaks.
    pub(crate) fn subject<'m>(&self, mission: &'m Mission) -> Subject<'m> {
        let subject = Subject::of(mission, self.supervised(mission));
        subject.watching(std::slice::from_ref(&self.breaks)).unwrap()
    }

    fn supervised<'m>(&self, mission: &'m Mission) -> Supervised<'m> {
        let supervised = Supervised::of_supervisors(mission, self.change.system()).unwrap();
        match self.change {
            Change::Planted(it) => supervised.with_planted(vec![it]),
            _ => supervised,
        }
    }
}

/// A requirement of the delivery, by its id.
fn required(id: &str) -> Requirement {
    let found = REQUIREMENTS.iter().find(|it| it.id == id).unwrap();
    Requirement::Always(found.asked.unwrap().text.to_owned())
}

/// Returns the requirement that a lost module is used at the ends of two rounds at most: AS2, of
/// one module.
fn unused(lost: &str, by: &str) -> Requirement {
    Requirement::Always(format!("AG (!faults.{lost} & ({by}) -> AF<=200ms !({by}))"))
}

/// All of them. F1 to F6 are findings of the reconstruction (requirements of the delivery).
pub(crate) fn defects() -> Vec<Defect> {
    use Change::{Also, Blind, Keeps, Moved, Says, Silent, Without};
    let of = |name, change, breaks| Defect { name, change, breaks };
    let timely = |name, change| Defect { name, change, breaks: Requirement::InTime };
    let planted = |name, it| timely(name, Change::Planted(it));
    let late = |mode: FailureMode, s: u64| Planted::Late(mode, Millis(s * 1_000));
    let always = |text: &str| Requirement::Always(text.to_owned());
    let answered = "AG (gom.hard_flag.waiting & ls.Following -> AF<=200ms !ls.Following)";
    vec![
        // A drive declared finished while a report waits leaves the place of the mission wrong.
        of(
            "F1 completion race",
            Without("ls.l3", &["local_pending", "global_pending"]),
            required("LS5"),
        ),
        // An adapter event that comes when path following has ended starts it anew.
        of("F2 stale adapter event", Also("pf.m1", "Off", "Optimal"), required("LS1")),
        // Without sonars there is no localisation either, so one flag alone hides nothing.
        timely("F3 masked loss of sonars", Without("pf.a1", &["sonar", "mcl"])),
        timely("F3 masked loss of localisation", Without("pf.a1", &["mcl"])),
        of(
            "F4 operator out of reach",
            Says("cs.ambiguous4", "local_event"),
            always("AG (ls.local_event.waiting -> gom.wifi)"),
        ),
        timely("F5 driven without a camera", Blind),
        of("F6 abort against start", Keeps("ls.start_drive"), required("GS2")),
        timely("start with a lost avoidance", Without("pf.a1", &["smz"])),
        of(
            "other avoidance not asked for",
            Without("pf.a17", &["avoidance"]),
            unused("avoidance", "to.Full | pf.Reactive"),
        ),
        timely("lost sonars change nothing", Moved("pf.a24", "Reactive", "Reactive")),
        of(
            "lost localisation is recorded",
            Silent("cs.mcl3"),
            unused("mcl", "pf.Optimal | pf.Reduced | pf.Reactive"),
        ),
        timely("a lost sonar is recorded", Silent("cs.sonar1")),
        timely("a lost sonar is not told", Silent("gom.sonar")),
        // A crash is hard by its row too, so that the operator is asked a round later anyway.
        of("a crashed avoidance is not told", Silent("gom.smz"), Requirement::Conforms),
        of("a crashed avoidance is recorded", Silent("cs.smz1"), Requirement::Conforms),
        of("a hard failure is recorded", Silent("cs.hard3"), always(answered)),
        timely("what is vital is not told", Silent("gom.vital")),
        timely("what is vital is recorded", Silent("cs.vital")),
        timely("a lost camera is recorded", Silent("cs.camera1")),
        planted("SON1 is seen by nobody", Planted::Unseen(Son1)),
        planted("ODO1 is seen by nobody", Planted::Unseen(Odo1)),
        planted("ODO1 is seen 20 s late", late(Odo1, 20)),
        planted("SON2 is seen 20 s late", late(Son2, 20)),
        planted("COM1 hides ODO1", Planted::UnseenWhile(Com1, Odo1)),
        planted("LOC2 hides MOT1", Planted::UnseenWhile(Loc2, Mot1)),
        of(
            "BAT2 is seen by nobody",
            Change::Planted(Planted::Unseen(Bat2)),
            Requirement::NotFailed,
        ),
        planted("MOT4 is seen by nobody", Planted::Unseen(Mot4)),
        of(
            "plans with lost modules",
            Change::Planted(Planted::PlansWithLost),
            Requirement::PlansWithWhatWorks,
        ),
        of(
            "creeps when it is to stand",
            Change::Planted(Planted::Creeps),
            Requirement::StandsWhenSafe,
        ),
        BLIND,
    ]
}

/// The supervisors as they were: a lost sonar blinded the observer of the camera too, so that the
/// operator drove on without an image.
pub(crate) const BLIND: Defect = Defect {
    name: "a lost sonar hides a dead camera",
    change: Change::Planted(Planted::UnseenWhile(Son2, Cam1)),
    breaks: Requirement::InTime,
};
