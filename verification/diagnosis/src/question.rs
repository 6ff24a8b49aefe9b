//! Explanations of a run for questions that are no formulas.

use super::run::enabled;
use super::story::{Story, Teller};
use super::words::{self, counted, name, short_list};
use cotama_core::net::{PlaceId, TransitionId};

impl Teller<'_> {
    pub(super) fn bound(mut self, places: &[u32]) -> Story {
        let (mut most, mut at) = (None, 0);
        // The walk cannot fail: sequences that are no runs were refused before.
        let _ = self.run().walk(self.pt(), |position, marking| {
            let sum = words::sum(places, marking);
            if most.is_none_or(|most| most < sum) {
                (most, at) = (Some(sum), position);
            }
        });
        let most = counted(most.unwrap_or(0), "token");
        let sum = words::sum_name(self.pt(), places);
        let verb = if places.len() == 1 { "holds" } else { "hold" };
        self.culprits.extend(places);
        Story {
            what: format!("{} {sum} {verb} {most}", self.when(at)),
            cause: self.fired(at).map_or_else(
                || "it is so from the start.".to_owned(),
                |it| format!("{} fired: it raised {sum} to the most.", self.transition(it)),
            ),
            notes: self.grown(places, at).into_iter().collect(),
            culprits: self.culprits,
        }
    }

    pub(super) fn response(mut self, from: TransitionId, to: PlaceId) -> Story {
        let (mut fired, mut met) = (None, None);
        // The walk cannot fail: sequences that are no runs were refused before.
        let _ = self.run().walk(self.pt(), |at, marking| {
            if self.fired(at) == Some(from) {
                (fired, met) = (Some(at), None);
            }
            if fired.is_some() && met.is_none() && words::sum(&[to.0], marking) > 0 {
                met = Some(at);
            }
        });
        let place = name(&self.pt().places, to.0);
        let transition = self.transition(from);
        self.culprits.insert(to.0);
        let what = match (fired, met) {
            (Some(fired), Some(met)) => {
                let marks = if fired == met { "at once".to_owned() } else { self.when(met) };
                format!("{transition} fires {}, and {place} is marked {marks}", self.when(fired))
            }
            (Some(fired), None) => {
                format!("{transition} fires {}, and then {place} is not marked", self.when(fired))
            }
            _ => format!("{transition} does not fire"),
        };
        let what = what.trim_end_matches(',').to_owned();
        Story { what, cause: String::new(), notes: Vec::new(), culprits: self.culprits }
    }

    pub(super) fn one_safe(mut self) -> Story {
        let last = self.run().len();
        let (marking, before) = (self.marking(last), self.marking(last.saturating_sub(1)));
        let crowded: Vec<u32> =
            (0..marking.len() as u32).filter(|it| marking[*it as usize] > 1).collect();
        let names: Vec<_> = crowded
            .iter()
            .map(|it| {
                format!(
                    "{} holds {}",
                    name(&self.pt().places, *it),
                    counted(marking[*it as usize], "token")
                )
            })
            .collect();
        if names.is_empty() {
            return self.end();
        }
        self.culprits.extend(&crowded);
        let full: Vec<_> = crowded
            .iter()
            .filter(|it| before[**it as usize] == 1)
            .map(|it| name(&self.pt().places, *it))
            .collect();
        let cause = match (self.fired(last), full.as_slice()) {
            (None, _) => "it is so from the start.".to_owned(),
            (Some(it), []) => format!("{} fired.", self.transition(it)),
            (Some(it), full) => {
                let verb = if full.len() == 1 { "was" } else { "were" };
                format!(
                    "{} fired while {} {verb} marked already.",
                    self.transition(it),
                    short_list(full, 4)
                )
            }
        };
        let what = format!("{} {}", self.when(last), short_list(&names, 4));
        Story { what, cause, notes: Vec::new(), culprits: self.culprits }
    }

    /// Ends the story with the marking that the run leads to, when nothing more can be said.
    pub(super) fn end(mut self) -> Story {
        let last = self.run().len();
        let when = self.when(last);
        if enabled(self.pt(), &self.marking(last)).next().is_some() {
            let what = format!("the run below is in its last marking {when}")
                .trim_end_matches(',')
                .to_owned();
            return Story { what, culprits: self.culprits, ..Story::default() };
        }
        let cause = self.fired(last).map_or_else(String::new, |it| {
            format!("{} fired: it left nothing that can fire.", self.transition(it))
        });
        let notes = self.stuck();
        Story { what: format!("{when} nothing can fire"), cause, notes, culprits: self.culprits }
    }
}
