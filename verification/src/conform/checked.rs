//! Tells a player again what was recorded.

use super::allowed::{Allowed, offered, window};
use super::departure::{Departure, Refused, unused};
use super::names::Names;
use super::read::{Line, Recording, What};
use crate::play::{Fired, Game, Numbered, Unused};
use cotama_core::net::{EventId, TransitionId};
use cotama_core::player::Why;
use cotama_core::system::System;
use cotama_core::units::Millis;
use std::collections::VecDeque;

/// The most rounds that follow one another at one instant because something waits.
const MOST_ROUNDS: usize = 1_000;
/// The most transitions that fire by themselves at one instant.
const MOST_FIRINGS: usize = 200_000;

/// How a recording is judged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// How far recorded dates may be from those of the model.
    pub tolerance: Millis,
}

/// What became of a recording.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verdict {
    /// How many events were told.
    pub events: u64,
    /// How many recorded firings are those of the model.
    pub fired: u64,
    /// How many rounds took place.
    pub rounds: u64,
    /// The date of the last line that is as the model.
    pub until: Millis,
    /// Where it is no run of the model; none when it is one.
    pub departs: Option<Departure>,
}

/// Whether a recording is a run of a system, or of a [net alone](System::alone).
///
/// # Errors
/// A [`Refused`] when that cannot be said.
///
/// ```
/// use cotama_core::net;
/// use cotama_core::system::{Component, System};
/// use cotama_verification::conform::{Options, Recording, conform};
///
/// net! {
///     /// Goes out by itself.
///     pub mod lamp {
///         places { Dark: 1, Lit }
///         events { press }
///         transitions { on on press: Dark => Lit; off: Lit => Dark within 5_000..=6_000 ms; }
///     }
/// }
/// let alone = [Component::alone(&lamp::NET)];
/// let told = |off: u64| {
///     let text = format!(
///         "{{\"t_ms\":9,\"event\":\"press\"}}\n{{\"t_ms\":9,\"fired\":\"on\"}}\n\
///          {{\"t_ms\":{off},\"fired\":\"off\"}}"
///     );
///     let recording = Recording::read("log", &text).unwrap();
///     conform(&System::alone(&alone), &recording, Options::default()).unwrap().departs
/// };
/// assert_eq!(told(5_500), None);
/// let late = told(7_000).unwrap();
/// let reason = "`off` fired at 7000 ms, too late: it had to fire by 6009 ms";
/// assert_eq!((late.line, late.reason.as_str()), (3, reason));
/// ```
pub fn conform(
    system: &System<'_>,
    recording: &Recording,
    options: Options,
) -> Result<Verdict, Refused> {
    let numbered = Numbered::of(system);
    let nets = if numbered.is_system() { numbered.net_names() } else { &[] };
    if let Some(name) = recording.silent.iter().find(|it| !nets.contains(it)) {
        let (at, known) = (None, nets.to_vec());
        return Err(Refused::Name { at, kind: "net", name: name.clone(), known });
    }
    let plain = numbered.is_plain();
    let whole = numbered.whole().clone();
    let is_silent: Vec<_> = (0..whole.transitions.len() as u32)
        .map(|id| recording.silent.iter().any(|it| it == numbered.net_name(TransitionId(id))))
        .collect();
    let is_chosen = |TransitionId(id): TransitionId| {
        let timed = whole.transitions[id as usize].within.is_some();
        (plain || timed) && !is_silent[id as usize]
    };
    let numbered = numbered.choosing(is_chosen, options.tolerance);
    let mut result = Ok(Verdict::default());
    let played = numbered.play(recording.start, &mut |game, fired| {
        let checked = Checked::new(&numbered, &is_silent, game, recording, options);
        result = checked.all(recording, fired);
    });
    played.map_err(Refused::Model)?;
    result
}

/// Why a line is the last one.
enum Stop {
    /// For this reason, where this was allowed.
    Departs(String, Allowed),
    Refused(Refused),
}

/// A game that follows a recording.
struct Checked<'s, 'c> {
    numbered: &'s Numbered,
    is_silent: &'s [bool],
    game: Box<dyn Game<'c> + 'c>,
    /// What has fired and is not recorded yet.
    pending: VecDeque<Fired>,
    names: Names<'s>,
    /// The transitions that are chosen, and cannot be put off for ever.
    forced: Vec<TransitionId>,
    tolerance: u64,
    round_every: Option<Millis>,
    next_round: Millis,
    /// Whether a round takes place as soon as something waits.
    rounds_when_due: bool,
    /// The last event that nothing used, and why.
    unused: Option<(String, String)>,
    verdict: Verdict,
}

