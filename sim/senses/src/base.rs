//! The base: what its micro-controller tells in each packet, and what is left of it.

use cotama_core::units::Millis;
use cotama_devices::{Sensed, Stream};
use cotama_models::robots::{Harm, Harmed};
use cotama_observers::{Supply, WheelSettings, Wheels};
use cotama_plane::{Defect, DriveFault, Drivetrain, Rover, Side, Slip};

/// A packet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packet {
    pub(crate) wheels: Wheels,
    pub(crate) stalled: [bool; 2],
    pub(crate) pressed: u16,
    /// Whether the emergency button is.
    pub(crate) is_stopped: bool,
    /// The speed of the wheels, in m/s.
    pub(crate) speed_m_s: f64,
    pub(crate) supply: Supply,
    /// The way that the wheels have gone, in metres.
    pub(crate) way_m: f64,
    /// Whether it is the first one after a new start.
    pub(crate) is_first: bool,
}

/// The micro-controller and its packets.
#[derive(Clone, Debug)]
pub(crate) struct Base {
    pub(crate) settings: WheelSettings,
    /// The resistance of the battery, in Ω, and the acceleration of the wheels, in m/s².
    pub(crate) ohms: f64,
    pub(crate) acceleration: f64,
    noise: Stream,
    /// The turn that the gyro reads, in rad/s.
    pub(crate) gyro: Option<f64>,
    counts: [i64; 2],
    way_m: f64,
    restarts: bool,
    pub(crate) newest: Option<Sensed<Packet>>,
}

/// Levels of the voltage at rest, of 12 V lead-acid batteries: low, and at the end (the manual of
/// a Pioneer 3 warns below 11.5 V and switches off at 11 V).
pub(crate) const LOW_V: f64 = 11.5;
pub(crate) const CRITICAL_V: f64 = 11.0;
/// The resistance of the battery where the robot's file says none, in Ω.
const OHMS: f64 = 0.05;
/// The charge of a battery that is low.
pub(crate) const LOW_CHARGE: f64 = 0.15;
/// The speed above which dry friction is whole, in rad/s (assumed).
const DRY_FROM: f64 = 0.3;

/// Wheels and motors as their observer knows them. Set-points are ramped by the micro-controller,
/// so wheels follow them at once.
fn settings(of: &Drivetrain) -> WheelSettings {
    let known = WheelSettings { lag_s: 0.01, ..WheelSettings::pioneer() };
    let Some(motors) = &of.motors else { return known };
    let force = motors.rolling * motors.mass * 9.806_65;
    WheelSettings {
        viscous: 0.0,
        dry: force / 2.0 * of.wheel / motors.constant,
        dry_from: DRY_FROM,
        acceleration: motors.mass / 2.0 * of.wheel * of.wheel / motors.constant,
        stalled: motors.limit,
        turn: of.wheel / of.axle,
        ..known
    }
}

impl Base {
    pub(crate) fn new(of: &Drivetrain, noise: Stream) -> Self {
        let ohms = of.battery.map_or(OHMS, |it| it.resistance());
        let (counts, way_m) = ([0; 2], 0.0);
        let (settings, acceleration) = (settings(of), of.acceleration);
        let (gyro, restarts, newest) = (None, false, None);
        Self { settings, ohms, acceleration, noise, gyro, counts, way_m, restarts, newest }
    }

    /// Begins anew with the next packet.
    pub(crate) fn restart(&mut self) {
        self.restarts = true;
    }

