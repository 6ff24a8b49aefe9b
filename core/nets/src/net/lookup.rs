//! Names of a definition, looked up.

use super::data::{EventId, PlaceId, Signal};
use super::source::{Declared, Line, Source};
use super::text::{Text, same};

/// The kind and position of a found name.
#[derive(Clone, Copy)]
pub(super) enum Found {
    /// A place.
    Place(usize),
    /// A flag, counter or shared place: its position, and that among those with a complement.
    Data(usize, usize),
    /// A group.
    Group(usize),
    /// Nowhere.
    Nothing,
}

/// The kind that a name is expected to have.
#[derive(Clone, Copy)]
pub(super) enum Meant {
    /// A place.
    Place,
    /// A place or a group.
    PlaceOrGroup,
    /// A flag, counter or shared place.
    Data,
    /// Any of these but a group.
    Any,
    /// A place, a group, a flag, a counter or a shared place.
    AnyOrGroup,
}

/// The most names among which a misspelt one is looked for.
const SEARCHED: usize = 256;

impl Source<'_> {
    /// Places without complements: places, flags, counters and shared ones, in this order.
    pub(super) const fn own_places(&self) -> usize {
        self.places.len() + self.data()
    }

    /// Flags, counters and shared places: those with a complement.
    pub(super) const fn data(&self) -> usize {
        self.flags.len() + self.counters.len() + self.shared.len()
    }

    /// The declaration of a place by its position.
    pub(super) const fn declared(&self, at: usize) -> Declared<'_> {
        let (places, flags, counters) = (self.places.len(), self.flags.len(), self.counters.len());
        if at < places {
            self.places[at]
        } else if at < places + flags {
            self.flags[at - places]
        } else if at < places + flags + counters {
            self.counters[at - places - flags]
        } else {
            self.shared[at - places - flags - counters]
        }
    }

    pub(super) const fn find(&self, name: &str) -> Found {
        let places = self.places.len();
        let mut before = 0;
        let lists = [self.places, self.flags, self.counters, self.shared];
        // Compared here: an interpreter evaluates this most of all, and calls cost it most.
        let wanted = name.as_bytes();
        let size = wanted.len();
        let mut list = 0;
        while list < lists.len() {
            let declared = lists[list];
            let length = declared.len();
            let mut at = 0;
            while at < length {
                let found = declared[at].name.as_bytes();
                let mut byte = 0;
                while byte < size && found.len() == size && found[byte] == wanted[byte] {
                    byte += 1;
                }
                if byte == size && found.len() == size {
                    let place = before + at;
                    return if list == 0 {
                        Found::Place(place)
                    } else {
                        Found::Data(place, place - places)
                    };
                }
                at += 1;
            }
            before += length;
            list += 1;
        }
        let mut at = 0;
        while at < self.groups.len() {
            if same(self.groups[at].name, name) {
                return Found::Group(at);
            }
            at += 1;
        }
        Found::Nothing
    }

    /// The complement of the data place at this position among them.
    pub(super) const fn complement(&self, data: usize) -> PlaceId {
        PlaceId((self.own_places() + data) as u32)
    }

    /// Begins the text of an error in a line.
    pub(super) const fn at_line(&self, line: &Line<'_>) -> Text {
        let text = Text::new().with("net ").name(self.name);
        if line.is_ignore() {
            text.with(", ignore of ").name(line.on).with(": ")
        } else {
            text.with(", transition ").name(line.name).with(": ")
        }
    }

    /// Ends the compilation: this name is not there.
    #[track_caller]
    pub(super) const fn nothing(&self, text: Text, name: &str, meant: Meant) -> ! {
        let (places, own) = (self.places.len(), self.own_places());
        let (what, mut from, to, groups) = match meant {
            Meant::Place => ("place", 0, places, false),
            Meant::PlaceOrGroup => ("place or group", 0, places, true),
            Meant::Data => ("flag, counter or shared place", places, own, false),
            Meant::Any => ("place, flag or counter", 0, own, false),
            Meant::AnyOrGroup => ("place, flag, counter or group", 0, own, true),
        };
        let mut known = [""; SEARCHED];
        let mut count = 0;
        while from < to && count < SEARCHED {
            known[count] = self.declared(from).name;
            count += 1;
            from += 1;
        }
        let mut at = 0;
        while groups && at < self.groups.len() && count < SEARCHED {
            known[count] = self.groups[at].name;
            count += 1;
            at += 1;
        }
        text.unknown(what, name, known.split_at(count).0)
    }

    #[track_caller]
    pub(super) const fn event(&self, text: Text, name: &str) -> EventId {
        EventId(signal(text, "event", self.events, name))
    }

    /// A place, flag or counter that a law or an ignored event names.
    #[track_caller]
    pub(super) const fn place(&self, text: Text, name: &str, meant: Meant) -> PlaceId {
        match self.find(name) {
            Found::Place(place) | Found::Data(place, _) => PlaceId(place as u32),
            Found::Group(_) => text.name(name).with(" is a group; name a place").stop(),
            Found::Nothing => self.nothing(text, name, meant),
        }
    }
}

/// The position of an event or output of this name.
pub(super) const fn position(signals: &[Signal<'_>], name: &str) -> Option<u32> {
    let mut at = 0;
    while at < signals.len() {
        if same(signals[at].name, name) {
            return Some(at as u32);
        }
        at += 1;
    }
    None
}

#[track_caller]
pub(super) const fn signal(text: Text, what: &str, signals: &[Signal<'_>], name: &str) -> u32 {
    if let Some(at) = position(signals, name) {
        return at;
    }
    let mut known = [""; 256];
    let count = if signals.len() < known.len() { signals.len() } else { known.len() };
    let mut at = 0;
    while at < count {
        known[at] = signals[at].name;
        at += 1;
    }
    text.unknown(what, name, known.split_at(count).0)
}
