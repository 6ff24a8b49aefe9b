//! The net, drawn as a run leaves it.

use super::Step;
use crate::export::drawing::Style;
use crate::export::svg::{self, Highlight, Part};
use crate::pt::Pt;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Net, PlaceId, TransitionId};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Larger nets are not drawn: nobody would find anything.
const LARGEST: usize = 60;

/// A drawing with a line above it.
pub(super) struct Frame {
    pub(super) caption: String,
    pub(super) part: Part,
    /// Whether it is what a run leads to.
    pub(super) is_last: bool,
}

/// A small net, a marking of it, and what to point at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Picture {
    net: OwnedNet,
    style: Style,
    marking: Vec<u32>,
    pointed: Vec<TransitionId>,
    /// The places to point at.
    culprits: Vec<u32>,
}

impl Picture {
    pub(super) fn new(
        pt: &Pt,
        net: Option<&Net<'_>>,
        marking: &[u32],
        pointed: &[TransitionId],
        culprits: &BTreeSet<u32>,
    ) -> Option<Self> {
        if pt.places.len() + pt.transitions.len() > LARGEST {
            return None;
        }
        let (net, style) = match net {
            Some(net) => (OwnedNet::from(net), Style::Auto),
            None => (drawn(pt)?, Style::Net),
        };
        let (marking, pointed) = (marking.to_vec(), pointed.to_vec());
        Some(Self { net, style, marking, pointed, culprits: culprits.iter().copied().collect() })
    }

    /// The drawing as a part of a sheet.
    pub(super) fn frame(&self, caption: String, prefix: &str) -> Frame {
        let highlight = Highlight { marking: Some(&self.marking), transitions: &self.pointed };
        let mut part = svg::part(&self.net.view().net(), self.style, &highlight, prefix);
        if !self.culprits.is_empty() {
            let _ = writeln!(part.text, "<style>{}</style>", self.rims(".cotama", prefix));
        }
        Frame { caption, part, is_last: true }
    }

    /// The drawings of a run: of the start and after each step, or after the last one if they are
    /// too many.
    pub(super) fn frames(&self, trace: &[Step], most: usize) -> Vec<Frame> {
        let view = self.net.view();
        let net = view.net();
        let mut now = Self { culprits: Vec::new(), pointed: Vec::new(), ..self.clone() };
        now.marking = net.places.iter().map(|it| it.initial).collect();
        let mut frames = Vec::new();
        if trace.len() < most {
            frames.push(Frame { is_last: false, ..now.frame("start".to_owned(), "at-0-") });
            for (at, step) in trace.iter().enumerate().take(trace.len().saturating_sub(1)) {
                for it in &step.changes {
                    if let Some(place) = net.places.iter().position(|place| place.name == it.place)
                    {
                        now.marking[place] = it.after;
                    }
                }
                let fired = net.transitions.iter().position(|it| it.name == step.transition);
                now.pointed = fired.map(|it| TransitionId(it as u32)).into_iter().collect();
                let prefix = format!("at-{}-", at + 1);
                frames.push(Frame { is_last: false, ..now.frame(caption(at, step), &prefix) });
            }
        }
        match trace.last() {
            Some(step) => frames.push(self.frame(caption(trace.len() - 1, step), "last-")),
            None => frames = vec![self.frame("start".to_owned(), "last-")],
        }
        frames
    }

    /// Thick rims for the places to point at.
    fn rims(&self, class: &str, prefix: &str) -> String {
        let rim = |it: &u32| {
            let id = format!("{class} #{prefix}place-{it}");
            format!("{id} circle.rim,{id} rect")
        };
        let rims: Vec<String> = self.culprits.iter().map(rim).collect();
        format!("{}{{stroke:#c2410c;stroke:var(--hot);stroke-width:4}}", rims.join(","))
    }

    /// The drawing as a figure of a page, with a heading.
    pub(super) fn figure(&self, heading: &str) -> String {
        let keys: Vec<String> = self.culprits.iter().map(|it| format!("place-{it}")).collect();
        let class = format!("at-{}", keys.join("-"));
        let mut out = format!("<h2>{heading}</h2>\n");
        if !self.culprits.is_empty() {
            let _ = writeln!(out, "<style>{}</style>", self.rims(&format!(".{class}"), ""));
        }
        let highlight = Highlight { marking: Some(&self.marking), transitions: &self.pointed };
        let drawing = svg::write_highlighted(&self.net.view().net(), self.style, &highlight);
        out + &format!("<figure class=\"{class}\">\n{drawing}</figure>\n")
    }
}

/// What a step is, in a line.
fn caption(at: usize, step: &Step) -> String {
    let event = step.event.as_deref().map_or_else(String::new, |it| format!(" on {it}"));
    let date = step.at.as_ref().map_or_else(String::new, |it| format!(", at {it} ms"));
    format!("{}  {}{event}{date}", at + 1, step.transition)
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
        for &(place, weight) in effects.iter().filter(|it| needs.iter().all(|need| need.0 != it.0))
        {
            transition = transition.give(PlaceId(place), u32::try_from(weight).ok()?);
        }
        net.transition(transition).ok()?;
    }
    Some(net)
}
