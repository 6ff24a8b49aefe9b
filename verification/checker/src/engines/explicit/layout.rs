//! How a marking is packed into machine words.
//!
//! Every place is a field of a word. Where the bound of a place is proved the field is as wide as
//! the bound; elsewhere it has a guess, and one bit more that tells when the guess was too small.
//! The map from markings to words is linear, so firing a transition is one addition to each word,
//! whatever it takes and gives. Places that others imply are left out where that saves a word.

use super::implied::{Implied, implied};
use super::{Limit, Limits};
use crate::bounds::bounds_within;
use cotama_property::pt::Pt;

/// Always set in the first word: no marking is all zeros.
pub(super) const PRESENT: u64 = 1 << 63;

/// How many words a marking may have: those for which the search is compiled.
pub(super) const SIZES: [usize; 12] = [1, 2, 3, 4, 5, 6, 8, 12, 16, 32, 64, 128];

/// The most words of a marking in which implied places are left out.
const NARROW: usize = 64;

/// How wide the field of a place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Width {
    /// Bits for tokens.
    pub(super) bits: u32,
    /// Whether it is proved that they are enough.
    pub(super) proved: bool,
}

impl Width {
    /// For each place what is proved, or a first guess.
    ///
    /// # Errors
    /// A firing can add more tokens than there may be, or time is up.
    pub(super) fn of(pt: &Pt, limits: &Limits) -> Result<Vec<Self>, Limit> {
        let width = |tokens: u32| (u32::BITS - tokens.leading_zeros()).max(1);
        // Tokens that are given to places that were emptied.
        let mut left = vec![0; pt.places.len()];
        for &(place, tokens) in (0..pt.transitions.len() as u32).flat_map(|it| pt.resets(it)) {
            left[place as usize] = tokens.max(left[place as usize]);
        }
        let first = |(place, &bound): (usize, &Option<u32>)| {
            if let Some(bound) = bound {
                return Some(Self { bits: width(bound), proved: true });
            }
            // One firing beyond the guess must not pass the additional bit.
            let given =
                pt.changers.of(place as u32).iter().map(|it| it.1).max().unwrap_or(0).max(0);
            Some(Self {
                bits: width(pt.initial[place].max(u32::try_from(given).ok()?).max(left[place])),
                proved: false,
            })
        };
        let bounds = bounds_within(pt, limits)?.iter().enumerate();
        bounds.map(first).collect::<Option<_>>().ok_or(Limit::Tokens)
    }

    fn field(self) -> u32 {
        self.bits + u32::from(!self.proved)
    }
}

/// The position of a place in a packed marking.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field {
    /// The word. Those after the stored ones are computed.
    pub(super) word: usize,
    /// The lowest bit.
    pub(super) shift: u32,
    /// Bits.
    pub(super) width: u32,
}

impl Field {
    pub(super) fn tokens(self, word: u64) -> u64 {
        (word >> self.shift) & ((1 << self.width) - 1)
    }
}

/// The positions of all places of a net.
#[derive(Debug)]
pub(super) struct Layout {
    /// For each place where it lies.
    pub(super) fields: Vec<Field>,
    /// How many words are stored.
    pub(super) stored: usize,
    /// How many words are computed from them: those of implied places.
    pub(super) computed: usize,
    /// Places in computed words, in their order.
    pub(super) implied: Vec<Implied>,
    /// For each stored word the bits that tell that a guess was too small.
    pub(super) guards: Vec<u64>,
    /// The initial marking.
    pub(super) initial: Vec<u64>,
}

impl Layout {
    /// Packs places of these widths; `None` when a marking needs more words than the largest of
    /// [`SIZES`].
    pub(super) fn new(pt: &Pt, widths: &[Width]) -> Option<Self> {
        let mut implied = left_out(pt, widths);
        implied.sort_by_key(|it| it.place);
        let mut is_stored = vec![true; widths.len()];
        for it in &implied {
            is_stored[it.place as usize] = false;
        }
        let mut words = Words::new(63);
        let mut fields = vec![Field { word: 0, shift: 0, width: 0 }; widths.len()];
        for (at, width) in widths.iter().enumerate().filter(|it| is_stored[it.0]) {
            fields[at] = words.add(width.field());
        }
        let used = words.used.len();
        let stored = SIZES.into_iter().find(|&it| it >= used)?;
        let mut words = Words::new(u64::BITS);
        for it in &implied {
            let field = words.add(widths[it.place as usize].field());
            fields[it.place as usize] = Field { word: stored + field.word, ..field };
        }
        let computed = if implied.is_empty() { 0 } else { words.used.len() };
        let (mut guards, mut initial) = (vec![0; stored], vec![0; stored]);
        initial[0] = PRESENT;
        for (at, field) in fields.iter().enumerate().filter(|it| it.1.word < stored) {
            let tokens = u64::from(pt.initial[at]);
            debug_assert!(tokens >> widths[at].bits == 0, "the start fits");
            debug_assert!(field.shift + field.width <= u64::BITS);
            initial[field.word] |= tokens << field.shift;
            if !widths[at].proved {
                guards[field.word] |= 1 << (field.shift + widths[at].bits);
            }
        }
        Some(Self { fields, stored, computed, implied, guards, initial })
    }

