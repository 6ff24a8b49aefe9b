//! The parts of a requirement, and the table in which requirements are written.

use super::guarded::Guarded;
use crate::cotama::label::Label;
use cotama_core::net::{PlaceId, Transition};
use cotama_core::system::System;

/// Something that the decisional level is required to do. What is known of it may come in parts,
/// each with its own proof.
///
/// ```
/// use cotama_models::cotama::{Label, REQUIREMENTS};
/// let first = &REQUIREMENTS[0];
/// assert_eq!((first.id, first.label), ("GS1", Label::Stated));
/// assert_eq!(first.sentence, "The mission is in exactly one place.");
/// assert!(first.asked.unwrap().text.starts_with("AG gs.Wait + gs.DriveA"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Requirement {
    /// Short name, for example `GS3`.
    pub id: &'static str,
    /// The requirement in a sentence.
    pub sentence: &'static str,
    /// Source of the requirement.
    pub label: Label,
    /// The question to a checker.
    pub asked: Option<Asked>,
    /// The outputs that transitions have to emit.
    pub said: &'static [Said],
    /// The conditions that transitions have to check.
    pub guarded: &'static [Guarded],
    /// The file of the tests that show the rest, in which a comment of one of them has its short
    /// name.
    pub tests: Option<&'static str>,
}

/// A property of the net of rounds.
#[derive(Clone, Copy, Debug)]
pub struct Asked {
    /// The observers that the question needs.
    pub watches: &'static [Watch],
    /// The property.
    pub text: &'static str,
}

/// Counts in how many rounds a duty lasts: it begins where the first condition is found and ends
/// where the second one is, no sooner than a round later. It is a place of its name.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    /// Name of the observer.
    pub name: &'static str,
    /// Whether it looks at the end of a round, or else when every net has had its turn and what is
    /// outside has not.
    pub at_end: bool,
    /// The condition that begins the interval.
    pub begins: &'static str,
    /// The condition that ends the interval.
    pub ends: &'static str,
    /// Largest count.
    pub most: u32,
}

/// Every transition of a net that goes from one of the places `from` to one of the places `to` says
/// `output`.
#[derive(Clone, Copy, Debug)]
pub struct Said {
    /// The net, by its name in the system.
    pub net: &'static str,
    /// The places that the transitions leave; if empty, any but `to`.
    pub from: &'static [&'static str],
    /// The places that the transitions reach.
    pub to: &'static [&'static str],
    /// The output that the transitions emit.
    pub output: &'static str,
    /// The event that they answer, where not all of them are meant.
    pub on: Option<&'static str>,
}

impl Said {
    /// The transitions of a system that do not say it; of a system without such a net none.
    ///
    /// ```
    /// use cotama_models::cotama::{REQUIREMENTS, delivery};
    /// let mut said = REQUIREMENTS.iter().flat_map(|it| it.said);
    /// assert!(said.all(|it| it.unsaid(&delivery::SYSTEM).next().is_none()));
    /// ```
    pub fn unsaid<'s>(self, system: &System<'s>) -> impl Iterator<Item = &'s str> {
        let net = system.components.iter().find(|it| it.name == self.net).map(|it| it.net);
        net.into_iter().flat_map(move |net| {
            let named = |place: PlaceId, names: &[&str]| {
                net.places.get(place.0 as usize).is_some_and(|it| names.contains(&it.name))
            };
            let is_meant = move |it: &&Transition<'s>| {
                let goes = it.give.iter().any(|arc| named(arc.place, self.to));
                let comes = it.take.iter().any(|arc| named(arc.place, self.from));
                let stays = it.take.iter().any(|arc| named(arc.place, self.to));
                let event = it.on.and_then(|on| net.events.get(on.0 as usize)).map(|it| it.name);
                let answers = self.on.is_none() || self.on == event;
                goes && answers && (comes || (self.from.is_empty() && !stays))
            };
            let says = move |it: &Transition<'s>| {
                it.emits.iter().any(|id| {
                    net.outputs.get(id.0 as usize).is_some_and(|it| it.name == self.output)
                })
            };
            net.transitions.iter().filter(is_meant).filter(move |it| !says(it)).map(|it| it.name)
        })
    }
}

pub(super) const fn said(
    net: &'static str,
    from: &'static [&'static str],
    to: &'static [&'static str],
    output: &'static str,
) -> Said {
    Said { net, from, to, output, on: None }
}

pub(super) const fn at_end(
    name: &'static str,
    begins: &'static str,
    ends: &'static str,
    most: u32,
) -> Watch {
    Watch { name, at_end: true, begins, ends, most }
}

impl Said {
    /// The same of the transitions that answer this event.
    pub(super) const fn on(self, event: &'static str) -> Self {
        Self { on: Some(event), ..self }
    }
}

macro_rules! requirements {
    ($(#[doc = $doc:literal])* $list:ident; $($id:ident $label:ident $sentence:literal
        $(, checked $text:expr $(, watched by [$($watch:expr),+])?)?
        $(, said [$($said:expr),+])?
        $(, guarded [$($guarded:expr),+])?
        $(, tested in $file:literal)?;)+) => {
        $(#[doc = $doc])*
        pub static $list: &[Requirement] = &[$(Requirement {
            id: stringify!($id),
            sentence: $sentence,
            label: Label::$label,
            asked: requirements!(asked $($text $(, [$($watch),+])?)?),
            said: &[$($($said),+)?],
            guarded: &[$($($guarded),+)?],
            tests: requirements!(tests $($file)?),
        }),+];
    };
    (asked) => { None };
    (asked $text:expr) => { Some(Asked { watches: &[], text: $text }) };
    (asked $text:expr, [$($watch:expr),+]) => {
        Some(Asked { watches: &[$($watch),+], text: $text })
    };
    (tests) => { None };
    (tests $file:literal) => { Some($file) };
}

pub(super) use requirements;
