//! Questions in a test of somebody's own net.

use super::{Answer, Model, Options, Verdict, check_all, laws};
use crate::flat::{FlatError, flat};
use cotama_core::net::Net;
use cotama_core::net::owned::OwnedNet;
use cotama_core::system::System;
use cotama_diagnosis::{Case, Diagnosis};
use cotama_property::pt::Pt;
use cotama_property::time::{TimeNet, TimeNetDefect};
use cotama_property::{self as property, Property, PropertyError};
use std::fmt;

/// A model that can be checked: a net, a system of nets.
///
/// ```
/// use cotama_models::nets::{door, families::philosophers};
/// use cotama_verification::assert_holds;
/// use cotama_verification::pt::Pt;
/// // A net of `net!`, one that was built, and one that engines read.
/// assert_holds!(door::NET, "EF Open");
/// assert_holds!(philosophers(3).unwrap(), "EF deadlock");
/// assert_holds!(Pt::from(&door::NET), "AG EF Closed");
/// ```
pub trait Checkable {
    /// The model that engines read, and the net whose events and documentation explain its runs.
    ///
    /// # Errors
    /// When it cannot be made one.
    fn subject(&self) -> Result<(Model, Option<OwnedNet>), NoModel>;
}

impl Checkable for Net<'_> {
    fn subject(&self) -> Result<(Model, Option<OwnedNet>), NoModel> {
        Ok((Model::timed(self).map_err(NoModel::Time)?, Some(OwnedNet::from(self))))
    }
}

impl Checkable for OwnedNet {
    fn subject(&self) -> Result<(Model, Option<OwnedNet>), NoModel> {
        self.view().net().subject()
    }
}

/// A system as its steps in any order, which cover the markings of rounds.
impl Checkable for System<'_> {
    fn subject(&self) -> Result<(Model, Option<OwnedNet>), NoModel> {
        let net = flat(self).map_err(NoModel::System)?;
        Ok((Model::from(&net.view().net()), Some(net)))
    }
}

impl Checkable for Pt {
    fn subject(&self) -> Result<(Model, Option<OwnedNet>), NoModel> {
        Ok((Model::from(self.clone()), None))
    }
}

impl Checkable for TimeNet {
    fn subject(&self) -> Result<(Model, Option<OwnedNet>), NoModel> {
        Ok((Model::from(self.clone()), None))
    }
}

/// Why something cannot be checked.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoModel {
    /// The interval of a transition is none of a time net.
    Time(TimeNetDefect),
    /// The system has no net.
    System(FlatError),
}

impl fmt::Display for NoModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Time(defect) => defect.fmt(f),
            Self::System(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for NoModel {}

/// Answers to several questions; `Display` explains each that is not as it should be.
#[derive(Debug)]
#[non_exhaustive]
pub struct Report {
    model: Model,
    net: Option<OwnedNet>,
    rows: Vec<(Property, Answer)>,
}

/// Asks the questions of these texts, in the language of [`property`](mod@property). Without a
/// text, the laws of the net are asked, which speak of the net without its intervals.
///
/// # Errors
/// When it has no model, or a text is none of the language.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::check::{Options, report};
/// let report = report(&door::NET, &["AG !(Open & obstacle)"], &Options::default()).unwrap();
/// assert!(!report.holds());
/// let (property, answer) = &report.rows()[0];
/// let diagnosis = report.diagnosis(property, answer).unwrap();
/// assert_eq!(diagnosis.trace.last().unwrap().event.as_deref(), Some("Obstacle"));
/// ```
pub fn report(
    of: &impl Checkable,
    texts: &[&str],
    options: &Options<'_>,
) -> Result<Report, ReportError> {
    let (mut model, net) = of.subject().map_err(ReportError::Model)?;
    let properties = if texts.is_empty() {
        model = Model::Plain(model.pt().clone());
        net.as_ref().map(|it| laws(&it.view().net())).unwrap_or_default()
    } else {
        let parsed = texts.iter().map(|it| property::parse(it, model.pt()));
        parsed.collect::<Result<Vec<_>, _>>().map_err(ReportError::Property)?
    };
    let answers = check_all(&model, &properties, options);
    Ok(Report { model, net, rows: properties.into_iter().zip(answers).collect() })
}

/// Why there is no report.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReportError {
    /// There is no model.
    Model(NoModel),
    /// A text is no property.
    Property(PropertyError),
}

