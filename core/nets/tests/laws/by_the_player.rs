//! Every state in which a player can be, millisecond by millisecond, and what laws say of them.

use cotama_core::net::{Arc, EventId, Law, Net, Place, PlaceId, Transition, TransitionId};
use cotama_core::player::{Firing, Kind, Loaded, Outcome, Player, Program as _};
use cotama_core::units::Millis;
use std::collections::{HashMap, HashSet};

/// The most intervals of a net.
pub(crate) const CLOCKS: usize = 5;

pub(crate) type Program<'n> = Loaded<'n, 1, CLOCKS>;
pub(crate) type Played<'n> = Player<Program<'n>, 1, CLOCKS>;
pub(crate) type Fired<'f, 'n> = Firing<'f, Program<'n>>;
type Marking = Vec<u32>;
type Key = ([u64; 1], [u32; CLOCKS]);

/// The events from one state at rest to the next one.
struct Move {
    to: usize,
    /// The markings on the way.
    passed: Vec<Marking>,
}

struct State {
    marking: Marking,
    /// The outcome of each event, those of other nets last.
    events: Vec<Option<Move>>,
    /// The outcome of a millisecond, and whether something fires in it.
    time: Option<(Move, bool)>,
    /// Whether two transitions of one event are enabled.
    conflict: bool,
}

/// Why there is nothing to look at.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Trouble {
    Bound,
    Forever,
    TooMany,
}

pub(crate) struct Explored<'n> {
    net: Net<'n>,
    states: Vec<State>,
    /// All markings, also in passing.
    pub(crate) markings: HashSet<Marking>,
    /// Which transitions fire in which of them.
    pub(crate) firings: HashSet<(Marking, u32)>,
    /// The most that fire at once in a row.
    pub(crate) settle: u32,
    conflict: bool,
    /// Whether something fires for ever; what comes after it is not looked at.
    forever: bool,
}

/// A player that believes that bounds hold, at the start.
pub(crate) fn start<'n>(program: &Program<'n>, mut fired: impl FnMut(TransitionId)) -> Played<'n> {
    Player::start(program.bounded(), Millis(0), &mut |it: &Fired<'_, 'n>| fired(it.id.id))
}

fn has(marking: &Marking, arcs: &[Arc]) -> bool {
    arcs.iter().all(|arc| marking[arc.place.0 as usize] >= arc.weight)
}

fn enabled(it: &Transition<'_>, marking: &Marking) -> bool {
    has(marking, it.take) && has(marking, it.read)
}

/// The transitions fired, once more by the book.
struct Replay<'r, 'n> {
    explored: &'r mut Explored<'n>,
    marking: Marking,
    /// The transitions due now.
    due: HashSet<usize>,
    passed: Vec<Marking>,
    row: u32,
}

impl Replay<'_, '_> {
    fn new<'r, 'n>(explored: &'r mut Explored<'n>, marking: &Marking) -> Replay<'r, 'n> {
        let (marking, due) = (marking.clone(), HashSet::new());
        Replay { explored, marking, due, passed: vec![], row: 0 }
    }

    fn by_itself(&self) -> impl Iterator<Item = (usize, &Transition<'_>)> {
        let all = self.explored.net.transitions.iter().enumerate();
        all.filter(|(_, it)| it.on.is_none() && enabled(it, &self.marking))
    }

    /// Adds the transitions that became enabled and are due at once.
    fn begins(&mut self, left: Option<&Marking>) {
        let new = |it: &Transition<'_>| left.is_none_or(|left| !enabled(it, left));
        let now = |it: &Transition<'_>| it.within.is_some_and(|it| it.earliest == 0);
        let begun: Vec<usize> =
            self.by_itself().filter(|(_, it)| new(it) && now(it)).map(|(at, _)| at).collect();
        self.due.extend(begun);
    }

