//! A system as one net that acts in rounds: the meaning that
//! [`Player`](cotama_core::player::Player) gives it.
//!
//! One token passes through the places of a round. It begins in `round`, where a round ends too;
//! then it goes from mailbox to mailbox in the order of turns, `turn.net.event`, over those that
//! are empty; at last it lies in `turn.outside`, where one event that no link leads to fires a
//! transition of its net and then all nets settle, or nothing happens, `idle`. A net with
//! transitions that fire at once by themselves has a place `turn.net` before its mailboxes, where
//! it settles. All nets have settled at the start, and settle again after the turns: in
//! `turn.rest`, which is there when a turn can leave such a transition enabled, by what it changes
//! in a shared place or by the room that it makes in a mailbox.
//!
//! To settle is to let transitions without event fire until none is enabled: the first one first,
//! and from the first one on again after each firing. One that needs room in a full mailbox is
//! passed over.
//!
//! In each place one transition is enabled but in `turn.outside`. It is what a player does there,
//! with all that follows from it, for the markings in which its tests find the same: which
//! transition of each net is the first one that is enabled, which mailboxes are empty or full. So
//! priorities and the order of transitions decide here too.

use super::branch::{Branch, Held, Known, branches};
use super::interleaving::Flat;
use super::moves::Moves;
use super::observer::Seen;
use super::path::{Part, Path};
use super::turn::{Answer, Disturbed, Play};
use super::{FlatError, MOST_TRANSITIONS};
use cotama_core::net::owned::{OwnedNet, OwnedPlace};
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::system::{Delivery, Of, System};
use std::collections::{BTreeMap, BTreeSet};

/// A system that acts in rounds, with observers.
#[derive(Clone, Debug)]
pub struct Rounds {
    /// All but transitions.
    pub(super) draft: OwnedNet,
    /// The complements that are there already, by place.
    pub(super) absent: BTreeMap<PlaceId, PlaceId>,
    pub(super) known: Known,
    pub(super) paths: Vec<Path>,
    /// Marked between two rounds.
    pub(super) round: PlaceId,
    pub(super) outside: PlaceId,
    pub(super) watches: Vec<Seen>,
}

/// An item that takes its turn, in order.
enum Item {
    /// A net settles; without one, all nets.
    Settle { at: PlaceId, component: Option<u16> },
    /// The mailbox, where the token lies while so many more are to be read, from one on, and where
    /// it lies afterwards.
    Read { event: Of<EventId>, waiting: PlaceId, at: Vec<PlaceId> },
}

impl Item {
    /// Returns the place in which the turn ends.
    fn last(&self) -> Option<PlaceId> {
        match self {
            Self::Settle { at, .. } => Some(*at),
            Self::Read { at, .. } => at.first().copied(),
        }
    }
}

