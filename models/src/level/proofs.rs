//! The decisional level at work: what flags are taken for, what waits to be told, which settings
//! hold, and when a loss is over.

use super::tables::{event, place};
use super::untold::Untold;
use super::*;
use crate::severity::{Persistence, Severity};
use cotama_core::proofs::few;
use cotama_core::units::Millis;

/// The tables of a robot without anything else.
fn tables<'t>(failures: &'t [Failure], losses: &'t [Loss], reports: &'t [Report]) -> Tables<'t> {
    let (no_event, no_place) = (event(0, 0), place(0, 0));
    Tables {
        begins: no_event,
        stopped: no_event,
        gives_up: None,
        before: no_place,
        done: None,
        secures: no_place,
        safe: no_place,
        waits: no_place,
        granted: no_place,
        destroyed: no_place,
        steps: &[],
        sub_objectives: &[],
        configurations: &[],
        losses,
        reports,
        failures,
        masks: &[],
        acting: &[],
    }
}

/// A failure that any of three flags show, or none; the first one also at times.
fn any_failure(report: u8) -> Failure {
    let flags = u64::from(few::<3>());
    let sometimes = if report == 0 { u64::from(few::<3>()) } else { 0 };
    Failure { flags, sometimes, report, worst: Severity::Hard, persistence: Persistence::Permanent }
}

/// A diagnosis needs a new flag: whatever is up, without one nothing is found.
#[kani::proof]
#[kani::unwind(6)]
pub fn a_diagnosis_needs_a_new_flag() {
    let failures = [any_failure(0), any_failure(1), any_failure(2)];
    let up = u64::from(few::<3>());
    assert!(diagnose(&failures, up, 0).is_empty());
    kani::cover!(failures.iter().all(|it| it.flags != 0 && it.flags & !up == 0), "all are up");
}

/// A diagnosis says as much as the flags do: every failure found shows a new flag; if some failure
/// shows all of its flags, each one found does, none found says less than another such failure, and
/// each that is left out says less than one that is found.
#[kani::proof]
#[kani::unwind(6)]
pub fn a_diagnosis_says_as_much_as_the_flags() {
    let failures = [any_failure(0), any_failure(1), any_failure(2)];
    let (up, raised) = (u64::from(few::<3>()), u64::from(few::<3>()));
    kani::assume(raised & !up == 0);
    let found = diagnose(&failures, up, raised);
    let new = |it: usize| (failures[it].flags | failures[it].sometimes) & raised != 0;
    let whole = |it: usize| failures[it].flags & raised != 0 && failures[it].flags & !up == 0;
    let less = |one: usize, other: usize| {
        let (one, other) = (failures[one].flags, failures[other].flags);
        one | other == other && one != other
    };
    let any_is_whole = (0..3).any(whole);
    for it in 0..3 {
        assert!(!found.has(it) || new(it));
        if any_is_whole {
            assert!(!found.has(it) || whole(it));
            assert!(!found.has(it) || !(0..3).any(|other| whole(other) && less(it, other)));
            let is_said = (0..3).any(|other| found.has(other) && less(it, other));
            assert!(!whole(it) || found.has(it) || is_said);
        } else {
            assert!(found.has(it) == new(it));
        }
    }
    let count = (0..3).filter(|it| found.has(*it)).count();
    assert!(found.count() as usize == count);
    kani::cover!(any_is_whole && (0..3).any(|it| new(it) && !whole(it)), "one is not whole");
    kani::cover!(count == 1 && (0..3).all(whole), "one says more than two others");
    kani::cover!(count == 3 && !any_is_whole, "none is whole");
}

/// News wait once each, in the order in which they came, with the first cause; once told they may
/// come again, and what is no report and no return does not wait.
#[kani::proof]
#[kani::unwind(8)]
pub fn news_wait_once_each_in_order() {
    const TOLD: [Told; 7] = [
        Told::Report(0),
        Told::Report(MAX_REPORTS - 1),
        Told::Back(0),
        Told::Back(MAX_LOSSES - 1),
        Told::Report(MAX_REPORTS),
        Told::Back(MAX_LOSSES),
        Told::GivesUp,
    ];
    let mut untold = Untold::default();
    let (mut expected, mut first, mut end) = ([None; 4], 0, 0);
    let mut again = false;
    for step in 0..4 {
        if kani::any() {
            assert!(untold.pop() == if first < end { expected[first] } else { None });
            first = end.min(first + 1);
            continue;
        }
        let it = usize::from(few::<3>());
        kani::assume(it < TOLD.len());
        let is_it = |other: &Option<(Told, Cause)>| other.is_some_and(|other| other.0 == TOLD[it]);
        let waits = expected[first..end].iter().any(is_it);
        again |= expected[..first].iter().any(is_it);
        assert!(untold.has(TOLD[it]) == waits);
        untold.push(TOLD[it], Cause(step));
        if it < 4 && !waits {
            expected[end] = Some((TOLD[it], Cause(step)));
            end += 1;
        }
        kani::cover!(waits, "the same waits");
    }
    kani::cover!(again, "the same was told");
    kani::cover!(end - first == 4, "four wait");
    while first < end {
        assert!(!untold.is_empty() && untold.pop() == expected[first]);
        first += 1;
    }
    assert!(untold.is_empty() && untold.pop().is_none());
}

