//! A round of observers, from the signals of a period to a change of the status vector.

use crate::signals::{Observer, Report, Signals};
use crate::status::{Item, Items, Status, StatusEvent, StatusVector};
use cotama_core::units::Millis;

/// An item of which a flag speaks, and what it says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blame {
    /// The flags of the observer, as bits: any of them counts.
    pub flags: u16,
    /// The item.
    pub item: Item,
    /// The state of the item while such a flag is raised.
    pub raised: Status,
    /// The state of the item while the signal is missing.
    pub missing: Status,
}

impl Blame {
    fn status(self, report: Report) -> Status {
        if self.flags & report.raised != 0 {
            self.raised
        } else if self.flags & report.missing != 0 {
            self.missing
        } else {
            Status::Sound
        }
    }
}

/// An observer at work, and the items of which it speaks.
pub struct Watch<'w> {
    /// The observer.
    pub observer: &'w mut dyn Observer,
    /// The statements of its flags.
    pub blames: &'w [Blame],
}

/// Runs observers over the signals of a period; returns the change of the status vector, if any.
///
/// The state of an item is the worst that is said of it in this period, and lost if its data are
/// corrupt. Nothing is remembered but what observers remember: that a fault is permanent is for the
/// decisional level to say.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_devices::Rate;
/// use cotama_observers::{
///     Age, Blame, FalseAlarms, Item, Items, Needs, Port, Signals, Status, StatusVector, Watch,
///     round,
/// };
/// // Localisation needs the sonars, whose data come each 100 ms, none lost.
/// let [sonars, mcl] = [0, 1].map(|it| Item::new(it).unwrap());
/// let mut vector = StatusVector::new(Needs::of([(mcl, sonars)]));
/// let promise = FalseAlarms::per_hour(0.1).unwrap();
/// let rate = Rate { period: Millis(100), latency: Millis(0) };
/// let mut port = Port(0, Age::new(rate, Millis(0), 0.0, promise).unwrap());
/// let blames =
///     [Blame { flags: 1, item: sonars, raised: Status::Lost, missing: Status::Suspect }];
/// let mut watches = [Watch { observer: &mut port, blames: &blames }];
///
/// let mut at = |now, taken| {
///     let signals = Signals { taken: &[Some(Millis(taken))], ..Signals::default() };
///     round(&mut watches, Millis(now), &signals, &mut vector)
/// };
/// assert!(at(100, 100).is_none());
/// let event = at(300, 100).unwrap();
/// assert_eq!(event.lost, Items::from_iter([sonars, mcl]));
/// assert!(at(400, 100).is_none()); // as before
/// assert_eq!(at(500, 500).unwrap().sound, Items::from_iter([sonars, mcl]));
/// ```
pub fn round(
    watches: &mut [Watch],
    now: Millis,
    signals: &Signals,
    vector: &mut StatusVector,
) -> Option<StatusEvent> {
    let (mut suspect, mut lost) = (Items::NONE, signals.corrupt);
    for Watch { observer, blames } in watches {
        let report = observer.observe(now, signals);
        debug_assert!(report.raised & report.missing == 0, "a missing signal raises nothing");
        for blame in *blames {
            match blame.status(report) {
                Status::Sound => {}
                Status::Suspect => suspect = suspect.and(Items::of(blame.item)),
                Status::Lost => lost = lost.and(Items::of(blame.item)),
            }
        }
    }
    vector.say_all(suspect, lost)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Stall;
    use crate::promise::FalseAlarms;
    use crate::status::Needs;
    use cotama_devices::Sensed;

    fn item(number: u8) -> Item {
        Item::new(number).unwrap()
    }

    fn blame(item: Item, raised: Status, missing: Status) -> Blame {
        Blame { flags: 1, item, raised, missing }
    }

    fn stall() -> Stall {
        Stall::new(Millis(100), 0.0, FalseAlarms::per_hour(1.0).unwrap()).unwrap()
    }

    fn signals(taken: u64, is_stalled: bool) -> Signals<'static> {
        let stalled = Some(Sensed { taken: Millis(taken), value: [is_stalled; 2] });
        Signals { stalled, ..Signals::default() }
    }

    #[test]
    fn a_missing_signal_is_a_cause_of_its_own() {
        let mut vector = StatusVector::new(Needs::none());
        let mut stall = stall();
        let blames = [blame(item(3), Status::Lost, Status::Suspect)];
        let mut watches = [Watch { observer: &mut stall, blames: &blames }];
        let nothing = Signals::default();
        let event = round(&mut watches, Millis(0), &nothing, &mut vector).unwrap();
        assert_eq!((event.suspect, event.lost), (Items::of(item(3)), Items::NONE));
        let event = round(&mut watches, Millis(1), &signals(1, true), &mut vector).unwrap();
        assert_eq!(event.lost, Items::of(item(3)));
    }

    #[test]
    fn the_worst_that_is_said_of_an_item_counts() {
        let mut vector = StatusVector::new(Needs::none());
        let [mut one, mut other] = [stall(), stall()];
        let lost = [blame(item(3), Status::Lost, Status::Sound)];
        let suspect = [blame(item(3), Status::Suspect, Status::Sound)];
        let mut watches = [
            Watch { observer: &mut one, blames: &lost },
            Watch { observer: &mut other, blames: &suspect },
        ];
        round(&mut watches, Millis(1), &signals(1, true), &mut vector);
        assert_eq!(vector.status(item(3)), Status::Lost);
        let event = round(&mut watches, Millis(2), &signals(2, false), &mut vector);
        assert_eq!(event.unwrap().sound, Items::of(item(3)));
    }

    #[test]
    fn corrupt_data_take_what_needs_them() {
        let mut vector = StatusVector::new(Needs::of([(item(1), item(0))]));
        let signals = Signals { corrupt: Items::of(item(0)), ..Signals::default() };
        let event = round(&mut [], Millis(0), &signals, &mut vector).unwrap();
        assert_eq!(event.lost, Items::from_iter([item(0), item(1)]));
        assert!(round(&mut [], Millis(1), &Signals::default(), &mut vector).is_some());
    }
}
