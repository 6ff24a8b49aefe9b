//! The net in the making: its places by what they mean, and how a transition is added.

use super::team::{Defect, Team};
use cotama_core::net::owned::{OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Arc, PlaceId};

/// Documentation of the net.
const DOC: &str = "Robots agree by messages on who does which task.";

/// A robot's places: one of `idle`, `waiting`, `executing` and `down` is marked.
pub(super) struct Robot {
    pub(super) up: PlaceId,
    pub(super) down: PlaceId,
    pub(super) idle: PlaceId,
    /// For each task: it said yes, and waits for its partner.
    pub(super) waiting: Vec<PlaceId>,
    /// For each task.
    pub(super) executing: Vec<PlaceId>,
}

/// A robot in the present round of a task: one of these is marked.
pub(super) struct Answer {
    pub(super) silent: PlaceId,
    pub(super) bid: PlaceId,
    /// The robot will not bid in this round; only the text's auctioneer waits for that.
    pub(super) passed: PlaceId,
    /// The award names it; its Assign is in the air.
    pub(super) named: PlaceId,
    /// The Ack of the robot is in the air.
    pub(super) acked: PlaceId,
    /// The robot had said yes and has left; its Ack and its "no" are in the air.
    pub(super) left: PlaceId,
    /// The robot said no at once.
    pub(super) refused: PlaceId,
    /// The messages to and from the robot that are in the air from rounds before: nothing, an
    /// Assign to it, an Ack as well. No places where messages of older rounds leave no trace.
    pub(super) old: Vec<PlaceId>,
}

/// A task's places: one of the phases is marked.
pub(super) struct Task {
    pub(super) open: PlaceId,
    pub(super) announced: PlaceId,
    pub(super) awarded: PlaceId,
    pub(super) executing: PlaceId,
    pub(super) withdrawn: PlaceId,
    pub(super) done: PlaceId,
    pub(super) reported: PlaceId,
    pub(super) lost: PlaceId,
    /// Whether the robots have completed it, whoever knows.
    pub(super) unfinished: PlaceId,
    pub(super) completed: PlaceId,
    /// Some auctioneer of it is active.
    pub(super) led: PlaceId,
    /// The auctioneer of the task is down.
    pub(super) vacant: PlaceId,
    /// For each robot: whether it is the auctioneer.
    pub(super) leader: Vec<PlaceId>,
    pub(super) follower: Vec<PlaceId>,
    pub(super) answers: Vec<Answer>,
}

/// The net in the making.
pub(super) struct Draft<'t> {
    pub(super) team: &'t Team,
    pub(super) net: OwnedNet,
    pub(super) robots: Vec<Robot>,
    pub(super) tasks: Vec<Task>,
    pub(super) failures: PlaceId,
    /// How often a robot has failed.
    pub(super) failed: PlaceId,
    pub(super) untimely: PlaceId,
}

fn place(net: &mut OwnedNet, name: &str, tokens: u32, bound: u32) -> PlaceId {
    net.places.push(OwnedPlace::new(name, tokens).at_most(bound));
    PlaceId(net.places.len() as u32 - 1)
}

impl<'t> Draft<'t> {
    /// All places, no transition.
    pub(super) fn new(team: &'t Team) -> Self {
        let mut net = OwnedNet::new(&format!("team_{}", team.robots), DOC);
        let failures = place(&mut net, "failures", team.failures, team.failures);
        let failed = place(&mut net, "failed", 0, team.failures);
        let untimely = place(&mut net, "untimely", 1, 1);
        let robots = (1..=team.robots).map(|r| robot(&mut net, r, team.tasks.len())).collect();
        let tasks = (0..team.tasks.len()).map(|t| task(&mut net, t, team)).collect();
        Self { team, net, robots, tasks, failures, failed, untimely }
    }

