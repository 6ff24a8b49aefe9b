//! Defects of nets in words, with what they are about.

use super::super::name::Misnamed;
use super::Named;
use cotama_core::net::NetError;

/// The defect of a net.
pub(super) fn of_net(defect: NetError, names: &Named) -> Misnamed {
    let (name, subject) = match defect {
        NetError::TooLong => (None, "a list".to_owned()),
        NetError::Place { place } => {
            let name = names.places.get(place);
            (name, name.map_or_else(String::new, |it| format!("place `{}`", it.text)))
        }
        NetError::UnknownId { transition }
        | NetError::Arcs { transition }
        | NetError::Interval { transition } => {
            let name = names.transitions.get(transition);
            (name, name.map_or_else(String::new, |it| format!("transition `{}`", it.text)))
        }
        NetError::Law => (None, "a law, or an entry of `ignored`,".to_owned()),
        NetError::Twice { list, at } => (None, format!("entry {at} of the {list}")),
        _ => (None, "the net".to_owned()),
    };
    Misnamed::about(name.or(Some(&names.net)), format!("{subject} {}", fault(defect)))
}

fn fault(defect: NetError) -> &'static str {
    match defect {
        NetError::TooLong => "has more entries than ids can count",
        NetError::UnknownId { .. } => "names something that the net does not have",
        NetError::Arcs { .. } => {
            "has an arc of weight 0, or names a place twice in `give`, or in `take` and `read` \
             together"
        }
        NetError::Interval { .. } => {
            "has an interval that ends before it begins, or after 4294967294 ms"
        }
        NetError::Place { .. } => {
            "has more tokens at the start than its bound, or does not sum to the bound with the \
             place that it complements"
        }
        NetError::Law => "has an arc of weight 0, or a place twice in one sum or guard",
        NetError::Twice { .. } => "has the name of an earlier one",
        _ => "does not fit together",
    }
}
