//! Harnesses for the symbolic executor, each as an exported function. Their inputs come from
//! `proof_any32`, and a panic goes to an address where nothing is: the executor watches both.
#![no_std]

#[path = "../../run/src/canaries.rs"]
#[allow(dead_code, reason = "the other canaries are for the engine that runs harnesses")]
mod canaries;

use core::panic::PanicInfo;

unsafe extern "C" {
    /// Stands at an address that the linker is told.
    safe fn a_panic_can_be_reached() -> !;
}

#[panic_handler]
fn stop(_: &PanicInfo<'_>) -> ! {
    a_panic_can_be_reached()
}

/// The names are those of the harnesses, with `__` for `::`.
macro_rules! harnesses {
    ($($export:ident: $($harness:ident)::+;)+) => { $(
        #[unsafe(no_mangle)]
        pub extern "C" fn $export() {
            $($harness)::+();
        }
    )+ };
}

harnesses! {
    proof_canary_one_case: canaries::canary_one_case;
    proof_canary_wide: canaries::canary_wide;
    proof_units__units__sums_never_wrap: cotama_core::units::proofs::sums_never_wrap;
    proof_units__units__differences_never_wrap: cotama_core::units::proofs::differences_never_wrap;
    proof_units__units__microseconds_are_a_thousand_to_the_millisecond:
        cotama_core::units::proofs::microseconds_are_a_thousand_to_the_millisecond;
    proof_allocation__hardware__covering_is_comparing_all_kinds:
        cotama_core::hardware::proofs::covering_is_comparing_all_kinds;
    proof_allocation__hardware__covering_is_comparing_every_kind:
        cotama_core::hardware::proofs::covering_is_comparing_every_kind;
    proof_allocation__monitor__margins_are_exact: cotama_core::monitor::proofs::margins_are_exact;
    proof_allocation__monitor__spending_adds_up_or_changes_nothing:
        cotama_core::monitor::proofs::spending_adds_up_or_changes_nothing;
    proof_allocation__monitor__a_plan_gets_the_rest_of_each_limit:
        cotama_core::monitor::proofs::a_plan_gets_the_rest_of_each_limit;
    proof_allocation__problem__an_order_names_every_axis_once:
        cotama_core::problem::proofs::an_order_names_every_axis_once;
    proof_executive__the_latest_is_read_with_its_age:
        cotama_core::executive::proofs::the_latest_is_read_with_its_age;
    proof_assignment__a_cost_is_its_number: cotama_core::team::proofs::a_cost_is_its_number;
    proof_nets__player__executor__comparing_words_is_comparing_places:
        cotama_core::player::proofs::comparing_words_is_comparing_places;
    proof_nets__player__executor__sums_of_tokens_are_conserved:
        cotama_core::player::proofs::sums_of_tokens_are_conserved;
    proof_nets__player__timing__an_event_has_its_interval:
        cotama_core::player::proofs::an_event_has_its_interval;
    proof_nets__player__timing__a_due_transition_fires_at_its_due_time:
        cotama_core::player::proofs::a_due_transition_fires_at_its_due_time;
    proof_nets__player__snapshots__a_snapshot_of_another_net_is_refused:
        cotama_core::player::proofs::a_snapshot_of_another_net_is_refused;
}
