//! A net as a model of stateright.

use crate::measure::{Counts, Measured, measure};
use cotama_verification::pt::Pt;
use stateright::{Checker, Model, Property};
use std::hash::{Hash, Hasher};

/// How stateright goes through states.
#[derive(Clone, Copy)]
pub enum Search {
    Breadth,
    Depth,
}

/// Tokens of a place; what stateright has to copy, compare and hash in a marking.
pub trait Marking: Clone + PartialEq + Hash + Send + Sync + 'static {
    fn new(tokens: &[u8]) -> Self;
    fn tokens(&self) -> &[u8];
    fn tokens_mut(&mut self) -> &mut [u8];
}

/// A marking in place, hashed as one run of bytes: the best that was found.
#[derive(Clone, PartialEq)]
pub struct Array<const N: usize>([u8; N]);

impl<const N: usize> Hash for Array<N> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write(&self.0); // the length, which the standard adds, is the same for all
    }
}

impl<const N: usize> Marking for Array<N> {
    fn new(tokens: &[u8]) -> Self {
        Self(std::array::from_fn(|at| tokens.get(at).copied().unwrap_or(0)))
    }

    fn tokens(&self) -> &[u8] {
        &self.0
    }

    fn tokens_mut(&mut self) -> &mut [u8] {
        &mut self.0
    }
}

/// A marking as one would write it first.
impl Marking for Vec<u8> {
    fn new(tokens: &[u8]) -> Self {
        tokens.to_vec()
    }

    fn tokens(&self) -> &[u8] {
        self
    }

    fn tokens_mut(&mut self) -> &mut [u8] {
        self
    }
}

/// A transition: what it needs, and what it adds, modulo 256.
struct Row {
    needs: Box<[(usize, u8)]>,
    effects: Box<[(usize, u8)]>,
}

struct Tables<M> {
    initial: M,
    rows: Vec<Row>,
}

impl<M: Marking> Tables<M> {
    fn new(pt: &Pt) -> Result<Self, String> {
        let byte =
            |tokens: u32| u8::try_from(tokens).map_err(|_| "a place with more than 255 tokens");
        let initial: Vec<u8> = pt.initial.iter().map(|&it| byte(it)).collect::<Result<_, _>>()?;
        let rows = (0..pt.transitions.len() as u32).map(|it| {
            let needs =
                pt.needs.of(it).iter().map(|&(place, tokens)| Ok((place as usize, byte(tokens)?)));
            let effects =
                pt.effects.of(it).iter().map(|&(place, change)| (place as usize, change as u8));
            Ok(Row { needs: needs.collect::<Result<_, String>>()?, effects: effects.collect() })
        });
        Ok(Self { initial: M::new(&initial), rows: rows.collect::<Result<_, String>>()? })
    }
}

impl<M: Marking> Model for Tables<M> {
    type State = M;
    type Action = u16;

    fn init_states(&self) -> Vec<M> {
        vec![self.initial.clone()]
    }

    fn actions(&self, marking: &M, actions: &mut Vec<u16>) {
        let tokens = marking.tokens();
        let enabled = |row: &Row| row.needs.iter().all(|&(place, needed)| tokens[place] >= needed);
        actions.extend((0..).zip(&self.rows).filter(|(_, row)| enabled(row)).map(|(at, _)| at));
    }

    fn next_state(&self, marking: &M, action: u16) -> Option<M> {
        let mut next = marking.clone();
        let tokens = next.tokens_mut();
        for &(place, change) in &self.rows[action as usize].effects {
            tokens[place] = tokens[place].wrapping_add(change);
        }
        Some(next)
    }

    /// One that costs nothing and is never decided: without any, the search ends at once.
    fn properties(&self) -> Vec<Property<Self>> {
        vec![Property::always("explored", |_, _| true)]
    }
}

/// All markings, with a marking in an array.
pub fn by_array(pt: &Pt, search: Search) -> Result<Measured, String> {
    match pt.places.len() {
        ..=16 => explore::<Array<16>>(pt, search),
        ..=22 => explore::<Array<22>>(pt, search),
        ..=46 => explore::<Array<46>>(pt, search),
        ..=60 => explore::<Array<60>>(pt, search),
        ..=128 => explore::<Array<128>>(pt, search),
        more => Err(format!("{more} places: more than 128")),
    }
}

/// All markings, with a marking on the heap.
pub fn by_vec(pt: &Pt, search: Search) -> Result<Measured, String> {
    explore::<Vec<u8>>(pt, search)
}

fn explore<M: Marking>(pt: &Pt, search: Search) -> Result<Measured, String> {
    let model = Tables::<M>::new(pt)?;
    Ok(match search {
        Search::Breadth => measure(|| counts(model.checker().threads(1).spawn_bfs().join())),
        Search::Depth => measure(|| counts(model.checker().threads(1).spawn_dfs().join())),
    })
}

/// The tables are not freed: only the search is measured.
fn counts<M: Marking>(checker: impl Checker<Tables<M>>) -> Counts {
    let found = Counts {
        nodes: checker.unique_state_count() as u64,
        edges: checker.state_count() as u64 - 1,
    };
    std::mem::forget(checker);
    found
}
