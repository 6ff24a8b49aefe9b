//! Courses as numbers of 32 bits, as a page reads them.

use super::{Course, Input, Mark};
use crate::answer::list;
use alloc::vec::Vec;
use cotama_core::units::Millis;
use cotama_models::level::Where;

impl Course {
    /// As numbers: how it ended and when; of each fault began, found and over, each after 1, 0 for
    /// never; lists of marks (time, kind, number) and of samples (time, place, speed). A place is
    /// 0 for rest, 1 for waiting, else its configuration after 2.
    pub fn to_numbers(&self) -> Vec<u32> {
        let when = |it: Option<Millis>| it.map_or(0, |it| it.0 as u32 + 1);
        let mut out = Vec::from([self.ended as u32, self.end.0 as u32]);
        let fates = self.fates.iter().map(|it| [it.began, it.found, it.over].map(when));
        list(&mut out, fates);
        list(
            &mut out,
            self.marks.iter().map(|(at, it)| {
                let (kind, number) = it.to_numbers();
                [at.0 as u32, kind, number]
            }),
        );
        list(&mut out, self.samples.iter().map(|it| [it.0.0 as u32, it.1 as u32, it.2 as u32]));
        out
    }

    /// The periods as numbers: a list of time, flags that are up, modules that work, what is said
    /// (kind times 256, and number, and 1; 0 for nothing), what the planner tells (after 1, or 0),
    /// and whether the robot coasts.
    pub fn inputs_to_numbers(&self) -> Vec<u32> {
        let mut out = Vec::new();
        list(
            &mut out,
            self.inputs.iter().map(|Input { at, seen, coasts }| {
                let said = seen.said.map_or(0, |it| {
                    let (kind, number) = it.to_numbers();
                    u32::from(kind) * 256 + number as u32 + 1
                });
                let (up, works) = (seen.up, seen.works);
                let halves = [up as u32, (up >> 32) as u32, works as u32, (works >> 32) as u32];
                let [a, b, c, d] = halves;
                let planned = seen.planned.map_or(0, |it| it as u32 + 1);
                [at.0 as u32, a, b, c, d, said, planned, u32::from(*coasts)]
            }),
        );
        out
    }
}

impl Mark {
    fn to_numbers(self) -> (u32, u32) {
        match self {
            Self::Place(Where::Rests) => (0, 0),
            Self::Place(Where::Waits) => (0, 1),
            Self::Place(Where::Runs { configuration, .. }) => (0, 2 + configuration as u32),
            Self::Taken(row) => (1, row as u32),
            Self::Told(told) => {
                let (kind, number) = told.to_numbers();
                (2, u32::from(kind) * 256 + number as u32)
            }
            Self::Fired(it) => (3, it),
        }
    }
}
