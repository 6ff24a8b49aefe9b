//! The faults of one run of a campaign: a list, as data.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::Definition;
use cotama_models::missions::faults::{Event, EventKind, Faults, PowerError};
use cotama_models::robots::{self as row, Moment};
use cotama_models::team::scenario::{self, FaultKind};
use cotama_sim::faults_text::faults_text;
use cotama_sim::robots;

/// The faults of one run.
///
/// A plan is data: it is drawn, mutated, shrunk and printed, and a run is a function of it. As a
/// `panorama-faults/1` file it is read back by `cotama run` and `cotama replay`.
///
/// ```
/// use cotama_core::units::Millimetres;
/// use cotama_models::missions::{Mission, embedded, faults::Faults};
/// use cotama_models::robots::Moment;
/// use cotama_campaign::plan::{Fault, Plan};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let silent = mission.robot().unwrap().robot().failure("SON2").unwrap();
/// let lost = Fault::failure(Moment::Place(Millimetres(5_000)), silent);
/// let plan = Plan { faults: vec![lost] };
/// let text = plan.to_toml(&mission);
/// assert!(text.contains("x_mm = 5000\nkind = \"failure\"\nmode = \"SON2\""));
/// let read = Faults::parse("plan.toml", &text, &mission).unwrap();
/// assert_eq!(Plan::from(&read), plan);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// The faults; their order changes nothing where they differ in their moments.
    pub faults: Vec<Fault>,
}

/// One thing that goes wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A failure of the robot's file, in a mission under its supervisors.
    Failure(robots::Injection),
    /// The answers of the operator to the first request from a place on.
    Operator(robots::Answers),
    /// Something that happens at a place of a mission that is run by its plans alone.
    Event(Event),
    /// Real power differs from the modelled one in a zone of such a mission.
    Power(PowerError),
    /// Something that goes wrong in a team.
    Team(scenario::Fault),
}

impl Fault {
    /// A failure of the robot's file, by its number, that ends by itself or never.
    pub const fn failure(when: Moment, failure: usize) -> Self {
        Self::Failure(robots::Injection::new(when, failure))
    }

    /// Returns the name of the fault without its moment: two plans with the same cause share it.
    pub fn name(&self) -> String {
        match self {
            Self::Operator(_) => "operator".to_owned(),
            Self::Failure(it) => format!("failure {}", it.failure),
            Self::Event(it) => match it.kind {
                EventKind::Obstacle { .. } => "obstacle".to_owned(),
                EventKind::Odometry { .. } => "odometry".to_owned(),
                EventKind::Fault { hardware, units } => format!("hardware {hardware}:{units} lost"),
                EventKind::Repair { hardware, units } => {
                    format!("hardware {hardware}:{units} back")
                }
            },
            Self::Power(it) => format!("power in zone {}", it.zone),
            Self::Team(it) => match it.what {
                FaultKind::Robot(_, mode) | FaultKind::Auctioneer(mode) => {
                    format!("failure {}", mode.number())
                }
                FaultKind::Shifted(_) => "an object shifted".to_owned(),
                FaultKind::Turned(..) => "an object turned".to_owned(),
            },
        }
    }
}

impl From<&Faults> for Plan {
    /// Returns the faults of a file, less its random events, which are drawn by each run.
    fn from(faults: &Faults) -> Self {
        let script = robots::Script::from(&faults.of_robot[..]);
        let failures = script.injections.into_iter().map(Fault::Failure);
        let answers = script.answers.into_iter().map(Fault::Operator);
        let events = faults.events.iter().copied().map(Fault::Event);
        let powers = faults.power_errors.iter().copied().map(Fault::Power);
        let all = failures.chain(answers).chain(events).chain(powers);
        Self { faults: all.collect() }
    }
}

impl From<&Plan> for Faults {
    fn from(plan: &Plan) -> Self {
        let mut faults = Self::default();
        for fault in &plan.faults {
            match fault {
                Fault::Event(it) => faults.events.push(*it),
                // A file names each zone once; errors of one zone add up, as those of zones that
                // overlap do.
                Fault::Power(it) => {
                    match faults.power_errors.iter_mut().find(|o| o.zone == it.zone) {
                        Some(other) => {
                            let sum = other.permille.saturating_add(it.permille);
                            other.permille = sum.clamp(-999, 10_000);
                        }
                        None => faults.power_errors.push(*it),
                    }
                }
                Fault::Failure(robots::Injection { when, failure, until }) => {
                    let kind = row::IncidentKind::Failure { failure: *failure, until: *until };
                    faults.of_robot.push(row::Incident { when: *when, kind });
                }
                Fault::Operator(it) => {
                    let (answers, delay) = (it.answers.iter().copied().collect(), it.delay);
                    let kind = row::IncidentKind::Operator { answers, delay };
                    faults.of_robot.push(row::Incident { when: Moment::Place(it.x), kind });
                }
                // No mission has one.
                Fault::Team(_) => {}
            }
        }
        // As a file is read, so that a plan is run as its file is.
        faults.events.sort_by_key(|it| it.x);
        faults.of_robot.sort_by_key(|it| it.when);
        faults
    }
}

