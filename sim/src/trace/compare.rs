//! Comparing a trace with that of the same run made again.

use super::{Head, Line, TraceOf};
use crate::canonical::{Differing, difference, value};

/// A record that differs from the one that was stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Number of the record, which is that of its line: from 1, the header.
    pub line: usize,
    /// Kind of the record: `header`, `sample` and so on; the stored one's, if there is one.
    pub record: String,
    /// The field with what was stored and what there is now, as JSON; none where there is no record
    /// on one side.
    pub field: Option<Differing>,
    /// Whether there is such a record in what was stored, and now.
    pub there: [bool; 2],
}

impl<H: Head + Clone, R: Line> TraceOf<H, R> {
    /// The first record in which a stored trace differs from one made now, but for the version of
    /// the program; none where they are the same.
    pub fn difference(&self, now: &Self) -> Option<Difference> {
        let expected = now.header.clone().by_version_of(&self.header);
        self.foreign()
            .filter(|it| it.line == 1)
            .or_else(|| differs(0, "header".into(), difference(&self.header, &expected)))
            .or_else(|| self.differing(now))
    }

    /// Returns the field of the file that no record of ours has.
    fn foreign(&self) -> Option<Difference> {
        let (number, field) = self.foreign.clone()?;
        let record = number.checked_sub(1).and_then(|it| self.records.get(it));
        differs(number, record.map_or_else(|| "header".into(), kind), Some(field))
    }

    /// The first record that differs, of traces with equal headers.
    fn differing(&self, now: &Self) -> Option<Difference> {
        let foreign = self.foreign();
        let before = foreign.as_ref().map_or(usize::MAX, |it| it.line);
        for at in 0..self.records.len().max(now.records.len()) {
            match (self.records.get(at), now.records.get(at)) {
                (Some(then), Some(now)) if then != now => {
                    return differs(at + 1, kind(then), difference(then, now));
                }
                (Some(_), Some(_)) if at + 2 == before => return foreign,
                (Some(_), Some(_)) | (None, None) => {}
                (then, now) => {
                    let record = then.or(now).map_or_else(String::new, kind);
                    let there = [then.is_some(), now.is_some()];
                    return Some(Difference { line: at + 2, record, field: None, there });
                }
            }
        }
        None
    }
}

fn differs(number: usize, record: String, field: Option<Differing>) -> Option<Difference> {
    Some(Difference { line: number + 1, record, field: Some(field?), there: [true, true] })
}

/// The kind of a record, as its line names it.
fn kind(record: &impl Line) -> String {
    let value = value(record);
    value["record"].as_str().unwrap_or_default().to_owned()
}
