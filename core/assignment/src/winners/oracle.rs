//! The cheapest coalition of one plan, with a price on each robot.

use super::{BIG, FAR, LIMIT, PlanEntry, at, put};
use crate::RobotSet;

/// The memory of a small assignment of roles to robots, of whole 64 bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Oracle<const N: usize> {
    /// How many robots there are.
    pub(super) robots: usize,
    prices: [i64; N],
    /// The role of each robot, and the robot of each role; `NONE` for none.
    role_of: [u8; N],
    robot_of: [u8; N],
    distances: [i64; N],
    before: [u8; N],
    /// Robots whose shortest path is known, in order.
    done: [u8; N],
    lengths: [i64; N],
    /// How many of these the last path had, and the role that it began at.
    met: usize,
    from: u8,
}

const NONE: u8 = u8::MAX;

impl<const N: usize> Oracle<N> {
    pub(super) const EMPTY: Self = Self {
        robots: N,
        prices: [0; N],
        role_of: [NONE; N],
        robot_of: [NONE; N],
        distances: [0; N],
        before: [NONE; N],
        done: [0; N],
        lengths: [0; N],
        met: 0,
        from: 0,
    };

    /// The robot of a role in the last answer.
    pub(super) fn robot(&self, role: usize) -> Option<usize> {
        self.robot_of.get(role).filter(|it| **it != NONE).map(|it| usize::from(*it))
    }

    /// The least that a plan costs with its robots' prices, and these robots. `keep` is what counts
    /// of an entry: all of it, or only whether it is missing.
    pub(super) fn cheapest(
        &mut self,
        plan: &PlanEntry,
        rows: &[[i64; N]],
        keep: i64,
        prices: &[i64; N],
    ) -> Option<(i64, RobotSet)> {
        let found = if plan.largest {
            self.least_largest(rows, keep, prices)
        } else {
            let entry = |row: &[i64; N], robot: usize| {
                (at(row, robot) & keep).wrapping_add(at(prices, robot))
            };
            self.least(rows, entry)
        };
        let value = found?;
        let robots = self.robot_of.iter().take(rows.len()).filter(|it| **it != NONE);
        let set = robots.fold(0, |set: RobotSet, it| set | 1_u128.wrapping_shl(u32::from(*it)));
        debug_assert_eq!(set.count_ones() as usize, rows.len(), "each role has a robot of its own");
        Some((value.wrapping_add(plan.extra & keep), set))
    }

    /// The least of the largest cost plus the sum of prices.
    ///
    /// Under a limit on the costs, what counts is the least sum of prices: an assignment. Only an
    /// edge above the limit that its prices pay for can make that less, so the limit rises from one
    /// such edge to the next, until the largest cost alone is too much.
    fn least_largest(&mut self, rows: &[[i64; N]], keep: i64, prices: &[i64; N]) -> Option<i64> {
        let robots = self.robots.min(N);
        let open =
            |row: &[i64; N], robot: usize| at(row, robot) < LIMIT && at(prices, robot) < LIMIT;
        let floor =
            self.least(rows, |row, robot| if open(row, robot) { at(prices, robot) } else { FAR })?;
        let cheapest = |row: &[i64; N]| {
            (0..robots).filter(|it| open(row, *it)).map(|it| at(row, it) & keep).fold(FAR, i64::min)
        };
        let mut limit = rows.iter().map(cheapest).fold(0, i64::max);
        let mut best = (FAR, [NONE; N]);
        while limit < LIMIT && limit.wrapping_add(floor) < best.0 {
            let within = |row: &[i64; N], robot: usize| {
                if open(row, robot) && at(row, robot) & keep <= limit {
                    at(prices, robot)
                } else {
                    FAR
                }
            };
            let sum = self.least(rows, within);
            let mut next = FAR;
            if let Some(sum) = sum {
                let mut largest = 0;
                for (row, robot) in rows.iter().zip(self.robot_of) {
                    largest = largest.max(at(row, usize::from(robot)) & keep);
                }
                if sum.wrapping_add(largest) < best.0 {
                    best = (sum.wrapping_add(largest), self.robot_of);
                }
                for (row, own) in rows.iter().zip(self.robot_of) {
                    let own = usize::from(own);
                    let role = at(prices, own).wrapping_sub(at(&self.prices, own));
                    for robot in 0..robots {
                        let entry = at(row, robot) & keep;
                        let pays = at(prices, robot).wrapping_sub(at(&self.prices, robot)) < role;
                        if entry > limit && entry < next && pays && open(row, robot) {
                            next = entry;
                        }
                    }
                }
            } else {
                // The roles in conflict need another robot.
                let done = self.done;
                let roles =
                    done.iter().take(self.met).map(|it| at(&self.role_of, usize::from(*it)));
                for role in roles.chain([self.from]) {
                    let Some(row) = rows.get(usize::from(role)) else { continue };
                    for robot in 0..robots {
                        let entry = at(row, robot) & keep;
                        if entry > limit && entry < next && open(row, robot) {
                            next = entry;
                        }
                    }
                }
            }
            limit = next;
        }
        self.robot_of = best.1;
        (best.0 < LIMIT).then_some(best.0)
    }

