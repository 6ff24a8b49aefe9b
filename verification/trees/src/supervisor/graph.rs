//! The graph of a net or a system, by its player.

use super::{Edge, Supervisor, Taken};
use cotama_core::net::{EventId, PlaceId, Role};
use cotama_core::player::Why;
use cotama_core::system::System;
use cotama_core::system::owned::OwnedSystem;
use cotama_core::units::Millis;
use cotama_play::{Fired, Game, NotPlayed, Numbered, Unused};
use std::collections::{BTreeMap, HashMap, VecDeque};
use std::fmt;

/// Most states of a supervisor.
pub const MOST_STATES: usize = 200_000;
/// Most edges of its graph.
const MOST_EDGES: usize = 20_000_000;
/// Name of the move in which nets of a system read their mailboxes.
const ROUND: &str = "round";

/// Reasons why a supervisor cannot be set beside a tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unfit {
    /// No player takes it.
    NotPlayed(NotPlayed),
    /// Nothing in it waits for an event.
    Plain,
    /// Transitions without event fire without an end.
    Restless,
    /// More than [`MOST_STATES`] states, or too many edges.
    Large,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unfit::NotPlayed(it) => it.fmt(f),
            Unfit::Plain => f.write_str("nothing in it waits for an event"),
            Unfit::Restless => f.write_str("its transitions without event fire without an end"),
            Unfit::Large => write!(f, "it has more than {MOST_STATES} states"),
        }
    }
}

impl std::error::Error for Unfit {}

impl Supervisor {
    /// Explores a net alone or a system.
    ///
    /// With a period time passes between two ticks, and events come at the instants of ticks.
    /// Without, intervals are left out: a transition with one fires when it likes, by a move of its
    /// own, or is open whenever its event comes. Events of `never` do not happen.
    ///
    /// # Errors
    /// Why it cannot be set beside a tree.
    pub fn of(
        system: &System<'_>,
        period: Option<u32>,
        never: &[&str],
    ) -> Result<Supervisor, Unfit> {
        let mut owned = OwnedSystem::from(system);
        let told = |numbered: &Numbered| numbered.told_events();
        let numbered = Numbered::of(system);
        if numbered.is_plain() {
            return Err(Unfit::Plain);
        }
        let mut timed = vec![false; told(&numbered)];
        for it in &numbered.whole().transitions {
            if let (Some(on), Some(_), None) = (it.on, it.within, period) {
                timed[on.0 as usize] = true;
            }
        }
        for it in owned.nets.iter_mut().flat_map(|it| &mut it.1.transitions) {
            if it.on.is_some() && period.is_none() {
                it.within = None;
            }
        }
        let numbered = owned.with(Numbered::of);
        let all = &numbered.whole().transitions;
        let free: Vec<_> = all.iter().map(|it| it.within.is_some()).collect();
        let numbered = match period {
            Some(_) => numbered,
            None => numbered.choosing(|it| free[it.0 as usize], Millis(u32::MAX.into())),
        };
        let mut found = Err(Unfit::Restless);
        numbered
            .play(Millis(0), &mut |game, _| {
                found = Search::new(&numbered, timed.clone(), period).run(game, never);
            })
            .map_err(Unfit::NotPlayed)?;
        found
    }
}

struct Search<'n> {
    numbered: &'n Numbered,
    /// Places that are shown, by their numbers.
    places: Vec<u32>,
    /// The event that is a round.
    round: Option<usize>,
    /// Time between two ticks in ms.
    period: u64,
    numbers: HashMap<Vec<u64>, u32>,
    lists: HashMap<Vec<u16>, u32>,
    net: Supervisor,
}

