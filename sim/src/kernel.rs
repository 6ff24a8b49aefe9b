//! The queue of what comes next: by time, then priority, then the order of insertion.
//!
//! ```
//! use cotama_sim::kernel::Queue;
//! let mut queue = Queue::new();
//! queue.push(20, 0, "late");
//! queue.push(10, 1, "second");
//! queue.push(10, 0, "first");
//! let order: Vec<_> = std::iter::from_fn(|| queue.pop()).collect();
//! assert_eq!(order, [(10, "first"), (10, "second"), (20, "late")]);
//! ```

use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// A discrete-event queue. Equal times leave by priority (lower first), equal priorities in the
/// order in which they came; nothing else decides, so the order is the same everywhere.
///
/// ```
/// use cotama_sim::kernel::Queue;
/// let mut queue = Queue::new();
/// queue.push(20, 0, "late");
/// queue.push(10, 1, "second");
/// queue.push(10, 0, "first");
/// assert_eq!(queue.pop(), Some((10, "first"))); // of equal times the lower priority
/// assert_eq!((queue.pop(), queue.next_time()), (Some((10, "second")), Some(20)));
/// ```
#[derive(Clone, Debug)]
pub struct Queue<E> {
    heap: BinaryHeap<Entry<E>>,
    sequence: u64,
}

#[derive(Clone, Debug)]
struct Entry<E> {
    key: (u64, u8, u64),
    event: E,
}

impl<E> PartialEq for Entry<E> {
    fn eq(&self, other: &Self) -> bool {
        self.key == other.key
    }
}

impl<E> Eq for Entry<E> {}

impl<E> PartialOrd for Entry<E> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<E> Ord for Entry<E> {
    /// Reversed, since the heap gives its largest.
    fn cmp(&self, other: &Self) -> Ordering {
        other.key.cmp(&self.key)
    }
}

impl<E> Default for Queue<E> {
    fn default() -> Self {
        Self::new()
    }
}

impl<E> Queue<E> {
    /// An empty queue.
    pub const fn new() -> Self {
        Self { heap: BinaryHeap::new(), sequence: 0 }
    }

    /// Adds an event at a time in µs. Of equal times the lower priority leaves first.
    pub fn push(&mut self, time_us: u64, priority: u8, event: E) {
        self.heap.push(Entry { key: (time_us, priority, self.sequence), event });
        self.sequence += 1;
    }

    /// Takes the first event and its time in µs.
    pub fn pop(&mut self) -> Option<(u64, E)> {
        self.heap.pop().map(|entry| (entry.key.0, entry.event))
    }

    /// The time of the first event, in µs.
    pub fn next_time(&self) -> Option<u64> {
        self.heap.peek().map(|entry| entry.key.0)
    }

    /// Drops all events; the order of insertion goes on.
    pub fn clear(&mut self) {
        self.heap.clear();
    }

    /// How many events wait.
    pub fn len(&self) -> usize {
        self.heap.len()
    }

    /// Whether none waits.
    pub fn is_empty(&self) -> bool {
        self.heap.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[derive(Clone, Debug)]
    enum Step {
        Push(u64, u8),
        Pop,
    }

    fn step() -> impl Strategy<Value = Step> {
        prop_oneof![
            3 => (0u64..8, 0u8..3).prop_map(|(t, p)| Step::Push(t, p)),
            2 => Just(Step::Pop)
        ]
    }

    proptest! {
        #[test]
        fn the_queue_is_a_sorted_list(steps in prop::collection::vec(step(), 0..200)) {
            let mut queue = Queue::new();
            let mut list: Vec<(u64, u8, usize)> = Vec::new();
            for (number, step) in steps.into_iter().enumerate() {
                match step {
                    Step::Push(time, priority) => {
                        queue.push(time, priority, number);
                        list.push((time, priority, number));
                        list.sort_unstable();
                    }
                    Step::Pop => {
                        let expected = (!list.is_empty()).then(|| list.remove(0));
                        prop_assert_eq!(queue.next_time(), expected.map(|(time, ..)| time));
                        prop_assert_eq!(
                            queue.clone().pop(),
                            expected.map(|(time, _, event)| (time, event))
                        );
                        prop_assert_eq!(
                            queue.pop(),
                            expected.map(|(time, _, event)| (time, event))
                        );
                    }
                }
                prop_assert_eq!(queue.len(), list.len());
                prop_assert_eq!(queue.is_empty(), list.is_empty());
            }
        }
    }
}
