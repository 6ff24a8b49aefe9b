//! The contents of elements `<toolspecific tool="cotama">`, read from their tags.

use super::document::{OwnArc, OwnNet, OwnPlace, OwnTransition, RawIgnored, RawLaw, RawRole, Text};
use super::error::{Finding, Spanned};
use super::escape::unescape;
use super::state::{Context, Parser};
use super::xml::{Attribute, Tag, tag as shown};
use cotama_core::net::Within;
use cotama_core::net::owned::OwnedSignal;
use cotama_property::source::quoted;
use std::str::FromStr;

impl<'a> Parser<'a> {
    /// Reads an element inside of a part that this project defines.
    pub(super) fn own(&mut self, context: Context, tag: &Tag<'a>) -> Context {
        use Context::{
            Own, OwnArc, OwnIgnored, OwnInvariant, OwnNet, OwnPlace, OwnTransition, Skipped,
        };
        match (context, tag.name) {
            (OwnNet, _) => {
                let read = element(&mut self.document.own, tag);
                self.findings.keep(read);
                match tag.name {
                    "invariant" => OwnInvariant,
                    "ignored" => OwnIgnored,
                    _ => Own,
                }
            }
            (OwnInvariant | OwnIgnored, "term") => {
                let own = &mut self.document.own;
                let to = match own.laws.last_mut() {
                    _ if context == OwnIgnored => own.ignored.last_mut().map(|it| &mut it.guard),
                    Some(RawLaw::Invariant { sum, .. }) => Some(sum),
                    _ => None,
                };
                if let (Some(term), Some(to)) = (self.findings.keep(term(tag)), to) {
                    to.push(term);
                }
                Own
            }
            (OwnPlace, "place") => {
                let read = self.findings.keep(place(tag));
                if let (Some(own), Some(place)) = (read, self.document.places.last_mut()) {
                    place.own = Some(Box::new(own));
                }
                Own
            }
            (OwnTransition, "transition") => {
                let read = self.findings.keep(transition(tag));
                if let (Some(own), Some(transition)) = (read, self.document.transitions.last_mut())
                {
                    transition.own = Some(Box::new(own));
                }
                Own
            }
            (OwnArc, "arc") => {
                let read = self.findings.keep(arc(tag));
                if let (Some(own), Some(arc)) = (read, self.document.arcs.last_mut()) {
                    arc.own = own;
                }
                Own
            }
            _ => {
                self.findings.push(unknown(tag));
                Skipped
            }
        }
    }
}

/// Reads one element of the net-level part.
fn element<'a>(own: &mut OwnNet<'a>, tag: &Tag<'a>) -> Result<(), Finding> {
    match tag.name {
        "net" => {
            let fields = Fields::of(tag, &["name", "doc"])?;
            (own.name, own.doc) =
                (fields.string("name")?, fields.string("doc")?.unwrap_or_default());
        }
        "event" => own.events.push(signal(tag)?),
        "output" => own.outputs.push(signal(tag)?),
        "ignored" => {
            let fields = Fields::of(tag, &["event", "place"])?;
            let (event, place) = (fields.id("event")?, fields.id("place")?);
            own.ignored.push(RawIgnored { event, place, guard: Vec::new() });
        }
        _ => own.laws.push(law(tag)?),
    }
    Ok(())
}

fn law<'a>(tag: &Tag<'a>) -> Result<RawLaw<'a>, Finding> {
    let no_attributes = |law| Fields::of(tag, &[]).map(|_| law);
    match tag.name {
        "invariant" => {
            let equals = Fields::of(tag, &["equals"])?.required_number("equals")?;
            Ok(RawLaw::Invariant { sum: Vec::new(), equals })
        }
        "never-both" => {
            let fields = Fields::of(tag, &["first", "second"])?;
            Ok(RawLaw::NeverBoth(fields.id("first")?, fields.id("second")?))
        }
        "reachable" => Fields::of(tag, &["place"])?.id("place").map(RawLaw::Reachable),
        "always-can" => Fields::of(tag, &["place"])?.id("place").map(RawLaw::AlwaysCan),
        "handles-all" => no_attributes(RawLaw::HandlesAll),
        "settles" => no_attributes(RawLaw::Settles),
        "deadlock-free" => {
            let end = Fields::of(tag, &["end"])?.tag.get("end").cloned();
            Ok(RawLaw::DeadlockFree { end })
        }
        "deterministic" => no_attributes(RawLaw::Deterministic),
        _ => Err(unknown(tag)),
    }
}

/// Reads `<term>`: a place of an invariant or of a guard.
fn term<'a>(tag: &Tag<'a>) -> Result<(Text<'a>, u32), Finding> {
    let fields = Fields::of(tag, &["place", "weight"])?;
    let weight: u32 = fields.required_number("weight")?;
    if weight == 0 {
        return Err(Finding::new(tag.span, "a term of weight 0").help("remove it"));
    }
    Ok((fields.id("place")?, weight))
}

