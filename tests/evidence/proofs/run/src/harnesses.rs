//! Every harness, and whether its inputs are few enough to try all of them.

use kani::Harness;

/// The words of the stand-in for a harness.
#[derive(Clone, Copy)]
pub(crate) enum Word {
    /// All inputs are run.
    Exhaustive,
    /// Some of them are.
    Sampled,
}

/// A harness, and what is promised of it.
pub(crate) struct Listed {
    pub(crate) harness: Harness,
    pub(crate) word: Word,
}

macro_rules! list {
    ($all:ident, $room:ident $(:: $in:ident)* { $( $word:ident: $($harness:ident)* ; )* }) => {{
        use $room $(:: $in)* ::proofs as room;
        $( $( $all.push(Listed {
            harness: room::$harness::HARNESS,
            word: Word::$word,
        }); )* )*
    }};
}

/// All of them, by room.
pub(crate) fn all() -> Vec<Listed> {
    let mut all = canaries();
    core(&mut all);
    #[cfg(feature = "models")]
    models(&mut all);
    #[cfg(feature = "verification")]
    verification(&mut all);
    all
}

fn canaries() -> Vec<Listed> {
    use crate::canaries;
    let canary = |harness, word| Listed { harness, word };
    vec![
        canary(canaries::canary_one_case::HARNESS, Word::Exhaustive),
        canary(canaries::canary_wide::HARNESS, Word::Sampled),
        canary(canaries::canary_vacuous::HARNESS, Word::Exhaustive),
        canary(canaries::canary_uncovered::HARNESS, Word::Exhaustive),
    ]
}

fn core(all: &mut Vec<Listed>) {
    list!(all, cotama_core::units {
        Exhaustive: quotients_of_small_numbers_are_rounded_half_up
            slower_or_further_takes_no_less_time;
        Sampled: sums_never_wrap differences_never_wrap
            microseconds_are_a_thousand_to_the_millisecond
            quotients_of_wide_numbers_are_rounded_half_up energy_is_power_times_time;
    });
    list!(all, cotama_core::hardware {
        Exhaustive: covering_is_comparing_every_kind a_union_is_the_least_that_covers_both
            losing_units_touches_no_other_kind;
        Sampled: covering_is_comparing_all_kinds;
    });
    list!(all, cotama_core::monitor {
        Exhaustive: a_plan_gets_the_rest_of_each_limit a_plan_that_does_not_hold_is_reported
            going_up_is_paid_for going_up_does_not_flap;
        Sampled: margins_are_exact spending_adds_up_or_changes_nothing;
    });
    list!(all, cotama_core::problem {
        Exhaustive: an_order_names_every_axis_once totals_are_sums;
    });
    list!(all, cotama_core::panorama {
        Exhaustive: every_plan_is_within_the_limits with_one_limit_the_rule_is_complete
            the_last_activity_is_lowered_first;
        Sampled: it_ends;
    });
    list!(all, cotama_core::exact {
        Exhaustive: the_best_plan_is_found_or_there_is_none the_bound_holds_whatever_the_budget
            a_dominated_candidate_changes_nothing;
    });
    list!(all, cotama_core::front {
        Exhaustive: the_front_has_the_points_that_nothing_beats too_little_memory_is_said;
    });
    list!(all, cotama_core::executive {
        Exhaustive: a_watchdog_moves_as_its_net the_most_urgent_has_the_processor
            due_events_happen_in_order response_times_are_those_of_the_critical_instant
            the_most_cost_is_exact a_task_proven_in_time_is_in_time
            requests_take_effect_as_documented;
        Sampled: the_latest_is_read_with_its_age;
    });
    list!(all, cotama_core::team {
        Exhaustive: a_table_under_a_limit_has_the_costs_within
            an_assignment_is_the_least_and_is_proven shortest_paths_assign_the_least
            a_wide_assignment_is_the_least_and_is_proven a_proof_that_is_accepted_is_true
            a_bottleneck_is_the_least the_two_nearest_are_found the_two_nearest_of_many_are_found
            a_coalition_is_the_cheapest;
        Sampled: a_cost_is_its_number;
    });
    list!(all, cotama_core::team::winners {
        Exhaustive: all_tasks_at_once_cost_the_least
            the_bound_of_all_tasks_holds_whatever_the_budget;
    });
    list!(all, cotama_core::player {
        Exhaustive: an_event_fires_the_transition_of_the_textbook sums_of_tokens_are_conserved
            an_ignored_event_changes_nothing an_ignored_event_leaves_clocks_alone
            an_event_is_ignored_for_the_reason_that_is_said settling_ends_within_its_bound
            a_checked_net_settles_from_anywhere comparing_words_is_comparing_places
            a_step_without_conflict_is_an_interleaving
            time_can_be_told_in_any_portions the_player_wakes_when_something_fires
            a_due_transition_fires_at_its_due_time an_event_has_its_interval time_does_not_go_back
            clocks_stop_at_their_caps
            nothing_is_lost_or_overtaken a_refused_event_leaves_no_trace
            the_order_of_turns_is_no_matter_without_conflict
            a_round_empties_the_mailboxes_that_waited
            a_restored_system_is_the_same a_restored_clock_is_the_same
            only_possible_states_are_restored a_damaged_snapshot_is_not_read
            the_executor_refines_the_textbook;
        Sampled: a_snapshot_of_another_net_is_refused;
    });
}

#[cfg(feature = "models")]
fn models(all: &mut Vec<Listed>) {
    list!(all, cotama_models::level {
        Exhaustive: a_diagnosis_needs_a_new_flag a_diagnosis_says_as_much_as_the_flags
            news_wait_once_each_in_order the_least_setting_that_holds_is_the_speed
            a_loss_is_back_after_five_seconds_without_it
            more_flags_show_more_and_more_modules_break_less;
    });
    list!(all, cotama_models::nets {
        Exhaustive: the_net_is_the_watchdog_of_the_executive;
    });
    list!(all, cotama_models::team {
        Exhaustive: a_fraction_is_in_lowest_terms fractions_are_ordered a_fraction_is_rounded_up;
        Sampled: two_are_no_likelier_than_one a_pledge_is_within_its_slack;
    });
}

#[cfg(feature = "verification")]
fn verification(all: &mut Vec<Listed>) {
    use cotama_verification as root;
    list!(all, root {
        Exhaustive: executor_and_explorer_see_the_same_steps;
    });
    list!(all, root::explicit {
        Exhaustive: the_explorer_has_the_steps_of_the_textbook;
    });
    list!(all, root::certificate {
        Exhaustive: a_verdict_by_all_markings_is_true a_trace_shows_its_last_marking
            a_refutation_by_an_inequality_is_true a_refutation_by_a_trap_is_true
            a_run_is_shown_by_itself growth_is_without_end a_refutation_by_a_split_is_true
            a_refutation_by_a_cut_is_true each_or_one_of_several_parts_is_so;
    });
    list!(all, root::pnml {
        Exhaustive: numbers_fit_or_are_refused limits_are_kept any_byte_anywhere_is_answered;
    });
}
