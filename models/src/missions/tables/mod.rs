//! The tables of a mission as an allocator needs them: numbers only, no heap, ready for flash.
//!
//! ```
//! use cotama_core::{hardware::Equipment, problem::Problem, units::Millimetres};
//! use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE, LIMITS, ORDER};
//! use cotama_models::missions::tables::{EMPTY, Rest, remaining};
//!
//! // 10 m before the end of the patrol, with everything working.
//! let mut candidates = [EMPTY; 32];
//! let mut lists = [&[][..]; 1];
//! let rest = Rest::Travel(Millimetres(10_000));
//! let last = &ACTIVITIES[16..];
//! let activities = remaining(last, Some(rest), AVAILABLE, &mut candidates, &mut lists).unwrap();
//! let problem = Problem::new(activities, LIMITS, ORDER).unwrap();
//! assert_eq!(problem.combinations(), Some(21));
//! ```

pub mod delivery;
pub mod patrol;
pub mod rows;

use cotama_core::hardware::Equipment;
use cotama_core::problem::Candidate;
use cotama_core::units::{Millijoules, Millimetres, MillimetresPerSecond, Millis, Milliwatts};

/// The performance axis of durations, in ms.
pub const DURATION: usize = 0;
/// The performance axis of energies, in mJ.
pub const ENERGY: usize = 1;

/// A candidate that costs nothing, to fill a buffer before its first use.
pub const EMPTY: Candidate<2> = Candidate { cost: [0; 2], quality: 0, id: 0 };

/// Quality is counted per this length of travel, in mm.
const QUALITY_LENGTH: u64 = 100;

/// An implementation alternative of an activity: its TIOs taken together.
///
/// ```
/// use cotama_core::hardware::Equipment;
/// use cotama_core::units::{Millimetres, Millis};
/// use cotama_models::missions::tables::{Alternative, Rest};
/// let drive = Alternative::travelling(410, 18_224, Equipment::NONE, 3);
/// assert_eq!(drive.cost(Rest::Travel(Millimetres(31_000))), Some([75_610, 1_377_917]));
/// assert_eq!(drive.quality_of(Rest::Travel(Millimetres(31_000))), Some(930));
/// let turn = Alternative::standing(8_000, 7_500, Equipment::NONE, 2);
/// assert_eq!(turn.cost(Rest::Time(Millis(8_000))), Some([8_000, 60_000]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Alternative {
    /// The speed of travel; zero when the activity does not travel.
    pub speed: MillimetresPerSecond,
    /// The duration of the whole activity when it does not travel, else zero.
    pub duration: Millis,
    /// The power of everything that is on.
    pub power: Milliwatts,
    /// The hardware it needs.
    pub needs: Equipment,
    /// The quality per 100 mm of travel, or of the whole activity when it does not travel.
    pub quality: u32,
}

/// The rest of an activity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rest {
    /// So much path, at the speed of the alternative.
    Travel(Millimetres),
    /// So much time, for an activity that does not travel.
    Time(Millis),
}

/// An activity and the ways to do it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Activity<'a> {
    /// Start on the path.
    pub x_start: Millimetres,
    /// End on the path; the same place when the activity does not travel.
    pub x_end: Millimetres,
    /// The alternatives; the index of each is its [`Candidate::id`].
    pub alternatives: &'a [Alternative],
}

impl Alternative {
    /// An alternative of an activity that travels.
    #[must_use]
    pub const fn travelling(
        speed_mm_s: u64,
        power_mw: u64,
        needs: Equipment,
        quality: u32,
    ) -> Self {
        let speed = MillimetresPerSecond(speed_mm_s);
        Self { speed, duration: Millis(0), power: Milliwatts(power_mw), needs, quality }
    }

    /// An alternative of an activity that does not travel.
    #[must_use]
    pub const fn standing(duration_ms: u64, power_mw: u64, needs: Equipment, quality: u32) -> Self {
        let duration = Millis(duration_ms);
        Self {
            speed: MillimetresPerSecond(0),
            duration,
            power: Milliwatts(power_mw),
            needs,
            quality,
        }
    }

    /// The duration (ms) and the energy (mJ) of a rest done this way, each rounded half up.
    ///
    /// `None` for travel without speed, or when a cost does not fit 32 bits.
    #[must_use]
    pub const fn cost(&self, rest: Rest) -> Option<[u32; 2]> {
        let duration = match rest {
            Rest::Travel(length) => Millis::to_travel(length, self.speed),
            Rest::Time(duration) => Some(duration),
        };
        let Some(duration) = duration else { return None };
        let Some(energy) = Millijoules::spent(self.power, duration) else { return None };
        if duration.0 > u32::MAX as u64 || energy.0 > u32::MAX as u64 {
            return None;
        }
        Some([duration.0 as u32, energy.0 as u32])
    }

    /// The quality of a rest done this way: per full 100 mm of travel, else that of the whole
    /// activity.
    ///
    /// `None` when it does not fit 32 bits.
    #[must_use]
    pub const fn quality_of(&self, rest: Rest) -> Option<u32> {
        match rest {
            Rest::Time(_) => Some(self.quality),
            Rest::Travel(length) => {
                match (self.quality as u64).checked_mul(length.0 / QUALITY_LENGTH) {
                    Some(quality) if quality <= u32::MAX as u64 => Some(quality as u32),
                    _ => None,
                }
            }
        }
    }

