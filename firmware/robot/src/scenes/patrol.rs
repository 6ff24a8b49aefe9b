//! The patrol: planned and planned again.

use super::Memory;
use crate::dice::Dice;
use crate::patrol::{COURSE, Patrol, Planner};
use crate::trace::{Sink, Trace};
use cotama_core::units::{Millimetres, Millis};
use cotama_models::missions::tables::Rest;
use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE};

/// So many random situations.
const SITUATIONS: u32 = 200;

pub(super) fn by_rule(memory: &mut Memory, trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    drive(&mut Planner::Rule, &mut memory.tables, trace)
}

pub(super) fn exactly(memory: &mut Memory, trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    drive(&mut Planner::Exact(&mut memory.workspace), &mut memory.tables, trace)
}

fn drive(
    planner: &mut Planner<'_>,
    tables: &mut crate::patrol::Tables,
    trace: &mut Trace<'_, impl Sink>,
) -> [u32; 2] {
    match Patrol::default().drive(&COURSE, planner, tables, trace) {
        Some(replans) => [replans as u32, 0],
        None => [0, 1],
    }
}

pub(super) fn random(memory: &mut Memory, trace: &mut Trace<'_, impl Sink>) -> [u32; 2] {
    let mut dice = Dice::new(187);
    let mut counts = [0; 2];
    for _ in 0..SITUATIONS {
        let patrol = situation(&mut dice);
        let planners = [Planner::Rule, Planner::Exact(&mut memory.workspace)];
        for mut planner in planners {
            let planned = { patrol }.plan(&mut planner, &mut memory.tables, trace);
            counts[usize::from(!planned)] += 1;
        }
    }
    counts
}

/// Anywhere on the way, with any hardware left, and more or less used.
fn situation(dice: &mut Dice) -> Patrol {
    let first = dice.roll(ACTIVITIES.len() as u32) as usize;
    let activity = &ACTIVITIES[first];
    let rest = match activity.length().0 {
        0 => Rest::Time(Millis(u64::from(dice.roll(8_000)))),
        length => Rest::Travel(Millimetres(1 + u64::from(dice.roll(length as u32)))),
    };
    let mut available = AVAILABLE;
    for kind in 0..4 {
        if dice.once_in(4) {
            available = available.without(kind, 1);
        }
    }
    // Limits of 600 s and 8,640 kJ, less where less of the path is behind.
    let done = activity.x_start.0;
    let time = done * 600_000 / 187_000 * u64::from(800 + dice.roll(500)) / 1_000;
    let energy = done * 8_640_000 / 187_000 * u64::from(800 + dice.roll(500)) / 1_000;
    Patrol::at(first, rest, available, [time, energy])
}
