//! The possible faults of a mission, their weights and moments: the space that every strategy draws
//! from.

use crate::plan::{Fault, Plan, at, place};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{FailureMode, Module, local};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Answer, Event, EventKind, Moment, PowerError};
use cotama_models::robots as row;
use cotama_models::team::scenario::{self, FaultKind, FaultTime, Scenario};
use cotama_sim::fleet;
use cotama_sim::robots;
use cotama_sim::streams::Stream;
use cotama_sim::supervised::{Answers, PERIOD, Script, Supervised, When};

/// The possible faults of a mission.
///
/// ```
/// use cotama_models::cotama::FailureMode;
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::space::{Rates, Space};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let space = Space::of(&mission, Rates::Even, 1..=3);
/// assert_eq!(space.kinds.len(), FailureMode::ALL.len());
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Space {
    /// The kinds of faults, each with its weight.
    pub kinds: Vec<Weighted>,
    /// The fewest faults of a plan.
    pub least: u64,
    /// The most faults of a plan.
    pub most: u64,
    /// End of the path, in mm.
    pub path_mm: u64,
    /// Times are drawn below this, in ms.
    pub time_ms: u64,
    /// Whether supervisors decide: then a moment can be a time, or a place of the local one.
    pub supervised: bool,
    /// Whether a moment is a time, and nothing else: of a team.
    pub timed: bool,
    /// The sub-objectives of a mission whose robot has a file of its own, each with whether it is
    /// the operator's; empty for other missions.
    pub parts: Vec<bool>,
    /// When supervisors act if nothing fails, in ms, each once, in order.
    pub acts_ms: Vec<u64>,
}

/// A kind of fault and how likely it is.
///
/// ```
/// use cotama_models::cotama::FailureMode;
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::space::{Kind, Rates, Space, Weighted};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// // Nothing but sonars fails, one of them three times as often as the other.
/// let of = |mode, weight| Weighted { kind: Kind::Failure(mode), weight };
/// let kinds = vec![of(FailureMode::Son1, 3), of(FailureMode::Son2, 1)];
/// let space = Space { kinds, ..Space::of(&mission, Rates::Even, 1..=2) };
/// assert_eq!(space.kinds[0].weight, 3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Weighted {
    /// The kind of fault.
    pub kind: Kind,
    /// How likely it is drawn, among the weights of all.
    pub weight: u64,
}

/// A kind of fault, with the range of its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A row of the FMECA; of a row about one module, whichever it is, the module is drawn too.
    Failure(FailureMode),
    /// A failure of a robot's file, by its number.
    Row(usize),
    /// An obstacle, for 1 to 60 s (assumed).
    Obstacle,
    /// So much more path to drive, 0.1 to 5 m (assumed).
    Odometry,
    /// So many units of hardware fail.
    Hardware {
        /// The index of the hardware.
        hardware: usize,
        /// Number of units.
        units: u8,
    },
    /// Power in a zone, from −10 % to +30 % of the modelled one (assumed).
    Power {
        /// The index of the zone.
        zone: usize,
    },
    /// A row of the FMECA, on a robot of a team.
    Robot {
        /// The index of the robot.
        robot: usize,
        /// The row.
        mode: FailureMode,
    },
    /// The object of a team's task moves under the hand.
    Shifted {
        /// The index of the task.
        task: usize,
    },
}

/// How kinds of faults are weighted.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::space::{Rates, Space};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let weights = |rates| {
///     let space = Space::of(&mission, rates, 1..=1);
///     space.kinds.iter().map(|it| it.weight).collect::<std::collections::BTreeSet<_>>()
/// };
/// assert_eq!(weights(Rates::Even).len(), 1);
/// assert!(weights(Rates::Fmeca).len() > 5);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rates {
    /// Each kind is as likely as each other: what searches well.
    #[default]
    Even,
    /// By the mean times between failures of the FMECA, most of which are assumed: what estimates.
    Fmeca,
}

impl Rates {
    /// Returns the weight of a row of the FMECA.
    fn weight(self, mode: FailureMode) -> u64 {
        match self {
            Self::Even => 1,
            Self::Fmeca => (LONGEST_MTBF_MH / u64::from(mode.description().mtbf_mh).max(1)).max(1),
        }
    }

    /// Returns the name: `even`, `fmeca`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Even => "even",
            Self::Fmeca => "fmeca",
        }
    }
}

