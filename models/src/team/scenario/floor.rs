//! The floor: places, ways between them, and the shortest distance of any two.

use super::ground::{Asked, Ways};
use super::track::Track;
use std::collections::BinaryHeap;
use std::sync::Arc;

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
    /// The floor on which all of it stands; none of a team that names none.
    on: Option<On>,
}

/// A floor of walls and rooms on which the places of a team stand.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct On {
    /// The floor: a name, or the path of a file.
    pub floor: String,
    /// Doors that are open, other than the floor says.
    pub open: Vec<String>,
    /// Doors that are closed.
    pub close: Vec<String>,
    /// Ways whose lengths the file says: between those the floor only draws; the smaller number
    /// first. None of a team whose places all lead to each other.
    given: Vec<(usize, usize)>,
    /// Whether the file names ways; else each place leads to each.
    has_ways: bool,
    /// The planned ways; none where nobody had the floor, and all lengths are the file's.
    ways: Option<Arc<Ways>>,
    /// The track of each pair of [`Asked::pairs`](super::Asked::pairs).
    tracks: Vec<((usize, usize), Track)>,
}

impl On {
    /// A floor as a file names it: with its planned ways, if somebody had it, and the ways whose
    /// lengths the file says; `None` of these where it names no ways.
    pub(super) fn new(
        floor: String,
        [open, close]: [Vec<String>; 2],
        given: Option<Vec<(usize, usize)>>,
        ways: Option<Arc<Ways>>,
    ) -> Self {
        let has_ways = given.is_some();
        let mut given = given.unwrap_or_default();
        given.iter_mut().for_each(|it| *it = (it.0.min(it.1), it.0.max(it.1)));
        given.sort_unstable();
        let tracks = ways.iter().flat_map(|it| it.asked.pairs().into_iter().zip(&it.legs));
        let tracks = tracks.filter_map(|(at, it)| Some((at, Track::of(&it.as_ref().ok()?.points))));
        let tracks = tracks.collect();
        Self { floor, open, close, given, has_ways, ways, tracks }
    }

    /// Returns the planned ways, with the text of the floor; `None` where nobody had the floor.
    pub fn ways(&self) -> Option<&Ways> {
        self.ways.as_deref()
    }

    /// Whether the file names ways; else each place leads to each.
    pub fn has_ways(&self) -> bool {
        self.has_ways
    }

    /// Whether the length of a way is that of its planned path, and not one that the file says.
    pub fn measures(&self, a: usize, b: usize) -> bool {
        !self.given.contains(&(a.min(b), a.max(b)))
    }

    fn track(&self, a: usize, b: usize) -> Option<&Track> {
        let at = (a.min(b), a.max(b));
        let found = self.tracks.binary_search_by_key(&at, |it| it.0).ok()?;
        self.tracks.get(found).map(|it| &it.1)
    }
}

