//! A charger for a lithium-ion battery.
//!
//! The textbook procedure: a deeply discharged cell is *precharged* with a small current until it
//! has recovered, then charged with *constant current* until it reaches its final voltage, then at
//! *constant voltage* until the current has tapered off. Each phase has a safety timer, and heat
//! ends the charging. The times are plausible for a robot's battery and assumed; the data sheet of
//! the cell has the true ones.
//!
//! What to learn from it:
//!
//! - `Removed` can come at any time: a group (`Plugged`) makes one line of five transitions.
//! - `on` is the pin of the power switch. It could be told from the state, and that is the point:
//!   the invariant `on & Idle & Done & Fault = 1` says that power flows exactly in the three phases
//!   of charging, so a transition that forgets to switch is a compile error; and `never_both(on,
//!   hot)` is the law of safety, in one line.
//! - `taper` waits for an event *and* ten seconds: the current is not looked at before the voltage
//!   has settled. An earlier event is refused as too early, not remembered.
//! - Timers restart with their phase, as their transitions become enabled anew.
//!
//! ```
//! use cotama_core::{player::Outcome, player::Why, units::Millis};
//! use cotama_models::nets::charger::{Event, Place, Player, State, Transition};
//!
//! let minutes = |it: u64| Millis(it * 60_000);
//! let mut charger = Player::new();
//! for (at, event) in [(0, Event::Inserted), (5, Event::Recovered), (90, Event::Reached)] {
//!     assert!(charger.offer(minutes(at), &event).fired());
//! }
//! assert_eq!((charger.state(), charger.tokens(Place::on)), (State::Voltage, 1));
//! let early = charger.offer(minutes(90), &Event::Tapered);
//! assert_eq!(early, Outcome::Ignored { why: Why::TooEarly(Transition::taper) });
//!
//! // The battery never tapers off: two hours after the phase began the timer ends it.
//! assert_eq!(charger.wake_at(), Some(minutes(210)));
//! assert_eq!(charger.advance(minutes(300)).fired, 1);
//! assert_eq!((charger.state(), charger.tokens(Place::on)), (State::Fault, 0));
//! ```

pub use self::charger::*;

cotama_core::net! {
    /// A charger for a lithium-ion battery: precharge, constant current, constant voltage, with
    /// timers and heat.
    mod charger {
        places {
            /// No battery is in.
            Idle: 1,
            /// A small current, until the cell has recovered.
            Precharge,
            /// Constant current, until the cell has its final voltage.
            Current,
            /// Constant voltage, until the current has tapered off.
            Voltage,
            /// The battery is full.
            Done,
            /// Charging was given up; the battery is to be removed.
            Fault,
        }
        flags {
            /// The power switch.
            on,
            /// The battery bay is too hot.
            hot,
        }
        events {
            /// A battery was put in.
            Inserted,
            /// The battery was taken out.
            Removed,
            /// The cell has the voltage at which it takes the full current.
            Recovered,
            /// The cell has its final voltage.
            Reached,
            /// The current has fallen below a tenth of the full one.
            Tapered,
            /// A full battery has discharged itself.
            Sagged,
            /// The bay is too hot.
            Overheated,
            /// The bay has cooled down.
            Cooled,
        }
        outputs {
            /// Switch on, with a small current.
            Trickle,
            /// Full current.
            FullCurrent,
            /// Constant voltage.
            HoldVoltage,
            /// Switch off.
            Off,
            /// Tell somebody.
            Alarm,
        }
        groups {
            Charging: Precharge & Current & Voltage;
            Unpowered: Idle & Done & Fault;
            Finished: Done & Fault;
        }
        transitions {
            insert  on Inserted [!hot & !on]: Idle => Precharge do on = true emit Trickle;
            /// Nothing is charged in the heat.
            refuse  on Inserted [hot]: Idle => Fault emit Alarm;
            recover on Recovered: Precharge => Current emit FullCurrent;
            reach   on Reached:   Current => Voltage emit HoldVoltage;
            taper   on Tapered [on]: Voltage => Done do on = false emit Off after 10_000 ms;
            top_up  on Sagged [!hot & !on]: Done => Current do on = true emit FullCurrent;

            precharge_timer [on]:
                Precharge => Fault do on = false emit Off & Alarm within 1_800_000..=1_800_000 ms;
            current_timer   [on]:
                Current => Fault do on = false emit Off & Alarm within 14_400_000..=14_400_000 ms;
            voltage_timer   [on]:
                Voltage => Fault do on = false emit Off & Alarm within 7_200_000..=7_200_000 ms;

            overheat on Overheated [on & !hot]:
                Charging => Fault do on = false & hot = true emit Off & Alarm;
            warm     on Overheated [!hot]: _ => _ read Unpowered do hot = true;
            cool     on Cooled [hot]:      _ => _ read Unpowered do hot = false;
            unplug   on Removed [on]: Charging => Idle do on = false emit Off;
            remove   on Removed: Finished => Idle;
        }
        ignore {
            Inserted in Precharge & Current & Voltage & Done & Fault;
            Removed in Idle;
            Recovered in Idle & Current & Voltage & Done & Fault;
            Reached in Idle & Precharge & Voltage & Done & Fault;
            Tapered in Idle & Precharge & Current & Voltage & Done & Fault;
            Sagged in Idle & Precharge & Current & Voltage & Fault & hot;
            Overheated in hot;
            Cooled in Idle & Precharge & Current & Voltage & Done & Fault;
        }
        laws {
            invariant(Idle & Precharge & Current & Voltage & Done & Fault = 1);
            invariant(on & Idle & Done & Fault = 1);
            never_both(on, hot);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Idle);
            always_can(Done);
            always_can(hot);
        }
    }
}
