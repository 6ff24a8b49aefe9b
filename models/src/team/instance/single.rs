//! Tasks of one robot each: one assignment.

use super::solve::{Assignment, Done, Proof, Reason, Verdict};
use super::{Instance, MAX_INSTANCE_ENTRIES};
use cotama_core::allocation::MemoryError;
use cotama_core::team::{Amount, AssignmentError, Cost, Costs, Memory, assign};

/// The memory of an assignment, on the heap, with a table.
pub(super) struct Room<N> {
    rows: usize,
    columns: usize,
    entries: Vec<Option<Cost>>,
    words: Vec<u32>,
    amounts: Vec<N>,
}

impl<N: Amount + Default> Room<N> {
    pub(super) fn new(rows: usize, columns: usize, entries: usize) -> Self {
        Self {
            rows,
            columns,
            entries: vec![None; entries],
            words: vec![0; Memory::<N>::words(rows, columns)],
            amounts: vec![N::default(); Memory::<N>::amounts(columns)],
        }
    }

    /// The table and the memory.
    pub(super) fn parts(&mut self) -> Result<(&mut [Option<Cost>], Memory<'_, N>), MemoryError> {
        let Self { rows, columns, entries, words, amounts } = self;
        Ok((entries, Memory::new(*rows, *columns, words, amounts)?))
    }
}

/// Assigns, in 32 bits where that suffices.
pub(super) fn assigned<R>(
    costs: &Costs<'_>,
    act: impl Fn(&Costs<'_>, Result<u64, AssignmentError>, &dyn Read) -> R,
) -> Result<R, MemoryError> {
    let mut narrow = Room::<i32>::new(costs.rows(), costs.columns(), 0);
    let (_, mut memory) = narrow.parts()?;
    let result = assign(costs, &mut memory);
    if result != Err(AssignmentError::TooLarge) {
        return Ok(act(costs, result, &memory));
    }
    let mut wide = Room::<i64>::new(costs.rows(), costs.columns(), 0);
    let (_, mut memory) = wide.parts()?;
    let result = assign(costs, &mut memory);
    Ok(act(costs, result, &memory))
}

/// Read access to a memory of any width.
pub(super) trait Read {
    fn column(&self, row: usize) -> Option<usize>;
    fn price(&self, column: usize) -> i64;
    fn in_conflict(&self, row: usize) -> bool;
}

impl<N: Amount> Read for Memory<'_, N> {
    fn column(&self, row: usize) -> Option<usize> {
        Memory::column(self, row)
    }
    fn price(&self, column: usize) -> i64 {
        Memory::price(self, column)
    }
    fn in_conflict(&self, row: usize) -> bool {
        Memory::in_conflict(self, row)
    }
}

impl Instance {
    /// Tasks are rows, robots are columns; a task that may be left undone has one more column,
    /// that no other task has.
    pub(super) fn solve_single(&self) -> Result<Assignment, MemoryError> {
        let (tasks, robots) = (self.tasks.len(), self.robots.len());
        let optional = self.tasks.iter().filter(|it| it.skip.is_some()).count();
        let columns = robots.saturating_add(optional);
        let entries = tasks.saturating_mul(columns);
        if entries > MAX_INSTANCE_ENTRIES {
            let limit =
                format!("{tasks} tasks and {robots} robots make a table of {entries} costs");
            return Ok(self.too_large(limit));
        }
        let mut table = vec![None; entries];
        let mut place = robots;
        for (row, task) in table.chunks_mut(columns.max(1)).zip(&self.tasks) {
            for (entry, cost) in row.iter_mut().zip(task.plans.iter().flat_map(|it| &it.costs)) {
                *entry = *cost;
            }
            if task.skip.is_some() {
                if let Some(entry) = row.get_mut(place) {
                    *entry = task.skip;
                }
                place += 1;
            }
        }
        let lacks = MemoryError { what: "assignment", needed: columns, given: 0 };
        let costs = Costs::new(&table, columns).ok_or(lacks)?;
        assigned(&costs, |_, result, memory| self.single_answer(result, memory))?
    }

    fn single_answer(
        &self,
        result: Result<u64, AssignmentError>,
        memory: &dyn Read,
    ) -> Result<Assignment, MemoryError> {
        let robots = self.robots.len();
        match result {
            Ok(total) => {
                let cost = total.saturating_mul(self.denominator.into());
                let done = |task| {
                    let robot = memory.column(task).filter(|it| *it < robots)?;
                    Some(Done { task, plan: 0, robots: vec![robot] })
                };
                // The right to be left undone is worth nothing to other tasks: these columns need
                // no price.
                let price = |robot| memory.price(robot).unsigned_abs();
                Ok(Assignment {
                    verdict: Verdict::Optimal { cost },
                    done: (0..self.tasks.len()).filter_map(done).collect(),
                    proof: Proof::Prices((0..robots).map(price).collect()),
                })
            }
            Err(AssignmentError::Infeasible { .. }) => {
                // Tasks that may be left undone are left out: each takes a column of its own with
                // it.
                let must = |it: &usize| self.tasks.get(*it).is_some_and(|it| it.skip.is_none());
                let tasks = (0..self.tasks.len()).filter(|it| memory.in_conflict(*it));
                let tasks: Vec<_> = tasks.filter(must).collect();
                let reason = Reason { robots: self.capable(&tasks), tasks };
                let (verdict, proof) = (Verdict::Infeasible(reason), Proof::Hall);
                Ok(Assignment { verdict, done: vec![], proof })
            }
            Err(AssignmentError::Memory(error)) => Err(error),
            Err(AssignmentError::TooLarge) => Ok(self.too_large("costs pass 64 bits".into())),
        }
    }

    /// The robots that are capable of a role of one of these tasks.
    pub(super) fn capable(&self, tasks: &[usize]) -> Vec<usize> {
        let mut is_capable = vec![false; self.robots.len()];
        for plan in tasks.iter().filter_map(|it| self.tasks.get(*it)).flat_map(|it| &it.plans) {
            for (number, cost) in plan.costs.iter().enumerate() {
                let robot = number.checked_rem(self.robots.len()).unwrap_or(0);
                if let (Some(_), Some(it)) = (cost, is_capable.get_mut(robot)) {
                    *it = true;
                }
            }
        }
        is_capable.iter().enumerate().filter(|it| *it.1).map(|it| it.0).collect()
    }
}
