//! The faults of a supervised run, and the answers of the operator.

use super::operator::Answers;
use cotama_models::cotama::{FailureMode, Module};
use cotama_models::missions::faults::{Faults, IncidentKind, Moment};

/// When something is to fail.
pub use cotama_models::missions::faults::Moment as When;

/// The faults, and the answers of the operator.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Script {
    /// Failures, each once.
    pub injections: Vec<Injection>,
    /// The operator's answers to requests, in their order; where there is none he has his habits.
    pub answers: Vec<Answers>,
}

impl From<&Faults> for Script {
    /// The failures and answers of a mission's own script.
    fn from(faults: &Faults) -> Self {
        let mut script = Self::default();
        for incident in &faults.incidents {
            match &incident.kind {
                IncidentKind::Failure { mode, part, until } => {
                    let it = Injection::new(incident.when, *mode);
                    let part = part.unwrap_or(it.part);
                    script.injections.push(Injection { part, until: *until, ..it });
                }
                IncidentKind::Repair(mode) => {
                    let under_way = |it: &&mut Injection| it.mode == *mode && it.until.is_none();
                    if let Some(it) = script.injections.iter_mut().rfind(under_way) {
                        it.until = Some(incident.when);
                    }
                }
                IncidentKind::Operator { answers, delay } => {
                    let (answers, delay) = (answers.clone(), *delay);
                    let Moment::Place(x) = incident.when else { continue };
                    script.answers.push(Answers { x, answers, delay });
                }
            }
        }
        script
    }
}

/// A failure that is to happen.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::cotama::{Class, FailureMode};
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::supervised::{Injection, Script, Supervised, When};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let failure = Injection::new(When::At(Millis(20_000)), FailureMode::Rt1);
/// let script = Script { injections: vec![failure], ..Script::default() };
/// let run = Supervised::new(&mission).unwrap().run(&script).unwrap();
/// // Localisation is late again and again: an adapter takes fewer particles.
/// assert_eq!(run.conduct[0].decided.unwrap().1, Class::Adapter);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Injection {
    /// The moment of the failure.
    pub when: When,
    /// The failure mode.
    pub mode: FailureMode,
    /// Which module, if the failure is one of a module, whichever it is.
    pub part: Module,
    /// When it ends, if not by itself.
    pub until: Option<When>,
}

impl Injection {
    /// A failure; if it is one of a module, whichever it is, then of avoidance.
    pub const fn new(when: When, mode: FailureMode) -> Self {
        Self { when, mode, part: Module::Smz, until: None }
    }
}
