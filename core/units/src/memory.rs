//! Memory that a caller gives as slices, and what is said when it is too small.

/// Memory that the caller gave is too small for the problem.
///
/// ```
/// use cotama_core::allocation::Allocator;
/// use cotama_core::panorama::Panorama;
/// use cotama_core::problem::{Candidate, Problem};
///
/// let activity = [Candidate { cost: [7], quality: 1, id: 0 }];
/// let activities = [&activity[..], &activity[..]];
/// let problem = Problem::new(&activities, [20], [0]).unwrap();
/// let error = Panorama::new(&mut [[0]; 2]).allocate(&problem, &mut [0; 1]).unwrap_err();
/// assert_eq!(error.to_string(), "the plan needs 2 elements, 1 were given");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MemoryError {
    /// The kind of memory that is too small.
    pub what: &'static str,
    /// How many elements are needed.
    pub needed: usize,
    /// How many elements were given.
    pub given: usize,
}

impl core::fmt::Display for MemoryError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "the {} needs {} elements, {} were given", self.what, self.needed, self.given)
    }
}

impl core::error::Error for MemoryError {}

/// Says whether `given` elements of memory suffice.
///
/// # Errors
/// When fewer are given than are needed.
pub const fn enough(what: &'static str, needed: usize, given: usize) -> Result<(), MemoryError> {
    if given < needed { Err(MemoryError { what, needed, given }) } else { Ok(()) }
}

/// Returns as many elements as are needed: no answer depends on the problems before.
#[cfg(feature = "alloc")]
pub fn at_least<T: Copy>(memory: &mut alloc::vec::Vec<T>, needed: usize, empty: T) -> &mut [T] {
    if memory.len() < needed {
        memory.resize(needed, empty);
    }
    memory.get_mut(..needed).unwrap_or(&mut [])
}