    fn fire(&mut self, id: TransitionId) -> Result<(), Trouble> {
        let at = id.0 as usize;
        let it = self.explored.net.transitions[at];
        let urgent = self.by_itself().filter(|(_, it)| it.within.is_none()).count();
        let several = match (it.on, it.within) {
            (Some(_), _) => 0,
            (None, None) => urgent,
            (None, Some(_)) => self.due.len(),
        };
        self.explored.conflict |= several > 1;
        self.row = if it.on.is_none() && it.within.is_none() { self.row + 1 } else { 0 };
        self.explored.settle = self.explored.settle.max(self.row);
        self.explored.firings.insert((self.marking.clone(), id.0));
        let mut left = self.marking.clone();
        it.take.iter().for_each(|arc| left[arc.place.0 as usize] -= arc.weight);
        let transitions = self.explored.net.transitions;
        self.due.retain(|&other| other != at && enabled(&transitions[other], &left));
        self.marking.clone_from(&left);
        it.give.iter().for_each(|arc| self.marking[arc.place.0 as usize] += arc.weight);
        self.explored.markings.insert(self.marking.clone());
        self.passed.push(self.marking.clone());
        let full = |(place, &tokens): (&Place<'_>, &u32)| tokens > place.bound;
        if self.explored.net.places.iter().zip(&self.marking).any(full) {
            return Err(Trouble::Bound);
        }
        self.begins(Some(&left));
        // The transition has fired, so its clock starts anew.
        let now = it.on.is_none() && it.within.is_some_and(|it| it.earliest == 0);
        if now && enabled(&it, &self.marking) {
            self.due.insert(at);
        }
        Ok(())
    }
}

impl<'n> Explored<'n> {
    /// Plays the net, which is that of the code and begins with the transitions of the law's.
    pub(crate) fn of(net: &Net<'n>, program: &Program<'n>, most: usize) -> Result<Self, Trouble> {
        let mut it = Self {
            net: *net,
            states: vec![],
            markings: HashSet::new(),
            firings: HashSet::new(),
            settle: 0,
            conflict: false,
            forever: false,
        };
        let initial: Marking = net.places.iter().map(|place| place.initial).collect();
        it.markings.insert(initial.clone());
        let mut log = vec![];
        let mut player = start(program, |id| log.push(id));
        it.finish(&mut player, log, &initial, true, &HashSet::new())?;
        if it.forever {
            return Err(Trouble::Forever);
        }
        let mut known: HashMap<Key, usize> = HashMap::from([(key(&player), 0)]);
        let mut players = vec![player];
        while it.states.len() < players.len() {
            if players.len() > most {
                return Err(Trouble::TooMany);
            }
            let player = players[it.states.len()];
            let marking = it.marking(&player);
            let mut number = |player: Played<'n>| {
                *known.entry(key(&player)).or_insert_with(|| {
                    players.push(player);
                    players.len() - 1
                })
            };
            let able = |at: usize| player.enabled(TransitionId(at as u32));
            let mut on = vec![0; net.events.len()];
            for (at, transition) in net.transitions.iter().enumerate() {
                if let Some(event) = transition.on {
                    on[event.0 as usize] += usize::from(able(at));
                }
            }
            let mut events = vec![];
            for event in 0..net.events.len() as u32 {
                let (mut next, mut log) = (player, vec![]);
                let outcome =
                    next.offer_with(next.now(), &EventId(event).id(), &mut |it: &Fired<'_, 'n>| {
                        log.push(it.id.id);
                    });
                events.push(if matches!(outcome, Outcome::Fired { .. }) {
                    let passed = it.finish(&mut next, log, &marking, false, &HashSet::new())?;
                    Some(Move { to: if rests(&next) { number(next) } else { 0 }, passed })
                } else {
                    assert!(log.is_empty());
                    None
                });
            }
            let (mut next, mut log) = (player, vec![]);
            let due = it.due(&player, &marking);
            let advanced =
                next.advance_with(Millis(next.now().0 + 1), &mut |it: &Fired<'_, 'n>| {
                    log.push(it.id.id);
                });
            assert!(!advanced.behind || !rests(&next));
            let fires = !log.is_empty();
            let passed = it.finish(&mut next, log, &marking, false, &due)?;
            let time =
                Some((Move { to: if rests(&next) { number(next) } else { 0 }, passed }, fires));
            let conflict = on.iter().any(|&count| count > 1);
            it.states.push(State { marking, events, time, conflict });
        }
        if it.forever { Err(Trouble::Forever) } else { Ok(it) }
    }

    fn marking(&self, player: &Played<'_>) -> Marking {
        (0..self.net.places.len() as u32).map(|at| player.tokens(PlaceId(at))).collect()
    }

    /// Returns the transitions due in a millisecond.
    fn due(&self, player: &Played<'_>, marking: &Marking) -> HashSet<usize> {
        let code = player.program().code();
        let clocks = player.snapshot().clocks;
        let id =
            |at: usize| usize::from(code.entries[usize::from(code.clocks[at].entry)].transition);
        (0..code.clocks.len())
            .filter(|&at| !code.clocks[at].event && clocks[at] + 1 == code.clocks[at].earliest)
            .map(id)
            .filter(|&at| enabled(&self.net.transitions[at], marking))
            .collect()
    }

