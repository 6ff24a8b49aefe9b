//! Motors, battery and faults of a robot at work, and the signals that they give.

use crate::active::Active;
use crate::battery::Battery;
use crate::drivetrain::Drivetrain;
use crate::fault::DriveFault;
use crate::follower::STEP;
use crate::motors::{Load, Motors};
use crate::vehicle::{Effect, Step};
use cotama_core::units::Millis;
use cotama_devices::SettingsError;
use cotama_floor::Point;

/// Signals of the drive at the end of a period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Signals {
    /// The speeds that the wheels are told, left and right, in rad/s.
    pub commanded: [f64; 2],
    /// The whole counts of the encoders.
    pub counts: [i64; 2],
    /// The motors; `None` of a robot whose file has none.
    pub motors: Option<MotorSignals>,
    /// The battery; `None` of a robot whose file has none.
    pub battery: Option<BatterySignals>,
}

/// Signals of the motors, left and right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorSignals {
    /// Currents in A, without a direction.
    pub current_a: [f64; 2],
    /// Whether a motor was held for as long as its file says.
    pub stalled: [bool; 2],
}

/// Signals of the battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BatterySignals {
    /// The voltage under load.
    pub voltage_v: f64,
    /// The current of all that it feeds, in A.
    pub current_a: f64,
    /// The charge, 1 when it is full.
    pub charge: f64,
    /// The energy that was drawn from it, in J.
    pub energy_j: f64,
    /// Whether it feeds nothing any more: the robot stands.
    pub is_off: bool,
}

/// A wheel that turns less than this part of what it is told is held.
const HELD: f64 = 0.01;
/// The length of a step in ms.
const STEP_MS: u64 = 10;

/// Motors, battery and faults of one robot.
#[derive(Clone, Debug)]
pub(crate) struct Drive {
    motors: Option<Motors>,
    battery: Option<Battery>,
    faults: Vec<Active>,
    load: Load,
    /// The power of hardware, in W.
    hardware: f64,
    /// Cells that are dead in this step.
    dead: u8,
    commanded: [f64; 2],
    current: [f64; 2],
    /// The steps since each wheel is held.
    held: [u64; 2],
    steps: u64,
}

impl Drive {
    pub(crate) fn new(of: &Drivetrain) -> Self {
        let mass = of.motors.map_or(0.0, |it| it.mass);
        let (wheel, axle, radius) = (of.wheel, of.axle, of.footprint.radius());
        Self {
            motors: of.motors,
            battery: of.battery,
            faults: Vec::new(),
            load: Load { mass, radius, wheel, axle },
            hardware: 0.0,
            dead: 0,
            commanded: [0.0; 2],
            current: [0.0; 2],
            held: [0; 2],
            steps: 0,
        }
    }

    pub(crate) fn set_faults(
        &mut self,
        all: &[DriveFault],
        seed: u64,
    ) -> Result<(), SettingsError> {
        self.faults = Active::all(all, seed)?;
        Ok(())
    }

    pub(crate) fn power_hardware(&mut self, watts: f64) {
        self.hardware = watts.max(0.0);
    }

    pub(crate) fn carry(&mut self, payload: f64) {
        self.load.mass = self.motors.map_or(0.0, |it| it.mass) + payload.max(0.0);
    }

    pub(crate) fn charge(&mut self, part: f64) {
        self.battery = self.battery.map(|it| it.charged(part));
    }

    /// Whether there are faults, which may change with each step.
    pub(crate) const fn is_sound(&self) -> bool {
        self.faults.is_empty()
    }

    /// Whether motors get no power any more.
    pub(crate) fn is_off(&self) -> bool {
        self.battery.is_some_and(|it| it.is_off())
    }

    /// Returns what faults and the voltage make of the next step, at a place.
    pub(crate) fn effect(&mut self, at: Point) -> Effect {
        let mut effect = Effect::default();
        self.dead = 0;
        for fault in &mut self.faults {
            fault.act(Millis(self.steps * STEP_MS), at, &mut effect, &mut self.dead);
        }
        if let Some(motors) = &self.motors {
            effect.most = motors.fastest(self.supply(motors), &self.load);
        }
        effect
    }

    /// Takes note of so many steps that were alike.
    pub(crate) fn took(&mut self, step: &Step, steps: u64) {
        let Step { told, turned, gained } = *step;
        self.commanded = told;
        let mut power = self.hardware;
        if let Some(motors) = &self.motors {
            let supply = self.supply(motors);
            let torques = motors.torques(&self.load, turned, [gained.speed, gained.turn]);
            let wheels = told.into_iter().zip(turned).zip(torques);
            let out = self.current.iter_mut().zip(&mut self.held);
            for (((told, turned), torque), (current, held)) in wheels.zip(out) {
                let is_held = turned.abs() < told.abs() * HELD;
                *held = if is_held { *held + steps } else { 0 };
                let (amperes, watts) =
                    if is_held { motors.held(supply) } else { motors.turning(turned, torque) };
                *current = amperes;
                power += watts;
            }
        }
        for _ in 0..steps {
            if let Some(battery) = &mut self.battery {
                battery.draw(power, STEP, self.dead);
            }
        }
        self.steps += steps;
    }

