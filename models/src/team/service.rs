//! The thesis's service team: four robots take orders and serve drinks (3.6, Table 3.4).

use super::capability::{Capability, Robot, Skill};
use super::constraint::Constraint::{self, All, Any, Has};
use super::task::{Action, ActionPlan, Role};

const fn capability(number: u8) -> Capability {
    Capability::new(number).expect("it is a small number")
}

/// Drives.
pub const MOVE: Capability = capability(0);
/// Knows where people and cups are.
pub const DETECT: Capability = capability(1);
/// Grasps with two fingers.
pub const GRASP_2F: Capability = capability(2);
/// Grasps with three fingers.
pub const GRASP_3F: Capability = capability(3);
/// Holds a billiard cue.
pub const CUE_HOLD: Capability = capability(4);
/// Understands and speaks.
pub const DIALOGUE: Capability = capability(5);

const fn certain<const N: usize>(list: [Capability; N]) -> [Skill; N] {
    let (mut skills, mut at) = ([Skill::certain(MOVE); N], 0);
    while at < N {
        skills[at] = Skill::certain(list[at]);
        at += 1;
    }
    skills
}

/// The only one who speaks.
pub const EDDIE: Robot<'static> =
    Robot { name: "eddie", skills: &certain([MOVE, DETECT, GRASP_2F, DIALOGUE]) };
/// Two fingers.
pub const JIMMY: Robot<'static> =
    Robot { name: "jimmy", skills: &certain([MOVE, DETECT, GRASP_2F]) };
/// Three fingers.
pub const POPPY: Robot<'static> =
    Robot { name: "poppy", skills: &certain([MOVE, DETECT, GRASP_3F]) };
/// Plays billiards.
pub const TOMMY: Robot<'static> =
    Robot { name: "tommy", skills: &certain([MOVE, DETECT, CUE_HOLD]) };

/// The team, in the order of Table 3.4.
pub const ROBOTS: [Robot<'static>; 4] = [EDDIE, JIMMY, POPPY, TOMMY];

/// Some hand.
const GRASP: Constraint<'static> = Any(&[Has(GRASP_2F), Has(GRASP_3F)]);
const DRIVE: Constraint<'static> = All(&[Has(MOVE), Has(DETECT)]);

const TO_CUP: Action<'static> = Action { name: "move to the cup", needs: DRIVE };
const TO_PERSON: Action<'static> = Action { name: "move to the person", needs: DRIVE };
const TAKE: Action<'static> = Action { name: "grasp the cup", needs: GRASP };
const HAND_OVER: Action<'static> = Action { name: "hand the cup over", needs: GRASP };
const TALK: Action<'static> = Action { name: "talk to the person", needs: Has(DIALOGUE) };

/// One goes to a person and takes the order.
pub const ORDER: Role<'static> =
    Role { name: "order", plans: &[ActionPlan { name: "order", actions: &[TO_PERSON, TALK] }] };
/// One brings the cup to a person, or to who talks to the person.
pub const FETCH: Role<'static> = Role {
    name: "fetch",
    plans: &[ActionPlan { name: "fetch", actions: &[TO_CUP, TAKE, TO_PERSON, HAND_OVER] }],
};
/// The same, and talks to the person.
pub const BRING: Role<'static> = Role {
    name: "bring",
    plans: &[ActionPlan { name: "bring", actions: &[TO_CUP, TAKE, TO_PERSON, HAND_OVER, TALK] }],
};
