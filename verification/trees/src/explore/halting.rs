//! States in which halting the whole tree throws.

use super::Space;
use super::runs::Run;

impl Space<'_> {
    /// Returns a run with the fewest ticks after which `haltTree` throws, and the cause.
    pub fn halting(&mut self) -> Option<(Run, String)> {
        if self.tree.nodes.iter().all(|it| it.afterwards.on_halted.is_none()) {
            return None;
        }
        let mut states: Vec<_> = (0..self.len()).filter(|it| self.is_state(*it)).collect();
        states.sort_by_key(|it| self.level[*it]);
        let thrown = states.into_iter().find_map(|it| {
            let thrown = self.at(it).halt_tree().err()?;
            Some((it, thrown.why))
        });
        self.machine.events.clear();
        thrown.map(|(point, why)| (self.run_at(point), why))
    }
}
