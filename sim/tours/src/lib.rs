//! Missions of any axes on their way: phase P3 of PANORAMA (Lambert et al., J. Intell. Robot. Syst.
//! 110, 2024, Sections 7.2 and 8).
//!
//! The plan of [`cotama_axes`] meets what its models do not know: a script of costs, lost
//! hardware and errors of formulas. Once a second the margin of each end constraint is looked at:
//! the goal less what was used and less what the plan will use (equation 7); of an `at least` the
//! sign is turned. Where one is below zero (equation 8), or the plan needs what is lost, the rest
//! is planned again from where the robot is, with the speeds that the hardware left allows.
//!
//! A mission may ask for a return that is kept whatever happens of what it states (Section 9
//! leaves this open): before each second the robot asks whether it could still be home, or done,
//! by the cheapest options that need nothing of what may be lost. If not, it turns round now.
//!
//! ```
//! use cotama_axes::{Case, PATROL};
//! use cotama_tours::{Outcome, run};
//!
//! let case = Case::parse(PATROL).unwrap();
//! let run = run(&case).unwrap();
//! // Both lasers are lost at 130 m: the rest is planned again, at the speeds of sonars.
//! assert_eq!((run.outcome, run.plans.len()), (Outcome::Completed, 2));
//! assert_eq!((run.plans[1].x_mm, run.plans[1].choices[0].speed_mm_s), (130_000, 330));
//! ```

mod leg;
mod limits;
mod run;
mod safe;
mod tour;

pub use run::{Cause, Choice, NotRun, Outcome, Planned, Run};
pub use tour::{PERIOD_MS, run};