impl Plan {
    /// Whether all its places lie on a path of this length.
    pub fn is_within(&self, path: Millimetres) -> bool {
        let on_path = |when| !matches!(when, Moment::Place(x) if x > path);
        self.faults.iter().all(|it| match it {
            Fault::Operator(it) => it.x <= path,
            Fault::Event(it) => it.x <= path,
            Fault::Failure(it) => on_path(it.when) && it.until.is_none_or(on_path),
            Fault::Power(_) | Fault::Team(_) => true,
        })
    }

    /// The faults of a team in it.
    pub fn of_team(&self) -> Vec<scenario::Fault> {
        let team = self.faults.iter().filter_map(|it| match it {
            Fault::Team(it) => Some(*it),
            _ => None,
        });
        team.collect()
    }

    /// As the text of a `panorama-faults/1` file.
    pub fn to_toml(&self, mission: &Definition) -> String {
        faults_text(&Faults::from(self), mission)
    }

    /// As a `panorama-faults/1` file with a line for each fault.
    pub fn compact(&self, mission: &Definition) -> String {
        let text = self.to_toml(mission);
        let (head, events) =
            text.split_once("\n[[event]]\n").map_or((text.as_str(), None), |it| (it.0, Some(it.1)));
        let Some(events) = events else { return head.to_owned() };
        let lines = events.split("\n[[event]]\n").map(|it| {
            let keys: Vec<_> = it.lines().filter(|it| !it.is_empty()).collect();
            format!("  {{ {} }},\n", keys.join(", "))
        });
        format!("{head}event = [\n{}]\n", lines.collect::<String>())
    }

    /// The names of its faults, sorted, each once: the signature of its cause.
    pub fn signature(&self) -> String {
        self.signature_by(Fault::name)
    }

    /// The signature with failures of a team's robots by their short names.
    pub fn signature_in(&self, team: &scenario::Scenario) -> String {
        let name = |robot: usize, row: scenario::Row| {
            Some(row.name(team.robots.get(robot)?.file.robot()).to_owned())
        };
        self.signature_by(|fault| {
            let named = match fault {
                Fault::Team(it) => match it.what {
                    FaultKind::Robot(robot, row) => name(robot, row),
                    FaultKind::Auctioneer(row) => name(0, row),
                    FaultKind::Shifted(_) | FaultKind::Turned(..) => None,
                },
                _ => None,
            };
            named.unwrap_or_else(|| fault.name())
        })
    }

    fn signature_by(&self, name: impl Fn(&Fault) -> String) -> String {
        let mut names: Vec<_> = self.faults.iter().map(name).collect();
        names.sort();
        names.dedup();
        if names.is_empty() { "nothing fails".to_owned() } else { names.join(" + ") }
    }

    /// The signature with the hardware and zones of a mission by their names.
    pub fn named_signature(&self, mission: &Definition) -> String {
        let name = |fault: &Fault| match fault {
            Fault::Event(Event { kind, .. }) => match kind {
                EventKind::Fault { hardware, units } | EventKind::Repair { hardware, units } => {
                    let kinds = mission.hardware.get(*hardware);
                    let what = kinds.map_or("hardware", |it| it.name.as_str());
                    let lost = matches!(kind, EventKind::Fault { .. });
                    format!("{units} {what} {}", if lost { "lost" } else { "back" })
                }
                _ => fault.name(),
            },
            Fault::Power(it) => {
                let zone = mission.zones.get(it.zone).map_or("a zone", |it| it.id.as_str());
                format!("power in {zone}")
            }
            Fault::Failure(it) => {
                let robot = mission.under.as_ref().map(|it| it.file.robot());
                let row = robot.and_then(|robot| robot.failures.get(it.failure));
                row.map_or_else(|| fault.name(), |it| it.id.clone())
            }
            _ => fault.name(),
        };
        self.signature_by(name)
    }
}

/// A place of the path in whole mm, as a moment.
pub(super) const fn place(x_mm: u64) -> Moment {
    Moment::Place(Millimetres(x_mm))
}

/// A time after the start in ms, as a moment.
pub(super) const fn at(t_ms: u64) -> Moment {
    Moment::At(Millis(t_ms))
}
