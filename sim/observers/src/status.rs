//! The module status vector: which modules and data are sound, suspect or lost.

/// The most items of a vector.
pub const MAX_ITEMS: usize = 64;

/// A module, a datum or a device: a number below [`MAX_ITEMS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Item(u8);

impl Item {
    /// Returns the item of a number, if it is below [`MAX_ITEMS`].
    pub const fn new(number: u8) -> Option<Self> {
        if (number as usize) < MAX_ITEMS { Some(Self(number)) } else { None }
    }

    /// Returns its number.
    pub const fn number(self) -> usize {
        self.0 as usize
    }
}

/// A set of items.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Items(u64);

impl Items {
    /// No item.
    pub const NONE: Self = Self(0);

    /// The set of one item.
    pub const fn of(item: Item) -> Self {
        Self(1 << item.0)
    }

    /// Returns the items of both.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Returns the items that are not in the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether an item is in it.
    pub const fn has(self, item: Item) -> bool {
        self.0 >> item.0 & 1 == 1
    }

    /// Whether no item is in it.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Returns its items, the lowest number first.
    pub fn iter(self) -> impl Iterator<Item = Item> {
        (0..MAX_ITEMS as u8).map(Item).filter(move |it| self.has(*it))
    }
}

impl FromIterator<Item> for Items {
    fn from_iter<I: IntoIterator<Item = Item>>(items: I) -> Self {
        items.into_iter().fold(Self::NONE, |all, it| all.and(Self::of(it)))
    }
}

/// The state of an item; later is worse.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Nothing speaks against it.
    #[default]
    Sound,
    /// Perhaps broken, or its data may be wrong.
    Suspect,
    /// Broken, or its data are corrupt.
    Lost,
}

/// The needs of items: what has to work, and which data have to be right, for each of them.
///
/// Circles are allowed: items that need each other are lost together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Needs {
    /// The items that are in danger with each: itself, and all that need it over any steps.
    dependants: [Items; MAX_ITEMS],
}

impl Default for Needs {
    fn default() -> Self {
        Self::none()
    }
}

impl Needs {
    /// Items that need nothing.
    pub fn none() -> Self {
        Self { dependants: core::array::from_fn(|it| Items(1 << it)) }
    }

    /// Needs as pairs: the first item needs the second.
    pub fn of(pairs: impl IntoIterator<Item = (Item, Item)>) -> Self {
        let mut all = Self::none();
        for (of, needed) in pairs {
            let Some(on) = all.dependants.get_mut(needed.number()) else { continue };
            *on = on.and(Items::of(of));
        }
        all.close();
        all
    }

    /// Adds what follows over several steps (Warshall, Journal of the ACM 9(1), 1962).
    fn close(&mut self) {
        for by in (0..MAX_ITEMS as u8).map(Item) {
            let Some(further) = self.dependants.get(by.number()).copied() else { continue };
            for on in self.dependants.iter_mut().filter(|it| it.has(by)) {
                *on = on.and(further);
            }
        }
    }

    /// Returns some items and all that need any of them.
    pub fn closure(&self, of: Items) -> Items {
        let dependants = |it: Item| self.dependants.get(it.number()).copied().unwrap_or_default();
        of.iter().map(dependants).fold(of, Items::and)
    }
}

/// A change of the vector: the items whose state is another now, by that state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StatusEvent {
    /// Items that have become sound.
    pub sound: Items,
    /// Items that have become suspect.
    pub suspect: Items,
    /// Items that have become lost.
    pub lost: Items,
}

/// The module status vector (Durand et al., TAROS 2010, Section V.A.3): the state of each item, as
/// it is said of itself and as it follows from what it needs, with an event whenever it changes.
///
/// An item is lost if it, or any item that it needs, is said to be lost; if not, suspect if any of
/// these is said to be suspect. Losing the sonars takes the modules that need their ranges:
///
/// ```
/// use cotama_observers::{Item, Items, Needs, Status, StatusVector};
/// let item = |it| Item::new(it).unwrap();
/// let [sonars, ust, mcl, smz, nav] = [0, 1, 2, 3, 4].map(item);
/// let needs = Needs::of([(ust, sonars), (mcl, ust), (smz, ust), (smz, nav)]);
/// let mut vector = StatusVector::new(needs);
/// let event = vector.say(sonars, Status::Lost).unwrap();
/// assert_eq!(event.lost, Items::from_iter([sonars, ust, mcl, smz]));
/// assert_eq!(vector.status(nav), Status::Sound);
/// assert!(vector.say(mcl, Status::Suspect).is_none()); // lost already, so nothing changes
/// let event = vector.say(sonars, Status::Sound).unwrap();
/// assert_eq!((event.suspect, event.lost), (Items::of(mcl), Items::NONE));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StatusVector {
    needs: Needs,
    /// As was said of the items themselves. Invariant: no item is in both.
    said_suspect: Items,
    said_lost: Items,
    /// As it follows. Invariant: no item is in both.
    suspect: Items,
    lost: Items,
}

impl StatusVector {
    /// A vector of sound items.
    pub const fn new(needs: Needs) -> Self {
        let none = Items::NONE;
        Self { needs, said_suspect: none, said_lost: none, suspect: none, lost: none }
    }

    /// Says the state of an item itself: by an observer, or as its data have become corrupt.
    pub fn say(&mut self, item: Item, status: Status) -> Option<StatusEvent> {
        let one = Items::of(item);
        let [suspect, lost] =
            [Status::Suspect, Status::Lost].map(|it| if it == status { one } else { Items::NONE });
        self.say_all(
            self.said_suspect.without(one).and(suspect),
            self.said_lost.without(one).and(lost),
        )
    }

