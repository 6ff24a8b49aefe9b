//! With `net!`.

use crate::{Event, Line, Outcome, State, Supervisor};
use cotama_core::net;
use cotama_core::player::Outcome::{Fired, Ignored, Refused};
use cotama_core::units::Millis;

net! {
    /// The local supervisor of Drive.
    pub mod drive {
        places { Idle: 1, Planning, Following, Asking, Teleprogramming, Teleoperating, End }
        flags { camera: true, wifi: true, pending }
        events {
            StartDrive, PathReady, GoalReached, LocalEvent, OpTeleprogram, OpTeleoperate,
            OpWaypoints, OpPath,
            OpGoalReached, GsAbort, CameraLost, CameraBack, WifiLost, WifiBack, Report, ReportDone,
        }
        groups { Driving: Planning & Following & Asking & Teleprogramming & Teleoperating; }
        transitions {
            Start        on StartDrive:                     Idle => Planning;
            Follow       on PathReady:                      Planning => Following;
            Reach        on GoalReached [!pending]:         Following => End;
            AskPlanning  on LocalEvent:                     Planning => Asking;
            AskFollowing on LocalEvent:                     Following => Asking;
            Teleprogram  on OpTeleprogram:                  Asking => Teleprogramming;
            Teleoperate  on OpTeleoperate [camera & wifi]:  Asking => Teleoperating;
            Plan         on OpWaypoints:                    Teleprogramming => Planning;
            Take         on OpPath:                         Teleprogramming => Following;
            Redraw       on OpTeleprogram:                  Teleoperating => Teleprogramming;
            Arrive       on OpGoalReached [!pending]:       Teleoperating => End;
            HandBack     on LocalEvent:                     Teleoperating => Asking;
            GiveUp       on LocalEvent:                     Teleprogramming => Asking;
            Finish:                                         End => Idle;
            LoseLink     [!wifi]:                           Teleoperating => Asking;
            Abort        on GsAbort:                        Driving => Idle;
            CameraLost   on CameraLost [camera]:            _ => _ do camera = false;
            CameraBack   on CameraBack [!camera]:           _ => _ do camera = true;
            WifiLost     on WifiLost [wifi]:                _ => _ do wifi = false;
            WifiBack     on WifiBack [!wifi]:               _ => _ do wifi = true;
            Report       on Report [!pending]:              _ => _ do pending = true;
            ReportDone   on ReportDone [pending]:           _ => _ do pending = false;
        }
    }
}

impl From<Event> for drive::Event {
    #[inline]
    fn from(event: Event) -> Self {
        match event {
            Event::StartDrive => Self::StartDrive,
            Event::PathReady => Self::PathReady,
            Event::GoalReached => Self::GoalReached,
            Event::LocalEvent => Self::LocalEvent,
            Event::OpTeleprogram => Self::OpTeleprogram,
            Event::OpTeleoperate => Self::OpTeleoperate,
            Event::OpWaypoints => Self::OpWaypoints,
            Event::OpPath => Self::OpPath,
            Event::OpGoalReached => Self::OpGoalReached,
            Event::GsAbort => Self::GsAbort,
            Event::CameraLost => Self::CameraLost,
            Event::CameraBack => Self::CameraBack,
            Event::WifiLost => Self::WifiLost,
            Event::WifiBack => Self::WifiBack,
            Event::Report => Self::Report,
            Event::ReportDone => Self::ReportDone,
        }
    }
}

impl From<drive::Transition> for Line {
    #[inline]
    fn from(line: drive::Transition) -> Self {
        use drive::Transition as Of;
        match line {
            Of::Start => Self::Start,
            Of::Follow => Self::Follow,
            Of::Reach => Self::Reach,
            Of::AskPlanning => Self::AskPlanning,
            Of::AskFollowing => Self::AskFollowing,
            Of::Teleprogram => Self::Teleprogram,
            Of::Teleoperate => Self::Teleoperate,
            Of::Plan => Self::Plan,
            Of::Take => Self::Take,
            Of::Redraw => Self::Redraw,
            Of::Arrive => Self::Arrive,
            Of::HandBack => Self::HandBack,
            Of::GiveUp => Self::GiveUp,
            Of::Finish => Self::Finish,
            Of::LoseLink => Self::LoseLink,
            Of::Abort => Self::Abort,
            Of::CameraLost => Self::CameraLost,
            Of::CameraBack => Self::CameraBack,
            Of::WifiLost => Self::WifiLost,
            Of::WifiBack => Self::WifiBack,
            Of::Report => Self::Report,
            Of::ReportDone => Self::ReportDone,
        }
    }
}

impl Supervisor for drive::Player {
    fn new() -> Self {
        Self::default()
    }

    #[inline]
    fn offer(&mut self, now: u64, event: Event) -> Outcome {
        match Self::offer(self, Millis(now), &event.into()) {
            Fired { transition, settled } => Some((transition.into(), settled)),
            Ignored { .. } | Refused { .. } => None,
        }
    }

    #[inline]
    fn state(&self) -> State {
        match Self::state(self) {
            drive::State::Idle => State::Idle,
            drive::State::Planning => State::Planning,
            drive::State::Following => State::Following,
            drive::State::Asking => State::Asking,
            drive::State::Teleprogramming => State::Teleprogramming,
            drive::State::Teleoperating => State::Teleoperating,
            drive::State::End => State::End,
        }
    }
}
