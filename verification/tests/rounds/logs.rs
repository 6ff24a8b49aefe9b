//! The logs that robots write, held against their nets: names of lines, late reports, events and
//! outputs alone, what no log shows.

use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Net, TransitionId};
use cotama_core::system::{Component, System};
use cotama_core::units::Millis;
use cotama_core::{net, system};
use cotama_verification::conform::{Options, Recording, Verdict, conform};

net! {
    /// Stops when nothing is heard.
    pub mod gate {
        places { Stopped: 1, Slow, Fast, Lost }
        flags { armed }
        counters { missed: 0 of 2 }
        events { heard, start, faster, arm }
        outputs { motors_on, motors_off }
        groups { Moving: Slow & Fast; }
        transitions {
            arm     on arm: Stopped => Stopped do armed = true;
            start   on start [armed]: Stopped => Slow emit motors_on;
            faster  on faster: Slow => Fast;
            still   on heard: Moving => Stopped do missed = 0 & armed = false emit motors_off;
            miss    [missed < 2]: Slow => Slow do missed += 1 within 100..=120 ms;
            lose    [missed == 2]: Slow => Lost emit motors_off;
            recover on heard: Lost => Stopped do missed = 0;
        }
    }
}

fn judged(net: &Net<'_>, text: &str, options: Options<'_>) -> Verdict {
    let recording = Recording::read("log", text).unwrap_or_else(|it| panic!("{it}"));
    conform(&System::alone(&[Component::alone(net)]), &recording, options).unwrap()
}

/// Lines as `0 event arm`, and the header when it is one.
fn lines(text: &str) -> String {
    let line = |line: &str| match line.trim().split(' ').collect::<Vec<_>>()[..] {
        [at, kind @ ("round" | "end")] => format!("{{\"t_ms\":{at},\"{kind}\":true}}"),
        [at, kind, name] => format!("{{\"t_ms\":{at},\"{kind}\":\"{name}\"}}"),
        _ => line.trim().to_owned(),
    };
    text.split(", ").map(line).collect::<Vec<_>>().join("\n")
}

fn reason(text: &str) -> Option<String> {
    judged(&gate::NET, &lines(text), Options::default()).departs.map(|it| it.reason)
}

#[test]
fn the_name_of_a_line_stands_for_that_of_its_transitions_which_is_enabled() {
    for told in [
        "0 event arm, 0 fired arm, 5 event start, 5 fired start, 9 event heard, 9 fired still",
        "0 event arm, 0 fired arm, 1 event arm, 1 fired arm, 2 event start, 2 fired start",
        "0 event arm, 0 fired arm, 5 event start, 5 fired start, 6 event faster, 6 fired faster, \
         9 event heard, 9 fired still",
        "0 event arm, 0 fired arm, 5 event start, 5 fired start, 107 fired miss, 110 event heard, \
         110 fired still",
        "0 event arm, 0 fired arm, 5 event start, 5 fired start, 107 fired miss, 220 fired miss, \
         220 fired lose, 300 event heard, 300 fired recover",
    ] {
        assert_eq!(reason(told), None, "{told}");
    }
    let wrong = "0 event arm, 0 fired arm, 5 event start, 5 fired still";
    let said = "`still` fired, and before it `start` had to fire on `start` at 5 ms";
    assert_eq!(reason(wrong).as_deref(), Some(said));
}

#[test]
fn an_ambiguous_line_is_followed_on_all_paths() {
    // Either of two transitions of a group may have gone; what comes later tells which.
    let mut net = OwnedNet::new("pick", "");
    let [left, right] = ["left", "right"].map(|it| net.place(OwnedPlace::new(it, 1)).unwrap());
    let [a, b] = ["a", "b"].map(|it| net.place(OwnedPlace::new(it, 0)).unwrap());
    let of = |name: &str, from, to| OwnedTransition::new(name).take(from, 1).give(to, 1);
    net.transition(of("take.left", left, a)).unwrap();
    net.transition(of("take.right", right, b)).unwrap();
    net.transitions[1].line = 0;
    net.transition(of("done_a", a, left)).unwrap();
    net.transition(of("done_b", b, right)).unwrap();
    let view = net.view();
    let departs = |text: &str| {
        judged(&view.net(), &lines(text), Options::default()).departs.map(|it| it.line)
    };
    assert_eq!(departs("1 fired take, 2 fired done_b"), None);
    assert_eq!(departs("1 fired take, 2 fired done_a, 3 fired take, 4 fired done_b"), None);
    assert_eq!(departs("1 fired take, 1 fired take, 2 fired done_b, 2 fired done_a"), None);
    assert_eq!(departs("1 fired take.left, 2 fired done_b"), Some(2));
    assert_eq!(departs("1 fired take, 2 fired done_a, 3 fired done_b"), Some(3));
    assert_eq!(departs("1 fired take, 1 fired take, 1 fired take"), Some(3));
}

