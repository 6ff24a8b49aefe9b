//! The possible faults of a mission, their weights and moments: the space that every strategy draws
//! from.

use crate::plan::{Fault, Plan, at, place};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Mission;
use cotama_models::missions::faults::{Event, EventKind, PowerError};
use cotama_models::robots::{self as row, Moment};
use cotama_models::team::scenario::{self, FaultKind, FaultTime, Row, Scenario};
use cotama_sim::fleet;
use cotama_sim::robots::{self, Driven, Script};
use cotama_sim::streams::Stream;

/// The possible faults of a mission.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::space::{Rates, Space};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let space = Space::of(&mission, Rates::Even, 1..=3);
/// // All of the file but that no plan is left: this happens by no fault.
/// let failures = &mission.robot().unwrap().robot().failures;
/// assert_eq!(space.kinds.len(), failures.iter().filter(|it| !it.no_plan).count());
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
    /// Whether a moment is a time, and nothing else: of a team.
    pub timed: bool,
    /// The sub-objectives of a mission under supervisors, each with whether it is the operator's;
    /// empty for other missions.
    pub parts: Vec<bool>,
    /// When supervisors act if nothing fails, in ms, each once, in order.
    pub acts_ms: Vec<u64>,
    /// The period of the rounds of supervisors, in ms.
    pub period_ms: u64,
    /// How long after each failure of the robot's file its flags are up, in ms.
    pub latencies_ms: Vec<u64>,
}

/// A kind of fault and how likely it is.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::space::{Kind, Rates, Space, Weighted};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// // Nothing but sonars fails, one of them three times as often as the other.
/// let robot = mission.robot().unwrap().robot();
/// let of = |id, weight| Weighted { kind: Kind::Failure(robot.failure(id).unwrap()), weight };
/// let kinds = vec![of("SON1", 3), of("SON2", 1)];
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
    /// A failure of the robot's file, by its number.
    Failure(usize),
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
    /// A row of the robot's file, on a robot of a team.
    Robot {
        /// The index of the robot.
        robot: usize,
        /// The row.
        mode: Row,
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
    /// Nothing but what wears on any day: obstacles, wrong odometry, power that differs by zone. Of
    /// missions without supervisors.
    Drift,
}

impl Rates {
    /// Returns the weight of a failure with this mean time between two of them, in thousandths of
    /// an hour.
    fn weight(self, mean_mh: Option<u64>) -> u64 {
        match self {
            Self::Even | Self::Drift => 1,
            Self::Fmeca => mean_mh.map_or(1, |mean| (LONGEST_MTBF_MH / mean.max(1)).max(1)),
        }
    }

    /// All, in the order of their names in help.
    pub const ALL: [Self; 3] = [Self::Even, Self::Fmeca, Self::Drift];

    /// Returns the name: `even`, `fmeca`, `drift`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Even => "even",
            Self::Fmeca => "fmeca",
            Self::Drift => "drift",
        }
    }
}

/// A mean time between failures of 10 million hours has weight 1.
const LONGEST_MTBF_MH: u64 = 10_000_000_000;

impl Space {
    /// Returns the space of this mission: under supervisors every failure of the robot's file, else
    /// obstacles, wrong odometry, lost hardware, and power that differs by zone.
    pub fn of(mission: &Mission, rates: Rates, faults: std::ops::RangeInclusive<u64>) -> Self {
        if let Some(robot) = mission.robot() {
            return Self::of_robot(mission, robot.robot(), rates, faults);
        }
        let hardware = mission.hardware.iter().enumerate().flat_map(|(hardware, it)| {
            (1..=it.units).map(move |units| Kind::Hardware { hardware, units })
        });
        let zones = (0..mission.zones.len()).map(|zone| Kind::Power { zone });
        let hardware = hardware.filter(|_| rates != Rates::Drift);
        let kinds = [Kind::Obstacle, Kind::Odometry].into_iter().chain(hardware).chain(zones);
        Self {
            kinds: kinds.map(|kind| Weighted { kind, weight: 1 }).collect(),
            path_mm: mission.path_length.0,
            time_ms: (mission.limits[0] / 2).max(1),
            ..Self::empty(faults)
        }
    }

    fn empty(faults: std::ops::RangeInclusive<u64>) -> Self {
        Self {
            kinds: Vec::new(),
            least: *faults.start(),
            most: (*faults.end()).max(*faults.start()),
            path_mm: 0,
            time_ms: 1,
            timed: false,
            parts: Vec::new(),
            acts_ms: Vec::new(),
            period_ms: 1,
            latencies_ms: Vec::new(),
        }
    }

    /// Returns the space of a mission whose robot has a file: every failure of it.
    fn of_robot(
        mission: &Mission,
        robot: &row::Robot,
        rates: Rates,
        faults: std::ops::RangeInclusive<u64>,
    ) -> Self {
        // A failure that the planner tells does not happen by itself.
        let kinds = robot.failures.iter().enumerate().filter(|it| !it.1.no_plan);
        let one = |(at, it): (usize, &row::Failure)| Weighted {
            kind: Kind::Failure(at),
            weight: rates.weight(it.mean_mh),
        };
        let operators = |it: &row::SubObjective| it.mode == row::Mode::Operator;
        let period_ms = robot.body.as_ref().map_or(1, |it| it.period.0.max(1));
        let undisturbed = || Driven::new(mission).ok()?.run(&Script::default()).ok();
        let told = undisturbed().map_or_else(Vec::new, |it| it.told);
        Self {
            kinds: kinds.map(one).collect(),
            path_mm: mission.path_length.0,
            time_ms: (mission.limits[0] / 2).max(1),
            parts: robot.sub_objectives.iter().map(operators).collect(),
            // The first round is at the start.
            acts_ms: told.iter().map(|it| it.0.saturating_sub(1) * period_ms).collect(),
            period_ms,
            latencies_ms: robot.failures.iter().map(|it| it.latency.0).collect(),
            ..Self::empty(faults)
        }
    }

