//! The executor refines the semantics of nets: all nets of a small family, packed at run time,
//! against the rule of the textbook.

use crate::net::{Arc, EventId, Net, Place, PlaceId, Role, Signal, Transition};
use crate::player::{Arrays, Loaded, Outcome, Player};
use crate::system::{Component, Of, System};
use cotama_units::proofs::few;
use cotama_units::units::Millis;

/// The bounds of both places.
const BOUNDS: [u32; 2] = [2, 3];
/// Limit at which settling is cut short.
const MOST: u32 = 4;

/// The effect of a transition on the two places.
#[derive(Clone, Copy)]
struct Rule {
    /// Event of the transition; `None` if it fires by itself.
    on: Option<u32>,
    take: [u32; 2],
    /// No place is both taken from and read.
    read: [u32; 2],
    give: [u32; 2],
    priority: i16,
}

/// Arcs of these weights, those of weight zero left out.
fn arcs(weights: [u32; 2]) -> ([Arc; 2], usize) {
    let arc = |place: u32, weight| Arc { place: PlaceId(place), weight };
    match weights {
        [0, 0] => ([arc(0, 0); 2], 0),
        [0, it] => ([arc(1, it); 2], 1),
        [it, 0] => ([arc(0, it); 2], 1),
        [a, b] => ([arc(0, a), arc(1, b)], 2),
    }
}

/// Any arc into a transition: up to `most` are taken, or what is beyond that is read.
fn any_need<const BITS: usize>(most: u32) -> [u32; 2] {
    match u32::from(few::<BITS>()) {
        it if it <= most => [it, 0],
        it => [0, it - most],
    }
}

/// The tokens after a rule, if it can fire: it has what it takes and reads, and there is room for
/// the result.
fn fired(rule: &Rule, tokens: [u32; 2]) -> Option<[u32; 2]> {
    let mut after = tokens;
    for place in 0..2 {
        if tokens[place] < rule.read[place] {
            return None;
        }
        after[place] = tokens[place].checked_sub(rule.take[place])? + rule.give[place];
        if after[place] > BOUNDS[place] {
            return None;
        }
    }
    Some(after)
}

/// The textbook: of the rules on an event, or without one, the one of the highest priority that can
/// fire, of equal ones the first.
fn first(rules: [Rule; 2], on: Option<u32>, tokens: [u32; 2]) -> Option<(u32, [u32; 2])> {
    let turned = rules[1].priority > rules[0].priority;
    let order = if turned { [1, 0] } else { [0, 1] };
    order.into_iter().find_map(|it: u32| {
        let rule = &rules[it as usize];
        let after = fired(rule, tokens).filter(|_| rule.on == on)?;
        Some((it, after))
    })
}

/// For every net of two transitions over two places in every marking, with arcs that take, read and
/// give, the executor answers an event as the textbook does, and lets fire by itself what the
/// textbook lets fire.
#[kani::proof]
#[kani::unwind(9)]
pub fn the_executor_refines_the_textbook() {
    let weights = || [u32::from(few::<1>()), u32::from(few::<1>())];
    let (a, b) = (any_need::<3>(3), any_need::<2>(1));
    let (c, d) = (any_need::<2>(1), any_need::<2>(1));
    let rules = [
        Rule { on: Some(0), take: [a[0], b[0]], read: [a[1], b[1]], give: weights(), priority: 0 },
        Rule {
            on: if kani::any() { Some(0) } else { None },
            take: [c[0], d[0]],
            read: [c[1], d[1]],
            give: weights(),
            priority: i16::from(few::<1>()),
        },
    ];
    let mut tokens = [u32::from(few::<2>()), u32::from(few::<2>())];
    kani::assume(tokens[0] <= BOUNDS[0]);

    let place = |bound| Place { name: "", doc: "", initial: 0, bound, role: Role::Data };
    let places = BOUNDS.map(place);
    let lists = rules.map(|it| (arcs(it.take), arcs(it.read), arcs(it.give)));
    let transition = |at: usize| Transition {
        name: "",
        doc: "",
        line: 0,
        on: rules[at].on.map(EventId),
        take: &lists[at].0.0[..lists[at].0.1],
        read: &lists[at].1.0[..lists[at].1.1],
        give: &lists[at].2.0[..lists[at].2.1],
        emits: &[],
        within: None,
        priority: rules[at].priority,
    };
    let transitions = [transition(0), transition(1)];
    let events = [Signal { name: "", doc: "" }];
    let net = Net {
        name: "",
        doc: "",
        places: &places,
        events: &events,
        outputs: &[],
        transitions: &transitions,
        ignored: &[],
        laws: &[],
    };
    let components = [Component::alone(&net)];
    let system = System::alone(&components);
    let arrays = Arrays::<1, 2, 2, 2, 0, 6, 0, 0, 0, 2, 2, 0, 0, 0, 0, 0, 0, 0>::of(&system);
    let code = arrays.code(MOST, false);
    let marking = [code.fields[0].tokens(tokens[0]) + code.fields[1].tokens(tokens[1])];
    let program = Loaded::<1> { system, code, order: &[] };
    let mut player: Player<_, 1> =
        Player { program, marking, clocks: [], slots: [], now: Millis(0) };

    // A player whose bounds are not proven settles first, and is behind when that does not end.
    let settle = |tokens: &mut [u32; 2]| {
        (0..MOST).find(|_| {
            let next = first(rules, None, *tokens);
            *tokens = next.map_or(*tokens, |it| it.1);
            next.is_none()
        })
    };
    let rested = settle(&mut tokens);
    let said = player.offer_id(Millis(0), Of { component: 0, id: EventId(0) }, (), &mut ());
    let has = |player: &Player<_, 1>| [0, 1].map(|it| player.tokens(PlaceId(it)));
    kani::assume(rested.is_some());
    match (said, first(rules, Some(0), tokens)) {
        (Outcome::Fired { transition, settled }, Some((rule, after))) => {
            assert!(transition.id.0 == rule);
            let mut after = after;
            let ended = settle(&mut after);
            assert!(has(&player) == after);
            assert!(ended.is_none_or(|count| count == settled));
            kani::cover!(settled > 1, "one follows the other");
            kani::cover!(rule == 1, "by priority or as the only one");
            kani::cover!(rules[0].read == [2, 1] && rule == 0, "two places are read");
        }
        (Outcome::Ignored { .. }, None) => {
            assert!(has(&player) == tokens);
            let alone = [Rule { read: [0; 2], ..rules[0] }, rules[1]];
            kani::cover!(first(alone, Some(0), tokens).is_some(), "only what is read lacks");
        }
        _ => unreachable!(),
    }
}
