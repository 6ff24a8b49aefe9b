//! Watches consumption against the plan and asks for a new one.
//!
//! Lambert et al., J. Intell. Robot. Syst. 110, 2024, eqs. 7 and 8: on every axis *margin = limit -
//! used - planned rest*. A new plan is asked for **downwards** when a margin is below zero or the
//! plan needs lost hardware (rule 5 of the algorithm), and, going beyond the paper and off by
//! default, **upwards** when margins leave room for a better plan.
//!
//! *No flapping.* After every plan the margins become the baseline. An upward request needs some
//! margin to have grown by [`Upward::growth`] since then, and an upward plan keeps
//! [`Upward::reserve`]; so between two upward requests the robot has really saved that much, or
//! hardware has come back.
//!
//! ```
//! use cotama_core::hardware::Equipment;
//! use cotama_core::monitor::{Trigger, Monitor, Request};
//!
//! let mut monitor = Monitor::new([600_000, 8_640_000], [0, 1]).unwrap();
//! monitor.planned(&[527_924, 8_563_613]).unwrap();
//! monitor.spend(&[75_610, 1_377_917]).unwrap();
//! assert_eq!(monitor.margins(&[452_314, 7_185_696]), Ok([72_076, 76_387]));
//! let request = monitor.assess(&[452_314, 7_285_696], Equipment::NONE, Equipment::NONE);
//! assert_eq!(request, Ok(Request::Down(Trigger::Margin { axis: 1 })));
//! ```

#[cfg(kani)]
pub mod proofs;

use crate::hardware::Equipment;
use crate::problem::{Candidate, ProblemError, names_every_axis_once};

/// The largest amount on an axis: sums of four still fit 64 signed bits.
pub const MAX_AMOUNT: u64 = 1 << 61;

/// An amount beyond [`MAX_AMOUNT`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AmountError {
    /// The axis of the amount.
    pub axis: usize,
}

impl core::fmt::Display for AmountError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "an amount on axis {} is beyond {MAX_AMOUNT}", self.axis)
    }
}

impl core::error::Error for AmountError {}

/// Why limits and an order do not make a monitor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MonitorError {
    /// A limit is beyond [`MAX_AMOUNT`].
    Limit(AmountError),
    /// The order of treatment does not name every axis once.
    BadOrder,
}

impl core::fmt::Display for MonitorError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Limit(overflow) => overflow.fmt(f),
            Self::BadOrder => ProblemError::BadOrder.fmt(f),
        }
    }
}

impl core::error::Error for MonitorError {}

/// When to ask for a better plan.
///
/// ```
/// use cotama_core::hardware::Equipment;
/// use cotama_core::monitor::{Monitor, Request, Upward};
///
/// let upward = Upward { growth: [0, 50], reserve: [0, 10] };
/// let mut monitor = Monitor::new([600, 900], [0, 1]).unwrap().with_upward(upward);
/// monitor.planned(&[500, 800]).unwrap();
/// // Half of it was done with 60 less energy than planned.
/// monitor.spend(&[250, 340]).unwrap();
/// let asks = monitor.assess(&[250, 400], Equipment::NONE, Equipment::NONE);
/// assert_eq!((asks, monitor.room()), (Ok(Request::Up), [350, 550]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Upward<const A: usize> {
    /// How much some margin must have grown since the last plan; zero on an axis means: not on this
    /// axis.
    pub growth: [u64; A],
    /// Amount that an upward plan leaves unspent on each axis.
    pub reserve: [u64; A],
}

/// A request of the monitor to plan anew.
///
/// ```
/// use cotama_core::hardware::Equipment;
/// use cotama_core::monitor::{Monitor, Request, Trigger};
///
/// let laser = Equipment::NONE.with(0, 1).unwrap();
/// let mut monitor = Monitor::new([600, 900], [0, 1]).unwrap();
/// monitor.planned(&[500, 800]).unwrap();
/// assert_eq!(monitor.assess(&[500, 800], laser, laser), Ok(Request::Keep));
/// let lost = monitor.assess(&[500, 800], laser, Equipment::NONE);
/// assert_eq!(lost, Ok(Request::Down(Trigger::Hardware)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Request {
    /// Nothing; go on.
    Keep,
    /// A plan that needs less.
    Down(Trigger),
    /// A better plan, within [`Monitor::room`].
    Up,
}

