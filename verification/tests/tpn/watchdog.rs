//! The scheduler's watchdog with the world around it: how late it finds a module that misses its deadlines.

use crate::bound;
use cotama_core::net::{Arc, PlaceId};
use cotama_models::nets::watchdog::NET;
use cotama_verification::tpn::{Interval, TimeNet, TimePlace, TimeTransition, from_net};

const PERIOD: u64 = 100;

/// The watchdog as it is defined, its events tied to a world: jobs are released each period, a release that finds the
/// module at work waits, and a job takes so long, in milliseconds; without a time it hangs.
fn watched(job: Option<Interval>) -> TimeNet {
    let watchdog = from_net(&NET).unwrap().net;
    let mut places = watchdog.places().to_vec();
    let mut place = |name: &str, initial| {
        places.push(TimePlace { name: name.to_owned(), label: None, initial });
        vec![Arc { place: PlaceId(places.len() as u32 - 1), weight: 1 }]
    };
    let (clock, no_release, release) = (place("clock", 1), place("no_release", 1), place("release", 0));
    let (working, done) = (place("working", 0), place("done", 0));
    let mut transitions = watchdog.transitions().to_vec();
    for it in &mut transitions {
        let event = NET
            .transitions
            .iter()
            .find(|of| of.name == it.name)
            .unwrap()
            .on
            .map(|on| NET.events[on.0 as usize].name);
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
            // The deadline passes only while the job is under way, and when its extra time is over it is stopped.
            None if it.name.starts_with("w3") => it.read.extend(&working),
            None => it.take.extend(&working),
            Some(other) => panic!("the watchdog has a new event {other}"),
        }
    }
    let mut transition = |name: &str, interval, take: &[&[Arc]], give: &[&[Arc]]| {
        let (take, give) = (take.concat(), give.concat());
        transitions.push(TimeTransition { interval, take, give, ..TimeTransition::new(name) });
    };
    let period = Interval::closed(PERIOD, PERIOD);
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
    // The next release waits for the end of the extra time: three times 100 + 20, and once for the third job.
    assert_eq!(bound(&net, "w1", "Fault"), "120..360");
    // From the first deadline on, and from the last.
    assert_eq!(bound(&net, "w3", "Fault"), "20..260");
    assert_eq!(bound(&net, "w7", "Idle"), "10..50");
}

#[test]
fn a_module_that_is_always_late_is_found_out_as_well() {
    // Its third late job is a fault when it ends, at the latest when its extra time does.
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
