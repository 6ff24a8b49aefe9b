//! The candidates of what is left of a mission, on the heap.

use super::tables::{Activity, EMPTY, RemainingError, Rest, buffer_sizes, remaining};
use cotama_core::hardware::Equipment;
use cotama_core::problem::Candidate;

/// The candidates of what is left of a mission: those of [`remaining`], with their memory.
///
/// ```
/// use cotama_models::missions::{Mission, Remaining, embedded};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let scenario = mission.scenario();
/// let left = Remaining::new(&scenario.activities()[16..], None, scenario.available()).unwrap();
/// let lists = left.lists();
/// assert_eq!((lists.len(), lists[0].len()), (1, 21));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remaining {
    candidates: Vec<Candidate<2>>,
    /// The number of candidates of each activity. *Invariant:* their sum is at most the number of
    /// candidates.
    counts: Vec<usize>,
}

impl Remaining {
    /// Returns the candidates of these activities, of whose first one `first` is left, or all of it
    /// if that is `None`.
    ///
    /// # Errors
    /// As those of [`remaining`]; the memory always suffices.
    pub fn new(
        activities: &[Activity<'_>],
        first: Option<Rest>,
        available: Equipment,
    ) -> Result<Self, RemainingError> {
        let (candidates, lists) = buffer_sizes(activities);
        let (mut candidates, mut lists) = (vec![EMPTY; candidates], vec![&[][..]; lists]);
        let lists = remaining(activities, first, available, &mut candidates, &mut lists)?;
        let counts = lists.iter().map(|it| it.len()).collect();
        Ok(Self { candidates, counts })
    }

    /// Returns the candidates of each activity.
    pub fn lists(&self) -> Vec<&[Candidate<2>]> {
        let mut rest = self.candidates.as_slice();
        let next = |&count: &usize| {
            let (list, behind) = rest.split_at(count);
            rest = behind;
            list
        };
        self.counts.iter().map(next).collect()
    }
}
