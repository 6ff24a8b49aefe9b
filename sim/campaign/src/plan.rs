//! The faults of one run of a campaign: a list, as data.

use cotama_core::units::{Millimetres, Millis};
use cotama_models::cotama::{FailureMode, Module};
use cotama_models::missions::Definition;
use cotama_models::missions::faults::{
    Event, EventKind, Faults, Incident, IncidentKind, PowerError,
};
use cotama_models::robots as row;
use cotama_models::team::scenario::{self, FaultKind};
use cotama_sim::faults_text::faults_text;
use cotama_sim::robots;
use cotama_sim::supervised::{Answers, Injection, Script, When};

/// The faults of one run.
///
/// A plan is data: it is drawn, mutated, shrunk and printed, and a run is a function of it. As a
/// `panorama-faults/1` file it is read back by `cotama run` and `cotama replay`.
///
/// ```
/// use cotama_core::units::Millimetres;
/// use cotama_models::cotama::FailureMode;
/// use cotama_models::missions::{Mission, embedded, faults::Faults};
/// use cotama_campaign::plan::{Fault, Plan};
/// use cotama_sim::supervised::When;
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let lost = Fault::failure(When::Place(Millimetres(5_000)), FailureMode::Son2);
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
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::cotama::{FailureMode, local};
/// use cotama_campaign::plan::Fault;
/// use cotama_sim::supervised::When;
/// // Five seconds after the operator is asked for the first time, his link is gone.
/// let when = When::During(local::State::HandOver, Millis(5_000));
/// assert_eq!(Fault::failure(when, FailureMode::Com1).name(), "COM1");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// A row of the FMECA, in a supervised mission.
    Failure {
        /// When it begins.
        when: When,
        /// The row.
        mode: FailureMode,
        /// The module, where the row is about one, whichever it is.
        part: Option<Module>,
        /// When it ends, if not by itself.
        until: Option<When>,
    },
    /// The answers of the operator to the first request from a place on.
    Operator(Answers),
    /// Something that happens at a place of a mission that is run by its plans alone.
    Event(Event),
    /// Real power differs from the modelled one in a zone of such a mission.
    Power(PowerError),
    /// A failure of a robot's file, in a mission under its supervisors.
    Row(robots::Injection),
    /// The answers of the operator of such a robot to the first request from a place on.
    Replies(robots::Answers),
    /// Something that goes wrong in a team.
    Team(scenario::Fault),
}

impl Fault {
    /// A failure that stays, of avoidance if the row is about one module, whichever it is.
    pub const fn failure(when: When, mode: FailureMode) -> Self {
        Self::Failure { when, mode, part: None, until: None }
    }

    /// Returns the name of the fault without its moment: two plans with the same cause share it.
    ///
    /// ```
    /// use cotama_core::units::Millis;
    /// use cotama_models::cotama::{FailureMode, Module};
    /// use cotama_campaign::plan::Fault;
    /// use cotama_sim::supervised::When;
    /// let (when, until) = (When::At(Millis(7)), None);
    /// let crash = Fault::Failure { when, mode: FailureMode::Sw1, part: Some(Module::Mcl), until };
    /// assert_eq!(crash.name(), "SW1 of MCL");
    /// ```
    pub fn name(&self) -> String {
        match self {
            Self::Failure { mode, part: Some(part), .. } if mode.rule().one_module => {
                format!("{} of {}", mode.name(), part.name())
            }
            Self::Failure { mode, .. } => mode.name().to_owned(),
            Self::Operator(_) | Self::Replies(_) => "operator".to_owned(),
            Self::Row(it) => format!("failure {}", it.failure),
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
                FaultKind::Robot(_, mode) => mode.name().to_owned(),
                FaultKind::Shifted(_) => "an object shifted".to_owned(),
                FaultKind::Turned(..) => "an object turned".to_owned(),
            },
        }
    }
}

