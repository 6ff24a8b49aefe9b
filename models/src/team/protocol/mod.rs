//! How a team's auctioneers, brokers and bidders agree on who does what, as a net: over a network
//! that loses, repeats and reorders messages, with robots that break down (F. Rohrmueller, TUM
//! 2011, ch. 3: algorithms 3.1 and 3.2, section 3.4).
//!
//! [`net()`] makes the repaired protocol of a [`Team`], or that of the thesis's [`TEXT`], or one with
//! single [`Defect`]s; [`requirements`] are what is asked of it: safety S1 to S9 and liveness L1 to
//! L4.
//!
//! ```
//! use cotama_models::team::protocol::{Team, net, requirements};
//! let team = Team::new(3, 1);
//! let net = net(&team);
//! assert_eq!(net.view().net().defect(), None);
//! let asked = requirements(&team, &net);
//! assert_eq!((asked.len(), asked[6].id), (13, "S7"));
//! assert!(asked[6].text.starts_with("AG !(t1.leader.r1 + t1.leader.r2"));
//! ```
//!
//! # The protocol
//!
//! 1. The auctioneer of a task announces it. Who is idle and capable bids.
//! 2. At a deadline it awards the task to a coalition of bidders. It asks them one after the other,
//!    in the order of their numbers: the second one when the first one said yes. So of two
//!    auctioneers that want the same robots one gets none.
//! 3. An asked robot that is idle acknowledges and waits; a busy one says no. It executes its role
//!    when its partner has acknowledged too.
//! 4. A "no", a robot that is silent, or a deadline make the auctioneer withdraw the award: whoever
//!    it named is released and says that it left. When all have left or are dead, and not before,
//!    the number of the round goes up and the task is announced again.
//! 5. When the robots have completed it the task is done; when too few capable robots are alive it
//!    is reported.
//! 6. The auctioneer has what it knows copied before it acts on it. When it dies, the first robot
//!    that is alive takes over.
//! 7. A message of an older round is ignored.
//!
//! # What is kept, what is left out
//!
//! | in the world | in the net | why that is enough |
//! | --- | --- | --- |
//! | a lossy, repeating, reordering network | what was sent in a round stays in the air: it is read never, once or again, in any order | more can happen than with mailboxes of two, or of any size |
//! | numbers of rounds | this round, or an older one | they are only compared with the present one; so rounds are not limited |
//! | messages of older rounds | for each robot: none, its Assign, its Ack as well; for ever | a bid comes before its Assign; other messages of older rounds do not count in any version but one, and there an Assign stands for its Release |
//! | Announce, then a bid | a bid while the task is announced | a bid on an older Announce has an old number |
//! | bids, the best coalition | any coalition of bidders may be the best one | the costs are left open |
//! | the second Assign | the partner reads the first Ack | it is one step of the auctioneer that nobody else sees |
//! | Alive messages | the auctioneer may see at any time from then on that a robot is down | the deadline is longer than what the network may take, and a robot that hears nobody for that long leaves its role |
//! | deadlines that are too early | an award may be withdrawn at any time until the network settles | for safety all of time, for liveness a time without a limit |
//! | work | it ends for all robots of a coalition at once | a handover |
//! | copies of tasks | the next auctioneer knows what the one before knew | it writes the copy first |
//!
//! Liveness is asked of runs on which the network settles at last. Nothing else is assumed: a run
//! goes on as long as something can happen, failures need not happen (`failure.spared`), and there
//! is no cycle in which somebody could be kept from a step for ever. Where there is one, in the text
//! and in mutants, [`Requirement::fair`] leaves the unfair runs out.
//!
//! Names: `r2.waiting.t1` is robot 2 in task 1, `t1.named.r2` what task 1's round holds of robot 2.

mod auctioneer;
mod draft;
mod failure;
mod member;
mod requirement;
mod team;

pub use requirement::{Requirement, requirements};
pub use team::{Defect, MOST_ROBOTS, Plan, TEXT, Team};

use cotama_core::net::owned::OwnedNet;
use draft::Draft;

/// The net of a team.
///
/// ```
/// use cotama_models::team::protocol::{TEXT, Team, net};
/// let text = net(&Team::new(3, 1).with(TEXT));
/// assert!(text.transitions.iter().any(|it| it.name == "t1.all_acked.r1_by_old_ack.r2"));
/// ```
pub fn net(team: &Team) -> OwnedNet {
    let mut draft = Draft::new(team);
    for task in 0..team.tasks.len() {
        draft.auctioneer(task);
        for r in 0..team.robots {
            draft.member(task, r);
        }
        draft.finishes(task);
        draft.takes_over(task);
    }
    for r in 0..team.robots {
        draft.fails(r);
    }
    draft.settles();
    draft.net
}
