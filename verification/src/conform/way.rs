//! One way in which a recording can be meant: a player that was told it so far.

use super::allowed::{Allowed, offered, window};
use super::departure::{Refused, unused};
use super::pending::{Pending, Stop};
use super::read::{Line, What, may_follow};
use super::rules::{Rules, Seen};
use super::verdict::Verdict;
use crate::play::{Fired, Game, Unused};
use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::Why;
use cotama_core::units::Millis;
use std::collections::VecDeque;

/// The most rounds that follow one another at one instant because something waits.
const MOST_ROUNDS: usize = 1_000;
/// The most transitions that fire by themselves at one instant.
const MOST_FIRINGS: usize = 200_000;

/// A game that follows a recording.
pub(super) struct Way<'c> {
    pub(super) game: Box<dyn Game<'c> + 'c>,
    pub(super) pending: VecDeque<Pending>,
    pub(super) next_round: Millis,
    /// The position of an event that is recorded and not yet told: what is recorded behind it at
    /// the same instant may have come before it.
    pub(super) untold: Option<usize>,
    /// The last event that nothing used, and why.
    unused: Option<(String, String)>,
    pub(super) counts: Verdict,
}

impl Clone for Way<'_> {
    fn clone(&self) -> Self {
        Self {
            game: self.game.fork(),
            pending: self.pending.clone(),
            next_round: self.next_round,
            untold: self.untold,
            unused: self.unused.clone(),
            counts: self.counts.clone(),
        }
    }
}

impl<'c> Way<'c> {
    pub(super) fn new(
        rules: &Rules<'_>,
        game: Box<dyn Game<'c> + 'c>,
        start: Millis,
        fired: &[Fired],
    ) -> Self {
        let mut way = Self {
            game,
            pending: VecDeque::new(),
            next_round: start,
            untold: None,
            unused: None,
            counts: Verdict::default(),
        };
        way.hear(rules, fired, false);
        way
    }

    /// The ways in which this one goes on with a line whose time has come, or why it does not.
    pub(super) fn follow(
        mut self,
        rules: &Rules<'_>,
        lines: &[Line],
        at: usize,
        next: &mut Vec<Self>,
        stops: &mut Vec<Stop>,
    ) {
        let Some(line) = lines.get(at) else { return };
        let is_answer = matches!(line.what, What::Fired(_) | What::Output(_));
        // The same way with the event told before this line is there as well.
        if self.untold.is_some() && !is_answer {
            return;
        }
        match &line.what {
            What::Event { .. } if self.may_wait(rules, lines, at) => {
                self.clone().tell_and_go_on(rules, line, next, stops);
                self.untold = Some(at);
                next.push(self);
            }
            What::Event { .. } => self.tell_and_go_on(rules, line, next, stops),
            What::Fired(name) => {
                let (mut after, waits) = (Vec::new(), self.untold);
                self.fired(rules, line.at, name, &mut after, stops);
                for way in after {
                    way.go_on(rules, lines, at, waits, next, stops);
                }
            }
            What::Output(name) => {
                let waits = self.untold;
                match self.said(rules, line.at, name) {
                    Ok(()) => self.go_on(rules, lines, at, waits, next, stops),
                    Err(stop) => stops.push(stop),
                }
            }
            What::Round => match self.round(rules, line.at) {
                Ok(()) => self.settle(rules, line.at, next, stops),
                Err(stop) => stops.push(stop),
            },
            What::End => match self.pending.front() {
                Some(first) => stops.push(first.missing(rules, "")),
                None => self.settle(rules, line.at, next, stops),
            },
        }
    }

    /// Goes on after an answer: the event that waits is told now, or after the next answer.
    fn go_on(
        mut self,
        rules: &Rules<'_>,
        lines: &[Line],
        at: usize,
        waits: Option<usize>,
        next: &mut Vec<Self>,
        stops: &mut Vec<Stop>,
    ) {
        let event = waits.and_then(|it| lines.get(it).map(|line| (it, line)));
        let Some((position, event)) = event else {
            return self.settle(rules, lines[at].at, next, stops);
        };
        if may_follow(lines, at, event.at) {
            next.push(Self { untold: Some(position), ..self.clone() });
        }
        self.untold = None;
        self.tell_and_go_on(rules, event, next, stops);
    }