impl<'s, 'c> Checked<'s, 'c> {
    fn new(
        numbered: &'s Numbered,
        is_silent: &'s [bool],
        game: Box<dyn Game<'c> + 'c>,
        recording: &Recording,
        options: Options,
    ) -> Self {
        let transitions = numbered.whole().transitions.iter().zip((0..).map(TransitionId));
        let forced = transitions.filter(|(it, id)| {
            numbered.choice(*id).is_some() && it.within.is_some_and(|it| it.latest.is_some())
        });
        let says_round = recording.lines.iter().any(|it| it.what == What::Round);
        Self {
            numbered,
            is_silent,
            game,
            pending: VecDeque::new(),
            names: Names::of(numbered),
            forced: forced.map(|it| it.1).collect(),
            tolerance: options.tolerance.0,
            round_every: recording.round_every,
            next_round: recording.start,
            rounds_when_due: recording.round_every.is_none() && !says_round,
            unused: None,
            verdict: Verdict { until: recording.start, ..Verdict::default() },
        }
    }

    fn all(mut self, recording: &Recording, fired: Vec<Fired>) -> Result<Verdict, Refused> {
        self.names.all_known(recording)?;
        self.hear(fired);
        let mut last = 0;
        for line in &recording.lines {
            if let Err(stop) = self.line(line) {
                return self.stopped(stop, line.number, line.at);
            }
            (self.verdict.until, last) = (line.at, line.number);
        }
        match self.pending.front().copied() {
            None => Ok(self.verdict),
            Some(first) => {
                let at = self.verdict.until;
                let stop = self.missing(first, "the recording ends, and ");
                self.stopped(stop, last, at)
            }
        }
    }

    fn stopped(mut self, stop: Stop, line: usize, at: Millis) -> Result<Verdict, Refused> {
        match stop {
            Stop::Refused(refused) => Err(refused),
            Stop::Departs(reason, allowed) => {
                self.verdict.departs = Some(Departure { line, at, reason, allowed });
                Ok(self.verdict)
            }
        }
    }

    fn departs(&self, reason: String) -> Stop {
        Stop::Departs(reason, Allowed::of(self.numbered, &*self.game))
    }

    /// That what has fired is not recorded.
    fn missing(&self, first: Fired, before: &str) -> Stop {
        let name = self.numbered.transition(first.transition);
        let on = self.numbered.needs_event(first.transition);
        let on = on.map_or_else(String::new, |it| format!(" on `{it}`"));
        let reason = format!("{before}`{name}` had to fire{on} at {} ms", first.at.0);
        Stop::Departs(reason, self.must(first))
    }

    fn must(&self, first: Fired) -> Allowed {
        let latest = Millis(first.at.0.saturating_add(self.tolerance));
        Allowed::only(self.numbered.transition(first.transition), first.at, latest)
    }

    fn line(&mut self, line: &Line) -> Result<(), Stop> {
        self.pass_to(line)?;
        match &line.what {
            What::Event { name, ignored } => self.tell(line.at, name, *ignored)?,
            What::Fired(name) => self.fired(line.at, name)?,
            What::Round => self.round(line.at)?,
            What::End => {
                if let Some(&first) = self.pending.front() {
                    return Err(self.missing(first, ""));
                }
            }
        }
        let mut rounds = 0;
        while self.rounds_when_due && self.game.round_is_due() {
            rounds += 1;
            if rounds > MOST_ROUNDS {
                return Err(Stop::Refused(Refused::Endless(line.at)));
            }
            self.round(line.at)?;
        }
        Ok(())
    }

    fn tell(&mut self, at: Millis, name: &str, ignored: Option<bool>) -> Result<(), Stop> {
        let event = self.names.event(name);
        let before = (ignored == Some(true)).then(|| self.game.fork());
        let mut fired = Vec::new();
        match (self.game.offer(at, event, &mut fired), before) {
            (Ok(transition), Some(before)) => {
                let by = self.numbered.transition(transition);
                let reason = format!("`{name}` is recorded as ignored, and `{by}` fires on it");
                self.game = before;
                return Err(self.departs(reason));
            }
            (Ok(_), None) => self.hear(fired),
            (Err(why), _) => {
                let why = unused(self.numbered, &*self.game, event, why);
                if ignored == Some(false) {
                    let reason = format!("`{name}` is told, and nothing fires on it: {why}");
                    return Err(self.departs(reason));
                }
                self.unused = Some((name.to_owned(), why));
            }
        }
        self.verdict.events += 1;
        Ok(())
    }

    fn fired(&mut self, at: Millis, name: &str) -> Result<(), Stop> {
        let id = self.names.transition(name);
        if self.is_silent[id.0 as usize] {
            return Ok(());
        }
        if let Some(&first) = self.pending.front() {
            if self.numbered.transition(first.transition) != name {
                let before = format!("`{name}` fired, and before it ");
                return Err(self.missing(first, &before));
            }
        } else if let Some(choice) = self.numbered.choice(id) {
            let mut fired = Vec::new();
            if let Err(why) = self.game.offer(at, choice, &mut fired) {
                return Err(self.cannot(at, name, id, why));
            }
            self.hear(fired);
        } else {
            return Err(self.unasked(name, id));
        }
        self.pending.pop_front();
        self.verdict.fired += 1;
        Ok(())
    }

