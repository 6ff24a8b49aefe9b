//! The floor: places, ways between them, and the shortest distance of any two.

use std::collections::BinaryHeap;

/// A place, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place(pub usize);

/// A spot on the floor: so far from one place towards a neighbour, or at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spot {
    /// The place that it is coming from.
    pub from: Place,
    /// The next place.
    pub to: Place,
    /// How far it has come, in mm; at most the length of the way.
    pub done_mm: u64,
}

impl Spot {
    /// At a place.
    pub const fn at(place: Place) -> Self {
        Self { from: place, to: place, done_mm: 0 }
    }
}

/// Places, and ways between them that can be gone in both directions.
///
/// ```
/// use cotama_models::team::scenario::{Floor, Place, Spot};
/// let floor = Floor::new(&["hall", "kitchen", "desk"], &[(0, 1, 4_000), (0, 2, 3_000)]);
/// assert_eq!(floor.distance(Spot::at(Place(1)), Spot::at(Place(2))), Some(7_000));
/// let under_way = Spot { from: Place(1), to: Place(0), done_mm: 1_000 };
/// assert_eq!(floor.distance(under_way, Spot::at(Place(2))), Some(6_000));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Floor {
    names: Vec<String>,
    /// Neighbours of each place, with the length of the road in mm.
    ways: Vec<Vec<(usize, u64)>>,
    /// From each place to each, in mm, row by row; none where no way leads.
    distances: Vec<Option<u64>>,
    /// The first place on the shortest way from each place to each.
    next: Vec<usize>,
}

impl Floor {
    /// Places by name, and ways between their numbers with lengths in mm. Ways to places that are
    /// not there are left out.
    pub fn new(names: &[&str], ways: &[(usize, usize, u64)]) -> Self {
        let count = names.len();
        let mut neighbours = vec![Vec::new(); count];
        for &(a, b, length) in ways.iter().filter(|it| it.0 < count && it.1 < count) {
            neighbours[a].push((b, length));
            neighbours[b].push((a, length));
        }
        // The order in which ways are named changes nothing.
        neighbours.iter_mut().for_each(|it| it.sort_unstable());
        let mut floor = Self {
            names: names.iter().map(|&it| it.to_owned()).collect(),
            ways: neighbours,
            distances: vec![None; count * count],
            next: vec![0; count * count],
        };
        (0..count).for_each(|goal| floor.reach(goal));
        floor
    }

    /// Distances of all places to one (E. W. Dijkstra, 1959), and where the way begins.
    fn reach(&mut self, goal: usize) {
        let count = self.names.len();
        let mut queue = BinaryHeap::from([std::cmp::Reverse((0, goal, goal))]);
        while let Some(std::cmp::Reverse((length, place, next))) = queue.pop() {
            let at = place * count + goal;
            if self.distances[at].is_some() {
                continue;
            }
            (self.distances[at], self.next[at]) = (Some(length), next);
            queue.extend(
                self.ways[place].iter().map(|it| std::cmp::Reverse((length + it.1, it.0, place))),
            );
        }
    }