    /// Whether an event may be told after the next line: where that is a firing at the same instant
    /// that nothing makes happen.
    fn may_wait(&self, rules: &Rules<'_>, lines: &[Line], at: usize) -> bool {
        let Some(What::Fired(name)) = lines.get(at + 1).map(|it| &it.what) else { return false };
        let ids = rules.names.transitions(name);
        may_follow(lines, at, lines[at].at)
            && (!self.pending.is_empty()
                || ids.iter().any(|&id| rules.numbered.choice(id).is_some()))
    }

    fn tell_and_go_on(
        mut self,
        rules: &Rules<'_>,
        line: &Line,
        next: &mut Vec<Self>,
        stops: &mut Vec<Stop>,
    ) {
        let What::Event { name, ignored } = &line.what else { return };
        match self.tell(rules, line.at, name, *ignored) {
            Ok(()) => self.settle(rules, line.at, next, stops),
            Err(stop) => stops.push(stop),
        }
    }

    /// Goes on once it is at rest.
    fn settle(
        mut self,
        rules: &Rules<'_>,
        at: Millis,
        next: &mut Vec<Self>,
        stops: &mut Vec<Stop>,
    ) {
        match self.rest(rules, at) {
            Ok(()) => next.push(self),
            Err(stop) => stops.push(stop),
        }
    }

    /// Lets rounds take place as long as something waits, where rounds are not recorded.
    pub(super) fn rest(&mut self, rules: &Rules<'_>, at: Millis) -> Result<(), Stop> {
        let mut rounds = 0;
        while rules.rounds_when_due && self.game.round_is_due() {
            rounds += 1;
            if rounds > MOST_ROUNDS {
                return Err(Stop::Refused(Refused::Endless(at)));
            }
            self.round(rules, at)?;
        }
        Ok(())
    }

    pub(super) fn departs(&self, rules: &Rules<'_>, reason: String) -> Stop {
        Stop::Departs(reason, Allowed::of(rules.numbered, &*self.game))
    }

    fn tell(
        &mut self,
        rules: &Rules<'_>,
        at: Millis,
        name: &str,
        ignored: Option<bool>,
    ) -> Result<(), Stop> {
        let event = rules.names.event(name);
        let before = (ignored == Some(true)).then(|| self.game.fork());
        let mut fired = Vec::new();
        match (self.game.offer(at, event, &mut fired), before) {
            (Ok(transition), Some(before)) => {
                let by = rules.numbered.transition(transition);
                let reason = format!("`{name}` is recorded as ignored, and `{by}` fires on it");
                self.game = before;
                return Err(self.departs(rules, reason));
            }
            (Ok(_), None) => self.hear(rules, &fired, false),
            (Err(why), _) => {
                self.hear(rules, &fired, false);
                let why = unused(rules.numbered, &*self.game, event, why);
                if ignored == Some(false) {
                    let reason = format!("`{name}` is told, and nothing fires on it: {why}");
                    return Err(self.departs(rules, reason));
                }
                self.unused = Some((name.to_owned(), why));
            }
        }
        self.counts.events += 1;
        Ok(())
    }

