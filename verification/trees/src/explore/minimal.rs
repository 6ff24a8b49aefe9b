//! States that no sequence of ticks can tell apart, merged.

use super::Space;
use super::graph::{End, What};
use super::keys::Map;
use crate::machine::How;

/// View of a point at once.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Sight {
    State,
    Asks(usize, bool),
    End(u8, usize),
}

impl Space<'_> {
    /// Returns the number of states after merging: the same for every way to store states.
    pub fn minimal(&mut self) -> usize {
        let mut names: Map<Sight, u32> = Map::default();
        let mut block = Vec::with_capacity(self.len());
        for point in 0..self.len() {
            let sight = match self.what(point) {
                What::State => Sight::State,
                What::Asks(node) => {
                    let how = self.at(point).question().map(|it| it.how);
                    Sight::Asks(node, how == Some(How::Goes))
                }
                What::End(End::Answered(it)) => Sight::End(it as u8, 0),
                What::End(End::Halted) => Sight::End(10, 0),
                What::End(End::Thrown(node)) => Sight::End(9, node.map_or(0, |it| it + 1)),
            };
            let next = names.len() as u32;
            block.push(*names.entry(sight).or_insert(next));
        }
        let mut count = names.len();
        let mut signature: Vec<u32> = Vec::new();
        loop {
            let mut names: Map<Vec<u32>, u32> = Map::default();
            let mut new = Vec::with_capacity(self.len());
            for point in 0..self.len() {
                signature.clear();
                signature.push(block[point]);
                for edge in self.out(point) {
                    let it = self.edges[edge];
                    let reply = super::graph::code(it.reply());
                    signature.extend([reply, it.events(), block[it.target as usize]]);
                }
                let next = names.len() as u32;
                let number = names.get(&signature).copied().unwrap_or_else(|| {
                    names.insert(signature.clone(), next);
                    next
                });
                new.push(number);
            }
            let finer = names.len();
            block = new;
            if finer == count {
                break;
            }
            count = finer;
        }
        let mut states: Vec<_> =
            (0..self.len()).filter(|it| self.is_state(*it)).map(|it| block[it]).collect();
        states.sort_unstable();
        states.dedup();
        states.len()
    }
}
