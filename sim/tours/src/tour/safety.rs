//! The return that is kept, on the way.

use super::{After, Rest, Tour};
use crate::leg::{Leg, real_factor, up};
use crate::limits::Limit;
use crate::run::Outcome;
use crate::safe::{Safe, factor};
use cotama_axes::{Activity, Table, What};

impl Tour<'_> {
    /// Asks before some ms more whether the robot could then still be home or done; if not, it
    /// turns round, or hurries to the end.
    pub(super) fn keep_safe(&mut self, leg: &Leg, ms: i64) -> Option<After> {
        let safe = self.safe.as_ref()?;
        if !leg.travels() && leg.done_ms > 0 {
            return None; // a task is begun where all of it is safe
        }
        let ms = if leg.travels() { ms } else { leg.left_ms() };
        let most = |it: &Limit| {
            let used = self.used_in(leg, it.indicator);
            used + leg.most_in(ms, it.indicator, factor(&safe.stated, it.indicator))
        };
        let (objective, x_mm) = (self.objective + usize::from(!leg.travels()), leg.x_mm(ms));
        if self.fits_home(safe, x_mm, &most) || self.fits_ahead(safe, objective, x_mm, &most) {
            return None;
        }
        self.take(leg);
        Some(self.go_safely())
    }

    /// Returns the costs of events that were stated and may still come.
    fn reserve(&self, safe: &Safe, indicator: usize) -> i64 {
        let events = self.course.script.events.iter().zip(&self.happened).filter(|it| *it.1);
        let cost = events.filter_map(|(it, _)| match &it.what {
            What::Costs(costs) => Some(costs.iter().filter(|it| it.0 == indicator).map(|it| it.1)),
            What::Lost(..) => None,
        });
        let stated = safe.stated.costs.iter().filter(|it| it.0 == indicator).map(|it| it.1);
        (stated.sum::<i64>() - cost.flatten().sum::<i64>()).max(0)
    }

    fn fits(
        &self,
        safe: &Safe,
        used: &dyn Fn(&Limit) -> i64,
        rest: &dyn Fn(usize) -> Option<i64>,
    ) -> bool {
        self.limits.iter().all(|it| {
            let Some(most) = it.most() else { return true };
            let whole =
                rest(it.indicator).map(|rest| used(it) + self.reserve(safe, it.indicator) + rest);
            whole.is_some_and(|it| it <= most)
        })
    }

    fn fits_home(&self, safe: &Safe, x_mm: i64, used: &dyn Fn(&Limit) -> i64) -> bool {
        self.fits(safe, used, &|it| Some(safe.back(x_mm, it)))
    }

    fn fits_ahead(
        &self,
        safe: &Safe,
        objective: usize,
        x_mm: i64,
        used: &dyn Fn(&Limit) -> i64,
    ) -> bool {
        self.fits(safe, used, &|it| safe.onward(objective, x_mm, it))
    }

    /// Goes home, or to the end by the cheapest safe options where home is too far; what the leg
    /// used is counted.
    pub(super) fn go_safely(&mut self) -> After {
        let Some(safe) = self.safe.take() else { return After::Ended(Outcome::Stopped) };
        let used = |it: &Limit| self.used.get(it.indicator).copied().unwrap_or(0);
        let goes_home = self.fits_home(&safe, self.x_mm, &used)
            || !self.fits_ahead(&safe, self.objective, self.x_mm, &used);
        if goes_home {
            self.turned = Some((self.t_ms, self.x_mm));
            return After::Ended(self.home(&safe));
        }
        self.hurried = Some((self.t_ms, self.x_mm));
        self.hurry(&safe);
        After::Again
    }

    /// Goes on by the safe options of the rest.
    fn hurry(&mut self, safe: &Safe) {
        let ahead = safe.ahead(self.objective, self.x_mm);
        let (mut activities, mut choices) = (Vec::new(), Vec::new());
        for it in ahead {
            let Some(activity) = safe.table.activities.get(it.activity) else { continue };
            activities.push(from(activity, self.x_mm));
            choices.push(it.choice);
        }
        let table = Table { activities };
        self.rest = Rest { table, choices, before: 0, at: 0 };
    }

    /// Drives back by the safe options.
    fn home(&mut self, safe: &Safe) -> Outcome {
        for stretch in safe.stretches.iter().rev() {
            let Some(activity) = safe.table.activities.get(stretch.activity) else { continue };
            let way = self.x_mm - activity.x_start_mm;
            let Some(candidate) = activity.candidates.get(stretch.choice) else { continue };
            if !activity.travels() || way <= 0 {
                continue;
            }
            if !self.works(&candidate.options) {
                return Outcome::Stopped;
            }
            let length = activity.x_end_mm - activity.x_start_mm;
            for (at, used) in self.used.iter_mut().enumerate() {
                let is_sum = self.mission.indicators.get(at).is_some_and(|it| it.adds_up);
                let factor = real_factor(&self.course.script, at, &activity.zones);
                let real = up(candidate.value(at), factor, 1_000);
                *used += if is_sum { up(real, way, length) } else { 0 };
            }
            self.t_ms += up(way, 1_000, candidate.speed_mm_s);
            self.x_mm = activity.x_start_mm;
            let used = |it: &Limit| self.used.get(it.indicator).copied().unwrap_or(0);
            let spent = self.limits.iter().find(|it| it.most().is_some_and(|most| used(it) > most));
            if let Some(it) = spent {
                return Outcome::Stranded(it.constraint);
            }
        }
        Outcome::Returned
    }
}

/// Returns what is left of an activity from a place on; values are in proportion.
fn from(activity: &Activity, x_mm: i64) -> Activity {
    let mut left = activity.clone();
    let (whole, way) = (
        activity.x_end_mm - activity.x_start_mm,
        activity.x_end_mm - activity.x_start_mm.max(x_mm),
    );
    if whole > 0 && way < whole {
        left.x_start_mm = x_mm;
        for it in left.candidates.iter_mut().flat_map(|it| &mut it.values) {
            *it = it.map(|it| up(it, way, whole));
        }
    }
    left
}