    /// Stands for some steps.
    pub(crate) fn rested(&mut self, at: Point, steps: u64) {
        if self.is_sound() {
            return self.took(&Step::default(), steps);
        }
        for _ in 0..steps {
            self.effect(at);
            self.took(&Step::default(), 1);
        }
    }

    pub(crate) fn signals(&self, counts: [i64; 2]) -> Signals {
        let motors = self.motors.as_ref().map(|it| MotorSignals {
            current_a: self.current,
            stalled: self.held.map(|steps| steps * STEP_MS >= it.stall.0),
        });
        let battery = self.battery.as_ref().map(|it| BatterySignals {
            voltage_v: it.voltage(),
            current_a: it.current(),
            charge: it.charge(),
            energy_j: it.energy(),
            is_off: it.is_off(),
        });
        Signals { commanded: self.commanded, counts, motors, battery }
    }

    /// Returns the voltage of the motors' supply; what they are made for where no battery is known.
    fn supply(&self, motors: &Motors) -> f64 {
        self.battery.map_or(motors.voltage, |it| if it.is_off() { 0.0 } else { it.voltage() })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::float_cmp)] // to the last bit
mod tests {
    use super::*;
    use crate::vehicle::{Command, Vehicle};
    use cotama_floor::{Bounds, Kind, Pose, Segment, Segments};
    use cotama_models::robots::Robot;

    /// A Pioneer 3-DX that drives, told `ahead` m/s, towards a wall 2 m before its centre.
    struct Story {
        of: Drivetrain,
        floor: Segments,
        vehicle: Vehicle,
        drive: Drive,
    }

    impl Story {
        fn of(change: impl FnOnce(&mut Drivetrain)) -> Self {
            let mut of =
                Drivetrain::of(Robot::shipped("p3dx-delivery").unwrap().body.as_ref().unwrap());
            change(&mut of);
            let wall =
                Segment { from: Point::new(2.0, -9.0), to: Point::new(2.0, 9.0), kind: Kind::Wall };
            let bounds = Bounds { least: Point::new(-90.0, -90.0), most: Point::new(90.0, 90.0) };
            let floor = Segments::new(bounds, &[wall], &[]).unwrap();
            let (vehicle, drive) = (Vehicle::new(Pose::identity()), Drive::new(&of));
            Self { of, floor, vehicle, drive }
        }

        /// Drives for some steps of 10 ms.
        fn drive(&mut self, ahead: f64, steps: u64) -> MotorSignals {
            for _ in 0..steps {
                let effect = self.drive.effect(self.vehicle.pose().translation.vector.into());
                let told = Command { speed: ahead, turn: 0.0 };
                let it = self.vehicle.step_under(&self.of, &self.floor, told, STEP, &effect);
                self.drive.took(&it, 1);
            }
            self.drive.signals([0; 2]).motors.unwrap()
        }
    }

    #[test]
    fn motors_of_a_robot_that_a_wall_holds_take_the_limit_and_stall_until_it_backs_off() {
        let mut story = Story::of(|_| ());
        assert_eq!(story.drive(0.3, 500).stalled, [false; 2]); // 1.35 m
        while !story.vehicle.touches() {
            assert_eq!(story.drive(0.3, 1).stalled, [false; 2]);
        }
        let at = *story.vehicle.pose();
        let held = story.drive(0.3, 20);
        assert_eq!((held.stalled, held.current_a), ([true; 2], [8.0; 2]));
        assert!((story.vehicle.pose().translation.x - at.translation.x).abs() < 1e-5);
        assert!(story.drive.battery.unwrap().voltage() < 12.95); // of 13.0 V
        let free = story.drive(-0.3, 20);
        assert!(free.stalled == [false; 2] && free.current_a[0] < 1.0, "{free:?}");
    }

    /// 7.4 N, half on each wheel of 97.5 mm, take 0.37 A of a motor with 12 V over 12.3 rad/s.
    #[test]
    fn a_robot_that_rolls_evenly_takes_the_current_of_rolling_and_more_with_a_payload() {
        let mut story = Story::of(|_| ());
        let current = story.drive(0.3, 300).current_a;
        assert!(current[0] == current[1] && (current[0] - 0.370).abs() < 0.001, "{current:?}");
        story.drive.carry(9.0);
        assert!((story.drive(0.3, 1).current_a[0] - 2.0 * current[0]).abs() < 1e-9);
    }

    /// Less than 13 V over 0.976 Vs, by what falls at the winding.
    #[test]
    fn wheels_turn_no_faster_than_the_voltage_allows() {
        let quick = |it: &mut Drivetrain| (it.speed, it.acceleration) = (99.0, 9.0);
        let mut full = Story::of(quick);
        full.drive(-99.0, 500);
        let most = full.drive.effect(Point::origin()).most;
        assert!((12.8..13.0).contains(&most), "{most}");
        let before = full.vehicle.pose().translation.x;
        full.drive(-99.0, 100);
        let way = before - full.vehicle.pose().translation.x;
        assert!((way - most * 0.0975).abs() < 0.001, "{way}");
        let mut low = Story::of(quick);
        low.drive.charge(0.1);
        assert!(low.drive.effect(Point::origin()).most < most - 1.5);
    }
}
