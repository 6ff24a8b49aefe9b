//! Bumpers, the battery and stalled motors, as the micro-controller tells them.

use crate::flag::Flag;
use crate::newest::Newest;
use crate::promise::{FalseAlarms, Run};
use crate::quantile::normal_quantile;
use crate::spell::{Spell, Tail};
use cotama_core::units::Millis;
use cotama_devices::{Sensed, SettingsError, within};

/// The bumpers, and what speaks for or against a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The segments that are pressed, as bits.
    pub pressed: u16,
    /// The way that the wheels have gone, in metres, ahead or back.
    pub way_m: f64,
    /// The distance from the bumper to the nearest thing that the ranges show, in metres; `None`
    /// if there are no ranges.
    pub free_m: Option<f64>,
}

/// An observer of whether contacts are plausible.
///
/// *Assumption.* Contacts with things that the ranges do not show have a [`Tail`] of durations, in
/// seconds. After a contact the robot brakes, and goes on by at most v t + v² / 2a, read with a
/// normal error: its speed v, the latency t of the switch, its deceleration a.
///
/// *Threshold.* A contact is *stuck* if it lasts longer, with free room ahead, than the tail does
/// as seldom as promised. The robot *moves though pressed* if it goes on by more than its braking
/// way and zσ.
#[derive(Clone, Debug, PartialEq)]
pub struct Bumper {
    room_m: f64,
    stuck: Spell,
    moved: Spell,
    last: Option<Sensed<Contact>>,
}

/// The braking of a robot that touches something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Braking {
    /// The highest speed, in m/s.
    pub speed: f64,
    /// The deceleration, in m/s².
    pub deceleration: f64,
    /// The time from contact to braking, in seconds.
    pub latency: f64,
    /// The deviation of a way over that distance, in metres.
    pub deviation: f64,
}

impl Bumper {
    /// An observer that expects nothing to touch if there is more room than this, in metres.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        tail: Tail,
        room_m: f64,
        braking: Braking,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        let Braking { speed, deceleration, latency, deviation } = braking;
        within("the room in m", room_m, 0.0, 100.0)?;
        within("the speed in m/s", speed, 0.0, 100.0)?;
        within("the deceleration in m/s²", deceleration, 1e-3, 100.0)?;
        within("the latency in s", latency, 0.0, 10.0)?;
        within("the deviation of a way in m", deviation, 0.0, 10.0)?;
        let z = normal_quantile(promise.per_decision(period));
        let way = speed * latency + speed * speed / (2.0 * deceleration) + z * deviation;
        let stuck = Spell::new(tail.limit(promise));
        Ok(Self { room_m, stuck, moved: Spell::new(way), last: None })
    }

    /// Looks at the bumpers; says first whether they are stuck, then whether the robot moves though
    /// pressed.
    pub fn observe(&mut self, contact: Option<Sensed<Contact>>) -> [Flag; 2] {
        let Some(now) = contact.filter(|it| it.value.way_m.is_finite()) else {
            return [Flag::Missing; 2];
        };
        let last = *self.last.get_or_insert(now);
        if now.value.pressed == 0 {
            self.moved.ends();
        } else if last.value.pressed != 0 {
            self.moved.goes_on(now.value.way_m - last.value.way_m);
        }
        let is_free = now.value.free_m.map(|it| it > self.room_m);
        if now.value.pressed == 0 || is_free == Some(false) {
            self.stuck.ends();
        } else if is_free == Some(true) {
            self.stuck.goes_on(now.taken.0.saturating_sub(last.taken.0) as f64 / 1_000.0);
        }
        self.last = Some(now);
        let stuck = Flag::raised_if(self.stuck.is_long());
        let stuck = if is_free.is_none() { Flag::Missing } else { stuck };
        [stuck, Flag::raised_if(self.moved.is_long())]
    }
}

/// Voltage and current of a battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Supply {
    /// The voltage, in V.
    pub volts: f64,
    /// The current that is drawn, in A.
    pub amperes: f64,
}

