//! Blackboards: entries by number, values by number, and who watches an entry.

use super::{Fault, Machine, fault};
use crate::script::{Assign, Entries, ScriptError, Value, as_integer, number_of, stored};
use crate::tree::{Kind, Number, Port, Tree};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The entry does not exist.
pub(crate) const ABSENT: u32 = 0;
/// The entry exists, and has no value.
pub(crate) const EMPTY: u32 = 1;
/// A bit beside the number of a value: `SetBlackboard` made the entry, which holds texts from then
/// on, until it is unset.
const MADE: u32 = 1 << 31;

/// Numbers of entries and values: they are given in the order of appearance and never change.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    /// Numbers of entries by board and key.
    numbers: Vec<BTreeMap<String, u32>>,
    /// Board and key by number.
    pub(crate) entries: Vec<(usize, String)>,
    values: Vec<Value>,
    known: BTreeMap<(u8, u64, Rc<str>), u32>,
    /// Nodes that ask whether an entry was written.
    watchers: Vec<(usize, String)>,
}

impl Store {
    pub(crate) fn of(tree: &Tree) -> Store {
        let watched = |it: &Kind| match it {
            Kind::SkipUnlessUpdated { entry }
            | Kind::WaitValueUpdate { entry }
            | Kind::WasEntryUpdated { entry } => Some(entry.clone()),
            _ => None,
        };
        let nodes = tree.nodes.iter().enumerate();
        let watchers = nodes.filter_map(|(at, node)| Some((at, watched(&node.kind)?))).collect();
        Store {
            numbers: vec![BTreeMap::new(); tree.boards.len()],
            entries: Vec::new(),
            values: Vec::new(),
            known: BTreeMap::new(),
            watchers,
        }
    }

    /// Returns the number of a value, above those of entries without one.
    pub(crate) fn value(&mut self, value: &Value) -> u32 {
        let next = self.values.len() as u32 + 2;
        let number = *self.known.entry(value.key()).or_insert(next);
        if number == next {
            self.values.push(value.clone());
        }
        number
    }

    /// Returns the value of this number.
    pub(crate) fn of_number(&self, number: u32) -> Option<&Value> {
        self.values.get((number as usize).checked_sub(2)?)
    }
}

