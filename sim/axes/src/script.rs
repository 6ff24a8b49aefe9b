//! What happens on the way that no model knows.

use crate::safe::Return;

/// A mission's way through the world: what happens, and what must never happen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Course {
    /// What happens.
    pub script: Script,
    /// The return that is kept, where one is.
    pub home: Option<Return>,
}

/// What happens on the way.
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
    /// What happens.
    pub what: What,
}

/// What happens at a place.
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

impl Script {
    /// Returns the factor of an indicator in some zones, in parts of a thousand.
    pub(crate) fn factor(&self, indicator: usize, zones: &[usize]) -> i64 {
        let holds = |it: &&ModelError| {
            it.indicator == indicator && it.zone.is_none_or(|it| zones.contains(&it))
        };
        let error: i64 = self.errors.iter().filter(holds).map(|it| it.permille).sum();
        (1_000 + error).max(0)
    }
}
