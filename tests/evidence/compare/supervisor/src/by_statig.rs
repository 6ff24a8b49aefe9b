//! With `statig`: a handler for each state, superstates for what several have in common. It knows
//! no transitions that fire by themselves, so an event of its own asks for them.

use crate::{Event, Line, Outcome as Offered, State as Named, Supervisor};
use statig::blocking::*;

/// The input of the handlers.
#[derive(Clone, Copy, Debug)]
pub enum Input {
    /// An event from outside.
    Event(Event),
    /// Time to settle.
    Settle,
}

/// The supervisor.
#[derive(Debug)]
pub struct Drive {
    camera: bool,
    wifi: bool,
    pending: bool,
}

/// Says which line fires, and moves.
fn go(fired: &mut Option<Line>, line: Line, to: State) -> Outcome<State> {
    *fired = Some(line);
    Transition(to)
}

/// Says which line fires, and stays.
fn stay(fired: &mut Option<Line>, line: Line) -> Outcome<State> {
    *fired = Some(line);
    Handled
}

#[state_machine(initial = "State::idle()", state(derive(Debug)), superstate(derive(Debug)))]
impl Drive {
    #[state(superstate = "any")]
    fn idle(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::StartDrive) => go(context, Line::Start, State::planning()),
            _ => Super,
        }
    }

    #[state(superstate = "driving")]
    fn planning(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::PathReady) => go(context, Line::Follow, State::following()),
            Input::Event(Event::LocalEvent) => go(context, Line::AskPlanning, State::asking()),
            _ => Super,
        }
    }

    #[state(superstate = "driving")]
    fn following(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::GoalReached) if !self.pending => {
                go(context, Line::Reach, State::end())
            }
            Input::Event(Event::LocalEvent) => go(context, Line::AskFollowing, State::asking()),
            _ => Super,
        }
    }

    #[state(superstate = "driving")]
    fn asking(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::OpTeleprogram) => {
                go(context, Line::Teleprogram, State::teleprogramming())
            }
            Input::Event(Event::OpTeleoperate) if self.camera && self.wifi => {
                go(context, Line::Teleoperate, State::teleoperating())
            }
            _ => Super,
        }
    }

    #[state(superstate = "driving")]
    fn teleprogramming(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::OpWaypoints) => go(context, Line::Plan, State::planning()),
            Input::Event(Event::OpPath) => go(context, Line::Take, State::following()),
            Input::Event(Event::LocalEvent) => go(context, Line::GiveUp, State::asking()),
            _ => Super,
        }
    }

    #[state(superstate = "driving")]
    fn teleoperating(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::OpTeleprogram) => {
                go(context, Line::Redraw, State::teleprogramming())
            }
            Input::Event(Event::OpGoalReached) if !self.pending => {
                go(context, Line::Arrive, State::end())
            }
            Input::Event(Event::LocalEvent) => go(context, Line::HandBack, State::asking()),
            Input::Settle if !self.wifi => go(context, Line::LoseLink, State::asking()),
            _ => Super,
        }
    }

    #[state(superstate = "any")]
    fn end(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Settle => go(context, Line::Finish, State::idle()),
            Input::Event(_) => Super,
        }
    }

    #[superstate(superstate = "any")]
    fn driving(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::GsAbort) => go(context, Line::Abort, State::idle()),
            _ => Super,
        }
    }

    #[superstate]
    fn any(&mut self, context: &mut Option<Line>, event: &Input) -> Outcome<State> {
        match event {
            Input::Event(Event::CameraLost) if self.camera => {
                self.camera = false;
                stay(context, Line::CameraLost)
            }
            Input::Event(Event::CameraBack) if !self.camera => {
                self.camera = true;
                stay(context, Line::CameraBack)
            }
            Input::Event(Event::WifiLost) if self.wifi => {
                self.wifi = false;
                stay(context, Line::WifiLost)
            }
            Input::Event(Event::WifiBack) if !self.wifi => {
                self.wifi = true;
                stay(context, Line::WifiBack)
            }
            Input::Event(Event::Report) if !self.pending => {
                self.pending = true;
                stay(context, Line::Report)
            }
            Input::Event(Event::ReportDone) if self.pending => {
                self.pending = false;
                stay(context, Line::ReportDone)
            }
            _ => Handled,
        }
    }
}

/// Hands an input to the machine; the line that fired.
#[inline]
fn fire(machine: &mut InitializedStateMachine<Drive>, input: Input) -> Option<Line> {
    let mut fired = None;
    machine.handle_with_context(&input, &mut fired);
    fired
}

impl Supervisor for InitializedStateMachine<Drive> {
    fn new() -> Self {
        let drive = Drive { camera: true, wifi: true, pending: false };
        drive.uninitialized_state_machine().init_with_context(&mut None)
    }

    #[inline]
    fn offer(&mut self, _: u64, event: Event) -> Offered {
        let line = fire(self, Input::Event(event))?;
        let mut settled = 0;
        while fire(self, Input::Settle).is_some() {
            settled += 1;
        }
        Some((line, settled))
    }

    #[inline]
    fn state(&self) -> Named {
        match InitializedStateMachine::state(self) {
            State::Idle {} => Named::Idle,
            State::Planning {} => Named::Planning,
            State::Following {} => Named::Following,
            State::Asking {} => Named::Asking,
            State::Teleprogramming {} => Named::Teleprogramming,
            State::Teleoperating {} => Named::Teleoperating,
            State::End {} => Named::End,
        }
    }
}
