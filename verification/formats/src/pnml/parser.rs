//! From tags to the parts of a net: which element may stand where, and what its text says.

use super::Limits;
use super::document::{Document, Object, OwnArc, RawArc, RawPlace, RawTransition, Reference, Text};
use super::error::{Finding, Findings, Span, Spanned};
use super::escape::trimmed;
use super::kind::Kind;
use super::known::{
    is_harmless, is_net_type, is_tapaal, other_format, others, tapaal, unknown, unknown_attribute,
};
use super::own::missing;
use super::state::{Context, Label, Parser};
use super::xml::{Tag, Token, Xml, tag as shown, too_long};
use cotama_property::source::quoted;
use std::borrow::Cow;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// Said once of a file that says where runs are to end.
const FINAL_MARKINGS: &str = "the file says in which markings runs are to end; here a marking in \
    which nothing can fire is a deadlock wherever it is";

/// Reads the parts of the one P/T net of a file. With findings there is a document only if no part
/// is missing.
pub(super) fn parse(text: &str, limits: Limits) -> (Option<Document<'_>>, Findings) {
    let mut parser = Parser {
        xml: Xml::new(text, limits),
        limits,
        // An object takes 60 bytes of a file or more.
        document: Document { ids: HashMap::with_capacity(text.len() / 128), ..Document::default() },
        findings: Findings::default(),
        contexts: Vec::new(),
        text: None,
        labels: Vec::new(),
        bounds: Vec::new(),
        closure: Cow::Borrowed("closed"),
        net: None,
        coloured: None,
        objects: 0,
        incomplete: false,
    };
    match parser.run() {
        Ok(()) if !parser.incomplete => (Some(parser.document), parser.findings),
        Ok(()) => (None, parser.findings),
        Err(finding) => {
            parser.findings.push(finding);
            (None, parser.findings)
        }
    }
}

impl<'a> Parser<'a> {
    fn run(&mut self) -> Result<(), Finding> {
        while let Some(token) = self.xml.next()? {
            match token {
                Token::Start(tag) => {
                    let context = self.start(&tag)?;
                    self.contexts.push(context);
                }
                Token::Text(text) => self.append(text)?,
                Token::End => {
                    let closed = self.contexts.pop();
                    self.end(closed);
                }
            }
        }
        match (self.net, self.coloured) {
            (Some(_), _) => Ok(()),
            (None, Some(span)) => Err(coloured(span)),
            (None, None) => Err(Finding::new(Span::default(), "the file has no `<net>`")
                .help("a PNML file has a `<net>` element in its `<pnml>` element")),
        }
    }

    fn start(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        use Context::{
            Arc, Bound, Delay, Foreign, Inside, Interval, Net, Own, OwnArc, OwnIgnored,
            OwnInvariant, OwnNet, OwnPlace, OwnTransition, Page, Place, Pnml, Reference, Skipped,
            Transition,
        };
        let Some(&context) = self.contexts.last() else { return root(tag) };
        if is_tapaal(tag) && !matches!(context, Skipped | Foreign(_)) {
            return Err(tapaal(tag.span));
        }
        Ok(match (context, tag.name) {
            (Context::Skipped, _) | (Page | Reference, "toolspecific") => Skipped,
            (Pnml, "net") => self.net(tag)?,
            (Net | Page, "page") => self.page(tag)?,
            (Net | Page, "place") => self.place(tag)?,
            (Net | Page, "transition") => self.transition(tag)?,
            (Net | Page, "arc") => self.arc(tag)?,
            (Net | Page, name) if Kind::of_element(name).is_some() => self.arc(tag)?,
            (Net | Page, "referencePlace" | "referenceTransition") => self.reference(tag)?,
            (Net | Place | Transition, "name") => self.label(Label::Name, tag),
            (Place, "initialMarking") => self.label(Label::InitialMarking, tag),
            (Place, "capacity") => self.label(Label::Capacity, tag),
            (Transition, "timed") => self.label(Label::Timed, tag),
            (Transition, "priority") => self.label(Label::Priority, tag),
            (Transition, "guard") => self.label(Label::Guard, tag),
            (Transition, "delay") => Delay,
            (Arc, "inscription") => self.label(Label::Inscription, tag),
            (Context::Label(Label::Wrapped, _) | Inside, _) => Inside,
            (Pnml | Net | Page, "finalmarkings") | (Place, "finalMarking") => {
                self.note(FINAL_MARKINGS);
                Skipped
            }
            (Place, "hlinitialMarking" | "type")
            | (Transition, "condition")
            | (Arc, "hlinscription") => {
                return Err(coloured(tag.span));
            }
            (Net | Place | Transition | Arc, "toolspecific") => self.toolspecific(context, tag)?,
            (Context::Label(label, _), "text" | "value") => {
                let empty = Spanned { value: Cow::Borrowed(""), span: end_of(tag.span) };
                if let Some(first) = self.text.replace(empty)
                    && !label.holds_text()
                {
                    self.findings.push(
                        Finding::new(tag.span, "a second value of one label")
                            .help("remove it")
                            .related(first.span),
                    );
                }
                Context::Text
            }
            (Delay, "interval") => {
                self.bounds.clear();
                self.closure = tag
                    .get("closure")
                    .map_or(Cow::Borrowed("closed"), |closure| closure.value.clone());
                Interval(tag.span)
            }
            (Interval(_), "cn" | "ci") => {
                self.text = Some(Spanned { value: Cow::Borrowed(""), span: end_of(tag.span) });
                Bound
            }
            (Interval(_), "infinity") => {
                self.bounds.push(Spanned { value: Cow::Borrowed("infty"), span: tag.span });
                Skipped
            }
            (Foreign(owner), _) => self.foreign(owner, tag),
            (OwnNet | OwnPlace | OwnTransition | OwnArc | OwnInvariant | OwnIgnored | Own, _) => {
                self.own(context, tag)
            }
            (
                _,
                "place"
                | "transition"
                | "arc"
                | "page"
                | "referencePlace"
                | "referenceTransition"
                | "net",
            ) => {
                return Err(Finding::new(
                    tag.span,
                    format!("{} cannot stand in here", shown(tag.name)),
                )
                .help("close the element that is open before it"));
            }
            (Pnml, _) => Skipped,
            (context, name) if is_harmless(context, name) => Skipped,
            (Arc | Context::Label(Label::Inscription, _), _) => match self.kind_element(tag) {
                Some(context) => context,
                None => self.unknown(tag, "an arc"),
            },
            (Net | Page, _) => self.unknown(tag, "the net"),
            (Place, _) => self.unknown(tag, "a place"),
            (Transition | Delay | Interval(_), _) => self.unknown(tag, "a transition"),
            (Reference, _) => self.unknown(tag, "a reference"),
            (Context::Label(Label::InitialMarking, _), _) => self.unknown(tag, "a marking"),
            _ => Skipped,
        })
    }

