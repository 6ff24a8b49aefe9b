//! Each rule on a net made for it, and on one that just misses its condition.
//!
//! What a rule keeps when a condition is left out is caught here and by the random nets.

use crate::reductions::net::{keep, net, reduced, text};
use crate::reductions::space::{is_dead, run};
use cotama_checker::reductions::Goal::{Bounds, Ctl, Deadlock, Reachability, StutterInvariantLtl};
use cotama_checker::reductions::{
    Effort, Goal, Keep, LiftError, Limits, Reduced, Rule, Tokens, reduce, reduce_within,
};
use cotama_core::net::TransitionId;
use cotama_verification::pt::Pt;

/// Reduces by one rule and compares the net.
fn becomes(before: &str, rule: Rule, goal: Goal, visible: &[&str], after: &str) -> (Pt, Reduced) {
    let before = net(before);
    let reduced = reduced(&before, &[rule], &keep(&before, goal, visible));
    assert_eq!(text(&reduced.net), after, "{}", rule.name());
    (before, reduced)
}

fn stays(before: &str, rule: Rule, goal: Goal, visible: &[&str]) {
    let (_, reduced) = becomes(before, rule, goal, visible, before);
    assert_eq!(reduced.counts, []);
}

fn value(pt: &Pt, reduced: &Reduced, place: &str) -> Option<String> {
    let tokens = reduced.trail.place(pt.place(place).unwrap())?;
    let weight = |&(place, weight): &(cotama_core::net::PlaceId, i64)| {
        format!(" + {weight} {}", reduced.net.places[place.0 as usize])
    };
    Some(format!("{}{}", tokens.constant, tokens.weights.iter().map(weight).collect::<String>()))
}

fn ids(pt: &Pt, names: &str) -> Vec<TransitionId> {
    names.split_whitespace().map(|it| pt.transition(it).unwrap()).collect()
}

fn lifted(pt: &Pt, reduced: &Reduced, names: &str) -> String {
    let run = reduced.trail.lift(pt, &ids(&reduced.net, names)).unwrap();
    run.iter().map(|it| pt.transitions[it.0 as usize].as_str()).collect::<Vec<_>>().join(" ")
}

#[test]
fn transitions_that_take_from_an_unmarked_siphon_are_dead() {
    let rule = Rule::DeadTransition;
    becomes("a:1 b c | t: a -> ; u: b -> c; v: c -> b", rule, Ctl, &[], "a:1 b c | t: a ->");
    stays("a:1 b c | t: a -> b; u: b -> c; v: c -> b", rule, Ctl, &[]);
    // A place that grows may hold any number some time.
    stays("a:1 b | t: ?a -> b; u: b*5 -> a", rule, Ctl, &[]);
    becomes("a:1 b:4 | t: b -> a; u: b*5 -> a", rule, Ctl, &[], "a:1 b:4 | t: b -> a");
}

#[test]
fn a_place_that_does_not_change_enables_or_disables_for_ever() {
    let (before, after) = becomes(
        "a:1 b:1 c | t: a ?b -> c; u: a ?b*2 -> c",
        Rule::ConstantPlace,
        Ctl,
        &["b"],
        "a:1 c | t: a -> c",
    );
    assert_eq!(value(&before, &after, "b").as_deref(), Some("1"));
    assert_eq!(value(&before, &after, "a").as_deref(), Some("0 + 1 a"));
    stays("a:1 b:1 c | t: a ?b -> c; u: b -> c", Rule::ConstantPlace, Ctl, &["b"]);
}

#[test]
fn a_place_that_nothing_takes_from_holds_nothing_up() {
    let rule = Rule::UnlimitedPlace;
    becomes("a:1 b:1 c | t: a b -> b*2 c", rule, Ctl, &["c"], "a:1 c | t: a -> c");
    stays("a:1 b:1 c | t: a ?b*2 -> c; u: -> b", rule, Ctl, &["c"]);
    stays("a:1 b:1 | t: a ?b ->; u: b ->", rule, Ctl, &[]);
    stays("a:1 b | t: a -> b", rule, Ctl, &["b"]);
}

