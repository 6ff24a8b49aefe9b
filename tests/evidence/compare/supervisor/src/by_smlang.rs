//! With `smlang`: a table of transitions. It knows none that fire by themselves, so an event of its
//! own asks for them, and it does not say which one fired, so an action of each does.

use crate::{Event, Line, Outcome, State, Supervisor};
use smlang::statemachine;

statemachine! {
    derive_events: [Clone, Copy, Debug],
    derive_states: [Clone, Copy, Debug],
    transitions: {
        *Idle + StartDrive / start = Planning,
        Planning + PathReady / follow = Following,
        Following + GoalReached [!pending] / reach = End,
        Planning + LocalEvent / ask_planning = Asking,
        Following + LocalEvent / ask_following = Asking,
        Asking + OpTeleprogram / teleprogram = Teleprogramming,
        Asking + OpTeleoperate [camera && wifi] / teleoperate = Teleoperating,
        Teleprogramming + OpWaypoints / plan = Planning,
        Teleprogramming + OpPath / take = Following,
        Teleoperating + OpTeleprogram / redraw = Teleprogramming,
        Teleoperating + OpGoalReached [!pending] / arrive = End,
        Teleoperating + LocalEvent / hand_back = Asking,
        Teleprogramming + LocalEvent / give_up = Asking,
        End + Settle / finish = Idle,
        Teleoperating + Settle [!wifi] / lose_link = Asking,
        Planning | Following | Asking | Teleprogramming | Teleoperating + GsAbort / abort = Idle,
        _ + CameraLost [camera] / camera_lost = _,
        _ + CameraBack [!camera] / camera_back = _,
        _ + WifiLost [wifi] / wifi_lost = _,
        _ + WifiBack [!wifi] / wifi_back = _,
        _ + Report [!pending] / report = _,
        _ + ReportDone [pending] / report_done = _,
    }
}

/// The flags, and what fired last.
#[derive(Debug)]
pub struct Flags {
    camera: bool,
    wifi: bool,
    pending: bool,
    fired: Line,
}

/// Actions that say which line fired.
macro_rules! lines {
    ($($action:ident: $line:ident $(, $flag:ident = $value:literal)?;)*) => {$(
        #[inline]
        fn $action(&mut self) -> Result<(), ()> {
            $(self.$flag = $value;)?
            self.fired = Line::$line;
            Ok(())
        }
    )*};
}

impl StateMachineContext for Flags {
    #[inline]
    fn camera(&self) -> Result<bool, ()> {
        Ok(self.camera)
    }

    #[inline]
    fn wifi(&self) -> Result<bool, ()> {
        Ok(self.wifi)
    }

    #[inline]
    fn pending(&self) -> Result<bool, ()> {
        Ok(self.pending)
    }

    lines! {
        start: Start;
        follow: Follow;
        reach: Reach;
        ask_planning: AskPlanning;
        ask_following: AskFollowing;
        teleprogram: Teleprogram;
        teleoperate: Teleoperate;
        plan: Plan;
        take: Take;
        redraw: Redraw;
        arrive: Arrive;
        hand_back: HandBack;
        give_up: GiveUp;
        finish: Finish;
        lose_link: LoseLink;
        abort: Abort;
        camera_lost: CameraLost, camera = false;
        camera_back: CameraBack, camera = true;
        wifi_lost: WifiLost, wifi = false;
        wifi_back: WifiBack, wifi = true;
        report: Report, pending = true;
        report_done: ReportDone, pending = false;
    }
}

impl From<Event> for Events {
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

impl Supervisor for StateMachine<Flags> {
    fn new() -> Self {
        StateMachine::new(Flags { camera: true, wifi: true, pending: false, fired: Line::Start })
    }

    #[inline]
    fn offer(&mut self, _: u64, event: Event) -> Outcome {
        self.process_event(event.into()).ok()?;
        let line = self.context().fired;
        let mut settled = 0;
        while self.process_event(Events::Settle).is_ok() {
            settled += 1;
        }
        Some((line, settled))
    }

    #[inline]
    fn state(&self) -> State {
        match StateMachine::state(self) {
            States::Idle => State::Idle,
            States::Planning => State::Planning,
            States::Following => State::Following,
            States::Asking => State::Asking,
            States::Teleprogramming => State::Teleprogramming,
            States::Teleoperating => State::Teleoperating,
            States::End => State::End,
        }
    }
}