    /// One way for each transition that can be meant.
    fn fired(
        &mut self,
        rules: &Rules<'_>,
        at: Millis,
        name: &str,
        next: &mut Vec<Self>,
        stops: &mut Vec<Stop>,
    ) {
        let ids = rules.names.transitions(name);
        if ids.iter().all(|&id| rules.seen(id) == Seen::Never) {
            return next.push(self.clone());
        }
        if let Some(first) = self.pending.front().copied() {
            if first.output.is_some() || !ids.contains(&TransitionId(first.by)) {
                let before = format!("`{name}` fired, and before it ");
                return stops.push(first.missing(rules, &before));
            }
            let mut way = self.clone();
            way.pending.pop_front();
            way.counts.fired += 1;
            return next.push(way);
        }
        let mut refused = None;
        for &id in ids {
            let Some(choice) = rules.numbered.choice(id) else { continue };
            let (mut way, mut fired) = (self.clone(), Vec::new());
            match way.game.offer(at, choice, &mut fired) {
                Ok(_) => {
                    way.hear(rules, &fired, true);
                    way.counts.fired += 1;
                    next.push(way);
                }
                Err(why) => _ = refused.get_or_insert((id, why)),
            }
        }
        if next.is_empty() {
            stops.push(match (refused, ids.first()) {
                (Some((id, why)), _) => self.cannot(rules, at, name, id, why),
                (None, id) => self.unasked(rules, name, id.copied().unwrap_or(TransitionId(0))),
            });
        }
    }

    fn said(&mut self, rules: &Rules<'_>, at: Millis, name: &str) -> Result<(), Stop> {
        let output = rules.names.output(name);
        let first = self.pending.front().copied();
        match first {
            Some(first) if first.output.is_some() && first.output == output => {
                self.pending.pop_front();
                self.counts.outputs += 1;
                Ok(())
            }
            // Outputs of nets whose firings are not recorded are not compared.
            _ if output.is_none_or(|it| rules.says.iter().all(|said| !said.contains(&it)))
                && rules.names.is_said(output) =>
            {
                Ok(())
            }
            Some(first) => Err(first.missing(rules, &format!("`{name}` is said, and before it "))),
            None => {
                let reason = format!("`{name}` is said at {} ms, and nothing says it here", at.0);
                Err(self.departs(rules, reason))
            }
        }
    }

    /// Reports a chosen transition that cannot fire.
    fn cannot(
        &self,
        rules: &Rules<'_>,
        at: Millis,
        name: &str,
        id: TransitionId,
        why: Unused,
    ) -> Stop {
        if let Unused::Ignored(Why::TooEarly(_)) = why
            && let Some((earliest, _)) = window(rules.numbered, &*self.game, id)
        {
            let reason = format!(
                "`{name}` fired at {} ms, too early: it could not fire before {} ms",
                at.0, earliest.0
            );
            return self.departs(rules, reason);
        }
        let event = rules.numbered.choice(id).unwrap_or(EventId(u32::MAX));
        let why = unused(rules.numbered, &*self.game, event, why);
        self.departs(rules, format!("`{name}` fired, and could not: {why}"))
    }

    /// Reports a recorded transition that nothing made fire.
    fn unasked(&self, rules: &Rules<'_>, name: &str, id: TransitionId) -> Stop {
        let reason = match (rules.numbered.needs_event(id), &self.unused) {
            (Some(event), Some((last, why))) if *last == event => {
                format!("`{name}` fired, but the model does not use `{event}` here: {why}")
            }
            (Some(event), _) => {
                format!("`{name}` fired, and nothing made it fire: it fires on `{event}`")
            }
            (None, _) => format!(
                "`{name}` fired, and nothing made it fire: it fires as soon as it is enabled"
            ),
        };
        self.departs(rules, reason)
    }

    /// The next instant up to a line at which the way cannot just let time pass: a round that is
    /// not in vain, or the line.
    pub(super) fn stop_before(&mut self, rules: &Rules<'_>, line: Millis) -> (Millis, bool) {
        let Some(Millis(every)) = rules.round_every else { return (line, false) };
        if self.next_round > line {
            return (line, false);
        }
        // A round in which nothing waits does nothing.
        let due = if self.game.round_is_due() {
            self.next_round
        } else {
            self.game.wake_at().unwrap_or(Millis(u64::MAX))
        };
        let left_out = due.0.min(line.0 + 1).saturating_sub(self.next_round.0).div_ceil(every);
        self.count_rounds(left_out, every);
        if self.next_round <= line { (self.next_round, true) } else { (line, false) }
    }