impl<'n> Search<'n> {
    fn new(numbered: &'n Numbered, timed: Vec<bool>, period: Option<u32>) -> Search<'n> {
        let whole = numbered.whole();
        let shown = whole.places.iter().take(numbered.shown_places()).enumerate();
        let shown: Vec<_> = shown.filter(|it| !matches!(it.1.role, Role::Complement(_))).collect();
        let has_mail = whole.places.iter().any(|it| it.role == Role::Mailbox);
        let mut events: Vec<_> = whole.events.iter().map(|it| it.name.clone()).collect();
        let round = has_mail.then_some(events.len());
        events.extend(round.map(|_| ROUND.to_owned()));
        let pass = period.map(|_| events.len());
        events.extend(pass.map(|_| "time".to_owned()));
        let mut outputs: BTreeMap<String, Vec<u16>> = BTreeMap::new();
        let mut lines: BTreeMap<String, Vec<u16>> = BTreeMap::new();
        for (at, name) in (0..).zip(numbered.line_names()) {
            if let Some(name) = name {
                lines.entry(name.to_owned()).or_default().push(at);
            }
        }
        for at in 0..whole.transitions.len() as u16 {
            for (name, _) in numbered.says(cotama_core::net::TransitionId(at.into())) {
                outputs.entry(name).or_default().push(at);
            }
        }
        let net = Supervisor {
            name: whole.name.clone(),
            told: numbered.told_events(),
            pass,
            timed,
            places: shown.iter().map(|it| it.1.name.clone()).collect(),
            transitions: whole.transitions.iter().map(|it| it.name.clone()).collect(),
            lines,
            outputs,
            states: 0,
            marks: Vec::new(),
            words: shown.len().div_ceil(64).max(1),
            edges: Vec::new(),
            fired: vec![Vec::new()],
            events,
        };
        Search {
            numbered,
            places: shown.iter().map(|it| it.0 as u32).collect(),
            round,
            period: period.unwrap_or(0).into(),
            numbers: HashMap::new(),
            lists: HashMap::from([(Vec::new(), 0)]),
            net,
        }
    }

    fn run<'c>(
        mut self,
        mut first: Box<dyn Game<'c> + 'c>,
        never: &[&str],
    ) -> Result<Supervisor, Unfit> {
        let happens = |it: &String| !never.contains(&it.as_str());
        let happens: Vec<_> = self.net.events.iter().map(happens).collect();
        if first.advance(Millis(0), &mut Vec::new()) {
            return Err(Unfit::Restless);
        }
        let mut waiting = VecDeque::new();
        self.number(&*first);
        waiting.push_back(first);
        while let Some(game) = waiting.pop_front() {
            for (event, happens) in happens.iter().enumerate() {
                if !happens {
                    let (to, _) = self.number(&*game);
                    self.net.edges.push(Edge { to, fired: 0, taken: Taken::Ignored });
                    continue;
                }
                let mut next = game.fork();
                let mut fired = Vec::new();
                let taken = self.takes(&mut *next, event, &mut fired)?;
                let (to, new) = self.number(&*next);
                let fired = self.list(&fired);
                self.net.edges.push(Edge { to, fired, taken });
                if new {
                    waiting.push_back(next);
                }
                if self.net.states > MOST_STATES || self.net.edges.len() > MOST_EDGES {
                    return Err(Unfit::Large);
                }
            }
        }
        Ok(self.net)
    }

    /// Lets an event happen, and all that follows at once.
    fn takes(
        &self,
        game: &mut dyn Game<'_>,
        event: usize,
        fired: &mut Vec<Fired>,
    ) -> Result<Taken, Unfit> {
        let now = game.now();
        let mut taken = Taken::Fired;
        let behind = if Some(event) == self.round {
            game.round_is_due() && game.round(now, fired)
        } else if Some(event) == self.net.pass {
            game.advance(Millis(now.0 + self.period), fired)
        } else {
            match game.offer(now, EventId(event as u32), fired) {
                Ok(_) => false,
                Err(Unused::Ignored(Why::Behind)) => true,
                Err(it) => {
                    let on_purpose = it == Unused::Ignored(Why::OnPurpose);
                    taken = if on_purpose { Taken::OnPurpose } else { Taken::Ignored };
                    false
                }
            }
        };
        let now = game.now();
        if behind || game.advance(now, fired) {
            return Err(Unfit::Restless);
        }
        Ok(taken)
    }

    /// Returns the number of a list of transitions.
    fn list(&mut self, fired: &[Fired]) -> u32 {
        let list: Vec<u16> = fired.iter().map(|it| it.transition.0 as u16).collect();
        let next = self.net.fired.len() as u32;
        *self.lists.entry(list).or_insert_with_key(|list| {
            self.net.fired.push(list.clone());
            next
        })
    }

    /// Returns the number of a state, and whether it is new.
    fn number(&mut self, game: &dyn Game<'_>) -> (u32, bool) {
        let next = self.net.states as u32;
        let number = *self.numbers.entry(game.state()).or_insert(next);
        if number < next {
            return (number, false);
        }
        self.net.states += 1;
        let from = self.net.marks.len();
        self.net.marks.resize(from + self.net.words, 0);
        for (at, place) in self.places.iter().enumerate() {
            let marked = game.tokens(PlaceId(*place)) > 0;
            self.net.marks[from + at / 64] |= (marked as u64) << (at % 64);
        }
        debug_assert!(self.numbered.shown_places() >= self.places.len());
        (number, true)
    }
}