    /// A rest done this way as a candidate of the allocation problem; `None` as for cost and
    /// quality.
    #[must_use]
    pub const fn candidate(&self, rest: Rest, id: u16) -> Option<Candidate<2>> {
        match (self.cost(rest), self.quality_of(rest)) {
            (Some(cost), Some(quality)) => Some(Candidate { cost, quality, id }),
            _ => None,
        }
    }
}

impl Activity<'_> {
    /// Whether it moves along the path.
    #[must_use]
    pub const fn travels(&self) -> bool {
        self.x_start.0 < self.x_end.0
    }

    /// Returns the length; zero when the activity does not travel.
    #[must_use]
    pub const fn length(&self) -> Millimetres {
        Millimetres(self.x_end.0.saturating_sub(self.x_start.0))
    }

    /// The whole of it as a rest, for one of its alternatives.
    #[must_use]
    pub const fn whole(&self, alternative: &Alternative) -> Rest {
        if self.travels() { Rest::Travel(self.length()) } else { Rest::Time(alternative.duration) }
    }
}

/// Why there is no problem of the remaining mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RemainingError {
    /// The available hardware covers no alternative of this activity, the first such one.
    NoCandidates {
        /// Position in the given activities.
        activity: usize,
    },
    /// A cost or a quality of this activity does not fit 32 bits, or it has more than 65,536
    /// alternatives.
    TooLarge {
        /// Position in the given activities.
        activity: usize,
    },
    /// The buffer of candidates or that of lists is too small; see [`buffer_sizes`].
    BufferTooSmall,
}

impl core::fmt::Display for RemainingError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::NoCandidates { activity } => {
                write!(
                    f,
                    "the available hardware covers no alternative of remaining activity {activity}"
                )
            }
            Self::TooLarge { activity } => {
                write!(f, "a cost of remaining activity {activity} does not fit 32 bits")
            }
            Self::BufferTooSmall => {
                f.write_str("the buffers are too small for the remaining mission")
            }
        }
    }
}

impl core::error::Error for RemainingError {}

/// The buffers that [`remaining`] may need for these activities: candidates and lists. More than
/// `usize::MAX` candidates are that many: no buffer is so long.
#[must_use]
pub const fn buffer_sizes(activities: &[Activity<'_>]) -> (usize, usize) {
    let mut candidates = 0_usize;
    let mut activity = 0;
    while activity < activities.len() {
        candidates = candidates.saturating_add(activities[activity].alternatives.len());
        activity += 1;
    }
    (candidates, activities.len())
}

/// The candidates of a remaining mission, written into the caller's memory.
///
/// `activities` start with the current one, of which `first` is left, or all of it if that is
/// `None`. Alternatives that need more than `available` are left out. The lists returned are what
/// [`Problem::new`](cotama_core::problem::Problem::new) takes; [`Candidate::id`] is the index of
/// the alternative in its activity.
///
/// # Errors
/// The first activity without candidates, a cost that does not fit, or a buffer smaller than
/// needed.
///
/// ```
/// use cotama_core::units::Millimetres;
/// use cotama_models::missions::tables::patrol::{ACTIVITIES, AVAILABLE};
/// use cotama_models::missions::tables::{EMPTY, Rest, buffer_sizes, remaining};
/// // The last activity, of which 10 m are left, after both lasers (kind 1) were lost.
/// let last = &ACTIVITIES[16..];
/// assert_eq!(buffer_sizes(last), (21, 1));
/// let (mut candidates, mut lists) = ([EMPTY; 21], [&[][..]; 1]);
/// let left = AVAILABLE.without(1, 2);
/// let rest = Rest::Travel(Millimetres(10_000));
/// let lists = remaining(last, Some(rest), left, &mut candidates, &mut lists).unwrap();
/// assert_eq!((lists[0].len(), lists[0][0].cost), (4, [24_390, 224_973]));
/// ```
pub fn remaining<'c, 'l>(
    activities: &[Activity<'_>],
    first: Option<Rest>,
    available: Equipment,
    mut candidates: &'c mut [Candidate<2>],
    lists: &'l mut [&'c [Candidate<2>]],
) -> Result<&'l [&'c [Candidate<2>]], RemainingError> {
    let lists = lists.get_mut(..activities.len()).ok_or(RemainingError::BufferTooSmall)?;
    for (index, (activity, list)) in (0..usize::MAX).zip(activities.iter().zip(lists.iter_mut())) {
        let mut count = 0_usize;
        for (id, alternative) in (0..usize::MAX).zip(activity.alternatives) {
            if !available.covers(alternative.needs) {
                continue;
            }
            let rest = match first {
                Some(rest) if index == 0 => rest,
                _ => activity.whole(alternative),
            };
            let candidate = u16::try_from(id).ok().and_then(|id| alternative.candidate(rest, id));
            let place = candidates.get_mut(count).ok_or(RemainingError::BufferTooSmall)?;
            *place = candidate.ok_or(RemainingError::TooLarge { activity: index })?;
            count = count.saturating_add(1);
        }
        if count == 0 {
            return Err(RemainingError::NoCandidates { activity: index });
        }
        let memory = core::mem::take(&mut candidates);
        let (filled, free) =
            memory.split_at_mut_checked(count).ok_or(RemainingError::BufferTooSmall)?;
        *list = filled;
        candidates = free;
    }
    Ok(lists)
}
