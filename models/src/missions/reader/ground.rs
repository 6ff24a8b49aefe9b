//! Reading the places of a mission that a floor knows.

use super::entry::Entry;
use super::fields::Fields;
use crate::missions::definition::Zone;
use crate::missions::diagnostic::{Diagnostic, Spanned};
use crate::missions::known::CLEARANCE_MM;
use crate::missions::way::{Leg, NoLeg, Refusal, Way};
use cotama_core::units::Millimetres;

/// Keys whose lengths a floor says.
const LENGTHS: [&str; 3] = ["path_length_mm", "x_start_mm", "x_end_mm"];

/// A door whose name is not known.
const UNREAD: &[String] = &[String::new()];

/// The floor of a mission, and how far its objectives were read.
pub(super) struct Ground<'w> {
    /// The way; `None` where there is none, which is reported.
    way: Option<&'w Way>,
    /// The next leg, and its start.
    next: usize,
    at: Option<Millimetres>,
}

impl<'w> Ground<'w> {
    /// Reads what a mission says of its floor; `None` where it names none.
    pub(super) fn of(root: &mut Fields<'_>, way: Option<&'w Way>) -> Option<Self> {
        let Ok(Some(floor)) = root.optional_text("floor") else {
            without_floor(root, &["from", "open", "close", "clearance_mm"]);
            return None;
        };
        let from = root.text("from");
        let _ = (root.optional_texts("open"), root.optional_texts("close"));
        let _ = root.optional_integer::<u64>("clearance_mm", CLEARANCE_MM);
        refuse_lengths(root);
        let Some(way) = way else {
            let message = format!("there is no floor `{}`, and no file of this name", floor.value);
            let it = Diagnostic::new(floor.span, message, "not known");
            root.report(it.help("`office` comes with the program; `cotama new floor` begins one"));
            return Some(Self { way: None, next: 0, at: None });
        };
        if let (Err(why), Some(from)) = (&way.start, from) {
            reported(root, from.span, why);
        }
        for key in ["open", "close"] {
            if let (Err(why), true) = (&way.doors, root.has(key)) {
                reported(root, root.span_of(key), why);
                break;
            }
        }
        Some(Self { way: Some(way), next: 0, at: Some(Millimetres(0)) })
    }

    /// The doors of the floor, by name; none of a map. A floor that is refused has one without a
    /// name.
    pub(super) fn doors(&self) -> &'w [String] {
        self.way.map_or(UNREAD, |it| it.doors.as_deref().unwrap_or(UNREAD))
    }

    /// The ways of a person, by the number in the file.
    pub(super) fn walks(&self, number: usize) -> Option<&'w [Result<Leg, NoLeg>]> {
        self.way?.people.get(number).map(Vec::as_slice)
    }

    /// The length of the path, when all objectives were read.
    pub(super) const fn length(&self) -> Option<Millimetres> {
        self.at
    }

    /// Reads where an objective goes: from the place at which the one before ends to `to`, or
    /// nowhere.
    pub(super) fn leg(&mut self, fields: &mut Fields<'_>) -> Option<(Millimetres, Millimetres)> {
        refuse_lengths(fields);
        let Ok(to) = fields.optional_text("to") else {
            self.at = None;
            return None;
        };
        let Some(to) = to else { return Some((self.at?, self.at?)) };
        let leg = self.way.and_then(|it| it.legs.get(self.next));
        self.next += 1;
        let from = self.at;
        self.at = match leg {
            Some(Ok(leg)) => from.map(|it| Millimetres(it.0 + leg.length.0)),
            Some(Err(why)) => {
                if let Some(why) = why.refusal("open") {
                    reported(fields, to.span, &why);
                }
                None
            }
            None => None,
        };
        Some((from?, self.at?))
    }

    /// The parts of the path inside a zone of the floor; an empty one where it does not lead
    /// through.
    pub(super) fn spans(&self, fields: &Fields<'_>, zone: &Spanned<String>) -> Vec<Span> {
        let asked = self.way.and_then(|way| {
            let at = way.asked.zones.iter().position(|it| *it == zone.value)?;
            way.zones.get(at)
        });
        match asked {
            Some(Ok(spans)) if spans.is_empty() => vec![[Millimetres(0); 2]],
            Some(Ok(spans)) => {
                spans.iter().map(|it| [Millimetres(it.start), Millimetres(it.end)]).collect()
            }
            Some(Err(why)) => {
                reported(fields, zone.span.clone(), why);
                Vec::new()
            }
            None => Vec::new(),
        }
    }
}

/// The start and the end of a part of the path.
pub(super) type Span = [Millimetres; 2];

/// A zone of which the path crosses several parts is as many zones: `store`, `store (2)`.
pub(super) fn parts(zone: &Zone, spans: Vec<Span>) -> Vec<Entry<Zone>> {
    let part = |(number, [x_start, x_end]): (usize, Span)| {
        let first = zone.id.clone();
        let id = if number == 0 { first } else { format!("{first} ({})", number + 1) };
        let item = Some(Zone { id: id.clone(), x_start, x_end, ..zone.clone() });
        Entry { id, item }
    };
    spans.into_iter().enumerate().map(part).collect()
}

/// Refuses names that only a floor knows.
pub(super) fn without_floor(fields: &mut Fields<'_>, keys: &[&'static str]) {
    for key in keys {
        if fields.has(key) {
            let message = format!("`{key}` speaks of a floor, and the mission names none");
            let it = Diagnostic::new(fields.span_of(key), message, "without a floor");
            fields.report(it.help("add `floor`, or leave it out and give lengths in mm"));
        }
        fields.knows(key);
    }
}

/// Refuses lengths beside a floor.
fn refuse_lengths(fields: &mut Fields<'_>) {
    for key in LENGTHS.into_iter().filter(|it| fields.has(it)).collect::<Vec<_>>() {
        let message = format!("`{key}` is a length of the path, which the floor says");
        let it = Diagnostic::new(fields.span_of(key), message, "beside a floor");
        fields
            .report(it.help("leave it out; objectives that drive say `to`, a place of the floor"));
        fields.knows(key);
    }
}

pub(super) fn reported(fields: &Fields<'_>, span: std::ops::Range<usize>, why: &Refusal) {
    let it = Diagnostic::new(span, why.message.as_str(), "on this floor");
    fields.report(Diagnostic { help: why.help.clone(), ..it });
}
