//! The defects that are planted.

use cotama_core::net::{Arc, Net, OutputId, PlaceId, Role, Transition};
use cotama_core::system::{Component, System};
use cotama_core::units::Millis;
use cotama_models::cotama::FailureMode::{Bat2, Cam1, Com1, Loc2, Mot1, Mot4, Odo1, Son1, Son2};
use cotama_models::cotama::{FailureMode, delivery};
use cotama_models::missions::Mission;
use cotama_sim::campaign::requirement::Requirement;
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
    /// It does not look at these flags.
    Without(&'static str, &'static [&'static str]),
    /// It says this in place of what it says.
    Says(&'static str, &'static str),
    /// It goes from a place to another one.
    Moved(&'static str, &'static str, &'static str),
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
    pub(crate) fn supervised<'m>(&self, mission: &'m Mission) -> Supervised<'m> {
        let supervised = Supervised::of_supervisors(mission, self.change.system()).unwrap();
        match self.change {
            Change::Planted(it) => supervised.with_planted(vec![it]),
            _ => supervised,
        }
    }
}

/// All of them. F1 to F6 are findings of the reconstruction (requirements of the delivery).
pub(crate) fn defects() -> Vec<Defect> {
    use Change::{Moved, Says, Silent, Without};
    let in_time = || Requirement::InTime;
    let planted = |name, it| Defect { name, change: Change::Planted(it), breaks: in_time() };
    let of = |name, change| Defect { name, change, breaks: in_time() };
    let late = |mode: FailureMode, s: u64| Planted::Late(mode, Millis(s * 1_000));
    vec![
        // A drive declared finished while a report waits leaves the place of the mission wrong.
        of("F1 completion race", Without("ls.l3", &["local_pending", "global_pending"])),
        of("F3 masked loss of sonars", Without("pf.a1", &["sonar"])),
        of("F3 masked loss of localisation", Without("pf.a1", &["mcl"])),
        Defect {
            name: "F4 operator out of reach",
            change: Says("cs.ambiguous4", "local_event"),
            breaks: Requirement::AtMost(cotama_sim::campaign::requirement::Metric::Requests, 0),
        },
        of("F5 driven without a camera", Without("ls.l7", &["camera"])),
        of("start with a lost avoidance", Without("pf.a1", &["smz"])),
        of("other avoidance not asked for", Without("pf.a17", &["avoidance"])),
        of("lost sonars change nothing", Moved("pf.a24", "Reactive", "Reactive")),
        of("lost localisation is recorded", Silent("cs.mcl3")),
        of("a lost sonar is recorded", Silent("cs.sonar1")),
        of("a lost sonar is not told", Silent("gom.sonar")),
        of("a crashed avoidance is not told", Silent("gom.smz")),
        of("a crashed avoidance is recorded", Silent("cs.smz1")),
        of("a hard failure is recorded", Silent("cs.hard3")),
        of("what is vital is not told", Silent("gom.vital")),
        of("what is vital is recorded", Silent("cs.vital")),
        of("a lost camera is recorded", Silent("cs.camera1")),
        planted("SON1 is seen by nobody", Planted::Unseen(Son1)),
        planted("ODO1 is seen by nobody", Planted::Unseen(Odo1)),
        planted("ODO1 is seen 20 s late", late(Odo1, 20)),
        planted("SON2 is seen 20 s late", late(Son2, 20)),
        planted("COM1 hides ODO1", Planted::UnseenWhile(Com1, Odo1)),
        planted("LOC2 hides MOT1", Planted::UnseenWhile(Loc2, Mot1)),
        planted("BAT2 is seen by nobody", Planted::Unseen(Bat2)),
        planted("MOT4 is seen by nobody", Planted::Unseen(Mot4)),
        planted("plans with lost modules", Planted::PlansWithLost),
        Defect {
            name: "creeps when it is to stand",
            change: Change::Planted(Planted::Creeps),
            breaks: Requirement::NotFailed,
        },
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
