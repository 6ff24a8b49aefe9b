//! The four nets of ACE as one robot, whose subsystems may die.
//!
//! Four subsystems ask, each by its [`request`], and are answered by the [`selection`]; what is
//! accepted is forwarded to [`behaviour`] control, whose [`accuracy`] may let it fail. *Reading*:
//! the emergency stop and traversability assessment want Idle, interaction `GoInDirection`, vision
//! `FollowPerson`, navigation `ReachGoal` where the [`goal`] is known, else `Explore`. A subsystem
//! that dies while it holds the robot is missed after three seconds without an [`alive`] message
//! (chapter 3 has these messages for robots of a team), and its behaviour has failed; one that dies
//! without holding the robot asks no more.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::nets::ace::robot::{Event, Place, Player, alive, request, selection};
//!
//! let mut ace = Player::new();
//! // Vision follows a person, and dies.
//! assert!(ace.offer(Millis(0), &Event::vision(request::Event::Trigger)).fired());
//! ace.round(Millis(100));
//! assert_eq!(ace.tokens(Place::vision(request::Place::Active)), 1);
//! assert!(ace.offer(Millis(3_000), &Event::alive(alive::Event::Silent)).fired());
//! ace.round(Millis(3_100));
//! assert_eq!(ace.tokens(Place::selection(selection::Place::Nobody)), 1);
//! ```

pub use super::{accuracy, behaviour, request, selection};
pub use ace_robot::*;

cotama_core::net! {
    /// Alive messages of the subsystem that holds the robot. One that dies without it asks no more.
    pub mod alive {
        places {
            /// Messages are waited for.
            Waiting: 1,
        }
        events {
            /// No alive message for three seconds: the holder is dead.
            Silent,
        }
        outputs {
            /// The holder of the robot is missed.
            Lost,
        }
        transitions { miss on Silent: Waiting => Waiting emit Lost; }
        laws { invariant(Waiting = 1); handles(all); deterministic; }
    }
}

cotama_core::net! {
    /// The behaviour that navigation wants.
    pub mod goal {
        places {
            /// Frontiers are explored.
            Unknown: 1,
            /// There is a goal on the map.
            Known,
        }
        events {
            /// Navigation holds the robot.
            Go,
            /// The goal is on the map.
            Found,
            /// The goal is on the map no more.
            Lost,
        }
        outputs {
            /// Go where the map ends.
            Explore,
            /// Go to the goal.
            ReachGoal,
        }
        transitions {
            explore on Go: Unknown => Unknown emit Explore;
            reach   on Go: Known => Known emit ReachGoal;
            find on Found: Unknown => Known;
            lose on Lost:  Known => Unknown;
        }
        ignore { Found in Known; Lost in Unknown; }
        laws { invariant(Unknown & Known = 1); handles(all); deterministic; }
    }
}

cotama_core::system! {
    /// ACE's selection and control of behaviours, with subsystems that die.
    pub mod ace_robot {
        nets {
            navigation: request,
            vision: request,
            interaction: request,
            traversability: request,
            selection: selection,
            goal: goal,
            behaviour: behaviour,
            accuracy: accuracy,
            alive: alive,
        }
        links {
            navigation.Ask => selection.NavigationTriggers now;
            vision.Ask => selection.VisionTriggers now;
            interaction.Ask => selection.InteractionTriggers now;
            traversability.Ask => selection.TraversabilityTriggers now;

            selection.NavigationAccepted => navigation.Accepted & vision.Displaced
                & interaction.Displaced & traversability.Displaced & goal.Go
                & accuracy.Begin mail 1;
            goal.Explore => behaviour.Explore mail 1;
            goal.ReachGoal => behaviour.ReachGoal mail 1;
            selection.VisionAccepted => vision.Accepted & navigation.Displaced
                & interaction.Displaced & traversability.Displaced & behaviour.FollowPerson
                & accuracy.Begin mail 1;
            selection.InteractionAccepted => interaction.Accepted & navigation.Displaced
                & vision.Displaced & traversability.Displaced & behaviour.GoInDirection
                & accuracy.Begin mail 1;
            selection.TraversabilityAccepted => traversability.Accepted & navigation.Displaced
                & vision.Displaced & interaction.Displaced & behaviour.Idle
                & accuracy.Begin mail 1;
            selection.EmergencyAccepted => navigation.Displaced & vision.Displaced
                & interaction.Displaced & traversability.Displaced & behaviour.Idle
                & accuracy.Begin mail 1;
            selection.NavigationRefused => navigation.Refused mail 1;
            selection.VisionRefused => vision.Refused mail 1;
            selection.InteractionRefused => interaction.Refused mail 1;
            selection.TraversabilityRefused => traversability.Refused mail 1;
            selection.Released => navigation.Ended & vision.Ended & interaction.Ended
                & traversability.Ended & behaviour.Released mail 1;

            accuracy.Fail => selection.Failed mail 1;
            alive.Lost => selection.Failed mail 1;
        }
    }
}
