//! The members of the format, in the order in which they are written.

mod defect;

use super::name::{Misnamed, Name, meant};
use super::{MAX_ARCS, SCHEMA, Whole};
use cotama_core::net::owned::{
    OwnedIgnored, OwnedLaw, OwnedNet, OwnedPlace, OwnedSignal, OwnedTransition,
};
use cotama_core::net::{self, EventId, Law, Net, OutputId, PlaceId, Role};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Display;

/// A text, or a reference by name, that is written.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Text<'n> {
    Name(&'n str),
    /// A name of two parts.
    Port(String),
    /// An id that the net does not have: a number, which is refused when it is read.
    Unknown(u32),
}

/// A net with texts and references of type `S`: [`Text`] when written, [`Name`] when read.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Document<S> {
    schema: S,
    name: S,
    doc: S,
    places: Vec<Place<S>>,
    events: Vec<Signal<S>>,
    outputs: Vec<Signal<S>>,
    transitions: Vec<Transition<S>>,
    ignored: Vec<Ignored<S>>,
    laws: Vec<LawOf<S>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Place<S> {
    name: S,
    doc: S,
    initial: Whole<u32>,
    bound: Option<Whole<u32>>,
    role: RoleOf<S>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum RoleOf<S> {
    State,
    Data,
    Complement(S),
    Shared,
    Mailbox,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Signal<S> {
    name: S,
    doc: S,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Transition<S> {
    name: S,
    doc: S,
    line: Whole<u32>,
    on: Option<S>,
    take: Vec<Arc<S>>,
    read: Vec<Arc<S>>,
    give: Vec<Arc<S>>,
    emits: Vec<S>,
    within: Option<Within>,
    priority: Whole<i16>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Arc<S> {
    place: S,
    weight: Whole<u32>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Within {
    earliest: Whole<u32>,
    latest: Option<Whole<u32>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ignored<S> {
    event: S,
    place: S,
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    guard: Vec<Arc<S>>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum LawOf<S> {
    Invariant { sum: Vec<Arc<S>>, equals: Whole<u32> },
    NeverBoth(S, S),
    Reachable(S),
    AlwaysCan(S),
    HandlesAll,
    Settles,
    DeadlockFree { end: Option<S> },
    Deterministic,
}

impl<'n> Document<Text<'n>> {
    pub(super) fn of(net: &Net<'n>) -> Self {
        let place = |PlaceId(id)| {
            net.places.get(id as usize).map_or(Text::Unknown(id), |it| Text::Name(it.name))
        };
        let event = |EventId(id)| {
            net.events.get(id as usize).map_or(Text::Unknown(id), |it| Text::Name(it.name))
        };
        let output = |OutputId(id)| {
            net.outputs.get(id as usize).map_or(Text::Unknown(id), |it| Text::Name(it.name))
        };
        let signals = |list: &[net::Signal<'n>]| {
            list.iter()
                .map(|it| Signal { name: Text::Name(it.name), doc: Text::Name(it.doc) })
                .collect()
        };
        let arcs = |list: &[net::Arc]| {
            list.iter()
                .map(|arc| Arc { place: place(arc.place), weight: Whole(arc.weight) })
                .collect()
        };
        let role = |role: Role| match role {
            Role::State => RoleOf::State,
            Role::Data => RoleOf::Data,
            Role::Complement(of) => RoleOf::Complement(place(of)),
            Role::Shared => RoleOf::Shared,
            Role::Mailbox => RoleOf::Mailbox,
        };
        let places = net.places.iter().map(|it| Place {
            name: Text::Name(it.name),
            doc: Text::Name(it.doc),
            initial: Whole(it.initial),
            bound: (it.bound != net::Place::UNBOUNDED).then_some(Whole(it.bound)),
            role: role(it.role),
        });
        let transitions = net.transitions.iter().map(|it| Transition {
            name: Text::Name(it.name),
            doc: Text::Name(it.doc),
            line: Whole(it.line),
            on: it.on.map(event),
            take: arcs(it.take),
            read: arcs(it.read),
            give: arcs(it.give),
            emits: it.emits.iter().copied().map(output).collect(),
            within: it
                .within
                .map(|it| Within { earliest: Whole(it.earliest), latest: it.latest.map(Whole) }),
            priority: Whole(it.priority),
        });
        let law = |law: &Law<'n>| match *law {
            Law::Invariant { sum, equals } => {
                LawOf::Invariant { sum: arcs(sum), equals: Whole(equals) }
            }
            Law::NeverBoth(a, b) => LawOf::NeverBoth(place(a), place(b)),
            Law::Reachable(it) => LawOf::Reachable(place(it)),
            Law::AlwaysCan(it) => LawOf::AlwaysCan(place(it)),
            Law::HandlesAll => LawOf::HandlesAll,
            Law::Settles => LawOf::Settles,
            Law::DeadlockFree { end } => LawOf::DeadlockFree { end: end.map(place) },
            Law::Deterministic => LawOf::Deterministic,
        };
        Self {
            schema: Text::Name(SCHEMA),
            name: Text::Name(net.name),
            doc: Text::Name(net.doc),
            places: places.collect(),
            events: signals(net.events),
            outputs: signals(net.outputs),
            transitions: transitions.collect(),
            ignored: net
                .ignored
                .iter()
                .map(|it| Ignored {
                    event: event(it.event),
                    place: place(it.place),
                    guard: arcs(it.guard),
                })
                .collect(),
            laws: net.laws.iter().map(law).collect(),
        }
    }
}

/// The ids of the names of one list.
pub(super) struct Ids {
    kind: &'static str,
    ids: BTreeMap<String, u32>,
}

impl Ids {
    pub(super) fn of<'a>(
        kind: &'static str,
        names: impl Iterator<Item = &'a Name>,
    ) -> Result<Self, Misnamed> {
        let mut ids = BTreeMap::new();
        for (name, id) in names.zip(0..) {
            if ids.insert(name.text.clone(), id).is_some() {
                let message = format!("two {kind}s are named `{}`", name.text);
                return Err(Misnamed::new(name, message).help("give each a name of its own"));
            }
        }
        Ok(Self { kind, ids })
    }

    fn find(&self, name: &Name, at: &dyn Display) -> Result<u32, Misnamed> {
        self.ids.get(&name.text).copied().ok_or_else(|| {
            let (kind, it) = (self.kind, &name.text);
            let message = format!("{at} names the {kind} `{it}`, which the net does not have");
            let near = meant(it, self.ids.keys().map(String::as_str));
            match near {
                Some(near) => Misnamed::new(name, message).help(near),
                None => Misnamed::new(name, message),
            }
        })
    }
}

/// Subject of an error.
enum At<'a> {
    Place(&'a Name),
    Transition(&'a Name),
    /// An entry of a list, from 0.
    Entry(&'static str, usize),
}

impl Display for At<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Place(name) => write!(f, "place `{}`", name.text),
            Self::Transition(name) => write!(f, "transition `{}`", name.text),
            Self::Entry(list, number) => write!(f, "entry {} of `{list}`", number + 1),
        }
    }
}

impl Document<Name> {
    /// The net, and where its places and transitions are named.
    pub(super) fn net(self) -> Result<(OwnedNet, Named), Misnamed> {
        if self.schema.text != SCHEMA {
            let found = &self.schema.text;
            let message = format!("`schema` is `{found}`, but a net has `{SCHEMA}`");
            return Err(Misnamed::new(&self.schema, message));
        }
        let names = Names {
            places: Ids::of("place", self.places.iter().map(|it| &it.name))?,
            events: Ids::of("event", self.events.iter().map(|it| &it.name))?,
            outputs: Ids::of("output", self.outputs.iter().map(|it| &it.name))?,
        };
        let signals = |list: Vec<Signal<Name>>| {
            let owned = |it: Signal<Name>| OwnedSignal { name: it.name.text, doc: it.doc.text };
            list.into_iter().map(owned).collect()
        };
        let named = Named {
            net: self.name.clone(),
            places: self.places.iter().map(|it| it.name.clone()).collect(),
            transitions: self.transitions.iter().map(|it| it.name.clone()).collect(),
        };
        let places = self.places.into_iter().map(|it| names.owned_place(it));
        let transitions = self.transitions.into_iter().map(|it| names.transition(it));
        let ignored = self.ignored.iter().enumerate().map(|it| names.ignored(it));
        let laws = self.laws.iter().enumerate().map(|it| names.law(it));
        let net = OwnedNet {
            name: self.name.text,
            doc: self.doc.text,
            places: places.collect::<Result<_, _>>()?,
            events: signals(self.events),
            outputs: signals(self.outputs),
            transitions: transitions.collect::<Result<_, _>>()?,
            ignored: ignored.collect::<Result<_, _>>()?,
            laws: laws.collect::<Result<_, _>>()?,
        };
        match net.view().net().defect() {
            None => Ok((net, named)),
            Some(it) => Err(defect::of_net(it, &named)),
        }
    }
}

/// The names of a net that messages are about.
pub(super) struct Named {
    pub(super) net: Name,
    pub(super) places: Vec<Name>,
    pub(super) transitions: Vec<Name>,
}

struct Names {
    places: Ids,
    events: Ids,
    outputs: Ids,
}

impl Names {
    fn place(&self, name: &Name, at: &dyn Display) -> Result<PlaceId, Misnamed> {
        self.places.find(name, at).map(PlaceId)
    }

    fn owned_place(&self, it: Place<Name>) -> Result<OwnedPlace, Misnamed> {
        let role = match &it.role {
            RoleOf::State => Role::State,
            RoleOf::Data => Role::Data,
            RoleOf::Complement(of) => Role::Complement(self.place(of, &At::Place(&it.name))?),
            RoleOf::Shared => Role::Shared,
            RoleOf::Mailbox => Role::Mailbox,
        };
        let bound = it.bound.map_or(net::Place::UNBOUNDED, |it| it.0);
        Ok(OwnedPlace { name: it.name.text, doc: it.doc.text, initial: it.initial.0, bound, role })
    }

    fn arcs(&self, list: &[Arc<Name>], at: &dyn Display) -> Result<Vec<net::Arc>, Misnamed> {
        if list.len() > MAX_ARCS {
            let message = format!("{at} has more than {MAX_ARCS} arcs");
            return Err(Misnamed::about(list.first().map(|it| &it.place), message));
        }
        let arc = |it: &Arc<Name>| {
            Ok(net::Arc { place: self.place(&it.place, at)?, weight: it.weight.0 })
        };
        list.iter().map(arc).collect()
    }

    fn transition(&self, it: Transition<Name>) -> Result<OwnedTransition, Misnamed> {
        let at = At::Transition(&it.name);
        let output = |name: &Name| self.outputs.find(name, &at).map(OutputId);
        let on = it.on.as_ref().map(|name| self.events.find(name, &at).map(EventId)).transpose()?;
        let (take, read, give) =
            (self.arcs(&it.take, &at)?, self.arcs(&it.read, &at)?, self.arcs(&it.give, &at)?);
        let emits = it.emits.iter().map(output).collect::<Result<_, _>>()?;
        let within = it
            .within
            .map(|it| net::Within { earliest: it.earliest.0, latest: it.latest.map(|it| it.0) });
        let (line, priority) = (it.line.0, it.priority.0);
        Ok(OwnedTransition {
            name: it.name.text,
            doc: it.doc.text,
            line,
            on,
            take,
            read,
            give,
            emits,
            within,
            priority,
        })
    }

    fn ignored(&self, (position, it): (usize, &Ignored<Name>)) -> Result<OwnedIgnored, Misnamed> {
        let at = At::Entry("ignored", position);
        Ok(OwnedIgnored {
            event: self.events.find(&it.event, &at).map(EventId)?,
            place: self.place(&it.place, &at)?,
            guard: self.arcs(&it.guard, &at)?,
        })
    }

    fn law(&self, (position, it): (usize, &LawOf<Name>)) -> Result<OwnedLaw, Misnamed> {
        let at = At::Entry("laws", position);
        let place = |name: &Name| self.place(name, &at);
        Ok(match it {
            LawOf::Invariant { sum, equals } => {
                OwnedLaw::Invariant { sum: self.arcs(sum, &at)?, equals: equals.0 }
            }
            LawOf::NeverBoth(a, b) => OwnedLaw::NeverBoth(place(a)?, place(b)?),
            LawOf::Reachable(it) => OwnedLaw::Reachable(place(it)?),
            LawOf::AlwaysCan(it) => OwnedLaw::AlwaysCan(place(it)?),
            LawOf::HandlesAll => OwnedLaw::HandlesAll,
            LawOf::Settles => OwnedLaw::Settles,
            LawOf::DeadlockFree { end } => {
                OwnedLaw::DeadlockFree { end: end.as_ref().map(place).transpose()? }
            }
            LawOf::Deterministic => OwnedLaw::Deterministic,
        })
    }
}