    /// Reads the wheels after a period in seconds, and sends a packet unless it is lost.
    pub(crate) fn read(&mut self, rover: &Rover<'_>, dt: f64, harms: &[Harmed]) {
        let has = |harm: Harm| harms.iter().find(|it| it.harm == harm);
        let drivetrain = rover.course().drivetrain();
        let signals = rover.signals();
        let commanded = signals.commanded;
        let left = Left::of(harms);
        let encoder = [0, 1].map(|side: usize| {
            let read = commanded[side] * left.turns[side] * left.counts[side];
            // One that is dead reads nothing, and no noise.
            read + self.noise.error() * self.settings.noise[0] * left.counts[side].ceil()
        });
        let motors = signals.motors;
        let current = [0, 1].map(|side: usize| {
            let along = motors.map_or(0.0, |it| it.current_a[side]).copysign(commanded[side]);
            let stands = commanded[side] == 0.0;
            let noise = self.noise.error() * self.settings.noise[1];
            if stands { noise } else { along + noise }
        });
        let counts = rover.vehicle().counts(drivetrain);
        let turn = core::f64::consts::TAU / drivetrain.counts;
        let ways = [0, 1]
            .map(|side: usize| (counts[side] - self.counts[side]) as f64 * turn * drivetrain.wheel);
        self.counts = counts;
        let way_m = f64::midpoint(ways[0], ways[1]).abs();
        self.way_m += way_m;
        let noise = self.noise.error() * 0.01;
        let supply = signals.battery.map_or(Supply { volts: f64::NAN, amperes: 0.0 }, |it| {
            Supply { volts: it.voltage_v + noise, amperes: it.current_a }
        });
        let is_lost = has(Harm::PacketsLossy)
            .is_some_and(|it| self.noise.part() < f64::from(it.permille) / 1_000.0);
        if is_lost || has(Harm::PacketsSilent).is_some() {
            return;
        }
        let touches = rover.is_pressed() && has(Harm::BumperDead).is_none();
        let pressed = u16::from(touches || has(Harm::BumperClosed).is_some());
        let packet = Packet {
            wheels: Wheels { dt, commanded, encoder, current, gyro: self.gyro },
            stalled: motors.map_or([false; 2], |it| it.stalled),
            pressed,
            is_stopped: has(Harm::EmergencyStop).is_some(),
            speed_m_s: way_m / dt,
            supply,
            way_m: self.way_m,
            is_first: core::mem::take(&mut self.restarts),
        };
        self.newest = Some(Sensed { taken: rover.now(), value: packet });
    }

    /// Returns when the newest packet came.
    pub(crate) fn taken(&self) -> Option<Millis> {
        self.newest.map(|it| it.taken)
    }
}

/// The parts that harms leave of the speeds of wheels, and of the counts of encoders.
struct Left {
    turns: [f64; 2],
    counts: [f64; 2],
}

impl Left {
    fn of(harms: &[Harmed]) -> Self {
        let mut left = Self { turns: [1.0; 2], counts: [1.0; 2] };
        for it in harms {
            let (side, rest) = (usize::from(it.unit % 2), 1.0 - part(*it));
            match it.harm {
                Harm::EncoderDead => left.counts[side] = 0.0,
                Harm::EncoderLossy => left.counts[side] = rest,
                Harm::WheelsStall => left.turns = [0.0; 2],
                Harm::MotorWeak => left.turns[side] = rest,
                Harm::MotorDead => left.turns[side] = 0.0,
                _ => {}
            }
        }
        left
    }
}

fn part(it: Harmed) -> f64 {
    f64::from(it.permille.min(1_000)) / 1_000.0
}

/// Returns the faults of the drive that harms make.
pub(crate) fn faults(harms: &[Harmed]) -> Vec<DriveFault> {
    let of = |it: &Harmed| -> Vec<Defect> {
        let side = if it.unit.is_multiple_of(2) { Side::Left } else { Side::Right };
        let (part, rest) = (part(*it), 1.0 - part(*it));
        match it.harm {
            Harm::EncoderDead => vec![Defect::EncoderDead(side)],
            Harm::EncoderLossy => vec![Defect::EncoderLossy(side, part)],
            Harm::WheelSlips => {
                vec![Defect::Slip(Slip { least: part, most: part, patch: None })]
            }
            Harm::WheelsStall => vec![Defect::Jam(Side::Left), Defect::Jam(Side::Right)],
            Harm::MotorWeak => vec![Defect::Weak(side, rest)],
            Harm::MotorDead => vec![Defect::Weak(side, 0.0)],
            Harm::WheelsUnequal => vec![Defect::Worn(side, part)],
            Harm::BatteryCritical => vec![Defect::DeadCell],
            _ => Vec::new(),
        }
    };
    harms.iter().flat_map(of).filter_map(|it| DriveFault::new(it).ok()).collect()
}