    /// Leaves out the rounds up to an instant, in which nothing waits.
    pub(super) fn leave_out_rounds(&mut self, rules: &Rules<'_>, at: Millis) {
        if let Some(Millis(every)) = rules.round_every {
            self.count_rounds((at.0 + 1).saturating_sub(self.next_round.0).div_ceil(every), every);
        }
    }

    fn count_rounds(&mut self, rounds: u64, every: u64) {
        self.counts.rounds += rounds;
        self.next_round = Millis(self.next_round.0.saturating_add(rounds * every));
    }

    /// Lets time pass, and nothing that had to happen may be missing then.
    pub(super) fn pass(
        &mut self,
        rules: &Rules<'_>,
        at: Millis,
        line: Option<&Line>,
    ) -> Result<(), Stop> {
        let says = |id: TransitionId| {
            matches!(line, Some(Line { what: What::Fired(it), .. })
                if rules.names.transitions(it).contains(&id))
        };
        if let Some(&first) = self.pending.front()
            && first.at.saturating_add(rules.tolerance) < at.0
        {
            let id = TransitionId(first.by);
            if first.output.is_none() && says(id) {
                let name = rules.numbered.transition(id);
                let reason = format!(
                    "`{name}` fired at {} ms, too late: it had to fire at {} ms",
                    at.0, first.at
                );
                return Err(Stop::Departs(reason, first.must(rules)));
            }
            return Err(first.missing(rules, ""));
        }
        if at > self.game.now()
            && let Some((latest, id)) = self.overdue(rules, at)
        {
            let name = rules.numbered.transition(id);
            let had = format!("had to fire by {} ms", latest.0);
            let reason = match rules.says(id).first() {
                _ if says(id) => format!("`{name}` fired at {} ms, too late: it {had}", at.0),
                Some(&said) if rules.seen(id) == Seen::Never => {
                    format!("`{name}` {had} and to say `{}`", rules.names.said(said))
                }
                _ => format!("`{name}` {had}"),
            };
            return Err(self.departs(rules, reason));
        }
        loop {
            let mut fired = Vec::new();
            let behind = self.game.advance(at, &mut fired);
            self.hear(rules, &fired, false);
            if !behind {
                return Ok(());
            }
            if self.pending.len() > MOST_FIRINGS {
                return Err(Stop::Refused(Refused::Endless(self.game.now())));
            }
        }
    }

    /// Returns the transition that should have fired before, and its latest time.
    fn overdue(&self, rules: &Rules<'_>, at: Millis) -> Option<(Millis, TransitionId)> {
        let late = |at: Millis, event| {
            matches!(offered(&*self.game, at, event), Err(Unused::Ignored(Why::TooLate(_))))
        };
        let overdue = rules.forced.iter().filter_map(|&id| {
            let event = rules.numbered.choice(id)?;
            if !late(at, event) || late(self.game.now(), event) {
                return None;
            }
            let (_, latest) = window(rules.numbered, &*self.game, id)?;
            // A transition that waits for room in a mailbox does not have to fire.
            offered(&*self.game, latest?, event).ok()?;
            Some((latest?, id))
        });
        overdue.min()
    }

    pub(super) fn round(&mut self, rules: &Rules<'_>, at: Millis) -> Result<(), Stop> {
        let mut fired = Vec::new();
        let behind = self.game.round(at, &mut fired);
        self.hear(rules, &fired, false);
        self.counts.rounds += 1;
        if behind { Err(Stop::Refused(Refused::Endless(at))) } else { Ok(()) }
    }

    /// Takes note of what fired; whether the first of it is recorded already, or never is.
    pub(super) fn hear(&mut self, rules: &Rules<'_>, fired: &[Fired], first_is_known: bool) {
        for (number, it) in fired.iter().enumerate() {
            let (by, at) = (it.transition.0, it.at.0);
            let known = first_is_known && number == 0;
            if !known && rules.seen(it.transition) == Seen::Always {
                self.pending.push_back(Pending { by, output: None, at });
            }
            let said = rules.says(it.transition).iter();
            self.pending.extend(said.map(|&output| Pending { by, output: Some(output), at }));
        }
    }
}