#[test]
fn tokens_that_come_and_go_in_pairs_count_as_pairs() {
    let (before, after) = becomes(
        "a:5 b | t: a*2 -> b*4; u: a*4 b*4 -> a*6",
        Rule::ScaledPlace,
        Ctl,
        &["a"],
        "a:2 b | t: a -> b; u: a*2 b -> a*3",
    );
    assert_eq!(value(&before, &after, "a").as_deref(), Some("1 + 2 a"));
    stays("a:5 b | t: a*2 -> b; u: b -> a*3", Rule::ScaledPlace, Ctl, &["a"]);
}

#[test]
fn a_place_in_proportion_to_another_is_told_from_it() {
    let rule = Rule::ProportionalPlace;
    let (before, after) = becomes(
        "a:1 b c:3 | t: a c*2 -> b; u: b -> a c*2",
        rule,
        Ctl,
        &["c"],
        "a:1 b | t: a -> b; u: b -> a",
    );
    assert_eq!(value(&before, &after, "c").as_deref(), Some("1 + 2 a"));
    // One token less, and it is `c` that holds up.
    becomes(
        "a:1 b c:1 | t: a c*2 -> b; u: b -> a c*2",
        rule,
        Ctl,
        &[],
        "b c:1 | t: c*2 -> b; u: b -> c*2",
    );
    // Seen, `a` would be half of `c`.
    stays("a:1 b c:1 | t: a c*2 -> b; u: b -> a c*2", rule, Ctl, &["a"]);
}

#[test]
fn a_shortcut_past_several_places_is_implied_by_them() {
    let rule = Rule::ImpliedPlace;
    let path = "a:1 b c d | t: a -> b; u: b -> c; v: c -> d";
    let (before, after) =
        becomes("a:1 b c d s | t: a -> b s; u: b -> c; v: c s -> d", rule, Ctl, &["s"], path);
    assert_eq!(value(&before, &after, "s").as_deref(), Some("0 + 1 b + 1 c"));
    // With a token more in `b`, `s` holds up `v`.
    stays("a:1 b:1 c d s | t: a -> b s; u: b -> c; v: c s -> d", rule, Ctl, &["s"]);
    // `u` takes from it as well: it is `a + 2 b + c` and a constant, and without those two
    // `v` waits for it; but then `b` is `c + s` and holds nothing up.
    becomes("a:1 b c d s:2 | t: a -> b s; u: b s -> c; v: c s -> d", rule, Ctl, &["s"], path);
    becomes(
        "a:1 b c d s | t: a -> b s; u: b s -> c; v: c s -> d",
        rule,
        Ctl,
        &["s"],
        "a:1 c d s | t: a -> s; u: s -> c; v: c s -> d",
    );
}

#[test]
fn a_transition_with_the_effect_of_another_goes() {
    let rule = Rule::EqualTransition;
    becomes("a:1 b:1 c | t: a -> c; u: a ?b -> c", rule, Ctl, &["a"], "a:1 b:1 c | t: a -> c");
    stays("a:1 b:1 c | t: a -> c; u: a b -> c", rule, Ctl, &[]);
    stays("a:1 b:1 c d | t: a ?b -> c; u: a ?d -> c", rule, Ctl, &[]);
}

#[test]
fn a_transition_that_repeats_another_is_removed() {
    let rule = Rule::RepeatedTransition;
    let both = "a:4 b | t: a -> b; u: a*2 -> b*2";
    let (before, after) = becomes(both, rule, Reachability, &["b"], "a:4 b | t: a -> b");
    assert_eq!(lifted(&before, &after, "t t"), "t t");
    becomes(both, rule, StutterInvariantLtl, &[], "a:4 b | t: a -> b");
    // There is a marking in between that is seen.
    stays(both, rule, StutterInvariantLtl, &["b"]);
    stays(both, rule, Ctl, &[]);
    stays("a:4 b | t: a*2 -> a b; u: a*2 -> b*2", rule, Reachability, &["b"]);
}

