//! A supervisor beside a tree: what it does upon each event, and which leaves act on it.
//!
//! A [`Supervisor`] is the whole graph of a net or a system, as its player plays it, so that one
//! number is its state. A [`Bond`] says which event a leaf offers when it starts and when it is
//! halted, and by what in the net it answers: such a leaf is asked nothing. All events that no leaf
//! offers are moves of the supervisor's own, any number of them before each tick.
//!
//! ```
//! use cotama_models::nets::door;
//! use cotama_core::system::{Component, System};
//! use cotama_trees::machine::{Machine, Reply, Stop};
//! use cotama_trees::reader;
//! use cotama_trees::supervisor::{Bindings, Supervisor};
//! let text = r#"<root BTCPP_format="4"><BehaviorTree ID="Main"><A1/></BehaviorTree></root>"#;
//! let mut tree = reader::read_text(text).unwrap().tree;
//! let alone = [Component::alone(&door::NET)];
//! let door = Supervisor::of(&System::alone(&alone), None, &[]).unwrap();
//! let bindings = Bindings::read("A1 starts Call succeeds at Open").unwrap();
//! bindings.bind(&mut tree, door).unwrap();
//!
//! let mut machine = Machine::new(&tree);
//! assert!(matches!(machine.tick(), Stop::Asked(_))); // the net, which may move or rest
//! machine.reply(Reply::Rest);
//! assert_eq!(machine.marked(), ["Opening"]);
//! ```

mod binding;
mod graph;

pub use binding::{Bindings, Wrong};
pub use graph::{MOST_STATES, Unfit};
use std::collections::BTreeMap;

/// Outcome of an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// A transition fired.
    Fired,
    /// The net leaves it unanswered on purpose.
    OnPurpose,
    /// No transition is on it here, a place is full, or a mailbox is.
    Ignored,
}

/// An edge of the graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Edge {
    pub(crate) to: u32,
    /// Number of the list of transitions that fired.
    pub(crate) fired: u32,
    pub(crate) taken: Taken,
}

/// All that a supervisor can do.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Supervisor {
    /// Name of the net or the system.
    pub name: String,
    /// Names of events from outside, then of transitions that time lets fire, then of a round.
    pub events: Vec<String>,
    /// Number of events that come from outside, the first ones.
    pub told: usize,
    /// The event that lets time pass up to the next tick, where time counts.
    pub pass: Option<usize>,
    /// Events that are taken in intervals, where time does not count.
    pub timed: Vec<bool>,
    /// Names of places and mailboxes.
    pub places: Vec<String>,
    /// Names of transitions.
    pub transitions: Vec<String>,
    /// Lines of the definition that stand for several transitions, with these.
    pub lines: BTreeMap<String, Vec<u16>>,
    /// Outputs, with the transitions that emit them.
    pub outputs: BTreeMap<String, Vec<u16>>,
    /// States.
    pub states: usize,
    /// Marked places, as bits, `words` for each state.
    marks: Vec<u64>,
    words: usize,
    edges: Vec<Edge>,
    /// Lists of transitions that fired, each once.
    fired: Vec<Vec<u16>>,
}

impl Supervisor {
    /// Returns whether a place is marked.
    pub fn is_marked(&self, state: u32, place: usize) -> bool {
        let at = state as usize * self.words + place / 64;
        self.marks[at] >> (place % 64) & 1 == 1
    }

    /// Returns the names of the marked places.
    pub fn marked(&self, state: u32) -> Vec<&str> {
        let places = self.places.iter().enumerate();
        places.filter(|it| self.is_marked(state, it.0)).map(|it| it.1.as_str()).collect()
    }

    /// Returns what comes of an event.
    pub(crate) fn edge(&self, state: u32, event: usize) -> Edge {
        self.edges[state as usize * self.events.len() + event]
    }

    /// Returns what comes of an event: the state afterwards, the outcome, the transitions fired.
    pub fn offer(&self, state: u32, event: usize) -> (u32, Taken, &[u16]) {
        let it = self.edge(state, event);
        (it.to, it.taken, &self.fired[it.fired as usize])
    }
}

/// A sight of a supervisor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Sight {
    /// A place is marked.
    At(usize),
    /// A place is not marked.
    NotAt(usize),
    /// One of these transitions has fired since the leaf started.
    After(Vec<u16>),
}

/// Returns whether sights wait for transitions.
pub(crate) fn waits(when: &[Sight]) -> bool {
    when.iter().any(|it| matches!(it, Sight::After(all) if !all.is_empty()))
}

/// Returns whether sights wait for one of the transitions that fired.
pub(crate) fn waited_for(when: &[Sight], fired: &[u16]) -> bool {
    let is = |all: &[u16]| fired.iter().any(|it| all.contains(it));
    when.iter().any(|it| matches!(it, Sight::After(all) if is(all)))
}

/// Sights, of which one is enough.
pub type When = Vec<Sight>;

/// Effects of a leaf on a supervisor, and its answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bond {
    /// A condition: SUCCESS where this is so, else FAILURE.
    Reads(When),
    /// An action.
    Acts(Acts),
}

/// An action in a supervisor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Acts {
    /// The event by which it starts.
    pub starts: Option<usize>,
    /// Takes an event that is ignored for FAILURE, also where it is ignored on purpose, and not
    /// for a fault.
    pub tries: bool,
    /// SUCCESS; at once where neither this nor `fails` is given.
    pub succeeds: Option<When>,
    /// FAILURE, which goes before SUCCESS.
    pub fails: Option<When>,
    /// The event by which it is halted.
    pub halts: Option<usize>,
}

impl Acts {
    /// Returns the sights upon which it succeeds, and fails.
    pub(crate) fn ends(&self) -> [&[Sight]; 2] {
        [&self.succeeds, &self.fails].map(|it| it.as_deref().unwrap_or_default())
    }
}

/// Part of a leaf's life in which it offers an event to the supervisor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The leaf starts.
    Starts,
    /// The leaf is halted.
    Halts,
}

/// A supervisor, its own moves, and the bond of each node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bonds {
    /// The supervisor.
    pub net: Supervisor,
    /// Events that no leaf offers.
    pub moves: Vec<usize>,
    /// Bond of each node.
    pub of: Vec<Option<Bond>>,
    /// Sights upon which the whole tree is halted before a tick.
    pub cancels: When,
}

impl Bonds {
    /// Returns the name of a move.
    pub fn of_move(&self, at: u8) -> &str {
        self.moves.get(at as usize).map_or("?", |it| &self.net.events[*it])
    }

    /// Returns the name of the event that a leaf offers.
    pub fn offered(&self, node: usize, part: Part) -> Option<&str> {
        let Some(Bond::Acts(acts)) = self.of.get(node)? else { return None };
        let event = match part {
            Part::Starts => acts.starts,
            Part::Halts => acts.halts,
        };
        event.map(|it| self.net.events[it].as_str())
    }

    /// Returns the names of the transitions of a list.
    pub(crate) fn fired(&self, list: u32) -> String {
        let all = self.net.fired[list as usize].iter();
        all.map(|it| self.net.transitions[*it as usize].as_str()).collect::<Vec<_>>().join(" ")
    }

    /// Returns whether a move changes nothing in a state.
    pub fn is_idle(&self, state: u32, at: u8) -> bool {
        self.moves.get(at as usize).is_none_or(|it| {
            let (to, _, fired) = self.net.offer(state, *it);
            to == state && fired.is_empty()
        })
    }
}