    /// That a transition was chosen that cannot fire.
    fn cannot(&self, at: Millis, name: &str, id: TransitionId, why: Unused) -> Stop {
        if let Unused::Ignored(Why::TooEarly(_)) = why
            && let Some((earliest, _)) = window(self.numbered, &*self.game, id)
        {
            return self.departs(format!(
                "`{name}` fired at {} ms, too early: it could not fire before {} ms",
                at.0, earliest.0
            ));
        }
        let event = self.numbered.choice(id).unwrap_or(EventId(u32::MAX));
        let why = unused(self.numbered, &*self.game, event, why);
        self.departs(format!("`{name}` fired, and could not: {why}"))
    }

    /// That a transition was recorded that nothing made fire.
    fn unasked(&self, name: &str, id: TransitionId) -> Stop {
        let reason = match (self.numbered.needs_event(id), &self.unused) {
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
        self.departs(reason)
    }

    /// Lets time pass up to a line, with the rounds of that time.
    fn pass_to(&mut self, line: &Line) -> Result<(), Stop> {
        if let Some(Millis(every)) = self.round_every {
            while self.next_round <= line.at {
                // A round in which nothing waits does nothing.
                let due = if self.game.round_is_due() {
                    self.next_round
                } else {
                    self.game.wake_at().unwrap_or(Millis(u64::MAX))
                };
                let left_out =
                    due.0.min(line.at.0 + 1).saturating_sub(self.next_round.0).div_ceil(every);
                self.verdict.rounds += left_out;
                self.next_round = Millis(self.next_round.0.saturating_add(left_out * every));
                if self.next_round <= line.at {
                    self.pass(self.next_round, None)?;
                    self.round(self.next_round)?;
                    self.next_round = Millis(self.next_round.0.saturating_add(every));
                }
            }
        }
        self.pass(line.at, Some(line))
    }

    /// Lets time pass, and nothing that had to fire may be missing then.
    fn pass(&mut self, at: Millis, line: Option<&Line>) -> Result<(), Stop> {
        let says =
            |name: &str| matches!(line, Some(Line { what: What::Fired(it), .. }) if it == name);
        if let Some(&first) = self.pending.front()
            && first.at.0.saturating_add(self.tolerance) < at.0
        {
            let name = self.numbered.transition(first.transition);
            if says(name) {
                let reason = format!(
                    "`{name}` fired at {} ms, too late: it had to fire at {} ms",
                    at.0, first.at.0
                );
                return Err(Stop::Departs(reason, self.must(first)));
            }
            return Err(self.missing(first, ""));
        }
        if at > self.game.now()
            && let Some((latest, id)) = self.overdue(at)
        {
            let name = self.numbered.transition(id);
            let had = format!("had to fire by {} ms", latest.0);
            return Err(self.departs(if says(name) {
                format!("`{name}` fired at {} ms, too late: it {had}", at.0)
            } else {
                format!("`{name}` {had}")
            }));
        }
        loop {
            let mut fired = Vec::new();
            let behind = self.game.advance(at, &mut fired);
            self.hear(fired);
            if !behind {
                return Ok(());
            }
            if self.pending.len() > MOST_FIRINGS {
                return Err(Stop::Refused(Refused::Endless(self.game.now())));
            }
        }
    }

    /// What should have fired before, and when at last.
    fn overdue(&self, at: Millis) -> Option<(Millis, TransitionId)> {
        let late = |at: Millis, event| {
            matches!(offered(&*self.game, at, event), Err(Unused::Ignored(Why::TooLate(_))))
        };
        let overdue = self.forced.iter().filter_map(|&id| {
            let event = self.numbered.choice(id)?;
            if !late(at, event) || late(self.game.now(), event) {
                return None;
            }
            let (_, latest) = window(self.numbered, &*self.game, id)?;
            // What waits for room in a mailbox does not have to fire.
            offered(&*self.game, latest?, event).ok()?;
            Some((latest?, id))
        });
        overdue.min()
    }

    fn round(&mut self, at: Millis) -> Result<(), Stop> {
        let mut fired = Vec::new();
        let behind = self.game.round(at, &mut fired);
        self.hear(fired);
        self.verdict.rounds += 1;
        if behind { Err(Stop::Refused(Refused::Endless(at))) } else { Ok(()) }
    }

    fn hear(&mut self, fired: Vec<Fired>) {
        let is_silent = self.is_silent;
        self.pending.extend(fired.into_iter().filter(|it| !is_silent[it.transition.0 as usize]));
    }
}