#[test]
fn parts_that_cannot_reach_the_visible_are_cut_off() {
    let before = "a:1 b c:1 d | t: a -> b; u: b -> a; v: c -> d; w: b c -> d; x: ?a ->";
    let after = "a:1 b c:1 | t: a -> b; u: b -> a; w: b c ->";
    becomes(before, Rule::Slice, Reachability, &["b"], after);
    // A transition that only loses tokens that others need does not matter.
    becomes("a:1 b | t: a -> b; u: a ->", Rule::Slice, Bounds, &["b"], "a:1 b | t: a -> b");
    stays("a:1 b | t: a -> b; u: a ->", Rule::Slice, Reachability, &["a", "b"]);
    stays("a:1 b | t: a -> b; u: a ->", Rule::Slice, Deadlock, &["b"]);
}

#[test]
fn an_end_without_a_cycle_comes_to_rest() {
    let rule = Rule::Suffix;
    let (before, after) = becomes(
        "a:1 b c d | t: a -> b; u: b -> a c; v: c -> d",
        rule,
        Deadlock,
        &[],
        "a:1 b | t: a -> b; u: b -> a",
    );
    assert_eq!(lifted(&before, &after, "t u"), "t u v");
    // `c` is on a cycle, so it may never come to rest.
    stays("a:1 b c d | t: a -> b; u: b -> a c; v: c -> d; w: d -> c", rule, Deadlock, &[]);
    // `a` needs something of it.
    stays("a:1 b c d | t: a -> b; u: b ?d -> a c; v: c -> d", rule, Deadlock, &[]);
    stays("a:1 b c | t: a -> b; u: b -> a c; v: ?c ->", rule, StutterInvariantLtl, &[]);
}

#[test]
fn a_transition_without_needs_rules_out_deadlocks() {
    becomes("a:1 b | t: a -> b; u: -> a", Rule::AlwaysEnabled, Deadlock, &[], "a:1 b | u: ->");
    stays("a:1 b | t: a -> b; u: b -> a", Rule::AlwaysEnabled, Deadlock, &[]);
}

#[test]
fn a_place_with_a_source_holds_as_much_as_one_likes() {
    let rule = Rule::Source;
    let (before, after) =
        becomes("a b | s: -> a*2; t: a*3 -> b", rule, Reachability, &["b"], "b | s: ->; t: -> b");
    assert_eq!(lifted(&before, &after, "t t"), "s s t s t");
    stays("a b | s: -> a*2; t: a*3 -> b", rule, Reachability, &["a"]);
    stays("a b | s: -> a*2; t: a*3 -> b", rule, StutterInvariantLtl, &["b"]);
}

#[test]
fn tokens_that_move_freely_on_a_cycle_are_in_one_place() {
    let rule = Rule::FreeCycle;
    let cycle = "a:1 b c:1 d | t: a -> b; u: b -> c; v: c -> a; w: b*2 -> d";
    let (before, after) = becomes(
        cycle,
        rule,
        Reachability,
        &["d"],
        "a:2 d | t: ?a ->; u: ?a ->; v: ?a ->; w: a*2 -> d",
    );
    assert_eq!(lifted(&before, &after, "w"), "t v t w");
    stays(cycle, rule, Reachability, &["c"]);
    stays(cycle, rule, Deadlock, &[]);
    stays("a:1 b | t: a -> b; u: b*2 -> a*2", rule, Reachability, &[]);
}

#[test]
fn post_agglomeration_joins_consumers_to_producers() {
    let rule = Rule::PostAgglomeration;
    let line = "a:1 p b c | h: a -> p; f: p -> b; g: p -> c";
    let (before, after) =
        becomes(line, rule, Deadlock, &["a"], "a:1 b c | h.f: a -> b; h.g: a -> c");
    assert_eq!(lifted(&before, &after, "h.g"), "h g");
    becomes(line, rule, StutterInvariantLtl, &["a"], "a:1 b c | h.f: a -> b; h.g: a -> c");
    stays(line, rule, StutterInvariantLtl, &["a", "b"]);
    stays(line, rule, Reachability, &["a", "p"]);
    // `f` waits for `d`; `p` is read; `f` needs two tokens; there is a choice at the start.
    stays("a:1 d:1 p b | h: a -> p; f: d p -> b; k: d -> a", rule, Deadlock, &["a", "d"]);
    stays("a:1 p b | h: a -> p; f: p -> b; g: ?p b -> a", rule, Deadlock, &["a", "b"]);
    stays("a:1 p b | h: a -> p; f: p*2 -> b", rule, Deadlock, &["a"]);
    stays("a:1 p:1 b c | h: a -> p; f: p -> b; g: p -> c", rule, Deadlock, &["a"]);
    // Two at once may take different ways.
    stays("a:1 p b c | h: a -> p*2; f: p -> b; g: p -> c", rule, Deadlock, &["a"]);
}

