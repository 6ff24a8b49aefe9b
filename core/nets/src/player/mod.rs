//! Plays a system of nets, or a net alone: events go in, transitions fire, and what happened comes
//! out.
//!
//! A net alone is a system of one component: one player executes both.
//!
//! Time comes in as an argument and the next deadline goes out ([`Player::wake_at`]), so the same
//! player serves firmware, a simulator and proofs. At every instant, in this order:
//!
//! 1. Transitions without event fire as soon as their interval allows, the one due first going
//!    first; of several due at the same instant the one of the highest priority, then the earlier
//!    one. After each of them all nets *settle*: transitions without event and interval fire until
//!    none is enabled, those of the first component first. Where it is not proven that they come
//!    to an end, [`SETTLE`] of them are enough, and the player is behind.
//! 2. An event is *offered*: the first enabled transition on it fires (by priority, then by line),
//!    and all nets settle; or the event is ignored, and the player says why. An ignored event, too,
//!    empties the mailboxes that it clears.
//! 3. In a *round* each net takes its turn, in the order of the system: it settles, then reads its
//!    mailboxes in the order in which its events are listed, each as far as it is filled when the
//!    net comes to it. An event that it reads makes a transition fire, or the net ignores it for
//!    good, or it goes on waiting because another mailbox is full. Then all nets settle.
//!    [`Player::round_is_due`] says whether something waits; a net alone has no mailboxes.
//!
//! **A firing.** An output that a transition emits *now* makes the receivers fire in the same step,
//! one after the other and depth first; one that it *mails* waits. When all that it says has
//! arrived, its net settles. All of it happens or nothing: when a mailbox on the way is full, an
//! offered event is [refused](Outcome::Refused), a transition that would fire by itself waits until
//! there is room, and the system is as it was. A full place is another matter: the transition that
//! would fill it further does not fire, and what it would have answered is
//! [ignored](Why::Full). An event carries a value of type `M` along; everything that happens
//! because of it has that value too.
//!
//! **Time.** The clock of a transition starts when the marking enables it, and starts anew whenever
//! a firing disturbs it: when it fires itself, or when what the firing takes leaves it disabled,
//! even if what is given back enables it again (Merlin's time Petri nets, with single-server
//! clocks). Reading disturbs no clock. Room in a place that several nets share is needed and taken
//! as tokens are; any other full place stops a firing, but no clock. The semantics is *strong* for
//! transitions without event: time does not pass their last instant. They fire at their first, so a
//! later last instant only tells the checker what to allow for. For a transition on an event it is
//! *weak*: when its last instant has passed, it is not enabled any more until its clock starts
//! anew. A player that is told the time late catches up: what was due fires at the time when it was
//! due, in order. So however often it is told the time in between, the same events and rounds at
//! the same instants give the same firings at the same instants.
//!
//! ```text
//! net! { .. } or system! { .. } -> System -> Code (packed) -> Player { marking, clocks, slots }
//!                                  ids       words            -> Outcome, Firing
//! ```

mod arcs;
mod cascade;
mod clocks;
pub mod code;
mod field;
mod fingerprint;
#[cfg(feature = "alloc")]
mod heap;
mod kept;
mod layout;
mod lists;
mod machine;
pub mod memory;
mod observer;
mod outcome;
pub mod pack;
#[allow(clippy::module_inception, reason = "the door of the room is the player")]
mod player;
mod program;
#[cfg(kani)]
pub mod proofs;
mod recorder;
mod settle;
pub mod size;
mod snapshot;
mod step;

pub use code::Code;
pub use field::{Field, LARGEST};
#[cfg(feature = "alloc")]
pub use heap::{clocks, slots, words};
pub use machine::is_state_machine;
pub use memory::Arrays;
#[cfg(feature = "alloc")]
pub use memory::Packed;
pub use observer::{Firing, Observer};
pub use outcome::{Advanced, EventNames, Outcome, Round, Stepped, Why};
pub use player::Player;
pub use program::{Checked, Kind, Loaded, Names, Program, StateMachine, Steps};
pub use recorder::Recorder;
pub use snapshot::{RestoreError, Snapshot, Stored};

/// The most transitions that one call lets fire by themselves while it catches up; see
/// [`Advanced::behind`].
pub const CATCH_UP: u32 = 10_000;

/// The most transitions that fire at once by themselves one after another, where no bound is
/// proven.
pub const SETTLE: u32 = 1_000;
