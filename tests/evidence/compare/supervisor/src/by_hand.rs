//! By hand: an enum and a `match`.

use crate::{Event, Line, Outcome, State, Supervisor};

/// The supervisor.
#[derive(Debug)]
pub struct Drive {
    state: State,
    camera: bool,
    wifi: bool,
    pending: bool,
}

impl Drive {
    /// The transition of an event.
    #[inline]
    fn step(&mut self, event: Event) -> Option<Line> {
        use State::{Asking, End, Following, Idle, Planning, Teleoperating, Teleprogramming};
        let (line, next) = match (self.state, event) {
            (Idle, Event::StartDrive) => (Line::Start, Planning),
            (Planning, Event::PathReady) => (Line::Follow, Following),
            (Following, Event::GoalReached) if !self.pending => (Line::Reach, End),
            (Planning, Event::LocalEvent) => (Line::AskPlanning, Asking),
            (Following, Event::LocalEvent) => (Line::AskFollowing, Asking),
            (Asking, Event::OpTeleprogram) => (Line::Teleprogram, Teleprogramming),
            (Asking, Event::OpTeleoperate) if self.camera && self.wifi => {
                (Line::Teleoperate, Teleoperating)
            }
            (Teleprogramming, Event::OpWaypoints) => (Line::Plan, Planning),
            (Teleprogramming, Event::OpPath) => (Line::Take, Following),
            (Teleoperating, Event::OpTeleprogram) => (Line::Redraw, Teleprogramming),
            (Teleoperating, Event::OpGoalReached) if !self.pending => (Line::Arrive, End),
            (Teleoperating, Event::LocalEvent) => (Line::HandBack, Asking),
            (Teleprogramming, Event::LocalEvent) => (Line::GiveUp, Asking),
            (Planning | Following | Asking | Teleprogramming | Teleoperating, Event::GsAbort) => {
                (Line::Abort, Idle)
            }
            (state, Event::CameraLost) if self.camera => {
                self.camera = false;
                (Line::CameraLost, state)
            }
            (state, Event::CameraBack) if !self.camera => {
                self.camera = true;
                (Line::CameraBack, state)
            }
            (state, Event::WifiLost) if self.wifi => {
                self.wifi = false;
                (Line::WifiLost, state)
            }
            (state, Event::WifiBack) if !self.wifi => {
                self.wifi = true;
                (Line::WifiBack, state)
            }
            (state, Event::Report) if !self.pending => {
                self.pending = true;
                (Line::Report, state)
            }
            (state, Event::ReportDone) if self.pending => {
                self.pending = false;
                (Line::ReportDone, state)
            }
            _ => return None,
        };
        self.state = next;
        Some(line)
    }

    /// Fires what fires by itself; how often.
    #[inline]
    fn settle(&mut self) -> u32 {
        let mut settled = 0;
        loop {
            self.state = match self.state {
                State::End => State::Idle,
                State::Teleoperating if !self.wifi => State::Asking,
                _ => return settled,
            };
            settled += 1;
        }
    }
}

impl Supervisor for Drive {
    fn new() -> Self {
        Self { state: State::Idle, camera: true, wifi: true, pending: false }
    }

    #[inline]
    fn offer(&mut self, _: u64, event: Event) -> Outcome {
        let line = self.step(event)?;
        Some((line, self.settle()))
    }

    #[inline]
    fn state(&self) -> State {
        self.state
    }
}
