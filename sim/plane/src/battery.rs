//! A battery whose voltage falls with its charge and under a load.

use cotama_models::robots;

/// A battery: a voltage that its charge gives behind an internal resistance (Plett, Battery
/// Management Systems, vol. 1, 2015). Empty, or below its cutoff, it is off for good.
///
/// ```
/// use cotama_models::robots::Robot;
/// use cotama_plane::Battery;
/// let robot = Robot::shipped("p3dx-delivery").unwrap();
/// let mut battery = Battery::of(&robot.body.unwrap().battery.unwrap());
/// assert_eq!((battery.voltage(), battery.charge()), (13.0, 1.0));
/// battery.draw(130.0, 0.01, 0);
/// assert!((12.89..12.9).contains(&battery.voltage())); // 10 A through 10 mΩ
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Battery {
    full: f64,
    empty: f64,
    cutoff: f64,
    resistance: f64,
    cells: f64,
    /// In coulombs.
    capacity: f64,
    /// Invariant: from 0 to the capacity.
    left: f64,
    voltage: f64,
    current: f64,
    energy: f64,
    is_off: bool,
}

impl Battery {
    /// Returns the full battery of a file.
    pub fn of(file: &robots::Battery) -> Self {
        let milli = |it: u64| it as f64 / 1_000.0;
        let capacity = milli(file.capacity_mah) * 3_600.0;
        Self {
            full: milli(file.full_mv),
            empty: milli(file.empty_mv),
            cutoff: milli(file.cutoff_mv),
            resistance: milli(file.resistance_mohm),
            cells: file.cells as f64,
            capacity,
            left: capacity,
            voltage: milli(file.full_mv),
            current: 0.0,
            energy: 0.0,
            is_off: false,
        }
    }

    /// Returns the battery with a part of its charge, from 0 to 1; what is no number is 0.
    #[must_use]
    pub fn charged(self, part: f64) -> Self {
        let part = if part > 0.0 { part.min(1.0) } else { 0.0 };
        let left = self.capacity * part;
        let it = Self { left, ..self };
        Self { voltage: it.open(0), ..it }
    }

    /// Returns the charge, 1 when it is full.
    pub fn charge(&self) -> f64 {
        self.left / self.capacity
    }

    /// Returns the internal resistance, in Ω.
    pub const fn resistance(&self) -> f64 {
        self.resistance
    }

    /// Returns the voltage under its last load, in V.
    pub const fn voltage(&self) -> f64 {
        self.voltage
    }

    /// Returns the current of its last load, in A.
    pub const fn current(&self) -> f64 {
        self.current
    }

    /// Returns the energy that was drawn from it, in J.
    pub const fn energy(&self) -> f64 {
        self.energy
    }

    /// Whether it feeds nothing any more.
    pub const fn is_off(&self) -> bool {
        self.is_off
    }

    /// Draws a power in W for a time in seconds, while so many cells are dead: they give no
    /// voltage.
    ///
    /// The current `i` gives the power `i (e - i r)`, or as much as the battery can, `e² / 4 r`.
    pub fn draw(&mut self, power: f64, time: f64, dead: u8) {
        let open = self.open(dead);
        let power = if self.is_off { 0.0 } else { power.max(0.0) };
        let root = (open * open - 4.0 * self.resistance * power).max(0.0).sqrt();
        let most = open / (2.0 * self.resistance);
        let current = if power > 0.0 { (2.0 * power / (open + root)).min(most) } else { 0.0 };
        // The last charge goes before the time is over.
        let taken = (current * time).min(self.left);
        self.current = if time > 0.0 { taken / time } else { 0.0 };
        self.voltage = open - self.current * self.resistance;
        self.energy += self.voltage * taken;
        self.left -= taken;
        self.is_off |= self.left <= 0.0 || self.voltage < self.cutoff;
        debug_assert!((0.0..=self.capacity).contains(&self.left) && self.energy >= 0.0);
    }

    /// Returns the voltage without a load.
    fn open(&self, dead: u8) -> f64 {
        let cells = (1.0 - f64::from(dead) / self.cells).max(0.0);
        (self.empty + (self.full - self.empty) * self.charge()) * cells
    }
}
