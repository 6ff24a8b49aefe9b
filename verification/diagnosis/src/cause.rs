//! By what it came about: the firing that did it, what repeats, what is lacking.

use super::mirror::mirrored;
use super::run::enabled;
use super::story::Teller;
use super::touched;
use super::words::{self, Says, counted, list, name, short_list};
use cotama_core::net::TransitionId;
use cotama_property::{Assumptions, Ctl, Formula};
use std::collections::{BTreeSet, HashSet};

/// The most lines of one kind.
const MOST: usize = 6;

impl Teller<'_> {
    /// The cause, and what is to be added to it.
    pub(super) fn reason(&self) -> (String, Vec<String>) {
        match (&self.forever, self.run().cycle()) {
            (Some(forever), Some(cycle)) if !cycle.is_empty() => self.repeating(forever, cycle),
            (Some(forever), Some(_)) => {
                let last = self.run().len();
                let fired = self.fired(last).map_or_else(
                    || "nothing can fire at the start".to_owned(),
                    |it| {
                        format!(
                            "after {} at step {last} nothing can fire any more",
                            self.transition(it)
                        )
                    },
                );
                (format!("{fired}, and {}.", words::always(self.pt(), forever)), Vec::new())
            }
            _ => match &self.moment {
                Some((at, literals)) => self.moment(*at, literals),
                None => (String::new(), Vec::new()),
            },
        }
    }

    /// By which firing something came to be.
    fn moment(&self, at: usize, literals: &[Formula]) -> (String, Vec<String>) {
        let Some(fired) = self.fired(at) else {
            return ("it is so from the start.".to_owned(), Vec::new());
        };
        let (before, after) = (self.marking(at - 1), self.marking(at));
        let (old, new): (Vec<_>, Vec<_>) =
            literals.iter().cloned().partition(|it| words::holds(self.pt(), it, &before));
        // The new one of the two inequalities of an equation is enough.
        let sums = |it: &Formula| match words::says(it) {
            Says::Sum { places, .. } => Some(places),
            _ => None,
        };
        let is_said = |it: &Formula| {
            sums(it).is_some_and(|it| new.iter().any(|new| sums(new).as_ref() == Some(&it)))
        };
        let old: Vec<Formula> = old.into_iter().filter(|it| !is_said(it)).collect();
        let transition = self.transition(fired);
        if new.is_empty() {
            return (format!("{transition} fired at step {at}."), Vec::new());
        }
        let effect = words::effect(self.pt(), &new, &before, &after);
        if old.is_empty() {
            return (format!("{transition} fired: {effect}."), Vec::new());
        }
        let already = words::sentence(self.pt(), &old, &before, true);
        if self.case.holds {
            return (format!("{transition} fired while {already}: {effect}."), Vec::new());
        }
        let near: BTreeSet<u32> = {
            let needs = self.pt().needs.of(fired.0).iter().map(|it| it.0);
            let inhibits = self.pt().inhibits(fired.0).iter().map(|it| it.0);
            needs.chain(inhibits).chain(touched(self.pt(), fired.0)).collect()
        };
        let apart: Vec<_> =
            words::places(&old).difference(&near).map(|it| name(&self.pt().places, *it)).collect();
        let name = name(&self.pt().transitions, fired.0);
        let blind = (!apart.is_empty()).then(|| {
            format!("{name} does not depend on {}: no arc joins them.", short_list(&apart, 4))
        });
        let kept: Vec<_> = words::places(&old)
            .into_iter()
            .filter(|it| near.contains(it) && before[*it as usize] == after[*it as usize])
            .map(|it| words::name(&self.pt().places, it))
            .collect();
        let kept = (!kept.is_empty())
            .then(|| format!("{name} needs {} and leaves it as it is.", short_list(&kept, 4)));
        (
            format!("{transition} fired while {already}: {effect}."),
            blind.into_iter().chain(kept).collect(),
        )
    }

    /// Which clocks were started anew although their transitions stayed enabled: timeouts that were
    /// put off.
    pub(super) fn clocks(&self, to: usize) -> Vec<String> {
        let (Some(net), false) = (self.case.net, self.along.dates.is_empty()) else {
            return Vec::new();
        };
        let fired: Vec<u32> = self.run().firings().map(|it| it.0).collect();
        let mut anew = vec![None; net.transitions.len()];
        let mut before: Vec<u32> = Vec::new();
        // The walk cannot fail: sequences that are no runs were refused before.
        let _ = self.run().walk(self.pt(), |at, marking| {
            if let Some(&last) = at.checked_sub(1).filter(|_| at <= to).and_then(|it| fired.get(it))
            {
                let mut left = before.clone();
                for arc in net.transitions[last as usize].take {
                    if let Some(tokens) = left.get_mut(arc.place.0 as usize) {
                        *tokens = tokens.saturating_sub(arc.weight);
                    }
                }
                for (transition, anew) in anew.iter_mut().enumerate() {
                    let transition = transition as u32;
                    if !self.pt().enabled(marking, transition) {
                        *anew = None;
                    } else if transition != last && !self.pt().enabled(&left, transition) {
                        *anew = self.pt().enabled(&before, transition).then_some(at);
                    }
                }
            }
            before = marking.to_vec();
        });
        let mut notes = Vec::new();
        for (transition, it) in net.transitions.iter().enumerate() {
            let (Some(at), Some(within)) = (anew[transition], it.within) else { continue };
            let by =
                self.fired(at).map_or_else(String::new, |it| name(&self.pt().transitions, it.0));
            notes.push(format!(
                "{} comes after {} ms, and its clock was started anew at {} ms by {by}, at step \
                 {at}.",
                name(&self.pt().transitions, transition as u32),
                within.earliest,
                self.along.dates[at - 1],
            ));
        }
        notes.truncate(MOST);
        notes
    }

    /// Returns words for the cycle that repeats for ever, and for the transitions that could fire
    /// instead.
    fn repeating(&self, forever: &Formula, cycle: &[TransitionId]) -> (String, Vec<String>) {
        let start = self.run().stem.len();
        let mut seen = HashSet::new();
        let first = cycle.iter().filter(|it| seen.insert(it.0));
        let names: Vec<String> = first.map(|it| name(&self.pt().transitions, it.0)).collect();
        let steps = match cycle {
            [_] => format!("step {} repeats", start + 1),
            [_, _] => format!("steps {} and {} repeat", start + 1, start + 2),
            _ => format!("steps {} to {} repeat", start + 1, start + cycle.len()),
        };
        let always = words::always(self.pt(), forever);
        let cause = format!("{steps} for ever ({}), and {always}.", short_list(&names, MOST));
        let mut often = vec![0_usize; self.pt().transitions.len()];
        // The walk cannot fail: sequences that are no runs were refused before.
        let _ = self.run().walk(self.pt(), |at, marking| {
            if (start..start + cycle.len()).contains(&at) {
                enabled(self.pt(), marking).for_each(|it| often[it as usize] += 1);
            }
        });
        let waits = |it: &u32| often[*it as usize] > 0 && !cycle.contains(&TransitionId(*it));
        // Transitions that would end the lasting condition, or else all.
        let ends = |it: &u32| self.ends(*it, forever);
        let all = || (0..self.pt().transitions.len() as u32).filter(waits);
        let some: Vec<u32> =
            if all().any(|it| ends(&it)) { all().filter(ends).collect() } else { all().collect() };
        let is_of_ctl =
            self.case.property.question.formula().is_some_and(|it| Ctl::new(it).is_some());
        let note = |it: &u32| {
            let fair = || vec![TransitionId(*it)];
            let (times, assumed) = match often[*it as usize] {
                all if all == cycle.len() => (
                    "before every step of the cycle".to_owned(),
                    Assumptions { weak: fair(), ..Assumptions::default() },
                ),
                some => (
                    format!("before {some} of {} steps of the cycle", cycle.len()),
                    Assumptions { strong: fair(), ..Assumptions::default() },
                ),
            };
            let name = self.transition(TransitionId(*it));
            let left_out = if is_of_ctl {
                format!(" (left out by `{}`)", assumed.display(self.pt()))
            } else {
                String::new()
            };
            format!("{name} could fire {times} and never does: the run is unfair to it{left_out}.")
        };
        (cause, some.iter().take(MOST).map(note).collect())
    }

    /// Whether a firing works towards the end of what lasts: marks a place that is to be empty, or
    /// empties one.
    fn ends(&self, transition: u32, forever: &Formula) -> bool {
        let parts = match forever {
            Formula::And(parts) => parts.as_slice(),
            one => std::slice::from_ref(one),
        };
        let effects = self.pt().effects.of(transition);
        parts.iter().any(|it| match words::says(it) {
            Says::Empty(place) => effects.iter().any(|it| it.0 == place && it.1 > 0),
            Says::Marked(place) => effects.iter().any(|it| it.0 == place && it.1 < 0),
            _ => false,
        })
    }

    /// Returns notes on the growth of sums of tokens up to a position.
    pub(super) fn growth(&self, to: usize, literals: &[Formula]) -> Vec<String> {
        let mut notes = Vec::new();
        for literal in literals {
            if let Says::Sum { places, large: true } = words::says(literal) {
                notes.extend(self.grown(&places, to));
            }
        }
        notes
    }

    pub(super) fn grown(&self, places: &[u32], to: usize) -> Option<String> {
        let (mut before, mut steps) = (None, Vec::new());
        // The walk cannot fail: sequences that are no runs were refused before.
        let _ = self.run().walk(self.pt(), |at, marking| {
            let now = words::sum(places, marking);
            if before.is_some_and(|before| before < now) && at <= to {
                let fired = self
                    .fired(at)
                    .map_or_else(String::new, |it| name(&self.pt().transitions, it.0));
                steps.push(format!("{now} at step {at} ({fired})"));
            }
            before = Some(now);
        });
        let left_out = steps.len().saturating_sub(MOST);
        let from = if left_out > 0 { "at last " } else { "" };
        let shown = &steps[left_out..];
        (shown.len() > 1).then(|| {
            format!("{} grew to {from}{}.", words::sum_name(self.pt(), places), list(shown))
        })
    }

    /// Which tokens keep transitions from firing that have what they need.
    fn inhibited(&mut self, waiting: &[u32], marking: &[u32]) -> Vec<String> {
        let pt = self.along.pt;
        let mut notes = Vec::new();
        for &transition in waiting.iter().take(MOST) {
            let full = |it: &&(u32, u32)| marking[it.0 as usize] >= it.1;
            let full: Vec<_> = pt.inhibits(transition).iter().filter(full).collect();
            self.culprits.extend(full.iter().map(|it| it.0));
            let reasons: Vec<_> = full
                .iter()
                .map(|&&(place, below)| {
                    let tokens = counted(marking[place as usize] as usize, "token");
                    format!("{} has {tokens}, must be below {below}", name(&pt.places, place))
                })
                .collect();
            notes.push(format!("{} waits: {}.", name(&pt.transitions, transition), list(&reasons)));
        }
        if waiting.len() > MOST {
            notes.push(format!("{} more wait.", counted(waiting.len() - MOST, "transition")));
        }
        notes
    }

    /// Which tokens the transitions nearest to being enabled wait for, and what would give them.
    pub(super) fn stuck(&mut self) -> Vec<String> {
        let marking = self.marking(self.run().len());
        let pt = self.along.pt;
        let missing = |transition: u32| -> Vec<(u32, u32)> {
            let needs = pt.needs.of(transition).iter();
            needs.filter(|it| marking[it.0 as usize] < it.1).copied().collect()
        };
        let all = || 0..pt.transitions.len() as u32;
        let waiting: Vec<_> = all().filter(|it| missing(*it).is_empty()).collect();
        if !waiting.is_empty() {
            return self.inhibited(&waiting, &marking);
        }
        let least = all().map(|it| missing(it).len()).min().unwrap_or(0);
        let met = |it: &u32| pt.needs.of(*it).len() > missing(*it).len();
        // Transitions that have some of their tokens are nearer than those that have none.
        let mut nearest: Vec<u32> =
            all().filter(|it| missing(*it).len() == least && met(it)).collect();
        if nearest.is_empty() {
            nearest = all().filter(|it| missing(*it).len() == least).collect();
        }
        let mut notes = Vec::new();
        let mirrored = mirrored(self.case);
        for &transition in nearest.iter().take(MOST) {
            let missing = missing(transition);
            self.culprits.extend(missing.iter().map(|it| mirrored[it.0 as usize].unwrap_or(it.0)));
            let places: Vec<_> = missing
                .iter()
                .map(|&(place, weight)| {
                    match (mirrored[place as usize], weight - marking[place as usize]) {
                        (Some(of), _) => format!("room in {}", name(&pt.places, of)),
                        (None, 1) => format!("a token in {}", name(&pt.places, place)),
                        (None, more) => format!("{more} tokens in {}", name(&pt.places, place)),
                    }
                })
                .collect();
            let producers: Vec<_> = match missing.as_slice() {
                [(place, _)] => {
                    pt.changers.of(*place).iter().filter(|it| it.1 > 0).map(|it| it.0).collect()
                }
                _ => Vec::new(),
            };
            let producers: Vec<_> = producers.iter().map(|it| name(&pt.transitions, *it)).collect();
            let given = match (missing.len(), producers.as_slice()) {
                (1, []) => ", which nothing gives".to_owned(),
                (1, [one]) => format!(", which only {one} gives"),
                (1, some) => format!(", which {} give", short_list(some, 3)),
                _ => String::new(),
            };
            notes.push(format!(
                "{} lacks {}{given}.",
                name(&pt.transitions, transition),
                list(&places)
            ));
        }
        if nearest.len() > MOST {
            notes.push(format!(
                "{} more lack as much.",
                counted(nearest.len() - MOST, "transition")
            ));
        }
        notes
    }
}