    fn replay(
        &mut self,
        log: &[TransitionId],
        marking: &Marking,
        start: bool,
        due: &HashSet<usize>,
    ) -> Result<(Marking, Vec<Marking>), Trouble> {
        let mut replay = Replay::new(self, marking);
        replay.due.clone_from(due);
        if start {
            replay.begins(None);
        }
        for &id in log {
            replay.fire(id)?;
        }
        Ok((replay.marking, replay.passed))
    }

    /// Lets what is due now fire, and checks what was played by the book.
    fn finish(
        &mut self,
        player: &mut Played<'n>,
        mut log: Vec<TransitionId>,
        marking: &Marking,
        start: bool,
        due: &HashSet<usize>,
    ) -> Result<Vec<Marking>, Trouble> {
        let mut observer = |it: &Fired<'_, 'n>| log.push(it.id.id);
        let behind = player.advance_with(player.now(), &mut observer).behind;
        let (after, passed) = self.replay(&log, marking, start, due)?;
        assert_eq!(after, self.marking(player));
        assert!(!behind || !rests(player));
        self.forever |= !rests(player);
        Ok(passed)
    }

    /// Whether a law of this net holds; events and transitions of other nets come after its own.
    pub(crate) fn holds(&self, net: &Net<'_>, law: &Law<'_>) -> bool {
        let tokens = |marking: &Marking, place: PlaceId| marking[place.0 as usize];
        let mut all = self.markings.iter();
        match *law {
            Law::Invariant { sum, equals } => all.all(|it| {
                sum.iter().map(|arc| arc.weight * tokens(it, arc.place)).sum::<u32>() == equals
            }),
            Law::NeverBoth(a, b) => !all.any(|it| tokens(it, a) > 0 && tokens(it, b) > 0),
            Law::Reachable(place) => all.any(|it| tokens(it, place) > 0),
            Law::AlwaysCan(place) => self.always_can(place),
            Law::HandlesAll => self.states.iter().all(|state| {
                (0..net.events.len()).all(|event| {
                    state.events[event].is_some()
                        || net.ignored.iter().any(|it| {
                            let all = it.guard.iter().copied();
                            it.event.0 as usize == event
                                && all
                                    .chain([Arc { place: it.place, weight: 1 }])
                                    .all(|arc| tokens(&state.marking, arc.place) >= arc.weight)
                        })
                })
            }),
            Law::Settles => true,
            Law::DeadlockFree { end } => (0..self.states.len()).all(|at| {
                end.is_some_and(|end| tokens(&self.states[at].marking, end) > 0)
                    || !self.is_stuck(at, net.events.len())
            }),
            Law::Deterministic => !self.conflict && !self.states.iter().any(|it| it.conflict),
        }
    }

    /// Whether no event, now or later, and no passing of time makes a transition fire.
    fn is_stuck(&self, at: usize, events: usize) -> bool {
        let mut at = at;
        loop {
            let state = &self.states[at];
            let Some((time, fires)) = &state.time else { return false };
            if *fires || state.events[..events].iter().any(Option::is_some) {
                return false;
            }
            if time.to == at {
                return true;
            }
            at = time.to;
        }
    }

    fn always_can(&self, place: PlaceId) -> bool {
        let marked = |it: &Marking| it[place.0 as usize] > 0;
        let mut can: Vec<bool> = self.states.iter().map(|it| marked(&it.marking)).collect();
        loop {
            let mut changed = false;
            for (at, state) in self.states.iter().enumerate().rev() {
                let moves = state.events.iter().flatten().chain(state.time.iter().map(|it| &it.0));
                let mut moves = moves.filter(|it| can[it.to] || it.passed.iter().any(marked));
                if !can[at] && moves.next().is_some() {
                    (can[at], changed) = (true, true);
                }
            }
            if !changed {
                return can.into_iter().all(|it| it);
            }
        }
    }
}

/// Whether nothing fires by itself now.
fn rests(player: &Played<'_>) -> bool {
    player.wake_at() != Some(player.now())
}

fn key(player: &Played<'_>) -> Key {
    let it = player.snapshot();
    (it.marking, it.clocks)
}
