//! A net as PNML.

use super::escape::{Content, Exact, survives};
use cotama_core::net::{
    Arc, Law, Net, Place, PlaceId, Role, Signal, Transition, TransitionId, Within,
};
use cotama_property::pt::Extras;
use std::collections::HashMap;
use std::fmt::{self, Display, Formatter};

/// A net as PNML, in the form that the [module](super) describes.
///
/// The result is valid PNML of a P/T net. [`read`](super::read) gives the same net back if
/// [`Net::defect`] finds nothing in it and names are unique; if not, it refuses the file or gives
/// another net.
///
/// ```
/// use cotama_models::nets::door;
/// use cotama_verification::pnml;
/// let text = pnml::write(&door::NET);
/// let net = pnml::read("door.pnml", text.as_bytes()).unwrap();
/// assert_eq!((net.name.as_str(), net.places.len()), ("door", door::NET.places.len()));
/// ```
pub fn write(net: &Net<'_>) -> String {
    write_extended(net, &Extras::default())
}

/// The same with inhibitor arcs, reset arcs and priorities, as TAPAAL, TINA and PIPE read them: an
/// arc has `<type value="inhibitor"/>` or `<type value="reset"/>`, a transition `<priority>`.
///
/// ```
/// use cotama_core::net::Arc;
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::pnml::{self, Limits};
/// use cotama_verification::pt::Extras;
///
/// let mut net = OwnedNet::new("gate", "");
/// let human = net.place(OwnedPlace::new("human", 0)).unwrap();
/// let drive = net.transition(OwnedTransition::new("drive")).unwrap();
/// let inhibitors = vec![(drive, Arc { place: human, weight: 2 })];
/// let extras = Extras { inhibitors, ..Extras::default() };
/// let text = pnml::write_extended(&net.view().net(), &extras);
/// let read = pnml::read_within("gate.pnml", text.as_bytes(), Limits::default()).unwrap();
/// assert_eq!((read.net, read.extras), (net, extras));
/// ```
pub fn write_extended(net: &Net<'_>, extras: &Extras) -> String {
    File { net, extras, for_tina: false }.to_string()
}

/// The same with an interval `<delay>` in every transition, as TINA writes and reads it.
///
/// The standard does not know this element, a strict checker of PNML will object. The times are
/// milliseconds. A transition that fires at once has the interval \[0, 0\]. A transition with an
/// event may be left out for ever in a supervisor and not in TINA, so its interval has no end
/// there: TINA then knows more executions than the supervisor has. TINA does not learn of
/// priorities.
pub fn write_for_tina(net: &Net<'_>) -> String {
    File { net, extras: &Extras::default(), for_tina: true }.to_string()
}

struct File<'n> {
    net: &'n Net<'n>,
    extras: &'n Extras,
    for_tina: bool,
}

const OWN: &str = "<toolspecific tool=\"cotama\" version=\"1\">";

impl Display for File<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <pnml xmlns=\"http://www.pnml.org/version-2009/grammar/pnml\">\n\
             <net id=\"net\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\">\n",
        )?;
        name(f, self.net.name)?;
        self.own(f)?;
        f.write_str("<page id=\"page\">\n")?;
        for (index, place) in self.net.places.iter().enumerate() {
            write_place(f, index, place)?;
        }
        for (index, transition) in self.net.transitions.iter().enumerate() {
            self.transition(f, index, transition)?;
        }
        let mut arcs = Arcs { written: 0 };
        for (index, transition) in self.net.transitions.iter().enumerate() {
            arcs.write(f, index, transition)?;
        }
        for &(transition, Arc { place, weight }) in &self.extras.inhibitors {
            arcs.kind(f, (place, transition), "inhibitor", weight)?;
        }
        for &(transition, place) in &self.extras.resets {
            arcs.kind(f, (place, transition), "reset", 1)?;
        }
        f.write_str("</page>\n</net>\n</pnml>\n")
    }
}

