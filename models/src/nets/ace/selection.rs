//! Behaviour selection: which subsystem's behaviour is active.
//!
//! *Print* (figure B.4): in INACTIVE and ACTIVE a trigger of a subsystem leads to PRIORITYCHECK. If
//! its priority is at least that of the subsystem whose behaviour is active, its own becomes
//! active. Idle is the behaviour where one has ended and nothing else is asked for (B.4.1).
//!
//! *Reading*:
//!
//! - When a behaviour has completed or failed, the machine is INACTIVE.
//! - The priorities, which are not printed: [`Emergency`](Place::Emergency) over traversability
//!   over interaction over vision over navigation. They are all different. `at least` lets a
//!   subsystem replace its own behaviour; between two of equal priority it would let them take
//!   turns for ever.
//! - The emergency stop is a subsystem of its own; the dissertation has the other four.
//! - A refused trigger leaves the active behaviour as it is, and the asker is told; it is not kept.
//! - Each subsystem has one slot, so triggers that come while others are checked are not lost: the
//!   highest is checked first, and the check ends when all slots are empty. A second trigger of the
//!   same subsystem takes the slot over, and the asker is told that the first was replaced.
//!
//! What to learn from it: guards that exclude each other (`!emergency_asks` and so on) say the
//! order of the check in the net itself, so `deterministic` holds without priorities; groups
//! (`UpToVision`) say "at most this priority" in a word. Between events the check takes no time:
//! the net passes `PriorityCheck` and never stays in it. In synchronous
//! [steps](cotama_core::player::Player::step) each decision is a step of its own, and then the
//! slots are needed.
//!
//! ```
//! use cotama_core::{player::Outcome, units::Millis};
//! use cotama_models::nets::ace::selection::{Event, Firing, Output, Place, Player, Transition};
//!
//! let (mut ace, now) = (Player::new(), Millis(0));
//! // A passer-by shows the way; then the robot sees a curb.
//! assert!(ace.offer(now, &Event::InteractionTriggers).fired());
//! assert!(ace.offer(now, &Event::TraversabilityTriggers).fired());
//! assert_eq!(ace.tokens(Place::Traversability), 1);
//!
//! // Navigation asks in vain.
//! let mut told = Vec::new();
//! let mut listen = |firing: &Firing<'_>| told.extend(firing.outputs());
//! let outcome = ace.offer_with(now, &Event::NavigationTriggers, &mut listen);
//! assert_eq!(outcome, Outcome::Fired { transition: Transition::navigation_asks, settled: 2 });
//! assert_eq!(told, [Output::NavigationRefused]);
//! assert_eq!(ace.tokens(Place::Traversability), 1);
//! ```

pub use self::ace_selection::*;

