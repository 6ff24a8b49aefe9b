//! A net seen as one state machine with variables.

use crate::effect::effect;
use cotama_core::net::{Arc, Net, NetError, PlaceId, Role, Transition};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// Why a net is no state machine with variables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NotAStateMachine {
    /// The lists of the net do not fit together.
    Defect(NetError),
    /// The state places do not hold exactly one token together at the start.
    Start {
        /// The places that hold tokens, with how many.
        tokens: Vec<(String, u32)>,
    },
    /// A transition does not take or read exactly one state.
    Source {
        /// Name of the transition.
        transition: String,
        /// The states that it takes or reads.
        states: Vec<String>,
    },
    /// A transition that takes a state does not give exactly one, or one that reads a state gives
    /// some.
    Target {
        /// Name of the transition.
        transition: String,
        /// The state that it takes or reads.
        from: String,
        /// Whether it takes that state.
        takes: bool,
        /// The states that it gives.
        states: Vec<String>,
    },
    /// A transition takes, reads or gives more than one token of a state.
    Weight {
        /// Name of the transition.
        transition: String,
        /// The state.
        state: String,
    },
    /// A place is the complement of a place that is neither data nor shared.
    ComplementOf {
        /// The complement.
        place: String,
        /// The place that it complements.
        of: String,
    },
    /// A transition changes a place and its complement, but not by opposite numbers of tokens.
    Complement {
        /// The transition.
        transition: String,
        /// The complement.
        place: String,
    },
}

impl fmt::Display for NotAStateMachine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Defect(defect) => {
                write!(f, "the lists of the net do not fit together: {defect}")
            }
            Self::Start { tokens } if tokens.is_empty() => {
                f.write_str("no state has a token at the start: exactly one must")
            }
            Self::Start { tokens } => {
                let tokens: Vec<_> =
                    tokens.iter().map(|(name, count)| format!("{count} in `{name}`")).collect();
                let tokens = tokens.join(", ");
                write!(
                    f,
                    "more than one token in the states at the start ({tokens}): there must be \
                     exactly one"
                )
            }
            Self::Source { transition, states } => {
                let states = listed(states);
                write!(
                    f,
                    "transition `{transition}` takes or reads {states}: it must take or read \
                     exactly one"
                )
            }
            Self::Target { transition, from, takes: true, states } => {
                let states = listed(states);
                write!(
                    f,
                    "transition `{transition}` takes `{from}` and gives {states}: it must give \
                     exactly one"
                )
            }
            Self::Target { transition, from, takes: false, states } => {
                let states = listed(states);
                write!(
                    f,
                    "transition `{transition}` reads `{from}` and gives {states}: it must take \
                     `{from}` to leave it"
                )
            }
            Self::Weight { transition, state } => {
                write!(
                    f,
                    "transition `{transition}` needs or gives more than one token of `{state}`, \
                     which is a state"
                )
            }
            Self::ComplementOf { place, of } => {
                write!(
                    f,
                    "place `{place}` is the complement of `{of}`, which is neither data nor shared"
                )
            }
            Self::Complement { transition, place } => {
                write!(
                    f,
                    "transition `{transition}` changes `{place}` and what it complements, but not \
                     by opposite numbers"
                )
            }
        }
    }
}

impl std::error::Error for NotAStateMachine {}

fn listed(states: &[String]) -> String {
    match states {
        [] => "no state".to_owned(),
        [one] => format!("`{one}`"),
        [first, rest @ ..] => {
            rest.iter().fold(format!("`{first}`"), |all, it| format!("{all}, `{it}`"))
        }
    }
}

/// A net that is one state machine with variables.
pub(super) struct Machine<'n> {
    pub(super) net: &'n Net<'n>,
    pub(super) initial: PlaceId,
    /// One for each transition.
    pub(super) moves: Vec<Move>,
    /// The places that are variables, and whether they stay at 0 or 1.
    pub(super) variables: BTreeMap<PlaceId, bool>,
}

/// How a transition moves the one token.
pub(super) struct Move {
    pub(super) from: PlaceId,
    /// The next state; `None` if the token stays.
    pub(super) to: Option<PlaceId>,
    pub(super) timing: Timing,
    /// Change of tokens in variables.
    pub(super) effect: BTreeMap<PlaceId, i64>,
}

/// The treatment of the interval of a transition.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Timing {
    /// No interval.
    Untimed,
    /// A timer of this many milliseconds that starts when the state is entered.
    Timer(u32),
    /// No timer keeps it.
    Unkept,
    /// There is none, and the transition waits for an event of its own name.
    Named,
}

