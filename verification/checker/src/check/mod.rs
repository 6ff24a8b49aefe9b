//! A question to a net, and its answer: engines behind one trait, and the choice among them.
//!
//! ```text
//! text, XML, a law -> Property      Net, System, PNML, .net -> Model
//! (Model, Property) -> Task         one of the parts of the question
//! Task -> Finding                   by an Engine: the cheapest of those that suit
//! Finding -> Answer                 verdict, run, evidence that `certificate::verify` checks again
//! ```
//!
//! ```
//! use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
//! use cotama_verification::check::{Model, Options, Verdict, check};
//! use cotama_verification::property;
//!
//! let mut lamp = OwnedNet::new("lamp", "");
//! let off = lamp.place(OwnedPlace::new("off", 1)).unwrap();
//! let on = lamp.place(OwnedPlace::new("on", 0)).unwrap();
//! lamp.transition(OwnedTransition::new("press").take(off, 1).give(on, 1)).unwrap();
//! let lamp = Model::from(&lamp.view().net());
//!
//! let both = property::parse("EF (on & off)", lamp.pt()).unwrap();
//! let answer = check(&lamp, &both, &Options::default());
//! assert_eq!((answer.verdict, answer.engine()), (Verdict::Holds(false), "structural"));
//! ```

mod laws;
mod liveness;
mod model;
mod question;
mod reduced;
mod report;
mod strategy;
mod unused;
mod watched;

pub use crate::engines::{Extent, Reason};
pub use laws::{laws, question};
pub use model::Model;
pub use report::{Checkable, NoModel, Report, ReportError, report};

use crate::engines::{Budget, Engine, Known};
use crate::explicit::{Limits, Progress};
use crate::temporal::Run;
use crate::tpn::{Schedule, Time};
use cotama_certificate::{self as certificate, Certificate, Evidence, Uncertifiable};
use cotama_property::Property;
use cotama_property::pt::Pt;
use std::fmt;

/// The verdict on a question.
///
/// ```
/// use cotama_verification::check::{Extent, Model, Options, Verdict, check};
/// use cotama_verification::{property, tina};
/// let belt = tina::read("belt.net", b"tr put on -> on full  pl on (1)").unwrap().untimed();
/// let model = Model::from(belt);
/// let ask = |text| {
///     check(&model, &property::parse(text, model.pt()).unwrap(), &Options::default()).verdict
/// };
/// assert_eq!(ask("EF full >= 3"), Verdict::Holds(true));
/// assert_eq!(ask("bounds(on)"), Verdict::Bound(Extent::Finite(1)));
/// assert_eq!(ask("bounds(full)"), Verdict::Bound(Extent::Infinite));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Truth of the formula.
    Holds(bool),
    /// The most tokens.
    Bound(Extent),
    /// The least and the most time; `None` when there is nothing to measure, as the transition
    /// never fires.
    Response(Option<(Time, Time)>),
    /// No verdict, for this reason.
    Unknown(Reason),
}

/// An answer, and how it is known.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::certificate::verify;
/// use cotama_verification::check::{Model, Options, check};
/// use cotama_verification::property;
/// let model = Model::from(&door::NET);
/// let wish = property::parse("AG !(Closing & obstacle)", model.pt()).unwrap();
/// let answer = check(&model, &wish, &Options { evidence: true, ..Options::default() });
/// let certificate = answer.certificate(model.pt(), &wish).unwrap();
/// assert!(verify(&certificate.text()).unwrap().verdict);
/// ```
#[derive(Clone, Debug)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// A run that shows it: a path to what was looked for, or a counterexample.
    pub run: Option<Run>,
    /// The run with dates, of time nets.
    pub schedule: Option<Schedule>,
    /// Evidence that can be checked again; [`Evidence::None`] when the verdict is as good as the
    /// engine.
    pub evidence: Evidence,
    /// Techniques that led to the answer, in order: names of engines, and `reductions`.
    pub techniques: Vec<&'static str>,
    /// How many markings, or classes of a time net, were met by the engine that met most.
    pub states: u64,
}

impl Answer {
    /// The engine that decided.
    pub fn engine(&self) -> &'static str {
        self.techniques.last().copied().unwrap_or("none")
    }

    /// The answer to a question as a file that [`verify`](cotama_certificate::verify()) checks
    /// again. Formulas are [simplified](cotama_property::Formula::simplified) in it.
    ///
    /// # Errors
    /// When there is nothing to certify, or no form for it.
    pub fn certificate(&self, pt: &Pt, property: &Property) -> Result<Certificate, Uncertified> {
        let known = match self.verdict {
            Verdict::Holds(holds) => certificate::Answer::Holds(holds),
            Verdict::Bound(Extent::Finite(most)) => certificate::Answer::Bound(most),
            Verdict::Bound(Extent::Infinite) => certificate::Answer::Unbounded,
            Verdict::Response(_) => return Err(Uncertified::Form(Uncertifiable::Time)),
            Verdict::Unknown(_) => return Err(Uncertified::Unknown),
        };
        if self.evidence == Evidence::None {
            return Err(Uncertified::NoEvidence(self.engine()));
        }
        let question = property.question.simplified();
        let property = Property { name: property.name.clone(), question };
        Certificate::new(pt, &property, known, self.evidence.clone()).map_err(Uncertified::Form)
    }
}

