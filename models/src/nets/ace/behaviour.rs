//! Which of the five behaviours is active, and whether the path planner runs.
//!
//! *Print*: the behaviours, that Idle is the one by default (B.4.1), and that the planner is off in
//! `FollowPerson`, as the way to the person is taken to be free (B.4.3). *Reading*: the planner is
//! off in Idle too, where no motion is commanded; each behaviour is forwarded as an event of its
//! own; `Released` is the end of one.
//!
//! | behaviour | does |
//! | --- | --- |
//! | [`Explore`](Place::Explore) | drives to a border of the unknown; finds people, grows the map |
//! | [`FollowPerson`](Place::FollowPerson) | follows a tracked person, over a street for instance |
//! | [`GoInDirection`](Place::GoInDirection) | along the sidewalk, as a person pointed |
//! | [`ReachGoal`](Place::ReachGoal) | the shortest way to a goal |
//! | [`Idle`](Place::Idle) | stands |
//!
//! What to learn from it: "the planner is off exactly in `FollowPerson` and `Idle`" is a place
//! invariant, `planner & Idle & FollowPerson = 1`. A line that switched behaviours and forgot the
//! planner would not compile.
//!
//! ```
//! use cotama_core::units::Millis;
//! use cotama_models::nets::ace::behaviour::{Event, Place, Player, State};
//!
//! let mut ace = Player::new();
//! assert!(ace.offer(Millis(0), &Event::Explore).fired());
//! assert_eq!((ace.state(), ace.tokens(Place::planner)), (State::Explore, 1));
//! assert!(ace.offer(Millis(0), &Event::FollowPerson).fired());
//! assert_eq!((ace.state(), ace.tokens(Place::planner)), (State::FollowPerson, 0));
//! ```

pub use self::ace_behaviour::*;

cotama_core::net! {
    /// ACE's behaviours and its path planner.
    mod ace_behaviour {
        places {
            /// The robot stands.
            Idle: 1,
            /// The robot goes where the map ends.
            Explore,
            /// The robot follows a person.
            FollowPerson,
            /// The robot goes where a person pointed.
            GoInDirection,
            /// The robot goes to a known goal.
            ReachGoal,
        }
        flags {
            /// The path planner runs.
            planner,
        }
        events {
            /// The behaviour that was accepted.
            Explore,
            /// The behaviour that was accepted.
            FollowPerson,
            /// The behaviour that was accepted.
            GoInDirection,
            /// The behaviour that was accepted.
            ReachGoal,
            /// The behaviour that was accepted: stop, for an emergency or to talk.
            Idle,
            /// The active behaviour has ended.
            Released,
        }
        outputs {
            /// Zero speed.
            Stop,
            /// Start the planner.
            PlannerOn,
            /// Stop the planner.
            PlannerOff,
        }
        groups {
            Planned: Explore & GoInDirection & ReachGoal;
            Unplanned: Idle & FollowPerson;
        }
        transitions {
            explore   on Explore [!planner]: Unplanned => Explore do planner = true emit PlannerOn;
            direct    on GoInDirection [!planner]:
                Unplanned => GoInDirection do planner = true emit PlannerOn;
            reach     on ReachGoal [!planner]:
                Unplanned => ReachGoal do planner = true emit PlannerOn;
            follow    on FollowPerson [planner]:
                Planned => FollowPerson do planner = false emit PlannerOff;
            stand     on Idle [planner]: Planned => Idle do planner = false emit Stop & PlannerOff;
            release   on Released [planner]:
                Planned => Idle do planner = false emit Stop & PlannerOff;

            explore_instead on Explore: Planned => Explore;
            direct_instead  on GoInDirection: Planned => GoInDirection;
            reach_instead   on ReachGoal: Planned => ReachGoal;
            follow_instead  on FollowPerson: Unplanned => FollowPerson;
            stand_instead   on Idle: FollowPerson => Idle emit Stop;
            release_person  on Released: FollowPerson => Idle emit Stop;
        }
        ignore { Idle in Idle; Released in Idle; }
        laws {
            invariant(Idle & Explore & FollowPerson & GoInDirection & ReachGoal = 1);
            invariant(planner & Idle & FollowPerson = 1);
            handles(all);
            deterministic;
            deadlock_free;
            always_can(Idle);
            always_can(Explore);
            always_can(FollowPerson);
            always_can(GoInDirection);
            always_can(ReachGoal);
        }
    }
}
