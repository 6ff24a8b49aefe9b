//! Names of a system, looked up while compiling: what `system!` writes.

use super::data::{Binding, Clear, Component, Delivery, Link, Of, System, Target};
use super::defect::SystemError;
use super::index::Index;
use crate::net::text::{Text, distance, same};
use crate::net::{EventId, OutputId, PlaceId, Signal, TransitionId};

/// A component and something of its net, as they were written.
pub type Port<'n> = (&'n str, &'n str);

const fn says(system: &str, what: &str, port: Port<'_>) -> Text {
    Text::new()
        .with("system ")
        .name(system)
        .with(", ")
        .with(what)
        .with(" ")
        .with(port.0)
        .with(".")
        .with(port.1)
        .with(": ")
}

#[track_caller]
const fn component(system: &str, components: &[Component<'_>], what: &str, port: Port<'_>) -> u16 {
    let mut at = 0;
    while at < components.len() {
        if same(components[at].name, port.0) {
            return at as u16;
        }
        at += 1;
    }
    says(system, what, port).with("there is no net ").name(port.0).stop()
}

#[track_caller]
const fn signal(text: Text, net: &str, kind: &str, signals: &[Signal<'_>], name: &str) -> u32 {
    let mut at = 0;
    while at < signals.len() {
        if same(signals[at].name, name) {
            return at as u32;
        }
        at += 1;
    }
    let mut near = Near::to(name);
    let mut at = 0;
    while at < signals.len() {
        near = near.or(signals[at].name);
        at += 1;
    }
    near.stop(text, net, kind)
}

/// The name that is nearest to a misspelt one.
struct Near<'n> {
    name: &'n str,
    best: &'n str,
    least: usize,
}

impl<'n> Near<'n> {
    const fn to(name: &'n str) -> Self {
        Self { name, best: "", least: 3 }
    }

    const fn or(self, other: &'n str) -> Self {
        let far = distance(other, self.name);
        if far < self.least { Self { best: other, least: far, ..self } } else { self }
    }

    #[track_caller]
    const fn stop(self, text: Text, net: &str, kind: &str) -> ! {
        let text =
            text.with("net ").name(net).with(" has no ").with(kind).with(" ").name(self.name);
        if self.best.is_empty() {
            text.stop()
        } else {
            text.with("; did you mean ").name(self.best).with("?").stop()
        }
    }
}

/// The event of a component.
#[track_caller]
pub const fn event(
    system: &str,
    components: &[Component<'_>],
    what: &str,
    port: Port<'_>,
) -> Of<EventId> {
    let component = component(system, components, what, port);
    let net = components[component as usize].net;
    Of {
        component,
        id: EventId(signal(says(system, what, port), net.name, "event", net.events, port.1)),
    }
}

#[track_caller]
const fn place(system: &str, components: &[Component<'_>], port: Port<'_>) -> Of<PlaceId> {
    let component = component(system, components, "shared", port);
    let net = components[component as usize].net;
    let mut at = 0;
    while at < net.places.len() {
        if same(net.places[at].name, port.1) {
            return Of { component, id: PlaceId(at as u32) };
        }
        at += 1;
    }
    let mut near = Near::to(port.1);
    let mut at = 0;
    while at < net.places.len() {
        near = near.or(net.places[at].name);
        at += 1;
    }
    near.stop(says(system, "shared", port), net.name, "place")
}

/// The source that `system!` keeps. It is implemented outside of the module that `system!` makes,
/// so that nets can be those of an enclosing function.
pub trait Written {
    /// `nets`.
    const COMPONENTS: &'static [Component<'static>];
    /// `links`.
    const LINKS: &'static [WrittenLink<'static>];
    /// `shared` and `pending`.
    const BINDINGS: &'static [WrittenBinding<'static>];
    /// `clears`.
    const CLEARS: &'static [WrittenClear<'static>];
    /// `laws`.
    const LAWS: &'static [super::laws::Claim];
}

