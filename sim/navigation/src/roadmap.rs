//! Probabilistic roadmaps that are checked lazily.

use crate::work::Work;
use cotama_floor::{Path, Point, Surface};
use cotama_streams::Streams;
use petgraph::algo::astar;
use petgraph::graph::{EdgeIndex, NodeIndex, UnGraph};
use petgraph::visit::{EdgeFiltered, EdgeRef};

/// The most samples of a roadmap.
pub const MAX_SAMPLES: usize = 4_096;
/// The least room beyond the radius that makes a straight line free, in metres. With it, a line is
/// checked in so many steps at most.
pub const SPARE_M: f64 = 0.005;

/// Properties of a roadmap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// The number of samples, at most [`MAX_SAMPLES`].
    pub samples: usize,
    /// Samples no further from each other than this are neighbours, in metres.
    pub near_m: f64,
    /// Radius of the disc that must find room everywhere, in metres.
    pub radius_m: f64,
}

/// Reasons why there is no way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoWay {
    /// The robot finds no room at the start.
    Start,
    /// The robot finds no room at the goal.
    Goal,
    /// No way is in the roadmap. There may be one on the floor.
    InRoadmap,
}

impl core::fmt::Display for NoWay {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Start => "no room for the robot at the start",
            Self::Goal => "no room for the robot at the goal",
            Self::InRoadmap => "no way in the roadmap: take more samples, or a larger radius",
        })
    }
}

impl core::error::Error for NoWay {}

/// Knowledge of a node or an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Unknown,
    Free,
    Blocked,
}

#[derive(Clone, Copy, Debug)]
struct Sample {
    at: Point,
    state: State,
}

#[derive(Clone, Copy, Debug)]
struct Line {
    length: f64,
    state: State,
}

/// A lazy probabilistic roadmap (R. Bohlin, L. E. Kavraki, "Path planning using lazy PRM", IEEE
/// International Conference on Robotics and Automation, 2000).
///
/// Samples are uniform over the floor; those within a radius are neighbours. Nothing is checked
/// before A* finds a way of unknown parts; then its samples, and if they are free its lines, from
/// both ends inwards. What is blocked leaves the roadmap, and A* begins again. What was checked
/// stays known for the next question. The enhancement of the roadmap is left
/// out: without a way in it, the answer is [`NoWay::InRoadmap`].
///
/// A way that is found is free: at each of its points a disc of the radius finds room. The same
/// stream gives the same roadmap, whatever is asked of it.
///
/// ```
/// use cotama_floor::{Version, embedded, metres};
/// use cotama_navigation::{Roadmap, Sampling};
/// use cotama_streams::Streams;
/// let office = embedded::OFFICE.floor().unwrap();
/// let charted = office.surface(Version::Charted, &[]).unwrap();
/// let sampling = Sampling { samples: 2_500, near_m: 2.0, radius_m: 0.26 };
/// let mut roadmap = Roadmap::new(&charted, sampling, &Streams::new(7));
/// let place = |name| metres(office.place(name).unwrap().at);
/// let path = roadmap.route(place("kitchen"), place("lab")).unwrap();
/// assert!((12.0..16.0).contains(&path.length()), "{}", path.length());
/// ```
pub struct Roadmap<'s> {
    surface: &'s dyn Surface,
    sampling: Sampling,
    graph: UnGraph<Sample, Line>,
    work: Work,
}

impl core::fmt::Debug for Roadmap<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let mut it = f.debug_struct("Roadmap");
        it.field("sampling", &self.sampling).field("work", &self.work).finish_non_exhaustive()
    }
}

impl<'s> Roadmap<'s> {
    /// Draws the samples over the charted floor, by the stream `roadmap`, and joins neighbours.
    pub fn new(surface: &'s dyn Surface, sampling: Sampling, streams: &Streams) -> Self {
        let mut stream = streams.stream("roadmap");
        let bounds = surface.bounds();
        let mut it = Self { surface, sampling, graph: UnGraph::default(), work: Work::default() };
        for _ in 0..sampling.samples.min(MAX_SAMPLES) {
            let x = bounds.least.x + stream.part() * bounds.width();
            let y = bounds.least.y + stream.part() * bounds.height();
            it.add(Point::new(x, y));
        }
        it
    }

    fn add(&mut self, at: Point) -> NodeIndex {
        let near = |it: &NodeIndex| {
            let length = (self.graph.node_weight(*it)?.at - at).norm();
            (length <= self.sampling.near_m).then_some((*it, length))
        };
        let others = self.graph.node_indices();
        let near: Vec<_> = others.filter_map(|it| near(&it)).collect();
        self.work.operations += self.graph.node_count() as u64;
        let node = self.graph.add_node(Sample { at, state: State::Unknown });
        for (other, length) in near {
            self.graph.add_edge(node, other, Line { length, state: State::Unknown });
        }
        node
    }

    /// Finds a way, and shortens it.
    ///
    /// # Errors
    /// An end without room for the robot at an end, or there is no way in the roadmap.
    pub fn route(&mut self, from: Point, to: Point) -> Result<Path, NoWay> {
        if !self.has_room(from) {
            return Err(NoWay::Start);
        }
        if !self.has_room(to) {
            return Err(NoWay::Goal);
        }
        let ends = [from, to].map(|it| self.add(it));
        let found = self.search(ends);
        // The last first, so that no other number changes.
        for end in ends.iter().rev() {
            self.graph.remove_node(*end);
        }
        let points = self.shorten(&found.ok_or(NoWay::InRoadmap)?);
        let short = || Path::new(vec![from, from + nalgebra::Vector2::new(0.001, 0.0)]);
        Path::new(points).or_else(short).ok_or(NoWay::InRoadmap)
    }