#[test]
fn a_line_reported_late_counts_at_its_own_time() {
    let begin = "0 event arm, 0 fired arm, 5 event start, 5 fired start";
    for late in [
        "450 event heard, 105 fired miss, 205 fired miss, 205 fired lose, 450 fired recover",
        "110 event heard, 105 fired miss, 110 fired still",
        "300 end, 300 end",
        "115 event heard, 115 fired miss, 115 fired still",
        "450 event faster, 120 fired miss, 230 fired miss, 230 fired lose, 460 event heard, \
         460 fired recover",
    ] {
        let text = format!("{begin}, {late}");
        if late.ends_with("end") {
            assert!(Recording::read("log", &lines(&text)).is_err());
        } else {
            assert_eq!(reason(&text), None, "{text}");
        }
    }
    let early = format!("{begin}, 450 event heard, 100 fired miss");
    assert!(reason(&early).unwrap().contains("too early"), "{:?}", reason(&early));
    let late = format!("{begin}, 450 event heard, 140 fired miss");
    assert!(reason(&late).unwrap().contains("too late"), "{:?}", reason(&late));
    // An event that goes back, and firings in another order, are in no order.
    for wrong in ["9 event start, 8 event arm", "9 event arm, 9 fired arm, 8 fired arm"] {
        let error = Recording::read("log", &lines(wrong)).unwrap_err().to_string();
        assert!(error.contains("the time goes back from 9 ms to 8 ms"), "{error}");
    }
}

#[test]
fn of_events_and_outputs_alone_all_that_may_have_fired_is_searched() {
    let begin = "0 event arm, 5 event start, 5 output motors_on";
    for told in [
        "",
        ", 60 event heard, 60 output motors_off",
        ", 205 output motors_off",
        ", 245 output motors_off",
        ", 221 output motors_off, 300 event heard, 301 event arm, 302 event start, \
         302 output motors_on",
        ", 110 event heard, 110 output motors_off, 400 end",
    ] {
        assert_eq!(reason(&format!("{begin}{told}")), None, "{told}");
    }
    let says = |more: &str, said: &str| {
        let reason = reason(&format!("{begin}{more}"));
        assert!(reason.as_ref().is_some_and(|it| it.contains(said)), "{more}: {reason:?}");
    };
    says(", 204 output motors_off", "`motors_off` is said at 204 ms, and nothing says it here");
    says(", 246 output motors_off", "had to");
    says(", 400 end", "had to");
    says(", 60 event heard, 61 end", "`still.Slow.missed_0.armed_1` had to say `motors_off`");
    says(", 6 output motors_on", "nothing says it here");
    assert!(reason("0 event start, 0 output motors_on").is_some());
    // Without any output it has to be said that firings are not recorded.
    let header = r#"{"schema":"cotama-recording/1","firings":false}"#;
    assert_eq!(reason(&format!("{header}, 0 event arm, 4 event arm")), None);
    assert!(reason("0 event arm, 4 event arm").is_some());
}

#[test]
fn with_too_many_states_the_answer_is_unknown_and_never_wrong() {
    let begin = "0 event arm, 5 event start, 5 output motors_on";
    let text = |more: &str| lines(&format!("{begin}{more}"));
    let judged = |more: &str, most_states: usize| {
        let options = Options { most_states, ..Options::default() };
        let verdict = judged(&gate::NET, &text(more), options);
        (verdict.departs.is_some(), verdict.unknown.is_some())
    };
    for most in [1, 2, 5, 20, 100] {
        let answer = judged(", 240 output motors_off", most);
        assert!(!answer.0, "{most}");
        let answer = judged(", 246 output motors_off", most);
        assert!(answer.0 || answer.1, "{most}");
    }
    assert_eq!(judged(", 246 output motors_off", 3), (false, true));
    assert_eq!(judged(", 246 output motors_off", 10_000), (true, false));
    assert_eq!(judged(", 240 output motors_off", 10_000), (false, false));
}

