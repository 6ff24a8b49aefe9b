//! The executive against the literature, a plain simulation, and its own promises.

mod oracle;
mod textbook;
mod watchdogs;

use super::{Executive, Happening, Task};
use cotama_units::units::Micros;
use proptest::prelude::*;
use std::vec::Vec;

/// A task of whole ticks.
fn task(period: u64, deadline: u64, cost: u64, extra: u64) -> Task {
    Task {
        deadline: Micros(deadline),
        extra: Micros(extra),
        ..Task::new(Micros(period), Micros(cost))
    }
}

/// Tasks with small periods, any of which may be late.
fn small<const N: usize>() -> impl Strategy<Value = [Task; N]> {
    let one = (2..=12_u64).prop_flat_map(|period| {
        (Just(period), 1..=period).prop_flat_map(|(period, deadline)| {
            (Just(period), Just(deadline), 1..=deadline.div_ceil(2), 0..=4_u64)
        })
    });
    proptest::array::uniform::<_, N>(
        one.prop_map(|(period, deadline, cost, extra)| task(period, deadline, cost, extra)),
    )
}

/// The least common multiple of the periods.
fn hyperperiod(tasks: &[Task]) -> u64 {
    let gcd = |mut a: u64, mut b: u64| {
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    tasks.iter().fold(1, |all, task| all / gcd(all, task.period.0) * task.period.0)
}

/// Returns the events up to an instant when each job of a task needs the same time.
fn run<const N: usize>(tasks: [Task; N], needs: [u64; N], until: u64) -> Vec<Happening> {
    let mut executive = Executive::new(tasks).unwrap();
    let needs = needs.map(Micros);
    core::iter::from_fn(|| executive.simulate(Micros(until), &needs)).collect()
}