    /// Says the state of all items themselves at once: those that are suspect, those that are
    /// lost (an item in both is), and all others sound. There is one event of all that changes.
    pub fn say_all(&mut self, suspect: Items, lost: Items) -> Option<StatusEvent> {
        self.said_suspect = suspect.without(lost);
        self.said_lost = lost;
        let (was_suspect, was_lost) = (self.suspect, self.lost);
        self.lost = self.needs.closure(lost);
        self.suspect = self.needs.closure(suspect).without(self.lost);
        debug_assert!(self.is_valid(), "an item is not suspect and lost");
        let event = StatusEvent {
            sound: was_suspect.and(was_lost).without(self.suspect.and(self.lost)),
            suspect: self.suspect.without(was_suspect),
            lost: self.lost.without(was_lost),
        };
        (self.suspect != was_suspect || self.lost != was_lost).then_some(event)
    }

    /// Returns the state of an item.
    pub const fn status(&self, item: Item) -> Status {
        if self.lost.has(item) {
            Status::Lost
        } else if self.suspect.has(item) {
            Status::Suspect
        } else {
            Status::Sound
        }
    }

    /// Returns the items that are suspect.
    pub const fn suspect(&self) -> Items {
        self.suspect
    }

    /// Returns the items that are lost.
    pub const fn lost(&self) -> Items {
        self.lost
    }

    fn is_valid(&self) -> bool {
        let both = |a: Items, b: Items| a.0 & b.0;
        both(self.suspect, self.lost) == 0 && both(self.said_suspect, self.said_lost) == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn item(number: u8) -> Item {
        Item::new(number).unwrap()
    }

    fn set<const N: usize>(numbers: [u8; N]) -> Items {
        numbers.map(item).into_iter().collect()
    }

    /// 0 <- 1 <- 2, and 3 by itself.
    fn chain() -> StatusVector {
        StatusVector::new(Needs::of([(item(1), item(0)), (item(2), item(1))]))
    }

    #[test]
    fn a_loss_takes_dependants_and_nothing_else() {
        let mut vector = chain();
        let event = vector.say(item(1), Status::Lost).unwrap();
        let none = Items::NONE;
        assert_eq!(event, StatusEvent { sound: none, suspect: none, lost: set([1, 2]) });
        assert_eq!(
            [0, 1, 2, 3].map(|it| vector.status(item(it)) == Status::Lost),
            [false, true, true, false]
        );
    }

    #[test]
    fn an_event_tells_each_change_once() {
        let mut vector = chain();
        assert!(vector.say(item(0), Status::Suspect).is_some());
        assert_eq!(vector.say(item(0), Status::Suspect), None);
        let event = vector.say(item(2), Status::Lost).unwrap();
        assert_eq!((event.suspect, event.lost), (Items::NONE, set([2])));
        let event = vector.say(item(0), Status::Sound).unwrap();
        assert_eq!((event.sound, event.lost), (set([0, 1]), Items::NONE));
        assert_eq!((vector.suspect(), vector.lost()), (Items::NONE, set([2])));
    }

    #[test]
    fn items_that_need_each_other_are_lost_together() {
        let needs = Needs::of([(item(0), item(63)), (item(63), item(0))]);
        assert_eq!(needs.closure(set([0])), set([0, 63]));
        assert_eq!(needs.closure(set([63])), set([0, 63]));
    }

    #[test]
    fn a_vector_ends_at_64_items() {
        assert_eq!(Item::new(63).map(Item::number), Some(63));
        assert_eq!(Item::new(64), None);
    }

    fn pairs() -> impl Strategy<Value = Vec<(u8, u8)>> {
        proptest::collection::vec((0..64_u8, 0..64_u8), 0..80)
    }

    fn needs(pairs: &[(u8, u8)]) -> Needs {
        Needs::of(pairs.iter().map(|&(of, needed)| (item(of), item(needed))))
    }

    proptest! {
        #[test]
        fn closure_is_idempotent_monotone_and_extensive(
            pairs in pairs(), one in any::<u64>(), other in any::<u64>()
        ) {
            let needs = needs(&pairs);
            let (one, other) = (Items(one & other), Items(other));
            let closed = needs.closure(one);
            prop_assert_eq!(needs.closure(closed), closed);
            prop_assert!(closed.without(needs.closure(other)).is_empty());
            prop_assert!(one.without(closed).is_empty());
        }

        #[test]
        fn closure_is_what_single_steps_reach(pairs in pairs(), of in 0..64_u8) {
            let mut reached = Items::of(item(of));
            loop {
                let before = reached;
                for &(dependant, needed) in &pairs {
                    if reached.has(item(needed)) {
                        reached = reached.and(Items::of(item(dependant)));
                    }
                }
                if reached == before {
                    break;
                }
            }
            prop_assert_eq!(needs(&pairs).closure(Items::of(item(of))), reached);
        }

        #[test]
        fn events_add_up_to_the_vector(
            pairs in pairs(), said in proptest::collection::vec((0..64_u8, 0..3_u8), 0..40)
        ) {
            let mut vector = StatusVector::new(needs(&pairs));
            let mut told = [Status::Sound; MAX_ITEMS];
            for (of, state) in said {
                let status = [Status::Sound, Status::Suspect, Status::Lost][state as usize];
                let Some(event) = vector.say(item(of), status) else { continue };
                let changes = [
                    (Status::Sound, event.sound),
                    (Status::Suspect, event.suspect),
                    (Status::Lost, event.lost),
                ];
                for (status, items) in changes {
                    items.iter().for_each(|it| told[it.number()] = status);
                }
            }
            for it in (0..64).map(item) {
                prop_assert_eq!(told[it.number()], vector.status(it));
            }
        }
    }
}
