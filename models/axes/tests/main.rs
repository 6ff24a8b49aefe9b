//! Tests of the crate, by subject.

mod broken;
mod brute;
mod edited;
mod forms;
mod patrol;
mod small;
mod speeds;

use cotama_axes::{Case, Lifted, Problem, Steps, Table};

/// The table of a case, and no more than the usual work.
fn table(case: &Case, lifted: Lifted) -> Table {
    Table::new(&case.mission, lifted, &mut Steps::default()).unwrap()
}

fn problem<'m>(case: &'m Case, table: &'m Table) -> Problem<'m> {
    Problem::new(&case.mission, table, Lifted::default())
}

/// The constraints of these names, as a set.
fn lifted(case: &Case, names: &[&str]) -> Lifted {
    let number = |it: &&str| case.mission.constraint(it).unwrap();
    names.iter().map(number).fold(Lifted::default(), Lifted::with)
}
