//! The parts of a model that no run uses.

use super::{Checker, Options};
use crate::coverability::{CoverabilitySet, Tokens};
use crate::engines::Budget;
use crate::explicit::Limit;
use cotama_diagnosis::Unused;
use cotama_property::time::TimeNet;

impl<'m> Checker<'m> {
    /// The transitions that never fire and the places that are never marked: all, by a complete
    /// search; or, where a limit is reached, those that the structure of the net shows.
    ///
    /// ```
    /// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
    /// use cotama_verification::check::{Checker, Model, Options};
    ///
    /// let mut net = OwnedNet::new("alarm", "");
    /// let smoke = net.place(OwnedPlace::new("smoke", 0)).unwrap();
    /// net.transition(OwnedTransition::new("ring").take(smoke, 1)).unwrap();
    /// let alarm = Model::from(&net.view().net());
    /// let unused = Checker::new(&alarm).unused(&Options::default());
    /// assert!(unused.is_complete);
    /// assert_eq!(unused.never_fired()[0].why, "needs `smoke`, which is never marked");
    /// assert_eq!(unused.never_marked()[0].name, "smoke");
    /// ```
    pub fn unused(&self, options: &Options<'_>) -> Unused<'m> {
        let budget = Budget::from(options);
        let all = match self.known.time() {
            None => self.in_any_order(&budget),
            Some(net) => self.in_time(net, &budget),
        };
        all.unwrap_or_else(|| {
            let structure = self.known.structure(&budget).filter(|_| self.known.pt().is_plain());
            let found = structure.map(|mut structure| {
                structure.find_dead_transitions();
                structure.dead().transitions.clone()
            });
            Unused::with_dead(self.known.pt(), &found.unwrap_or_default())
        })
    }

    fn in_any_order(&self, budget: &Budget<'_>) -> Option<Unused<'m>> {
        let pt = self.known.pt();
        let space = self.known.space(budget);
        let (dead, marked): (_, Vec<bool>) = match space.limit {
            None => {
                (space.dead_transitions.clone(), space.bounds.iter().map(|it| *it > 0).collect())
            }
            Some(Limit::Unbounded) => {
                let set = CoverabilitySet::new(pt, &budget.coverability()).ok()?;
                (
                    set.dead_transitions(),
                    set.bounds().iter().map(|it| *it > Tokens::new(0)).collect(),
                )
            }
            Some(_) => return None,
        };
        let mut fired = vec![true; pt.transitions.len()];
        for it in &dead {
            fired[it.0 as usize] = false;
        }
        Some(Unused::new(pt, &fired, &marked))
    }

    fn in_time(&self, net: &TimeNet, budget: &Budget<'_>) -> Option<Unused<'m>> {
        let classes = self.known.classes(net, &budget.limits).ok()?;
        let pt = self.known.pt();
        let mut marked = vec![false; pt.places.len()];
        for class in 0..classes.classes() as u32 {
            marked
                .iter_mut()
                .zip(classes.marking(class))
                .for_each(|(it, tokens)| *it |= *tokens > 0);
        }
        Some(Unused::new(pt, &classes.fired(pt.transitions.len()), &marked).timed())
    }
}
