//! Which transitions a packed marking enables: by tables, without a loop over transitions.
//!
//! Neighbouring fields of a word are a chunk of at most eight bits. For each value of a chunk a row
//! says which transitions it allows, as bits; the transitions that all chunks allow are enabled.
//! What else is linear in the marking, its number of tokens and the fields of implied places, is
//! added up in the same way. In nets with many transitions rows list instead the transitions that
//! may be enabled, each in a single chunk, and the rest of what they need is looked up.

use super::cache_padded::CachePadded;
use super::layout::{Field, Layout};
use super::often::marked_often;
use super::restricted::Restricted;
use super::view::{View, add, and};
use cotama_property::pt::{Lists, Pt};

/// Bits of a chunk.
const CHUNK: u32 = 8;
/// Words of the bits of all rows: beyond it rows list transitions.
const MOST: usize = 1 << 19;
/// Words of the bits of a row: beyond it rows list transitions. Tried on nets of 1,000 to 4,000
/// transitions: to list them is twice as fast at 16 words and eight times at 60.
const WORDS: usize = 8;

/// Which values chunks, and which most tokens wide fields had.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    rows: CachePadded<bool>,
    wide: CachePadded<u64>,
}

/// A group of fields whose values are the positions of rows.
#[derive(Clone, Debug)]
struct Chunk {
    word: usize,
    shift: u32,
    mask: u64,
    /// The row of value zero.
    row: usize,
    places: Vec<u32>,
}

/// A field that is too wide for a chunk.
#[derive(Clone, Debug)]
struct Wide {
    place: u32,
    field: Field,
    /// Numbers of tokens that make a difference, from small to large, and what is allowed with
    /// fewer than that.
    steps: Vec<(u64, Vec<u64>)>,
    /// Transitions that this field lists.
    listed: Vec<(u32, ())>,
    /// Amount that a token adds to the sum and to each computed word.
    adds: Vec<u64>,
}

/// Transitions by row, and what each needs outside of the chunk that lists it.
#[derive(Clone, Debug)]
struct Listed {
    /// Chunks that list any.
    chunks: Vec<u32>,
    rows: Lists<()>,
    /// Tokens, and where.
    rest: Lists<Field>,
}

/// The tables.
#[derive(Debug)]
pub(super) struct Enabling {
    stored: usize,
    chunks: Vec<Chunk>,
    wide: Vec<Wide>,
    /// How many chunks, and wide fields, are of stored words; those of computed words follow.
    in_stored: (usize, usize),
    /// For each row the words of allowed transitions, what it adds to the sum, and to each computed
    /// word.
    rows: Vec<u64>,
    /// Words of allowed transitions in a row.
    bits: usize,
    listed: Option<Listed>,
    /// The view of a marking without any stored token.
    start: View,
    /// Whether chunks of one word of transitions say all.
    is_small: bool,
    restricted: Option<Restricted>,
}

impl Enabling {
    pub(super) fn new(pt: &Pt, layout: &Layout) -> Self {
        let words = pt.transitions.len().div_ceil(64);
        let mut chunks = Vec::new();
        let mut wide = Vec::new();
        let mut in_stored = (0, 0);
        let mut row = 0;
        let mut by_word = vec![Vec::new(); layout.stored + layout.computed];
        for (place, field) in layout.fields.iter().enumerate() {
            by_word[field.word].push((place as u32, *field));
        }
        for (word, mut fields) in by_word.into_iter().enumerate() {
            fields.sort_by_key(|it| it.1.shift);
            if word == layout.stored {
                in_stored = (chunks.len(), wide.len());
            }
            chunked(fields, &mut row, &mut chunks, &mut wide);
        }
        if layout.computed == 0 {
            in_stored = (chunks.len(), wide.len());
        }
        let is_listed = row * words > MOST || words > WORDS;
        let mut start = View {
            enabled: CachePadded::new(0, words),
            computed: CachePadded::new(0, layout.computed),
            sum: 0,
        };
        for transition in 0..pt.transitions.len() as u32 {
            if !is_listed || pt.needs.of(transition).is_empty() {
                start.enabled[transition as usize / 64] |= 1 << (transition % 64);
            }
        }
        for it in &layout.implied {
            let field = layout.fields[it.place as usize];
            let word = &mut start.computed[field.word - layout.stored];
            *word = word.wrapping_add(it.constant.cast_unsigned() << field.shift);
            start.sum = start.sum.wrapping_add(it.constant.cast_unsigned());
        }
        let mut it = Self {
            stored: layout.stored,
            chunks,
            wide,
            in_stored,
            rows: Vec::new(),
            bits: if is_listed { 0 } else { words },
            listed: None,
            start,
            is_small: false,
            restricted: Restricted::new(pt, layout),
        };
        it.is_small = it.bits == 1
            && it.start.computed.is_empty()
            && it.wide.is_empty()
            && it.restricted.is_none();
        it.fill(pt, layout, row);
        if is_listed {
            it.list(pt, layout, row);
        }
        it
    }