/// The places of the local supervisor at which something may be drawn to fail.
const STATES: [local::State; 5] = [
    local::State::Planning,
    local::State::Following,
    local::State::HandOver,
    local::State::Teleprogrammed,
    local::State::Teleoperated,
];
/// Answers of the operator, those to a request first.
const ANSWERS: [Answer; 6] = [
    Answer::Teleoperate,
    Answer::Teleprogram,
    Answer::GiveUp,
    Answer::Waypoints,
    Answer::Path,
    Answer::Goal,
];
const TO_A_REQUEST: u64 = 3;
/// A mean time between failures of 10 million hours has weight 1.
const LONGEST_MTBF_MH: u64 = 10_000_000_000;

impl Space {
    /// Returns the space of this mission: under supervisors every row of the FMECA, else obstacles,
    /// wrong odometry, lost hardware, and power that differs by zone.
    pub fn of(mission: &Mission, rates: Rates, faults: std::ops::RangeInclusive<u64>) -> Self {
        if let Some(robot) = mission.robot() {
            return Self::of_robot(mission, robot.robot(), rates, faults);
        }
        let supervised = mission.supervisor().is_some();
        let kinds = if supervised {
            let one =
                |it: &FailureMode| Weighted { kind: Kind::Failure(*it), weight: rates.weight(*it) };
            FailureMode::ALL.iter().map(one).collect()
        } else {
            let hardware = mission.hardware.iter().enumerate().flat_map(|(hardware, it)| {
                (1..=it.units).map(move |units| Kind::Hardware { hardware, units })
            });
            let zones = (0..mission.zones.len()).map(|zone| Kind::Power { zone });
            let kinds = [Kind::Obstacle, Kind::Odometry].into_iter().chain(hardware).chain(zones);
            kinds.map(|kind| Weighted { kind, weight: 1 }).collect()
        };
        let undisturbed = || Supervised::new(mission).ok()?.run(&Script::default()).ok();
        let fired = undisturbed().map_or_else(Vec::new, |it| it.fired);
        let mut acts_ms: Vec<u64> = fired.iter().map(|it| it.at.0).collect();
        acts_ms.dedup();
        let (path_mm, limit) = (mission.path_length.0, mission.limits[0]);
        let (least, most) = (*faults.start(), (*faults.end()).max(*faults.start()));
        let time_ms = (limit / 2).max(1);
        let (timed, parts) = (false, Vec::new());
        Self { kinds, least, most, path_mm, time_ms, supervised, timed, parts, acts_ms }
    }

    /// Returns the space of a mission whose robot has a file: every failure of it.
    fn of_robot(
        mission: &Mission,
        robot: &row::Robot,
        rates: Rates,
        faults: std::ops::RangeInclusive<u64>,
    ) -> Self {
        let weight = |it: &row::Failure| match rates {
            Rates::Even => 1,
            Rates::Fmeca => it.mean_mh.map_or(1, |mean| (LONGEST_MTBF_MH / mean.max(1)).max(1)),
        };
        // A failure that the planner tells does not happen by itself.
        let kinds = robot.failures.iter().enumerate().filter(|it| !it.1.no_plan);
        let one = |(at, it)| Weighted { kind: Kind::Row(at), weight: weight(it) };
        let operators = |it: &row::SubObjective| it.mode == row::Mode::Operator;
        Self {
            kinds: kinds.map(one).collect(),
            least: *faults.start(),
            most: (*faults.end()).max(*faults.start()),
            path_mm: mission.path_length.0,
            time_ms: (mission.limits[0] / 2).max(1),
            supervised: false,
            timed: false,
            parts: robot.sub_objectives.iter().map(operators).collect(),
            acts_ms: Vec::new(),
        }
    }

    /// Returns the space of this team: every row of the FMECA on every robot, and objects that are
    /// shifted, at any time of a run in which nothing fails.
    ///
    /// ```
    /// use cotama_models::cotama::FailureMode;
    /// use cotama_models::team::scenario::service;
    /// use cotama_campaign::space::{Rates, Space};
    /// let space = Space::of_team(&service().unwrap(), Rates::Even, 1..=2);
    /// assert_eq!(space.kinds.len(), 4 * FailureMode::ALL.len() + 2);
    /// ```
    pub fn of_team(team: &Scenario, rates: Rates, faults: std::ops::RangeInclusive<u64>) -> Self {
        let undisturbed = fleet::run(&Scenario { faults: Vec::new(), ..team.clone() });
        let rows = (0..team.robots.len())
            .flat_map(|robot| FailureMode::ALL.iter().map(move |&mode| (robot, mode)));
        let rows = rows.map(|(robot, mode)| Weighted {
            kind: Kind::Robot { robot, mode },
            weight: rates.weight(mode),
        });
        let objects =
            (0..team.tasks.len()).map(|task| Weighted { kind: Kind::Shifted { task }, weight: 1 });
        Self {
            kinds: rows.chain(objects).collect(),
            least: *faults.start(),
            most: (*faults.end()).max(*faults.start()),
            path_mm: 0,
            time_ms: undisturbed.end_ms.max(1),
            supervised: false,
            timed: true,
            parts: Vec::new(),
            acts_ms: Vec::new(),
        }
    }