/// A part of a drive along one way, in mm from its first place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stretch {
    pub(super) from: Place,
    pub(super) to: Place,
    start: u64,
    end: u64,
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
            on: None,
        };
        (0..count).for_each(|goal| floor.reach(goal));
        floor
    }

    /// Places each of which leads to each, as a floor plans it: no drive goes by another place,
    /// even where that were shorter.
    pub(super) fn direct(names: &[&str], ways: &[(usize, usize, u64)]) -> Self {
        let (mut floor, count) = (Self::new(names, ways), names.len());
        for goal in 0..count {
            for place in 0..count {
                let at = place * count + goal;
                let way = if place == goal { Some(0) } else { floor.way(place, goal) };
                (floor.distances[at], floor.next[at]) = (way, goal);
            }
        }
        floor
    }

    /// The same on a floor of walls and rooms.
    #[must_use]
    pub(super) fn standing_on(self, on: On) -> Self {
        Self { on: Some(on), ..self }
    }

    /// Returns what the same asks a floor for that only draws it: all of its places and ways.
    pub fn asked_on(&self, floor: &str) -> Asked {
        let ways = self.ways().map(|it| (it.0, it.1)).collect();
        let floor = floor.to_owned();
        Asked { floor, places: self.names.clone(), ways, ..Asked::default() }
    }

    /// Returns the same on a floor that only draws it, by its answer to what it
    /// [asks](Self::asked_on): lengths stay.
    #[must_use]
    pub fn drawn_on(self, ways: Ways) -> Self {
        let Asked { floor, open, close, .. } = ways.asked.clone();
        let given = self.ways().map(|it| (it.0, it.1)).collect();
        self.standing_on(On::new(floor, [open, close], Some(given), Some(Arc::new(ways))))
    }

    /// Returns the floor on which it stands; none of a team that names none.
    pub fn on(&self) -> Option<&On> {
        self.on.as_ref()
    }

    /// Whether each spot has a place on a floor that is at hand.
    pub fn is_drawn(&self) -> bool {
        self.on.as_ref().is_some_and(|it| it.ways.is_some())
    }

    /// Returns the place of a spot in mm from the left lower corner of the floor: the point of the
    /// planned path at that length, in proportion where the file says another length. `None`
    /// without a floor.
    pub fn at_mm(&self, spot: Spot) -> Option<[i32; 2]> {
        let on = self.on.as_ref()?;
        let (a, b) = (spot.from.0, spot.to.0);
        if a == b {
            return on.ways()?.places.get(a)?.as_ref().ok().copied();
        }
        let whole = self.way(a, b)?;
        let done = if a < b { spot.done_mm } else { whole.saturating_sub(spot.done_mm) };
        on.track(a, b)?.at(done, whole)
    }

    /// Returns the corners of the shortest drive from spot to spot, each with the length up to it
    /// in mm, the ends among them; empty without a floor, or where no way leads.
    pub fn course(&self, from: Spot, to: Spot) -> Vec<(u64, [i32; 2])> {
        let (Some(on), Some(road)) = (&self.on, self.road(from, to)) else { return Vec::new() };
        let (mut course, mut gone) = (Vec::new(), 0);
        course.extend(self.at_mm(from).map(|it| (0, it)));
        for Stretch { from, to, start, end } in road {
            let whole = self.way(from.0, to.0).unwrap_or(0);
            let along = |it: u64| if from < to { it } else { whole.saturating_sub(it) };
            if let Some(track) = on.track(from.0, to.0) {
                let corners = track.between(along(start), along(end), whole).into_iter();
                let corners = corners.map(|it| (gone + along(it.0).abs_diff(start), it.1));
                course.extend(corners);
            }
            gone += start.abs_diff(end);
            course.extend(self.at_mm(Spot { from, to, done_mm: end }).map(|it| (gone, it)));
        }
        course
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
        let mut left = way_mm;
        let road = self.road(from, to).unwrap_or_default();
        for Stretch { from, to, start, end } in road {
            let length = start.abs_diff(end);
            if left <= length {
                let done_mm = if end >= start { start + left } else { start - left };
                return Spot { from, to, done_mm };
            }
            left -= length;
        }
        to
    }

    /// The stretches of the shortest road; `None` where no way leads.
    pub(super) fn road(&self, from: Spot, to: Spot) -> Option<Vec<Stretch>> {
        let whole = self.distance(from, to)?;
        let stretch = |end| Stretch { from: from.from, to: from.to, start: from.done_mm, end };
        if self.along(from, to) == Some(whole) {
            let same = (from.from, from.to) == (to.from, to.to);
            return Some(vec![stretch(if same { to.done_mm } else { self.ends(to)[0].1 })]);
        }
        let goals = self.ends(to);
        let nearest = |place: usize| {
            let way = |it: &(usize, u64)| Some((self.between(place, it.0)? + it.1, it.0));
            goals.iter().filter_map(way).min()
        };
        let leads = |it: &&(usize, u64)| nearest(it.0).is_some_and(|rest| it.1 + rest.0 == whole);
        let ends = self.ends(from);
        let mut place = ends.iter().find(leads)?.0;
        let back = place == from.from.0;
        let first = stretch(if back { 0 } else { self.way(from.from.0, from.to.0).unwrap_or(0) });
        let mut road = Vec::from_iter((from.from != from.to).then_some(first));
        // A road passes each place once at most.
        for _ in 0..=self.names.len() {
            let goal = nearest(place)?.1;
            if place != goal {
                let next = self.next[place * self.names.len() + goal];
                let end = self.way(place, next)?;
                road.push(Stretch { from: Place(place), to: Place(next), start: 0, end });
                place = next;
                continue;
            }
            if to.from != to.to {
                let next = if to.from.0 == place { to.to.0 } else { to.from.0 };
                let end = goals.iter().find(|it| it.0 == place)?.1;
                road.push(Stretch { from: Place(place), to: Place(next), start: 0, end });
            }
            break;
        }
        Some(road)
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