    /// The tokens of a place in a computed word.
    pub(super) fn computed_tokens(&self, place: u32, packed: &[u64]) -> u64 {
        let Ok(at) = self.implied.binary_search_by_key(&place, |it| it.place) else { return 0 };
        let Implied { constant, terms, .. } = &self.implied[at];
        let sum = terms.iter().fold(*constant, |sum, &(place, weight)| {
            let field = self.fields[place as usize];
            let tokens = packed.get(field.word).map_or(0, |word| field.tokens(*word));
            sum.wrapping_add(weight.wrapping_mul(tokens.cast_signed()))
        });
        // A sum of terms that are no tokens wraps around, and comes back.
        sum.cast_unsigned()
    }

    /// Returns the words that a firing adds to the stored ones.
    pub(super) fn delta(&self, pt: &Pt, transition: u32) -> Vec<u64> {
        let mut words = vec![0_u64; self.stored];
        let resets = pt.resets(transition);
        for &(place, left) in resets {
            let field = self.fields[place as usize];
            words[field.word] |= u64::from(left) << field.shift;
        }
        for &(place, by) in pt.effects.of(transition) {
            let field = self.fields[place as usize];
            if field.word < self.stored && resets.iter().all(|it| it.0 != place) {
                words[field.word] =
                    words[field.word].wrapping_add(by.cast_unsigned() << field.shift);
            }
        }
        words
    }
}

impl Layout {
    /// The bits of stored words that reset arcs of a transition leave. Where there are reset arcs,
    /// no place is implied.
    pub(super) fn mask(&self, pt: &Pt, transition: u32) -> Vec<u64> {
        let mut words = vec![u64::MAX; self.stored];
        for &(place, _) in pt.resets(transition) {
            let field = self.fields[place as usize];
            words[field.word] &= !(((1 << field.width) - 1) << field.shift);
        }
        words
    }
}

/// Fields put into words one after the other, each where there is room first.
struct Words {
    /// How many bits of the first word may be used.
    first: u32,
    used: Vec<u32>,
    /// For each width a word before which there is no room for it.
    from: [usize; 64],
}

impl Words {
    fn new(first: u32) -> Self {
        Self { first, used: vec![0], from: [0; 64] }
    }

    fn add(&mut self, width: u32) -> Field {
        let (first, from) = (self.first, &mut self.from[width as usize % 64]);
        let room = |&(word, used): &(usize, &u32)| {
            used + width <= if word == 0 { first } else { u64::BITS }
        };
        let words = self.used.iter().enumerate();
        let word = words.skip(*from).find(room).map_or(self.used.len(), |it| it.0);
        *from = word;
        if word == self.used.len() {
            self.used.push(0);
        }
        let shift = self.used[word];
        self.used[word] += width;
        Field { word, shift, width }
    }
}

/// Implied places, if leaving them out saves a word, and no more than are needed for that.
fn left_out(pt: &Pt, widths: &[Width]) -> Vec<Implied> {
    let words = |without: &[Implied]| {
        let mut kept = vec![true; widths.len()];
        for it in without {
            kept[it.place as usize] = false;
        }
        let mut words = Words::new(63);
        for (width, _) in widths.iter().zip(kept).filter(|it| it.1) {
            words.add(width.field());
        }
        words.used.len()
    };
    let all = words(&[]);
    // The search for a narrower layout is dear, and a word less makes little difference here.
    // Places that are emptied follow from no other one.
    if all == 1 || all > NARROW || pt.has_resets() {
        return Vec::new();
    }
    let mut candidates: Vec<u32> =
        (0..widths.len() as u32).filter(|&place| widths[place as usize].proved).collect();
    // Places that nothing needs cost least to compute, wide ones save most.
    candidates
        .sort_by_key(|&it| (!pt.consumers.of(it).is_empty(), u32::MAX - widths[it as usize].bits));
    let mut places = implied(pt, &candidates);
    let least = words(&places);
    if least == all {
        return Vec::new();
    }
    let (mut few, mut many) = (0, places.len());
    while few < many {
        let half = usize::midpoint(few, many);
        if words(&places[..half]) == least { many = half } else { few = half + 1 }
    }
    places.truncate(many);
    places
}