#[test]
fn several_tokens_are_taken_one_by_one_and_those_at_the_start_first() {
    let (before, after) = becomes(
        "a:1 p:2 b | h: a -> p*3; f: p -> b; g: b*2 -> a",
        Rule::PostAgglomeration,
        StutterInvariantLtl,
        &["a"],
        "a:1 b:2 | g: b*2 -> a; h.f: a -> b*3",
    );
    assert_eq!(lifted(&before, &after, "h.f"), "f f h f f f");
}

#[test]
fn pre_agglomeration_delays_producers_until_a_token_is_needed() {
    let rule = Rule::PreAgglomeration;
    let joint = "a:1 b:1 p c | h: a -> p; f: b p -> c; g: b -> c; k: c -> a b";
    let (before, after) =
        becomes(joint, rule, Deadlock, &[], "a:1 b:1 c | g: b -> c; k: c -> a b; h.f: a b -> c");
    // In the end `a` has a token of which `h` is still to be made.
    assert_eq!(lifted(&before, &after, "h.f"), "h f");
    let (before, after) = becomes(
        "a:1 b p c | h: a -> p; f: b p -> c; z: b -> c",
        rule,
        Deadlock,
        &["b"],
        "a:1 b c | z: b -> c; h.f: a b -> c",
    );
    assert_eq!(lifted(&before, &after, ""), "h");
    assert!(is_dead(&before, &run(&before, &ids(&before, "h")).unwrap()));
    stays(joint, rule, StutterInvariantLtl, &["a"]);
    // Another wants the token that `h` takes, or one of two; `h` gives elsewhere too, or needs
    // nothing.
    stays("a:1 b:1 p c | h: a -> p; f: b p -> c; k: ?a b -> c", rule, Deadlock, &[]);
    stays("a:1 b:1 d:1 p c | h: a d -> p; f: b p -> c; k: b d -> c", rule, Deadlock, &[]);
    stays("a:1 b:1 p c | h: a -> p c; f: b p -> c", rule, Deadlock, &[]);
    stays("b:1 p c | h: -> p; f: b p -> c", rule, Deadlock, &[]);
    // The two that `f` takes may come from different givers.
    stays("a:1 b:1 d:1 p c | h: a -> p; i: b -> p; f: d p*2 -> c", rule, Deadlock, &[]);
}

#[test]
fn reachability_allows_other_consumers_of_the_needs_of_a_producer() {
    let rule = Rule::FreeAgglomeration;
    let rivals = "a:1 b:1 p c | h: a -> p; f: b p -> c; k: a b -> c";
    let (before, after) =
        becomes(rivals, rule, Reachability, &["c"], "a:1 b:1 c | k: a b -> c; h.f: a b -> c");
    assert_eq!(lifted(&before, &after, "h.f"), "h f");
    stays(rivals, rule, Deadlock, &[]);
    stays(rivals, rule, Reachability, &["a"]);
    stays("a:1 b:1 p c | h: a ?b -> p; f: b p -> c", rule, Reachability, &["c"]);
    stays("a:1 b:1 p:1 c | h: a -> p; f: b p -> c; k: a b -> c", rule, Reachability, &["c"]);
}

#[test]
fn more_transitions_than_before_are_not_made() {
    let cross = "a:1 b:1 c:1 p x y | h: a -> p; i: b -> p; j: c -> p; f: p -> x; g: p -> y";
    stays(cross, Rule::PostAgglomeration, Deadlock, &["a", "b", "c"]);
}

#[test]
fn without_more_work_the_net_is_left_as_far_as_it_is() {
    let before = net("a:1 p b | h: a -> p; f: p -> b");
    let none = Effort { work: 0, ..Effort::default() };
    let after = reduce_within(&before, &Keep::new(Deadlock), &Limits::default(), &none);
    assert_eq!((after.net, after.counts), (before, vec![]));
}

