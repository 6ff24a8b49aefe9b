//! One event in any marking: what fires, what is ignored, what is conserved.

use super::{any_tokens, at, buffer, relay, tokens, twins};
use crate::net::{EventId, Net};
use crate::player::{Checked, Outcome, Why};
use crate::system::Of;
use cotama_units::proofs::few;
use cotama_units::units::Millis;

/// An event of a net, by its number.
fn event(id: u8) -> Of<EventId> {
    Of { component: 0, id: EventId(id.into()) }
}

/// The first transition on an event that has its tokens and room, fired as in the textbook.
fn textbook<const PLACES: usize>(
    net: &Net<'_>,
    before: [u8; PLACES],
    on: u8,
) -> Option<(u32, [u8; PLACES])> {
    for (id, it) in (0..).zip(net.transitions) {
        let own = it.on.is_some_and(|it| it.0 == u32::from(on));
        let has = |arc: &crate::net::Arc| u32::from(before[arc.place.0 as usize]) >= arc.weight;
        if !own || !it.take.iter().chain(it.read).all(has) {
            continue;
        }
        let mut after = before;
        it.take.iter().for_each(|arc| after[arc.place.0 as usize] -= arc.weight as u8);
        it.give.iter().for_each(|arc| after[arc.place.0 as usize] += arc.weight as u8);
        let fits =
            |(tokens, place): (&u8, &crate::net::Place<'_>)| u32::from(*tokens) <= place.bound;
        if after.iter().zip(net.places).all(fits) {
            return Some((id, after));
        }
    }
    None
}

/// In any marking within its bounds, whether it can be reached or not, an event fires the
/// transition of the textbook and moves its tokens, and no others.
#[kani::proof]
#[kani::unwind(7)]
pub fn an_event_fires_the_transition_of_the_textbook() {
    let before: [u8; 4] = any_tokens(&buffer::NET);
    let mut player = at(Checked(buffer::Program), &before);
    let on = few::<2>();
    let said = player.offer_id(Millis(0), event(on), (), &mut ());
    let expected = textbook(&buffer::NET, before, on);
    match said {
        Outcome::Fired { transition, settled } => {
            assert!(settled == 0);
            assert!(expected == Some((transition.id.0, tokens(&player))));
        }
        Outcome::Ignored { why } => {
            assert!(expected.is_none() && tokens(&player) == before);
            assert!((why == Why::NoSuchEvent) == (on == 3));
            kani::cover!(matches!(why, Why::Full(_)), "no room");
        }
        Outcome::Refused { .. } => unreachable!(),
    }
    kani::cover!(expected.is_some_and(|it| it.0 == 3), "a weight of two");
    kani::cover!(expected.is_some_and(|it| it.0 == 2), "the second line of an event");
}

/// A firing keeps every declared sum of tokens, from any marking that has it.
#[kani::proof]
#[kani::unwind(7)]
pub fn sums_of_tokens_are_conserved() {
    let before: [u8; 4] = any_tokens(&buffer::NET);
    let [idle, busy, stock, done] = before;
    kani::assume(idle + busy == 1 && stock + busy + done == 3);
    let mut player = at(buffer::Program, &before);
    let _ = player.offer_id(Millis(0), event(few::<2>()), (), &mut ());
    let after: [u8; 4] = tokens(&player);
    assert!(after[0] + after[1] == 1 && after[2] + after[1] + after[3] == 3);
    kani::cover!(after != before && before[1] == 1, "from work to done");
}

/// An ignored event leaves marking and clocks as they were, and the reason is right: an event of
/// another net, no tokens, or no room.
#[kani::proof]
#[kani::unwind(7)]
pub fn an_ignored_event_changes_nothing() {
    let before: [u8; 4] = any_tokens(&buffer::NET);
    let mut player = at(Checked(buffer::Program), &before);
    let (on, was) = (few::<2>(), player);
    let said = player.offer_id(Millis(0), event(on), (), &mut ());
    let Outcome::Ignored { why } = said else {
        kani::assume(false);
        return;
    };
    assert!(player == was);
    let has = |it: &crate::net::Transition<'_>| {
        let own = it.on.is_some_and(|it| it.0 == u32::from(on));
        let arcs = it.take.iter().chain(it.read);
        own && arcs.into_iter().all(|arc| u32::from(before[arc.place.0 as usize]) >= arc.weight)
    };
    let has_tokens = buffer::NET.transitions.iter().any(has);
    match why {
        Why::NoSuchEvent => assert!(on == 3),
        Why::Full(_) => assert!(has_tokens),
        Why::NotEnabled => assert!(!has_tokens && on < 3),
        _ => unreachable!(),
    }
    kani::cover!(has_tokens, "no room");
    kani::cover!(why == Why::NotEnabled, "no tokens");
}

