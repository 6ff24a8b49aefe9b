//! A drawing of a system: its nets, what they say to each other, and what they look at.

use super::figure::{Edge, Figure, Flow, Kind, Label, Node};
use super::svg;
use cotama_core::net::owned::{OwnedNet, OwnedPlace};
use cotama_core::net::{Net, OutputId, PlaceId};
use cotama_core::system::{Delivery, Of, System, Target};

/// How something comes from one net to another, in the order in which it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    Now,
    Mail,
    Look,
}

impl Way {
    const fn word(self) -> &'static str {
        match self {
            Self::Now => "now",
            Self::Mail => "mail",
            Self::Look => "sees",
        }
    }
}

/// The meaning of the words at the lines.
const LEGEND: [svg::Key; 3] = [
    (Flow::Move, Way::Now.word(), "the other net hears the output in the same step"),
    (Flow::Move, Way::Mail.word(), "the output waits in a mailbox of the other net, as its event"),
    (Flow::Read, Way::Look.word(), "the other net sees these places or mailboxes, unchanged"),
];

/// Draws a system: each net as a box. An arrow leads from a net to one that hears its outputs,
/// `now` in the same step or by `mail`; an output is written with its event where that has another
/// name. A dashed line leads from a net to one that `sees` its places or its mailboxes.
///
/// ```
/// use cotama_models::nets::by_hand::delivery;
/// let drawing = cotama_verification::drawing::overview::write(&delivery::SYSTEM);
/// assert!(drawing.starts_with("<svg xmlns=") && drawing.contains("start_drive"));
/// ```
pub fn write(system: &System<'_>) -> String {
    let mut boxes = OwnedNet::new(system.name, system.doc);
    for component in system.components {
        let name = match (component.name, component.net.name) {
            (own, net) if own == net => own.to_owned(),
            (own, net) => format!("{own}: {net}"),
        };
        // Components have different names; and a place too many would only be left out.
        let _ = boxes.place(OwnedPlace::new(&name, 0).doc(component.net.doc));
    }
    let view = boxes.view();
    let figure = figure(&view.net(), system);
    let is_said =
        |word| figure.edges.iter().flat_map(|it| &it.labels).any(|it| it.event == Some(word));
    let legend: Vec<svg::Key> = LEGEND.into_iter().filter(|it| is_said(it.1)).collect();
    svg::write_figure(&view.net(), figure, "System", &legend)
}

fn figure<'n>(boxes: &Net<'n>, system: &System<'_>) -> Figure<'n> {
    let places = boxes.places.iter().enumerate();
    let nodes: Vec<Node<'n>> = places.map(|(at, it)| Node::of(Kind::State(at), it)).collect();
    let mut said = said(system);
    said.retain(|it| it.from < nodes.len() && it.to < nodes.len());
    said.sort_by_key(|it| (it.from, it.to, it.way));
    let mut edges: Vec<Edge<'n>> = Vec::new();
    for Said { from, to, way, what } in said {
        let flow = if way == Way::Look && from != to { Flow::Read } else { Flow::Move };
        if edges.last().is_none_or(|it| (it.from, it.to, it.flow) != (from, to, flow)) {
            edges.push(Edge { from, to, flow, weight: 1, labels: Vec::new() });
        }
        let Some(edge) = edges.last_mut() else { continue };
        if edge.labels.last().and_then(|it| it.event) != Some(way.word()) {
            edge.labels.push(Label { event: Some(way.word()), ..Label::default() });
        }
        let Some(label) = edge.labels.last_mut().filter(|it| !it.timing.contains(&what)) else {
            continue;
        };
        label.timing.push(what);
    }
    Figure { name: boxes.name, doc: boxes.doc, is_states: true, nodes, edges }
}

/// One thing that comes from one net to another.
struct Said {
    from: usize,
    to: usize,
    way: Way,
    what: String,
}

fn said(system: &System<'_>) -> Vec<Said> {
    let net = |component: u16| system.components.get(usize::from(component)).map(|it| it.net);
    let output = |of: Of<OutputId>| Some(net(of.component)?.outputs.get(of.id.0 as usize)?.name);
    let event = |component: u16, id: u32| Some(net(component)?.events.get(id as usize)?.name);
    let place = |of: Of<PlaceId>| Some(net(of.component)?.places.get(of.id.0 as usize)?.name);
    let links = system.links.iter().filter_map(|it| {
        let (output, event) = (output(it.from)?, event(it.to.component, it.to.id.0)?);
        let what =
            if output == event { output.to_owned() } else { format!("{output} → {event}") };
        let way = if it.delivery == Delivery::Now { Way::Now } else { Way::Mail };
        Some(Said {
            from: usize::from(it.from.component),
            to: usize::from(it.to.component),
            way,
            what,
        })
    });
    let looks = system.bindings.iter().filter_map(|it| {
        let (owner, what) = match it.target {
            Target::Place(of) => (of.component, place(of)?.to_owned()),
            Target::Mailbox(of) => {
                (of.component, format!("{} waiting", event(of.component, of.id.0)?))
            }
        };
        let (from, to) = (usize::from(owner), usize::from(it.shared.component));
        Some(Said { from, to, way: Way::Look, what })
    });
    links.chain(looks).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::nets::ace::robot;
    use cotama_models::nets::by_hand::delivery;

    #[test]
    fn every_link_and_every_shared_place_is_drawn_once() {
        for system in [delivery::SYSTEM, robot::SYSTEM] {
            let mut boxes = OwnedNet::new("boxes", "");
            for component in system.components {
                boxes.place(OwnedPlace::new(component.name, 0)).unwrap();
            }
            let view = boxes.view();
            let figure = figure(&view.net(), &system);
            let written: usize =
                figure.edges.iter().flat_map(|it| &it.labels).map(|it| it.timing.len()).sum();
            assert_eq!(written, system.links.len() + system.bindings.len());
            let ends: Vec<_> =
                figure.edges.iter().map(|it| (it.from, it.to, it.flow == Flow::Read)).collect();
            let mut once = ends.clone();
            once.dedup();
            assert_eq!(ends, once);
        }
    }

    #[test]
    fn events_that_a_net_mails_to_itself_and_sees_stand_at_one_line() {
        let drawing = write(&delivery::SYSTEM);
        assert!(drawing.contains("ended → tick") || drawing.contains("ended\u{a0}→\u{a0}tick"));
        assert_eq!(drawing.matches("local_event\u{a0}waiting").count(), 1);
    }

    #[test]
    fn a_legend_explains_now_mail_and_sees() {
        let drawing = write(&delivery::SYSTEM);
        let legend = drawing.split_once("<g class=\"legend\">").unwrap().1;
        for (_, word, meaning) in LEGEND {
            let line =
                format!("\"strong\">{word}</tspan> <tspan class=\"quiet\">{meaning}</tspan>");
            assert_eq!(legend.matches(&line).count(), 1, "{word}");
        }
    }
}
