//! The signals of one period, and the observers that look at them.

use crate::body::{Battery, Bumper, Contact, Stall, Supply};
use crate::flag::Flag;
use crate::link::LinkLevel;
use crate::path::{Backward, Coherence, Convergence, Motion, OnPath, Progress};
use crate::pose::{Apart, Poses, Spread};
use crate::sonars::FarSonars;
use crate::status::Items;
use crate::timing::{Age, Deadlines, Interval, Job};
use crate::wheels::{MODES, WheelObserver, Wheels};
use cotama_core::units::Millis;
use cotama_devices::Sensed;

/// The newest signals that a robot has in one period of its observers. One that is `None` has never
/// come, or its port is closed; one that is old is still here, with the time when it was taken.
///
/// | signal | comes |
/// | --- | --- |
/// | `jobs` | each period: the end of the job of each module, `None` where none was due |
/// | `taken` | each period: when the newest datum of each port, and the last heartbeat, was taken |
/// | `values` | each period: readings that have a valid interval |
/// | `sonars` | each sonar after a sweep of its bank: 320 ms, or the period if simulated |
/// | `way_m`, `wheels`, `motion`, `contact`, `supply`, `stalled` | with each packet: 100 ms |
/// | `poses` | with each localisation: 100 ms |
/// | `place`, `is_told_to_move` | with each step of guidance: 100 ms |
/// | `level_dbm` | each 500 ms |
/// | `corrupt` | when a diagnosis says so |
#[derive(Clone, Copy, Debug, Default)]
pub struct Signals<'s> {
    /// The jobs of this period, by module.
    pub jobs: &'s [Option<Job>],
    /// Times at which the newest datum was taken, by port.
    pub taken: &'s [Option<Millis>],
    /// Values that have an interval.
    pub values: &'s [Option<f64>],
    /// Ranges of the sonars, in metres.
    pub sonars: &'s [Option<Sensed<f64>>],
    /// The way that the wheels have gone, ahead or back, in metres.
    pub way_m: Option<f64>,
    /// Wheels and motors.
    pub wheels: Option<Sensed<Wheels>>,
    /// Speeds, as told and as measured.
    pub motion: Option<Sensed<Motion>>,
    /// Bumpers.
    pub contact: Option<Sensed<Contact>>,
    /// Battery.
    pub supply: Option<Sensed<Supply>>,
    /// Bits of stalled motors, left and right.
    pub stalled: Option<Sensed<[bool; 2]>>,
    /// Odometry and localisation.
    pub poses: Option<Sensed<Poses>>,
    /// The place on the path.
    pub place: Option<Sensed<OnPath>>,
    /// Whether the robot is told to move.
    pub is_told_to_move: bool,
    /// Level of the link, in dBm.
    pub level_dbm: Option<Sensed<f64>>,
    /// Data that are known to be corrupt.
    pub corrupt: Items,
}

/// The flags of an observer, as bits by their numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Report {
    /// Flags that are raised.
    pub raised: u16,
    /// Flags whose signal is missing. Invariant: none of these is raised.
    pub missing: u16,
}

impl Report {
    fn of<const N: usize>(flags: [Flag; N]) -> Self {
        let bits = |of: Flag| {
            let all = flags.iter().enumerate().filter(|it| *it.1 == of);
            all.fold(0, |bits, it| bits | 1 << it.0)
        };
        Self { raised: bits(Flag::Raised), missing: bits(Flag::Missing) }
    }
}

/// An observer of the signals of a period.
pub trait Observer {
    /// Looks at the signals. All state is the observer's own, and no memory is taken.
    fn observe(&mut self, now: Millis, signals: &Signals) -> Report;
}

/// An observer of the data port of a number, or of a heartbeat.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Port(pub usize, pub Age);

impl Observer for Port {
    fn observe(&mut self, now: Millis, signals: &Signals) -> Report {
        let taken = signals.taken.get(self.0).copied().flatten();
        Report::of([self.1.observe(now, taken)])
    }
}

/// An observer of the deadlines of the module of a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Module(pub usize, pub Deadlines);

impl Observer for Module {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        let flag = signals.jobs.get(self.0).map_or(Flag::Missing, |it| self.1.observe(*it));
        Report::of([flag])
    }
}

/// An observer of the interval of the value of a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Value(pub usize, pub Interval);

impl Observer for Value {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.1.observe(signals.values.get(self.0).copied().flatten())])
    }
}

impl Observer for FarSonars {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        let flag = signals.way_m.map_or(Flag::Missing, |it| self.observe(signals.sonars, it));
        Report::of([flag])
    }
}

impl Observer for Apart {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.poses)])
    }
}

impl Observer for Spread {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        let covariance = signals.poses.as_ref().map(|it| &it.value.covariance);
        Report::of([Self::observe(self, covariance)])
    }
}

impl Observer for Backward {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.place)])
    }
}

impl Observer for Progress {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.place, signals.is_told_to_move)])
    }
}

impl Observer for Convergence {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.place)])
    }
}

impl Observer for Coherence {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.motion)])
    }
}

/// Flag 0: the link is poor; flag 1: it goes.
impl Observer for LinkLevel {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        let poor = self.observe(signals.level_dbm);
        let goes = if poor == Flag::Missing { poor } else { self.goes() };
        Report::of([poor, goes])
    }
}

/// Flag 0: a bumper is stuck; flag 1: the robot moves though pressed.
impl Observer for Bumper {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of(self.observe(signals.contact))
    }
}

impl Observer for Battery {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.supply)])
    }
}

impl Observer for Stall {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        Report::of([self.observe(signals.stalled)])
    }
}

/// Flag 0: wheels or motors are not sound; each other flag: the fault of that number in [`MODES`],
/// once it is likely enough.
impl Observer for WheelObserver {
    fn observe(&mut self, _: Millis, signals: &Signals) -> Report {
        let flag = self.observe(signals.wheels);
        let mut flags = [if flag == Flag::Missing { flag } else { Flag::Clear }; MODES.len()];
        if flag != Flag::Missing {
            let told = self.diagnosis().map(|it| it.mode);
            let all = flags.iter_mut().zip(MODES);
            all.for_each(|(flag, mode)| *flag = Flag::raised_if(told == Some(mode)));
        }
        flags[0] = flag;
        Report::of(flags)
    }
}

const _: () = assert!(MODES.len() <= u16::BITS as usize);
