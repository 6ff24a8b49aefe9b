//! The robots, as their files print them: a build script does it.

use crate::control::Control;
use cotama_models::level::Level;

/// The decisional level of a robot in its mission.
macro_rules! robot {
    ($(#[$doc:meta])* $name:ident, $file:literal, $system:ident) => {
        $(#[$doc])*
        pub mod $name {
            #[allow(
                missing_docs,
                nonstandard_style,
                unreachable_pub,
                reason = "names are those of the robot's file, of which few are asked for"
            )]
            mod printed {
                include!(concat!(env!("OUT_DIR"), $file));
            }

            use cotama_models::level::{self, Cause};
            pub use printed::names;
            pub use printed::tasks::TASKS;
            use printed::$system as system;
            use system::SIZE;

            /// The tables of the robot.
            pub static TABLES: &level::Tables<'static> = &printed::tables::TABLES;

            /// Checks every firing: what was restored from flash is not known to be reachable.
            pub type Program = cotama_core::player::Checked<system::Program>;

            /// The supervisors of a mission.
            pub type Supervisors = super::Level<
                'static,
                Program,
                { SIZE.words },
                { SIZE.clocks },
                { SIZE.slots },
            >;

            /// The control loop of the robot.
            pub type Control =
                super::Control<Program, { SIZE.words }, { SIZE.clocks }, { SIZE.slots }>;

            /// Bytes of the stored state.
            pub const STORED_BYTES: usize = cotama_core::player::Snapshot::<
                { SIZE.words },
                { SIZE.clocks },
                { SIZE.slots },
                Cause,
            >::BYTES;

            /// The supervisors at rest. Not inlined: their start is over before a control loop is
            /// made of them, so that the stack is not as deep as both together.
            #[inline(never)]
            pub fn at_rest() -> Supervisors {
                super::Level::start(TABLES, cotama_core::player::Checked(system::Program))
            }

            impl Default for Control {
                fn default() -> Self {
                    Self::new(at_rest())
                }
            }
        }
    };
}

robot! {
    /// The Pioneer 3-DX of COTAMA, in the delivery.
    delivery, "/delivery.rs", net_p3dx_delivery
}

robot! {
    /// The transport robot, in its shift.
    transport, "/transport.rs", net_transport
}
