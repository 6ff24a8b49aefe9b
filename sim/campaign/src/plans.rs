//! Plans of faults as a strategy of proptest, for property tests of a user's own; with the feature
//! `proptest`.

use crate::plan::Plan;
use crate::shrink::steps;
use crate::space::Space;
use cotama_sim::streams::Streams;
use proptest::arbitrary::any;
use proptest::strategy::{NewTree, Strategy, ValueTree};
use proptest::test_runner::TestRunner;

/// Plans drawn from a space, which shrink as those of a [campaign](crate::shrink) do.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_campaign::plans::plans;
/// use cotama_campaign::space::{Rates, Space};
/// use cotama_campaign::subject::{Policy, Subject};
/// use proptest::prelude::*;
///
/// let delivery = embedded::mission("delivery").unwrap();
/// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
/// let subject = Subject::new(&mission, Policy::default()).unwrap();
/// let space = Space::of(&mission, Rates::Even, 1..=3);
/// proptest!(ProptestConfig::with_cases(50), |(plan in plans(space))| {
///     let run = subject.run(&plan);
///     prop_assert!(!run.moved_when_safe, "{}", plan.to_toml(&mission));
/// });
/// ```
pub fn plans(space: Space) -> Plans {
    Plans { space }
}

/// The strategy made by [`plans`].
#[derive(Clone, Debug)]
pub struct Plans {
    space: Space,
}

impl Strategy for Plans {
    type Tree = PlanTree;
    type Value = Plan;

    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let seed = any::<u64>().new_tree(runner)?.current();
        let mut stream = Streams::new(seed).stream("plan");
        Ok(PlanTree::of(self.space.draw(&mut stream, &self.space.kinds)))
    }
}

/// A plan, and the simpler ones that are left to be tried.
///
/// ```
/// use cotama_models::robots::Moment;
/// use cotama_campaign::plan::{Fault, Plan};
/// use cotama_campaign::plans::PlanTree;
/// use cotama_core::units::Millis;
/// use proptest::strategy::ValueTree;
/// let fault = |t, mode| Fault::failure(Moment::At(Millis(t)), mode);
/// let mut tree = PlanTree::of(Plan { faults: vec![fault(3_210, 4), fault(17, 9)] });
/// // What fails is any plan with the ninth failure of the file.
/// let fails = |it: &Plan| it.faults.iter().any(|it| it.name() == "failure 9");
/// let mut goes_on = tree.simplify();
/// while goes_on {
///     goes_on = if fails(&tree.current()) { tree.simplify() } else { tree.complicate() };
/// }
/// assert_eq!(tree.current(), Plan { faults: vec![fault(0, 9)] });
/// ```
#[derive(Clone, Debug)]
pub struct PlanTree {
    /// The simplest plan that is known to fail.
    best: Plan,
    current: Plan,
    /// Plans one step from the best one, the next one last.
    left: Vec<Plan>,
}

impl PlanTree {
    /// A tree of this plan.
    pub fn of(plan: Plan) -> Self {
        Self { current: plan.clone(), left: left(&plan), best: plan }
    }

    fn next(&mut self) -> bool {
        let next = self.left.pop();
        let goes_on = next.is_some();
        self.current = next.unwrap_or_else(|| self.best.clone());
        goes_on
    }
}

fn left(plan: &Plan) -> Vec<Plan> {
    let mut left = steps(plan);
    left.reverse();
    left
}

impl ValueTree for PlanTree {
    type Value = Plan;

    fn current(&self) -> Plan {
        self.current.clone()
    }

    /// The current one fails: it is the best one now.
    fn simplify(&mut self) -> bool {
        if self.current != self.best {
            self.best = self.current.clone();
            self.left = left(&self.best);
        }
        self.next()
    }

    /// The current one does not fail: another step from the best one.
    fn complicate(&mut self) -> bool {
        self.next()
    }
}