/// Why a plan no longer holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// The margin of this axis is below zero.
    Margin {
        /// The axis, the first in the order of treatment.
        axis: usize,
    },
    /// The rest of the plan needs hardware that is no longer there.
    Hardware,
}

/// Consumption so far against limits.
///
/// ```
/// use cotama_core::monitor::Monitor;
///
/// let mut monitor = Monitor::new([600, 900], [0, 1]).unwrap();
/// monitor.planned(&[500, 800]).unwrap();
/// monitor.spend(&[200, 450]).unwrap();
/// assert_eq!((monitor.used(), monitor.left()), ([200, 450], [400, 450]));
/// assert_eq!(monitor.margins(&[300, 460]), Ok([100, -10])); // 10 mJ are short
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Monitor<const A: usize> {
    limits: [u64; A],
    order: [usize; A],
    used: [u64; A],
    upward: Option<Upward<A>>,
    /// Margins right after the last plan.
    baseline: [i64; A],
    hardware_returned: bool,
}

impl<const A: usize> Monitor<A> {
    /// A monitor of these limits with nothing used, that never asks upwards. Of several margins
    /// below zero it names the axis that comes first in the order.
    ///
    /// # Errors
    /// A [`MonitorError`] for a limit beyond [`MAX_AMOUNT`], or for an order that does not name
    /// every axis once.
    pub fn new(limits: [u64; A], order: [usize; A]) -> Result<Self, MonitorError> {
        for (axis, &limit) in limits.iter().enumerate() {
            checked(axis, limit).map_err(MonitorError::Limit)?;
        }
        if !names_every_axis_once(&order) {
            return Err(MonitorError::BadOrder);
        }
        Ok(Self {
            limits,
            order,
            used: [0; A],
            upward: None,
            baseline: [0; A],
            hardware_returned: false,
        })
    }

    /// The same, asking upwards too.
    #[must_use]
    pub const fn with_upward(mut self, upward: Upward<A>) -> Self {
        self.upward = Some(upward);
        self
    }

    /// Returns the amount used on each axis.
    #[must_use]
    pub const fn used(&self) -> [u64; A] {
        self.used
    }

    /// Adds consumption.
    ///
    /// # Errors
    /// [`AmountError`] when a total passes [`MAX_AMOUNT`]; nothing is added then.
    pub fn spend(&mut self, cost: &[u64; A]) -> Result<(), AmountError> {
        let mut used = self.used;
        for axis in 0..A {
            used[axis] = checked(axis, used[axis].saturating_add(cost[axis]))?;
        }
        self.used = used;
        Ok(())
    }

    /// Returns the rest of each limit, for a plan downwards (rule 4 of the algorithm); zero where
    /// it is passed.
    #[must_use]
    pub fn left(&self) -> [u64; A] {
        core::array::from_fn(|axis| self.limits[axis].saturating_sub(self.used[axis]))
    }

    /// Returns the rest of each limit for a plan upwards: [`Self::left`] less the reserve.
    #[must_use]
    pub fn room(&self) -> [u64; A] {
        let reserve = self.upward.map_or([0; A], |upward| upward.reserve);
        core::array::from_fn(|axis| self.left()[axis].saturating_sub(reserve[axis]))
    }

    /// The margins: limit less used less planned rest, on each axis (eqs. 7 and 8).
    ///
    /// # Errors
    /// [`AmountError`] for a rest beyond [`MAX_AMOUNT`].
    pub fn margins(&self, rest: &[u64; A]) -> Result<[i64; A], AmountError> {
        let mut margins = [0; A];
        for axis in 0..A {
            let rest = checked(axis, rest[axis])?;
            debug_assert!(
                self.limits[axis].max(self.used[axis]) <= MAX_AMOUNT,
                "margins are exact"
            );
            // Exact: none of the three is beyond `MAX_AMOUNT`.
            let left =
                self.limits[axis].cast_signed().saturating_sub(self.used[axis].cast_signed());
            margins[axis] = left.saturating_sub(rest.cast_signed());
        }
        Ok(margins)
    }

