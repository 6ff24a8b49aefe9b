//! Where a run tells what happens.

use crate::trace::Record;

/// Takes the records of a run, in the order of time.
pub trait Recorder {
    /// Whether records are wanted at all; if not, none is made.
    const WANTED: bool;

    /// Takes a record.
    fn record(&mut self, record: Record);
}

/// Takes nothing, and costs nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Recorder for Silent {
    const WANTED: bool = false;

    fn record(&mut self, _: Record) {}
}

/// Keeps all records.
impl Recorder for Vec<Record> {
    const WANTED: bool = true;

    fn record(&mut self, record: Record) {
        self.push(record);
    }
}