/// Any mode, or none.
fn any_mode() -> Option<Mode> {
    let operator: Option<bool> = kani::any();
    operator.map(|it| if it { Mode::Operator } else { Mode::Autonomous })
}

/// The speed that settings leave is never above 1,000 and no more than each setting leaves that
/// holds in the mode; it is that of one of them. A setting holds until its failure was not seen for
/// as long as it says.
#[kani::proof]
#[kani::unwind(66)]
pub fn the_least_setting_that_holds_is_the_speed() {
    let any_report = || {
        let speed = [0, 500, 800, 1_000][usize::from(few::<2>())];
        let holds = Millis([0, 1, 3][usize::from(kani::any::<bool>()) + usize::from(few::<1>())]);
        Report {
            event: event(0, 0),
            sets: Some(Setting { speed, mode: any_mode(), holds, mends: false }),
        }
    };
    let reports = [any_report(), any_report()];
    let tables = tables(&[], &[], &reports);
    let mut adapted = Adapted::default();
    let (made, shown): ([bool; 2], [bool; 2]) = (kani::any(), kani::any());
    for (report, _) in made.iter().enumerate().filter(|it| *it.1) {
        adapted.set(report, Millis(0));
    }
    let bit = |set: [bool; 2]| u64::from(set[0]) | u64::from(set[1]) << 1;
    adapted.see(bit(shown), 0, Millis(1));
    let (now, mode) = (Millis(1 + u64::from(few::<2>())), any_mode());
    let holding = adapted.holding(&tables, now);
    let speed = adapted.speed(&tables, now, mode);
    assert!(speed <= 1_000);
    let mut is_of_one = speed == 1_000;
    for it in 0..2 {
        let Some(setting) = reports[it].sets else { unreachable!() };
        let end = u64::from(shown[it]) + setting.holds.0;
        let holds = made[it] && now.0 < end;
        assert!(holds == (holding >> it & 1 == 1));
        let counts = holds && (setting.mode.is_none() || setting.mode == mode);
        assert!(!counts || speed <= setting.speed);
        is_of_one |= counts && speed == setting.speed;
    }
    assert!(is_of_one && holding >> 2 == 0);
    kani::cover!(holding == 3 && speed == 500, "the least of two");
    kani::cover!(holding == 3 && speed == 1_000, "two that leave all of it, or in another mode");
    kani::cover!(made == [true; 2] && shown == [true; 2] && holding == 1, "one is over");
}

/// A loss is told to be back only when it was known, can come back, is over, and has been over for
/// five seconds; and it is told once.
#[kani::proof]
#[kani::unwind(66)]
pub fn a_loss_is_back_after_five_seconds_without_it() {
    let loss = Loss { place: place(0, 0), modules: 1, back: Some(event(0, 0)) };
    let losses = [loss, Loss { back: None, ..loss }];
    let tables = tables(&[], &losses, &[]);
    let mut adapted = Adapted::default();
    // Whether the first is known and told to be back, and when it was last there.
    let (mut was_known, mut is_told, mut there) = (false, false, Millis(0));
    let mut now = Millis(0);
    for _ in 0..3 {
        now = Millis(now.0 + [0, 1, SOUND_FOR.0 - 1, SOUND_FOR.0][usize::from(few::<2>())]);
        let (known, other, broken): (bool, bool, bool) = (kani::any(), kani::any(), kani::any());
        adapted.see(0, u32::from(broken), now);
        let back = adapted.back(&tables, u32::from(known) | u32::from(other) << 1, now);
        if known && (broken || !was_known) {
            there = now;
        }
        (was_known, is_told) = (known, is_told && known);
        let is_over = known && !broken && !is_told;
        let is_back = is_over && now.0 - there.0 >= SOUND_FOR.0;
        assert!(back == u32::from(is_back));
        let at = Millis(there.0 + SOUND_FOR.0);
        assert!(adapted.returns_at() == if is_over { Some(at) } else { None });
        kani::cover!(known && !broken && is_told, "told, and known still");
        kani::cover!(is_over && !is_back && now.0 > there.0, "over, but not for long");
        if is_back && kani::any() {
            adapted.is_back(0);
            is_told = true;
        }
    }
    kani::cover!(is_told, "back");
}

/// More flags show no fewer reports, and the more modules work, the fewer losses are there: none
/// with all of them.
#[kani::proof]
#[kani::unwind(6)]
pub fn more_flags_show_more_and_more_modules_break_less() {
    let failures = [any_failure(few::<1>()), any_failure(few::<1>())];
    let loss = |it: &Failure| Loss { place: place(0, 0), modules: it.flags, back: None };
    let losses = [loss(&failures[0]), loss(&failures[1])];
    let tables = tables(&failures, &losses, &[]);
    let (some, more) = (u64::from(few::<3>()), u64::from(few::<3>()));
    let all = some | more;
    assert!(tables.shown(some) & !tables.shown(all) == 0);
    assert!(tables.broken(all) & !tables.broken(some) == 0);
    assert!(tables.shown(0) == 0 && tables.broken(u64::MAX) == 0);
    kani::cover!(tables.shown(some) != tables.shown(all), "more is shown");
    kani::cover!(tables.broken(some) != tables.broken(all), "less is there");
}