/// Makes a system one net that acts in rounds.
///
/// # Errors
/// When it or one of its nets is not sound, when a transition has an interval, when a net does not
/// settle, or when the net would be too large.
///
/// ```
/// use cotama_core::{net, system};
/// use cotama_verification::check::{Model, Options, Verdict, check};
/// use cotama_verification::{flat, property};
///
/// net! {
///     /// Rings at a door and goes in.
///     pub mod visitor {
///         places { Outside: 1, Inside }
///         events { arrive, opened }
///         outputs { ring }
///         transitions {
///             ring on arrive: Outside => Outside emit ring;
///             enter on opened: Outside => Inside;
///         }
///         ignore { arrive in Inside; opened in Inside; }
///     }
/// }
/// net! {
///     /// Opens when somebody rings.
///     pub mod door {
///         places { Closed: 1, Open }
///         events { bell }
///         outputs { click }
///         transitions { open on bell: Closed => Open emit click; }
///         ignore { bell in Open; }
///     }
/// }
/// system! {
///     /// A visitor and a door.
///     pub mod house {
///         nets { visitor: visitor, door: door }
///         links { visitor.ring => door.bell mail 1; door.click => visitor.opened now; }
///     }
/// }
///
/// # fn main() -> Result<(), flat::FlatError> {
/// let net = flat::rounds(&house::SYSTEM)?.net()?;
/// let model = Model::from(&net.view().net());
/// let inside = property::parse("AG (round & door.Open -> visitor.Inside)", model.pt()).unwrap();
/// assert_eq!(check(&model, &inside, &Options::default()).verdict, Verdict::Holds(true));
/// # Ok(())
/// # }
/// ```
pub fn rounds(system: &System<'_>) -> Result<Rounds, FlatError> {
    if let Some(defect) = system.defect() {
        return Err(FlatError::Defect(defect));
    }
    for component in system.components {
        if let Some(defect) = component.net.defect() {
            return Err(FlatError::Net { net: component.name.to_owned(), defect });
        }
    }
    let flat = Flat::new(system, BTreeSet::new());
    let moves = Moves::new(&flat)?;
    let begun = Rounds::begin(&flat, &moves)?;
    // A sum that holds at the start, and that every path from a marking with it keeps, always
    // holds. Paths that only exist without the sum are left out: those of nets that meet in one
    // step are many.
    let mut guesses = moves.guesses(&flat, &begun.draft.places);
    let mut disturbed = Disturbed::new();
    loop {
        let mut rounds = begun.clone();
        let bounds = rounds.draft.places.iter().map(|it| it.bound);
        rounds.known = Known::new(bounds, moves.sums.iter().chain(&guesses).cloned().collect());
        let items = rounds.items(&flat, &moves, !disturbed.is_empty());
        let more = rounds.turns(&moves, &items, &disturbed)?;
        rounds.offer_from_outside(&flat, &moves)?;
        let before = (guesses.len(), disturbed.len());
        disturbed.extend(more);
        guesses.retain(|sum| rounds.paths.iter().all(|path| sum.stays(&path.change)));
        if (guesses.len(), disturbed.len()) == before {
            let Rounds { known, paths, .. } = &mut rounds;
            paths.iter_mut().for_each(|it| it.held = known.essential(&it.held));
            return Ok(rounds);
        }
    }
}

impl Rounds {
    /// The places of the system as it starts, settled.
    fn begin(flat: &Flat<'_>, moves: &Moves) -> Result<Self, FlatError> {
        let mut draft = flat.net.clone();
        for (name, net) in (0..flat.components()).map(|it| flat.component(it)) {
            for output in net.outputs {
                let name = format!("{name}.{}", output.name);
                draft.output(&name, output.doc).map_err(|_| FlatError::TooMany)?;
            }
        }
        let known = Known::new(draft.places.iter().map(|it| it.bound), moves.sums.clone());
        let tokens = |at: usize| i64::from(draft.places[at].initial);
        let held = (0..draft.places.len()).map(|at| (PlaceId(at as u32), (tokens(at), tokens(at))));
        let mut start = Branch::new(&known, held.collect());
        Play::new(moves, &mut start).settle_all()?;
        let change = start.change;
        let mut rounds = Self {
            draft,
            absent: flat.absent.clone(),
            known,
            paths: Vec::new(),
            round: PlaceId(0),
            outside: PlaceId(0),
            watches: Vec::new(),
        };
        for (place, change) in change {
            for (place, change) in rounds
                .absent
                .get(&place)
                .map(|&it| (it, -change))
                .into_iter()
                .chain([(place, change)])
            {
                let initial = &mut rounds.draft.places[place.0 as usize].initial;
                *initial = u32::try_from(i64::from(*initial) + change).unwrap_or(*initial);
            }
        }
        rounds.round =
            rounds.place("round", "One round has ended, and the next one has not begun.", 1, 1);
        Ok(rounds)
    }

    pub(super) fn place(&mut self, name: &str, doc: &str, initial: u32, bound: u32) -> PlaceId {
        self.known.add(bound);
        self.draft.places.push(OwnedPlace::new(name, initial).at_most(bound).doc(doc));
        PlaceId(self.draft.places.len() as u32 - 1)
    }

