//! One supervisor written four times, and one stream of events for all of them.
//!
//! The supervisor is the local one of the robot *Drive*: seven states, twenty transitions of which
//! two fire by themselves, and three flags that six more transitions change. Each version says
//! which transition fired and how many fired by themselves after it, or that the event was ignored.
#![no_std]

pub mod by_hand;
pub mod by_net;
pub mod by_smlang;
pub mod by_statig;
pub mod by_timed_net;
pub mod stream;

/// The states.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Waits for a start.
    Idle,
    /// Plans a path.
    Planning,
    /// Follows it.
    Following,
    /// Waits for the operator to choose how to go on.
    Asking,
    /// The operator draws waypoints or a path.
    Teleprogramming,
    /// The operator drives.
    Teleoperating,
    /// The goal is reached; left at once.
    End,
}

/// The events.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "their names say it")]
pub enum Event {
    StartDrive,
    PathReady,
    GoalReached,
    LocalEvent,
    OpTeleprogram,
    OpTeleoperate,
    OpWaypoints,
    OpPath,
    OpGoalReached,
    GsAbort,
    CameraLost,
    CameraBack,
    WifiLost,
    WifiBack,
    Report,
    ReportDone,
}

/// The transitions, in the order of the net.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "their names say it")]
pub enum Line {
    Start,
    Follow,
    Reach,
    AskPlanning,
    AskFollowing,
    Teleprogram,
    Teleoperate,
    Plan,
    Take,
    Redraw,
    Arrive,
    HandBack,
    GiveUp,
    Finish,
    LoseLink,
    Abort,
    CameraLost,
    CameraBack,
    WifiLost,
    WifiBack,
    Report,
    ReportDone,
}

/// The outcome of an event: the transition that fired, and how many fired by themselves after it.
pub type Outcome = Option<(Line, u32)>;

/// A supervisor, however it is written.
pub trait Supervisor {
    /// At the start.
    fn new() -> Self;
    /// Takes one event; the milliseconds since the start are for those that keep time.
    fn offer(&mut self, now: u64, event: Event) -> Outcome;
    /// Returns the present state.
    fn state(&self) -> State;
}

/// A supervisor that ignores everything: what the loop itself costs.
#[derive(Debug)]
pub struct Nothing;

impl Supervisor for Nothing {
    fn new() -> Self {
        Self
    }

    #[inline]
    fn offer(&mut self, _: u64, event: Event) -> Outcome {
        let _ = core::hint::black_box(event);
        None
    }

    #[inline]
    fn state(&self) -> State {
        core::hint::black_box(State::Idle)
    }
}