/// An observer of a battery that is below a level for a time.
///
/// *Assumption.* Under load the voltage falls by R I (Rint model: He, Xiong, Fan, Energies 4(4),
/// 2011); V + R I is the voltage at rest, with independent errors that are as often above as below.
///
/// *Threshold.* A battery whose voltage at rest is just at the level is below it in half of the
/// readings: k in a row, the least with 1/2ᵏ⁺¹ at most the chance of a decision. A battery above
/// the level makes alarms rarer than that.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Sensed;
/// use cotama_observers::{Battery, FalseAlarms, Flag, Supply};
/// let promise = FalseAlarms::per_hour(0.36).unwrap();
/// let mut low = Battery::new(11.5, 0.05, Millis(100), promise).unwrap();
/// assert_eq!(low.readings(), 16); // 1.6 s
/// // 11.3 V under 6 A is 11.6 V at rest; under 2 A it is not.
/// let mut last = |amperes, from: u64| {
///     let value = Supply { volts: 11.3, amperes };
///     let read = |it| Some(Sensed { taken: Millis(it * 100), value });
///     (from..from + 16).map(|it| low.observe(read(it))).last().unwrap()
/// };
/// assert_eq!([last(6.0, 0), last(2.0, 16)], [Flag::Clear, Flag::Raised]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Battery {
    level: f64,
    ohms: f64,
    newest: Newest,
    run: Run,
}

impl Battery {
    /// An observer of a level in V, with the resistance of the battery in Ω.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(
        level: f64,
        ohms: f64,
        period: Millis,
        promise: FalseAlarms,
    ) -> Result<Self, SettingsError> {
        within("the level in V", level, 0.0, 1_000.0)?;
        within("the resistance in Ω", ohms, 0.0, 100.0)?;
        within("a period in ms", period.0 as f64, 1.0, 600_000.0)?;
        let run = Run::new(0.5, promise.per_decision(period));
        Ok(Self { level, ohms, newest: Newest::default(), run })
    }

    /// Returns how many readings in a row raise the flag.
    pub const fn readings(&self) -> u32 {
        self.run.most()
    }

    /// Looks at the newest reading; one that was seen before counts once.
    pub fn observe(&mut self, supply: Option<Sensed<Supply>>) -> Flag {
        let Some(Sensed { taken, value }) = supply else { return Flag::Missing };
        let at_rest = value.volts + self.ohms * value.amperes;
        if !at_rest.is_finite() {
            return Flag::Missing;
        }
        if self.newest.is_new(taken) {
            self.run.add(at_rest < self.level);
        }
        Flag::raised_if(self.run.is_long())
    }
}

/// An observer of the bits that say that motors are stalled.
///
/// *Assumption.* Of a sound motor, a bit is set in a packet with the chance q, independently.
/// *Threshold.* k packets in a row, the least with (1 - q)qᵏ at most the chance of a decision.
#[derive(Clone, Debug, PartialEq)]
pub struct Stall {
    newest: Newest,
    run: Run,
}

impl Stall {
    /// An observer of packets of a period, with the chance that a bit is set though all is sound.
    ///
    /// # Errors
    /// Numbers that are out of range.
    pub fn new(period: Millis, set: f64, promise: FalseAlarms) -> Result<Self, SettingsError> {
        within("a period in ms", period.0 as f64, 1.0, 600_000.0)?;
        within("the chance that a bit is set", set, 0.0, 0.99)?;
        let run = Run::new(set, promise.per_decision(period));
        Ok(Self { newest: Newest::default(), run })
    }

