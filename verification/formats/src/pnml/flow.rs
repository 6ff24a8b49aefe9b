//! From the arcs of a file to those of the transitions.

use super::document::RawArc;
use super::error::{Finding, Findings, Span};
use super::kind::Kind;
use super::nodes::{Node, Nodes};
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Arc, PlaceId, TransitionId};
use cotama_property::pt::Extras;

/// An arc between nodes that are known.
struct Flow {
    transition: u32,
    place: u32,
    into_transition: bool,
    /// Tokens of the arc.
    weight: u64,
    /// Tokens of a read arc, which come back.
    read: u64,
    kind: Kind,
    span: Span,
}

fn flow(arc: &RawArc<'_>, nodes: &Nodes<'_>, findings: &mut Findings) -> Option<Flow> {
    let (source, target) = (nodes.find(&arc.source, findings), nodes.find(&arc.target, findings));
    let (transition, place, into_transition) = match (source?, target?) {
        (Node::Place(place), Node::Transition(transition)) => (transition, place, true),
        (Node::Transition(transition), Node::Place(place)) => (transition, place, false),
        (Node::Place(_), Node::Place(_)) => {
            findings.push(
                Finding::new(arc.span, "an arc from a place to a place")
                    .help("put a transition between the two"),
            );
            return None;
        }
        (Node::Transition(_), Node::Transition(_)) => {
            findings.push(
                Finding::new(arc.span, "an arc from a transition to a transition")
                    .help("put a place between the two"),
            );
            return None;
        }
    };
    let (weight, span) =
        arc.weight.as_ref().map_or((1, arc.span), |weight| (weight.value, weight.span));
    let read = u64::from(arc.own.read);
    if read > weight {
        findings.push(
            Finding::new(
                span,
                format!("an arc of weight {weight} of which {read} belong to a read arc"),
            )
            .help("correct `read` in its element `<toolspecific>`, or remove that"),
        );
    }
    let backwards = match arc.kind {
        Kind::Test => Some("a read arc from a transition"),
        Kind::Inhibitor => Some("an inhibitor arc from a transition"),
        // A reset arc empties the place, however it is drawn.
        Kind::Normal | Kind::Reset => None,
    };
    if let Some(what) = backwards.filter(|_| !into_transition) {
        findings
            .push(Finding::new(arc.span, what).help("let it go from the place to the transition"));
    }
    if arc.kind == Kind::Reset && weight != 1 {
        findings.push(
            Finding::new(span, format!("a reset arc of weight {weight}"))
                .help("it takes all tokens: remove the weight"),
        );
    }
    Some(Flow { transition, place, into_transition, weight, read, kind: arc.kind, span })
}

/// Takes an inhibitor arc or a reset arc; whether it is one.
fn beyond(flow: &Flow, extras: &mut Extras, findings: &mut Findings) -> bool {
    let (transition, place) = (TransitionId(flow.transition), PlaceId(flow.place));
    match flow.kind {
        Kind::Normal | Kind::Test => return false,
        Kind::Reset => extras.resets.push((transition, place)),
        Kind::Inhibitor => match u32::try_from(flow.weight) {
            Ok(weight) => extras.inhibitors.push((transition, Arc { place, weight })),
            Err(_) => findings.push(
                Finding::new(flow.span, format!("the weight {} is too large", flow.weight))
                    .help(format!("the largest weight is {}", u32::MAX)),
            ),
        },
    }
    true
}

/// All arcs between one transition and one place in one direction.
struct Sum {
    place: u32,
    weight: u64,
    read: u64,
    tested: u64,
    span: Span,
}

/// Gives the transitions of a net their arcs, in the order of the file; arcs between the same nodes
/// become one.
pub(super) fn add_arcs(
    net: &mut OwnedNet,
    extras: &mut Extras,
    nodes: &Nodes<'_>,
    arcs: &[RawArc<'_>],
    findings: &mut Findings,
) {
    let mut flows: Vec<Flow> = arcs.iter().filter_map(|arc| flow(arc, nodes, findings)).collect();
    flows.retain(|flow| !beyond(flow, extras, findings));
    // As they stand in the file; no more memory is taken for it.
    flows.sort_unstable_by_key(|flow| (flow.transition, flow.span.start));
    // The slot of the sum of a place and a direction in `sums`, if its flag says that it is of this
    // transition.
    let mut slots = vec![[(u32::MAX, 0); 2]; net.places.len()];
    for flows in flows.chunk_by(|a, b| a.transition == b.transition) {
        let transition = flows[0].transition;
        let mut sums: [Vec<Sum>; 2] = [Vec::new(), Vec::new()];
        for flow in flows {
            let direction = usize::from(flow.into_transition);
            let sums = &mut sums[direction];
            let slot = &mut slots[flow.place as usize][direction];
            if slot.0 != transition {
                *slot = (transition, sums.len());
                sums.push(Sum {
                    place: flow.place,
                    weight: 0,
                    read: 0,
                    tested: 0,
                    span: flow.span,
                });
            }
            let sum = &mut sums[slot.1];
            sum.weight += flow.weight;
            sum.read += flow.read;
            sum.tested += if flow.kind == Kind::Test { flow.weight } else { 0 };
        }
        let [outputs, inputs] = &sums;
        let read_in = |direction: usize, place: u32| {
            let (of, index) = slots[place as usize][direction];
            if of == transition { sums[direction][index].read } else { 0 }
        };
        let into = &mut net.transitions[transition as usize];
        for sum in inputs {
            let read = sum.read + sum.tested;
            let take = sum.weight.saturating_sub(read);
            if take > 0 && read > 0 {
                findings.push(
                    Finding::new(sum.span, "a place that a transition both reads and takes from")
                        .help("use one ordinary arc from it, and one back for what stays"),
                );
            }
            push(&mut into.take, sum, take, findings);
            push(&mut into.read, sum, read, findings);
        }
        for sum in outputs {
            push(&mut into.give, sum, sum.weight.saturating_sub(sum.read), findings);
        }
        for (direction, sum) in [outputs, inputs]
            .into_iter()
            .enumerate()
            .flat_map(|(d, sums)| sums.iter().map(move |sum| (d, sum)))
        {
            if sum.read > read_in(1 - direction, sum.place) {
                findings.push(
                    Finding::new(sum.span, "a read arc whose tokens do not all come back").help(
                        "give the arc there and the arc back the same `read`, or remove `\
                         <toolspecific>`",
                    ),
                );
            }
        }
    }
}

fn push(arcs: &mut Vec<Arc>, sum: &Sum, weight: u64, findings: &mut Findings) {
    match u32::try_from(weight) {
        Ok(0) => {}
        Ok(weight) => arcs.push(Arc { place: PlaceId(sum.place), weight }),
        Err(_) => findings.push(
            Finding::new(sum.span, format!("the weight {weight} between two nodes is too large"))
                .help(format!("the largest weight is {}", u32::MAX)),
        ),
    }
}