    fn unknown(&mut self, tag: &Tag<'a>, place: &str) -> Context {
        self.findings.push(unknown(tag, place));
        Context::Skipped
    }

    pub(super) fn note(&mut self, note: impl Into<String>) {
        self.document.notes.insert(note.into());
    }

    /// Refuses attributes of a node that may change what it means.
    fn check_attributes(&mut self, tag: &Tag<'a>, known: &[&str]) {
        for (name, it) in others(tag, known) {
            self.findings.push(unknown_attribute(tag, name, it.value.span));
        }
    }

    fn net(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        if tag.get("type").is_some_and(|of| is_coloured(&of.value)) {
            self.coloured.get_or_insert(tag.span);
            return Ok(Context::Skipped);
        }
        if let Some(first) = self.net {
            return Err(Finding::new(tag.span, "a second net in the file")
                .help("give each net a file of its own")
                .related(first));
        }
        self.net = Some(tag.span);
        if let Some(of) = tag.get("type").filter(|of| !is_net_type(&of.value)) {
            self.note(format!("a net of the type {} is read as a P/T net", quoted(&of.value)));
        }
        self.document.id = tag.get("id").map_or(Cow::Borrowed("net"), |id| id.value.clone());
        Ok(Context::Net)
    }

    fn page(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        self.object(tag, Object::Page)?;
        Ok(Context::Page)
    }

    fn place(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        self.check_attributes(tag, &["id"]);
        if let Some(id) = self.node(tag, Object::Place(self.document.places.len() as u32))? {
            self.document.places.push(RawPlace { id, name: None, initial: 0, own: None });
        }
        Ok(Context::Place)
    }

    fn transition(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        if let Some(id) =
            self.node(tag, Object::Transition(self.document.transitions.len() as u32))?
        {
            self.document.transitions.push(RawTransition {
                id,
                name: None,
                delay: None,
                invisible: false,
                is_random: false,
                priority: None,
                own: None,
            });
        }
        self.check_attributes(tag, &["id", "guard", "priority", "invisible"]);
        for (name, label) in [("guard", Label::Guard), ("priority", Label::Priority)] {
            if let Some(said) = tag.get(name) {
                self.labelled(label, Some(said.clone()), said.span);
            }
        }
        Ok(Context::Transition)
    }

    fn reference(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        self.check_attributes(tag, &["id", "ref"]);
        let id = self.node(tag, Object::Reference(self.document.references.len() as u32))?;
        let to = self.required(tag, "ref");
        if let (Some(id), Some(to)) = (id, to) {
            let to_place = tag.name == "referencePlace";
            self.document.references.push(Reference { id, to, to_place });
        }
        Ok(Context::Reference)
    }

    fn arc(&mut self, tag: &Tag<'a>) -> Result<Context, Finding> {
        self.object(tag, Object::Arc)?;
        if let (Some(source), Some(target)) =
            (self.required(tag, "source"), self.required(tag, "target"))
        {
            let own = OwnArc::default();
            self.document.arcs.push(RawArc {
                span: tag.span,
                source,
                target,
                weight: None,
                kind: Kind::of_element(tag.name).unwrap_or_default(),
                own,
            });
        }
        for (name, it) in others(tag, &["id", "source", "target"]) {
            if !self.kind_attribute(name, &it.value) {
                self.findings.push(unknown_attribute(tag, name, it.value.span));
            }
        }
        Ok(Context::Arc)
    }

