//! A system with what those that ship lack: intervals, and mailboxes that time fills.

use cotama_models::nets::{charger, watchdog};

cotama_core::system! {
    /// A charger whose control loop is watched.
    pub mod watched {
        nets { watchdog: watchdog, charger: charger }
        links {
            watchdog.SkipJob => charger.Sagged mail 2;
            watchdog.RtFault => charger.Removed now;
            charger.Alarm => watchdog.CsAck mail 1;
        }
        clears { charger.Inserted empties charger.Sagged; }
    }
}
