//! Nets made at run time, packed on the heap so that a [`Player`](super::Player) plays them.

use super::code::{
    Borrowed, Clock, Code, Entry, Field, LARGEST, Lists, NO_CLOCK, Words, pack, size,
};
use super::data::Net;
use super::defect::Defect;
use super::program::Loaded;
use alloc::vec;
use alloc::vec::Vec;

/// The most transitions that fire at once one after another, where no bound is proven.
pub const SETTLE: u32 = 1_000;

/// The lists of a [`Code`], on the heap.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_core::net::{EventId, Outcome, Packed, Player, TransitionId, words};
/// use cotama_core::units::Millis;
///
/// let mut net = OwnedNet::new("lamp", "");
/// let (off, on) = (net.place(OwnedPlace::new("off", 1)).unwrap(), net.place(OwnedPlace::new("on", 0)).unwrap());
/// let press = net.event("press", "").unwrap();
/// net.transition(OwnedTransition::new("light").on(press).take(off, 1).give(on, 1)).unwrap();
/// let (view, now) = (net.view(), Millis(0));
/// let net = view.net();
///
/// assert_eq!(words(&net), Some(1)); // how many machine words a marking needs
/// let packed = Packed::<1>::of(&net).unwrap();
/// let mut player = Player::<_, 1, 0>::start(packed.load(&net), now, &mut ());
/// assert_eq!(player.offer(now, &press), Outcome::Fired { transition: TransitionId(0), settled: 0 });
/// assert_eq!(player.tokens(on), 1);
/// ```
#[derive(Clone, Debug)]
pub struct Packed<const W: usize> {
    entries: Vec<Entry<W>>,
    takes: Vec<[u64; W]>,
    order: Vec<u16>,
    rows: Vec<u16>,
    clocks: Vec<Clock<W>>,
    fields: Vec<Field>,
    ignored: Vec<[u64; W]>,
    words: Words<W>,
}

/// How many machine words a marking of this net needs; `None` when it has too many places, events
/// or transitions to be played.
pub fn words(net: &Net<'_>) -> Option<usize> {
    size(net).map(|size| size.words)
}

/// How many transitions of this net have an interval: the `C` of its player, at least.
pub fn clocks(net: &Net<'_>) -> usize {
    net.transitions.iter().filter(|it| it.within.is_some()).count()
}

impl<const W: usize> Packed<W> {
    /// Packs a net. Places of which no bound is claimed hold up to [`LARGEST`] tokens.
    ///
    /// # Errors
    /// The defect of the net; [`Defect::Place`] when a place starts with more than that;
    /// [`Defect::TooLong`] when it has too many parts, or `W` is less than [`words`].
    pub fn of(net: &Net<'_>) -> Result<Self, Defect> {
        if let Some(defect) = net.defect() {
            return Err(defect);
        }
        if let Some(place) = net.places.iter().position(|place| place.initial > LARGEST) {
            return Err(Defect::Place { place });
        }
        let size = size(net).filter(|size| size.words <= W).ok_or(Defect::TooLong)?;
        let entry = Entry { need: [0; W], delta: [0; W], transition: 0, clock: NO_CLOCK };
        let words = Words {
            guards: [0; W],
            bounds: [0; W],
            initial: [0; W],
            control: 0,
            states: 1,
            fingerprint: 0,
        };
        let mut it = Self {
            entries: vec![entry; size.entries],
            takes: vec![[0; W]; size.entries],
            order: vec![0; size.entries],
            rows: vec![0; size.rows],
            clocks: vec![
                Clock { need: [0; W], entry: 0, event: false, earliest: 0, latest: 0 };
                size.clocks
            ],
            fields: vec![Field { word: 0, shift: 0, width: 1 }; size.fields],
            ignored: vec![[0; W]; size.events],
            words,
        };
        let mut lists = Lists {
            entries: &mut it.entries,
            takes: &mut it.takes,
            order: &mut it.order,
            rows: &mut it.rows,
            clocks: &mut it.clocks,
            fields: &mut it.fields,
            ignored: &mut it.ignored,
        };
        it.words = pack(net, &mut lists);
        Ok(it)
    }

    /// The packed net.
    pub fn code(&self) -> Code<'_, W> {
        let Self { entries, takes, order, rows, clocks, fields, ignored, words } = self;
        Code::new(
            Borrowed { entries, takes, order, rows, clocks, fields, ignored },
            words,
            SETTLE,
            false,
        )
    }

    /// What a player plays; `net` is the net that was packed.
    pub fn load<'c>(&'c self, net: &Net<'c>) -> Loaded<'c, W> {
        Loaded { net: *net, code: self.code() }
    }
}