/// A net settles within the bound that its laws have shown, and nothing that fires by itself is
/// left to fire.
#[kani::proof]
#[kani::unwind(9)]
pub fn settling_ends_within_its_bound() {
    let before: [u8; 4] = any_tokens(&relay::NET);
    kani::assume(before == [2, 0, 0, 0] || before == [1, 0, 0, 1] || before == [0, 0, 0, 2]);
    let mut player = at(relay::Program, &before);
    let on = few::<1>();
    let said = player.offer_id(Millis(0), event(on), (), &mut ());
    let after: [u8; 4] = tokens(&player);
    assert!(after[1] == 0 && after[2] == 0 && after[0] + after[3] == 2);
    if let Outcome::Fired { settled, .. } = said {
        assert!(settled == if on == 0 { 2 } else { 0 });
        assert!(settled <= relay::KNOWN.settle());
    }
    kani::cover!(after == [0, 0, 0, 2] && on == 0, "both have come");
}

/// From any marking, reached or not, a checked net settles: all that was on the way has come where
/// there is room, and every firing that was told moved one token one place on.
#[kani::proof]
#[kani::unwind(11)]
pub fn a_checked_net_settles_from_anywhere() {
    let before: [u8; 4] = any_tokens(&relay::NET);
    let mut player = at(Checked(relay::Program), &before);
    let mut moved = 0;
    let mut count = |_: &crate::player::Firing<'_, Checked<relay::Program>>| moved += 1;
    let advanced = player.advance_with(Millis(0), &mut count);
    let after: [u8; 4] = tokens(&player);
    let way = |it: [u8; 4]| u32::from(it[1] + 2 * it[2] + 3 * it[3]);
    assert!(!advanced.behind && advanced.fired == moved && way(after) == way(before) + moved);
    assert!(after[0] == before[0] && after.iter().sum::<u8>() == before.iter().sum::<u8>());
    assert!(after[2] == 0 || after[3] == 2);
    assert!(after[1] == 0 || after[2] == 2);
    assert!(player.wake_at().is_none());
    kani::cover!(moved == 4, "two come all the way");
    kani::cover!(after[1] > 0, "full");
}

/// Comparing packed words says what comparing every place says.
#[kani::proof]
#[kani::unwind(7)]
pub fn comparing_words_is_comparing_places() {
    let (has, needs): ([u8; 4], [u8; 4]) = (any_tokens(&buffer::NET), any_tokens(&buffer::NET));
    let player = at(Checked(buffer::Program), &has);
    let code = crate::player::Program::code(&buffer::Program);
    let need = super::marking(&buffer::Program, &needs);
    let each = has.iter().zip(needs).all(|(has, need)| *has >= need);
    assert!(code.holds(player.marking(), &need) == each);
    kani::cover!(each && has != needs, "more than needed");
    kani::cover!(!each && has[2] > needs[2], "enough in one place only");
}

/// A synchronous step of transitions that share no place is every interleaving of them.
#[kani::proof]
#[kani::unwind(7)]
pub fn a_step_without_conflict_is_an_interleaving() {
    let before: [u8; 4] = any_tokens(&twins::NET);
    let (one_event, other_event) = (twins::Event::left, twins::Event::right);
    let player = at(Checked(twins::Program), &before);
    let (mut step, mut one, mut other) = (player, player, player);
    let stepped = step.step(Millis(0), &[one_event, other_event]);
    let fired =
        [one.offer(Millis(0), &one_event).fired(), one.offer(Millis(0), &other_event).fired()];
    let turned =
        [other.offer(Millis(0), &other_event).fired(), other.offer(Millis(0), &one_event).fired()];
    assert!(one.marking() == other.marking() && fired == [turned[1], turned[0]]);
    if stepped.full {
        assert!(step == player);
    } else if before[2] < 3 || before[3] == 0 {
        // Otherwise both transitions on one event fire in the step.
        assert!(step.marking() == one.marking());
        assert!(stepped.fired == u32::from(fired[0]) + u32::from(fired[1]));
        assert!(stepped.ignored == u64::from(!fired[0]) + 2 * u64::from(!fired[1]));
    }
    kani::cover!(fired == [true, true] && !stepped.full, "both");
    kani::cover!(fired == [true, false] && stepped.ignored == 2, "one is ignored");
}
