//! Reading of which kind an arc is, in all the ways in which tools say it.

use super::document::Text;
use super::error::Finding;
use super::kind::{Kind, says_kind};
use super::state::{Context, Label, Parser};
use super::xml::Tag;
use cotama_property::source::quoted;

impl<'a> Parser<'a> {
    /// Takes a kind to the arc that is open, from a word.
    pub(super) fn kind(&mut self, word: &Text<'a>) {
        let Some(kind) = Kind::of(&word.value) else {
            let message = format!("an arc of the kind {}", quoted(&word.value));
            self.findings.push(Finding::new(word.span, message).help(
                "ordinary arcs, read arcs (`test`), inhibitor arcs and reset arcs are read; write \
                 the net with these",
            ));
            return;
        };
        self.set_kind(kind, word);
    }

    fn set_kind(&mut self, kind: Kind, at: &Text<'a>) {
        let Some(arc) = self.document.arcs.last_mut() else { return };
        if arc.kind == Kind::Normal {
            arc.kind = kind;
        } else if kind != Kind::Normal && kind != arc.kind {
            self.findings.push(
                Finding::new(at.span, "an arc of two kinds")
                    .help("write two arcs, one of each kind"),
            );
        }
    }

    /// Reads what an attribute of an arc, or in an arc, says of its kind; whether it says that.
    pub(super) fn kind_attribute(&mut self, name: &str, value: &Text<'a>) -> bool {
        if says_kind(name) {
            self.kind(value);
            return true;
        }
        let Some(kind) = Kind::named(name) else { return false };
        match value.value.trim().to_ascii_lowercase().as_str() {
            "true" | "yes" | "1" => self.set_kind(kind, value),
            "false" | "no" | "0" => {}
            _ => {
                let message = format!("{} is neither `true` nor `false`", quoted(&value.value));
                self.findings.push(Finding::new(value.span, message).help("write one of the two"));
            }
        }
        true
    }

    /// Opens an element in an arc that says its kind; `None` when it says nothing of that.
    pub(super) fn kind_element(&mut self, tag: &Tag<'a>) -> Option<Context> {
        if says_kind(tag.name) {
            let context = self.label(Label::ArcKind, tag);
            let said = ["value", "id"].iter().find_map(|it| tag.get(it));
            if let Some(said) = said {
                self.text = Some(said.clone());
            }
            return Some(context);
        }
        let kind = Kind::named(tag.name)?;
        let at = Text { value: tag.name.into(), span: tag.span };
        self.set_kind(kind, &at);
        let context = self.label(Label::Wrapped, tag);
        if let Some(value) = tag.get("value") {
            self.text = Some(value.clone());
        }
        Some(context)
    }

    /// Reads the content of an element such as `<inhibitor>`: a number of tokens, or one token as
    /// SNAKES writes it.
    pub(super) fn wrapped(&mut self, text: &Text<'a>) {
        let said: String = text.value.split_whitespace().collect();
        let said = said.strip_suffix("True").unwrap_or(&said);
        let is_one = matches!(said, "" | "dot" | "1" | "true" | "token" | "•");
        let weight = said.parse::<u32>().ok().filter(|it| *it > 1);
        match (is_one, weight, self.document.arcs.last_mut()) {
            (true, ..) | (_, _, None) => {}
            (false, Some(value), Some(arc)) => {
                let weight = super::error::Spanned { value: value.into(), span: text.span };
                arc.weight = Some(Box::new(weight));
            }
            _ => {
                let message = format!("an arc with the annotation {}", quoted(&text.value));
                self.findings.push(
                    Finding::new(text.span, message)
                        .help("only arcs of tokens without colour are read: unfold the net first"),
                );
            }
        }
    }
}
