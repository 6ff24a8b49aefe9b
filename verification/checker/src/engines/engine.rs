//! The trait of engines.

use super::budget::Budget;
use super::known::Known;
use super::task::{Finding, Task};
use crate::explicit::Limits;

/// An engine. What it says is so; when it does not know, it says that.
///
/// One of your own is asked beside those of this crate when it is among the
/// [`engines`](crate::check::Options::engines) of a question:
///
/// ```
/// use cotama_models::nets::families::philosophers;
/// use cotama_verification::check::{Model, Options, Verdict, check};
/// use cotama_verification::engines::{Bid, Budget, Engine, Finding, Found, Known, Task};
/// use cotama_verification::property;
///
/// /// Fires what is enabled first, a hundred times.
/// struct Straight;
///
/// impl Engine for Straight {
///     fn name(&self) -> &'static str {
///         "straight"
///     }
///
///     fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid> {
///         let suits = matches!(task, Task::Reach(_)) && net.time().is_none();
///         suits.then(|| Bid::new(Bid::GLANCE - 1, budget))
///     }
///
///     fn find(&self, net: &Known<'_>, task: Task<'_>, _: &Budget<'_>) -> Finding {
///         let Task::Reach(goal) = task else { return Finding::unsuited() };
///         let Some(goal) = property::Condition::new(goal, net.pt()) else {
///             return Finding::unsuited();
///         };
///         let (mut marking, mut way) = (net.pt().initial.clone(), Vec::new());
///         while !goal.holds(marking.as_slice()) && way.len() < 100 {
///             let transitions = 0..net.pt().transitions.len() as u32;
///             let Some(next) = transitions.into_iter().find(|&it| net.pt().enabled(&marking, it))
///             else {
///                 break;
///             };
///             marking = net.pt().fire(&marking, next).unwrap();
///             way.push(cotama_core::net::TransitionId(next));
///         }
///         if !goal.holds(marking.as_slice()) {
///             return Finding::undecided(way.len() as u64);
///         }
///         Finding { states: way.len() as u64, found: Found::Path(way) }
///     }
/// }
///
/// let net = philosophers(3).unwrap();
/// let model = Model::from(&net.view().net());
/// let asked = property::parse("EF eat_1", model.pt()).unwrap();
/// let answer = check(&model, &asked, &Options { engines: &[&Straight], ..Options::default() });
/// assert_eq!((answer.verdict, answer.engine()), (Verdict::Holds(true), "straight"));
/// ```
pub trait Engine {
    /// The name that users know it by.
    fn name(&self) -> &'static str;

    /// Returns the bid of an engine for a task on a net: its cost, and its part of the budget;
    /// `None` when it does not do such tasks. Asked often: examining the net is left to
    /// [`find`](Self::find).
    fn suits(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Option<Bid>;

    /// Whether it knows inhibitor arcs, reset arcs and priorities: nets [that are not
    /// plain](cotama_property::pt::Pt::is_plain). Others are not asked about such nets.
    fn knows_special(&self) -> bool {
        false
    }

    /// Does a task on a net.
    fn find(&self, net: &Known<'_>, task: Task<'_>, budget: &Budget<'_>) -> Finding;
}

/// The bid of an engine for a task.
#[derive(Clone, Copy, Debug)]
pub struct Bid {
    /// The engine of the least cost is asked first.
    pub cost: u32,
    /// The part of the budget asked for; the last engine may use all.
    pub limits: Limits,
}

impl Bid {
    /// Cost of a search among about a thousand markings.
    pub const GLANCE: u32 = 10;
    /// Cost of an examination of the structure of a net, which visits no marking.
    pub const STRUCTURE: u32 = 20;
    /// Cost of an examination of markings that are stored, or will be needed.
    pub const STORED: u32 = 30;
    /// Cost of a search among few markings. Tasks of this cost or more are asked of a smaller net,
    /// if reductions make one.
    pub const SEARCH: u32 = 40;
    /// Cost of a search among many markings.
    pub const LONG: u32 = 50;
    /// Cost of a search among all markings.
    pub const ALL: u32 = 60;

    /// All of the budget, at this cost.
    pub fn new(cost: u32, budget: &Budget<'_>) -> Self {
        Self { cost, limits: budget.limits }
    }

    /// Half of it: others may be asked afterwards.
    pub fn half(cost: u32, budget: &Budget<'_>) -> Self {
        Self { cost, limits: budget.half() }
    }

    /// All of it, but for the number of markings.
    pub fn few(cost: u32, budget: &Budget<'_>, most: u64) -> Self {
        let states = budget.limits.states.min(most);
        Self { cost, limits: Limits { states, ..budget.limits } }
    }
}
