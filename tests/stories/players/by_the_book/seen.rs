//! Counts of a story, so that none goes blind.

use super::Act;
use cotama_core::net::TransitionId;
use cotama_core::player::{Outcome, Round, Why};
use cotama_core::system::{Of, System};
use cotama_tests::textbook::{Game, Told};

/// How often a story has seen what.
#[derive(Debug, Default)]
pub(crate) struct Seen {
    pub(crate) fired: u32,
    pub(crate) settled: u32,
    pub(crate) by_itself: u32,
    pub(crate) on_purpose: u32,
    pub(crate) not_enabled: u32,
    pub(crate) too_early: u32,
    pub(crate) too_late: u32,
    pub(crate) full: u32,
    pub(crate) endless: u32,
    pub(crate) bounded: u32,
    pub(crate) state_machines: u32,
    pub(crate) words: [u32; 5],
    pub(crate) systems: Together,
}

/// Counts of events that happen only where nets work together.
#[derive(Debug, Default)]
pub(crate) struct Together {
    pub(crate) refused: u32,
    /// Transitions of other nets that an offered event made fire: by a rendezvous, or by
    /// themselves.
    pub(crate) met: u32,
    pub(crate) enabled: u32,
    pub(crate) ignored: u32,
    pub(crate) mailed: u32,
    pub(crate) cleared: u32,
    /// Events read in rounds.
    pub(crate) read: u32,
    pub(crate) unread: u32,
    pub(crate) waiting: u32,
    /// Transitions that were due, or enabled without an interval, and waited for room in a mailbox.
    pub(crate) blocked: u32,
    pub(crate) blocked_at_once: u32,
}

impl Seen {
    /// A story that saw too little would prove nothing.
    pub(crate) fn assert_enough(&self) {
        let outcomes = [self.fired, self.settled, self.on_purpose, self.not_enabled, self.full];
        assert!(outcomes.iter().all(|&it| it > 5_000), "{self:?}");
        let nets = [self.endless, self.bounded, self.state_machines];
        assert!(nets.iter().all(|&it| it > 500), "{self:?}");
        assert!(self.words[1..].iter().all(|&it| it > 100), "{self:?}");
    }

    /// The same of nets that work together.
    pub(crate) fn assert_enough_together(&self) {
        let outcomes = [self.fired, self.settled, self.on_purpose, self.not_enabled, self.full];
        let timed = [self.by_itself, self.too_early, self.too_late];
        let it = &self.systems;
        let mail = [it.refused, it.mailed, it.cleared, it.read, it.unread, it.waiting];
        let others = [it.met, it.enabled, it.ignored, it.blocked];
        let often = [&outcomes[..], &timed, &mail, &others].concat();
        assert!(often.iter().all(|&it| it > 4_000), "{self:?}");
        assert!(it.blocked_at_once > 1_000 && self.endless > 100, "{self:?}");
        assert!(self.words[2] > 1_000 && self.words[4] > 500, "{self:?}");
    }

    pub(crate) fn outcome<T>(&mut self, outcome: &Outcome<T>) {
        let of = match outcome {
            Outcome::Fired { settled, .. } => {
                self.settled += u32::from(*settled > 0);
                &mut self.fired
            }
            Outcome::Ignored { why } => match why {
                Why::OnPurpose => &mut self.on_purpose,
                Why::NotEnabled => &mut self.not_enabled,
                Why::TooEarly(_) => &mut self.too_early,
                Why::TooLate(_) => &mut self.too_late,
                Why::Full(_) => &mut self.full,
                Why::Behind | Why::NoSuchEvent => panic!("not by the book"),
            },
            Outcome::Refused { .. } => &mut self.systems.refused,
        };
        *of += 1;
    }

    /// Counts the events reported because of this act.
    pub(crate) fn told(&mut self, act: Act, told: &[Told], system: &System<'_>) {
        let at_once = |of: Of<TransitionId>| {
            let net = system.components[usize::from(of.component)].net;
            net.transitions[of.id.0 as usize].within.is_none()
        };
        let to = if let Act::Offer(to, _) = act { Some(to) } else { None };
        let it = &mut self.systems;
        for told in told {
            match *told {
                Told::Fired(id, on, ..) => {
                    let elsewhere = to.is_some_and(|it| it.component != id.component);
                    it.met += u32::from(elsewhere && on.is_some());
                    it.enabled += u32::from(elsewhere && on.is_none() && at_once(id));
                }
                Told::Ignored(event, _) => it.ignored += u32::from(Some(event) != to),
                Told::Mailed(..) => it.mailed += 1,
                Told::Cleared(..) => it.cleared += 1,
            }
        }
    }

    pub(crate) fn round(&mut self, round: Round) {
        self.systems.read += round.fired;
        self.systems.unread += round.ignored;
        self.systems.waiting += round.waiting;
    }

    /// Counts the transitions that can fire by themselves and have not.
    pub(crate) fn blocked(&mut self, game: &Game<'_>) {
        let waits = |timed: bool| {
            let mut lines = game.book.lines.iter().enumerate();
            lines.any(|(at, it)| {
                it.on.is_none() && it.within.is_some() == timed && game.can_fire(at)
            })
        };
        self.systems.blocked += u32::from(waits(true));
        self.systems.blocked_at_once += u32::from(waits(false));
    }
}