    /// Ways between the numbers of places, each once, with their lengths in mm.
    pub fn ways(&self) -> impl Iterator<Item = (usize, usize, u64)> + '_ {
        let of = |(a, ways): (usize, &Vec<(usize, u64)>)| {
            ways.iter()
                .filter(move |it| a < it.0)
                .map(move |it| (a, it.0, it.1))
                .collect::<Vec<_>>()
        };
        self.ways.iter().enumerate().flat_map(of)
    }

    /// How many places there are.
    pub fn places(&self) -> usize {
        self.names.len()
    }

    /// The name of a place.
    pub fn name(&self, place: Place) -> &str {
        self.names.get(place.0).map_or("?", |it| it)
    }

    /// The length of the way between neighbours.
    fn way(&self, a: usize, b: usize) -> Option<u64> {
        self.ways.get(a)?.iter().find(|it| it.0 == b).map(|it| it.1)
    }

    fn between(&self, a: usize, b: usize) -> Option<u64> {
        self.distances.get(a * self.names.len() + b).copied().flatten()
    }

    /// The ends of the way on which something is, with what is left to each.
    fn ends(&self, spot: Spot) -> [(usize, u64); 2] {
        let (a, b) = (spot.from.0, spot.to.0);
        let whole = self.way(a, b).unwrap_or(spot.done_mm);
        [(b, whole.saturating_sub(spot.done_mm)), (a, spot.done_mm)]
    }

    /// The shortest distance, in mm; none where no way leads.
    pub fn distance(&self, from: Spot, to: Spot) -> Option<u64> {
        let along = self.along(from, to);
        let around = self.ends(from).into_iter().flat_map(|(a, before)| {
            self.ends(to).map(|(b, after)| Some(before + self.between(a, b)? + after))
        });
        around.flatten().chain(along).min()
    }

    /// The distance of two spots on the same way, along it.
    fn along(&self, from: Spot, to: Spot) -> Option<u64> {
        if (from.from, from.to) == (to.from, to.to) {
            return Some(from.done_mm.abs_diff(to.done_mm));
        }
        let whole = self.way(to.from.0, to.to.0)?;
        let turned = (from.from, from.to) == (to.to, to.from);
        turned.then(|| from.done_mm.abs_diff(whole.saturating_sub(to.done_mm)))
    }

    /// Returns the spot after so long a way on the shortest road.
    pub fn gone(&self, from: Spot, to: Spot, way_mm: u64) -> Spot {
        let Some(whole) = self.distance(from, to) else { return from };
        if way_mm >= whole {
            return to;
        }
        if self.along(from, to) == Some(whole) {
            let same = (from.from, from.to) == (to.from, to.to);
            let end = if same { to.done_mm } else { self.ends(to)[0].1 };
            let done_mm =
                if end >= from.done_mm { from.done_mm + way_mm } else { from.done_mm - way_mm };
            return Spot { done_mm, ..from };
        }
        let goals = self.ends(to);
        let leads = |&(a, before): &(usize, u64)| {
            let rest = goals.iter().filter_map(|it| Some(self.between(a, it.0)? + it.1)).min();
            rest.is_some_and(|it| before + it == whole)
        };
        let Some(&(mut place, before)) = self.ends(from).iter().find(|it| leads(it)) else {
            return from;
        };
        if way_mm <= before {
            let (back, done) = (place == from.from.0 && from.from != from.to, from.done_mm);
            let done_mm = if back { done - way_mm } else { done + way_mm };
            return Spot { done_mm, ..from };
        }
        let mut left = way_mm - before;
        let nearest = |place: usize| {
            let way = |it: &(usize, u64)| Some((self.between(place, it.0)? + it.1, it.0));
            goals.iter().filter_map(way).min().map(|it| it.1)
        };
        loop {
            let Some(goal) = nearest(place) else { return to };
            let next = if place == goal {
                if to.from.0 == place { to.to.0 } else { to.from.0 }
            } else {
                self.next[place * self.names.len() + goal]
            };
            let Some(length) = self.way(place, next) else { return to };
            if left <= length {
                return Spot { from: Place(place), to: Place(next), done_mm: left };
            }
            (left, place) = (left - length, next);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ring() -> Floor {
        let ways = [(0, 1, 500), (1, 2, 700), (2, 3, 300), (3, 0, 900), (1, 4, 400)];
        Floor::new(&["a", "b", "c", "d", "e"], &ways)
    }

    fn spots() -> impl Strategy<Value = Spot> {
        let ways = [(0, 1, 500), (1, 2, 700), (2, 3, 300), (3, 0, 900), (1, 4, 400)];
        (0..ways.len(), any::<bool>(), 0_u64..1_000).prop_map(move |(at, turned, share)| {
            let (a, b, length) = ways[at];
            let (from, to) = if turned { (b, a) } else { (a, b) };
            Spot { from: Place(from), to: Place(to), done_mm: length * share / 999 }
        })
    }

    proptest! {
        #[test]
        fn a_longer_drive_comes_nearer(from in spots(), to in spots(), way in 0_u64..3_000) {
            let floor = ring();
            let whole = floor.distance(from, to).unwrap();
            prop_assert_eq!(floor.distance(to, from), Some(whole));
            let there = floor.gone(from, to, way);
            prop_assert_eq!(floor.distance(there, to), Some(whole.saturating_sub(way)));
            prop_assert_eq!(floor.distance(from, there), Some(whole.min(way)));
        }
    }
}