    /// Returns the space of this team: every row of its file on every robot, and objects
    /// that are shifted, at any time of a run in which nothing fails.
    ///
    /// ```
    /// use cotama_models::team::scenario::{service, usual};
    /// use cotama_campaign::space::{Rates, Space};
    /// let space = Space::of_team(&service().unwrap(), Rates::Even, 1..=2);
    /// assert_eq!(space.kinds.len(), 4 * usual().robot().failures.len() + 2);
    /// ```
    pub fn of_team(team: &Scenario, rates: Rates, faults: std::ops::RangeInclusive<u64>) -> Self {
        let undisturbed = fleet::run(&Scenario { faults: Vec::new(), ..team.clone() });
        let rows = team.robots.iter().enumerate().flat_map(|(robot, spec)| {
            let failures = spec.file.robot().failures.iter().enumerate();
            failures.map(move |(number, it)| Weighted {
                kind: Kind::Robot { robot, mode: Row::new(number) },
                weight: rates.weight(it.mean_mh),
            })
        });
        let objects =
            (0..team.tasks.len()).map(|task| Weighted { kind: Kind::Shifted { task }, weight: 1 });
        Self {
            kinds: rows.chain(objects).collect(),
            time_ms: undisturbed.end_ms.max(1),
            timed: true,
            ..Self::empty(faults)
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
    pub fn with(&self, kind: Kind, when: Moment, stream: &mut Stream) -> Fault {
        let x = if let Moment::Place(x) = when { x } else { Millimetres(0) };
        let event = |kind| Fault::Event(Event { x, kind });
        match kind {
            Kind::Failure(failure) => {
                let until = (stream.below(4) == 0).then(|| self.end(when, stream));
                Fault::Failure(robots::Injection { when, failure, until })
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

    /// Draws a moment: a place of the path, and under supervisors as often a time, or a place of
    /// the drive.
    pub fn moment(&self, stream: &mut Stream) -> Moment {
        if self.timed {
            return at(stream.below(self.time_ms));
        }
        if self.parts.is_empty() {
            return place(stream.below(self.path_mm + 1));
        }
        let after = Millis(stream.below(20_000));
        match stream.below(3) {
            0 => at(stream.below(self.time_ms)),
            1 => place(stream.below(self.path_mm + 1)),
            _ => {
                let part = stream.below(self.parts.len() as u64 + 1) as usize;
                let waits = part == self.parts.len();
                if waits { Moment::Waiting(after) } else { Moment::During(part, after) }
            }
        }
    }

    /// A moment from which on a failure is seen in one of four rounds: that in which the
    /// supervisors are told something if nothing fails, or the three before. None where they are
    /// told nothing.
    pub fn race(&self, failure: usize, stream: &mut Stream) -> Option<Moment> {
        let count = self.acts_ms.len() as u64;
        let act = *self.acts_ms.get(stream.below(count.max(1)) as usize)?;
        // The failure is seen in the last period of its latency.
        let latency = self.latencies_ms.get(failure).copied().unwrap_or(0);
        let before = latency.saturating_sub(self.period_ms) + self.period_ms * stream.below(4);
        Some(at(act.saturating_sub(before)))
    }

    /// An operator who does not answer as he usually does: what can be said to a request, and
    /// sometimes something more, each after up to 20 s (assumed), from some place on.
    pub fn answers(&self, stream: &mut Stream) -> Fault {
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
        Fault::Operator(robots::Answers { x, answers, delay: Millis(1_000 * stream.below(21)) })
    }

    /// Draws an end for what begins at a moment.
    fn end(&self, begin: Moment, stream: &mut Stream) -> Moment {
        let later =
            |it: Millis, most: u64, stream: &mut Stream| Millis(it.0 + 1 + stream.below(most));
        match begin {
            Moment::Place(x) => place((x.0 + 1 + stream.below(20_000)).min(self.path_mm)),
            Moment::At(time) => Moment::At(later(time, 120_000, stream)),
            Moment::During(part, after) => Moment::During(part, later(after, 60_000, stream)),
            Moment::Waiting(after) => Moment::Waiting(later(after, 60_000, stream)),
        }
    }

    /// The moments of an abstract timeline: four places of the path, and under supervisors half a
    /// second after each place of the drive is first reached.
    pub fn timeline(&self) -> Vec<Moment> {
        let shares = [5, 30, 55, 80];
        if self.timed {
            return shares.map(|percent| at(self.time_ms * percent / 100)).to_vec();
        }
        let places = shares.map(|percent| place(self.path_mm * percent / 100));
        let soon = Millis(500);
        let parts = (0..self.parts.len()).map(|it| Moment::During(it, soon));
        let waits = (!self.parts.is_empty()).then_some(Moment::Waiting(soon));
        places.into_iter().chain(parts).chain(waits).collect()
    }
}

/// A fault of a team at a time.
fn of_team(when: Moment, what: FaultKind) -> Fault {
    let at = if let Moment::At(it) = when { it.0 } else { 0 };
    Fault::Team(scenario::Fault { when: FaultTime::At(at), what })
}