    /// Claims the properties of the repaired protocol; a net with a defect breaks some of them.
    pub(super) fn laws(&mut self) {
        let invariant = |places: &[PlaceId]| OwnedLaw::Invariant {
            sum: places.iter().map(|&place| Arc { place, weight: 1 }).collect(),
            equals: 1,
        };
        let mut laws = vec![];
        for it in &self.robots {
            let busy = [&it.waiting[..], &it.executing].concat();
            laws.push(invariant(&[&[it.idle, it.down][..], &busy].concat()));
        }
        for (t, it) in self.tasks.iter().enumerate() {
            laws.push(invariant(&[&[it.vacant][..], &it.leader].concat()));
            laws.push(OwnedLaw::NeverBoth(it.completed, it.announced));
            for r in self.team.tasks[t].capable() {
                let work = self.robots[r].executing[t];
                laws.push(OwnedLaw::NeverBoth(work, it.announced));
                laws.push(OwnedLaw::NeverBoth(it.executing, it.answers[r].named));
            }
        }
        self.net.laws = laws;
    }

    /// Whether the protocol has this defect.
    pub(super) fn has(&self, defect: Defect) -> bool {
        self.team.defects.contains(&defect)
    }

    /// A transition: what it takes, what it reads, what it gives.
    pub(super) fn add(&mut self, name: &str, take: &[PlaceId], read: &[PlaceId], give: &[PlaceId]) {
        let arcs = |places: &[PlaceId]| {
            places.iter().map(|&place| Arc { place, weight: 1 }).collect::<Vec<_>>()
        };
        let mut read = read.to_vec();
        read.sort_unstable();
        read.dedup();
        read.retain(|place| !take.contains(place));
        let line = self.net.transitions.len() as u32;
        let (take, read, give) = (arcs(take), arcs(&read), arcs(give));
        let new = OwnedTransition { line, take, read, give, ..OwnedTransition::new(name) };
        self.net.transitions.push(new);
    }
}

fn robot(net: &mut OwnedNet, number: usize, tasks: usize) -> Robot {
    let mut one = |what: &str, tokens| place(net, &format!("r{number}.{what}"), tokens, 1);
    let (up, down, idle) = (one("up", 1), one("down", 0), one("idle", 1));
    let waiting = (1..=tasks).map(|t| one(&format!("waiting.t{t}"), 0)).collect();
    let executing = (1..=tasks).map(|t| one(&format!("executing.t{t}"), 0)).collect();
    Robot { up, down, idle, waiting, executing }
}

fn task(net: &mut OwnedNet, at: usize, team: &Team) -> Task {
    let most = if team.defects.is_empty() { 1 } else { team.robots as u32 };
    let mut one = |what: &str, tokens| place(net, &format!("t{}.{what}", at + 1), tokens, most);
    let first = team.tasks[at].received;
    Task {
        open: one("open", 1),
        announced: one("announced", 0),
        awarded: one("awarded", 0),
        executing: one("executing", 0),
        withdrawn: one("withdrawn", 0),
        done: one("done", 0),
        reported: one("reported", 0),
        lost: one("lost", 0),
        unfinished: one("unfinished", 1),
        completed: one("completed", 0),
        led: one("led", 1),
        vacant: one("vacant", 0),
        leader: (0..team.robots)
            .map(|r| one(&format!("leader.r{}", r + 1), u32::from(r == first)))
            .collect(),
        follower: (0..team.robots)
            .map(|r| one(&format!("follower.r{}", r + 1), u32::from(r != first)))
            .collect(),
        answers: (1..=team.robots)
            .map(|r| {
                let mut of = |what: &str, tokens| one(&format!("{what}.r{r}"), tokens);
                Answer {
                    silent: of("silent", 1),
                    bid: of("bid", 0),
                    passed: of("passed", 0),
                    named: of("named", 0),
                    acked: of("acked", 0),
                    left: of("left", 0),
                    refused: of("refused", 0),
                    old: if team.keeps_old {
                        vec![of("old_none", 1), of("old_assign", 0), of("old_ack", 0)]
                    } else {
                        vec![]
                    },
                }
            })
            .collect(),
    }
}