fn signal<'a>(tag: &Tag<'a>) -> Result<(Text<'a>, OwnedSignal), Finding> {
    let fields = Fields::of(tag, &["id", "name", "doc"])?;
    let name = fields.string("name")?.unwrap_or_default();
    Ok((fields.id("id")?, OwnedSignal { name, doc: fields.string("doc")?.unwrap_or_default() }))
}

fn place<'a>(tag: &Tag<'a>) -> Result<OwnPlace<'a>, Finding> {
    let fields = Fields::of(tag, &["name", "doc", "bound", "role", "of"])?;
    let role = match tag.get("role") {
        None => RawRole::State,
        Some(role) => match &*role.value {
            "state" => RawRole::State,
            "data" => RawRole::Data,
            "complement" => RawRole::Complement(fields.id("of")?),
            "shared" => RawRole::Shared,
            "mailbox" => RawRole::Mailbox,
            other => {
                return Err(Finding::new(role.span, format!("{} is not a role", quoted(other)))
                    .help("the roles are `state`, `data`, `complement`, `shared` and `mailbox`"));
            }
        },
    };
    Ok(OwnPlace {
        span: tag.span,
        name: fields.string("name")?,
        doc: fields.string("doc")?.unwrap_or_default(),
        bound: fields.number("bound")?,
        role,
    })
}

fn transition<'a>(tag: &Tag<'a>) -> Result<OwnTransition<'a>, Finding> {
    let known = ["name", "doc", "line", "on", "emits", "earliest", "latest", "priority"];
    let fields = Fields::of(tag, &known)?;
    let (earliest, latest) = (fields.number("earliest")?, fields.number("latest")?);
    let within = match (earliest, latest) {
        (Some(earliest), latest) if (Within { earliest, latest }).is_sound() => {
            Some(Within { earliest, latest })
        }
        (None, None) => None,
        _ => {
            return Err(Finding::new(
                tag.span,
                "the interval of a transition does not begin before it ends",
            )
            .help(format!(
                "give `earliest`, and no smaller `latest` up to {}, or none",
                Within::LATEST
            )));
        }
    };
    Ok(OwnTransition {
        name: fields.string("name")?,
        doc: fields.string("doc")?.unwrap_or_default(),
        line: fields.number("line")?,
        on: tag.get("on").cloned(),
        emits: tag.get("emits").cloned(),
        within,
        priority: fields.number("priority")?.unwrap_or_default(),
    })
}

fn arc(tag: &Tag<'_>) -> Result<OwnArc, Finding> {
    Ok(OwnArc { read: Fields::of(tag, &["read"])?.number("read")?.unwrap_or_default() })
}

fn unknown(tag: &Tag<'_>) -> Finding {
    Finding::new(tag.span, format!("cotama writes no {} here", shown(tag.name))).help(
        "this part is read by cotama alone: repair it, or remove the element `<toolspecific>`",
    )
}

/// The attributes of an element that this project defines.
struct Fields<'t, 'a> {
    tag: &'t Tag<'a>,
}

impl<'t, 'a> Fields<'t, 'a> {
    fn of(tag: &'t Tag<'a>, known: &[&str]) -> Result<Self, Finding> {
        let foreign = |attribute: &&Attribute<'_>| {
            !known.contains(&attribute.name) && !attribute.name.starts_with("xml")
        };
        match tag.attributes.iter().find(foreign) {
            None => Ok(Self { tag }),
            Some(Attribute { name, value }) => {
                let message = format!("{} has no attribute {}", shown(tag.name), quoted(name));
                Err(Finding::new(value.span, message)
                    .help("remove it; the element is one that cotama defines"))
            }
        }
    }

    fn string(&self, name: &str) -> Result<Option<String>, Finding> {
        self.tag.get(name).map(|text| unescape(&text.value, text.span)).transpose()
    }

    fn number<N: FromStr>(&self, name: &str) -> Result<Option<N>, Finding> {
        let Some(Spanned { value, span }) = self.tag.get(name) else { return Ok(None) };
        let refused = || {
            Finding::new(*span, format!("{} is not a number for `{name}`", quoted(value)))
                .help("write a whole number that is not too large")
        };
        value.parse().map(Some).map_err(|_| refused())
    }

    fn required_number<N: FromStr>(&self, name: &str) -> Result<N, Finding> {
        self.number(name)?.ok_or_else(|| self.missing(name))
    }

    fn id(&self, name: &str) -> Result<Text<'a>, Finding> {
        self.tag.get(name).cloned().ok_or_else(|| self.missing(name))
    }

    fn missing(&self, name: &str) -> Finding {
        missing(self.tag, name)
    }
}

/// An attribute that an element must have and does not.
pub(super) fn missing(tag: &Tag<'_>, name: &str) -> Finding {
    Finding::new(tag.span, format!("{} has no attribute `{name}`", shown(tag.name)))
        .help(format!("add `{name}=\"…\"`"))
}
