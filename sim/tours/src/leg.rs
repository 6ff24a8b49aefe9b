//! A part of the way that is driven, or a task for which the robot stands, with one candidate.

use cotama_axes::{Activity, Candidate, Mission, ModelError, Script};

/// An activity under way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Leg {
    pub(crate) options: Vec<usize>,
    pub(crate) zones: Vec<usize>,
    from_mm: i64,
    to_mm: i64,
    lasts_ms: i64,
    pub(crate) done_ms: i64,
    /// Planned values and real ones, each of the whole leg, by indicator; zero where nothing adds
    /// up.
    planned: Vec<i64>,
    real: Vec<i64>,
}

/// Returns the real part of a planned value in some zones, in parts of a thousand.
pub(crate) fn real_factor(script: &Script, indicator: usize, zones: &[usize]) -> i64 {
    let holds = |it: &&ModelError| {
        it.indicator == indicator && it.zone.is_none_or(|it| zones.contains(&it))
    };
    let error: i64 = script.errors.iter().filter(holds).map(|it| it.permille).sum();
    (1_000 + error).max(0)
}

/// Returns a share of a value, rounded down.
fn share(value: i64, part: i64, whole: i64) -> i64 {
    if part >= whole {
        return value;
    }
    (i128::from(value) * i128::from(part)).div_euclid(i128::from(whole)) as i64
}

impl Leg {
    /// The leg of an activity; the real value of an indicator is the planned one times a factor in
    /// parts of a thousand.
    pub(crate) fn new(
        mission: &Mission,
        activity: &Activity,
        candidate: &Candidate,
        factor: impl Fn(usize) -> i64,
    ) -> Self {
        let sums = mission.indicators.iter().enumerate();
        let planned: Vec<_> =
            sums.map(|(at, it)| if it.adds_up { candidate.value(at) } else { 0 }).collect();
        let times = |(at, it): (usize, &i64)| {
            (i128::from(*it) * i128::from(factor(at))).div_euclid(1_000) as i64
        };
        let real = planned.iter().enumerate().map(times);
        Self {
            options: candidate.options.clone(),
            zones: activity.zones.clone(),
            from_mm: activity.x_start_mm,
            to_mm: activity.x_end_mm,
            lasts_ms: lasts_ms(mission, activity, candidate),
            done_ms: 0,
            real: real.collect(),
            planned,
        }
    }

    pub(crate) const fn travels(&self) -> bool {
        self.from_mm < self.to_mm
    }

    pub(crate) const fn left_ms(&self) -> i64 {
        self.lasts_ms - self.done_ms
    }

    /// Returns the place that is reached, or would be after some ms more.
    pub(crate) fn x_mm(&self, more_ms: i64) -> i64 {
        self.from_mm + share(self.to_mm - self.from_mm, self.done_ms + more_ms, self.lasts_ms)
    }

    /// Returns in how many ms a place of the leg is reached.
    pub(crate) fn until_ms(&self, x_mm: i64) -> i64 {
        let (way, whole) = (x_mm - self.from_mm, self.to_mm - self.from_mm);
        if whole <= 0 {
            return self.left_ms();
        }
        let at = (i128::from(way) * i128::from(self.lasts_ms) + i128::from(whole) - 1)
            .div_euclid(i128::from(whole));
        (at as i64 - self.done_ms).clamp(0, self.left_ms())
    }

    /// Returns what was really used so far.
    pub(crate) fn used(&self, indicator: usize) -> i64 {
        let real = self.real.get(indicator).copied().unwrap_or(0);
        share(real, self.done_ms, self.lasts_ms)
    }

    /// Returns what is planned for its rest.
    pub(crate) fn planned_rest(&self, indicator: usize) -> i64 {
        let planned = self.planned.get(indicator).copied().unwrap_or(0);
        planned - share(planned, self.done_ms, self.lasts_ms)
    }

    /// Returns the most that the next ms take, where real values are at most a factor larger than
    /// planned ones.
    pub(crate) fn most_in(&self, ms: i64, indicator: usize, factor: i64) -> i64 {
        let planned = self.planned.get(indicator).copied().unwrap_or(0);
        if self.lasts_ms == 0 {
            return up(planned, factor, 1_000);
        }
        up(up(planned, factor, 1_000), ms, self.lasts_ms) + 1
    }
}

/// Returns a value times a fraction, rounded up.
pub(crate) fn up(value: i64, times: i64, of: i64) -> i64 {
    let whole = i128::from(value) * i128::from(times);
    (-(-whole).div_euclid(i128::from(of.max(1)))) as i64
}

/// Returns how long a candidate takes: its length at its speed, or as long as its leading option
/// stands.
fn lasts_ms(mission: &Mission, activity: &Activity, candidate: &Candidate) -> i64 {
    if activity.travels() {
        let length = activity.x_end_mm - activity.x_start_mm;
        return up(length, 1_000, candidate.speed_mm_s).max(1);
    }
    let mut options = candidate.options.iter().filter_map(|&it| mission.options.get(it));
    let lead = options.find(|it| it.leads());
    lead.and_then(|it| it.attributes.get("stand_ms")).unwrap_or(0).max(0)
}
