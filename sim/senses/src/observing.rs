//! The observers of a robot, and the flags that they raise.

use crate::base::{Base, CRITICAL_V, LOW_V};
use crate::bench::Bench;
use crate::modules::Jobs;
use crate::sonars::short;
use crate::watching::Raised;
use cotama_core::units::Millis;
use cotama_devices::{Rate, Sensed, SettingsError};
use cotama_models::robots::{Observer, Robot, Watch};
use cotama_observers::{
    Age, Apart, Backward, Battery, Braking, Bumper, Contact, Convergence, Deadlines, FalseAlarms,
    FarSonars, Flag, Frozen, Job, LinkLevel, Mode, OdometryErrors, OnPath, Outliers, Poses,
    Progress, Runaway, Spread, Stall, WheelObserver, WheelRates,
};

/// False alarms per hour of each flag (assumed: one in 100 hours).
pub(crate) const PER_HOUR: f64 = 0.01;
/// The noise of a range, in metres.
const NOISE_M: f64 = 0.02;
/// The room ahead in which bumpers are not to be pressed, in metres.
const ROOM_M: f64 = 0.5;

/// Signals of a period, of which all flags are made.
pub(crate) struct Period<'s> {
    pub(crate) now: Millis,
    pub(crate) ranges: Option<&'s [Option<Sensed<f64>>]>,
    pub(crate) base: &'s Base,
    pub(crate) poses: Option<Sensed<Poses>>,
    /// The place on the path, where the robot follows it by itself.
    pub(crate) place: Option<OnPath>,
    pub(crate) is_told_to_move: bool,
    pub(crate) level_dbm: Option<Sensed<f64>>,
    /// Times at which the newest sign of the operator's station came, and the newest image; and at
    /// which that image was taken.
    pub(crate) heard: Option<Millis>,
    pub(crate) image: Option<(Millis, Millis)>,
    pub(crate) free_m: f64,
    pub(crate) is_packet_lost: bool,
    pub(crate) jobs: &'s Jobs,
    /// The speed that the motors were told, in m/s.
    pub(crate) told_m_s: f64,
    pub(crate) has_no_plan: bool,
    pub(crate) devices: Raised,
}

/// The observers.
#[derive(Clone, Debug)]
pub(crate) struct Observing {
    /// The flags of the robot, a bit each, with what they watch.
    watches: Vec<(u64, Watch)>,
    far: FarSonars,
    near: FarSonars,
    ranges: Age,
    wheels: WheelObserver,
    /// Windows of 0.1, 1, 5, 10 and 60 s.
    apart: [Apart; 5],
    spread: Spread,
    backward: Backward,
    convergence: Convergence,
    progress: Progress,
    level: LinkLevel,
    heard: Age,
    bumper: Bumper,
    stall: Stall,
    batteries: [Battery; 2],
    packets: Age,
    errors: Deadlines,
    /// The packets that were lost since the last one that came.
    lost: u32,
    frozen: Frozen,
    images: Age,
    old: Age,
    outliers: Outliers,
    runaway: Runaway,
}