    /// Draws a plan of these kinds.
    pub fn draw(&self, stream: &mut Stream, kinds: &[Weighted]) -> Plan {
        let count = self.least + stream.below(self.most - self.least + 1);
        Plan { faults: (0..count).map(|_| self.fault(stream, kinds)).collect() }
    }

    /// Draws one fault.
    pub fn fault(&self, stream: &mut Stream, kinds: &[Weighted]) -> Fault {
        let all: u64 = kinds.iter().map(|it| it.weight).sum();
        let mut left = stream.below(all);
        let chosen = kinds.iter().find(|it| {
            let found = left < it.weight;
            left = left.saturating_sub(it.weight);
            found
        });
        let kind = chosen.map_or(Kind::Obstacle, |it| it.kind);
        let when = self.moment(stream);
        self.with(kind, when, stream)
    }

    /// A fault of this kind at this moment; its parameters are drawn.
    pub fn with(&self, kind: Kind, when: When, stream: &mut Stream) -> Fault {
        let x = if let Moment::Place(x) = when { x } else { Millimetres(0) };
        let event = |kind| Fault::Event(Event { x, kind });
        match kind {
            Kind::Failure(mode) => {
                let part = mode.rule().one_module.then(|| self.part(stream));
                let until = (stream.below(4) == 0).then(|| self.end(when, stream));
                Fault::Failure { when, mode, part, until }
            }
            Kind::Row(failure) => {
                let when = match when {
                    When::Place(x) => row::Moment::Place(x),
                    When::At(at) => row::Moment::At(at),
                    When::During(..) | When::Fired(..) => self.row_moment(stream),
                };
                let when = if stream.below(3) == 0 { self.row_moment(stream) } else { when };
                let until = (stream.below(4) == 0).then(|| row_end(when, self.path_mm, stream));
                Fault::Row(robots::Injection { when, failure, until })
            }
            Kind::Obstacle => {
                event(EventKind::Obstacle { delay: Millis(1_000 * (1 + stream.below(60))) })
            }
            Kind::Odometry => {
                event(EventKind::Odometry { extra: Millimetres(100 * (1 + stream.below(50))) })
            }
            Kind::Hardware { hardware, units } => event(EventKind::Fault { hardware, units }),
            Kind::Power { zone } => {
                let permille = i32::try_from(stream.below(401)).unwrap_or(0) - 100;
                Fault::Power(PowerError { zone, permille })
            }
            Kind::Robot { robot, mode } => of_team(when, FaultKind::Robot(robot, mode)),
            Kind::Shifted { task } => of_team(when, FaultKind::Shifted(task)),
        }
    }

    /// Draws a module.
    pub fn part(&self, stream: &mut Stream) -> Module {
        Module::ALL[stream.below(Module::ALL.len() as u64) as usize]
    }

    /// Draws a moment: a place of the path, and under supervisors as often a time, or a place of
    /// the local supervisor.
    pub fn moment(&self, stream: &mut Stream) -> When {
        if self.timed {
            return at(stream.below(self.time_ms));
        }
        if !self.supervised {
            return place(stream.below(self.path_mm + 1));
        }
        match stream.below(3) {
            0 => at(stream.below(self.time_ms)),
            1 => place(stream.below(self.path_mm + 1)),
            _ => {
                let state = STATES[stream.below(STATES.len() as u64) as usize];
                When::During(state, Millis(stream.below(20_000)))
            }
        }
    }

    /// Draws a moment for a failure of a robot's file: a place of its drive, a time, or a place of
    /// the path, as often each.
    pub fn row_moment(&self, stream: &mut Stream) -> row::Moment {
        let after = Millis(stream.below(20_000));
        match stream.below(3) {
            0 => row::Moment::At(Millis(stream.below(self.time_ms))),
            1 => row::Moment::Place(Millimetres(stream.below(self.path_mm + 1))),
            _ => {
                let part = stream.below(self.parts.len() as u64 + 1) as usize;
                let waits = part == self.parts.len();
                if waits { row::Moment::Waiting(after) } else { row::Moment::During(part, after) }
            }
        }
    }

