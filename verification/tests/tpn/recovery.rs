//! RC2: the hysteresis before a module counts as available again, whatever its observer says and
//! when.

use crate::tpn::bound;
use cotama_core::net;
use cotama_core::net::{Arc, Net, PlaceId};
use cotama_models::cotama::recovery::{self, NET};
use cotama_verification::check::{Model, Options, Verdict, check_all};
use cotama_verification::property;
use cotama_verification::tpn::{Interval, TimeNet, TimePlace, from_net};

net! {
    /// Short, and four times.
    mod often extends recovery { constants { HOLD: 500, RETURNS: 4 } }
}

/// The net with an observer that says when it likes what it likes; `first` and `second` are marked
/// in turns when the module has returned.
fn observed(net: &Net<'_>) -> TimeNet {
    let net = from_net(net).unwrap().net;
    let (mut places, mut transitions) = (net.places().to_vec(), net.transitions().to_vec());
    let mut place = |name: &str, initial| {
        places.push(TimePlace { name: name.to_owned(), label: None, initial });
        Arc { place: PlaceId(places.len() as u32 - 1), weight: 1 }
    };
    let (first, second) = (place("first", 0), place("second", 1));
    let of = |name: &str| net.transition(name).unwrap().0 as usize;
    for name in ["r1", "r2", "r3", "r4"] {
        transitions[of(name)].interval = Interval::at_least(0);
    }
    let mut again = transitions[of("r5")].clone();
    "r5_again".clone_into(&mut again.name);
    for (it, take, give) in
        [(&mut transitions[of("r5")], second, first), (&mut again, first, second)]
    {
        it.take.push(take);
        it.give.push(give);
    }
    transitions.push(again);
    TimeNet::new("observed".to_owned(), places, transitions).unwrap()
}

/// The observer says that it is sound and lost in turns, for so long each.
fn flickering(net: &Net<'_>, sound: u64, lost: u64, hears_breaks: bool) -> TimeNet {
    let net = observed(net);
    let mut transitions = net.transitions().to_vec();
    for it in &mut transitions {
        match it.name.as_str() {
            "r3" => it.interval = Interval::closed(lost, lost),
            "r4" => it.interval = Interval::closed(sound, sound),
            _ => {}
        }
    }
    transitions.retain(|it| hears_breaks || it.name != "r4");
    TimeNet::new("flickering".to_owned(), net.places().to_vec(), transitions).unwrap()
}

#[test]
fn between_two_returns_lies_the_hold_at_least() {
    assert_eq!(bound(&observed(&NET), "r5", "second"), "10000..inf");
    assert_eq!(bound(&observed(&often::NET), "r5", "second"), "500..inf");
}

#[test]
fn a_module_sound_without_a_break_returns_exactly_after_the_hold() {
    assert_eq!(bound(&flickering(&NET, 0, 1_000, false), "r3", "Available"), "10000..10000");
    assert_eq!(bound(&flickering(&NET, 10_001, 1_000, true), "r3", "Available"), "10000..10000");
}

#[test]
fn a_loose_contact_never_returns() {
    for sound in [1_000, 9_999] {
        assert_eq!(bound(&flickering(&NET, sound, 1_000, true), "r3", "Available"), "inf..inf");
    }
}

#[test]
fn a_module_returned_so_many_times_is_lost_for_good_the_next_time() {
    let counted = |net: &Net<'_>, most: u32| {
        let promises = [
            format!("AG returns <= {most}"),
            "AG (Gone -> returns = 0 & AG Gone)".to_owned(),
            "AG (Lost -> returns >= 1 & AX !Available)".to_owned(),
            "AG (Available & returns = 0 -> AX Gone)".to_owned(),
        ];
        let each = (0..=most).flat_map(|left| {
            let less = left.saturating_sub(1);
            [
                format!("AG (Settling & returns = {left} -> AX (Available -> returns = {less}))"),
                format!("AG (!Settling & returns = {left} -> AX returns = {left})"),
            ]
        });
        let promises: Vec<_> = promises.into_iter().chain(each).collect();
        let model = Model::from(net);
        let promises: Vec<_> =
            promises.iter().map(|it| property::parse(it, model.pt()).unwrap()).collect();
        let answers = check_all(&model, &promises, &Options::default());
        answers.iter().all(|it| it.verdict == Verdict::Holds(true))
    };
    assert!(counted(&NET, 2) && counted(&often::NET, 4));
    // Without the count it would not be so.
    let mut transitions = NET.transitions.to_vec();
    let state = |arc: &Arc| arc.place.0 < 4;
    let r5 = transitions.iter_mut().find(|it| it.name.starts_with("r5")).unwrap();
    r5.take = r5.take.iter().copied().filter(state).collect::<Vec<_>>().leak();
    r5.give = r5.give.iter().copied().filter(state).collect::<Vec<_>>().leak();
    assert!(!counted(&Net { transitions: &transitions, ..NET }, 2));
}
