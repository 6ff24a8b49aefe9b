//! The protocol, and above each robot the global supervisor of COTAMA that decides what it does.

use super::draft::Draft;
use super::requirement::{Requirement, any};
use super::team::Team;
use crate::robots::supervisors::{Step, global};
use crate::team::scenario::steps;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId};

/// The net of a team whose robots are supervised, as one system: a task is a mission of the global
/// supervisor of four [`steps`] (Durand et al., TAROS 2010, V.C.1).
///
/// - A robot bids and acknowledges when its supervisor waits for a mission. To start its role is
///   `mission_received`; the role ends when the mission is `Done`, and the supervisor waits again.
/// - Robots fail by their supervisors alone: a `global_event` makes one safe, at any time, as often
///   as the team's failures; that no configuration is left and nobody can be asked is the same to
///   the team. A safe robot gives its role back, or falls silent, and is out of work.
/// - Who leaves its role for another reason begins anew: its supervisor waits again.
///
/// The supervisors below the global one are left out: seen from the team they decide when a drive
/// is done and when there is a `global_event`, which are left to chance here.
///
/// ```
/// use cotama_models::team::protocol::{Team, supervised};
/// let net = supervised(&Team::new(2, 1));
/// assert_eq!(net.view().net().defect(), None);
/// assert!(net.places.iter().any(|it| it.name == "r2.DriveA"));
/// assert!(net.transitions.iter().any(|it| it.name == "r2.abort.DriveA"));
/// ```
pub fn supervised(team: &Team) -> OwnedNet {
    let mut draft = super::drafted(team);
    draft.supervise();
    draft.net
}

/// Returns the requirements of supervised robots beside [`requirements`](super::requirements).
///
/// ```
/// use cotama_models::team::protocol::{Team, supervised_requirements};
/// let asked = supervised_requirements(&Team::new(2, 1));
/// assert_eq!(asked.iter().map(|it| it.id).collect::<Vec<_>>(), ["C1", "C2", "C3"]);
/// ```
pub fn supervised_requirements(team: &Team) -> Vec<Requirement> {
    let robots = 1..=team.robots;
    let works = |r: usize| any((1..=team.tasks.len()).map(|t| format!("r{r}.executing.t{t}")));
    let busy = |r: usize| any(steps().iter().map(|it| format!("r{r}.{}", it.place())));
    let each =
        |of: &dyn Fn(usize) -> String| robots.clone().map(of).collect::<Vec<_>>().join(" & ");
    let all = [
        (
            "C1",
            "A robot is on a mission exactly while it executes a role, or has become safe in it.",
            each(&|r| format!("AG (({} -> {w}) & ({w} -> !r{r}.Wait))", busy(r), w = works(r))),
        ),
        (
            "C2",
            "A safe robot gives its role back.",
            each(&|r| format!("AG (r{r}.Safe -> AF !{})", works(r))),
        ),
        (
            "C3",
            "A safe robot never executes a role again.",
            each(&|r| format!("AG (r{r}.Safe & r{r}.idle -> AG !{})", works(r))),
        ),
    ];
    let requirement = |(id, sentence, text): (&'static str, &'static str, String)| {
        let assumed = if text.contains("AF") { " assuming weak(network.settles)" } else { "" };
        let text = format!("{text}{assumed}");
        Requirement { id, sentence, fair: text.clone(), text }
    };
    all.into_iter().map(requirement).collect()
}

/// The supervisor of a robot: its net, and where the places of that are among all.
struct Supervisor<'n> {
    net: &'n OwnedNet,
    places: Vec<PlaceId>,
}

impl Supervisor<'_> {
    /// Returns the arc from or to a place of this name.
    fn at(&self, name: &str) -> Option<Arc> {
        let place = self.net.places.iter().position(|it| it.name == name)?;
        Some(Arc { place: *self.places.get(place)?, weight: 1 })
    }

    fn all(&self, arcs: &[Arc]) -> Vec<Arc> {
        let place = |it: &Arc| Some(Arc { place: *self.places.get(it.place.0 as usize)?, ..*it });
        arcs.iter().filter_map(place).collect()
    }
}