    /// Notes that a plan with this rest is in force from now on, whether new or kept after a
    /// request.
    ///
    /// # Errors
    /// [`AmountError`] for a rest beyond [`MAX_AMOUNT`].
    pub fn planned(&mut self, rest: &[u64; A]) -> Result<(), AmountError> {
        self.baseline = self.margins(rest)?;
        self.hardware_returned = false;
        Ok(())
    }

    /// Notes that hardware has come back: a reason to ask upwards that needs no saving.
    pub const fn hardware_returned(&mut self) {
        self.hardware_returned = true;
    }

    /// Decides whether the plan still holds, from its planned rest, the hardware it needs and what
    /// there is.
    ///
    /// # Errors
    /// [`AmountError`] for a rest beyond [`MAX_AMOUNT`].
    pub fn assess(
        &self,
        rest: &[u64; A],
        needs: Equipment,
        available: Equipment,
    ) -> Result<Request, AmountError> {
        if !available.covers(needs) {
            return Ok(Request::Down(Trigger::Hardware));
        }
        let margins = self.margins(rest)?;
        if let Some(axis) =
            self.order.into_iter().find(|&axis| margins.get(axis).is_some_and(|&it| it < 0))
        {
            return Ok(Request::Down(Trigger::Margin { axis }));
        }
        debug_assert!(margins.iter().all(|it| *it >= 0), "each margin below 0 is found");
        let Some(upward) = self.upward else { return Ok(Request::Keep) };
        let reserve_kept =
            (0..A).all(|axis| margins[axis] >= upward.reserve[axis].min(MAX_AMOUNT).cast_signed());
        let grown = (0..A).any(|axis| {
            upward.growth[axis] > 0
                && margins[axis] >= self.baseline[axis].saturating_add_unsigned(upward.growth[axis])
        });
        Ok(if reserve_kept && (grown || self.hardware_returned) {
            Request::Up
        } else {
            Request::Keep
        })
    }

    /// The return margin: what would be left if the robot went to a safe end from here by the way
    /// whose worst cost is `way` (see [`worst`]). Below zero, reaching that end is not guaranteed.
    ///
    /// # Errors
    /// [`AmountError`] for a way beyond [`MAX_AMOUNT`].
    pub fn return_margin(&self, way: &[u64; A]) -> Result<[i64; A], AmountError> {
        self.margins(way)
    }
}

/// The most that activities can cost on each axis, whichever candidate is used in each.
///
/// ```
/// use cotama_core::monitor::{Monitor, worst};
/// use cotama_core::problem::Candidate;
///
/// let c = |duration, energy| Candidate { cost: [duration, energy], quality: 0, id: 0 };
/// let (a, b) = ([c(10, 90), c(40, 20)], [c(30, 30)]);
/// let way = worst(&[&a, &b]);
/// assert_eq!(way, [70, 120]);
/// let mut monitor = Monitor::new([100, 200], [0, 1]).unwrap();
/// monitor.spend(&[20, 100]).unwrap();
/// assert_eq!(monitor.return_margin(&way), Ok([10, -20])); // 20 mJ may lack on the way home
/// ```
#[must_use]
pub fn worst<const A: usize>(activities: &[&[Candidate<A>]]) -> [u64; A] {
    core::array::from_fn(|axis| {
        activities
            .iter()
            .map(|candidates| candidates.iter().map(|c| u64::from(c.cost[axis])).max().unwrap_or(0))
            .fold(0, u64::saturating_add)
    })
}

const fn checked(axis: usize, amount: u64) -> Result<u64, AmountError> {
    if amount > MAX_AMOUNT { Err(AmountError { axis }) } else { Ok(amount) }
}

#[cfg(test)]
mod tests;
