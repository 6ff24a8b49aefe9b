//! The net, drawn as a run leaves it.

use super::Step;
use super::words::printable;
use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
use cotama_core::net::{Net, PlaceId, TransitionId};
use cotama_core::text::markup;
use cotama_drawing::figure::Style;
use cotama_drawing::svg::{self, Highlight, Part};
use cotama_property::pt::Pt;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Larger nets are not drawn: nobody would find anything.
const LARGEST: usize = 60;

/// A step for the script: what fires, its name, and the tokens of the places that it changes.
type Move = (Option<usize>, String, Vec<(u32, u32)>);

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

    /// The drawing as a part of a sheet; coloured are the places that changed, or those that are
    /// marked.
    pub(super) fn frame(
        &self,
        caption: String,
        prefix: &str,
        changed: Option<&[PlaceId]>,
    ) -> Frame {
        let highlight = self.highlight(changed);
        let mut part = svg::part(&self.net.view().net(), self.style, &highlight, prefix);
        if !self.culprits.is_empty() {
            let _ = writeln!(part.text, "<style>{}</style>", self.rims(".cotama", prefix));
        }
        Frame { caption, part, is_last: true }
    }

    fn highlight<'p>(&'p self, changed: Option<&'p [PlaceId]>) -> Highlight<'p> {
        let (marking, transitions) = (Some(self.marking.as_slice()), self.pointed.as_slice());
        Highlight { marking, transitions, places: changed }
    }

    fn place(&self, name: &str) -> Option<PlaceId> {
        let at = self.net.view().net().places.iter().position(|it| it.name == name)?;
        u32::try_from(at).ok().map(PlaceId)
    }

    /// The places that a step changes.
    fn changed(&self, step: &Step) -> Vec<PlaceId> {
        step.changes.iter().filter_map(|it| self.place(&it.place)).collect()
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
            let start = now.frame("start".to_owned(), "at-0-", Some(&[]));
            frames.push(Frame { is_last: false, ..start });
            for (at, step) in trace.iter().enumerate().take(trace.len().saturating_sub(1)) {
                for it in &step.changes {
                    if let Some(place) = self.place(&it.place) {
                        now.marking[place.0 as usize] = it.after;
                    }
                }
                let fired = net.transitions.iter().position(|it| it.name == step.transition);
                now.pointed = fired.map(|it| TransitionId(it as u32)).into_iter().collect();
                let prefix = format!("at-{}-", at + 1);
                let frame = now.frame(caption(at, step), &prefix, Some(&self.changed(step)));
                frames.push(Frame { is_last: false, ..frame });
            }
        }
        match trace.last() {
            Some(step) => {
                let caption = caption(trace.len() - 1, step);
                frames.push(self.frame(caption, "last-", Some(&self.changed(step))));
            }
            None => frames = vec![self.frame("start".to_owned(), "last-", Some(&[]))],
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

    /// The drawing as a figure of a page, with a heading. It is that of the last step; a script
    /// moves along the run, if the page may have one.
    pub(super) fn figure(&self, heading: &str, trace: &[Step]) -> String {
        let keys: Vec<String> = self.culprits.iter().map(|it| format!("place-{it}")).collect();
        let class = format!("at-{}", keys.join("-"));
        let mut out = format!("<h2>{heading}</h2>\n");
        if !self.culprits.is_empty() {
            let _ = writeln!(out, "<style>{}</style>", self.rims(&format!(".{class}.ended"), ""));
        }
        let changed = trace.last().map(|it| self.changed(it));
        let highlight = self.highlight(changed.as_deref());
        let drawing = svg::write_highlighted(&self.net.view().net(), self.style, &highlight);
        let (player, script) = if trace.is_empty() {
            (String::new(), String::new())
        } else {
            let script = format!("<script>\n{}</script>\n", include_str!("player.js"));
            (self.player(trace), script)
        };
        let _ = write!(
            out,
            "<p class=\"net\">{}</p>\n<figure class=\"{class} ended\">\n{player}\
             <div class=\"scroll\">\n{drawing}</div>\n{script}</figure>\n",
            self.legend(!trace.is_empty())
        );
        out
    }

    /// Says what the drawing shows by fill, colour and rim.
    fn legend(&self, moves: bool) -> String {
        let mut words = String::from("Filled, or with dots: marked.");
        if moves {
            words += " In colour: what fired last, and what it changed.";
        }
        if !self.culprits.is_empty() {
            words += " Thick rim, after the last step: what the property speaks of.";
        }
        words
    }

    /// Returns the controls that move along a run: a slider and two buttons, hidden until the
    /// script is there.
    fn player(&self, trace: &[Step]) -> String {
        let view = self.net.view();
        let net = view.net();
        let places = net.places.iter().zip(0u32..);
        let start = places.filter(|it| it.0.initial > 0).map(|(it, at)| (at, it.initial));
        let mut run: Vec<Move> = vec![(None, String::new(), start.collect())];
        for step in trace {
            let fired = net.transitions.iter().position(|it| it.name == step.transition);
            let changes = step.changes.iter();
            let changes = changes.filter_map(|it| Some((self.place(&it.place)?.0, it.after)));
            run.push((fired, printable(&step.transition), changes.collect()));
        }
        let run = serde_json::to_string(&run).unwrap_or_default();
        let parts = serde_json::to_string(&svg::parts(&net, self.style)).unwrap_or_default();
        let last = trace.len();
        format!(
            "<div class=\"player\" hidden=\"hidden\" data-run=\"{}\" data-parts=\"{}\">\
             <button type=\"button\" value=\"-1\" aria-label=\"one step back\">◀</button>\
             <input type=\"range\" min=\"0\" max=\"{last}\" value=\"{last}\" aria-label=\"step\"/>\
             <button type=\"button\" value=\"1\" aria-label=\"one step on\">▶</button>\
             <output></output></div>\n",
            markup(&run),
            markup(&parts)
        )
    }
}

/// Returns the caption of a step, in a line.
fn caption(at: usize, step: &Step) -> String {
    let event = step.event.as_deref().map_or_else(String::new, |it| format!(" on {it}"));
    let date = step.at.as_ref().map_or_else(String::new, |it| format!(", at {it} ms"));
    format!("{}  {}{event}{date}", at + 1, step.transition)
}

/// The net as far as engines know it.
fn drawn(pt: &Pt) -> Option<OwnedNet> {
    if !pt.is_plain() {
        return None;
    }
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
