//! How a team's auctioneers, brokers and bidders agree on who does what, as a net: over a network
//! that loses, repeats and reorders messages, with robots that break down (F. Rohrmueller, TUM
//! 2011, ch. 3: algorithms 3.1 and 3.2, section 3.4).
//!
//! [`net()`] makes the repaired protocol of a [`Team`], or that of the thesis's [`TEXT`], or one
//! with single [`Defect`]s; [`requirements`] are what is asked of it: safety S1 to S9 and liveness
//! L1 to L4. `cotama check team:3` knows the first as [`TEAM`](crate::nets::families::TEAM).
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
//! - *The network*: what was sent in a round stays in the air, and is read never, once or again, in
//!   any order. That is loss, repetition and reordering; more can happen than with mailboxes of two
//!   messages, or of any number. For liveness it means that a robot sends again while it waits.
//! - *Numbers of rounds*: a message is of this round, or of an older one. Numbers are only compared
//!   with the present one, so rounds are not limited.
//! - *Messages of older rounds*: of each robot nothing, its Assign, or its Ack as well; for ever. A
//!   bid comes before its Assign, and one defect takes an Assign for its Release. No other message
//!   of an older round counts in any version.
//! - *Announce* and the bid that answers it are one message: a bid on an older Announce has an old
//!   number. So are a coalition's second Assign and the Ack before it, and "no" to an award and its
//!   withdrawal take two steps of which anything may come between.
//! - *Bids*: any coalition of bidders may be the best one; costs are left open.
//! - *Alive*: from the time a robot is down the auctioneer may notice it. So its deadline is longer
//!   than a message may take, and a robot that hears nobody for that long leaves its role.
//! - *Early deadlines*: until the network settles an award may be withdrawn at any time; for safety
//!   that is for ever.
//! - *Work* ends for both robots of a coalition at once, as a handover does.
//! - *Copies*: the next auctioneer knows what the one before knew, as that wrote the copy first.
//!
//! Liveness is asked of runs on which the network settles at last. Nothing else is assumed: a run
//! goes on as long as something can happen, failures need not happen (`failure.spared`), and no
//! cycle keeps anybody from a step for ever. The text and mutants have such cycles:
//! [`Requirement::fair`] leaves the unfair runs out. MuRoCo-D's requests of brokers to bidders are
//! left out, and a broker and its bidder are one robot.
//!
//! Names: `r2.waiting.t1` is robot 2 in task 1, `t1.named.r2` what task 1's round holds of robot 2.

mod auctioneer;
mod coalition;
mod conversion;
mod draft;
mod failure;
mod member;
mod requirement;
mod supervised;
mod team;

pub use conversion::MOST_STEPS;
pub use requirement::{REQUIREMENTS, Requirement, requirements};
pub use supervised::{supervised, supervised_requirements};
pub use team::{Defect, MOST_ROBOTS, TEXT, Team};

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
    drafted(team).net
}

fn drafted(team: &Team) -> Draft<'_> {
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
    draft.laws();
    draft
}