impl File<'_> {
    fn own(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Net { name, doc, events, outputs, ignored, laws, .. } = *self.net;
        write!(f, "{OWN}\n<net")?;
        exact_name(f, name)?;
        attribute(f, "doc", doc)?;
        f.write_str("/>\n")?;
        signals(f, "event", events)?;
        signals(f, "output", outputs)?;
        for it in ignored {
            write!(f, "<ignored event=\"e{}\" place=\"p{}\"", it.event.0, it.place.0)?;
            if it.guard.is_empty() {
                f.write_str("/>\n")?;
            } else {
                f.write_str(">")?;
                terms(f, it.guard)?;
                f.write_str("</ignored>\n")?;
            }
        }
        laws.iter().try_for_each(|it| law(f, it))?;
        f.write_str("</toolspecific>\n")
    }

    fn transition(&self, f: &mut Formatter<'_>, index: usize, it: &Transition<'_>) -> fmt::Result {
        writeln!(f, "<transition id=\"t{index}\">")?;
        name(f, it.name)?;
        if self.for_tina {
            delay(f, it)?;
        }
        if let Some(priority) = self.extras.priorities.get(index) {
            writeln!(f, "<priority><value>{priority}</value></priority>")?;
        }
        let attributes = TransitionAttributes { index, it }.to_string();
        if self.for_tina || !attributes.is_empty() {
            writeln!(f, "{OWN}<transition{attributes}/></toolspecific>")?;
        }
        f.write_str("</transition>\n")
    }
}

fn name(f: &mut Formatter<'_>, name: &str) -> fmt::Result {
    writeln!(f, "<name><text>{}</text></name>", Content(name))
}

/// The name where `<name>` cannot hold it.
fn exact_name(f: &mut Formatter<'_>, name: &str) -> fmt::Result {
    if survives(name) { Ok(()) } else { write!(f, " name=\"{}\"", Exact(name)) }
}

/// An attribute, left out when it is empty.
fn attribute(f: &mut Formatter<'_>, name: &str, value: &str) -> fmt::Result {
    if value.is_empty() { Ok(()) } else { write!(f, " {name}=\"{}\"", Exact(value)) }
}

fn signals(f: &mut Formatter<'_>, element: &str, signals: &[Signal<'_>]) -> fmt::Result {
    for (index, signal) in signals.iter().enumerate() {
        write!(f, "<{element} id=\"{}{index}\" name=\"{}\"", &element[..1], Exact(signal.name))?;
        attribute(f, "doc", signal.doc)?;
        f.write_str("/>\n")?;
    }
    Ok(())
}

fn terms(f: &mut Formatter<'_>, arcs: &[Arc]) -> fmt::Result {
    let term = |it: &Arc| write!(f, "<term place=\"p{}\" weight=\"{}\"/>", it.place.0, it.weight);
    arcs.iter().try_for_each(term)
}

fn law(f: &mut Formatter<'_>, law: &Law<'_>) -> fmt::Result {
    match *law {
        Law::Invariant { sum, equals } => {
            write!(f, "<invariant equals=\"{equals}\">")?;
            terms(f, sum)?;
            f.write_str("</invariant>\n")
        }
        Law::NeverBoth(a, b) => writeln!(f, "<never-both first=\"p{}\" second=\"p{}\"/>", a.0, b.0),
        Law::Reachable(place) => writeln!(f, "<reachable place=\"p{}\"/>", place.0),
        Law::AlwaysCan(place) => writeln!(f, "<always-can place=\"p{}\"/>", place.0),
        Law::HandlesAll => f.write_str("<handles-all/>\n"),
        Law::Settles => f.write_str("<settles/>\n"),
        Law::DeadlockFree { end: None } => f.write_str("<deadlock-free/>\n"),
        Law::DeadlockFree { end: Some(end) } => writeln!(f, "<deadlock-free end=\"p{}\"/>", end.0),
        Law::Deterministic => f.write_str("<deterministic/>\n"),
    }
}

fn write_place(f: &mut Formatter<'_>, index: usize, place: &Place<'_>) -> fmt::Result {
    writeln!(f, "<place id=\"p{index}\">")?;
    name(f, place.name)?;
    if place.initial > 0 {
        writeln!(f, "<initialMarking><text>{}</text></initialMarking>", place.initial)?;
    }
    let attributes = PlaceAttributes(place).to_string();
    if !attributes.is_empty() {
        writeln!(f, "{OWN}<place{attributes}/></toolspecific>")?;
    }
    f.write_str("</place>\n")
}

struct PlaceAttributes<'p>(&'p Place<'p>);

impl Display for PlaceAttributes<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let place = self.0;
        exact_name(f, place.name)?;
        attribute(f, "doc", place.doc)?;
        if place.bound != Place::UNBOUNDED {
            write!(f, " bound=\"{}\"", place.bound)?;
        }
        match place.role {
            Role::State => Ok(()),
            Role::Data => f.write_str(" role=\"data\""),
            Role::Complement(PlaceId(of)) => write!(f, " role=\"complement\" of=\"p{of}\""),
            Role::Shared => f.write_str(" role=\"shared\""),
            Role::Mailbox => f.write_str(" role=\"mailbox\""),
        }
    }
}