    /// A moment from which on a failure is seen in one of four rounds: that in which a supervisor
    /// acts if nothing fails, or the three before. None where no supervisor acts.
    pub fn race(&self, mode: FailureMode, stream: &mut Stream) -> Option<When> {
        let count = self.acts_ms.len() as u64;
        let act = *self.acts_ms.get(stream.below(count.max(1)) as usize)?;
        // The failure is seen in the last period of its latency.
        let latency = u64::from(mode.rule().latency_ms).saturating_sub(PERIOD.0);
        Some(at(act.saturating_sub(latency + PERIOD.0 * stream.below(4))))
    }

    /// An operator who does not answer as he usually does: what can be said to a request, and
    /// sometimes something more, each after up to 20 s (assumed), from some place on.
    pub fn answers(&self, stream: &mut Stream) -> Fault {
        if !self.parts.is_empty() {
            return self.replies(stream);
        }
        let x = Millimetres(stream.below(self.path_mm + 1) * stream.below(2));
        let answer = |stream: &mut Stream| ANSWERS[stream.below(ANSWERS.len() as u64) as usize];
        let first = ANSWERS[stream.below(TO_A_REQUEST) as usize];
        let more = stream.below(2);
        let answers = std::iter::once(first).chain((0..more).map(|_| answer(stream))).collect();
        Fault::Operator(Answers { x, answers, delay: Millis(1_000 * stream.below(21)) })
    }

    /// The same of the operator of a robot that has a file.
    fn replies(&self, stream: &mut Stream) -> Fault {
        let x = Millimetres(stream.below(self.path_mm + 1) * stream.below(2));
        let his: Vec<_> = (0..self.parts.len()).filter(|it| self.parts[*it]).collect();
        let chosen = (0..=stream.below(2)).filter(|_| !his.is_empty());
        let chosen = chosen.map(|_| stream.below(his.len().max(1) as u64) as usize);
        let chosen: Vec<_> = chosen.map(|it| row::Answer::Chooses(his[it])).collect();
        let last = if chosen.is_empty() || stream.below(4) == 0 {
            row::Answer::GivesUp
        } else {
            row::Answer::Done
        };
        let answers = chosen.into_iter().chain([last]).collect();
        Fault::Replies(robots::Answers { x, answers, delay: Millis(1_000 * stream.below(21)) })
    }

    /// Draws an end for what begins at a moment.
    fn end(&self, begin: When, stream: &mut Stream) -> When {
        match begin {
            When::Place(x) => place((x.0 + 1 + stream.below(20_000)).min(self.path_mm)),
            When::At(time) => at(time.0 + 1 + stream.below(120_000)),
            When::During(state, after) => {
                When::During(state, Millis(after.0 + 1 + stream.below(60_000)))
            }
            When::Fired(act, after) => When::Fired(act, Millis(after.0 + 1 + stream.below(60_000))),
        }
    }

    /// The moments of an abstract timeline: four places of the path, and under supervisors half a
    /// second after each place of the local one is first reached.
    pub fn timeline(&self) -> Vec<When> {
        let shares = [5, 30, 55, 80];
        if self.timed {
            return shares.map(|percent| at(self.time_ms * percent / 100)).to_vec();
        }
        let places = shares.map(|percent| place(self.path_mm * percent / 100));
        let states = STATES.map(|state| When::During(state, Millis(500)));
        let states = states.into_iter().filter(|_| self.supervised);
        places.into_iter().chain(states).collect()
    }
}

/// Draws an end for what begins at a moment.
fn row_end(begin: row::Moment, path_mm: u64, stream: &mut Stream) -> row::Moment {
    match begin {
        row::Moment::Place(x) => {
            row::Moment::Place(Millimetres((x.0 + 1 + stream.below(20_000)).min(path_mm)))
        }
        row::Moment::At(time) => row::Moment::At(Millis(time.0 + 1 + stream.below(120_000))),
        row::Moment::During(part, after) => {
            row::Moment::During(part, Millis(after.0 + 1 + stream.below(60_000)))
        }
        row::Moment::Waiting(after) => {
            row::Moment::Waiting(Millis(after.0 + 1 + stream.below(60_000)))
        }
    }
}

/// A fault of a team at a time.
fn of_team(when: When, what: FaultKind) -> Fault {
    let at = if let When::At(it) = when { it.0 } else { 0 };
    Fault::Team(scenario::Fault { when: FaultTime::At(at), what })
}