    /// Fills rows and wide fields.
    fn fill(&mut self, pt: &Pt, layout: &Layout, rows: usize) {
        // Amount that a token of a place adds to the sum and to each computed word.
        let mut adds = vec![vec![0_u64; 1 + layout.computed]; pt.places.len()];
        for (place, adds) in adds.iter_mut().enumerate() {
            adds[0] = u64::from(layout.fields[place].word < layout.stored);
        }
        for it in &layout.implied {
            let field = layout.fields[it.place as usize];
            for &(place, weight) in &it.terms {
                let adds = &mut adds[place as usize];
                adds[0] = adds[0].wrapping_add(weight.cast_unsigned());
                let word = &mut adds[1 + field.word - layout.stored];
                *word = word.wrapping_add(weight.cast_unsigned() << field.shift);
            }
        }
        let stride = self.bits + 1 + layout.computed;
        self.rows = vec![0; rows * stride];
        for chunk in &self.chunks {
            for value in 0..=chunk.mask as usize {
                let row = &mut self.rows[(chunk.row + value) * stride..][..stride];
                let (allowed, sums) = row.split_at_mut(self.bits);
                allowed.copy_from_slice(&self.start.enabled[..self.bits]);
                for &place in &chunk.places {
                    let tokens =
                        layout.fields[place as usize].tokens((value as u64) << chunk.shift);
                    for (sum, add) in sums.iter_mut().zip(&adds[place as usize]) {
                        *sum = sum.wrapping_add(add.wrapping_mul(tokens));
                    }
                    if self.bits > 0 {
                        forbid(pt, place, tokens, allowed);
                    }
                }
            }
        }
        for wide in &mut self.wide {
            wide.adds.clone_from(&adds[wide.place as usize]);
            let mut needed: Vec<u64> = pt
                .consumers
                .of(wide.place)
                .iter()
                .map(|it| it.1.into())
                .filter(|_| self.bits > 0)
                .collect();
            needed.sort_unstable();
            needed.dedup();
            wide.steps = needed
                .into_iter()
                .map(|tokens| {
                    let mut allowed = self.start.enabled.to_vec();
                    forbid(pt, wide.place, tokens.saturating_sub(1), &mut allowed);
                    (tokens, allowed)
                })
                .collect();
        }
    }

    /// Lists each transition in the chunk or wide field of the place that is marked least often on
    /// a walk, and looks up the rest in that order: what cannot fire is mostly seen at once.
    fn list(&mut self, pt: &Pt, layout: &Layout, rows: usize) {
        let marked = marked_often(pt);
        let rarely = |place: u32| (marked[place as usize], pt.consumers.of(place).len(), place);
        let (mut rows, mut rests) = (vec![Vec::new(); rows], Vec::new());
        let mut chunk_of = vec![None; pt.places.len()];
        for (at, chunk) in self.chunks.iter().enumerate() {
            chunk.places.iter().for_each(|&it| chunk_of[it as usize] = Some(at));
        }
        for transition in 0..pt.transitions.len() as u32 {
            let needs = pt.needs.of(transition);
            let key = needs.iter().map(|it| it.0).min_by_key(|it| rarely(*it));
            let chunk = key.and_then(|key| chunk_of[key as usize]);
            let (here, mut rest): (Vec<_>, Vec<_>) =
                needs.iter().partition(|it| chunk.is_some() && chunk_of[it.0 as usize] == chunk);
            let field =
                |&(place, tokens): &(u32, u32)| (layout.fields[place as usize], u64::from(tokens));
            rest.sort_by_key(|it: &(u32, u32)| rarely(it.0));
            let need = |&(place, tokens): &(u32, u32)| (tokens, layout.fields[place as usize]);
            rests.push(rest.iter().map(need).collect::<Vec<_>>());
            if let Some(chunk) = chunk.map(|at| &self.chunks[at]) {
                for value in 0..=chunk.mask {
                    if here
                        .iter()
                        .map(field)
                        .all(|(it, need)| it.tokens(value << chunk.shift) >= need)
                    {
                        rows[chunk.row + value as usize].push((transition, ()));
                    }
                }
            } else if let Some(wide) = self.wide.iter_mut().find(|it| Some(it.place) == key) {
                wide.listed.push((transition, ()));
            }
        }
        let lists = |at: &u32| {
            let chunk = &self.chunks[*at as usize];
            rows[chunk.row..=chunk.row + chunk.mask as usize].iter().any(|it| !it.is_empty())
        };
        let chunks = (0..self.chunks.len() as u32).filter(lists).collect();
        self.listed = Some(Listed { chunks, rows: Lists::new(rows), rest: Lists::new(rests) });
    }