/// The types of a net of a system.
#[allow(missing_docs)]
pub trait Part {
    type Event;
    type Place;
    type Output;
    type Transition;
    type State;
    type Program;
    const PROGRAM: Self::Program;
}

/// The position of a net of a system; behind the last when there is none.
pub const fn at<S: Written>(name: &str) -> u16 {
    let mut at = 0;
    while at < S::COMPONENTS.len() && !same(S::COMPONENTS[at].name, name) {
        at += 1;
    }
    at as u16
}

/// Ends the compilation when an extension names a net that the system does not have.
#[track_caller]
pub const fn replaced<S: Written>(system: &str, names: &[&str]) {
    let mut known = 0;
    while known < names.len() {
        if at::<S>(names[known]) as usize == S::COMPONENTS.len() {
            Text::new()
                .with("system ")
                .name(system)
                .with(" has no net ")
                .name(names[known])
                .with(", so an extension can put none in its place or before it")
                .stop()
        }
        known += 1;
    }
}

/// A delivery by mail into a mailbox with so much room.
#[track_caller]
pub const fn mail(system: &str, from: Port<'_>, capacity: i128) -> Delivery {
    if capacity < 1 || capacity > u16::MAX as i128 {
        says(system, "link", from).with("the room of a mailbox is from 1 to 65,535").stop()
    }
    Delivery::Mail { capacity: capacity.unsigned_abs() as u16 }
}

/// An item of `links`: an output, events, and how they arrive.
pub type WrittenLink<'n> = (Port<'n>, &'n [Port<'n>], Delivery);

/// An item of `clears`: an event, and that whose mailbox it empties.
pub type WrittenClear<'n> = (Port<'n>, Port<'n>);

/// An item of `shared` or `pending`: shared places, the place or the event that they are bound to,
/// and whether it is the mailbox of an event.
pub type WrittenBinding<'n> = (&'n [Port<'n>], Port<'n>, bool);