/// The most firings that are followed at the start.
const MOST_FIRINGS: usize = 10_000;

impl<'n> Machine<'n> {
    pub(super) fn of(net: &'n Net<'n>) -> Result<Self, NotAStateMachine> {
        if let Some(defect) = net.defect() {
            return Err(NotAStateMachine::Defect(defect));
        }
        // From here on every id is one of the net.
        let mut machine =
            Self { net, initial: start(net)?, moves: Vec::new(), variables: BTreeMap::new() };
        machine.moves =
            net.transitions.iter().map(|it| machine.follow(it)).collect::<Result<_, _>>()?;
        machine.check_complements()?;
        machine.time();
        machine.wait();
        machine.variables = machine.find_variables();
        for it in &mut machine.moves {
            it.effect.retain(|place, _| machine.variables.contains_key(place));
        }
        Ok(machine)
    }

    pub(super) fn role(&self, place: PlaceId) -> Role {
        self.net.places[place.0 as usize].role
    }

    pub(super) fn name(&self, place: PlaceId) -> &'n str {
        self.net.places[place.0 as usize].name
    }

    /// The arcs of what it needs besides the state.
    pub(super) fn needs(&self, transition: &Transition<'n>) -> impl Iterator<Item = Arc> {
        let needs = transition.take.iter().chain(transition.read).copied();
        needs.filter(|arc| self.role(arc.place) != Role::State)
    }

    fn states(&self, arcs: &'n [Arc]) -> Vec<Arc> {
        arcs.iter().copied().filter(|arc| self.role(arc.place) == Role::State).collect()
    }

    fn follow(&self, transition: &Transition<'n>) -> Result<Move, NotAStateMachine> {
        let (take, read) = (self.states(transition.take), self.states(transition.read));
        let give = self.states(transition.give);
        let names = |arcs: &[Arc]| {
            arcs.iter().map(|arc| self.name(arc.place).to_owned()).collect::<Vec<_>>()
        };
        let name = transition.name.to_owned();
        let (from, takes) = match (take.as_slice(), read.as_slice()) {
            ([one], []) => (one.place, true),
            ([], [one]) => (one.place, false),
            _ => {
                let states = names(&take).into_iter().chain(names(&read)).collect();
                return Err(NotAStateMachine::Source { transition: name, states });
            }
        };
        let to = match (takes, give.as_slice()) {
            (true, [one]) => Some(one.place),
            (false, []) => None,
            _ => {
                let (from, states) = (self.name(from).to_owned(), names(&give));
                return Err(NotAStateMachine::Target { transition: name, from, takes, states });
            }
        };
        if let Some(arc) = take.iter().chain(&read).chain(&give).find(|arc| arc.weight != 1) {
            return Err(NotAStateMachine::Weight {
                transition: name,
                state: self.name(arc.place).to_owned(),
            });
        }
        Ok(Move { from, to, timing: Timing::Untimed, effect: effect(transition) })
    }

    fn check_complements(&self) -> Result<(), NotAStateMachine> {
        for (id, place) in (0..).map(PlaceId).zip(self.net.places) {
            let Role::Complement(of) = place.role else { continue };
            if !matches!(self.role(of), Role::Data | Role::Shared) {
                let (place, of) = (place.name.to_owned(), self.name(of).to_owned());
                return Err(NotAStateMachine::ComplementOf { place, of });
            }
            let change = |it: &Move, place| it.effect.get(&place).copied().unwrap_or(0);
            let uneven = self.moves.iter().position(|it| change(it, id) + change(it, of) != 0);
            if let Some(transition) = uneven {
                let transition = self.net.transitions[transition].name.to_owned();
                return Err(NotAStateMachine::Complement {
                    transition,
                    place: place.name.to_owned(),
                });
            }
        }
        Ok(())
    }

    fn time(&mut self) {
        // The places touched by transitions that stay in a state while the token lies there.
        let mut touched: BTreeMap<PlaceId, BTreeSet<PlaceId>> = BTreeMap::new();
        for (it, transition) in self.moves.iter().zip(self.net.transitions) {
            if it.to.is_none() {
                let places = transition.take.iter().chain(transition.give).map(|arc| arc.place);
                touched.entry(it.from).or_default().extend(places);
            }
        }
        let foreign = |place: PlaceId| {
            let of = match self.role(place) {
                Role::Complement(of) => self.role(of),
                role => role,
            };
            matches!(of, Role::Shared | Role::Mailbox)
        };
        let timing = |(it, transition): (&Move, &Transition<'n>)| match transition.within {
            None => Timing::Untimed,
            Some(_) if transition.on.is_some() => Timing::Unkept,
            Some(within) => {
                let unsteady = |place| {
                    foreign(place) || touched.get(&it.from).is_some_and(|it| it.contains(&place))
                };
                let kept = !self.needs(transition).any(|arc| unsteady(arc.place));
                if kept { Timing::Timer(within.earliest) } else { Timing::Unkept }
            }
        };
        let timings: Vec<Timing> =
            self.moves.iter().zip(self.net.transitions).map(timing).collect();
        for (it, timing) in self.moves.iter_mut().zip(timings) {
            it.timing = timing;
        }
    }

    /// Lets transitions wait for events of their own names where the chart would not come to rest
    /// at its start: all of a net that has neither events nor time, else those that fire for ever.
    fn wait(&mut self) {
        let net = self.net;
        if net.events.is_empty() && net.transitions.iter().all(|it| it.within.is_none()) {
            self.moves.iter_mut().for_each(|it| it.timing = Timing::Named);
            return;
        }
        while let Some(endless) = self.endless_at_start() {
            for id in endless {
                self.moves[id].timing = Timing::Named;
            }
        }
    }

    /// The transitions that fire again and again at the start, before time passes or an event
    /// comes.
    fn endless_at_start(&self) -> Option<BTreeSet<usize>> {
        let net = self.net;
        let mut order: Vec<usize> = (0..net.transitions.len())
            .filter(|&id| {
                let untimed = self.moves[id].timing == Timing::Untimed;
                let at_once = untimed || self.moves[id].timing == Timing::Timer(0);
                at_once && net.transitions[id].on.is_none()
            })
            .collect();
        order.sort_by_key(|&id| {
            let timed = self.moves[id].timing != Timing::Untimed;
            (timed, Reverse(net.transitions[id].priority), id)
        });
        let mut marking: Vec<u64> = net.places.iter().map(|it| it.initial.into()).collect();
        let (mut met, mut fired) = (BTreeMap::new(), Vec::new());
        loop {
            let since = met.insert(marking.clone(), fired.len());
            if since.is_some() || fired.len() >= MOST_FIRINGS {
                let first = since.unwrap_or(fired.len() / 2);
                return Some(fired.split_off(first).into_iter().collect());
            }
            let holds = |arc: &Arc| marking[arc.place.0 as usize] >= arc.weight.into();
            let enabled = order.iter().find(|&&id| {
                let it = &net.transitions[id];
                it.take.iter().chain(it.read).all(holds)
            });
            let id = *enabled?;
            for (place, change) in effect(&net.transitions[id]) {
                let tokens = &mut marking[place.0 as usize];
                *tokens = tokens.saturating_add_signed(change);
            }
            fired.push(id);
        }
    }

    fn find_variables(&self) -> BTreeMap<PlaceId, bool> {
        let is_variable =
            |place: PlaceId| matches!(self.role(place), Role::Data | Role::Shared | Role::Mailbox);
        let places = (0..).map(PlaceId).take(self.net.places.len());
        let mut variables: BTreeMap<PlaceId, bool> = places
            .filter(|&id| is_variable(id))
            .map(|id| (id, self.net.places[id.0 as usize].bound == 1))
            .collect();
        // A bound is a claim. Only where adding a token needs the complement, no claim is needed.
        for (it, transition) in self.moves.iter().zip(self.net.transitions) {
            let missing: BTreeSet<PlaceId> = self
                .needs(transition)
                .filter_map(|arc| match self.role(arc.place) {
                    Role::Complement(of) => Some(of),
                    _ => None,
                })
                .collect();
            for (place, &change) in &it.effect {
                if change > 1 || (change == 1 && !missing.contains(place)) {
                    variables.entry(*place).and_modify(|boolean| *boolean = false);
                }
            }
        }
        variables
    }
}

/// The state that holds the one token.
fn start(net: &Net<'_>) -> Result<PlaceId, NotAStateMachine> {
    let places = (0..).map(PlaceId).zip(net.places);
    let marked: Vec<_> =
        places.filter(|(_, it)| it.role == Role::State && it.initial > 0).collect();
    match marked.as_slice() {
        [(id, place)] if place.initial == 1 => Ok(*id),
        _ => {
            let tokens = marked.iter().map(|(_, it)| (it.name.to_owned(), it.initial)).collect();
            Err(NotAStateMachine::Start { tokens })
        }
    }
}
