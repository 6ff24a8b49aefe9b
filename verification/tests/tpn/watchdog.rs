//! The scheduler's watchdog with the world around it: how late it finds a module that misses its
//! deadlines.

use crate::tpn::bound;
use cotama_core::net;
use cotama_core::net::{Arc, Net, PlaceId};
use cotama_models::nets::watchdog::{self, NET};
use cotama_verification::check::{Model, Options, Verdict, check_all};
use cotama_verification::property;
use cotama_verification::pt::Pt;
use cotama_verification::tpn::{Interval, TimeNet, TimePlace, TimeTransition, from_net};

net! {
    /// The extra time ends with the period, so that no release waits.
    mod within_period extends watchdog { constants { DEADLINE: 80 } }
}
net! {
    /// The first miss is a fault.
    mod impatient extends watchdog { constants { MISSES: 1, DEADLINE: 30, EXTRA: 5 } }
}

/// The watchdog as it is defined, its events tied to a world: jobs are released each period, a
/// release that finds the module at work waits, and a job takes so long, in milliseconds; without a
/// time it hangs.
fn watched(job: Option<Interval>) -> TimeNet {
    with_period(&NET, 100, job)
}

fn with_period(net: &Net<'_>, period: u64, job: Option<Interval>) -> TimeNet {
    let watchdog = from_net(net).unwrap().net;
    let mut places = watchdog.places().to_vec();
    let mut place = |name: &str, initial| {
        places.push(TimePlace { name: name.to_owned(), label: None, initial });
        vec![Arc { place: PlaceId(places.len() as u32 - 1), weight: 1 }]
    };
    let (clock, no_release, release) =
        (place("clock", 1), place("no_release", 1), place("release", 0));
    let (working, done) = (place("working", 0), place("done", 0));
    let mut transitions = watchdog.transitions().to_vec();
    for it in &mut transitions {
        let event = net
            .transitions
            .iter()
            .find(|of| of.name == it.name)
            .unwrap()
            .on
            .map(|on| net.events[on.0 as usize].name);
        match event {
            Some("Release") => {
                it.interval = Interval::NOW;
                it.take.extend(&release);
                it.give.extend(no_release.iter().chain(&working));
            }
            Some("Done") => {
                it.interval = Interval::NOW;
                it.take.extend(&done);
            }
            Some("CsAck") => it.interval = Interval::closed(10, 50),
            // The deadline passes only while the job is under way, and when its extra time is over
            // it is stopped.
            None if it.name.starts_with("w3") => it.read.extend(&working),
            None => it.take.extend(&working),
            Some(other) => panic!("the watchdog has a new event {other}"),
        }
    }
    let mut transition = |name: &str, interval, take: &[&[Arc]], give: &[&[Arc]]| {
        let (take, give) = (take.concat(), give.concat());
        transitions.push(TimeTransition { interval, take, give, ..TimeTransition::new(name) });
    };
    let period = Interval::closed(period, period);
    transition("tick", period, &[&clock, &no_release], &[&clock, &release]);
    transition("tick_kept", period, &[&clock, &release], &[&clock, &release]);
    if let Some(interval) = job {
        transition("job_end", interval, &[&working], &[&done]);
    }
    TimeNet::new("watched".to_owned(), places, transitions).unwrap()
}

#[test]
fn a_module_that_hangs_is_found_out_at_the_end_of_the_third_extra_time() {
    let net = watched(None);
    // The next release waits for the end of the extra time: three times 100 + 20, and once for the
    // third job.
    assert_eq!(bound(&net, "w1", "Fault"), "120..360");
    // From the first deadline on, and from the last.
    assert_eq!(bound(&net, "w3", "Fault"), "20..260");
    assert_eq!(bound(&net, "w7", "Idle"), "10..50");
}

#[test]
fn a_module_that_is_always_late_is_found_out_as_well() {
    // The third late job is a fault when it ends, at the latest when its extra time does.
    let late = watched(Some(Interval::closed(101, 119)));
    assert_eq!(bound(&late, "w1", "Fault"), "101..357");
    let later = watched(Some(Interval::at_least(101)));
    assert_eq!(bound(&later, "w1", "Fault"), "101..360");
}

#[test]
fn a_module_that_is_late_now_and_then_may_never_be_found_out() {
    let net = watched(Some(Interval::closed(60, 140)));
    assert_eq!(bound(&net, "w1", "Fault"), "100..inf"); // done at 100 sharp may be too late
}

#[test]
fn a_module_in_time_is_never_accused() {
    let net = watched(Some(Interval::closed(10, 99)));
    assert_eq!(bound(&net, "w1", "Fault"), "inf..inf");
}

#[test]
fn a_fault_is_found_after_periods_for_all_misses_but_the_last_and_then_deadline_and_extra_time() {
    // (K - 1) T + D + E from the first release, at most; D + E from the last, at least.
    let hangs = with_period(&within_period::NET, 100, None);
    assert_eq!(bound(&hangs, "w1", "Fault"), "100..300");
    let late = with_period(&within_period::NET, 100, Some(Interval::closed(81, 99)));
    assert_eq!(bound(&late, "w1", "Fault"), "81..299");
    let hangs = with_period(&impatient::NET, 50, None);
    assert_eq!(bound(&hangs, "w1", "Fault"), "35..35");
}

/// WD2: from the last miss in a row it takes the extra time, from the first one two periods more:
/// before the next release.
#[test]
fn the_last_miss_is_a_fault_when_its_extra_time_is_over() {
    let hangs = with_period(&within_period::NET, 100, None);
    assert_eq!(bound(&hangs, "w3", "Fault"), "20..220");
}

/// WD1, WD2, WD3 and WD6, whatever jobs take: of the net without time.
#[test]
fn misses_are_counted_and_forgotten_as_promised() {
    for (net, most) in [(NET, 3), (within_period::NET, 3), (impatient::NET, 1)] {
        let promises = [
            // A fault is raised with the last miss alone, and then always.
            format!("AG (Fault -> misses = {most})"),
            format!("AG (Extra & misses < {most} -> AX !Fault)"),
            format!("AG (Extra & misses = {most} -> AX Fault)"),
            format!("AG misses <= {most}"),
            format!("EF misses = {most}"),
            // Back at rest from a job in time, or from a fault, nothing is held against it; from a
            // late one it is.
            "AG (Run | Fault -> AX (Idle -> misses = 0))".to_owned(),
            "AG (Extra -> AX (Idle -> misses > 0))".to_owned(),
        ];
        let pt = Pt::from(&net);
        let promises = promises
            .map(|text| property::parse(&text, &pt).unwrap_or_else(|error| panic!("{error}")));
        for (promise, answer) in
            promises.iter().zip(check_all(&Model::from(&net), &promises, &Options::default()))
        {
            assert_eq!(answer.verdict, Verdict::Holds(true), "{}: {}", net.name, promise.name);
        }
    }
}
