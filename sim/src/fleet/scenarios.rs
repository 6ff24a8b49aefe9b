//! Scenarios: the drink service of the thesis, an office with a fleet, and the worst cases of its
//! table of messages.

use super::floors;
use crate::streams::{Stream, Streams};
use cotama_core::team::Combine;
use cotama_models::team::scenario;
use cotama_models::team::scenario::{
    FailureRates, Fault, FaultKind, FaultTime, Floor, Formation, Give, MAX_ROBOTS, Method, Needs,
    Place, PlanSpec, Quality, RobotSpec, RoleSpec, Row, Scenario, Seat, Stay, Take, TaskSpec,
    Travel, Trust, usual,
};
use cotama_models::team::service::{DETECT, GRASP_2F, MOVE};
use cotama_models::team::{Capability, CapabilitySet, Reliability, Skill};
use std::sync::LazyLock;

/// May enter the secured wing.
const BADGE: Capability = Capability::new(6).expect("it is a small number");

/// The needs of a delivery, and of one into the secured wing.
const ANYBODY: [Capability; 2] = [MOVE, GRASP_2F];
const WITH_BADGE: [Capability; 3] = [MOVE, GRASP_2F, BADGE];

/// The names of the capabilities of the service and the fleet, by their numbers.
fn skills() -> Vec<String> {
    let names = ["move", "detect", "grasp-2f", "grasp-3f", "cue-hold", "dialogue", "badge"];
    names.map(str::to_owned).to_vec()
}

/// A fleet in an office.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FleetOptions {
    /// How many robots; at most [`MAX_ROBOTS`].
    pub robots: usize,
    /// Number of deliveries.
    pub tasks: usize,
    /// How many robots fail for good; as many others have a lesser failure.
    pub failures: usize,
    /// How many of a thousand messages get lost.
    pub loss_permille: u16,
    /// How often the gripper of the first robot fails, in thousandths; 0 for a fleet in which none
    /// ever does. Where one does, grippers take and give for a minute, ten uses of each have gone
    /// well before, and deliveries come more slowly.
    pub gripper_fails_permille: u16,
    /// Whether a robot gives tasks out, the first one, and others take over when it fails.
    pub takeover: bool,
    /// Number of times that whoever gives tasks out then fails.
    pub kills: usize,
    /// How tasks are given to robots.
    pub method: Method,
    /// The seed of all random numbers.
    pub seed: u64,
}

impl Default for FleetOptions {
    fn default() -> Self {
        let method = Method::Optimal;
        Self {
            robots: 40,
            tasks: 200,
            failures: 5,
            loss_permille: 50,
            gripper_fails_permille: 0,
            takeover: false,
            kills: 0,
            method,
            seed: 0,
        }
    }
}

/// Failures after which a robot does not work any more: some it finds, some make it silent.
const STOPS: [&str; 7] = ["MOT1", "EST1", "BAT3", "PWR1", "SW3", "ODO1", "BMP2"];
/// Failures with which it goes on: slower, or after a while.
const LESSER: [&str; 5] = ["SON1", "SON2", "HUM1", "MOT2", "CAM1"];

/// Corridor nodes of one of the two corridors; each has two offices.
const NODES: usize = 12;
/// From here on the second corridor is the secured wing, behind a door.
const SECURED: usize = 8;
/// How long a robot works for a delivery on average, with its way there: for how many come in which
/// time.
const WORK: u64 = 240_000;

/// The same where what is taken and given takes long, with some robots at rest at any time.
const WORK_BY_HAND: u64 = 720_000;

