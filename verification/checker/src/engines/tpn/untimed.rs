//! The markings of a net without time.

use super::index::{Index, hash, room, taken};
use super::{Limit, Limits};
use cotama_property::pt::Pt;

/// How many firings back a smaller marking is looked for. Growth that takes longer goes unnoticed,
/// and counts as unknown.
const BACK: usize = 4096;

/// How many markings a net has when time is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Untimed {
    /// How many there are, or were met.
    pub markings: usize,
    /// Why counting stopped; `None`: there are no more.
    pub stopped: Option<Limit>,
}

impl Untimed {
    /// Whether they are finitely many; `None` when that is not known.
    pub fn bounded(&self) -> Option<bool> {
        match self.stopped {
            None => Some(true),
            Some(Limit::Unbounded) => Some(false),
            Some(_) => None,
        }
    }
}

/// Counts the markings of a net without time; [`Limits::states`] is the most that are counted.
///
/// A firing sequence that adds tokens and takes none away in sum can be repeated: the net is
/// unbounded.
pub fn markings(pt: &Pt, limits: &Limits) -> Untimed {
    let width = pt.initial.len();
    let mut tokens = pt.initial.clone();
    let mut parents = vec![0_u32];
    let mut index = Index::new();
    let key = |marking: &[u32]| hash(marking.iter().map(|&it| it.into()));
    index.find_or_insert(key(&tokens), 0, |_| false);
    let of = |tokens: &[u32], at: u32| tokens[at as usize * width..][..width].to_vec();
    let mut next = 0;
    let stopped = loop {
        if next == parents.len() as u32 {
            break None;
        }
        if let Err(stop) = limits.check(next, || taken(&tokens) + taken(&parents) + index.bytes()) {
            break Some(stop);
        }
        let marking = of(&tokens, next);
        let stop = (0..pt.transitions.len() as u32)
            .filter(|&it| pt.enabled(&marking, it))
            .find_map(|fired| {
                let Some(after) = pt.fire(&marking, fired) else { return Some(Limit::Tokens) };
                let number = parents.len() as u32;
                let is = |it: u32| tokens[it as usize * width..][..width] == after;
                if index.find_or_insert(key(&after), number, is).is_some() {
                    return None;
                }
                if parents.len() as u64 >= limits.states.min(u64::from(u32::MAX) - 1) {
                    return Some(Limit::States);
                }
                let mut before = next;
                for _ in 0..BACK {
                    let smaller = tokens[before as usize * width..][..width]
                        .iter()
                        .zip(&after)
                        .all(|(a, b)| a <= b);
                    if smaller {
                        return Some(Limit::Unbounded);
                    }
                    if before == 0 {
                        break;
                    }
                    before = parents[before as usize];
                }
                room(&mut tokens, after.len());
                room(&mut parents, 1);
                tokens.extend(after);
                parents.push(next);
                None
            });
        if stop.is_some() {
            break stop;
        }
        next += 1;
    };
    Untimed { markings: parents.len(), stopped }
}