impl fmt::Display for ReportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Model(it) => it.fmt(f),
            Self::Property(it) => it.fmt(f),
        }
    }
}

impl std::error::Error for ReportError {}

impl Report {
    /// Whether every property holds. What is unknown does not.
    pub fn holds(&self) -> bool {
        self.rows.iter().all(|it| {
            matches!(it.1.verdict, Verdict::Holds(true) | Verdict::Bound(_) | Verdict::Response(_))
        })
    }

    /// The properties and their answers.
    pub fn rows(&self) -> &[(Property, Answer)] {
        &self.rows
    }

    /// Why an answer is as it is; `None` when no run shows it.
    pub fn diagnosis(&self, property: &Property, answer: &Answer) -> Option<Diagnosis> {
        let run = answer.run.as_ref()?;
        let holds = answer.verdict != Verdict::Holds(false);
        let case = Case {
            schedule: answer.schedule.as_ref(),
            ..Case::new(self.model.pt(), property, holds, run)
        };
        let view = self.net.as_ref().map(OwnedNet::view);
        let net = view.as_ref().map(|it| it.net());
        Diagnosis::new(&Case { net: net.as_ref(), ..case }).or_else(|_| Diagnosis::new(&case)).ok()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (property, answer) in &self.rows {
            match &answer.verdict {
                Verdict::Holds(true) => {
                    writeln!(f, "{}: holds ({})", property.name, answer.engine())?;
                }
                Verdict::Holds(false) => match self.diagnosis(property, answer) {
                    Some(diagnosis) => writeln!(f, "{diagnosis}")?,
                    None => writeln!(f, "{}: does not hold ({})", property.name, answer.engine())?,
                },
                Verdict::Bound(most) => writeln!(f, "{}: {most}", property.name)?,
                Verdict::Response(Some((min, max))) => {
                    writeln!(f, "{}: {min} to {max}", property.name)?;
                }
                Verdict::Response(None) => writeln!(f, "{}: never begins", property.name)?,
                Verdict::Unknown(reason) => {
                    let is_timed = matches!(self.model, Model::Timed { .. });
                    let way_out = reason.way_out(&property.question, is_timed);
                    write!(f, "{}: unknown, {reason}", property.name)?;
                    if answer.states > 0 {
                        write!(f, " after {} markings", answer.states)?;
                    }
                    writeln!(f, "\n  help: {way_out}")?;
                }
            }
        }
        Ok(())
    }
}

/// Fails a test with the counterexample when a property does not hold; without properties, the laws
/// of the net are meant.
///
/// ```
/// use cotama_core::net;
/// use cotama_verification::assert_holds;
///
/// net! {
///     /// Stops the robot when the operator falls silent.
///     pub mod link {
///         places { Up: 1, Down }
///         events { Silence, Heard }
///         transitions {
///             lose    on Silence: Up => Down;
///             recover on Heard:   Down => Up;
///         }
///         ignore { Silence in Down; Heard in Up; }
///         laws { handles(all); deadlock_free; always_can(Up); }
///     }
/// }
/// assert_holds!(link::NET);
/// assert_holds!(link::NET, "AG !(Up & Down)", "A G F Up | EG Down");
/// ```
///
/// ```should_panic
/// # use cotama_core::net;
/// # use cotama_verification::assert_holds;
/// # net! {
/// #     /// Stops the robot when the operator falls silent.
/// #     pub mod link {
/// #         places { Up: 1, Down }
/// #         events { Silence, Heard }
/// #         transitions {
/// #             lose    on Silence: Up => Down;
/// #             recover on Heard:   Down => Up;
/// #         }
/// #         ignore { Silence in Down; Heard in Up; }
/// #         laws { handles(all); deadlock_free; always_can(Up); }
/// #     }
/// # }
/// // does not hold: after 1 firing `Up` is not marked ...
/// assert_holds!(link::NET, "AG Up");
/// ```
#[macro_export]
macro_rules! assert_holds {
    ($net:expr $(, $property:expr)* $(,)?) => {
        match $crate::check::report(&$net, &[$($property),*], &$crate::check::Options::default()) {
            Ok(report) => assert!(report.holds(), "\n{report}"),
            Err(error) => panic!("{error}"),
        }
    };
}