    /// The order of turns; and the place of what is outside.
    fn items(&mut self, flat: &Flat<'_>, moves: &Moves, rest: bool) -> Vec<Item> {
        let mut items = Vec::new();
        // No net may be called as the turns are.
        let mut turn = "turn".to_owned();
        while flat.system.components.iter().any(|it| it.name == turn) {
            turn.push('_');
        }
        for component in 0..flat.components() {
            let (name, net) = flat.component(component);
            if moves.settles(component) {
                let at = self.place(&format!("{turn}.{name}"), &format!("{name} settles."), 0, 1);
                items.push(Item::Settle { at, component: Some(component) });
            }
            for (event, number) in net.events.iter().zip(0..) {
                let event_of = Of { component, id: EventId(number) };
                let Some(Delivery::Mail { capacity }) = flat.system.delivery(event_of) else {
                    continue;
                };
                let (waiting, ..) = flat.mailboxes[&(component, number)];
                let label = format!("{turn}.{name}.{}", event.name);
                let doc = format!("{name} reads {}.", event.name);
                let left =
                    |left: u16| if left == 1 { label.clone() } else { format!("{label}.{left}") };
                let at = (1..=capacity).map(|it| self.place(&left(it), &doc, 0, 1)).collect();
                items.push(Item::Read { event: event_of, waiting, at });
            }
        }
        if rest {
            let at = self.place(&format!("{turn}.rest"), "All nets settle.", 0, 1);
            items.push(Item::Settle { at, component: None });
        }
        self.outside =
            self.place(&format!("{turn}.outside"), "What is outside may do one thing.", 0, 1);
        items
    }