impl Machine<'_> {
    /// Makes the entries that exist from the beginning.
    pub(super) fn fill(&mut self) {
        let tree = self.tree;
        for (board, it) in tree.boards.iter().enumerate() {
            for (key, value) in &it.initial {
                let number = self.number(board, key);
                self.entries[number] = match value {
                    Some(value) => self.store.value(value),
                    None => EMPTY,
                };
            }
        }
        // A constant of a subtree counts as written.
        for (board, it) in tree.boards.iter().enumerate() {
            for (key, _) in it.initial.iter().filter(|it| it.1.is_some()) {
                let number = self.number(board, key);
                self.touch(number);
            }
        }
    }

    /// Returns the number of an entry of this very board.
    pub(crate) fn number(&mut self, board: usize, key: &str) -> usize {
        if let Some(&number) = self.store.numbers[board].get(key) {
            return number as usize;
        }
        let number = self.store.entries.len();
        self.store.entries.push((board, key.to_owned()));
        self.store.numbers[board].insert(key.to_owned(), number as u32);
        self.entries.resize(number + 1, ABSENT);
        number
    }

    fn exists(&self, board: usize, key: &str) -> bool {
        let number = self.store.numbers[board].get(key);
        number.is_some_and(|&it| self.entries.get(it as usize).is_some_and(|it| *it != ABSENT))
    }

    /// Returns the number of the value of an entry.
    fn held(&self, number: usize) -> u32 {
        self.entries[number] & !MADE
    }

    /// Gives an entry the number of a value.
    fn hold(&mut self, number: usize, value: u32) {
        self.entries[number] = value | self.entries[number] & MADE;
    }

    /// Returns the number of the entry that a name means on a board.
    pub(crate) fn entry(&mut self, board: usize, key: &str) -> usize {
        let tree = self.tree;
        let (mut board, mut key) = (board, key);
        loop {
            if let Some(rest) = key.strip_prefix('@') {
                (board, key) = (0, rest);
                continue;
            }
            let it = &tree.boards[board];
            let Some(parent) = it.parent.filter(|_| !self.exists(board, key)) else { break };
            if let Some(renamed) = it.remaps.get(key) {
                (board, key) = (parent, renamed);
            } else if it.autoremap && !key.starts_with('_') {
                board = parent;
            } else {
                break;
            }
        }
        let key = key.to_owned();
        self.number(board, &key)
    }

    /// Returns the value of an entry, as the node of this board sees it.
    pub(crate) fn read(&mut self, board: usize, key: &str) -> Option<Value> {
        let number = self.entry(board, key);
        self.store.of_number(self.held(number)).cloned()
    }

    pub(crate) fn has(&mut self, board: usize, key: &str) -> bool {
        let number = self.entry(board, key);
        self.entries[number] != ABSENT
    }

    /// Writes an entry, whatever it held.
    pub(crate) fn put(&mut self, board: usize, key: &str, value: &Value) {
        let number = self.entry(board, key);
        let value = self.store.value(value);
        self.hold(number, value);
        self.touch(number);
    }

    /// Tells all who watch an entry that it was written.
    pub(super) fn touch(&mut self, number: usize) {
        for at in 0..self.store.watchers.len() {
            let (node, key) = self.store.watchers[at].clone();
            if self.entry(self.tree.nodes[node].board, &key) == number {
                self.set(node, 0, 1);
            }
        }
    }

    /// Returns the value of a port.
    pub(crate) fn port(&mut self, node: usize, port: &Port) -> Option<Value> {
        match port {
            Port::Constant(text) => Some(Value::text(text)),
            Port::Entry(key) => self.read(self.tree.nodes[node].board, key),
        }
    }

    /// Returns the integer at a port.
    pub(crate) fn integer(&mut self, node: usize, number: &Number) -> Option<i64> {
        match number {
            Number::Is(it) => Some(*it),
            Number::Entry(key) => match self.read(self.tree.nodes[node].board, key)? {
                Value::Integer(it) => Some(it),
                Value::Real(it) => as_integer(it),
                Value::Text(it) => as_integer(number_of(&it)?),
            },
        }
    }

    /// Returns the integer at a port, which the node cannot do without.
    pub(crate) fn needed(&mut self, node: usize, number: &Number) -> Result<i64, Fault> {
        match (self.integer(node, number), number) {
            (Some(it), _) => Ok(it),
            (None, Number::Entry(key)) => fault(format!("entry {key} holds no integer")),
            (None, Number::Is(_)) => fault("no integer"),
        }
    }

    /// Runs a `SetBlackboard`.
    pub(super) fn set_blackboard(
        &mut self,
        node: usize,
        value: &Port,
        output: &Port,
    ) -> Result<bool, Fault> {
        let board = self.tree.nodes[node].board;
        let Some(Value::Text(target)) = self.port(node, output) else {
            return fault("output_key names no entry");
        };
        let mut new = match value {
            Port::Constant(text) => Value::text(text),
            Port::Entry(key) => {
                if !self.has(board, key) {
                    return fault(format!("entry {key} does not exist"));
                }
                let Some(value) = self.read(board, key) else { return Ok(false) };
                value
            }
        };
        let number = self.entry(board, &target);
        if let Value::Text(text) = new.clone() {
            let made = self.entries[number] & MADE != 0;
            if self.entries[number] == ABSENT && matches!(value, Port::Constant(_)) {
                self.entries[number] = EMPTY | MADE;
            } else if !made {
                use crate::tree::EntryType::{Integer, Real, Text, Truth};
                let home = self.store.entries[number].clone();
                let parsed = number_of(&text);
                new = match (self.tree.types.get(&home), parsed) {
                    (Some(Text), _) => new,
                    (Some(Real), Some(it)) => Value::Real(it),
                    (Some(Integer), Some(it)) if as_integer(it).is_some() => {
                        Value::Integer(it as i64)
                    }
                    (Some(Integer | Real), _) => return fault(format!("'{text}' is no number")),
                    (None | Some(Truth), _) => {
                        return fault(format!(
                            "a text into entry {target}, which has no type: nothing is stored, \
                             and the next write throws"
                        ));
                    }
                };
            }
        }
        self.put(board, &target, &new);
        Ok(true)
    }

    /// Runs an `UnsetBlackboard`.
    pub(super) fn unset(&mut self, node: usize, key: &Port) {
        if let Some(key) = self.port(node, key) {
            let key = match key {
                Value::Text(it) => it,
                it => it.shown().into(),
            };
            let number = self.number(self.tree.nodes[node].board, &key);
            self.entries[number] = ABSENT;
        }
    }

    /// Writes all blackboards as traces have them.
    pub fn blackboard(&self) -> String {
        let mut all: Vec<String> = Vec::new();
        for (board, numbers) in self.store.numbers.iter().enumerate() {
            for (key, &number) in numbers {
                let value = match self.entries.get(number as usize).map(|it| it & !MADE) {
                    None | Some(ABSENT) => continue,
                    Some(number) => self.store.of_number(number),
                };
                let value = value.map_or_else(|| "?".to_owned(), Value::to_string);
                let of = if board > 0 { format!("{board}.") } else { String::new() };
                all.push(format!("{of}{key}={value}"));
            }
        }
        if all.is_empty() { "-".to_owned() } else { all.join(";") }
    }
}

/// The blackboard of a node, for its scripts.
pub(super) struct OnBoard<'m, 't> {
    pub(super) machine: &'m mut Machine<'t>,
    pub(super) board: usize,
}

impl Entries for OnBoard<'_, '_> {
    fn read(&mut self, name: &str) -> Result<Value, ScriptError> {
        let number = self.machine.entry(self.board, name);
        match self.machine.held(number) {
            ABSENT => Err(ScriptError(format!("entry {name} does not exist"))),
            EMPTY => Err(ScriptError(format!("entry {name} has no value"))),
            value => {
                let value = self.machine.store.of_number(value).cloned();
                value.ok_or_else(|| ScriptError(format!("entry {name} has no value")))
            }
        }
    }

    fn prepare(&mut self, name: &str, how: Assign) -> Result<(), ScriptError> {
        let number = self.machine.entry(self.board, name);
        if self.machine.entries[number] != ABSENT {
            return Ok(());
        }
        if how != Assign::Create {
            let help = "`:=` would create it";
            return Err(ScriptError(format!("entry {name} does not exist; {help}")));
        }
        self.machine.entries[number] = EMPTY;
        Ok(())
    }

    fn write(&mut self, name: &str, how: Assign, value: Value) -> Result<Value, ScriptError> {
        let number = self.machine.entry(self.board, name);
        let old = self.machine.store.of_number(self.machine.held(number)).cloned();
        let value = stored(old.as_ref(), how, value)?;
        let value_number = self.machine.store.value(&value);
        self.machine.hold(number, value_number);
        self.machine.touch(number);
        Ok(value)
    }
}