/// Why there is no certificate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Uncertified {
    /// The answer is not known.
    Unknown,
    /// The engine of this name gives none.
    NoEvidence(&'static str),
    /// The answer has no form in a certificate.
    Form(Uncertifiable),
}

impl fmt::Display for Uncertified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => f.write_str("the answer is not known"),
            Self::NoEvidence(engine) => write!(f, "the engine `{engine}` gives no evidence for it"),
            Self::Form(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for Uncertified {}

/// Which engine is asked. Formulas of CTL and LTL beyond reachability have one engine, which is
/// asked by every choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// The engines that suit the question, the cheapest first.
    #[default]
    Auto,
    /// The structure of the net alone.
    Structural,
    /// Markings one by one, only some transitions in each.
    Stubborn,
    /// All markings one by one.
    Explicit,
}

impl<'b> From<&Options<'b>> for Budget<'b> {
    fn from(options: &Options<'b>) -> Self {
        let Options { limits, jobs, evidence, progress, .. } = *options;
        Self { limits, jobs, evidence, progress }
    }
}

/// How a question is answered.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::check::{Choice, Model, Options, Verdict, check};
/// use cotama_verification::explicit::Limits;
/// use cotama_verification::property;
/// let net = philosophers(8).unwrap();
/// let model = Model::from(&net.view().net());
/// let asked = property::parse("EF deadlock", model.pt()).unwrap();
/// let limits = Limits { states: 100, ..Limits::default() };
/// let options = Options { engine: Choice::Explicit, limits, ..Options::default() };
/// assert!(matches!(check(&model, &asked, &options).verdict, Verdict::Unknown(_)));
/// assert_eq!(check(&model, &asked, &Options::default()).verdict, Verdict::Holds(true));
/// ```
#[derive(Clone, Copy)]
pub struct Options<'o> {
    /// By which engine.
    pub engine: Choice,
    /// Engines of one's own, which are asked beside.
    pub engines: &'o [&'o dyn Engine],
    /// The limits of time, memory and markings.
    pub limits: Limits,
    /// On how many threads, where an engine can use several.
    pub jobs: usize,
    /// Whether evidence is worth more work: without it, verdicts carry what evidence comes for
    /// free.
    pub evidence: bool,
    /// Called now and then.
    pub progress: &'o dyn Fn(Progress),
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            engine: Choice::Auto,
            engines: &[],
            limits: Limits::default(),
            jobs: 1,
            evidence: false,
            progress: &|_| (),
        }
    }
}

/// A model and what was found of it so far, which serves the next question.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::check::{Checker, Model, Options, Verdict};
/// use cotama_verification::property;
/// let model = Model::from(&door::NET);
/// let checker = Checker::new(&model);
/// let verdict = |text| {
///     checker.answer(&property::parse(text, model.pt()).unwrap(), &Options::default()).verdict
/// };
/// assert_eq!(verdict("EF Open"), Verdict::Holds(true));
/// assert_eq!(verdict("AG EF Closed"), Verdict::Holds(true)); // the graph may be there already
/// ```
#[derive(Debug)]
pub struct Checker<'m> {
    known: Known<'m>,
}

impl<'m> Checker<'m> {
    /// Nothing is known of it yet.
    pub fn new(model: &'m Model) -> Self {
        let known = match model {
            Model::Plain(pt) => Known::new(pt),
            Model::Timed { net, untimed } => Known::timed(untimed, net),
        };
        Self { known }
    }

    /// Answers a question.
    pub fn answer(&self, property: &Property, options: &Options<'_>) -> Answer {
        question::answer(&self.known, &property.question, options)
    }
}

/// Answers one question.
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::check::{Model, Options, Verdict, check};
/// use cotama_verification::property;
/// let net = philosophers(3).unwrap();
/// let model = Model::from(&net.view().net());
/// let wish = property::parse("AG !deadlock", model.pt()).unwrap();
/// let answer = check(&model, &wish, &Options::default());
/// assert_eq!(answer.verdict, Verdict::Holds(false)); // all take the left fork
/// assert_eq!(answer.run.unwrap().stem.len(), 3);
/// ```
pub fn check(model: &Model, property: &Property, options: &Options<'_>) -> Answer {
    Checker::new(model).answer(property, options)
}

/// Answers questions to one net, in their order.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::check::{Model, Options, Verdict, check_all};
/// use cotama_verification::property;
/// let model = Model::from(&door::NET);
/// let asked = ["AG !(Closing & obstacle)", "EF Blocked", "AG Closed"];
/// let asked = asked.map(|it| property::parse(it, model.pt()).unwrap());
/// let answers = check_all(&model, &asked, &Options::default());
/// let verdicts = answers.iter().map(|it| it.verdict).collect::<Vec<_>>();
/// assert_eq!(verdicts, [true, true, false].map(Verdict::Holds));
/// ```
pub fn check_all(model: &Model, properties: &[Property], options: &Options<'_>) -> Vec<Answer> {
    let checker = Checker::new(model);
    properties.iter().map(|it| checker.answer(it, options)).collect()
}
