//! Missions with any number of performance axes (Lambert et al., J. Intell. Robot. Syst. 110,
//! 2024).
//!
//! An engineer writes down axes, their indicators with formulas of inducers, and constraints:
//! phase P0, read once by [`Case::parse`]. Phase P1 makes activities and candidates with the speeds
//! that core constraints allow ([`Table`]), and says [why](why::why) a candidate is not faster.
//! Phase P2 takes a candidate for each activity so that all limits on sums hold ([`Problem`]),
//! exactly, as a [front](Problem::front), or by the paper's [rule](rule::rule); where there is no
//! plan, [`Infeasible`] names least sets of constraints to lift, and goals that suffice.
//!
//! All numbers are whole. Every search has a limit on its [`Steps`]: reaching it is an answer.
//!
//! ```
//! use cotama_axes::{Case, Lifted, Problem, Steps, Table, label};
//!
//! let case = Case::parse(cotama_axes::PATROL).unwrap();
//! let (mission, mut steps) = (&case.mission, Steps::default());
//! let table = Table::new(mission, Lifted::default(), &mut steps).unwrap();
//! let problem = Problem::new(mission, &table, Lifted::default());
//! let plan = problem.best(&case.ask, &mut steps).unwrap().unwrap();
//! let first = &table.activities[0].candidates[plan.choices[0]];
//! assert_eq!((label(mission, &first.options).as_str(), first.speed_mm_s), ("M1 L2", 410));
//! assert_eq!(plan.totals[mission.indicator("energy.RC").unwrap()], 6_181_615);
//! ```

pub mod causes;
mod corrections;
mod count;
mod course;
mod dominance;
mod fields;
mod formula;
mod json;
mod mission;
mod plan;
pub mod raise;
mod read;
pub mod rule;
mod search;
mod speeds;
mod steps;
mod surrogate;
mod table;
mod toml_text;
mod tree;
pub mod why;
mod world;

pub use corrections::{Infeasible, Single};
pub use course::{Course, Event, ModelError, Return, Script, What};
pub use formula::{Formula, Inducer};
pub use mission::{
    Ask, Attributes, Axis, Constraint, DetectBy, Hardware, Indicator, Kind, LOCALISATION, Lifted,
    Mission, Objective, Relation, Sense, Tio, Zone,
};
pub use plan::{Plan, Point, Problem};
pub use read::{CASE_FORMAT, Case, FORMAT, Ground, Keys, MAX_BYTES};
pub use speeds::Speeds;
pub use steps::{STEPS, Steps, Stop};
pub use table::{Activity, Candidate, Dropped, Reason, Table, label, speed_alone};
pub use tree::{Wrong, Wrongs};

/// The patrol of the paper with five limited axes; the file gives the source of each value.
pub const PATROL: &str = include_str!("../missions/patrol.toml");

/// A mission with axes that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Embedded {
    /// Name of the mission.
    pub name: &'static str,
    /// Description in one line.
    pub description: &'static str,
    /// The text of the file.
    pub text: &'static str,
}

/// All missions with axes that come with the program.
pub const EMBEDDED: [Embedded; 1] = [Embedded {
    name: "patrol-axes",
    description: "The same patrol with axes of its own: speeds follow from safety and stability, \
                  five sums have limits",
    text: PATROL,
}];

/// Returns the mission with axes of this name.
///
/// ```
/// assert!(cotama_axes::embedded("patrol-axes").unwrap().text.contains("[[axis]]"));
/// assert_eq!(cotama_axes::embedded("nope"), None);
/// ```
pub fn embedded(name: &str) -> Option<Embedded> {
    EMBEDDED.into_iter().find(|it| it.name == name)
}