impl From<&Faults> for Plan {
    /// Returns the faults of a file, less its random events, which are drawn by each run.
    fn from(faults: &Faults) -> Self {
        let script = Script::from(faults);
        let failure = |it: &Injection| Fault::Failure {
            when: it.when,
            mode: it.mode,
            part: it.mode.rule().one_module.then_some(it.part),
            until: it.until,
        };
        let failures = script.injections.iter().map(failure);
        let answers = script.answers.into_iter().map(Fault::Operator);
        let events = faults.events.iter().copied().map(Fault::Event);
        let powers = faults.power_errors.iter().copied().map(Fault::Power);
        let own = robots::Script::from(&faults.of_robot[..]);
        let rows = own.injections.into_iter().map(Fault::Row);
        let replies = own.answers.into_iter().map(Fault::Replies);
        let all = failures.chain(answers).chain(events).chain(powers).chain(rows).chain(replies);
        Self { faults: all.collect() }
    }
}

impl From<&Plan> for Faults {
    fn from(plan: &Plan) -> Self {
        let mut faults = Self::default();
        for fault in &plan.faults {
            match fault {
                Fault::Failure { when, mode, part, until } => faults.incidents.push(Incident {
                    when: *when,
                    kind: IncidentKind::Failure { mode: *mode, part: *part, until: *until },
                }),
                Fault::Operator(it) => faults.incidents.push(Incident {
                    when: When::Place(it.x),
                    kind: IncidentKind::Operator { answers: it.answers.clone(), delay: it.delay },
                }),
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
                Fault::Row(robots::Injection { when, failure, until }) => {
                    let kind = row::IncidentKind::Failure { failure: *failure, until: *until };
                    faults.of_robot.push(row::Incident { when: *when, kind });
                }
                Fault::Replies(it) => {
                    let (answers, delay) = (it.answers.iter().copied().collect(), it.delay);
                    let kind = row::IncidentKind::Operator { answers, delay };
                    faults.of_robot.push(row::Incident { when: row::Moment::Place(it.x), kind });
                }
                // No mission has one.
                Fault::Team(_) => {}
            }
        }
        // As a file is read, so that a plan is run as its file is.
        faults.events.sort_by_key(|it| it.x);
        faults.incidents.sort_by_key(|it| it.when.key());
        faults.of_robot.sort_by_key(|it| it.when);
        faults
    }
}

impl From<&Plan> for Script {
    fn from(plan: &Plan) -> Self {
        Self::from(&Faults::from(plan))
    }
}

impl Plan {
    /// Whether all its places lie on a path of this length.
    pub fn is_within(&self, path: Millimetres) -> bool {
        let on_it = |when: When| !matches!(when, When::Place(x) if x > path);
        let on_path = |when| !matches!(when, row::Moment::Place(x) if x > path);
        self.faults.iter().all(|it| match it {
            Fault::Failure { when, until, .. } => on_it(*when) && until.is_none_or(on_it),
            Fault::Operator(it) => it.x <= path,
            Fault::Event(it) => it.x <= path,
            Fault::Row(it) => on_path(it.when) && it.until.is_none_or(on_path),
            Fault::Replies(it) => it.x <= path,
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
        let mut names: Vec<_> = self.faults.iter().map(Fault::name).collect();
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
            Fault::Row(it) => {
                let robot = mission.under.as_ref().map(|it| it.file.robot());
                let row = robot.and_then(|robot| robot.failures.get(it.failure));
                row.map_or_else(|| fault.name(), |it| it.id.clone())
            }
            _ => fault.name(),
        };
        let mut names: Vec<_> = self.faults.iter().map(name).collect();
        names.sort();
        names.dedup();
        if names.is_empty() { "nothing fails".to_owned() } else { names.join(" + ") }
    }
}

/// A place of the path in whole mm, as a moment.
pub(super) const fn place(x_mm: u64) -> When {
    When::Place(Millimetres(x_mm))
}

/// A time after the start in ms, as a moment.
pub(super) const fn at(t_ms: u64) -> When {
    When::At(Millis(t_ms))
}
