//! A machine as a few words, and back.

use super::keys::Map;
use crate::machine::{Layout, Machine};
use crate::tree::{Kind, Tree};

/// Position of a cell within the words.
#[derive(Clone, Copy)]
struct Field {
    word: u32,
    shift: u32,
    mask: u64,
}

/// Positions of all cells, and blackboards by number.
pub(super) struct Pack {
    /// Words of a key.
    pub(super) words: usize,
    /// Whether a cell held more than its bits: then nothing is known.
    pub(super) overflows: bool,
    /// Whether answers of nodes are kept until the next tick.
    pub(super) watches: bool,
    /// The key stored last.
    pub(super) key: Vec<u64>,
    /// Cells that take bits: number of the cell, position.
    fields: Vec<(u32, Field)>,
    /// The node that asks, and whether a wake-up is pending.
    at: Field,
    /// Number of those that may ask: nodes, and the supervisor.
    asks: usize,
    wake: Field,
    /// Number of the blackboard, where nodes write to it.
    board: Option<Field>,
    boards: Vec<Vec<u32>>,
    known: Map<Vec<u32>, u32>,
}

impl Pack {
    pub(super) fn of(tree: &Tree, layout: &Layout) -> Pack {
        let mut used = 0;
        let mut place = |bits: u8| {
            let bits = bits as u32;
            if used % 64 + bits > 64 {
                used = (used / 64 + 1) * 64;
            }
            let mask = if bits == 64 { u64::MAX } else { (1 << bits) - 1 };
            let field = Field { word: used / 64, shift: used % 64, mask };
            used += bits;
            field
        };
        let widths = layout.widths.iter().enumerate().filter(|it| *it.1 > 0);
        let mut fields: Vec<_> = widths.map(|(at, &bits)| (at as u32, place(bits))).collect();
        // Words are filled in turn, so that neighbours stay together.
        fields.sort_by_key(|it| (it.1.word, it.1.shift));
        let largest = 2 * tree.nodes.len() + 7;
        let at = place((usize::BITS - largest.leading_zeros()) as u8);
        let wake = place(1);
        let board = writes(tree).then(|| place(32));
        let words = (used as usize).div_ceil(64);
        Pack {
            words,
            overflows: false,
            watches: false,
            key: vec![0; words],
            fields,
            at,
            asks: tree.nodes.len() + tree.bonds.is_some() as usize,
            wake,
            board,
            boards: Vec::new(),
            known: Map::default(),
        }
    }

    /// Packs a machine; `what` says whether it is a state, asks, or has ended.
    pub(super) fn store(&mut self, machine: &mut Machine, what: u32) {
        self.key.fill(0);
        let (mut word, mut at, mut over) = (0, 0, 0);
        for (cell, field) in &self.fields {
            let value = machine.cells[*cell as usize] as u64;
            debug_assert!(value <= field.mask, "cell {cell} holds {value}");
            over |= value & !field.mask;
            if field.word != at {
                self.key[at as usize] = word;
                (word, at) = (0, field.word);
            }
            word |= (value & field.mask) << field.shift;
        }
        self.key[at as usize] = word;
        self.overflows |= over != 0;
        self.put(self.at, what as u64);
        self.put(self.wake, machine.wake as u64);
        if let Some(field) = self.board {
            let mut entries = machine.entries.as_slice();
            while let Some((0, rest)) = entries.split_last() {
                entries = rest;
            }
            let known = self.known.get(entries).copied();
            let number = known.unwrap_or_else(|| {
                let number = self.boards.len() as u32;
                self.boards.push(entries.to_vec());
                self.known.insert(entries.to_vec(), number);
                number
            });
            self.put(field, number as u64);
        }
    }

    fn put(&mut self, field: Field, value: u64) {
        debug_assert!(value <= field.mask, "no bit of {value} is left out");
        self.key[field.word as usize] |= (value & field.mask) << field.shift;
    }

    /// Unpacks a machine.
    pub(super) fn load(&self, key: &[u64], machine: &mut Machine) {
        let get = |field: Field| key[field.word as usize] >> field.shift & field.mask;
        for (cell, field) in &self.fields {
            machine.cells[*cell as usize] = get(*field) as u32;
        }
        let at = get(self.at) as usize;
        debug_assert_eq!(key.len(), self.words);
        machine.at = (1..=self.asks).contains(&at).then(|| at - 1);
        machine.wake = get(self.wake) == 1;
        if let Some(field) = self.board {
            let board = &self.boards[get(field) as usize];
            machine.entries.clone_from(board);
            machine.entries.resize(machine.store.entries.len(), 0);
        }
    }

    /// Forgets everything but what is watched: the run has ended.
    pub(super) fn leave(&self, machine: &mut Machine) {
        if self.board.is_some() {
            machine.entries.fill(0);
        }
        if !self.watches {
            return machine.cells.fill(0);
        }
        let watched = machine.watched.iter().flatten().copied();
        let kept = machine.kept.iter().copied();
        let watched: Vec<_> = watched.chain(machine.watched_net()).chain(kept).collect();
        for (cell, value) in machine.cells.iter_mut().enumerate() {
            if !watched.contains(&cell) {
                *value = 0;
            }
        }
    }
}

/// Returns whether the nodes of a tree itself write entries; leaves do so unseen.
fn writes(tree: &Tree) -> bool {
    tree.nodes.iter().any(|it| {
        let scripts = [
            &it.guards.failure_if,
            &it.guards.success_if,
            &it.guards.skip_if,
            &it.guards.while_,
            &it.afterwards.on_halted,
            &it.afterwards.on_failure,
            &it.afterwards.on_success,
            &it.afterwards.post,
        ];
        let own = matches!(
            it.kind,
            Kind::Script(Some(_))
                | Kind::ScriptCondition(_)
                | Kind::Precondition { .. }
                | Kind::SetBlackboard { .. }
                | Kind::UnsetBlackboard { .. }
                | Kind::PersistentSequence { .. }
                | Kind::Loop { .. }
        );
        own || scripts.iter().any(|it| it.is_some())
    })
}
