//! Advice of `handles(all)` on 12,000 random nets that break it: the lines to paste make it hold.

use crate::draw::Draw;
use crate::random::{Random, net};
use cotama_core::net::owned::{OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Culprit, EventId, PlaceId, Role, judge};
use cotama_core::player::Packed;

const NETS: usize = 12_000;

/// Returns the compiler's message when a net forgets an event.
fn said(owned: &OwnedNet) -> Option<String> {
    said_of::<1>(owned)
}

/// The same of a net of so many words.
fn said_of<const W: usize>(owned: &OwnedNet) -> Option<String> {
    let view = owned.view();
    let net = view.net();
    let packed = Packed::<W, 9>::alone(&net).unwrap();
    match judge(&net, &packed.code()) {
        Err(violation) if matches!(violation.culprit, Culprit::Unanswered { .. }) => {
            let mut text = String::new();
            violation.write(&net, &packed.code(), &mut text).unwrap();
            Some(text)
        }
        _ => None,
    }
}

/// The pairs of lines as `Go in A & B;`, or of one in a sentence.
fn pasted(owned: &OwnedNet, text: &str) -> Vec<OwnedIgnored> {
    let view = owned.view();
    let net = view.net();
    let event = |name: &str| net.events.iter().position(|it| it.name == name).unwrap() as u32;
    let place = |name: &str| net.places.iter().position(|it| it.name == name).unwrap() as u32;
    let mut all = Vec::new();
    for line in text.lines().filter(|line| line.contains(';') && line.contains(" in ")) {
        let line = line.split("`ignore { ").last().unwrap();
        let Some((name, places)) = line.trim().split(';').next().unwrap().split_once(" in ") else {
            continue;
        };
        let event = EventId(event(name));
        let ignored = |name: &str| match name.strip_suffix(']').map(|it| it.split_once(" [!")) {
            Some(Some((name, flag))) => {
                let guard = PlaceId(place(&format!("not_{flag}")));
                OwnedIgnored::new(event, PlaceId(place(name))).guard(guard, 1)
            }
            _ => OwnedIgnored::new(event, PlaceId(place(name))),
        };
        all.extend(places.split(" & ").map(ignored));
    }
    all
}

#[test]
fn the_lines_to_paste_make_random_nets_handle_all_events() {
    let mut random = Random(Draw::new(25));
    let (mut several, mut one, mut nowhere, mut guarded) = (0, 0, 0, 0);
    for number in 0..NETS {
        let mut owned = net(&mut random);
        owned.laws = vec![OwnedLaw::HandlesAll];
        let Some(text) = said(&owned) else { continue };
        let pairs = pasted(&owned, &text);
        let told = text.lines().find_map(|line| line.trim().strip_prefix("one of "));
        if let Some(told) = told {
            let count: usize = told.split(' ').next().unwrap().parse().unwrap();
            let without = text.matches("// no place is marked").count();
            assert_eq!(count, pairs.len() + without, "{number}: {text}");
            several += 1;
        } else {
            assert!(pairs.len() <= 1, "{number}: {text}");
            one += 1;
        }
        guarded += usize::from(pairs.iter().any(|it| !it.guard.is_empty()));
        owned.ignored.extend(pairs);
        if let Some(rest) = said(&owned) {
            // The remaining pairs cannot be ignored.
            assert!(text.contains("// no place is marked") || told.is_none(), "{number}: {text}");
            assert!(pasted(&owned, &rest).is_empty(), "{number}: {rest}");
            nowhere += 1;
        }
    }
    assert!(several > 1_000 && one > 100 && nowhere > 100, "{several} {one} {nowhere}");
    assert!(guarded > 20, "{guarded}");
}

/// `go` is used in each of 35 places while a flag is set, and forgotten otherwise: 32 are listed
/// with the flag, the rest without.
#[test]
fn of_many_places_that_want_a_guard_the_first_32_are_told_with_it() {
    let places = 35;
    let mut owned = OwnedNet::new("many", "");
    for at in 0..places {
        let place = OwnedPlace::new(&format!("P{at}"), u32::from(at == 0)).at_most(1);
        owned.place(place).unwrap();
    }
    let flag = OwnedPlace { role: Role::Data, ..OwnedPlace::new("flag", 0).at_most(1) };
    let flag = owned.place(flag).unwrap();
    let absent = OwnedPlace { role: Role::Complement(flag), ..OwnedPlace::new("not_flag", 1) };
    let absent = owned.place(absent.at_most(1)).unwrap();
    let [go, next, flip] = ["go", "next", "flip"].map(|it| owned.event(it, "").unwrap());
    for at in 0..places {
        let (here, there) = (PlaceId(at), PlaceId((at + 1) % places));
        let step = |name: &str| OwnedTransition::new(&format!("{name}{at}")).take(here, 1);
        owned.transition(step("go").on(go).read(flag, 1).give(here, 1)).unwrap();
        owned.transition(step("next").on(next).give(there, 1)).unwrap();
    }
    owned.transition(OwnedTransition::new("up").on(flip).take(absent, 1).give(flag, 1)).unwrap();
    owned.transition(OwnedTransition::new("down").on(flip).take(flag, 1).give(absent, 1)).unwrap();
    owned.laws = vec![OwnedLaw::HandlesAll];
    let text = said_of::<2>(&owned).unwrap();
    assert!(text.contains("one of 35 "), "{text}");
    assert_eq!(text.matches("[!flag];").count(), 32, "{text}");
    assert!(text.contains("\n      go in P32;\n      go in P33;\n      go in P34;\n"), "{text}");
}
