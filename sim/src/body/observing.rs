//! The flags that observers of a robot raise and lower, after their latencies.

use super::effect::{observable, raises};
use super::laptop::{Seen, jobs};
use super::robot::{Failure, Robot};
use super::{PERIOD, Planted};
use cotama_core::units::Millis;
use cotama_models::cotama::{FailureMode, Flag, Flags, Module, Modules, Perceived, Situation};

/// The state of the decisional level on which it depends what observers see.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watch<'p> {
    pub(crate) situation: Situation,
    /// The modules that observe.
    pub(crate) observing: Modules,
    /// The defects of observers.
    pub(crate) planted: &'p [Planted],
}

/// The news of a period.
#[derive(Clone, Debug)]
pub(crate) struct Observed {
    pub(crate) perceived: Perceived,
    /// The numbers of the failures that are seen from now on.
    pub(crate) seen: Vec<usize>,
    /// The failure that the flags go back to.
    pub(crate) cause: Option<usize>,
}

impl Watch<'_> {
    /// Whether an observer at work should see a failure now, whatever is wrong with observers.
    pub(crate) fn shows(&self, it: &Failure, moving: bool) -> bool {
        observable(it.mode, self.situation, moving) && !raises(it.mode, self.observing).is_empty()
    }

    /// How long an observer takes to see a failure, in ms.
    pub(crate) fn latency_ms(&self, mode: FailureMode) -> u64 {
        let later = self.planted.iter().filter_map(|it| match *it {
            Planted::Late(late, by) if late == mode => Some(by.0),
            _ => None,
        });
        u64::from(mode.rule().latency_ms) + later.sum::<u64>()
    }
}

impl Robot {
    /// Observers look for a period; the scheduler has seen this.
    pub(crate) fn observe(&mut self, scheduler: Seen, watch: &Watch<'_>) -> Observed {
        let seen = self.newly_seen(scheduler, watch);
        let by_observers = seen.iter().map(|&it| &self.failures[it]);
        let by_observers = by_observers.filter(|it| !is_shown(it, scheduler));
        let flags = by_observers.map(|it| raises(it.mode, watch.observing));
        let raised = flags.fold(scheduler.flags, Flags::union);
        let first = seen.first().map_or(Modules::NONE, |&it| self.failures[it].part);
        let part = if scheduler.part.is_empty() { first } else { scheduler.part };
        let works = self.works();
        let perceived = Perceived { raised, lowered: self.newly_lowered(), part, works };
        // A module that the scheduler sees again goes back to its state before.
        let again = || self.failures.iter().rposition(|it| is_shown(it, scheduler));
        let cause = seen.first().copied().or_else(again);
        Observed { perceived, seen, cause }
    }

    /// The decisional level was told of these failures.
    pub(crate) fn are_found(&mut self, failures: &[usize]) {
        for &it in failures {
            self.failures[it].found = true;
        }
    }

    /// The decisional level starts anew: what is under way is to be found again.
    pub(crate) fn are_new_again(&mut self) {
        for it in self.failures.iter_mut().filter(|it| !it.over) {
            (it.found, it.seen) = (false, Millis(0));
        }
    }

    /// The modules that work, and that somebody would see fail.
    fn works(&mut self) -> Modules {
        let broken = self.broken();
        if self.works.0 != broken {
            self.works = (broken, broken.relied_on());
        }
        self.works.1
    }

    /// Whether an observer can see a failure now.
    pub(crate) fn is_observable(&self, mode: FailureMode, watch: &Watch<'_>, moving: bool) -> bool {
        let hides = |it: &Planted| match *it {
            Planted::Unseen(unseen) => unseen == mode,
            Planted::UnseenWhile(first, unseen) => {
                unseen == mode && self.failures.iter().any(|it| it.mode == first && !it.over)
            }
            _ => false,
        };
        observable(mode, watch.situation, moving) && !watch.planted.iter().any(hides)
    }

    /// A failure that is not seen was shown for longer.
    fn show(&mut self, number: usize, time: Millis) {
        let it = &mut self.failures[number];
        it.shown.0 += time.0;
        let late = it.shown.0.saturating_sub(u64::from(it.mode.rule().latency_ms).max(PERIOD.0));
        self.unseen = self.unseen.max(Millis(late));
    }

    /// The failures that are seen from now on.
    fn newly_seen(&mut self, scheduler: Seen, watch: &Watch<'_>) -> Vec<usize> {
        let mut seen = Vec::new();
        for number in 0..self.failures.len() {
            let it = self.failures[number];
            if !it.found && is_shown(&it, scheduler) {
                seen.push(number);
            }
            self.look(number, PERIOD, watch);
            let it = self.failures[number];
            let is_open = !it.over && !it.found;
            if is_open
                && self.is_observable(it.mode, watch, self.moves())
                && it.seen.0 >= watch.latency_ms(it.mode)
            {
                seen.push(number);
            }
        }
        seen
    }

    /// Observers look at a failure for a time.
    fn look(&mut self, number: usize, time: Millis, watch: &Watch<'_>) {
        let (it, moving) = (self.failures[number], self.moves());
        if it.over || it.found {
            return;
        }
        if watch.shows(&it, moving) {
            self.show(number, time);
        }
        if self.is_observable(it.mode, watch, moving) {
            self.failures[number].seen.0 += time.0;
        }
    }

    /// Observers look for a time in which none of them sees anything new.
    pub(crate) fn look_on(&mut self, time: Millis, watch: &Watch<'_>) {
        (0..self.failures.len()).for_each(|number| self.look(number, time, watch));
    }

    /// In how many periods no observer sees a failure that it does not see yet.
    pub(crate) fn periods_unseen(&self, watch: &Watch<'_>) -> u64 {
        let moving = self.moves();
        let unseen = self
            .failures
            .iter()
            .filter(|it| !it.over && !it.found && self.is_observable(it.mode, watch, moving));
        let periods = unseen.filter_map(|it| {
            let left = watch.latency_ms(it.mode).checked_sub(it.seen.0)?;
            // A failure that was seen for long enough and raises nothing changes nothing.
            (left > 0).then(|| left.div_ceil(PERIOD.0) - 1)
        });
        periods.min().unwrap_or(u64::MAX)
    }

    /// The flags of failures that are over since they were seen, but for those that others hold.
    fn newly_lowered(&mut self) -> Flags {
        let (mut lowered, mut held) = (Flags::NONE, Flags::NONE);
        for it in &mut self.failures {
            let flags = it.mode.rule().signature.always;
            match (it.found, it.over) {
                (true, false) => held = held.union(flags),
                (true, true) if !it.lowered => {
                    it.lowered = true;
                    lowered = lowered.union(flags);
                }
                _ => {}
            }
        }
        lowered.without(held)
    }
}

/// Whether a failure is what the scheduler sees.
fn is_shown(failure: &Failure, seen: Seen) -> bool {
    let of_part = |flag| seen.flags.has(flag) && !seen.part.common(jobs(failure.part)).is_empty();
    match failure.mode {
        FailureMode::Rt1 => seen.flags.has(Flag::MclLate),
        FailureMode::Rt2 => seen.flags.has(Flag::OneLate),
        FailureMode::Rt3 if failure.part.has(Module::Mcl) => seen.flags.has(Flag::MclLate),
        FailureMode::Rt3 => of_part(Flag::ModuleLate),
        FailureMode::Sw1 => of_part(Flag::ModuleSilent),
        _ => false,
    }
}
