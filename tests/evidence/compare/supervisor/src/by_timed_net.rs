//! With `net!`, with four transitions on time: what clocks add.

use crate::{Event, Line, Outcome, State, Supervisor};
use cotama_core::net;
use cotama_core::player::Outcome::{Fired, Ignored, Refused};
use cotama_core::units::Millis;

net! {
    /// The local supervisor of Drive, which does not wait for ever.
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
            NoPath:                                         Planning => Asking after 10_000 ms;
            NoChoice:                                       Asking => Idle after 60_000 ms;
            NoDrawing:                                  Teleprogramming => Asking after 300_000 ms;
            NoDriving:                                      Teleoperating => Asking after 30_000 ms;
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

impl Supervisor for drive::Player {
    fn new() -> Self {
        Self::default()
    }

    #[inline]
    fn offer(&mut self, now: u64, event: Event) -> Outcome {
        match Self::offer(self, Millis(now), &event.into()) {
            // Which line is not asked for: only the cost is.
            Fired { settled, .. } => Some((Line::Start, settled)),
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
