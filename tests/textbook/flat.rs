//! A system written out: every number of tokens and every transition once, over all nets.

use cotama_core::net::{Arc, EventId, PlaceId, Role, TransitionId, Within};
use cotama_core::player::LARGEST;
use cotama_core::system::{Delivery, Of, System, Target};
use std::cmp::Reverse;

/// The meaning of a number of tokens.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cell {
    /// The tokens of a place.
    Place(Of<PlaceId>),
    /// The free room of a place up to its bound.
    Absence(Of<PlaceId>),
    /// The events waiting in the mailbox of an event.
    Waiting(Of<EventId>),
    /// For how many more there is room in it.
    Room(Of<EventId>),
}

/// Tokens of some cells, by their positions.
pub type Tokens = Vec<(usize, u32)>;

/// A transition, with its arcs in cells and its outputs as what they cause.
#[derive(Clone, Debug)]
pub struct Line {
    /// Which one.
    pub id: Of<TransitionId>,
    /// The event it needs.
    pub on: Option<Of<EventId>>,
    /// Tokens that it removes.
    pub take: Tokens,
    /// Tokens that must be there and stay.
    pub read: Tokens,
    /// Tokens that it adds.
    pub give: Tokens,
    /// The events that it causes, in this order.
    pub says: Vec<(Of<EventId>, Delivery)>,
    /// Interval.
    pub within: Option<Within>,
}

/// A system written out.
#[derive(Debug)]
pub struct Book {
    /// All cells, with the most that they hold.
    pub cells: Vec<(Cell, u32)>,
    /// Tokens at the start.
    pub initial: Vec<u32>,
    /// All transitions, in the order of the components.
    pub lines: Vec<Line>,
    /// Positions of transitions: those of the highest priority first, then the earlier ones.
    pub order: Vec<usize>,
    /// The events that have a mailbox, in the order of the turns.
    pub mailboxes: Vec<Of<EventId>>,
}

/// All of this kind that the nets have, in their order.
fn all(counts: impl Iterator<Item = usize>) -> impl Iterator<Item = Of<u32>> {
    (0..)
        .zip(counts)
        .flat_map(|(component, count)| (0..count as u32).map(move |id| Of { component, id }))
}

impl Book {
    /// This system written out.
    pub fn of(system: &System<'_>) -> Self {
        let nets = || system.components.iter().map(|it| it.net);
        let mut book = Self {
            cells: Vec::new(),
            initial: Vec::new(),
            lines: Vec::new(),
            order: Vec::new(),
            mailboxes: Vec::new(),
        };
        for Of { component, id } in all(nets().map(|it| it.places.len())) {
            book.add(system, cell(system, Of { component, id: PlaceId(id) }));
        }
        for binding in system.bindings {
            // The free room of a place that several nets share counts as tokens do.
            if let Target::Place(of) = binding.target {
                book.add(system, Cell::Absence(of));
            }
        }
        for Of { component, id } in all(nets().map(|it| it.events.len())) {
            let event = Of { component, id: EventId(id) };
            if let Some(Delivery::Mail { .. }) = system.delivery(event) {
                book.mailboxes.push(event);
                book.add(system, Cell::Waiting(event));
                book.add(system, Cell::Room(event));
            }
        }
        for Of { component, id } in all(nets().map(|it| it.transitions.len())) {
            book.lines.push(book.line(system, Of { component, id: TransitionId(id) }));
        }
        let priority = |at: usize| {
            let Of { component, id } = book.lines[at].id;
            system.components[usize::from(component)].net.transitions[id.0 as usize].priority
        };
        book.order = (0..book.lines.len()).collect();
        book.order.sort_by_key(|&at| (Reverse(priority(at)), at));
        book
    }

    fn add(&mut self, system: &System<'_>, cell: Cell) {
        if self.cells.iter().any(|it| it.0 == cell) {
            return;
        }
        let (bound, initial) = match cell {
            Cell::Place(of) | Cell::Absence(of) => {
                let net = system.components[usize::from(of.component)].net;
                let place = &net.places[of.id.0 as usize];
                (place.bound.min(LARGEST), place.initial)
            }
            Cell::Waiting(event) | Cell::Room(event) => match system.delivery(event) {
                Some(Delivery::Mail { capacity }) => (u32::from(capacity), 0),
                _ => unreachable!("an event with a mailbox"),
            },
        };
        let lacks = matches!(cell, Cell::Absence(_) | Cell::Room(_));
        self.cells.push((cell, bound));
        self.initial.push(if lacks { bound - initial } else { initial });
    }

    /// The position of a cell.
    pub fn find(&self, cell: Cell) -> Option<usize> {
        self.cells.iter().position(|it| it.0 == cell)
    }

    /// The position of the cell of a place.
    ///
    /// # Panics
    /// When the system has no such place.
    pub fn place(&self, system: &System<'_>, of: Of<PlaceId>) -> usize {
        self.find(cell(system, of)).expect("every place has a cell")
    }

    fn line(&self, system: &System<'_>, id: Of<TransitionId>) -> Line {
        let component = id.component;
        let it = &system.components[usize::from(component)].net.transitions[id.id.0 as usize];
        let tokens = |arcs: &[Arc]| -> Tokens {
            let one = |it: &Arc| (self.place(system, Of { component, id: it.place }), it.weight);
            arcs.iter().map(one).collect()
        };
        let (mut take, mut give) = (tokens(it.take), tokens(it.give));
        // A transition that changes a place changes its free room, by the net change, if not by
        // arcs of its own.
        for at in 0..self.cells.len() {
            let Cell::Place(of) = self.cells[at].0 else { continue };
            let Some(absence) = self.find(Cell::Absence(of)) else { continue };
            let (taken, given) = (weight(&take, at), weight(&give, at));
            if weight(&take, absence) > 0 || weight(&give, absence) > 0 {
                continue;
            }
            match taken.cmp(&given) {
                std::cmp::Ordering::Less => take.push((absence, given - taken)),
                std::cmp::Ordering::Equal => {}
                std::cmp::Ordering::Greater => give.push((absence, taken - given)),
            }
        }
        let caused = it.emits.iter().flat_map(|&output| {
            let from = Of { component, id: output };
            system.links.iter().filter(move |it| it.from == from).map(|it| (it.to, it.delivery))
        });
        Line {
            id,
            on: it.on.map(|event| Of { component, id: event }),
            take,
            read: tokens(it.read),
            give,
            says: caused.collect(),
            within: it.within,
        }
    }
}

/// Returns the cell of the system for a place of a net.
fn cell(system: &System<'_>, of: Of<PlaceId>) -> Cell {
    let net = system.components[usize::from(of.component)].net;
    match net.places[of.id.0 as usize].role {
        Role::Shared => match system.target(of) {
            Some(Target::Place(owner)) => Cell::Place(owner),
            Some(Target::Mailbox(event)) => Cell::Waiting(event),
            None => Cell::Place(of),
        },
        Role::Complement(id) => match cell(system, Of { id, ..of }) {
            Cell::Waiting(event) => Cell::Room(event),
            Cell::Place(owner) => Cell::Absence(owner),
            other => other,
        },
        _ => Cell::Place(of),
    }
}

/// How many tokens of this cell.
pub fn weight(tokens: &[(usize, u32)], cell: usize) -> u32 {
    tokens.iter().find(|it| it.0 == cell).map_or(0, |it| it.1)
}