impl Observing {
    pub(crate) fn new(robot: &Robot, bench: &Bench, base: &Base) -> Result<Self, SettingsError> {
        let promise = FalseAlarms::per_hour(PER_HOUR)?;
        let period = Millis(100);
        let of = |it: &Observer| -> Vec<Option<Watch>> {
            (0..it.flags.len()).map(|at| it.watches.get(at).copied().flatten()).collect()
        };
        let watches = robot.observers.iter().flat_map(of).enumerate();
        let watches = watches.filter_map(|(flag, it)| Some((1 << flag, it?)));
        let rate = |latency: u64| Rate { period, latency: Millis(latency) };
        let apart = |window: u64| {
            // The sonars of the ring leave localisation a few centimetres and degrees unsure,
            // which counts less and less the longer the window is.
            let errors = match window {
                60_000.. => OdometryErrors::pioneer(),
                _ => OdometryErrors { way: 0.05, drift: 0.03, turn: 0.06 },
            };
            Apart::new(errors, Millis(window), promise)
        };
        let braking = Braking { speed: 0.3, deceleration: 0.3, latency: 0.2, deviation: 0.02 };
        Ok(Self {
            watches: watches.collect(),
            far: FarSonars::new(&bench.far, 16, promise)?,
            near: FarSonars::new(&bench.near, 16, promise)?,
            ranges: Age::new(rate(100), Millis(10), 0.05, promise)?,
            wheels: WheelObserver::new(base.settings, WheelRates::rare(PER_HOUR)?)?,
            apart: [apart(100)?, apart(1_000)?, apart(5_000)?, apart(10_000)?, apart(60_000)?],
            spread: Spread::new([0.5, 0.35], 100, period, promise)?,
            backward: Backward::new(bench.behind, 0.1, period, promise)?,
            convergence: Convergence::new(Millis(3_000), Millis(2_000), 0.1, promise)?,
            progress: Progress::new(bench.waits, 0.05, promise)?,
            level: LinkLevel::new(-82.0, 4.0, 10, [Millis(500), Millis(5_000)], promise)?,
            heard: Age::new(rate(50), Millis(50), 0.3, promise)?,
            bumper: Bumper::new(bench.behind, ROOM_M, braking, period, promise)?,
            stall: Stall::new(period, 0.001, promise)?,
            batteries: [
                Battery::new(LOW_V, base.ohms, period, promise)?,
                Battery::new(CRITICAL_V, base.ohms, period, promise)?,
            ],
            packets: Age::new(rate(0), Millis(20), 0.02, promise)?,
            errors: Deadlines::new(period, 0.001, promise)?,
            lost: 0,
            frozen: Frozen::new(NOISE_M, period, promise.shared_by(16))?,
            images: Age::new(rate(200), Millis(50), 0.3, promise)?,
            old: Age::new(rate(400), Millis(100), 0.3, promise)?,
            outliers: Outliers::new(bench.jumps, promise),
            runaway: Runaway::new(base.acceleration, 0.02, period, promise)?,
        })
    }

    /// A path, or a way of knowing the pose, begins: what was seen before says nothing of it.
    pub(crate) fn restart(&mut self) {
        self.backward.restart();
        self.convergence.restart();
        self.progress.restart();
    }

    /// Packets that were lost show themselves when the next one comes: before, none comes.
    fn lost(&mut self, is_lost: bool) -> Flag {
        if is_lost {
            self.lost += 1;
            return Flag::Missing;
        }
        let lost = core::mem::take(&mut self.lost);
        let flags = (0..lost).map(|_| self.errors.observe(Some(Job::Missed)));
        let flag = flags.last().unwrap_or(Flag::Clear);
        self.errors.observe(Some(Job::Kept));
        flag
    }

