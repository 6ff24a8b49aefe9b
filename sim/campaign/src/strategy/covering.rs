//! Covering arrays: any two, or any three, values of what a plan is made of come together in some
//! plan.

use super::exhaustive::{Factors, plan};
use super::{Draws, Strategy};
use crate::plan::Plan;
use crate::space::Space;
use cotama_sim::streams::Streams;

/// A covering array of strength `t` over the factors of a plan: the kind of each of its faults and
/// its moment on the [timeline](Space::timeline).
///
/// Rows are polynomials of degree below `t` over a prime field, at one point for each factor (the
/// orthogonal array of Bush, Ann. Math. Stat. 23(3), 1952). A factor with fewer values than the
/// prime repeats some, so all combinations of `t` values are still there. After the last row the
/// array begins anew with other parameters of the faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Covering {
    prime: u64,
    strength: u32,
}

impl Covering {
    /// An array of strength 2 or 3 for plans of this space.
    pub fn new(space: &Space, strength: u32) -> Self {
        let factors = Factors::of(space);
        let values = factors.widths().max().unwrap_or(1).max(factors.count() as u64);
        let is_prime = |it: &u64| (2..=it.isqrt()).all(|d| !it.is_multiple_of(d));
        // Between a number and its double lies a prime (Bertrand, Chebyshev).
        let least = values.max(2);
        let prime = (least..=2 * least).find(is_prime).unwrap_or(least);
        Self { prime, strength: strength.clamp(2, 3) }
    }

    /// How many rows the array has.
    pub fn rows(&self) -> u64 {
        self.prime.saturating_pow(self.strength)
    }

    /// The value of a factor, the number of its column, in a row.
    ///
    /// ```
    /// use cotama_models::missions::{Mission, embedded};
    /// use cotama_campaign::space::{Rates, Space};
    /// use cotama_campaign::strategy::Covering;
    /// use std::collections::BTreeSet;
    /// let delivery = embedded::mission("delivery").unwrap();
    /// let mission = Mission::parse(delivery.name, delivery.text).unwrap();
    /// let array = Covering::new(&Space::of(&mission, Rates::Even, 2..=2), 2);
    /// let p = array.rows().isqrt();
    /// let pairs = (0..array.rows()).map(|row| (array.value(row, 0), array.value(row, 3)));
    /// assert_eq!(pairs.collect::<BTreeSet<_>>().len() as u64, p * p);
    /// ```
    pub fn value(&self, row: u64, column: u64) -> u64 {
        let (mut coefficients, mut sum, mut power) = (row % self.rows(), 0, 1);
        for _ in 0..self.strength {
            sum = (sum + coefficients % self.prime * power) % self.prime;
            power = power * (column % self.prime) % self.prime;
            coefficients /= self.prime;
        }
        sum
    }
}

impl Strategy for Covering {
    fn block<'s>(&'s self, space: &'s Space, seed: u64, first: u64) -> Box<dyn Draws + 's> {
        let factors = Factors::of(space);
        Box::new(Rows { array: *self, space, factors, streams: Streams::new(seed), run: first })
    }
}

struct Rows<'s> {
    array: Covering,
    space: &'s Space,
    factors: Factors,
    streams: Streams,
    run: u64,
}

impl Draws for Rows<'_> {
    fn next(&mut self) -> Plan {
        let run = self.run;
        self.run += 1;
        let values =
            self.factors.widths().zip(0..).map(|(width, at)| self.array.value(run, at) % width);
        plan(self.space, &self.factors, &values.collect::<Vec<_>>(), self.streams, run)
    }
}
