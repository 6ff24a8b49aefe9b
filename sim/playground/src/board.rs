//! A run of a system that goes forth and back.

use super::coded::decode;
use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use cotama_core::net::EventId;
use cotama_core::units::Millis;
use cotama_play::{Endless, MOST_FIRINGS, Numbered, Record, Saved, Session};

/// The most steps of a run.
pub const MOST_STEPS: usize = 1 << 20;
/// So many steps are played anew at most to go back: each state that is kept takes some kilobytes.
const KEPT_EACH: usize = 64;
/// The last millisecond that a page can name: the largest whole number that it counts exactly.
const LAST: u64 = (1 << 53) - 1;

/// Time passes up to `at`; then an event is offered, or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Step {
    at: Millis,
    event: Option<EventId>,
}

/// Why a step was not done; the board is as it was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// More than [`MOST_FIRINGS`] transitions would fire.
    Endless,
    /// The run has [`MOST_STEPS`] steps.
    Full,
    /// There is no such event, or time would go back.
    Unknown,
}

/// A run of a system, from its start, and where in it one is.
///
/// ```
/// use cotama_core::net::EventId;
/// use cotama_core::system::{Component, System};
/// use cotama_core::units::Millis;
/// use cotama_models::nets::door;
/// use cotama_playground::{Board, encode};
/// let bytes = encode(&System::alone(&[Component::alone(&door::NET)]));
/// let mut board = Board::of(&bytes, false).unwrap();
/// let start = board.session().marking().to_vec();
/// let records = board.tell(Some(EventId(0)), Millis(500)).unwrap();
/// assert_eq!((records.len(), board.at()), (1, 1));
/// board.go(0);
/// assert_eq!((board.session().marking(), board.steps()), (start.as_slice(), 1));
/// ```
pub struct Board {
    session: Session<'static, 'static>,
    steps: Vec<Step>,
    at: usize,
    /// The states after 0, [`KEPT_EACH`], .. steps.
    kept: Vec<Saved<'static>>,
    started: Vec<Record>,
}

impl Board {
    /// A board for the system in these bytes. With `rounds` each step of a system is a round, as
    /// `cotama simulate --rounds` plays it; without, a round follows as soon as something waits in
    /// a mailbox. In a plain net, without events and time, each transition gets an event of its
    /// name.
    ///
    /// The memory is never given back: a page has one board.
    ///
    /// # Errors
    /// Why it cannot be played, in words.
    pub fn of(bytes: &[u8], rounds: bool) -> Result<Self, String> {
        let system = decode(bytes).map_err(|it| it.to_string())?;
        let numbered = system.with(Numbered::of);
        let by_name = numbered.is_plain();
        let numbered = if by_name { numbered.choosing(|_| true, Millis(0)) } else { numbered };
        let (numbered, game, fired) = numbered.leak(Millis(0)).map_err(|it| it.to_string())?;
        let view: &'static _ = Box::leak(Box::new(numbered.whole().view()));
        let net: &'static _ = Box::leak(Box::new(view.net()));
        let mut session = Session::new(numbered, net, game, rounds && numbered.is_system());
        session.begin(&fired).map_err(|Endless| {
            format!("it does not come to rest: {MOST_FIRINGS} transitions fired at its start")
        })?;
        let started = session.take();
        let kept = Vec::from([session.save()]);
        Ok(Self { session, steps: Vec::new(), at: 0, kept, started })
    }

    /// Returns the records of the start, before anything is told.
    pub fn started(&self) -> &[Record] {
        &self.started
    }

    /// The session at this place of the run.
    pub fn session(&self) -> &Session<'static, 'static> {
        &self.session
    }

    /// The number of steps that were taken to come here.
    pub fn at(&self) -> usize {
        self.at
    }

    /// The number of steps of the run, those among them that were gone back over.
    pub fn steps(&self) -> usize {
        self.steps.len()
    }

    /// Lets time pass, then offers an event. What came after in the run is forgotten.
    ///
    /// # Errors
    /// Why nothing was done.
    pub fn tell(&mut self, event: Option<EventId>, at: Millis) -> Result<Vec<Record>, Refused> {
        let known = |EventId(it): EventId| (it as usize) < self.session.net().events.len();
        if !event.is_none_or(known) || at < self.session.now() || at.0 > LAST {
            return Err(Refused::Unknown);
        }
        if self.at >= MOST_STEPS {
            return Err(Refused::Full);
        }
        let before = self.session.save();
        let step = Step { at, event };
        let Ok(records) = played(&mut self.session, step) else {
            self.session.restore(before);
            return Err(Refused::Endless);
        };
        self.steps.truncate(self.at);
        self.kept.truncate(self.at / KEPT_EACH + 1);
        self.steps.push(step);
        self.at += 1;
        if self.at.is_multiple_of(KEPT_EACH) {
            self.kept.push(self.session.save());
        }
        Ok(records)
    }