    /// Every net takes its turn; which transitions this may disturb.
    fn turns(
        &mut self,
        moves: &Moves,
        items: &[Item],
        disturbed: &Disturbed,
    ) -> Result<Disturbed, FlatError> {
        let mut from = self.round;
        let mut more = Disturbed::new();
        for (at, item) in items.iter().enumerate() {
            self.go_on(from, &items[at..]);
            let after = match item.last() {
                Some(last) if at + 1 < items.len() => {
                    let name = self.label(last);
                    let name = name.replacen("turn", "after", 1);
                    self.place(
                        &name,
                        "The token goes on to the next mailbox that is not empty.",
                        0,
                        1,
                    )
                }
                _ => self.outside,
            };
            match item {
                Item::Settle { at, component } => {
                    let known = self.known.clone();
                    let step = |branch: &mut Branch<'_>| {
                        let mut play = Play::new(moves, branch);
                        if let Some(component) = component {
                            play.settle(*component)?;
                            more.append(&mut play.disturbs());
                        } else {
                            play.rest(disturbed)?;
                        }
                        Ok((play.name, play.emits))
                    };
                    branches(&known, &Held::new(), step, |branch, (name, emits)| {
                        let part = if name.is_empty() { Part::Between } else { Part::Turn };
                        let name =
                            if name.is_empty() { "settled".to_owned() } else { name.join(" + ") };
                        let path = Path::new(part, name, *at, after, branch);
                        self.push(Path { emits, ..path })
                    })?;
                }
                Item::Read { event, waiting, at } => {
                    more.append(&mut self.read(moves, *event, *waiting, at, after)?);
                }
            }
            from = after;
        }
        if items.is_empty() {
            self.go_on(from, &[]);
        }
        Ok(more)
    }

    /// A net reads a mailbox: where the token lies while so many more are to be read, and where it
    /// lies afterwards. Which transitions this may disturb.
    fn read(
        &mut self,
        moves: &Moves,
        event: Of<EventId>,
        waiting: PlaceId,
        at: &[PlaceId],
        after: PlaceId,
    ) -> Result<Disturbed, FlatError> {
        let known = self.known.clone();
        let mut disturbed = Disturbed::new();
        for (left, &here) in at.iter().enumerate() {
            let next = if left == 0 { after } else { at[left - 1] };
            let held = if at.len() == 1 { Held::from([(waiting, (1, 1))]) } else { Held::new() };
            let step = |branch: &mut Branch<'_>| {
                let mut play = Play::new(moves, branch);
                let mut answer = None;
                if play.branch.holds(waiting, 1) {
                    play.branch.add(waiting, -1);
                    answer = Some(play.deliver(event)?);
                    if answer == Some(Answer::Refused) {
                        play.branch.add(waiting, 1);
                    }
                }
                disturbed.append(&mut play.disturbs());
                Ok((answer, play.name, play.doc, play.emits))
            };
            branches(&known, &held, step, |branch, (answer, name, doc, emits)| {
                let (part, name, to) = match answer {
                    None => (Part::Between, format!("{} is empty", self.label(waiting)), after),
                    Some(Answer::Refused) => {
                        (Part::Turn, format!("{} goes on", self.label(waiting)), after)
                    }
                    Some(_) => (Part::Turn, name.join(" + "), next),
                };
                self.push(Path { doc, emits, ..Path::new(part, name, here, to, branch) })
            })?;
        }
        Ok(disturbed)
    }

    fn label(&self, waiting: PlaceId) -> &str {
        &self.draft.places[waiting.0 as usize].name
    }

    /// Over empty mailboxes to the first one that is not, to a net that settles, or to what is
    /// outside.
    fn go_on(&mut self, from: PlaceId, items: &[Item]) {
        let known = self.known.clone();
        let mut empty = Held::new();
        for item in items {
            match item {
                Item::Settle { at, .. } => {
                    let branch = Branch::new(&known, empty);
                    let name = format!("to {}", self.label(*at));
                    self.paths.push(Path::new(Part::Between, name, from, *at, &branch));
                    return;
                }
                Item::Read { waiting, at, .. } => {
                    for (&to, tokens) in at.iter().zip(1..) {
                        let mut branch = Branch::new(&known, empty.clone());
                        branch.held.insert(*waiting, (tokens, tokens));
                        let name = format!("to {}", self.label(to));
                        self.paths.push(Path::new(Part::Between, name, from, to, &branch));
                    }
                    empty.insert(*waiting, (0, 0));
                }
            }
        }
        let name = format!("to {}", self.label(self.outside));
        let branch = Branch::new(&known, empty);
        self.paths.push(Path::new(Part::Between, name, from, self.outside, &branch));
    }

    /// One event that no link leads to, or none.
    fn offer_from_outside(&mut self, flat: &Flat<'_>, moves: &Moves) -> Result<(), FlatError> {
        let known = self.known.clone();
        let idle = Path::new(
            Part::Outside,
            "idle".to_owned(),
            self.outside,
            self.round,
            &Branch::new(&known, Held::new()),
        );
        self.push(idle)?;
        for component in 0..flat.components() {
            let (name, net) = flat.component(component);
            for (event, number) in net.events.iter().zip(0..) {
                let of = Of { component, id: EventId(number) };
                if flat.system.delivery(of).is_some() {
                    continue;
                }
                let label = format!("{name}.{}", event.name);
                let on = self.draft.event(&label, event.doc).map_err(|_| FlatError::TooMany)?;
                let step = |branch: &mut Branch<'_>| {
                    let mut play = Play::new(moves, branch);
                    let answer = play.deliver(of)?;
                    let happened = play.name.len();
                    play.rest(&Disturbed::new())?;
                    let fires = play.name.len() > happened;
                    Ok((answer, fires, play.name, play.doc, play.emits))
                };
                let (from, to) = (self.outside, self.round);
                branches(
                    &known,
                    &Held::new(),
                    step,
                    |branch, (answer, fires, name, doc, emits)| {
                        // An event that is ignored and changes nothing is as if it had not come.
                        let changes = fires || branch.change.values().any(|&it| it != 0);
                        if answer == Answer::Refused || (answer == Answer::Ignored && !changes) {
                            return Ok(());
                        }
                        let path = Path::new(Part::Outside, name.join(" + "), from, to, branch);
                        self.push(Path { doc, on: Some(on), emits, ..path })
                    },
                )?;
            }
        }
        Ok(())
    }

    pub(super) fn push(&mut self, path: Path) -> Result<(), FlatError> {
        if self.paths.len() >= MOST_TRANSITIONS {
            return Err(FlatError::TooMany);
        }
        self.paths.push(path);
        Ok(())
    }

    /// Returns the part of a round that a transition of the net plays.
    pub fn part(&self, transition: TransitionId) -> Option<Part> {
        self.paths.get(transition.0 as usize).map(|it| it.part)
    }

    /// Marked between two rounds.
    pub const fn round(&self) -> PlaceId {
        self.round
    }

    /// Marked when it is the turn of what is outside.
    pub const fn outside(&self) -> PlaceId {
        self.outside
    }
}