/// How many links these are.
pub const fn count_links(written: &[WrittenLink<'_>]) -> usize {
    let (mut count, mut at) = (0, 0);
    while at < written.len() {
        count += written[at].1.len();
        at += 1;
    }
    count
}

/// How many bindings these are.
pub const fn count_bindings(written: &[WrittenBinding<'_>]) -> usize {
    let (mut count, mut at) = (0, 0);
    while at < written.len() {
        count += written[at].0.len();
        at += 1;
    }
    count
}

/// The links.
#[track_caller]
pub const fn links<const N: usize>(
    system: &str,
    components: &[Component<'_>],
    written: &[WrittenLink<'_>],
) -> [Link; N] {
    let nothing = Link {
        from: Of { component: 0, id: OutputId(0) },
        to: Of { component: 0, id: EventId(0) },
        delivery: Delivery::Now,
    };
    let (mut links, mut count, mut at) = ([nothing; N], 0, 0);
    while at < written.len() {
        let (from, to, delivery) = written[at];
        let component = component(system, components, "link", from);
        let net = components[component as usize].net;
        let output =
            OutputId(signal(says(system, "link", from), net.name, "output", net.outputs, from.1));
        let from = Of { component, id: output };
        let mut each = 0;
        while each < to.len() {
            links[count] = Link { from, to: event(system, components, "link", to[each]), delivery };
            count += 1;
            each += 1;
        }
        at += 1;
    }
    links
}

/// The bindings.
#[track_caller]
pub const fn bindings<const N: usize>(
    system: &str,
    components: &[Component<'_>],
    written: &[WrittenBinding<'_>],
) -> [Binding; N] {
    let nothing = Of { component: 0, id: PlaceId(0) };
    let mut bindings = [Binding { shared: nothing, target: Target::Place(nothing) }; N];
    let (mut count, mut at) = (0, 0);
    while at < written.len() {
        let (shared, owner, mailbox) = written[at];
        let mut each = 0;
        while each < shared.len() {
            let target = if mailbox {
                Target::Mailbox(event(system, components, "pending", owner))
            } else {
                Target::Place(place(system, components, owner))
            };
            bindings[count] = Binding { shared: place(system, components, shared[each]), target };
            count += 1;
            each += 1;
        }
        at += 1;
    }
    bindings
}

/// The clears.
#[track_caller]
pub const fn clears<const N: usize>(
    system: &str,
    components: &[Component<'_>],
    written: &[WrittenClear<'_>],
) -> [Clear; N] {
    let nothing = Of { component: 0, id: EventId(0) };
    let mut clears = [Clear { on: nothing, mailbox: EventId(0) }; N];
    let mut at = 0;
    while at < written.len() {
        let on = event(system, components, "clears", written[at].0);
        let mailbox = event(system, components, "clears", written[at].1);
        if on.component != mailbox.component {
            says(system, "clears", written[at].0)
                .with("an event empties mailboxes of its own net only")
                .stop();
        }
        clears[at] = Clear { on, mailbox: mailbox.id };
        at += 1;
    }
    clears
}

const fn named(text: Text, system: &System<'_>, at: Of<PlaceId>) -> Text {
    let component = &system.components[at.component as usize];
    text.with(component.name).with(".").with(component.net.places[at.id.0 as usize].name)
}

/// Ends the compilation when something is wrong with a system of so many links, bindings and nets.
#[track_caller]
pub const fn check<const L: usize, const B: usize, const N: usize>(system: &System<'_>) {
    let mut index = Index {
        links: &mut [(0, 0); L],
        says: &mut [(0, 0); L],
        bindings: &mut [(0, 0); B],
        chains: &mut [0; N],
    };
    let Some(defect) = system.defect_by(&mut index) else { return };
    let text = Text::new().with("system ").name(system.name).with(": ");
    match defect {
        SystemError::Net { .. } => text.with("one of its nets is not sound").stop(),
        SystemError::UnknownId { list, at } => text
            .with("number ")
            .number(at as u64 + 1)
            .with(" of the ")
            .with(list)
            .with(" names a mailbox of an event that does not arrive by mail")
            .stop(),
        SystemError::TooLong => text.with("it is too large").stop(),
        SystemError::Unbound(place) => {
            let text = named(text.with("the shared place "), system, place);
            named(text.with(" belongs to nobody: say whose it is, as `shared { "), system, place)
                .with(" = owner.place; }`")
                .stop()
        }
        SystemError::Binding { at } => {
            named(text.with("the shared place "), system, system.bindings[at].shared)
                .with(" is bound twice, or is no shared place, or to a place of another bound, ")
                .with("or to a place that is shared itself")
                .stop()
        }
        SystemError::Delivery { at } => {
            let to = system.links[at].to;
            let component = &system.components[to.component as usize];
            text.with("the links to ")
                .with(component.name)
                .with(".")
                .with(component.net.events[to.id.0 as usize].name)
                .with(" differ in how they deliver, or its mailbox has no room")
                .stop()
        }
        SystemError::Circle { component } => text
            .with("`now` links lead from ")
            .name(system.components[component as usize].name)
            .with(" back to it, or on over more than 8 nets; use mail for one of them")
            .stop(),
        SystemError::ChangesMailbox(of) => line(text, system, of)
            .with(" changes a shared place that is a mailbox; it can only be read")
            .stop(),
        SystemError::Overfills(of) => line(text, system, of)
            .with(" mails more at once than a mailbox holds, so it could never fire; ")
            .with("give the mailbox more room")
            .stop(),
    }
}

/// Adds what a transition is called.
const fn line(text: Text, system: &System<'_>, of: Of<TransitionId>) -> Text {
    let component = &system.components[of.component as usize];
    text.with("transition ")
        .with(component.name)
        .with(".")
        .with(component.net.transitions[of.id.0 as usize].name)
}
