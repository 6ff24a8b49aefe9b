//! The events that all of them are offered.

use crate::{Event, State};

/// The events of each state, as equal chances: events that it waits for, changes of flags, and such
/// as come too late or too early. About half of them fire.
const MIX: [[Event; 16]; 7] = {
    use Event::*;
    /// The six changes of flags and ten other events.
    const fn with_flags(others: [Event; 10]) -> [Event; 16] {
        let [a, b, c, d, e, f, g, h, i, j] = others;
        [
            a, b, c, d, e, f, g, h, i, j, CameraLost, CameraBack, WifiLost, WifiBack, Report,
            ReportDone,
        ]
    }
    const IDLE: [Event; 16] = with_flags([
        StartDrive,
        StartDrive,
        StartDrive,
        StartDrive,
        StartDrive,
        PathReady,
        GoalReached,
        LocalEvent,
        GsAbort,
        OpPath,
    ]);
    const PLANNING: [Event; 16] = with_flags([
        PathReady,
        PathReady,
        PathReady,
        LocalEvent,
        GsAbort,
        StartDrive,
        GoalReached,
        OpPath,
        OpWaypoints,
        OpTeleoperate,
    ]);
    const FOLLOWING: [Event; 16] = with_flags([
        GoalReached,
        GoalReached,
        GoalReached,
        LocalEvent,
        LocalEvent,
        GsAbort,
        PathReady,
        OpPath,
        StartDrive,
        OpGoalReached,
    ]);
    const ASKING: [Event; 16] = with_flags([
        OpTeleprogram,
        OpTeleprogram,
        OpTeleoperate,
        OpTeleoperate,
        OpTeleoperate,
        OpTeleoperate,
        GsAbort,
        LocalEvent,
        GoalReached,
        PathReady,
    ]);
    const TELEPROGRAMMING: [Event; 16] = with_flags([
        OpWaypoints,
        OpWaypoints,
        OpPath,
        OpPath,
        LocalEvent,
        GsAbort,
        OpTeleoperate,
        OpGoalReached,
        PathReady,
        StartDrive,
    ]);
    const TELEOPERATING: [Event; 16] = with_flags([
        OpTeleprogram,
        OpGoalReached,
        OpGoalReached,
        OpGoalReached,
        LocalEvent,
        GsAbort,
        GoalReached,
        OpPath,
        OpWaypoints,
        StartDrive,
    ]);
    [IDLE, PLANNING, FOLLOWING, ASKING, TELEPROGRAMMING, TELEOPERATING, IDLE]
};

/// A stream of events, the same at every run (Marsaglia, "Xorshift RNGs", 2003; multiplied, as
/// xorshift64*).
#[derive(Clone, Debug)]
pub struct Stream(u64);

impl Stream {
    /// From the first event on.
    pub const fn new() -> Self {
        Self(1)
    }

    /// The next event, for a supervisor in this state.
    #[inline]
    pub fn next(&mut self, state: State) -> Event {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        MIX[state as usize][(self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 60) as usize]
    }
}

impl Default for Stream {
    fn default() -> Self {
        Self::new()
    }
}
