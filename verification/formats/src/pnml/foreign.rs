//! Parts of tools, `<toolspecific>`: those of this project, and the words of others that change
//! the firing.

use super::error::Finding;
use super::known::{is_tool, others};
use super::state::{Context, Label, Owner, Parser};
use super::xml::Tag;
use cotama_property::source::quoted;

/// Said once of a file in which a tool's part of a transition holds a delay.
const FOREIGN_DELAYS: &str = "delays in the parts of tools are left out: enabled transitions fire \
    in any order";

impl<'a> Parser<'a> {
    /// Opens a part of some tool.
    pub(super) fn toolspecific(
        &mut self,
        context: Context,
        tag: &Tag<'a>,
    ) -> Result<Context, Finding> {
        if is_invisible(context, tag)
            && let Some(transition) = self.document.transitions.last_mut()
        {
            transition.invisible = true;
        }
        let tool = tag.get("tool").map_or("", |tool| &tool.value);
        if tool == "cotama" {
            return own_part(context, tag);
        }
        let owner = match context {
            Context::Place => Owner::Place,
            Context::Transition => Owner::Transition,
            Context::Arc => Owner::Arc,
            _ => return Ok(Context::Skipped),
        };
        if !is_tool(tool) {
            self.note(format!("what the tool {} adds to the net is left out", quoted(tool)));
        }
        Ok(self.foreign(owner, tag))
    }

    /// Reads or refuses those words of another tool that change the firing.
    pub(super) fn foreign(&mut self, owner: Owner, tag: &Tag<'a>) -> Context {
        let context = Context::Foreign(owner);
        let property = tag.get("key").map(|key| key.value.to_ascii_lowercase());
        let name = tag.name.to_ascii_lowercase();
        match (owner, property.as_deref().unwrap_or(&name)) {
            (Owner::Arc, _) => {
                for (name, it) in others(tag, &["tool", "version", "id", "key"]) {
                    // An attribute that says a type may speak of anything else.
                    if !name.eq_ignore_ascii_case("type") {
                        self.kind_attribute(name, &it.value);
                    }
                }
                self.kind_element(tag).unwrap_or(context)
            }
            (Owner::Transition, "guard" | "condition" | "precondition") => {
                self.label(Label::Guard, tag)
            }
            (Owner::Transition, "priority") => self.label(Label::Priority, tag),
            (Owner::Transition, "distributiontype" | "timed") => self.label(Label::Timed, tag),
            (Owner::Place, "capacity") => self.label(Label::Capacity, tag),
            (Owner::Transition, "interval" | "delay") => {
                self.note(FOREIGN_DELAYS);
                context
            }
            _ => context,
        }
    }
}

fn own_part(context: Context, tag: &Tag<'_>) -> Result<Context, Finding> {
    match tag.get("version") {
        Some(version) if version.value != "1" => {
            let message = format!("a part of version {} of cotama", quoted(&version.value));
            Err(Finding::new(version.span, message)
                .help("this version reads version 1; the file is of a newer one"))
        }
        _ => Ok(match context {
            Context::Net => Context::OwnNet,
            Context::Place => Context::OwnPlace,
            Context::Transition => Context::OwnTransition,
            _ => Context::OwnArc,
        }),
    }
}

/// Whether `ProM` or pm4py says that a transition is one that no log shows.
fn is_invisible(context: Context, tag: &Tag<'_>) -> bool {
    let activity = tag.get("activity").map(|it| it.value.trim());
    context == Context::Transition && activity.is_some_and(|it| it == "$invisible$")
}