    /// The id of a node.
    fn node(&mut self, tag: &Tag<'a>, object: Object) -> Result<Option<Text<'a>>, Finding> {
        self.object(tag, object)?;
        Ok(self.required(tag, "id"))
    }

    /// Counts an object and notes its id, if it has one.
    fn object(&mut self, tag: &Tag<'a>, object: Object) -> Result<(), Finding> {
        self.labels.clear();
        self.objects += 1;
        if self.objects > self.limits.objects {
            return Err(Finding::new(
                tag.span,
                format!("the net has more than {} parts", self.limits.objects),
            )
            .help("raise the limit, or make the net smaller"));
        }
        let Some(id) = tag.get("id") else { return Ok(()) };
        let is_free = |object| matches!(object, Object::Arc | Object::Page);
        match self.document.ids.entry(id.value.clone()) {
            Entry::Vacant(entry) => {
                entry.insert((object, id.span));
            }
            // Nothing refers to arcs and pages: their ids are kept for messages.
            Entry::Occupied(_) if is_free(object) => {}
            Entry::Occupied(mut entry) if is_free(entry.get().0) => {
                entry.insert((object, id.span));
            }
            Entry::Occupied(entry) => {
                let (first, span) = *entry.get();
                let message =
                    format!("the id {} is that of {} already", quoted(&id.value), first.noun());
                self.findings.push(
                    Finding::new(id.span, message)
                        .help("give every part of the net an id of its own")
                        .related(span),
                );
                self.incomplete = true;
            }
        }
        Ok(())
    }

    fn required(&mut self, tag: &Tag<'a>, name: &str) -> Option<Text<'a>> {
        let value = tag.get(name).cloned();
        if value.is_none() {
            self.findings.push(missing(tag, name));
            self.incomplete = true;
        }
        value
    }

    pub(super) fn label(&mut self, label: Label, tag: &Tag<'a>) -> Context {
        let net = matches!(self.contexts.last(), Some(Context::Net));
        if !net && self.labels.contains(&label) {
            let message = format!("a second {} of one object", shown(tag.name));
            self.findings.push(Finding::new(tag.span, message).help("remove one of them"));
        }
        self.labels.push(label);
        let empty = || Spanned { value: Cow::Borrowed(""), span: end_of(tag.span) };
        self.text = label.holds_text().then(empty);
        Context::Label(label, tag.span)
    }

    fn append(&mut self, piece: Text<'a>) -> Result<(), Finding> {
        let counts = match self.contexts.last() {
            Some(Context::Text | Context::Bound | Context::Inside) => true,
            Some(Context::Label(label, _)) => label.holds_text(),
            _ => false,
        };
        let (true, Some(text)) = (counts, &mut self.text) else { return Ok(()) };
        if text.value.is_empty() {
            *text = piece;
        } else {
            text.value.to_mut().push_str(&piece.value);
            text.span.end = piece.span.end;
        }
        if text.value.len() > self.limits.text {
            return Err(too_long(text.span, self.limits.text));
        }
        Ok(())
    }

    fn end(&mut self, closed: Option<Context>) {
        match closed {
            Some(Context::Label(label, span)) => {
                let text = self
                    .text
                    .take()
                    .map(|text| Spanned { value: trimmed(text.value), span: text.span });
                self.labelled(label, text, span);
            }
            Some(Context::Bound) => {
                let bound = self.text.take();
                self.bounds.extend(bound.filter(|_| self.bounds.len() < 3));
            }
            Some(Context::Interval(span)) => {
                let delay = self.interval(span);
                let delay = self.findings.keep(delay);
                if let Some(transition) = self.document.transitions.last_mut() {
                    transition.delay = delay;
                }
            }
            _ => {}
        }
    }
}

fn root(tag: &Tag<'_>) -> Result<Context, Finding> {
    match tag.name {
        "pnml" => Ok(Context::Pnml),
        "html" => Err(Finding::new(tag.span, "this is a web page, not a PNML file")
            .help("save the file that it shows or links to")),
        other => Err(Finding::new(
            tag.span,
            format!("the element of the file is {}, not `<pnml>`", shown(other)),
        )
        .help(
            other_format(other)
                .unwrap_or("this is a file of another format; export the net as PNML"),
        )),
    }
}

/// Whether a net type is one of the coloured (high-level) ones.
fn is_coloured(of: &str) -> bool {
    let of = of.to_ascii_lowercase();
    ["symmetricnet", "highlevelnet", "hlpn", "colour", "colored", "snnet"]
        .iter()
        .any(|word| of.contains(word))
}

fn coloured(span: Span) -> Finding {
    Finding::new(span, "a coloured (high-level) net").help(
        "unfold it into a P/T net first; the Model Checking Contest gives most of its nets in both \
         forms",
    )
}

/// The empty place behind a tag.
fn end_of(span: Span) -> Span {
    Span { start: span.end, end: span.end }
}
