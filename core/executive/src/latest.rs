//! Data from one module to others, with its age.

use cotama_units::units::Micros;

/// The right to publish what a job made: only a job that is done gives one
/// ([`Happening::publication`](super::Happening::publication)), so a skipped job publishes nothing.
#[derive(Debug, PartialEq, Eq)]
#[must_use = "a job that is done publishes"]
pub struct Publication {
    pub(super) at: Micros,
}

/// The last value that a module published, and when.
///
/// ```
/// use cotama_core::executive::{Executive, Latest, Task};
/// use cotama_core::units::Micros;
///
/// let ms = |ms: u64| Micros(ms * 1_000);
/// let localisation = Task { deadline: ms(80), extra: ms(20), ..Task::new(ms(100), ms(50)) };
/// let mut executive = Executive::new([localisation]).unwrap();
/// let mut pose = Latest::empty();
/// assert!(executive.step(ms(0)).is_some()); // the release
/// let done = executive.complete(0, ms(50)).unwrap();
/// pose.publish(done.publication().unwrap(), "in the corridor");
/// // The consumer sees its age.
/// assert_eq!(pose.read(ms(150)), Some((&"in the corridor", ms(100))));
///
/// // The next job hangs, until it is stopped: the old value stays and grows older.
/// let mut last = None;
/// while let Some(happening) = executive.step(ms(199)) {
///     last = Some(happening);
/// }
/// assert_eq!(last.unwrap().publication(), None);
/// assert_eq!(pose.read(ms(200)), Some((&"in the corridor", ms(150))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Latest<T> {
    last: Option<(T, Micros)>,
}

impl<T> Latest<T> {
    /// Nothing was published yet.
    #[must_use]
    pub const fn empty() -> Self {
        Self { last: None }
    }

    /// Replaces the value. Its age counts from the end of the job.
    pub fn publish(&mut self, Publication { at }: Publication, value: T) {
        self.last = Some((value, at));
    }

    /// The last value and its age; `None` before the first.
    #[must_use]
    pub fn read(&self, now: Micros) -> Option<(&T, Micros)> {
        let (value, at) = self.last.as_ref()?;
        // A reader that learns the time late sees a fresh value.
        Some((value, Micros(now.0.saturating_sub(at.0))))
    }

    /// The last value, unless it is older than this.
    #[must_use]
    pub fn read_within(&self, now: Micros, oldest: Micros) -> Option<&T> {
        self.read(now).filter(|&(_, age)| age <= oldest).map(|(value, _)| value)
    }
}

impl<T> Default for Latest<T> {
    fn default() -> Self {
        Self::empty()
    }
}
