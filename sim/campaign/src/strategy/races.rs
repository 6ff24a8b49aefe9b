//! Plans whose failures are seen just when a supervisor acts.

use super::uniform::each;
use super::{Draws, Strategy};
use crate::plan::{Fault, Plan};
use crate::space::Space;
use cotama_sim::streams::Stream;

/// Races.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::space::{Rates, Space};
/// use cotama_campaign::strategy::{Races, Strategy};
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let space = Space::of(&mission, Rates::Even, 1..=3);
/// assert!(space.acts_ms.contains(&166_200)); // the object is received
/// let plan = Races.block(&space, 0, 0).next();
/// assert!((1..=3).contains(&plan.faults.len()));
/// ```
///
/// What goes wrong between two events that nearly come together has few moments to be drawn
/// at. Most failures are drawn so that their observers see them in one of the rounds before the
/// supervisors act in a run in which nothing fails, and some plans have an operator with answers of
/// his own: boundary values (Myers, The Art of Software Testing, 1979) in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Races;

impl Strategy for Races {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        each(space, seed, first, racing)
    }
}

fn racing(space: &Space, stream: &mut Stream) -> Plan {
    let mut plan = space.draw(stream, &space.kinds);
    for it in &mut plan.faults {
        if stream.below(4) > 0 {
            race(it, space, stream);
        }
    }
    answer(&mut plan, space, stream);
    plan
}

/// The failure is seen about when a supervisor acts.
pub(super) fn race(fault: &mut Fault, space: &Space, stream: &mut Stream) {
    if let Fault::Failure(it) = fault
        && let Some(race) = space.race(it.failure, stream)
    {
        (it.when, it.until) = (race, None);
    }
}

/// One plan in three has an operator with answers of his own, where there are supervisors: as one
/// of its faults.
pub(super) fn answer(plan: &mut Plan, space: &Space, stream: &mut Stream) {
    if !space.parts.is_empty() && stream.below(3) == 0 {
        plan.faults.truncate(space.most.saturating_sub(1) as usize);
        plan.faults.push(space.answers(stream));
    }
}
