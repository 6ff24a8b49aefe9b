//! Checkers of nets with watches.

use super::{Checker, Choice, Model, Options};
use crate::engines::{Budget, Known, STORED};
use crate::explicit::{Limits, Watching};

/// The same of a net with watches, where that of the net without is there: its markings are pairs
/// of numbers, and take little time.
const WATCHED: u64 = 20_000_000;

impl Checker<'_> {
    /// A checker of the same net with watches. Where evidence asks for graphs, that of the net with
    /// watches is made of that of the net without, so that what the net does is explored once.
    pub fn watched<'w>(
        &self,
        model: &'w Model,
        watching: Watching,
        options: &Options<'_>,
    ) -> Checker<'w> {
        let budget = Budget::from(options);
        let few = |most| {
            let states = options.limits.states.min(most);
            budget.with(Limits { states, ..options.limits })
        };
        if options.engine == Choice::Auto && options.evidence {
            // One that is too large is not kept, and each net has its own.
            let _ = self.known.graph(&few(STORED));
        }
        match self.known.made().filter(|_| options.engine == Choice::Auto) {
            None => Checker::new(model),
            Some(graph) => {
                let known = Known::watched(model.pt(), graph, watching);
                let _ = known.graph(&few(WATCHED));
                Checker { known }
            }
        }
    }
}
