use super::*;
use proptest::prelude::*;

const ALL: Equipment = Equipment::NONE;

/// With such an order axis 1 was never looked at, and a margin of -990 there was kept.
#[test]
fn an_order_that_does_not_name_every_axis_once_is_refused() {
    for order in [[0, 0], [1, 1], [0, 2], [usize::MAX, 0]] {
        assert_eq!(Monitor::new([10, 10], order), Err(MonitorError::BadOrder));
    }
    for order in [[0, 1], [1, 0]] {
        let mut monitor = Monitor::new([10, 10], order).unwrap();
        monitor.spend(&[0, 1_000]).unwrap();
        assert_eq!(monitor.margins(&[0, 0]), Ok([10, -990]));
        let down = Request::Down(Trigger::Margin { axis: 1 });
        assert_eq!(monitor.assess(&[0, 0], ALL, ALL), Ok(down));
    }
}

#[test]
fn a_lost_unit_is_named_before_a_margin() {
    let mut monitor = Monitor::new([10, 10], [0, 1]).unwrap();
    monitor.spend(&[20, 20]).unwrap();
    let laser = Equipment::NONE.with(0, 1).unwrap();
    assert_eq!(
        monitor.assess(&[0, 0], laser, Equipment::NONE),
        Ok(Request::Down(Trigger::Hardware))
    );
    assert_eq!(
        monitor.assess(&[0, 0], laser, laser),
        Ok(Request::Down(Trigger::Margin { axis: 0 }))
    );
}

#[test]
fn an_exactly_used_limit_is_kept() {
    let mut monitor = Monitor::new([10], [0]).unwrap();
    monitor.spend(&[4]).unwrap();
    assert_eq!(monitor.assess(&[6], ALL, ALL), Ok(Request::Keep));
    assert_eq!(monitor.assess(&[7], ALL, ALL), Ok(Request::Down(Trigger::Margin { axis: 0 })));
}

#[test]
fn overflow_is_refused_and_changes_nothing() {
    let mut monitor = Monitor::new([MAX_AMOUNT], [0]).unwrap();
    monitor.spend(&[MAX_AMOUNT]).unwrap();
    assert_eq!(monitor.spend(&[1]), Err(AmountError { axis: 0 }));
    assert_eq!(monitor.used(), [MAX_AMOUNT]);
    assert_eq!(monitor.margins(&[u64::MAX]), Err(AmountError { axis: 0 }));
    let too_large = MonitorError::Limit(AmountError { axis: 0 });
    assert_eq!(Monitor::new([u64::MAX], [0]), Err(too_large));
}

#[test]
fn upward_needs_the_growth_of_one_axis_and_the_reserve_of_each() {
    let upward = Upward { growth: [5, 50], reserve: [3, 30] };
    let mut monitor = Monitor::new([100, 1_000], [1, 0]).unwrap().with_upward(upward);
    monitor.planned(&[90, 900]).unwrap(); // margins 10 and 100
    for (rest, asked) in [
        ([86, 851], Request::Keep), // each has grown by one less than its growth
        ([85, 900], Request::Up),
        ([90, 850], Request::Up),
        ([97, 850], Request::Up), // 3 are left, the reserve
        ([98, 850], Request::Keep),
        ([85, 970], Request::Up), // 30 are left, the reserve
        ([85, 971], Request::Keep),
        ([101, 1_001], Request::Down(Trigger::Margin { axis: 1 })),
    ] {
        assert_eq!(monitor.assess(&rest, ALL, ALL), Ok(asked), "{rest:?}");
    }
}

#[test]
fn an_axis_with_growth_zero_never_asks_upwards() {
    let upward = Upward { growth: [0, 50], reserve: [0, 0] };
    let mut monitor = Monitor::new([100, 1_000], [0, 1]).unwrap().with_upward(upward);
    monitor.planned(&[90, 900]).unwrap();
    assert_eq!(monitor.assess(&[0, 900], ALL, ALL), Ok(Request::Keep));
    assert_eq!(monitor.assess(&[0, 850], ALL, ALL), Ok(Request::Up));
}

/// Also where a request was refused and the plan is kept: it is noted as planned then.
#[test]
fn margins_grow_from_those_of_the_last_plan() {
    let upward = Upward { growth: [5], reserve: [0] };
    let mut monitor = Monitor::new([100], [0]).unwrap().with_upward(upward);
    monitor.planned(&[90]).unwrap();
    assert_eq!(monitor.assess(&[85], ALL, ALL), Ok(Request::Up));
    monitor.planned(&[85]).unwrap();
    assert_eq!(monitor.assess(&[85], ALL, ALL), Ok(Request::Keep));
    assert_eq!(monitor.assess(&[81], ALL, ALL), Ok(Request::Keep));
    assert_eq!(monitor.assess(&[80], ALL, ALL), Ok(Request::Up));
}

