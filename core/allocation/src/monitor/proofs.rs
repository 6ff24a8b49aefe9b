//! Margins are exact, requests follow from them, and going up does not flap.

use super::*;
use cotama_units::proofs::few;

/// A monitor of limits, with something used and a plan made.
fn monitor(limits: [u64; 2], used: [u64; 2], order: [usize; 2]) -> Monitor<2> {
    let Ok(mut monitor) = Monitor::new(limits, order) else { unreachable!() };
    let Ok(()) = monitor.spend(&used) else { unreachable!() };
    monitor
}

fn small() -> [u64; 2] {
    [u64::from(few::<2>()), u64::from(few::<2>())]
}

fn any_order() -> [usize; 2] {
    if kani::any() { [0, 1] } else { [1, 0] }
}

/// The margin of every axis is limit less used less rest, exactly, for all amounts that are
/// accepted.
#[kani::proof]
#[kani::unwind(3)]
pub fn margins_are_exact() {
    let limits = [0; 2].map(|_: u64| kani::any_where(|it: &u64| *it <= MAX_AMOUNT));
    let used = [0; 2].map(|_: u64| kani::any_where(|it: &u64| *it <= MAX_AMOUNT));
    let rest: [u64; 2] = kani::any();
    let monitor = monitor(limits, used, [0, 1]);
    let too_much = rest[0] > MAX_AMOUNT || rest[1] > MAX_AMOUNT;
    match monitor.margins(&rest) {
        Ok(margins) => {
            assert!(!too_much);
            for axis in 0..2 {
                let exact = limits[axis] as i128 - used[axis] as i128 - rest[axis] as i128;
                assert!(i128::from(margins[axis]) == exact);
            }
        }
        Err(_) => assert!(too_much),
    }
    kani::cover!(!too_much && limits[0] < used[0], "passed");
    kani::cover!(too_much, "refused");
}

/// Amounts spent add up, or are refused beyond the largest amount, and then nothing is spent.
#[kani::proof]
#[kani::unwind(3)]
pub fn spending_adds_up_or_changes_nothing() {
    let before = kani::any_where(|it: &u64| *it <= MAX_AMOUNT);
    let (more, other): (u64, u64) = (kani::any(), kani::any());
    let mut monitor = monitor([5, 5], [7, before], [0, 1]);
    let told = monitor.spend(&[other, more]);
    let fits = other <= MAX_AMOUNT - 7 && more <= MAX_AMOUNT - before;
    assert!(told.is_ok() == fits);
    let after = if fits { [7 + other, before + more] } else { [7, before] };
    assert!(monitor.used() == after);
    kani::cover!(fits && more > 0, "spent");
    kani::cover!(!fits && more <= MAX_AMOUNT - before, "refused for the other axis");
}

/// The rest of a limit is never below zero, and a plan upwards gets that less the reserve.
#[kani::proof]
#[kani::unwind(3)]
pub fn a_plan_gets_the_rest_of_each_limit() {
    let (limits, used, reserve) = (small(), small(), small());
    let upward = Upward { growth: [1, 1], reserve };
    let monitor = monitor(limits, used, [0, 1]).with_upward(upward);
    for axis in 0..2 {
        let left = limits[axis].max(used[axis]) - used[axis];
        assert!(monitor.left()[axis] == left);
        assert!(monitor.room()[axis] == left.max(reserve[axis]) - reserve[axis]);
    }
    kani::cover!(limits[0] < used[0] && limits[1] > used[1], "one is passed");
}