    /// Looks at the bits of the newest packet, left and right; one seen before counts once.
    pub fn observe(&mut self, stalled: Option<Sensed<[bool; 2]>>) -> Flag {
        let Some(Sensed { taken, value: [left, right] }) = stalled else { return Flag::Missing };
        if self.newest.is_new(taken) {
            self.run.add(left || right);
        }
        Flag::raised_if(self.run.is_long())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measured::{Measured, normal};
    use cotama_devices::Streams;

    fn promise(per_hour: f64) -> FalseAlarms {
        FalseAlarms::per_hour(per_hour).unwrap()
    }

    /// 3 cm of latency, 15 cm of braking.
    const BRAKING: Braking =
        Braking { speed: 0.3, deceleration: 0.3, latency: 0.1, deviation: 0.002 };

    fn bumper() -> Bumper {
        let tail = Tail::new(1.0, 0.1, 1.0).unwrap();
        Bumper::new(tail, 0.3, BRAKING, Millis(100), promise(0.1)).unwrap()
    }

    fn contact(now: u64, pressed: u16, way_m: f64, free_m: f64) -> Option<Sensed<Contact>> {
        let value = Contact { pressed, way_m, free_m: Some(free_m) };
        Some(Sensed { taken: Millis(now), value })
    }

    #[test]
    fn a_battery_at_its_level_alarms_as_often_as_promised() {
        let mut noise = Streams::new(8).stream("volts");
        let often = promise(360.0);
        let mut battery = Battery::new(11.5, 0.05, Millis(100), often).unwrap();
        let mut measured = Measured::of(often.per_decision(Millis(100)));
        for taken in (0..200_000).map(Millis) {
            let amperes = 3.0 + normal(&mut noise);
            let volts = 11.5 - 0.05 * amperes + 0.1 * normal(&mut noise);
            measured
                .period(battery.observe(Some(Sensed { taken, value: Supply { volts, amperes } })));
        }
        measured.is_as_computed("battery", 1.0 / 128.0); // k = 6
    }

    #[test]
    fn stall_bits_alarm_as_often_as_promised() {
        let mut luck = Streams::new(8).stream("bits");
        let often = promise(360.0);
        let mut stall = Stall::new(Millis(100), 0.2, often).unwrap();
        let mut measured = Measured::of(often.per_decision(Millis(100)));
        for taken in (0..200_000).map(Millis) {
            let value = [luck.part() < 0.2, false];
            measured.period(stall.observe(Some(Sensed { taken, value })));
        }
        measured.is_as_computed("stall", 0.8 * 0.008);
    }

    #[test]
    fn a_packet_that_was_seen_counts_once() {
        let mut stall = Stall::new(Millis(100), 0.2, promise(360.0)).unwrap();
        let mut battery = Battery::new(11.5, 0.05, Millis(100), promise(360.0)).unwrap();
        let low = Supply { volts: 9.0, amperes: 0.0 };
        for _ in 0..100 {
            let bits = Sensed { taken: Millis(7), value: [false, true] };
            assert_eq!(stall.observe(Some(bits)), Flag::Clear);
            let low = Sensed { taken: Millis(7), value: low };
            assert_eq!(battery.observe(Some(low)), Flag::Clear);
        }
        assert_eq!((stall.observe(None), battery.observe(None)), (Flag::Missing, Flag::Missing));
    }

    #[test]
    fn braking_ways_alarm_as_often_as_promised() {
        let mut noise = Streams::new(8).stream("way");
        let often = promise(360.0);
        let tail = Tail::new(1.0, 0.1, 1.0).unwrap();
        let mut measured = Measured::of(often.per_decision(Millis(100)));
        for _ in 0..100_000 {
            let mut bumper = Bumper::new(tail, 0.3, BRAKING, Millis(100), often).unwrap();
            bumper.observe(contact(0, 1, 0.0, 0.0));
            // Contact at full speed: the whole way of braking.
            let way = 0.18 + 0.002 * normal(&mut noise);
            measured.decision(bumper.observe(contact(1_100, 1, way, 0.0))[1]);
        }
        measured.is_as_promised("moves though pressed");
    }

    #[test]
    fn a_contact_with_free_room_is_stuck_after_its_limit() {
        let mut bumper = bumper();
        let flags: Vec<_> =
            (0..30).map(|it| bumper.observe(contact(it * 100, 4, 0.0, 2.0))[0]).collect();
        // 1 s and nothing more, as there are no more such contacts than alarms are promised.
        assert_eq!(flags.iter().position(|it| *it == Flag::Raised), Some(11));
        assert_eq!(bumper.observe(contact(3_000, 4, 0.0, 0.1))[0], Flag::Clear);
    }

    #[test]
    fn a_contact_without_ranges_is_not_called_stuck() {
        let mut bumper = bumper();
        for it in 0..100 {
            let value = Contact { pressed: 1, way_m: 0.0, free_m: None };
            let flags = bumper.observe(Some(Sensed { taken: Millis(it * 100), value }));
            assert_eq!(flags, [Flag::Missing, Flag::Clear]);
        }
        assert_eq!(bumper.observe(None), [Flag::Missing; 2]);
    }

    #[test]
    fn a_robot_that_moves_on_though_pressed_is_raised() {
        let mut bumper = bumper();
        let moved = |bumper: &mut Bumper, way| bumper.observe(contact(100, 1, way, 0.0))[1];
        assert_eq!(bumper.observe(contact(0, 0, 5.0, 0.0))[1], Flag::Clear);
        assert_eq!(moved(&mut bumper, 6.0), Flag::Clear); // pressed at the end of this way
        assert_eq!(moved(&mut bumper, 6.15), Flag::Clear);
        assert_eq!(moved(&mut bumper, 6.25), Flag::Raised);
    }
}