cotama_core::net! {
    /// ACE's behaviour selection: five subsystems, their priorities, one active.
    mod ace_selection {
        places {
            /// No behaviour but Idle.
            Inactive: 1,
            /// A trigger is compared with the active subsystem.
            PriorityCheck,
            /// A behaviour that a subsystem triggered is active.
            Active,
            /// No subsystem holds the robot.
            Nobody: 1,
            /// Navigation holds it; priority 1.
            Navigation,
            /// Vision holds it; priority 2.
            Vision,
            /// Human-robot interaction holds it; priority 3.
            Interaction,
            /// Traversability assessment holds it; priority 4.
            Traversability,
            /// The emergency stop holds it; priority 5.
            Emergency,
        }
        flags {
            /// The slot of navigation.
            navigation,
            /// The slot of vision.
            vision,
            /// The slot of interaction.
            interaction,
            /// The slot of traversability assessment.
            traversability,
            /// The slot of the emergency stop.
            emergency,
        }
        events {
            /// Navigation asks for a behaviour.
            NavigationTriggers,
            /// Vision asks for a behaviour.
            VisionTriggers,
            /// Human-robot interaction asks for a behaviour.
            InteractionTriggers,
            /// Traversability assessment asks for a behaviour.
            TraversabilityTriggers,
            /// The emergency stop asks for Idle.
            EmergencyTriggers,
            /// The active behaviour is completed.
            Completed,
            /// The active behaviour has failed.
            Failed,
        }
        outputs {
            /// The trigger's behaviour is active.
            NavigationAccepted,
            /// The active behaviour is more important.
            NavigationRefused,
            /// A newer trigger took the slot.
            NavigationReplaced,
            /// The trigger's behaviour is active.
            VisionAccepted,
            /// The active behaviour is more important.
            VisionRefused,
            /// A newer trigger took the slot.
            VisionReplaced,
            /// The trigger's behaviour is active.
            InteractionAccepted,
            /// The active behaviour is more important.
            InteractionRefused,
            /// A newer trigger took the slot.
            InteractionReplaced,
            /// The trigger's behaviour is active.
            TraversabilityAccepted,
            /// The active behaviour is more important.
            TraversabilityRefused,
            /// A newer trigger took the slot.
            TraversabilityReplaced,
            /// The trigger's behaviour is active.
            EmergencyAccepted,
            /// A newer trigger took the slot.
            EmergencyReplaced,
            /// No subsystem holds the robot: Idle.
            Released,
        }
        groups {
            Ready: Inactive & Active;
            UpToNavigation: Nobody & Navigation;
            UpToVision: Nobody & Navigation & Vision;
            UpToInteraction: Nobody & Navigation & Vision & Interaction;
            UpToTraversability: Nobody & Navigation & Vision & Interaction & Traversability;
            UpToEmergency: Nobody & Navigation & Vision & Interaction & Traversability & Emergency;
            AboveNavigation: Vision & Interaction & Traversability & Emergency;
            AboveVision: Interaction & Traversability & Emergency;
            AboveInteraction: Traversability & Emergency;
            Subsystem: Navigation & Vision & Interaction & Traversability & Emergency;
        }
        transitions {
            navigation_asks     on NavigationTriggers     [!navigation]:
                Ready => PriorityCheck do navigation = true;
            vision_asks         on VisionTriggers         [!vision]:
                Ready => PriorityCheck do vision = true;
            interaction_asks    on InteractionTriggers    [!interaction]:
                Ready => PriorityCheck do interaction = true;
            traversability_asks on TraversabilityTriggers [!traversability]:
                Ready => PriorityCheck do traversability = true;
            emergency_asks      on EmergencyTriggers      [!emergency]:
                Ready => PriorityCheck do emergency = true;

            /// A trigger during the check waits in its slot.
            navigation_joins     on NavigationTriggers     [!navigation]:
                _ => _ read PriorityCheck do navigation = true;
            vision_joins         on VisionTriggers         [!vision]:
                _ => _ read PriorityCheck do vision = true;
            interaction_joins    on InteractionTriggers    [!interaction]:
                _ => _ read PriorityCheck do interaction = true;
            traversability_joins on TraversabilityTriggers [!traversability]:
                _ => _ read PriorityCheck do traversability = true;
            emergency_joins      on EmergencyTriggers      [!emergency]:
                _ => _ read PriorityCheck do emergency = true;

            /// The newest wins.
            navigation_renews     on NavigationTriggers     [navigation]:
                _ => _ read PriorityCheck emit NavigationReplaced;
            vision_renews         on VisionTriggers         [vision]:
                _ => _ read PriorityCheck emit VisionReplaced;
            interaction_renews    on InteractionTriggers    [interaction]:
                _ => _ read PriorityCheck emit InteractionReplaced;
            traversability_renews on TraversabilityTriggers [traversability]:
                _ => _ read PriorityCheck emit TraversabilityReplaced;
            emergency_renews      on EmergencyTriggers      [emergency]:
                _ => _ read PriorityCheck emit EmergencyReplaced;

            /// Of the slots that are filled the most important one is checked first.
            emergency_accepted [emergency]: UpToEmergency => Emergency
                read PriorityCheck do emergency = false emit EmergencyAccepted;
            traversability_accepted [traversability & !emergency]:
                UpToTraversability => Traversability
                read PriorityCheck do traversability = false emit TraversabilityAccepted;
            interaction_accepted [interaction & !traversability & !emergency]:
                UpToInteraction => Interaction
                read PriorityCheck do interaction = false emit InteractionAccepted;
            vision_accepted [vision & !interaction & !traversability & !emergency]:
                UpToVision => Vision
                read PriorityCheck do vision = false emit VisionAccepted;
            navigation_accepted
                [navigation & !vision & !interaction & !traversability & !emergency]:
                UpToNavigation => Navigation
                read PriorityCheck do navigation = false emit NavigationAccepted;

            traversability_refused [PriorityCheck & traversability & !emergency]: _ => _
                read Emergency do traversability = false emit TraversabilityRefused;
            interaction_refused [PriorityCheck & interaction & !traversability & !emergency]: _ => _
                read AboveInteraction do interaction = false emit InteractionRefused;
            vision_refused [PriorityCheck & vision & !interaction & !traversability & !emergency]:
                _ => _
                read AboveVision do vision = false emit VisionRefused;
            navigation_refused
                [PriorityCheck & navigation
                & !vision & !interaction & !traversability & !emergency]:
                _ => _
                read AboveNavigation do navigation = false emit NavigationRefused;

            decided [!navigation & !vision & !interaction & !traversability & !emergency]:
                PriorityCheck => Active;

            complete on Completed: Active & Subsystem => Inactive & Nobody emit Released;
            fail     on Failed:    Active & Subsystem => Inactive & Nobody emit Released;
        }
        ignore { Completed in Inactive; Failed in Inactive; }
        laws {
            invariant(Inactive & PriorityCheck & Active = 1);
            invariant(Nobody & Navigation & Vision & Interaction & Traversability & Emergency = 1);
            never_both(Active, Nobody);
            never_both(Inactive, Navigation);
            never_both(Inactive, Vision);
            never_both(Inactive, Interaction);
            never_both(Inactive, Traversability);
            never_both(Inactive, Emergency);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Inactive);
            always_can(Navigation);
            always_can(Vision);
            always_can(Interaction);
            always_can(Traversability);
            always_can(Emergency);
        }
    }
}