/// A request names lost hardware first, then the first axis in the order whose margin is below
/// zero; without either, and without upward, the plan is kept.
#[kani::proof]
#[kani::unwind(17)]
pub fn a_plan_that_does_not_hold_is_reported() {
    let (limits, used, rest, order) = (small(), small(), small(), any_order());
    let monitor = monitor(limits, used, order);
    let (needs, has) = (few::<1>(), few::<1>());
    let unit = |count| Equipment::NONE.with(0, count).unwrap_or(Equipment::NONE);
    let lacks = |axis: usize| used[axis] + rest[axis] > limits[axis];
    let said = monitor.assess(&rest, unit(needs), unit(has));
    let expected = if needs > has {
        Request::Down(Trigger::Hardware)
    } else if lacks(order[0]) {
        Request::Down(Trigger::Margin { axis: order[0] })
    } else if lacks(order[1]) {
        Request::Down(Trigger::Margin { axis: order[1] })
    } else {
        Request::Keep
    };
    assert!(said == Ok(expected));
    kani::cover!(expected == Request::Keep, "kept");
    kani::cover!(needs <= has && lacks(0) && lacks(1) && order[0] == 1, "both lack");
}

/// A better plan is asked for exactly when every margin keeps the reserve and some margin has grown
/// by what is asked since the last plan, or hardware has come back.
#[kani::proof]
#[kani::unwind(17)]
pub fn going_up_is_paid_for() {
    let growth = [u64::from(few::<1>()), 2 * u64::from(few::<1>())];
    let reserve = [u64::from(few::<1>()), u64::from(few::<1>())];
    let limits = [4, 4];
    let mut monitor = monitor(limits, [0, 0], [0, 1]).with_upward(Upward { growth, reserve });
    let (planned, spent, rest) = (small(), small(), small());
    let Ok(()) = monitor.planned(&planned) else { unreachable!() };
    let Ok(()) = monitor.spend(&spent) else { unreachable!() };
    let returned = kani::any();
    if returned {
        monitor.hardware_returned();
    }
    let holds = (0..2).all(|axis| spent[axis] + rest[axis] <= limits[axis]);
    let keeps = (0..2).all(|axis| spent[axis] + rest[axis] + reserve[axis] <= limits[axis]);
    // The margin has grown by what the rest fell beyond what was spent.
    let grown =
        |axis: usize| growth[axis] > 0 && planned[axis] >= spent[axis] + rest[axis] + growth[axis];
    let up = keeps && (grown(0) || grown(1) || returned);
    let said = monitor.assess(&rest, Equipment::NONE, Equipment::NONE);
    assert!((said == Ok(Request::Up)) == up);
    assert!((said == Ok(Request::Keep)) == (holds && !up));
    kani::cover!(up && grown(1) && !grown(0) && !returned, "one axis has grown");
    kani::cover!(up && !grown(0) && !grown(1), "hardware is back");
}

/// After an answer to a request, whether a new plan or the old one, nothing is asked again until
/// something was saved: two upward requests are at least one growth apart on some axis.
#[kani::proof]
#[kani::unwind(17)]
pub fn going_up_does_not_flap() {
    let growth = [1 + u64::from(few::<1>()), u64::from(few::<1>())];
    let reserve = [u64::from(few::<1>()), 0];
    let limits = [4, 4];
    let mut monitor = monitor(limits, [0, 0], any_order()).with_upward(Upward { growth, reserve });
    let mut last = small();
    let Ok(()) = monitor.planned(&last) else { unreachable!() };
    if kani::any() {
        monitor.hardware_returned();
    }
    let mut ups = 0;
    for step in 0..3 {
        let rest = [u64::from(few::<1>()) * 2 + few::<1>() as u64, u64::from(few::<1>())];
        let nothing = Equipment::NONE;
        let Ok(said) = monitor.assess(&rest, nothing, nothing) else { unreachable!() };
        if said == Request::Up {
            let saved =
                (0..2).any(|axis| growth[axis] > 0 && last[axis] >= rest[axis] + growth[axis]);
            assert!(saved || ups == 0);
            ups += 1;
        }
        if said != Request::Keep {
            let Ok(()) = monitor.planned(&rest) else { unreachable!() };
            assert!(monitor.assess(&rest, nothing, nothing) != Ok(Request::Up));
            last = rest;
        }
        kani::cover!(ups == 2 && step == 2, "twice");
    }
}
