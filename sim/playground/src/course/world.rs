//! A robot and its mission as a course needs them, beside the tables of its decider.

use crate::coded::{Coded, Damaged, closed, fields, opened};
use alloc::vec::Vec;
use cotama_core::units::Millis;

/// A robot and its mission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct World {
    /// Acceleration and deceleration, in mm/s².
    pub acceleration: u64,
    /// The fastest that it can go, in mm/s.
    pub fastest: u64,
    /// The modules by which the operator is reached, a bit each.
    pub operator: Option<u64>,
    /// The modules.
    pub modules: Vec<Module>,
    /// The observers.
    pub observers: Vec<Observer>,
    /// The configurations.
    pub configurations: Vec<Runs>,
    /// The rows of the FMECA.
    pub rows: Vec<Row>,
    /// The objectives of the mission.
    pub objectives: Vec<Objective>,
    /// The planned speeds along the path.
    pub legs: Vec<Leg>,
}

/// A module, by what it needs.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Module {
    /// The hardware, a bit each.
    pub hardware: u64,
    /// The modules, a bit each.
    pub modules: u64,
    /// Modules of which one is enough; 0 for none.
    pub one_of: u64,
}

/// An observer, by what it needs and the flags that it raises.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Observer {
    /// The hardware, a bit each.
    pub hardware: u64,
    /// The modules, a bit each.
    pub modules: u64,
    /// The flags that it raises, a bit each.
    pub flags: u64,
}

/// A configuration.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Runs {
    /// The time that it takes where the robot stands in it.
    pub takes: Millis,
    /// The modules that it requires, a bit each.
    pub required: u64,
}

/// A row of the FMECA.
#[allow(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Row {
    /// The time after which its flags are up.
    pub latency: Millis,
    /// True if flags show it at all.
    pub is_seen: bool,
    /// Effect on motion: 0 none, 1 blocked, 2 slowed, 3 runaway, 4 dead, 5 silent, 6 mindless.
    pub motion: u8,
    /// The speed that a slowed robot has, in thousandths.
    pub share: u16,
    /// When it is over by itself.
    pub ends: Option<Millis>,
    /// True if it is over when the operator has helped.
    pub helped: bool,
    /// True if the operator answers nothing while it lasts.
    pub unanswered: bool,
    /// A module that is started anew, and whether it is over by that.
    pub restarts: Option<(u8, bool)>,
    /// True if its setting is only tried, so that it shows itself again.
    pub is_tried: bool,
    /// The hardware that it takes, a bit each.
    pub hardware: u64,
    /// The modules that it takes, a bit each.
    pub modules: u64,
}

/// An objective of the mission.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Objective {
    /// True if the robot drives for it.
    pub travels: bool,
    /// The end, in mm.
    pub end_mm: u64,
    /// The time for which the robot stands.
    pub stands: Millis,
}

/// A part of the path with a planned speed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Leg {
    /// The end, in mm.
    pub end_mm: u64,
    /// The speed, in mm/s.
    pub speed: u64,
}

fields!(World {
    acceleration,
    fastest,
    operator,
    modules,
    observers,
    configurations,
    rows,
    objectives,
    legs
});
fields!(Module { hardware, modules, one_of });
fields!(Observer { hardware, modules, flags });
fields!(Runs { takes, required });
fields!(Row {
    latency,
    is_seen,
    motion,
    share,
    ends,
    helped,
    unanswered,
    restarts,
    is_tried,
    hardware,
    modules
});
fields!(Objective { travels, end_mm, stands });
fields!(Leg { end_mm, speed });

impl World {
    /// Reads a world.
    ///
    /// # Errors
    /// [`Damaged`] when these bytes are not what [`encode`](Self::encode) wrote.
    pub fn decode(bytes: &[u8]) -> Result<Self, Damaged> {
        let from = &mut opened(bytes)?;
        let world = Self::read(from)?;
        if from.is_empty() { Ok(world) } else { Err(Damaged) }
    }

    /// Writes it as bytes.
    pub fn encode(&self) -> Vec<u8> {
        let mut to = Vec::new();
        self.write(&mut to);
        closed(to)
    }

    /// Returns the planned speed at a place, in mm/s.
    pub(super) fn pace(&self, x_mm: u64) -> u64 {
        let leg = self.legs.iter().find(|it| x_mm < it.end_mm).or(self.legs.last());
        leg.map_or(u64::MAX, |it| it.speed)
    }

    /// Returns the modules that can be used when this hardware and these modules are lost.
    pub(super) fn available(&self, hardware: u64, modules: u64) -> u64 {
        let all = self.modules.iter().enumerate();
        let mut available = all.clone().fold(0, |set, it| set | 1_u64 << it.0) & !modules;
        loop {
            let works = all.clone().filter(|(at, it)| {
                available >> at & 1 == 1
                    && it.hardware & hardware == 0
                    && it.modules & !available == 0
                    && (it.one_of == 0 || it.one_of & available != 0)
            });
            let left = works.fold(0, |set, it| set | 1_u64 << it.0);
            if left == available {
                return available;
            }
            available = left;
        }
    }
}
