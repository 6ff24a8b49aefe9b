//! A robot that meets doors which stand otherwise than it knows.

use super::{Aside, Rover, milli};
use crate::detours::Detours;
use crate::doors::{self, Doors};
use crate::drivetrain::SPARE;
use crate::follower::Follower;
use cotama_core::units::Millimetres;
use cotama_devices::Disc;

/// The outcome of a door in the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Met {
    /// The robot goes another way, which is so much longer.
    Detour {
        /// Number of the door.
        door: usize,
        /// The way beyond that of the path.
        extra: Millimetres,
    },
    /// Nothing leads to its goal any more: it stands.
    Blocked {
        /// Number of the door.
        door: usize,
    },
}

/// Whether a robot stops before a door.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Halts {
    No,
    /// Stops to look for another path.
    Before(usize),
    /// There is none.
    ForGood,
}

/// The room beyond which a leaf beside the path is none in it, in metres.
const BESIDE: f64 = 0.01;

impl Rover<'_> {
    /// Opens or closes a door of the floor, by its number, as soon as that leaves room to the robot
    /// to stand before the leaf. A map has no doors.
    pub fn set_door(&mut self, door: usize, is_open: bool) {
        if self.doors.is_none() {
            self.doors = Doors::of(self.course()).map(Box::new);
        }
        if let Some(doors) = &mut self.doors {
            doors.ask(door, is_open);
        }
    }

    /// Returns what became of a door in its way since this was asked last.
    pub fn take_met(&mut self) -> Option<Met> {
        self.met.take()
    }

    /// Sees a door in its way, within sight, that stands otherwise than it knows; stands, and plans
    /// another path.
    pub(super) fn see_doors(&mut self) {
        let Some(mut doors) = self.doors.take() else { return };
        self.see(&mut doors);
        self.doors = Some(doors);
    }

    fn see(&mut self, doors: &mut Doors) {
        let radius = self.course().drivetrain().footprint.radius();
        let brakes = self.braking_distance().0 as f64 / 1_000.0;
        let centre = self.pose().translation.vector.into();
        let robot = Disc { centre, radius: radius + brakes };
        if let Some(real) = doors.change(&robot, self.people()) {
            if let Some(people) = &mut self.people {
                people.set_leaves(doors.moved());
            }
            let mut own = self.course().clone();
            own.stand_on(real);
            self.own = Some(Box::new(own));
        }
        let near = self.follower.near();
        if self.halts == Halts::No {
            let met = doors.met(self.course().track(), near, radius + SPARE - BESIDE);
            self.halts = met.map_or(Halts::No, Halts::Before);
        }
        let is_on_path = self.aside == Aside::No && self.owed.0 == 0;
        let Halts::Before(door) = self.halts else { return };
        if !self.stands() || !is_on_path {
            return;
        }
        doors.learn(door);
        let x = self.x.0 as f64 / 1_000.0;
        let legs: Vec<_> = self.course().way().legs.iter().flatten().cloned().collect();
        let ends = doors::ends(&legs, x);
        let goals: Vec<_> = ends.iter().map(|it| self.detours.goal(*it)).collect();
        let before = self.detours.owed(x, near.along);
        let Some(rests) = doors.around(door, self.course(), near, &goals) else {
            (self.met, self.halts) = (Some(Met::Blocked { door }), Halts::ForGood);
            return;
        };
        let mut start = x;
        let rests: Vec<_> = rests
            .into_iter()
            .zip(&ends)
            .map(|(rest, end)| {
                let length = end - core::mem::replace(&mut start, *end);
                rest.no_shorter_than(length)
            })
            .collect();
        let lengths = ends.iter().copied().zip(rests.iter().map(crate::track::Rest::length));
        self.detours = Detours::from(x, near.along, lengths);
        let mut own = self.course().clone();
        let near = own.lead(near, &rests);
        self.own = Some(Box::new(own));
        self.follower = Follower::new(near);
        self.halts = Halts::No;
        let extra = (self.detours.owed(x, near.along) - before).max(0.0);
        self.met = Some(Met::Detour { door, extra: Millimetres(milli(extra)) });
    }
}