impl Draft<'_> {
    /// Adds a supervisor for each robot, and ties the steps of the protocol to it.
    fn supervise(&mut self) {
        let net = global(&steps());
        let supervisors = (1..=self.team.robots).map(|r| self.supervisor(r, &net));
        let supervisors: Vec<_> = supervisors.collect();
        let mut steps = std::mem::take(&mut self.net.transitions);
        for (r, supervisor) in supervisors.iter().enumerate() {
            steps = steps.into_iter().flat_map(|it| self.tied(it, r, supervisor)).collect();
            steps.extend(self.own_steps(r, supervisor));
        }
        for (line, it) in (0..).zip(&mut steps) {
            it.line = line;
        }
        self.net.transitions = steps;
    }

    fn supervisor<'n>(&mut self, number: usize, net: &'n OwnedNet) -> Supervisor<'n> {
        let first = self.net.places.len() as u32;
        let places = net.places.iter().map(|it| {
            OwnedPlace::new(&format!("r{number}.{}", it.name), it.initial).at_most(it.bound)
        });
        self.net.places.extend(places);
        let places = (first..self.net.places.len() as u32).map(PlaceId).collect();
        Supervisor { net, places }
    }

    /// A step of the protocol, as this robot's supervisor allows it.
    fn tied(&self, it: OwnedTransition, r: usize, own: &Supervisor<'_>) -> Vec<OwnedTransition> {
        let robot = &self.robots[r];
        let among =
            |arcs: &[Arc], places: &[PlaceId]| arcs.iter().any(|it| places.contains(&it.place));
        let [bids, acks] = [0, 1].map(|which| -> Vec<PlaceId> {
            let answers = self.tasks.iter().map(|it| &it.answers[r]);
            answers.map(|it| if which == 0 { it.bid } else { it.acked }).collect()
        });
        let completed: Vec<_> = self.tasks.iter().map(|it| it.completed).collect();
        let with = |suffix: &str, take: &[Arc], read: &[Arc], give: &[Arc]| {
            let name = format!("{}{suffix}", it.name);
            let joined = |all: &[Arc], more: &[Arc]| [all, more].concat();
            let (take, read, give) =
                (joined(&it.take, take), joined(&it.read, read), joined(&it.give, give));
            OwnedTransition { name, take, read, give, ..it.clone() }
        };
        let at = |place: &str| own.at(place).into_iter().collect::<Vec<_>>();
        let [wait, done, safe] = ["Wait", "Done", "Safe"].map(at);
        let objectives: Vec<_> = steps().iter().map(Step::place).collect();
        let first = objectives.first().map_or_else(Vec::new, |it| at(it));
        if among(&it.take, &[self.failures]) && it.name.starts_with(&format!("r{}.", r + 1)) {
            let mut it = with("", &[], &safe, &[]);
            it.take.retain(|arc| arc.place != self.failures);
            it.give.retain(|arc| arc.place != self.failed);
            vec![it]
        } else if among(&it.give, &robot.executing) {
            vec![with("", &wait, &[], &first)]
        } else if among(&it.take, &robot.executing) && among(&it.give, &completed) {
            vec![with("", &done, &[], &wait)]
        } else if among(&it.take, &robot.executing) {
            let leaves = |place: &str| with(&format!(".{place}"), &at(place), &[], &wait);
            let stays = |place: &str| with(&format!(".{place}"), &[], &at(place), &[]);
            let on_mission = objectives.iter().map(String::as_str).chain(["Done"]);
            on_mission.map(leaves).chain(["Security", "Safe"].map(stays)).collect()
        } else if among(&it.give, &bids)
            || among(&it.give, &acks) && among(&it.give, &robot.waiting)
        {
            vec![with("", &[], &wait, &[])]
        } else {
            vec![it]
        }
    }

    /// The steps of the supervisor that are none of the protocol.
    fn own_steps(&self, r: usize, own: &Supervisor<'_>) -> Vec<OwnedTransition> {
        let one = |place: PlaceId| Arc { place, weight: 1 };
        let wait = own.at("Wait").map(|it| it.place);
        let mut steps = Vec::new();
        for it in &own.net.transitions {
            let (mut take, mut give) = (own.all(&it.take), own.all(&it.give));
            let abort = it.name.strip_prefix("abort_");
            let fails = abort.is_some();
            // To start a role is a step of the protocol; to give up is to fail.
            let begins = take.iter().any(|arc| Some(arc.place) == wait);
            if begins && !fails || it.name.starts_with("give_up_") {
                continue;
            }
            let name = match abort {
                Some(from) => format!("r{}.abort.{from}", r + 1),
                None => format!("r{}.{}", r + 1, it.name),
            };
            if fails {
                take.push(one(self.failures));
                give.push(one(self.failed));
            }
            steps.push(OwnedTransition { take, give, ..OwnedTransition::new(&name) });
        }
        steps
    }
}
