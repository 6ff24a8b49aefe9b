//! Speed and power of what is driven: the planned alternative, or the one of the configuration that
//! runs.

use super::{Planning, add};
use cotama_core::monitor::MAX_AMOUNT;
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::missions::tables::Alternative;

impl Planning<'_> {
    /// Returns the pace of an activity in a configuration: speed and power; that of the planned
    /// alternative when none has it.
    pub(crate) fn pace(
        &self,
        activity: usize,
        configuration: Option<usize>,
    ) -> (MillimetresPerSecond, Milliwatts) {
        let alternative = self.driven(activity, configuration);
        (alternative.speed, alternative.power)
    }

    /// Returns the power of standing in a configuration, with its hardware on.
    pub(crate) fn rest_power(&self, activity: usize, configuration: Option<usize>) -> Milliwatts {
        let mission = self.of.mission;
        let standing = mission.motion_power.at(MillimetresPerSecond(0));
        let hardware = mission.power_of(self.driven(activity, configuration).needs);
        Milliwatts(standing.0.saturating_add(hardware.0))
    }

    pub(super) fn driven(&self, activity: usize, configuration: Option<usize>) -> Alternative {
        self.alternatives(activity)[self.driven_id(activity, configuration)]
    }

    /// Returns the alternative of an activity that a configuration is; the planned one when none.
    pub(super) fn driven_id(&self, activity: usize, configuration: Option<usize>) -> usize {
        let all = &self.of.configurations[activity];
        let with = all.iter().position(|it| it.is_some() && *it == configuration);
        with.unwrap_or_else(|| usize::from(self.choice[activity]))
    }

    /// Returns how much more (ms, mJ) the rest of the plan in force costs where its configurations
    /// go no faster than this: `left` is the rest of the first activity.
    pub(crate) fn slower(
        &self,
        first: usize,
        left: Millimetres,
        allowed: impl Fn(usize) -> MillimetresPerSecond,
    ) -> [u64; 2] {
        let more = |activity: usize| {
            let (table, planned) = (&self.of.activities[activity], self.chosen(activity));
            let id = usize::from(self.choice[activity]);
            let speed = allowed(self.of.configurations[activity][id]?);
            if speed.0 == 0 || speed >= planned.speed {
                return None;
            }
            let whole = Millimetres(table.x_end.0.saturating_sub(table.x_start.0));
            let way = if activity == first { left } else { whole };
            let time = |speed: MillimetresPerSecond| way.0.saturating_mul(1_000).div_ceil(speed.0);
            let more = Millis(time(speed).saturating_sub(time(planned.speed)));
            Some([more.0, Millijoules::spent(planned.power, more).map_or(MAX_AMOUNT, |it| it.0)])
        };
        (first..self.choice.len()).filter_map(more).fold([0; 2], add)
    }
}
