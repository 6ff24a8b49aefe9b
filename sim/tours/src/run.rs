//! Results of a mission.

use cotama_axes::Wrong;

/// A mission that was run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// End of the mission.
    pub outcome: Outcome,
    /// When it ended, ms after the start.
    pub t_ms: i64,
    /// The place on the path at which it ended, mm.
    pub x_mm: i64,
    /// Sums that were used, by indicator; zero where values do not add up.
    pub used: Vec<i64>,
    /// The plans, the first of the start.
    pub plans: Vec<Planned>,
    /// When and where the robot turned round to go home.
    pub turned: Option<(i64, i64)>,
    /// When and where the robot gave up its plan for the cheapest safe options, as home was
    /// further than the end.
    pub hurried: Option<(i64, i64)>,
}

/// The end of a mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// All is done, and all end constraints hold.
    Completed,
    /// All is done, and an end constraint does not hold, by index.
    Missed(usize),
    /// The robot turned round and is home within all that it may use.
    Returned,
    /// The robot stands on the way: no plan is left.
    Stopped,
    /// The robot stands on the way: it used up what an end constraint, by index, leaves.
    Stranded(usize),
}

/// A plan, as it was made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Planned {
    /// When, ms after the start.
    pub t_ms: i64,
    /// The place on the path, mm.
    pub x_mm: i64,
    /// Why.
    pub cause: Cause,
    /// Choices, from here on.
    pub choices: Vec<Choice>,
}

/// Cause of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The mission begins.
    Start,
    /// The margin of an end constraint, by index, is below zero.
    Margin(usize),
    /// The plan needs hardware, by index, that is lost.
    Lost(usize),
}

/// The choice for an activity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The objective of the mission, by index.
    pub objective: usize,
    /// The begin, mm.
    pub x_start_mm: i64,
    /// Options, by index.
    pub options: Vec<usize>,
    /// The speed, mm/s; zero where the robot stands.
    pub speed_mm_s: i64,
}

/// Why a mission is not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotRun {
    /// An end constraint, by index, asks for equality: no run keeps it to the last unit.
    Equality(usize),
    /// No plan keeps all constraints.
    NoPlan,
    /// No way home is left in a stretch of the path that begins here, mm: all options need what
    /// may be lost.
    NoReturn(i64),
    /// The steps of the search do not suffice.
    Limit,
    /// Arithmetic of a formula does not come out.
    Wrong(Wrong),
}