    /// Each round either returns a way or blocks a sample or a line, of which there are finitely
    /// many.
    fn search(&mut self, [from, to]: [NodeIndex; 2]) -> Option<Vec<Point>> {
        loop {
            let nodes = self.find([from, to])?;
            if self.check_samples(&nodes) && self.check_lines(&nodes) {
                let point = |it: &NodeIndex| self.graph.node_weight(*it).map(|it| it.at);
                return nodes.iter().map(point).collect();
            }
        }
    }

    fn find(&mut self, [from, to]: [NodeIndex; 2]) -> Option<Vec<NodeIndex>> {
        let graph = &self.graph;
        let goal = graph.node_weight(to)?.at;
        let open = EdgeFiltered::from_fn(graph, |it| {
            let is_free =
                |node| graph.node_weight(node).is_some_and(|it| it.state != State::Blocked);
            it.weight().state != State::Blocked && is_free(it.source()) && is_free(it.target())
        });
        let (mut looked, mut opened) = (0, 0);
        let found = astar(
            &open,
            from,
            |it| it == to,
            |it| {
                looked += 1;
                it.weight().length
            },
            |it| {
                opened += 1;
                graph.node_weight(it).map_or(0.0, |it| (it.at - goal).norm())
            },
        );
        self.work.operations += looked;
        self.work.nodes += opened;
        found.map(|it| it.1)
    }

    /// Checks the samples of a way, from its ends inwards; stops at one that is blocked.
    fn check_samples(&mut self, nodes: &[NodeIndex]) -> bool {
        for node in inwards(nodes) {
            let Some(sample) = self.graph.node_weight(*node).copied() else { return false };
            if sample.state == State::Unknown {
                let is_free = self.has_room(sample.at);
                if let Some(it) = self.graph.node_weight_mut(*node) {
                    it.state = if is_free { State::Free } else { State::Blocked };
                }
                if !is_free {
                    return false;
                }
            }
        }
        true
    }

    fn check_lines(&mut self, nodes: &[NodeIndex]) -> bool {
        let ends = nodes.iter().zip(nodes.iter().skip(1));
        let lines = ends.filter_map(|(a, b)| self.graph.find_edge(*a, *b));
        let lines: Vec<EdgeIndex> = lines.collect();
        for line in inwards(&lines) {
            let known = self.graph.edge_weight(*line).map(|it| it.state);
            let Some((a, b)) = self.graph.edge_endpoints(*line) else { return false };
            let ends = self.graph.node_weight(a).zip(self.graph.node_weight(b));
            let Some((a, b)) = ends.map(|(a, b)| (a.at, b.at)) else { return false };
            if known == Some(State::Unknown) {
                let is_free = self.is_free(a, b);
                if let Some(it) = self.graph.edge_weight_mut(*line) {
                    it.state = if is_free { State::Free } else { State::Blocked };
                }
                if !is_free {
                    return false;
                }
            }
        }
        true
    }

    fn has_room(&mut self, at: Point) -> bool {
        self.work.rays += 1;
        let needed = self.sampling.radius_m + SPARE_M;
        self.surface.clearance(at, needed) >= needed
    }

    /// Whether a disc finds room along a straight line. Room falls by no more than the way that is
    /// gone, so each step goes as far as there is more than the radius.
    fn is_free(&mut self, from: Point, to: Point) -> bool {
        let Sampling { radius_m, near_m, .. } = self.sampling;
        let way = to - from;
        let (length, mut along) = (way.norm(), 0.0);
        loop {
            let at = from + way * if length > 0.0 { along / length } else { 0.0 };
            let room = self.surface.clearance(at, radius_m + near_m.max(SPARE_M));
            self.work.rays += 1;
            if room < radius_m + SPARE_M {
                return false;
            }
            if along >= length {
                return true;
            }
            along = (along + room - radius_m).min(length);
        }
    }

    /// Leaves out corners where a straight line is free: each point is joined to the last one that
    /// it can be. The way is no longer than before and free; the shortest it need not be.
    fn shorten(&mut self, points: &[Point]) -> Vec<Point> {
        let mut out: Vec<Point> = points.first().copied().into_iter().collect();
        let mut at = 0;
        while let Some(from) = points.get(at).copied() {
            let further = points.iter().enumerate().skip(at + 1).rev();
            let further: Vec<_> = further.map(|it| (it.0, *it.1)).collect();
            let Some(&(next, point)) =
                further.iter().find(|(next, it)| *next == at + 1 || self.is_free(from, *it))
            else {
                break;
            };
            out.push(point);
            at = next;
        }
        out
    }

    /// Returns the work that was done since the roadmap was begun.
    pub const fn work(&self) -> Work {
        self.work
    }
}

/// Returns the first, the last, the second, and so on.
fn inwards<T>(all: &[T]) -> impl Iterator<Item = &T> {
    let half = all.len().div_ceil(2);
    let (front, back) = all.split_at(half);
    let back = back.iter().rev().map(Some).chain([None]);
    front.iter().zip(back).flat_map(|(front, back)| core::iter::once(front).chain(back))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_checked_from_both_ends_inwards() {
        assert_eq!(inwards(&[1, 2, 3, 4, 5]).collect::<Vec<_>>(), [&1, &5, &2, &4, &3]);
        assert_eq!(inwards(&[1, 2]).collect::<Vec<_>>(), [&1, &2]);
        assert_eq!(inwards::<u8>(&[]).count(), 0);
    }
}
