//! The methods of the thesis, for comparison only: all coalitions, all orderings, greedy rounds,
//! shares of coalitions, pruning by capability (F. Rohrmueller, dissertation, TU München 2011, ch.
//! 3).

mod capability;
mod formation;
mod rounds;
mod shares;

pub use capability::{has_matching, has_roles, has_union};
pub use formation::{Formed, all_coalitions, all_orderings};
pub use rounds::{Rounds, State, greedy};
pub use shares::Shares;

use cotama_core::team::RobotSet;
use cotama_core::team::{Cost, Costs};

/// A set with one robot.
const fn bit(robot: usize) -> RobotSet {
    1_u128.wrapping_shl(robot as u32)
}

/// The table with only these robots, in the order of their numbers; none where memory lacks.
fn only<'e>(
    costs: &Costs<'_>,
    robots: RobotSet,
    entries: &'e mut [Option<Cost>],
) -> Option<Costs<'e>> {
    let mut count = 0_usize;
    let chosen = (0..costs.columns()).filter(|it| robots & bit(*it) != 0);
    let columns = chosen.fold(0_usize, |count, _| count.wrapping_add(1));
    for row in 0..costs.rows() {
        for (robot, cost) in (0..costs.columns()).zip(costs.row(row)) {
            if robots & bit(robot) != 0 {
                *entries.get_mut(count)? = cost;
                count = count.saturating_add(1);
            }
        }
    }
    Costs::new(entries.get(..count)?, columns)
}
