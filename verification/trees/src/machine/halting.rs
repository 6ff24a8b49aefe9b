//! Scripts, and halting: memory, children, the script afterwards.

use super::boards::OnBoard;
use super::{Fault, Machine, Status, Stop, choices, leaves};
use crate::script::{Script, Value, evaluate, truth};
use crate::tree::Kind;

impl Machine<'_> {
    /// Runs a script of a node, and returns its value.
    pub(crate) fn script(&mut self, node: usize, script: &Script) -> Result<Value, Fault> {
        let board = self.tree.nodes[node].board;
        let mut last = Value::Real(0.0);
        for statement in &script.statements {
            let mut entries = OnBoard { machine: self, board };
            last = evaluate(statement, &mut entries)
                .map_err(|it| Fault(format!("{it}, in the script `{}`", script.text)))?;
        }
        Ok(last)
    }

    pub(crate) fn holds(&mut self, node: usize, script: &Script) -> Result<bool, Fault> {
        let value = self.script(node, script)?;
        truth(&value).map_err(|it| Fault(format!("{it}, in the script `{}`", script.text)))
    }

    /// Runs a script from outside on the root's blackboard.
    ///
    /// # Errors
    ///
    /// Returns why it throws.
    pub fn assign(&mut self, script: &Script) -> Result<Value, String> {
        self.script(0, script).map_err(|it| it.0)
    }

    /// Halts a node: its memory, its children, its script.
    pub(crate) fn halt(&mut self, node: usize) -> Result<(), Fault> {
        if !leaves::halted(self, node) {
            match self.tree.nodes[node].kind {
                Kind::TryCatch { on_halt: true } => self.catch(node)?,
                Kind::ManualSelector { .. } => choices::halt_manual(self, node)?,
                _ => {}
            }
            self.forget(node);
            for at in 0..self.children(node).len() {
                self.reset(self.child(node, at))?;
            }
            self.put_status(node, Status::Idle);
        }
        match &self.tree.nodes[node].afterwards.on_halted {
            Some(script) => self.script(node, script).map(|_| ()),
            None => Ok(()),
        }
    }

    /// Clears the memory that halting clears.
    fn forget(&mut self, node: usize) {
        let start = self.layout.start[node];
        for cell in self.layout.halting[node].clone() {
            self.cells[start + cell] = 0;
        }
    }

    /// Halts a child if it runs; it is IDLE afterwards.
    pub(crate) fn reset(&mut self, child: usize) -> Result<(), Fault> {
        if self.status(child) == Status::Running {
            self.halt(child)?;
        }
        self.put_status(child, Status::Idle);
        Ok(())
    }

    pub(crate) fn reset_children(&mut self, node: usize) -> Result<(), Fault> {
        for &child in self.children(node) {
            self.reset(child)?;
        }
        Ok(())
    }

    /// Halts the root, then every node once more.
    pub(super) fn halt_all(&mut self) -> Stop {
        let mut nodes = std::iter::once(0).chain(0..self.tree.nodes.len());
        match nodes.try_for_each(|node| self.halt(node)) {
            Ok(()) => Stop::Halted,
            Err(fault) => self.thrown(None, fault),
        }
    }
}
