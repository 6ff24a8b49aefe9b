//! States in which halting the whole tree throws.

use super::Space;
use super::runs::Run;
use crate::machine::{Reply, Stop, catches};
use crate::tree::Answer;

/// Most ways through the questions that halting one state asks.
const MOST_WAYS: usize = 10_000;

impl Space<'_> {
    /// Returns a run with the fewest ticks after which `haltTree` throws, and the cause.
    pub fn halting(&mut self) -> Option<(Run, String)> {
        let tree = self.tree;
        if tree.nodes.iter().all(|it| it.afterwards.on_halted.is_none()) && !catches(tree) {
            return None;
        }
        let mut states: Vec<_> = (0..self.len()).filter(|it| self.is_state(*it)).collect();
        states.sort_by_key(|it| self.level[*it]);
        let thrown = states.into_iter().find_map(|it| Some((it, self.throws(it)?)));
        self.machine.events.clear();
        thrown.map(|(point, why)| (self.run_at(point), why))
    }

    /// Returns why halting a state throws, after some replies to what it asks.
    fn throws(&mut self, state: usize) -> Option<String> {
        let mut ways: Vec<Vec<Reply>> = vec![Vec::new()];
        let mut count = 0;
        while let Some(replies) = ways.pop() {
            self.at(state);
            let mut stop = self.machine.halt_tree();
            for &reply in &replies {
                stop = self.machine.reply(reply);
            }
            let question = match stop {
                Stop::Thrown(thrown) => return Some(thrown.why),
                Stop::Asked(question) => question,
                Stop::Answered(_) | Stop::Halted => continue,
            };
            count += 1;
            if count > MOST_WAYS {
                self.complete = false;
                return None;
            }
            for &reply in question.replies {
                let skips = reply == Reply::Leaf(Answer::Skipped) && !self.skips;
                let cells = &self.machine.cells;
                if !skips && self.assumptions.allows(question.node, reply, cells) {
                    ways.push([&replies[..], &[reply]].concat());
                }
            }
        }
        None
    }
}
