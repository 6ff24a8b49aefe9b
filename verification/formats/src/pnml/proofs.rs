//! The reader of PNML: limits are limits, numbers that do not fit are refused, nothing panics.

use super::{Limits, read, read_within};
use cotama_core::proofs::few;

/// A net with some places, so many tokens in the first, and an arc of some weight.
fn file(places: usize, tokens: u64, weight: u64) -> String {
    let mut text = String::from("<pnml><net id=\"n\" type=\"ptnet\"><page id=\"g\">");
    for place in 0..places {
        let marking = format!("<initialMarking><text>{tokens}</text></initialMarking>");
        let own = if place == 0 { &marking[..] } else { "" };
        text += &format!("<place id=\"p{place}\">{own}</place>");
    }
    let weight = format!("<inscription><text>{weight}</text></inscription>");
    text +=
        &format!("<transition id=\"t\"/><arc id=\"a\" source=\"p0\" target=\"t\">{weight}</arc>");
    text + "</page></net></pnml>"
}

/// Numbers are read as they are up to the largest of 32 bits, an arc has a weight, and what does
/// not fit is refused, not cut.
#[kani::proof]
#[kani::unwind(40)]
pub fn numbers_fit_or_are_refused() {
    let largest = u64::from(u32::MAX);
    let near = |it: u8| if it < 4 { u64::from(it) } else { largest - 7 + u64::from(it) - 4 };
    let (tokens, weight) = (near(few::<4>()), near(few::<4>()));
    let said = read("", file(1, tokens, weight).as_bytes());
    match said {
        Ok(net) => {
            assert!(u64::from(net.places[0].initial) == tokens && tokens <= largest);
            assert!(u64::from(net.transitions[0].take[0].weight) == weight && weight <= largest);
            kani::cover!(tokens == largest, "the largest number");
        }
        Err(_) => assert!(tokens > largest || weight > largest || weight == 0),
    }
    kani::cover!(tokens == largest + 1, "one more");
}

/// A file is read exactly when it is within its limits: bytes, depth, objects, attributes, texts.
#[kani::proof]
#[kani::unwind(40)]
pub fn limits_are_kept() {
    let (places, kind) = (1 + usize::from(few::<2>()), few::<3>());
    let text = file(places, 1, 1);
    let mut limits = Limits::default();
    // A page and a net hold places, a transition and an arc; the deepest text is that of a marking.
    let needs = match kind {
        0 => text.len(),
        1 => 6,
        2 => 3,
        3 => places + 3,
        _ => 5,
    };
    let given = needs + usize::from(few::<1>()) - usize::from(few::<1>());
    match kind {
        0 => limits.bytes = given,
        1 => limits.depth = given,
        2 => limits.attributes = given,
        3 => limits.objects = given,
        _ => limits.text = given,
    }
    let said = read_within("", text.as_bytes(), limits);
    assert!(said.is_ok() == (given >= needs));
    kani::cover!(kind == 3 && given < needs, "too many objects");
    kani::cover!(kind == 1 && said.is_ok() && given == needs, "just deep enough");
}

/// Whatever stands anywhere in a file, the reader answers: a net without a defect, or what is
/// wrong and where.
#[kani::proof]
#[kani::unwind(40)]
pub fn any_byte_anywhere_is_answered() {
    let mut bytes = file(1, 1, 1).into_bytes();
    let place = 256 * usize::from(few::<1>()) + usize::from(few::<8>());
    kani::assume(place < bytes.len());
    let damage = *b"<>/&\"'= ;\0\xff1ap]!";
    bytes[place] = damage[usize::from(few::<4>())];
    match read("", &bytes) {
        Ok(net) => {
            assert!(net.view().net().defect().is_none());
            kani::cover!(net.places[0].initial == 1, "still a net");
        }
        Err(errors) => {
            assert!(!errors.diagnostics().is_empty());
            let length = errors.text().len();
            kani::cover!(length > 0, "refused");
        }
    }
}