/// A fleet in an office: deliveries from office to office come one after the other; those into the
/// secured wing are carried by a robot with a badge alone, or handed over at its door.
///
/// ```
/// use cotama_sim::fleet::{record::Fate, run, scenarios::{FleetOptions, fleet}};
/// let options = FleetOptions { robots: 8, tasks: 12, failures: 1, ..FleetOptions::default() };
/// let run = run(&fleet(&options));
/// assert!(run.is_sound());
/// assert_eq!(run.count(Fate::Done) + run.count(Fate::Reported), 12);
/// ```
pub fn fleet(options: &FleetOptions) -> Scenario {
    let robots = options.robots.clamp(1, MAX_ROBOTS);
    let streams = Streams::new(options.seed);
    let floor = OFFICE.clone();
    let hands = options.gripper_fails_permille > 0;
    let work = if hands { WORK_BY_HAND } else { WORK };
    let horizon = options.tasks as u64 * work / robots as u64;
    let (mut places, mut times) = (streams.stream("fleet tasks"), streams.stream("fleet times"));
    let mut arrivals: Vec<u64> = (0..options.tasks).map(|_| times.below(horizon + 1)).collect();
    arrivals.sort_unstable();
    let offices = 2 * NODES as u64 * 2;
    let tasks = arrivals.iter().enumerate().map(|(number, &arrival_ms)| {
        let start = places.below(offices) as usize;
        let goal = (start + 1 + places.below(offices - 1) as usize) % offices as usize;
        let mut task = delivery(number, arrival_ms, start, goal);
        if hands {
            task.plans.iter_mut().flat_map(|it| &mut it.roles).for_each(drives_and_grasps);
        }
        task
    });
    let robot = |number: usize| {
        let rate = if number == 0 { options.gripper_fails_permille } else { 0 };
        let skill = |it: Capability| match it {
            GRASP_2F if hands => Skill { capability: it, reliability: TESTED },
            it => Skill::certain(it),
        };
        RobotSpec {
            name: format!("r{:02}", number + 1),
            file: usual(),
            skills: [MOVE, DETECT, GRASP_2F]
                .into_iter()
                .chain((number.is_multiple_of(3)).then_some(BADGE))
                .map(skill)
                .collect(),
            fails: FailureRates::NONE.with(GRASP_2F, rate),
            start: Place(number * 7 % (2 * NODES)),
            stay: Stay::default(),
            supply: None,
        }
    };
    Scenario {
        name: "fleet".into(),
        skills: skills(),
        floor,
        crowds: Vec::new(),
        robots: (0..robots).map(robot).collect(),
        tasks: tasks.collect(),
        faults: faults(options, robots, horizon, streams),
        network: Quality { loss_permille: options.loss_permille, ..Quality::OFFICE },
        method: options.method,
        formation: Formation::Central,
        auctioneer: if options.takeover { Seat::Queue(0) } else { Seat::Desk },
        slack_permille: 1_000,
        second_best: false,
        trust: Trust::default(),
        travel: Travel::Plain,
        seed: options.seed,
    }
}

/// Each gripper was tried ten times before the robot came, and did not fail.
const TESTED: Reliability = Reliability::Uses { succeeded: 10, failed: 0 };

/// Parts the one action of a role: who may go there drives, and the gripper takes and gives, for
/// a minute each.
fn drives_and_grasps(role: &mut RoleSpec) {
    let whole: Vec<CapabilitySet> = role.actions.iter().flat_map(|it| it.0.clone()).collect();
    let (grasps, drives): (Vec<_>, Vec<_>) = whole.into_iter().partition(|it| it.has(GRASP_2F));
    role.actions = [drives.clone(), grasps.clone(), drives, grasps].map(Needs).to_vec();
    (role.take_ms, role.give_ms) = (60_000, 60_000);
}

/// Some robots fail for good, as many others in part; whoever gives tasks out fails now and then.
fn faults(options: &FleetOptions, robots: usize, horizon: u64, streams: Streams) -> Vec<Fault> {
    let mut all = failures(robots, options.failures, horizon, &mut streams.stream("fleet faults"));
    let mut moments = streams.stream("fleet auctioneers");
    let laptop = Row::named(usual().robot(), "PWR1").filter(|_| options.takeover);
    let kill = |row| Fault {
        when: FaultTime::At(moments.below(horizon + 1)),
        what: FaultKind::Auctioneer(row),
    };
    all.extend(laptop.into_iter().cycle().take(options.kills).map(kill));
    all
}

