//! SCXML, the W3C's State Chart XML (<https://www.w3.org/TR/scxml/>).

mod machine;
mod xml;

use cotama_core::net::{Net, TransitionId};
pub use machine::NotAStateMachine;
use machine::{Machine, Timing};

/// The net as a state chart, if its [`Role::State`](cotama_core::net::Role::State) places are the
/// states of one machine: one token in them at the start, and every transition either moves it
/// (takes it from one state and gives it to one) or stays (reads one state).
///
/// | of the net | in the chart |
/// | --- | --- |
/// | state place | `<state>`; ignored events are a comment, with their guards |
/// | other place | `<data>`: a boolean where it surely stays at 0 or 1, else a number |
/// | complement | no variable: its tokens are the bound less those of the place |
/// | transition that moves | `<transition target=..>`, also from a state to itself |
/// | transition that stays | `<transition>` without a target: nothing is left or entered |
/// | tokens needed, changed | `cond`, `<assign>` |
/// | event | `event`; without one the transition is eventless, or waits: see below |
/// | output | `<send target="#_parent">`, to whoever invoked the chart: the outside |
/// | priority, then position | document order within the state |
/// | documentation | comments |
///
/// A transition that fires by itself `within` an interval fires at its earliest instant: the state
/// sends itself a delayed event when it is entered and cancels it when it is left. This is the
/// net's clock only if that starts when the state is entered, so no transition that stays may touch
/// what the timed one needs, nor may another net (shared places, mailboxes). Otherwise, and when a
/// transition has both an event and an interval, no timer keeps the interval: it stands in the
/// attribute `cotama:within`, in milliseconds, a comment at the top lists it, and
/// [`unkept_intervals`] gives it to a program. If such a transition has no event, it waits for the
/// event `timeout_` and its name, which the environment then has to send: it never fires too early.
/// Of two timers that end at the same instant the one that was started first goes first, whatever
/// the priorities.
///
/// A net without events and time has no transition that waits for anything: as a chart it would
/// run for ever at its start, or to its end. There each transition waits for an event of its own
/// name, as `cotama simulate` plays it. So do, in other nets, transitions that would fire for ever
/// at the start. [`waiting`] gives them to a program.
///
/// Names are changed where SCXML allows fewer characters: a letter, then letters, digits, `_`, and
/// for states and events `-`. No dots, as `event="door"` would also match `door.open`; no event
/// `error` or `done`, which would match those of the platform; no reserved word of ECMAScript as a
/// variable. The attribute `cotama:name` keeps the original, and the name
/// of each transition. Characters that XML 1.0 cannot hold become U+FFFD there,
/// and codes as `\u{1b}` in comments. Laws are not written.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::formats::scxml;
///
/// let mut net = OwnedNet::new("light", "A lamp.");
/// let off = net.place(OwnedPlace::new("off", 1)).unwrap();
/// let on = net.place(OwnedPlace::new("on", 0)).unwrap();
/// let press = net.event("press", "").unwrap();
/// net.transition(OwnedTransition::new("light up").on(press).take(off, 1).give(on, 1)).unwrap();
/// let text = scxml::write(&net.view().net()).unwrap();
/// assert!(text.contains("<transition event=\"press\" target=\"on\" cotama:name=\"light up\"/>"));
///
/// net.transition(OwnedTransition::new("burn out").take(on, 1)).unwrap();
/// let error = scxml::write(&net.view().net()).unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "transition `burn out` takes `on` and gives no state: it must give exactly one"
/// );
/// ```
///
/// # Errors
/// [`NotAStateMachine`], which names the transition or place that is the reason.
pub fn write(net: &Net<'_>) -> Result<String, NotAStateMachine> {
    Ok(xml::document(&Machine::of(net)?))
}

/// The transitions whose interval no timer of the chart keeps; see [`write()`].
///
/// # Errors
/// [`NotAStateMachine`], as for [`write()`].
pub fn unkept_intervals(net: &Net<'_>) -> Result<Vec<TransitionId>, NotAStateMachine> {
    with(net, Timing::Unkept)
}

/// The transitions that wait for an event of their own name; see [`write()`].
///
/// # Errors
/// [`NotAStateMachine`], as for [`write()`].
pub fn waiting(net: &Net<'_>) -> Result<Vec<TransitionId>, NotAStateMachine> {
    with(net, Timing::Named)
}

fn with(net: &Net<'_>, timing: Timing) -> Result<Vec<TransitionId>, NotAStateMachine> {
    let machine = Machine::of(net)?;
    let such = machine.moves.iter().zip(0..).filter(|(it, _)| it.timing == timing);
    Ok(such.map(|(_, id)| TransitionId(id)).collect())
}