struct TransitionAttributes<'t> {
    index: usize,
    it: &'t Transition<'t>,
}

impl Display for TransitionAttributes<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let it = self.it;
        exact_name(f, it.name)?;
        attribute(f, "doc", it.doc)?;
        if it.line as usize != self.index {
            write!(f, " line=\"{}\"", it.line)?;
        }
        if let Some(event) = it.on {
            write!(f, " on=\"e{}\"", event.0)?;
        }
        if let [first, rest @ ..] = it.emits {
            write!(f, " emits=\"o{}", first.0)?;
            rest.iter().try_for_each(|output| write!(f, " o{}", output.0))?;
            f.write_str("\"")?;
        }
        if let Some(Within { earliest, latest }) = it.within {
            write!(f, " earliest=\"{earliest}\"")?;
            latest.map_or(Ok(()), |latest| write!(f, " latest=\"{latest}\""))?;
        }
        if it.priority == 0 { Ok(()) } else { write!(f, " priority=\"{}\"", it.priority) }
    }
}

fn delay(f: &mut Formatter<'_>, it: &Transition<'_>) -> fmt::Result {
    let (earliest, latest) = match (it.on, it.within) {
        (Some(_), within) => (within.map_or(0, |within| within.earliest), None),
        (None, Some(within)) => (within.earliest, within.latest),
        (None, None) => (0, Some(0)),
    };
    let closure = if latest.is_some() { "closed" } else { "closed-open" };
    write!(
        f,
        "<delay><interval xmlns=\"http://www.w3.org/1998/Math/MathML\" closure=\"{closure}\">\
         <cn>{earliest}</cn>"
    )?;
    match latest {
        Some(latest) => write!(f, "<cn>{latest}</cn>")?,
        None => f.write_str("<ci>infty</ci>")?,
    }
    f.write_str("</interval></delay>\n")
}

/// The arcs of the net, counted for their ids.
struct Arcs {
    written: usize,
}

impl Arcs {
    fn write(&mut self, f: &mut Formatter<'_>, index: usize, it: &Transition<'_>) -> fmt::Result {
        for arc in it.take {
            self.arc(f, &format!("p{}", arc.place.0), &format!("t{index}"), arc.weight.into(), 0)?;
        }
        for arc in it.read {
            self.arc(
                f,
                &format!("p{}", arc.place.0),
                &format!("t{index}"),
                arc.weight.into(),
                arc.weight,
            )?;
        }
        // Tokens read come back on the same arc as tokens added to the same place.
        let mut read: HashMap<PlaceId, u32> =
            it.read.iter().map(|arc| (arc.place, arc.weight)).collect();
        for arc in it.give {
            let read = read.remove(&arc.place).unwrap_or_default();
            let weight = u64::from(arc.weight) + u64::from(read);
            self.arc(f, &format!("t{index}"), &format!("p{}", arc.place.0), weight, read)?;
        }
        for arc in it.read.iter().filter(|arc| read.contains_key(&arc.place)) {
            self.arc(
                f,
                &format!("t{index}"),
                &format!("p{}", arc.place.0),
                arc.weight.into(),
                arc.weight,
            )?;
        }
        Ok(())
    }

    /// An arc from a place to a transition of such a kind.
    fn kind(
        &mut self,
        f: &mut Formatter<'_>,
        (place, transition): (PlaceId, TransitionId),
        kind: &str,
        weight: u32,
    ) -> fmt::Result {
        let (id, place, transition) = (self.written, place.0, transition.0);
        self.written += 1;
        write!(f, "<arc id=\"a{id}\" source=\"p{place}\" target=\"t{transition}\">")?;
        if weight != 1 {
            write!(f, "<inscription><text>{weight}</text></inscription>")?;
        }
        writeln!(f, "<type value=\"{kind}\"/></arc>")
    }

    fn arc(
        &mut self,
        f: &mut Formatter<'_>,
        source: &str,
        target: &str,
        weight: u64,
        read: u32,
    ) -> fmt::Result {
        write!(f, "<arc id=\"a{}\" source=\"{source}\" target=\"{target}\"", self.written)?;
        self.written += 1;
        if weight == 1 && read == 0 {
            return f.write_str("/>\n");
        }
        f.write_str(">")?;
        if weight != 1 {
            write!(f, "<inscription><text>{weight}</text></inscription>")?;
        }
        if read > 0 {
            write!(f, "{OWN}<arc read=\"{read}\"/></toolspecific>")?;
        }
        f.write_str("</arc>\n")
    }
}
