//! Ignored events leave no trace, on nets with clocks, and the reason is right. A player is behind
//! only when too much is due at once: here, nothing is.

use super::{any_tokens, gate, lamp, marking};
use crate::net::{EventId, Net, Place, TransitionId};
use crate::player::{Checked, Outcome, Player, Program, Why};
use crate::system::Of;
use Why::{Full, NoSuchEvent, NotEnabled, OnPurpose, TooEarly, TooLate};
use cotama_units::proofs::few;
use cotama_units::units::Millis;

/// A net at some time in this marking, and for each transition how long it has been enabled: the
/// clocks of those that have their tokens show any age up to where they stop.
fn any_ages<P: Program<W, C>, const W: usize, const C: usize, const T: usize>(
    program: P,
    tokens: &[u8],
) -> (Player<P, W, C>, [u32; T]) {
    let marking = marking(&program, tokens);
    let (mut clocks, mut ages) = ([0; C], [0; T]);
    for (elapsed, clock) in clocks.iter_mut().zip(program.code().clocks) {
        if program.code().holds(&marking, &clock.need) {
            *elapsed = u32::from(few::<3>());
            kani::assume(*elapsed <= clock.cap());
        }
        let entry = &program.code().entries[usize::from(clock.entry)];
        ages[usize::from(entry.transition)] = *elapsed;
    }
    (Player { program, marking, clocks, slots: [], now: Millis(1) }, ages)
}

/// Returns the reason why a transition that has its tokens cannot fire, by the textbook: the wrong
/// time, or no room. `None` if it has not its tokens.
fn lacks(net: &Net<'_>, at: usize, tokens: &[u8], age: u32) -> Option<Option<Why<u32>>> {
    let (it, id) = (&net.transitions[at], at as u32);
    let has = |arc: &crate::net::Arc| u32::from(tokens[arc.place.0 as usize]) >= arc.weight;
    if !it.take.iter().chain(it.read).all(has) {
        return None;
    }
    let room = |(place, now): (usize, &Place<'_>)| {
        let weight = |arcs: &[crate::net::Arc]| {
            arcs.iter().filter(|it| it.place.0 as usize == place).map(|it| it.weight).sum::<u32>()
        };
        u32::from(tokens[place]) + weight(it.give) <= now.bound + weight(it.take)
    };
    Some(match it.within {
        Some(within) if age < within.earliest => Some(TooEarly(id)),
        Some(within) if within.latest.is_some_and(|it| age > it) => Some(TooLate(id)),
        _ => (!net.places.iter().enumerate().all(room)).then_some(Full(id)),
    })
}

/// Whether nothing is due by itself: what is due goes before what is offered.
fn rests(net: &Net<'_>, tokens: &[u8], ages: &[u32]) -> bool {
    (0..ages.len()).all(|at| {
        // By itself a transition fires as soon as it can, so it is never too late.
        let said = lacks(net, at, tokens, ages[at]);
        net.transitions[at].on.is_some() || !matches!(said, Some(None | Some(TooLate(_))))
    })
}

/// Why an event is ignored, by the textbook; none where it is not. Of the transitions that have
/// their tokens, the first by priority and then by number says what it lacks.
fn textbook(net: &Net<'_>, on: u8, tokens: &[u8], ages: &[u32]) -> Option<Why<u32>> {
    let on = EventId(on.into());
    let mut first = None;
    for priority in [1, 0] {
        for (at, it) in net.transitions.iter().enumerate() {
            if it.on != Some(on) || it.priority != priority {
                continue;
            }
            if let Some(lacks) = lacks(net, at, tokens, ages[at]) {
                first = first.or(Some(lacks?));
            }
        }
    }
    let ignores = |it: &crate::net::Ignored<'_>| it.event == on && tokens[it.place.0 as usize] > 0;
    let otherwise = if net.ignored.iter().any(ignores) { OnPurpose } else { NotEnabled };
    let exists = (on.0 as usize) < net.events.len();
    Some(first.unwrap_or(if exists { otherwise } else { NoSuchEvent }))
}

/// Offers an event at the present instant. When it is ignored the player is as it was, and the
/// reason, which comes back, is that of the textbook.
fn offered<P, const W: usize, const C: usize>(
    net: &Net<'_>,
    player: &Player<P, W, C>,
    on: u8,
    tokens: &[u8],
    ages: &[u32],
) -> Option<Why<u32>>
where
    P: Program<W, C> + Copy + PartialEq,
{
    let (mut after, event) = (*player, Of { component: 0, id: EventId(on.into()) });
    let expected = textbook(net, on, tokens, ages);
    let said = after.offer_id(player.now, event, (), &mut ());
    match said.map(|it: Of<TransitionId>| it.id.0) {
        Outcome::Ignored { why } => assert!(after == *player && expected == Some(why)),
        Outcome::Fired { .. } => assert!(expected.is_none()),
        Outcome::Refused { .. } => unreachable!(),
    }
    expected
}

/// In any state of a state machine with clocks, whatever they show, an ignored event leaves tokens,
/// clocks and time as they were, and the reason is right: no tokens, too early, too late, or no
/// such event.
#[kani::proof]
#[kani::unwind(8)]
pub fn an_ignored_event_leaves_clocks_alone() {
    let marked = usize::from(few::<2>());
    kani::assume(marked < 3);
    let mut tokens = [0; 3];
    tokens[marked] = 1;
    let (player, ages) = any_ages::<_, _, _, 4>(lamp::Program, &tokens);
    kani::assume(rests(&lamp::NET, &tokens, &ages));
    let why = offered(&lamp::NET, &player, few::<2>(), &tokens, &ages);
    kani::cover!(matches!(why, Some(TooEarly(_))), "too early");
    kani::cover!(matches!(why, Some(TooLate(_))), "too late");
    kani::cover!(why == Some(NoSuchEvent), "no such event");
    kani::cover!(why == Some(NotEnabled) && ages[2] == 4, "no tokens, and a clock runs");
}

/// In any marking within its bounds and with any ages of its clocks, what a net ignores changes
/// nothing, and the reason is that of the first transition that has its tokens: too early, too
/// late, or no room; and without one, on purpose or no tokens.
#[kani::proof]
#[kani::unwind(8)]
pub fn an_event_is_ignored_for_the_reason_that_is_said() {
    let tokens: [u8; 4] = any_tokens(&gate::NET);
    let (player, ages) = any_ages::<_, _, _, 4>(Checked(gate::Program), &tokens);
    kani::assume(rests(&gate::NET, &tokens, &ages));
    let on = few::<2>();
    let why = offered(&gate::NET, &player, on, &tokens, &ages);
    kani::cover!(why == Some(Full(2)), "no room");
    kani::cover!(why == Some(TooEarly(1)) && ages[0] > 3, "too early by priority, else too late");
    kani::cover!(why == Some(OnPurpose), "on purpose");
}
