//! Events and errors that no formula knows, and the return that a mission asks for.

/// A mission's way through the world: events, and what must never happen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Course {
    /// Events, and errors of formulas.
    pub script: Script,
    /// The return that is kept, where the mission asks for one.
    pub home: Option<Return>,
}

/// Events on the way, and errors of formulas.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Script {
    /// Events, in any order.
    pub events: Vec<Event>,
    /// Errors of the formulas; those that hold at a place add up.
    pub errors: Vec<ModelError>,
}

/// Something that happens at a place of the path, as soon as the robot comes there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// The place, mm.
    pub x_mm: i64,
    /// The kind of the event.
    pub what: What,
}

/// A kind of event.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum What {
    /// Sums grow: a wait costs time and energy. By indicator.
    Costs(Vec<(usize, i64)>),
    /// Units of hardware, by its index, are lost for good.
    Lost(usize, i64),
}

/// An error of a formula: the real value of an indicator against the one that is planned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModelError {
    /// The indicator, by index.
    pub indicator: usize,
    /// The zone in which it holds, by index; everywhere if none.
    pub zone: Option<usize>,
    /// The error in parts of a thousand; below zero the real value is smaller.
    pub permille: i64,
}

/// Faults that a return withstands, all of them together, at any time.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Return {
    /// Units of hardware, by its index, that may be lost.
    pub losses: Vec<(usize, i64)>,
    /// By how much real values may exceed planned ones, by indicator in parts of a thousand.
    pub errors: Vec<(usize, i64)>,
    /// Costs of all events together, by indicator.
    pub costs: Vec<(usize, i64)>,
}
