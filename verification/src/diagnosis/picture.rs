//! The net, drawn as the run leaves it.

use crate::export::drawing::Style;
use crate::export::svg::{Highlight, write_highlighted};
use crate::pt::Pt;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Net, PlaceId, TransitionId};
use std::collections::BTreeSet;

/// Larger nets are not drawn: nobody would find anything.
const LARGEST: usize = 60;

/// A drawing and what to point at in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Picture {
    pub(super) svg: String,
    /// The elements of the places to point at.
    pub(super) culprits: Vec<String>,
}

impl Picture {
    pub(super) fn new(
        pt: &Pt,
        net: Option<&Net<'_>>,
        last: &[u32],
        pointed: &[TransitionId],
        culprits: &BTreeSet<u32>,
    ) -> Option<Self> {
        if pt.places.len() + pt.transitions.len() > LARGEST {
            return None;
        }
        let highlight = Highlight { marking: Some(last), transitions: pointed };
        let svg = match net {
            Some(net) => write_highlighted(net, Style::Auto, &highlight),
            None => write_highlighted(&drawn(pt)?.view().net(), Style::Net, &highlight),
        };
        Some(Self { svg, culprits: culprits.iter().map(|it| format!("place-{it}")).collect() })
    }

    /// The drawing as a figure of a page, with a heading.
    pub(super) fn figure(&self, heading: &str) -> String {
        let key = self.culprits.join("-");
        let mut out = format!("<h2>{heading}</h2>\n");
        if !self.culprits.is_empty() {
            let rims = self.culprits.iter();
            let rims: Vec<String> =
                rims.map(|it| format!(".at-{key} #{it} circle.rim,.at-{key} #{it} rect")).collect();
            out += &format!("<style>{}{{stroke:var(--hot);stroke-width:4}}</style>\n", rims.join(","));
        }
        out + &format!("<figure class=\"at-{key}\">\n{}</figure>\n", self.svg)
    }
}

/// The net as far as engines know it.
fn drawn(pt: &Pt) -> Option<OwnedNet> {
    let mut net = OwnedNet::new(&pt.name, "");
    for (name, tokens) in pt.places.iter().zip(&pt.initial) {
        net.place(OwnedPlace::new(name, *tokens)).ok()?;
    }
    for (at, name) in pt.transitions.iter().enumerate() {
        let (needs, effects) = (pt.needs.of(at as u32), pt.effects.of(at as u32));
        let change = |place: u32| effects.iter().find(|it| it.0 == place).map_or(0, |it| it.1);
        let mut transition = OwnedTransition::new(name);
        for &(place, weight) in needs {
            let given = i64::from(weight) + change(place);
            transition = match u32::try_from(given).ok()? {
                same if same == weight => transition.read(PlaceId(place), weight),
                0 => transition.take(PlaceId(place), weight),
                given => transition.take(PlaceId(place), weight).give(PlaceId(place), given),
            };
        }
        for &(place, weight) in effects.iter().filter(|it| needs.iter().all(|need| need.0 != it.0)) {
            transition = transition.give(PlaceId(place), u32::try_from(weight).ok()?);
        }
        net.transition(transition).ok()?;
    }
    Some(net)
}
