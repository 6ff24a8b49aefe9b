//! Hindrances of the robot: it waits at the power of rest, or drives a way that was not planned.
//! Either passes in the periods of the monitor.

use super::World;
use crate::plan::NM_PER_MM;
use crate::record::Recorder;
use crate::setup::Pending;
use cotama_core::units::{MillimetresPerSecond, Milliwatts, mul_div_half_up};
use cotama_models::missions::faults::EventKind;
use cotama_models::missions::tables::Alternative;

/// An event that takes its time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hindrance {
    pending: Pending,
    since_us: u64,
    left: Left,
}

/// The rest of a hindrance.
#[derive(Clone, Copy, Debug)]
enum Left {
    /// So many µs of standing.
    Wait(u64),
    /// So many nm of way, beside the path.
    Way(u64),
}

impl World<'_> {
    /// The robot is held up by an event from now on; not by one that takes no time. The margins are
    /// checked at once, since a way that was not planned is known from now on.
    pub(super) fn hold_up<R: Recorder>(&mut self, pending: Pending, recorder: &mut R) -> bool {
        let left = match pending.kind {
            EventKind::Obstacle { delay } => Left::Wait(delay.0.saturating_mul(1000)),
            EventKind::Odometry { extra } if self.driving().is_some() => {
                Left::Way(extra.0.saturating_mul(NM_PER_MM))
            }
            _ => return false,
        };
        self.hindrance = Some(Hindrance { pending, since_us: self.time_us, left });
        if let Left::Way(_) = left {
            // The way is driven before the activity is done.
            self.done &= !self.travels();
        }
        self.check(recorder);
        true
    }

    /// Nothing holds it up any more.
    pub(super) fn freed<R: Recorder>(&mut self, recorder: &mut R) {
        self.release(recorder);
        if self.travels() {
            self.done = self.x_nm >= self.end_nm();
        }
        self.check(recorder);
        if self.ended.is_none() {
            self.proceed(recorder);
        }
    }

    /// Ends the hindrance, which is over, or ends with the mission.
    pub(super) fn release<R: Recorder>(&mut self, recorder: &mut R) {
        let Some(it) = self.hindrance.take() else { return };
        if R::WANTED {
            recorder.record(self.event_record(&it.pending, 0, self.time_us - it.since_us));
        }
    }

    /// For how many µs it will be held up, if it is.
    pub(super) fn hindered_for(&self) -> Option<u64> {
        Some(match self.hindrance?.left {
            Left::Wait(us) => us,
            Left::Way(nm) => nm.div_ceil(self.driving().map_or(1, |it| it.speed.0)),
        })
    }

    /// So many µs of what holds it up have passed.
    pub(super) fn pass_hindered(&mut self, passed: u64) {
        let speed = self.driving().map_or(1, |it| it.speed.0);
        if let Some(Hindrance { left, .. }) = &mut self.hindrance {
            match left {
                Left::Wait(us) => *us = us.saturating_sub(passed),
                Left::Way(nm) => *nm = nm.saturating_sub(speed.saturating_mul(passed)),
            }
        }
    }

    /// The way, in nm, that is left beside the path.
    pub(super) fn detour_nm(&self) -> u64 {
        match self.hindrance {
            Some(Hindrance { left: Left::Way(nm), .. }) => nm,
            _ => 0,
        }
    }

    /// The cost of a way beside the path of an activity that does not travel itself, in ms and mJ,
    /// as the next one that travels drives.
    pub(super) fn detour_beside(&self) -> [u64; 2] {
        let Some(it) = self.driving().filter(|_| !self.travels()) else { return [0; 2] };
        let ms = mul_div_half_up(self.detour_nm(), 1, it.speed.0.saturating_mul(1000));
        let ms = ms.unwrap_or(u64::MAX);
        [ms, mul_div_half_up(ms, it.power.0, 1000).unwrap_or(u64::MAX)]
    }

    /// Returns the present pace of the robot: its speed and its modelled power.
    pub(super) fn pace(&self) -> (MillimetresPerSecond, Milliwatts) {
        match self.hindrance.map(|it| it.left) {
            None => (self.leg.alternative.speed, self.leg.alternative.power),
            Some(Left::Wait(_)) => (MillimetresPerSecond(0), self.rest_power()),
            Some(Left::Way(_)) => {
                let it = self.driving().unwrap_or(self.leg.alternative);
                (it.speed, it.power)
            }
        }
    }

    /// The real power now, in µW.
    pub(super) fn real_now_uw(&self) -> u64 {
        match self.hindrance {
            None => self.leg.real_uw,
            Some(_) => self.pace().1.0.saturating_mul(self.segments[self.segment].1),
        }
    }

    /// The modelled power of standing with the hardware of the alternative on.
    fn rest_power(&self) -> Milliwatts {
        let mission = self.simulation.mission();
        let standing = mission.motion_power.at(MillimetresPerSecond(0));
        let hardware = mission.power_of(self.leg.alternative.needs);
        Milliwatts(standing.0.saturating_add(hardware.0))
    }

    /// The current activity, or the first one after it that travels, as it is planned.
    fn driving(&self) -> Option<Alternative> {
        let all = self.activity..self.simulation.plannable.activities.len();
        let mut remaining = all.map(|activity| self.planning.chosen(activity));
        remaining.find(|alternative| alternative.speed.0 > 0)
    }
}
