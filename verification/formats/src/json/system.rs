//! Systems of nets as JSON: the format `cotama-system/1`.

mod defect;

use super::document::{Document, Ids, Named, Text};
use super::known::Known;
use super::name::{Misnamed, Name};
use super::{Whole, Wrong, read_document};
use cotama_core::net::{EventId, OutputId, PlaceId, TransitionId};
use cotama_core::system::owned::OwnedSystem;
use cotama_core::system::{Binding, Clear, Component, Delivery, Link, Of, System, Target};
use cotama_core::text;
use serde::{Deserialize, Serialize};

/// Value of the member `schema` of a system.
pub const SYSTEM_SCHEMA: &str = "cotama-system/1";
/// The most nets of a system.
const MAX_NETS: usize = u16::MAX as usize - 1;

/// A system with texts and references of type `S`: [`Text`] when written, [`Name`] when read.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Draft<S> {
    schema: S,
    name: S,
    doc: S,
    nets: Vec<Member<S>>,
    links: Vec<Joint<S>>,
    shared: Vec<Shared<S>>,
    clears: Vec<Empties<S>>,
}

/// A net with its name in the system.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Member<S> {
    name: S,
    net: Document<S>,
}

impl<'n> Member<Text<'n>> {
    fn of(it: &Component<'n>) -> Self {
        Self { name: Text::Name(it.name), net: Document::of(it.net) }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Joint<S> {
    from: S,
    pub(super) to: S,
    #[serde(default = "nothing", skip_serializing_if = "Option::is_none")]
    mail: Option<Whole<u16>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Shared<S> {
    pub(super) place: S,
    pub(super) of: Owner<S>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Owner<S> {
    Place(S),
    Mailbox(S),
}

impl<S> Owner<S> {
    pub(super) const fn name(&self) -> &S {
        match self {
            Self::Place(it) | Self::Mailbox(it) => it,
        }
    }
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Empties<S> {
    on: S,
    pub(super) mailbox: S,
}

const fn nothing<T>() -> Option<T> {
    None
}

/// The system as JSON: its nets as [`write()`](super::write) has them, and what connects them.
///
/// ```json
/// { "schema": "cotama-system/1", "name": "cell", "doc": "",
///   "nets": [{ "name": "arm", "net": { "schema": "cotama/net/1", "name": "arm" } }],
///   "links": [{ "from": "camera.part", "to": "arm.part", "mail": 2 },
///             { "from": "radio.lost", "to": "arm.stop" }],
///   "shared": [{ "place": "arm.safe", "of": { "place": "door.Closed" } },
///              { "place": "arm.asked", "of": { "mailbox": "arm.part" } }],
///   "clears": [{ "on": "arm.abort", "mailbox": "arm.part" }] }
/// ```
///
/// Nets act in the order in which they stand. A link with `mail` delivers to a mailbox that holds
/// so many, one without it at once.
///
/// [`read_system`] gives back the same system, unless names occur twice, `a.b` has two meanings
/// because names contain dots, the system has a [defect](System::defect), or the text is beyond the
/// limits: it then refuses the text. An id that is not there is written as a number.
pub fn write_system(system: &System<'_>) -> String {
    let net = |component: u16| system.components.get(usize::from(component));
    let port = |component: u16, part: Option<&str>, id: u32| match (net(component), part) {
        (Some(net), Some(part)) => Text::Port(format!("{}.{part}", net.name)),
        _ => Text::Unknown(id),
    };
    let output = |Of { component, id: OutputId(id) }| {
        let part = net(component).and_then(|it| it.net.outputs.get(id as usize));
        port(component, part.map(|it| it.name), id)
    };
    let event = |Of { component, id: EventId(id) }| {
        let part = net(component).and_then(|it| it.net.events.get(id as usize));
        port(component, part.map(|it| it.name), id)
    };
    let place = |Of { component, id: PlaceId(id) }| {
        let part = net(component).and_then(|it| it.net.places.get(id as usize));
        port(component, part.map(|it| it.name), id)
    };
    let joint = |it: &Link| Joint {
        from: output(it.from),
        to: event(it.to),
        mail: match it.delivery {
            Delivery::Now => None,
            Delivery::Mail { capacity } => Some(Whole(capacity)),
        },
    };
    let shared = |it: &Binding| Shared {
        place: place(it.shared),
        of: match it.target {
            Target::Place(of) => Owner::Place(place(of)),
            Target::Mailbox(of) => Owner::Mailbox(event(of)),
        },
    };
    let empties = |it: &Clear| Empties {
        on: event(it.on),
        mailbox: event(Of { component: it.on.component, id: it.mailbox }),
    };
    let draft = Draft {
        schema: Text::Name(SYSTEM_SCHEMA),
        name: Text::Name(system.name),
        doc: Text::Name(system.doc),
        nets: system.components.iter().map(Member::of).collect(),
        links: system.links.iter().map(joint).collect(),
        shared: system.bindings.iter().map(shared).collect(),
        clears: system.clears.iter().map(empties).collect(),
    };
    // strings and numbers: no error
    let text = serde_json::to_string_pretty(&draft).unwrap_or_default();
    format!("{}\n", text::json(&text))
}

/// The system of a JSON text as [`write_system`] makes it.
///
/// Members come in any order; of those of the system itself, `mail` alone may be missing, and none
/// may be unknown.
///
/// ```
/// use cotama_core::{net, system};
/// use cotama_verification::formats::json;
/// net! {
///     mod bell {
///         places { Here: 1 }
///         events { press }
///         outputs { ring }
///         transitions { ring on press: Here => Here emit ring; }
///     }
/// }
/// net! {
///     mod dog {
///         places { Asleep: 1, Awake }
///         events { heard }
///         transitions { wake on heard: Asleep => Awake; }
///     }
/// }
/// system! { mod house { nets { bell: bell, dog: dog } links { bell.ring => dog.heard mail 1; } } }
/// # fn main() {
/// let text = json::write_system(&house::SYSTEM);
/// let read = json::read_system(&text).unwrap();
/// read.with(|system| assert_eq!(*system, house::SYSTEM));
///
/// let wrong = json::read_system(&text.replace("dog.heard", "dog.hears")).unwrap_err();
/// assert!(wrong.to_string().ends_with("the net `dog` has no event `hears`"), "{wrong}");
/// assert_eq!(wrong.help.unwrap(), "did you mean `heard`?");
/// # }
/// ```
///
/// # Errors
/// The first thing that is wrong, and its place in the text.
pub fn read_system(text: &str) -> Result<OwnedSystem, Wrong> {
    let draft: Draft<Name> = read_document(text)?;
    draft.system().map_err(|it| it.placed(text))
}

/// The names of a system that messages are about.
pub(super) struct Ports<'n> {
    nets: &'n [(Name, Named)],
    pub(super) links: &'n [Joint<Name>],
    pub(super) shared: &'n [Shared<Name>],
    pub(super) clears: &'n [Empties<Name>],
}

impl Ports<'_> {
    /// Returns the name of a net in the system.
    pub(super) fn component(&self, it: u16) -> Option<&Name> {
        self.nets.get(usize::from(it)).map(|it| &it.0)
    }

    pub(super) fn net(&self, it: u16) -> &str {
        self.component(it).map_or("", Name::as_str)
    }

    pub(super) fn place(&self, of: Of<PlaceId>) -> Option<&Name> {
        self.nets.get(usize::from(of.component))?.1.places.get(of.id.0 as usize)
    }

    pub(super) fn transition(&self, of: Of<TransitionId>) -> Option<&Name> {
        self.nets.get(usize::from(of.component))?.1.transitions.get(of.id.0 as usize)
    }
}

impl Draft<Name> {
    fn system(self) -> Result<OwnedSystem, Misnamed> {
        if self.schema.text != SYSTEM_SCHEMA {
            let found = &self.schema.text;
            let message = format!("`schema` is `{found}`, but a system has `{SYSTEM_SCHEMA}`");
            return Err(Misnamed::new(&self.schema, message));
        }
        if self.nets.is_empty() || self.nets.len() > MAX_NETS {
            let message = format!("a system has 1 to {MAX_NETS} nets, not {}", self.nets.len());
            return Err(Misnamed::new(&self.name, message));
        }
        Ids::of("net", self.nets.iter().map(|it| &it.name))?;
        let (mut nets, mut names) = (Vec::new(), Vec::new());
        for Member { name, net } in self.nets {
            let (net, named) = net.net().map_err(|it| Misnamed {
                message: format!("the net `{}`: {}", name.text, it.message),
                ..it
            })?;
            nets.push((name.text.clone(), net));
            names.push((name, named));
        }
        let known = Known::of(&nets);
        let links = self.links.iter().map(|it| link(&known, it)).collect::<Result<_, _>>()?;
        let bindings =
            self.shared.iter().map(|it| binding(&known, it)).collect::<Result<_, _>>()?;
        let clears = self.clears.iter().map(|it| clear(&known, it)).collect::<Result<_, _>>()?;
        let system =
            OwnedSystem { name: self.name.text, doc: self.doc.text, nets, links, bindings, clears };
        let defect = system.with(|it: &System<'_>| it.defect());
        match defect {
            None => Ok(system),
            Some(it) => {
                let (links, shared, clears) = (&self.links, &self.shared, &self.clears);
                let ports = Ports { nets: &names, links, shared, clears };
                Err(defect::of_system(it, &ports))
            }
        }
    }
}

fn link(known: &Known<'_>, it: &Joint<Name>) -> Result<Link, Misnamed> {
    let from = known.output(&it.from)?;
    let delivery = match it.mail {
        None => Delivery::Now,
        Some(Whole(capacity)) => Delivery::Mail { capacity },
    };
    Ok(Link { from, to: known.event(&it.to)?, delivery })
}

fn binding(known: &Known<'_>, it: &Shared<Name>) -> Result<Binding, Misnamed> {
    let target = match &it.of {
        Owner::Place(it) => Target::Place(known.place(it)?),
        Owner::Mailbox(it) => Target::Mailbox(known.event(it)?),
    };
    Ok(Binding { shared: known.place(&it.place)?, target })
}

fn clear(known: &Known<'_>, it: &Empties<Name>) -> Result<Clear, Misnamed> {
    let (on, mailbox) = (known.event(&it.on)?, known.event(&it.mailbox)?);
    if on.component != mailbox.component {
        let message = format!("`{}` cannot empty a mailbox of another net", it.on.as_str());
        return Err(
            Misnamed::new(&it.mailbox, message).help("an event empties mailboxes of its own net")
        );
    }
    Ok(Clear { on, mailbox: mailbox.id })
}