#[test]
fn hardware_that_comes_back_needs_the_reserve_too() {
    let upward = Upward { growth: [5], reserve: [3] };
    let mut monitor = Monitor::new([10], [0]).unwrap().with_upward(upward);
    monitor.planned(&[8]).unwrap();
    monitor.hardware_returned();
    assert_eq!(monitor.assess(&[8], ALL, ALL), Ok(Request::Keep));
    assert_eq!(monitor.assess(&[7], ALL, ALL), Ok(Request::Up));
}

#[test]
fn more_hardware_than_needed_is_no_loss() {
    let monitor = Monitor::new([10], [0]).unwrap();
    let one = Equipment::NONE.with(0, 1).unwrap();
    assert_eq!(monitor.assess(&[1], ALL, one), Ok(Request::Keep));
    assert_eq!(monitor.left(), [10]);
}

#[test]
fn a_passed_limit_leaves_nothing_and_a_failed_sum_leaves_all_axes() {
    let mut monitor = Monitor::new([10, MAX_AMOUNT], [0, 1]).unwrap();
    monitor.spend(&[14, MAX_AMOUNT]).unwrap();
    assert_eq!((monitor.left(), monitor.room()), ([0, 0], [0, 0]));
    assert_eq!(monitor.spend(&[1, 1]), Err(AmountError { axis: 1 }));
    assert_eq!(monitor.used(), [14, MAX_AMOUNT]);
}

#[test]
fn hardware_that_comes_back_is_asked_about_once() {
    let upward = Upward { growth: [5], reserve: [2] };
    let mut monitor = Monitor::new([10], [0]).unwrap().with_upward(upward);
    monitor.planned(&[6]).unwrap();
    assert_eq!(monitor.assess(&[6], ALL, ALL), Ok(Request::Keep));
    monitor.hardware_returned();
    assert_eq!(monitor.assess(&[6], ALL, ALL), Ok(Request::Up));
    assert_eq!(monitor.room(), [8]);
    monitor.planned(&[7]).unwrap();
    assert_eq!(monitor.assess(&[7], ALL, ALL), Ok(Request::Keep));
}

proptest! {
    /// However the rest of the plan moves, upward requests are paid for by savings on an axis,
    /// and leave the reserve of every axis.
    #[test]
    fn upward_requests_cannot_flap_on_three_axes(
        steps in
            prop::collection::vec((0usize..3, [0u64..20, 0u64..20, 0u64..20], 0u64..200), 1..200)
    ) {
        let upward = Upward { growth: [25, 40, 0], reserve: [10, 0, 30] };
        let mut monitor = Monitor::new([2_000; 3], [2, 0, 1]).unwrap().with_upward(upward);
        let mut rest = [100; 3];
        monitor.planned(&rest).unwrap();
        let mut last = monitor.margins(&rest).unwrap();
        for (moved, spent, to) in steps {
            monitor.spend(&spent).unwrap();
            rest[moved] = to;
            let margins = monitor.margins(&rest).unwrap();
            let grown = (0..3).any(|axis| {
                let growth = upward.growth[axis].cast_signed();
                growth > 0 && margins[axis] - last[axis] >= growth
            });
            let kept = (0..3).all(|axis| margins[axis] >= upward.reserve[axis].cast_signed());
            let below = [2, 0, 1].into_iter().find(|&axis| margins[axis] < 0);
            let expected = match below {
                Some(axis) => Request::Down(Trigger::Margin { axis }),
                None if grown && kept => Request::Up,
                None => Request::Keep,
            };
            prop_assert_eq!(monitor.assess(&rest, ALL, ALL), Ok(expected));
            if expected != Request::Keep {
                monitor.planned(&rest).unwrap();
                last = margins;
            }
        }
    }

    /// However the rest of the plan moves, upward requests are paid for by savings.
    #[test]
    fn upward_requests_cannot_flap(
        steps in prop::collection::vec((0u64..20, 0u64..200), 1..200)
    ) {
        let growth = 25;
        let upward = Upward { growth: [growth], reserve: [10] };
        let mut monitor = Monitor::new([2_000], [0]).unwrap().with_upward(upward);
        monitor.planned(&[100]).unwrap();
        let mut last_margin = monitor.margins(&[100]).unwrap()[0];
        for (spent, rest) in steps {
            monitor.spend(&[spent]).unwrap();
            let margin = monitor.margins(&[rest]).unwrap()[0];
            match monitor.assess(&[rest], ALL, ALL).unwrap() {
                Request::Keep => {}
                Request::Up => {
                    prop_assert!(margin - last_margin >= growth.cast_signed() && margin >= 10);
                    monitor.planned(&[rest]).unwrap();
                    last_margin = margin;
                }
                Request::Down(_) => {
                    prop_assert!(margin < 0);
                    monitor.planned(&[rest]).unwrap();
                    last_margin = margin;
                }
            }
        }
    }
}