#[test]
fn reductions_end_when_time_is_over() {
    let places = (0..3_000).map(|it| format!("p{it}")).collect::<Vec<_>>().join(" ");
    let steps = (1..3_000).map(|it| format!("t{it}: p{} -> p{it}", it - 1)).collect::<Vec<_>>();
    let before = net(&format!("a:1 {places} | t: a -> p0; {}", steps.join(";")));
    let limits = Limits { deadline: Some(std::time::Instant::now()), ..Limits::default() };
    let after = reduce_within(&before, &Keep::new(Deadlock), &limits, &Effort::default());
    assert!(after.net.places.len() > 10, "{}", after.net.places.len());
}

#[test]
fn a_run_that_is_none_is_not_lifted() {
    let before = net("a:1 p b | h: a -> p; f: p -> b");
    let after = reduced(&before, &[Rule::PostAgglomeration], &keep(&before, Deadlock, &["a"]));
    let twice = ids(&after.net, "h.f h.f");
    assert_eq!(after.trail.lift(&before, &twice), Err(LiftError::NotARun));
    assert_eq!(after.trail.lift(&before, &[TransitionId(9)]), Err(LiftError::NotARun));
}

#[test]
fn doubling_again_and_again_is_too_long_to_lift() {
    let places: Vec<_> =
        (0..31).map(|it| if it == 0 { "p0:1".to_owned() } else { format!("p{it}") }).collect();
    let doubling: Vec<_> = (0..30).map(|it| format!("t{it}: p{it} -> p{}*2", it + 1)).collect();
    let before = net(&format!("{} | {}", places.join(" "), doubling.join(";")));
    let after =
        reduced(&before, &[Rule::PostAgglomeration], &keep(&before, Reachability, &["p30"]));
    assert_eq!(text(&after.net), "p29:536870912 p30 | t29: p29 -> p30*2");
    assert_eq!(after.trail.lift(&before, &[]), Err(LiftError::TooLong));
}

#[test]
fn a_lasso_is_lifted_as_a_lasso() {
    let before = net("s:1 a p b | i: s -> a; h: a -> p; f: p -> b; g: b -> a");
    let keep = keep(&before, StutterInvariantLtl, &["a"]);
    let after = reduce(&before, &keep);
    assert_eq!(text(&after.net), "s:1 a b | i: s -> a; g: b -> a; h.f: a -> b");
    let (stem, cycle) =
        after.trail.lift_lasso(&before, &ids(&after.net, "i"), &ids(&after.net, "h.f g")).unwrap();
    assert_eq!((stem, cycle), (ids(&before, "i"), ids(&before, "h f g")));
    let open = after.trail.lift_lasso(&before, &ids(&after.net, "i"), &ids(&after.net, "h.f"));
    assert_eq!(open, Err(LiftError::NotARun));
}

#[test]
fn a_sum_of_places_is_told_from_the_reduced_net() {
    let before = net("a:1 b c:3 k:7 | t: a c*2 ?k -> b; u: b -> a c*2");
    let after = reduce(&before, &keep(&before, Ctl, &["a", "c", "k"]));
    let sum = |names: &[(&str, i64)], pt: &Pt, constant| Tokens {
        constant,
        weights: names.iter().map(|it| (pt.place(it.0).unwrap(), it.1)).collect(),
    };
    let original = sum(&[("a", -2), ("c", 1), ("k", 3)], &before, 10);
    assert_eq!(after.trail.tokens(&original), Some(Tokens { constant: 32, weights: vec![] }));
}

#[test]
fn ten_thousand_nodes_in_a_ring_are_reduced_to_one_place() {
    let count = 5_000;
    let places: Vec<_> =
        (0..count).map(|it| if it == 0 { "p0:1".to_owned() } else { format!("p{it}") }).collect();
    let moves: Vec<_> =
        (0..count).map(|it| format!("t{it}: p{it} -> p{}", (it + 1) % count)).collect();
    let before = net(&format!("{} | {}", places.join(" "), moves.join(";")));
    let after = reduce(&before, &Keep::new(StutterInvariantLtl));
    assert_eq!((after.net.places.len(), after.net.transitions.len()), (0, 1));
    let (_, cycle) = after.trail.lift_lasso(&before, &[], &[TransitionId(0)]).unwrap();
    assert_eq!(cycle.len(), count);
}