    /// About how much memory it takes.
    pub(super) fn bytes(&self) -> u64 {
        let listed = self.listed.as_ref().map_or(0, |it| it.rows.len() * size_of::<Vec<u32>>());
        (size_of_val(&self.rows[..]) + listed) as u64
    }

    /// Room for a view.
    pub(super) fn view(&self) -> View {
        self.start.clone()
    }

    /// Nothing seen yet.
    pub(super) fn unseen(&self) -> Seen {
        let rows = self.chunks.last().map_or(0, |it| it.row + it.mask as usize + 1);
        Seen { rows: CachePadded::new(false, rows), wide: CachePadded::new(0, self.wide.len()) }
    }

    /// Looks at a marking.
    #[inline]
    pub(super) fn look(&self, marking: &[u64], view: &mut View, seen: &mut Seen) {
        if self.is_small {
            let (rows, _) = self.rows.as_chunks::<2>();
            let (mut enabled, mut sum, seen) = (u64::MAX, 0, &mut *seen.rows);
            for chunk in &self.chunks {
                let row = chunk.row + ((marking[chunk.word] >> chunk.shift) & chunk.mask) as usize;
                let [allowed, tokens] = rows[row];
                enabled &= allowed;
                sum += tokens;
                seen[row] = true;
            }
            view.enabled[0] = enabled & self.start.enabled[0];
            view.sum = sum;
        } else {
            self.look_at_all(marking, view, seen);
        }
    }

    fn look_at_all(&self, marking: &[u64], view: &mut View, seen: &mut Seen) {
        let (chunks, wide) = self.in_stored;
        view.enabled.copy_from_slice(&self.start.enabled);
        view.computed.copy_from_slice(&self.start.computed);
        view.sum = self.start.sum;
        let stride = self.bits + 1 + view.computed.len();
        let (computed, rows) = (&mut *view.computed, &mut *seen.rows);
        for chunk in &self.chunks[..chunks] {
            let row = chunk.row + ((marking[chunk.word] >> chunk.shift) & chunk.mask) as usize;
            rows[row] = true;
            let (allowed, adds) = self.rows[row * stride..][..stride].split_at(self.bits);
            and(&mut view.enabled[..self.bits], allowed);
            view.sum = view.sum.wrapping_add(adds[0]);
            for (it, more) in computed.iter_mut().zip(&adds[1..]) {
                *it = it.wrapping_add(*more);
            }
        }
        for (at, it) in self.wide[..wide].iter().enumerate() {
            let tokens = it.allow(marking[it.field.word], at, view, seen);
            view.sum = view.sum.wrapping_add(it.adds[0].wrapping_mul(tokens));
            add(&mut view.computed, &it.adds[1..], tokens);
        }
        for chunk in &self.chunks[chunks..] {
            self.allow(chunk, view.computed[chunk.word - self.stored], view, seen);
        }
        for (at, it) in self.wide.iter().enumerate().skip(wide) {
            it.allow(view.computed[it.field.word - self.stored], at, view, seen);
        }
        if let Some(listed) = &self.listed {
            self.enable(listed, marking, view);
        }
        if let Some(it) = &self.restricted {
            it.restrict(marking, view);
        }
    }