#[test]
fn an_invisible_transition_may_fire_unrecorded_or_be_recorded() {
    let mut net = OwnedNet::new("steps", "");
    let place = |net: &mut OwnedNet, at: usize| {
        net.place(OwnedPlace::new(&format!("p{at}"), u32::from(at == 0))).unwrap()
    };
    let places: Vec<_> = (0..5).map(|at| place(&mut net, at)).collect();
    for (at, name) in ["weld", "tau", "tau_2", "paint"].iter().enumerate() {
        let it = OwnedTransition::new(name).take(places[at], 1).give(places[at + 1], 1);
        net.transition(it).unwrap();
    }
    let again = OwnedTransition::new("again").take(places[4], 1).give(places[0], 1);
    net.transition(again).unwrap();
    let view = net.view();
    let invisible = [TransitionId(1), TransitionId(2), TransitionId(4)];
    let departs = |text: &str, invisible: &[TransitionId]| {
        let options = Options { invisible, ..Options::default() };
        judged(&view.net(), &lines(text), options).departs.map(|it| it.line)
    };
    for told in [
        "1 fired weld, 2 fired paint",
        "1 fired weld, 1 fired tau, 2 fired paint",
        "1 fired weld, 1 fired tau_2, 2 fired paint",
        "1 fired weld, 2 fired tau, 2 fired tau_2, 2 fired paint, 2 fired again",
        "1 fired weld, 2 fired paint, 3 fired weld, 4 fired paint",
    ] {
        assert_eq!(departs(told, &invisible), None, "{told}");
    }
    assert_eq!(departs("1 fired weld, 2 fired paint", &[]), Some(2));
    assert_eq!(departs("1 fired paint", &invisible), Some(1));
    assert_eq!(departs("1 fired weld, 2 fired tau_2, 3 fired tau", &invisible), Some(3));
    // The header can say so as well, with the names of lines or of nets.
    let silent = r#"{"schema":"cotama-recording/1","silent":["tau","tau_2"]}"#;
    assert_eq!(departs(&format!("{silent}, 1 fired weld, 2 fired paint"), &[]), None);
}

net! {
    pub mod link {
        places { Up: 1, Down }
        events { heard }
        outputs { lost }
        transitions {
            still on heard: Up => Up;
            lose: Up => Down emit lost within 500..=500 ms;
        }
    }
}
net! {
    pub mod drive {
        places { Stopped: 1, Running }
        events { start, halt }
        outputs { on, off }
        transitions {
            start on start: Stopped => Running emit on;
            halt on halt: Running => Stopped emit off;
        }
        ignore { halt in Stopped; }
    }
}
system! {
    pub mod robot {
        nets { link: link, drive: drive }
        links { link.lost => drive.halt mail 1; }
    }
}

#[test]
fn a_system_is_held_against_events_and_outputs_and_its_rounds() {
    let departs = |text: &str| {
        let recording = Recording::read("log", &lines(text)).unwrap();
        let verdict = conform(&robot::SYSTEM, &recording, Options::default()).unwrap();
        verdict.departs.map(|it| it.reason)
    };
    let start = "10 event drive.start, 10 output drive.on";
    assert_eq!(departs(&format!("{start}, 500 output drive.off")), None);
    assert_eq!(departs(&format!("{start}, 300 event link.heard, 800 output drive.off")), None);
    let said = departs(&format!("{start}, 300 event link.heard, 500 output drive.off"));
    assert!(said.unwrap().contains("`drive.off` is said at 500 ms"));
    // An output that another net hears may be recorded, then each time.
    let heard = "500 output link.lost, 500 output drive.off";
    assert_eq!(departs(&format!("{start}, {heard}")), None);
    let rounds = r#"{"schema":"cotama-recording/1","round_every_ms":200}"#;
    assert_eq!(departs(&format!("{rounds}, {start}, 600 output drive.off")), None);
    assert!(departs(&format!("{rounds}, {start}, 500 output drive.off")).is_some());
    // The link's firings are not recorded, the drive's are.
    let silent = r#"{"schema":"cotama-recording/1","silent":["link"]}"#;
    let run = "10 event drive.start, 10 fired drive.start, 500 fired drive.halt, 600 end";
    assert_eq!(departs(&format!("{silent}, {run}")), None);
    assert!(departs(run).unwrap().contains("`drive.halt` fired, and nothing made it fire"));
}

#[test]
fn a_tolerance_lets_outputs_be_late_and_intervals_be_wide() {
    let text = lines("0 event arm, 5 event start, 8 output motors_on, 251 output motors_off");
    let departs = |tolerance: u64| {
        let options = Options { tolerance: Millis(tolerance), ..Options::default() };
        judged(&gate::NET, &text, options).departs.map(|it| it.line)
    };
    assert_eq!((departs(0), departs(2), departs(3)), (Some(3), Some(3), None));
}