fn failures(robots: usize, failures: usize, horizon: u64, stream: &mut Stream) -> Vec<Fault> {
    let mut order: Vec<usize> = (0..robots).collect();
    for at in (1..robots).rev() {
        order.swap(at, stream.below(at as u64 + 1) as usize);
    }
    let modes = [&STOPS[..], &LESSER[..]];
    let each = order.iter().take(2 * failures).enumerate().filter_map(|(number, &robot)| {
        let modes = modes[usize::from(number >= failures)];
        let mode = modes[stream.below(modes.len() as u64) as usize];
        let when = FaultTime::At(stream.below(horizon + 1));
        Some(Fault { when, what: FaultKind::Robot(robot, Row::named(usual().robot(), mode)?) })
    });
    each.collect()
}

/// The office on its floor, which only draws it.
static OFFICE: LazyLock<Floor> = LazyLock::new(|| floors::drawn(office(), "fleet"));

/// Two corridors of 72 m, joined at both ends and in the middle, with an office on each side of
/// each corridor node.
fn office() -> Floor {
    let corridor = |it: usize| format!("{}{}", ["A", "B"][it / NODES], it % NODES + 1);
    let mut names: Vec<String> = (0..2 * NODES).map(corridor).collect();
    for it in 0..4 * NODES {
        names.push(format!("{}{}", corridor(it / 2), ["l", "r"][it % 2]));
    }
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let along = (0..2 * NODES - 1).filter(|it| it % NODES != NODES - 1);
    let along = along.map(|it| (it, it + 1, 6_000));
    let across = [0, NODES / 2, NODES - 1].map(|it| (it, it + NODES, 12_000));
    let doors = (0..4 * NODES).map(|it| (it / 2, 2 * NODES + it, 3_000));
    let ways: Vec<_> = along.chain(across).chain(doors).collect();
    Floor::new(&names, &ways)
}

/// A delivery from one office to another.
fn delivery(number: usize, arrival_ms: u64, start: usize, goal: usize) -> TaskSpec {
    let secured = |office: usize| office / 2 >= NODES + SECURED;
    let place = |office: usize| Place(2 * NODES + office);
    // Just outside of the secured wing.
    let door = Place(NODES + SECURED - 1);
    // One action stands for all, as they need the same.
    let role = |needs: &[Capability], take: Take, give: Give| RoleSpec {
        name: "carry".into(),
        actions: vec![Needs::all(needs)],
        take,
        give,
        take_ms: 5_000,
        give_ms: 5_000,
    };
    let alone = |needs: &[Capability]| PlanSpec {
        name: "carry".into(),
        extra_ms: 0,
        roles: vec![role(needs, Take::Object, Give::Goal)],
    };
    let plans = match (secured(start), secured(goal)) {
        (false, false) => vec![alone(&ANYBODY)],
        (false, true) => vec![
            alone(&WITH_BADGE),
            PlanSpec {
                name: "hand over".into(),
                extra_ms: 0,
                roles: vec![
                    role(&ANYBODY, Take::Object, Give::Partner(door)),
                    role(&WITH_BADGE, Take::Partner(door), Give::Goal),
                ],
            },
        ],
        _ => vec![alone(&WITH_BADGE)],
    };
    TaskSpec {
        name: format!("d{:03}", number + 1),
        arrival_ms,
        after: None,
        start: place(start),
        goal: place(goal),
        utility_ms: 1_800_000,
        combine: Combine::Sum,
        plans,
    }
}

/// The drink service.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ServiceOptions {
    /// The cup stands so that two fingers cannot grasp it: run 1 of the thesis (3.6.2).
    pub hidden_handle: bool,
    /// The three disturbances of run 2.
    pub disturbances: bool,
    /// How many of a thousand messages get lost.
    pub loss_permille: u16,
    /// The seed of the network.
    pub seed: u64,
}