    /// Lets a chunk forbid transitions; returns what its row adds.
    #[inline]
    fn allow(&self, chunk: &Chunk, word: u64, view: &mut View, seen: &mut Seen) -> &[u64] {
        let row = chunk.row + ((word >> chunk.shift) & chunk.mask) as usize;
        seen.rows[row] = true;
        let stride = self.bits + 1 + self.start.computed.len();
        let row = &self.rows[row * stride..][..stride];
        let (allowed, adds) = row.split_at(self.bits);
        and(&mut view.enabled[..allowed.len()], allowed);
        adds
    }

    /// Enables those of the listed transitions that have the rest of what they need.
    fn enable(&self, listed: &Listed, marking: &[u64], view: &mut View) {
        let View { enabled, computed, .. } = view;
        let word =
            |at: usize| if at < self.stored { marking[at] } else { computed[at - self.stored] };
        let mut enable = |transitions: &[(u32, ())]| {
            for &(transition, ()) in transitions {
                let mut rest = listed.rest.of(transition).iter();
                if rest.all(|(need, it)| it.tokens(word(it.word)) >= u64::from(*need)) {
                    enabled[transition as usize / 64] |= 1 << (transition % 64);
                }
            }
        };
        for &chunk in &listed.chunks {
            let it = &self.chunks[chunk as usize];
            let row = it.row + ((word(it.word) >> it.shift) & it.mask) as usize;
            enable(listed.rows.of(row as u32));
        }
        self.wide.iter().for_each(|it| enable(&it.listed));
    }
}

impl Wide {
    /// Lets a field forbid transitions; returns its tokens.
    fn allow(&self, word: u64, at: usize, view: &mut View, seen: &mut Seen) -> u64 {
        let tokens = self.field.tokens(word);
        seen.wide[at] = seen.wide[at].max(tokens);
        if let Some((_, allowed)) = self.steps.iter().find(|it| tokens < it.0) {
            view.enabled.iter_mut().zip(allowed).for_each(|(enabled, allowed)| *enabled &= allowed);
        }
        tokens
    }
}

impl Seen {
    /// Adds what another one has seen.
    pub(super) fn merge(&mut self, other: &Self) {
        self.rows.iter_mut().zip(&*other.rows).for_each(|(a, b)| *a |= b);
        self.wide.iter_mut().zip(&*other.wide).for_each(|(a, b)| *a = (*a).max(*b));
    }

    /// For each place the most tokens that it held.
    pub(super) fn most(&self, enabling: &Enabling, layout: &Layout) -> Vec<u64> {
        let mut most = vec![0; layout.fields.len()];
        for chunk in &enabling.chunks {
            for value in (0..=chunk.mask).filter(|&it| self.rows[chunk.row + it as usize]) {
                for &place in &chunk.places {
                    let tokens = layout.fields[place as usize].tokens(value << chunk.shift);
                    most[place as usize] = most[place as usize].max(tokens);
                }
            }
        }
        for (wide, tokens) in enabling.wide.iter().zip(&*self.wide) {
            most[wide.place as usize] = *tokens;
        }
        most
    }
}

/// Puts the fields of a word, which lie one after the other, into chunks.
fn chunked(
    fields: Vec<(u32, Field)>,
    row: &mut usize,
    chunks: &mut Vec<Chunk>,
    wide: &mut Vec<Wide>,
) {
    let mut bits = CHUNK;
    for (place, field) in fields {
        if field.width > CHUNK {
            wide.push(Wide {
                place,
                field,
                steps: Vec::new(),
                listed: Vec::new(),
                adds: Vec::new(),
            });
            // The next field cannot be in the chunk before it.
            bits = CHUNK;
            continue;
        }
        let room = bits + field.width <= CHUNK;
        bits = if room { bits + field.width } else { field.width };
        match chunks.last_mut() {
            Some(chunk) if room => {
                *row += (1 << bits) - (chunk.mask as usize + 1);
                chunk.mask = (1 << bits) - 1;
                chunk.places.push(place);
            }
            _ => {
                let Field { word, shift, .. } = field;
                chunks.push(Chunk {
                    word,
                    shift,
                    mask: (1 << bits) - 1,
                    row: *row,
                    places: vec![place],
                });
                *row += 1 << bits;
            }
        }
    }
}

/// Forbids transitions that need more than these tokens of a place.
fn forbid(pt: &Pt, place: u32, tokens: u64, allowed: &mut [u64]) {
    for &(transition, need) in pt.consumers.of(place) {
        if u64::from(need) > tokens {
            allowed[transition as usize / 64] &= !(1 << (transition % 64));
        }
    }
}