    /// The same by numbers: 0 for no event, else the one before it; the halves of the time.
    ///
    /// # Errors
    /// Why nothing was done.
    pub fn tell_number(&mut self, event: u32, low: u32, high: u32) -> Result<Vec<Record>, Refused> {
        self.tell(event.checked_sub(1).map(EventId), time(low, high))
    }

    /// Returns the session in which an event that is told at this time would be offered: in
    /// rounds, after the turns of the nets.
    pub fn before_event(&self, at: Millis) -> Session<'static, 'static> {
        let mut next = self.session.fork();
        if next.apply(at.max(self.session.now()), &[]).is_err() {
            next = self.session.fork();
        }
        next
    }

    /// Why no transition would use an event that is told at this time, in words; none if one would.
    pub fn why(&self, event: u32, low: u32, high: u32) -> Option<String> {
        let at = time(low, high);
        self.before_event(at).prospect(EventId(event)).err().map(|it| it.text)
    }

    /// Goes to after so many steps, or to the end of the run.
    pub fn go(&mut self, to: usize) {
        let to = to.min(self.steps.len());
        let near = self.at <= to && to - self.at < KEPT_EACH;
        let from = if near {
            self.at
        } else {
            let kept = (to / KEPT_EACH).min(self.kept.len().saturating_sub(1));
            if let Some(saved) = self.kept.get(kept) {
                self.session.restore(saved.clone());
            }
            kept * KEPT_EACH
        };
        for step in self.steps.get(from..to).unwrap_or_default() {
            // The same step from the same state came to rest before.
            let again = played(&mut self.session, *step);
            debug_assert!(again.is_ok(), "a player does the same again");
        }
        self.at = to;
    }
}

/// A time of two halves.
pub(super) fn time(low: u32, high: u32) -> Millis {
    Millis(u64::from(high) << 32 | u64::from(low))
}

fn played(session: &mut Session<'_, '_>, step: Step) -> Result<Vec<Record>, Endless> {
    session.apply(step.at, step.event.as_slice())?;
    Ok(session.take())
}

#[cfg(test)]
mod tests {
    use super::{Board, Refused};
    use crate::answer::state;
    use crate::encode;
    use cotama_core::net::EventId;
    use cotama_core::system::{Component, System};
    use cotama_core::units::Millis;
    use cotama_models::nets::by_hand::delivery;
    use cotama_models::nets::crossing;
    use std::vec::Vec;

    /// Plays so many steps: events in turn, at times that grow unevenly.
    fn walked(board: &mut Board, steps: u32) -> Vec<Vec<u32>> {
        let events = board.session().net().events.len() as u32;
        let mut states = Vec::from([state(board, 0, 0)]);
        let mut at = 0;
        for step in 0..steps {
            at += u64::from(step * 37 % 900);
            let event = (step % 5 > 0).then_some(EventId(step * 7 % events));
            board.tell(event, Millis(at)).unwrap();
            states.push(state(board, at as u32, 0));
        }
        states
    }

    #[test]
    fn a_run_goes_back_and_on_to_the_same_states() {
        let crossing = [Component::alone(&crossing::NET)];
        for (system, rounds) in
            [(delivery::SYSTEM, true), (delivery::SYSTEM, false), (System::alone(&crossing), false)]
        {
            let mut board = Board::of(&encode(&system), rounds).unwrap();
            let states = walked(&mut board, 300);
            for to in (0..300_usize).map(|it| it * 131 % 301) {
                board.go(to);
                let now = board.session().now().0 as u32;
                let mut then = states[to].clone();
                then[1] = 300; // the steps of the whole run
                assert_eq!(state(&board, now, 0), then, "{} after {to}", system.name);
            }
        }
    }

    #[test]
    fn a_step_from_the_middle_forgets_what_came_after() {
        let mut board = Board::of(&encode(&delivery::SYSTEM), true).unwrap();
        walked(&mut board, 200);
        board.go(70);
        let now = board.session().now();
        board.tell(None, now).unwrap();
        assert_eq!((board.at(), board.steps()), (71, 71));
        board.go(400);
        assert_eq!(board.at(), 71);
    }

    #[test]
    fn an_unknown_event_and_an_earlier_time_change_nothing() {
        let mut board = Board::of(&encode(&delivery::SYSTEM), false).unwrap();
        board.tell(None, Millis(500)).unwrap();
        assert_eq!(board.tell(Some(EventId(9_999)), Millis(500)), Err(Refused::Unknown));
        assert_eq!(board.tell(None, Millis(499)), Err(Refused::Unknown));
        assert_eq!(board.tell(None, Millis(1 << 53)), Err(Refused::Unknown));
        assert_eq!((board.at(), board.session().now()), (1, Millis(500)));
    }
}