/// The service on its floor, which only draws it.
static SERVICE: LazyLock<Scenario> = LazyLock::new(|| {
    let it = scenario::service().expect("it is shipped");
    Scenario { floor: floors::drawn(it.floor, "service"), ..it }
});

/// The drink service (3.6): a person orders at the desk; a cup in the kitchen is to be served.
/// The file is `models/teams/service.toml`; speeds are those of the delivery robot.
///
/// ```
/// use cotama_sim::fleet::{record::Fate, run, scenarios::{ServiceOptions, service}};
/// let run = run(&service(&ServiceOptions { disturbances: true, ..ServiceOptions::default() }));
/// assert_eq!((run.rounds, run.count(Fate::Done), run.awards), (4, 2, vec![1, 3]));
/// ```
///
/// # Panics
/// Never: the file is shipped, and a test reads it.
pub fn service(options: &ServiceOptions) -> Scenario {
    let mut scenario = SERVICE.clone();
    if !options.disturbances {
        scenario.faults.clear();
    }
    if options.hidden_handle {
        let hides = CapabilitySet::of(&[GRASP_2F]);
        scenario.faults.push(Fault { when: FaultTime::At(0), what: FaultKind::Turned(1, hides) });
    }
    scenario.network.loss_permille = options.loss_permille;
    Scenario { seed: options.seed, ..scenario }
}

/// The scenario on which the table of messages is counted (Table 3.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Worst {
    /// As many tasks of one robot as robots.
    Singles,
    /// One task for all robots at once.
    Together,
    /// The same, where brokers look for the coalition.
    TogetherDistributed,
}

/// The worst case of a round for so many robots, over a perfect network.
///
/// ```
/// use cotama_sim::fleet::{Kind, run, scenarios::{Worst, worst}};
/// let run = run(&worst(Worst::Together, 4));
/// assert_eq!([Kind::Announce, Kind::Bid, Kind::Assign, Kind::Ack].map(|it| run.sent(it)), [
///     4, 4, 4, 16
/// ]);
/// ```
pub fn worst(case: Worst, robots: usize) -> Scenario {
    let names: Vec<String> = (0..=robots).map(|it| it.to_string()).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let ways: Vec<_> = (1..=robots).map(|it| (0, it, 3_000)).collect();
    let role = |place: usize| RoleSpec {
        name: "carry".into(),
        actions: vec![Needs::all(&[MOVE, GRASP_2F])],
        take: Take::Words(Place(place)),
        give: Give::Nobody,
        take_ms: 1_000,
        give_ms: 0,
    };
    let task = |number: usize, roles: Vec<RoleSpec>| TaskSpec {
        name: format!("t{}", number + 1),
        arrival_ms: 0,
        after: None,
        start: Place(0),
        goal: Place(0),
        utility_ms: 1_000_000,
        combine: Combine::Mean,
        plans: vec![PlanSpec { name: "go".into(), extra_ms: 0, roles }],
    };
    let tasks = match case {
        Worst::Singles => (0..robots).map(|it| task(it, vec![role(it + 1)])).collect(),
        _ => vec![task(0, (1..=robots).map(role).collect())],
    };
    let robot = |number: usize| RobotSpec {
        name: format!("r{}", number + 1),
        file: usual(),
        skills: vec![Skill::certain(MOVE), Skill::certain(GRASP_2F)],
        fails: FailureRates::NONE,
        start: Place(0),
        stay: Stay::default(),
        supply: None,
    };
    Scenario {
        name: "worst case of a round".into(),
        skills: skills(),
        floor: Floor::new(&names, &ways),
        crowds: Vec::new(),
        robots: (0..robots).map(robot).collect(),
        tasks,
        faults: Vec::new(),
        network: Quality::PERFECT,
        method: Method::Optimal,
        formation: match case {
            Worst::TogetherDistributed => Formation::Distributed,
            _ => Formation::Central,
        },
        auctioneer: Seat::Desk,
        slack_permille: 1_000,
        second_best: false,
        trust: Trust::default(),
        travel: Travel::Plain,
        seed: 0,
    }
}