    /// The least sum of entries, each row with a column of its own.
    fn least(&mut self, rows: &[[i64; N]], entry: impl Fn(&[i64; N], usize) -> i64) -> Option<i64> {
        let robots = self.robots.min(N);
        debug_assert!(rows.len() <= robots, "a plan of more roles than robots is left out");
        self.prices = [0; N];
        self.role_of = [NONE; N];
        self.robot_of = [NONE; N];
        for (role, row) in (0..rows.len() as u8).zip(rows) {
            let (mut first, mut second, mut nearest) = (FAR, FAR, N);
            for robot in 0..robots {
                let value = entry(row, robot).wrapping_sub(at(&self.prices, robot));
                if value < first {
                    (first, second, nearest) = (value, first, robot);
                } else if value < second {
                    second = value;
                }
            }
            (self.from, self.met) = (role, 0);
            if first >= LIMIT {
                return None;
            }
            if at(&self.role_of, nearest) == NONE {
                let gain = if second < LIMIT { second.wrapping_sub(first) } else { 0 };
                let price = at(&self.prices, nearest).wrapping_sub(gain);
                put(&mut self.prices, nearest, price);
                put(&mut self.role_of, nearest, role);
                put(&mut self.robot_of, usize::from(role), nearest as u8);
            } else {
                self.grow(rows, &entry)?;
            }
        }
        let value = |(row, robot): (&[i64; N], u8)| match usize::from(robot) {
            robot if robot < N => entry(row, robot),
            _ => 0,
        };
        Some(rows.iter().zip(self.robot_of).map(value).fold(0, i64::wrapping_add))
    }

    /// A shortest path of exchanges from role `from` to a robot without a role.
    fn grow(&mut self, rows: &[[i64; N]], entry: impl Fn(&[i64; N], usize) -> i64) -> Option<()> {
        let robots = self.robots.min(N);
        self.distances = [FAR; N];
        let (mut role, mut base) = (self.from, 0_i64);
        let (end, length) = loop {
            let row = rows.get(usize::from(role))?;
            let (mut least, mut nearest) = (FAR, N);
            for robot in 0..robots {
                if at(&self.distances, robot) == -FAR {
                    continue;
                }
                let value =
                    entry(row, robot).wrapping_sub(at(&self.prices, robot)).wrapping_add(base);
                if value < at(&self.distances, robot) {
                    put(&mut self.distances, robot, value);
                    put(&mut self.before, robot, role);
                }
                if at(&self.distances, robot) < least {
                    (least, nearest) = (at(&self.distances, robot), robot);
                }
            }
            if least >= LIMIT {
                return None;
            }
            let next = at(&self.role_of, nearest);
            if next == NONE {
                break (nearest, least);
            }
            put(&mut self.done, self.met, nearest as u8);
            put(&mut self.lengths, self.met, least);
            put(&mut self.distances, nearest, -FAR);
            self.met = self.met.wrapping_add(1);
            let own = rows.get(usize::from(next)).filter(|_| nearest < N)?;
            base = least.wrapping_sub(entry(own, nearest).wrapping_sub(at(&self.prices, nearest)));
            role = next;
        };
        for (robot, at_length) in self.done.iter().zip(self.lengths).take(self.met) {
            if let Some(it) = self.prices.get_mut(usize::from(*robot)) {
                *it = it.wrapping_add(at_length.wrapping_sub(length));
            }
        }
        let mut robot = end;
        for _ in 0..=self.met {
            let role = at(&self.before, robot);
            let next = at(&self.robot_of, usize::from(role));
            debug_assert!(usize::from(role) <= usize::from(self.from), "a role that was looked at");
            put(&mut self.role_of, robot, role);
            put(&mut self.robot_of, usize::from(role), robot as u8);
            if role == self.from {
                break;
            }
            robot = usize::from(next);
        }
        Some(())
    }
}

/// Prices under which some robots cannot be taken, and others are taken wherever they can be.
pub(super) fn restricted<const N: usize>(
    prices: &[i64; N],
    banned: RobotSet,
    forced: RobotSet,
) -> [i64; N] {
    let mut own = *prices;
    for (robot, price) in (0..N as u32).zip(&mut own) {
        let bit = 1_u128.wrapping_shl(robot);
        if banned & bit != 0 {
            *price = FAR;
        } else if forced & bit != 0 {
            *price = price.wrapping_sub(BIG);
        }
    }
    own
}