    /// Returns the flags that are up, a bit each.
    pub(crate) fn look(&mut self, it: &Period<'_>) -> u64 {
        let packet = it.base.newest;
        let none: &[Option<Sensed<f64>>] = &[];
        let ranges = it.ranges.unwrap_or(none);
        let way_m = packet.map_or(0.0, |it| it.value.way_m);
        let far = self.far.observe(ranges, way_m);
        let mut shorts = [None; 16];
        for (short_one, range) in shorts.iter_mut().zip(ranges) {
            *short_one = range.map(short);
        }
        let near = self.near.observe(&shorts, way_m);
        let frozen = self.frozen.observe(ranges);
        let taken = ranges.iter().flatten().map(|it| it.taken).max();
        let no_ranges = self.ranges.observe(it.now, taken);
        let wheels = packet.map(|it| Sensed { taken: it.taken, value: it.value.wheels });
        let wheels = self.wheels.observe(wheels);
        let told = (wheels == Flag::Raised).then(|| self.wheels.diagnosis()).flatten();
        let told = told.map(|it| it.mode);
        let apart = {
            let poses = it.poses;
            self.apart.each_mut().map(|it| it.observe(poses))
        };
        let spread = self.spread.observe(it.poses.as_ref().map(|it| &it.value.covariance));
        let place = it.place.map(|value| Sensed { taken: it.now, value });
        let backward = self.backward.observe(place);
        let off = self.convergence.observe(place);
        let waits = self.progress.observe(place, it.is_told_to_move);
        let low = self.level.observe(it.level_dbm);
        let silent = self.heard.observe(it.now, it.heard);
        let contact = packet.map(|packet| {
            let Sensed { taken, value } = packet;
            let free_m = (taken == it.now).then_some(it.free_m);
            Sensed { taken, value: Contact { pressed: value.pressed, way_m: value.way_m, free_m } }
        });
        let [alone, _] = self.bumper.observe(contact);
        let stalled = packet.map(|it| Sensed { taken: it.taken, value: it.value.stalled });
        let stall = self.stall.observe(stalled);
        let supply = packet.map(|it| Sensed { taken: it.taken, value: it.value.supply });
        let voltages = self.batteries.each_mut().map(|it| it.observe(supply));
        let silence = self.packets.observe(it.now, it.base.taken());
        let errors = self.lost(it.is_packet_lost);
        let images = self.images.observe(it.now, it.image.map(|it| it.0));
        let old = self.old.observe(it.now, it.image.map(|it| it.1));
        let outliers = self.outliers.observe(ranges);
        let speeds = packet.map(|packet| {
            let Sensed { taken, value } = packet;
            Sensed { taken, value: [it.told_m_s, value.speed_m_s] }
        });
        let runaway = self.runaway.observe(speeds);
        let up = |watch: Watch| -> bool {
            let raised = |it: Flag| it == Flag::Raised;
            match watch {
                Watch::LargestRange => raised(far),
                Watch::ShortestRange => raised(near) || raised(frozen),
                Watch::NoRanges => raised(no_ranges),
                Watch::Encoders => {
                    matches!(told, Some(Mode::EncoderDead(_) | Mode::EncoderLossy(_)))
                }
                Watch::Slip => told == Some(Mode::Slip),
                Watch::NoTorque => matches!(told, Some(Mode::Blocked(_))),
                Watch::WeakTorque => matches!(told, Some(Mode::MotorWeak(_))),
                Watch::PoseJumps => raised(apart[0]),
                Watch::PosePeak => raised(apart[1]),
                Watch::PoseGrows => raised(apart[2]),
                Watch::PoseApart => raised(apart[3]),
                Watch::PoseSpread => raised(spread),
                Watch::Backward => raised(backward),
                Watch::OffPath => raised(off),
                Watch::NoProgress => raised(waits),
                Watch::LinkLow => raised(low),
                Watch::LinkSilent => raised(silent),
                Watch::Bumper => packet.is_some_and(|it| it.value.pressed != 0),
                Watch::BumperAlone => raised(alone),
                Watch::Stall => raised(stall),
                Watch::VoltageLow => raised(voltages[0]),
                Watch::VoltageCritical => raised(voltages[1]),
                Watch::PacketSilence => raised(silence),
                Watch::PacketErrors => raised(errors),
                Watch::PacketRestart => packet.is_some_and(|it| it.value.is_first),
                Watch::NoImage => raised(images),
                Watch::OldImage => raised(old) && !raised(images),
                Watch::RangeOutliers => raised(outliers),
                Watch::PoseDrifts => raised(apart[4]),
                Watch::Runaway => raised(runaway),
                Watch::EmergencyStop => packet.is_some_and(|it| it.value.is_stopped),
                Watch::PlanFailed => it.has_no_plan,
                Watch::JobLate
                | Watch::LocalisationLate
                | Watch::ModuleLate
                | Watch::ModuleSilent
                | Watch::ValueOutside => it.jobs.shows(watch),
                other => it.devices.is_up(other),
            }
        };
        self.watches.iter().filter(|it| up(it.1)).fold(0, |set, it| set | it.0)
    }
}
