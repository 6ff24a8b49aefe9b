//! Facts about all runs of a tree.

use super::cycles::{Circle, Marks};
use super::graph::{End, What};
use super::runs::Run;
use super::unwritten::Unwritten;
use super::{Seen, Space};
use crate::machine::{Event, How, Reply, Vain};
use crate::supervisor::Part;
use crate::tree::Answer;
use std::collections::BTreeMap;

/// Two nodes, and the fewest ticks until they meet.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Pair {
    /// Nodes.
    pub nodes: (usize, usize),
    /// Ticks.
    pub ticks: u32,
    pub(crate) seen: (u32, u32),
}

/// An event that a leaf offers to the supervisor in vain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InVain {
    /// The leaf, its event, and the state of the supervisor in a run with the fewest ticks.
    pub vain: Vain,
    /// Ticks.
    pub ticks: u32,
    pub(crate) seen: (u32, u32),
}

/// A leaf that reads an entry before it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Early {
    /// The leaf.
    pub node: usize,
    /// The entry.
    pub entry: String,
    /// Ticks.
    pub ticks: u32,
    pub(crate) path: Vec<usize>,
}

/// Facts about all runs of a tree.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// States between ticks.
    pub states: usize,
    /// Questions within ticks.
    pub questions: usize,
    /// Edges of the graph.
    pub edges: usize,
    /// The ends of a run, and the fewest ticks.
    pub ends: BTreeMap<End, u32>,
    /// States from which no end can be reached; 0 where not all was explored.
    pub stuck: usize,
    /// Whether a fair run never ends.
    pub forever: bool,
    /// Actions that a fair run starts again and again without an end.
    pub restarted: Vec<usize>,
    /// Whether a `tickOnce` may not return.
    pub spins: bool,
    /// Two actions that run at the end of a tick.
    pub both_running: Vec<Pair>,
    /// An action that starts, and one that still runs.
    pub started_while_running: Vec<Pair>,
    /// Leaves whose event the supervisor ignored, when they start or are halted: the state of the
    /// supervisor, and how it comes about.
    pub refused: Vec<InVain>,
    /// A child, and the control node that fails upon its SUCCESS.
    pub success_lost: Vec<Pair>,
    /// Nodes that are never ticked.
    pub never_ticked: Vec<usize>,
    /// Nodes that are ticked and never answer SUCCESS.
    pub never_success: Vec<usize>,
    /// Nodes that are ticked and never answer FAILURE.
    pub never_failure: Vec<usize>,
    /// Leaves that read what was not written.
    pub read_before_written: Vec<Early>,
    pub(crate) stuck_at: Option<u32>,
    pub(crate) forever_at: Option<Circle>,
    pub(crate) restarted_at: Vec<Circle>,
    pub(crate) spins_at: Option<Circle>,
}

/// Returns whether a word of an edge is an end of this leaf.
fn ends(event: Event, node: usize) -> bool {
    match event {
        Event::Asked(at, How::Starts | How::Goes, Reply::Leaf(answer)) => {
            at as usize == node && answer.is_done()
        }
        Event::Itself(at, answer) => at as usize == node && answer.is_done(),
        _ => false,
    }
}

fn begins(event: Event, node: usize) -> bool {
    event == Event::Asked(node as u32, How::Starts, Reply::Leaf(Answer::Running))
        || event == Event::Offered(node as u32, Part::Starts, true)
}

impl Space<'_> {
    /// Returns all facts; entries of `given` are written before the first tick.
    pub fn facts(&mut self, given: &[String]) -> Facts {
        let tree = self.tree;
        let (states, questions, edges) = self.size();
        let mut facts = Facts { states, questions, edges, ..Facts::default() };
        for point in 0..self.len() {
            if let What::End(end) = self.what(point) {
                let ticks = facts.ends.entry(end).or_insert(u32::MAX);
                *ticks = self.level[point].min(*ticks);
            }
        }
        let can = self.can_end();
        // A state that was not gone on from may reach an end.
        let known = self.is_complete();
        let stuck = (0..self.len()).filter(|it| known && self.is_state(*it) && !can[*it]);
        let mut stuck: Vec<_> = stuck.map(|it| it as u32).collect();
        facts.stuck = stuck.len();
        stuck.sort_by_key(|it| self.level[*it as usize]);
        facts.stuck_at = stuck.first().copied();
        self.endless(&mut facts);
        let pairs = |map: &BTreeMap<(usize, usize), Seen>| {
            let all = map.iter().map(|(nodes, seen)| Pair {
                nodes: *nodes,
                ticks: seen.ticks,
                seen: (seen.node, seen.edge),
            });
            all.collect::<Vec<_>>()
        };
        facts.both_running = pairs(&self.both);
        facts.started_while_running = pairs(&self.overlap);
        facts.success_lost = pairs(&self.lost);
        let vain = self.refused.values().map(|&(vain, seen)| InVain {
            vain,
            ticks: seen.ticks,
            seen: (seen.node, seen.edge),
        });
        facts.refused = vain.collect();
        let said = self.said().to_vec();
        let has = |node: usize, answer: Answer| said[node] >> answer as u8 & 1 == 1;
        let all = 0..tree.nodes.len();
        facts.never_ticked = all.clone().filter(|it| said[*it] == 0).collect();
        let ticked = all.filter(|it| said[*it] != 0);
        facts.never_success = ticked.clone().filter(|it| !has(*it, Answer::Success)).collect();
        facts.never_failure = ticked.filter(|it| !has(*it, Answer::Failure)).collect();
        let early = self.unwritten(given).into_iter();
        let early = early.map(|it| {
            let Unwritten { node, entry, ticks, path } = it;
            Early { node, entry: entry.1, ticks, path }
        });
        facts.read_before_written = early.collect();
        facts
    }

    fn endless(&mut self, facts: &mut Facts) {
        let all: Vec<u32> = (0..self.len() as u32).collect();
        let mut marks = Marks::new(self.len());
        let circles = self.components(&all, &|_, _| true, &mut marks);
        for circle in &circles {
            facts.forever_at = self.fair(circle, &|_, _| true, None, &mut marks);
            if facts.forever_at.is_some() {
                break;
            }
        }
        facts.forever = facts.forever_at.is_some();
        let tree = self.tree;
        for node in (0..tree.nodes.len()).filter(|it| tree.nodes[*it].is_action()) {
            let without =
                |space: &Space, edge: usize| !space.events(edge).iter().any(|it| ends(*it, node));
            let began =
                |space: &Space, edge: usize| space.events(edge).iter().any(|it| begins(*it, node));
            let found = circles.iter().find_map(|circle| {
                if !circle.edges.iter().any(|it| began(self, it.1 as usize)) {
                    return None;
                }
                let parts = self.components(&circle.points, &without, &mut marks);
                parts.iter().find_map(|it| self.fair(it, &without, Some(&began), &mut marks))
            });
            if let Some(circle) = found {
                facts.restarted.push(node);
                facts.restarted_at.push(circle);
            }
        }
        let wakes = |space: &Space, edge: usize| {
            let it = space.edges[edge];
            !space.is_state(it.target as usize) || it.wakes()
        };
        facts.spins_at = circles.iter().find_map(|circle| {
            let parts = self.components(&circle.points, &wakes, &mut marks);
            parts.into_iter().find(|it| it.points.iter().any(|at| self.is_state(*at as usize)))
        });
        facts.spins = facts.spins_at.is_some();
    }

    /// Returns a run with the fewest ticks that shows a pair.
    pub fn run_of(&self, pair: &Pair) -> Run {
        self.run_to(pair.seen.0 as usize, pair.seen.1 as usize)
    }

    /// Returns a run with the fewest ticks in which the supervisor ignores a leaf's event.
    pub fn run_of_in_vain(&self, it: &InVain) -> Run {
        self.run_to(it.seen.0 as usize, it.seen.1 as usize)
    }

    /// Returns a run with the fewest ticks that reads what was not written.
    pub fn run_of_early(&self, early: &Early) -> Run {
        self.run_along(&early.path)
    }

    /// Returns a run with the fewest ticks to an end.
    pub fn run_to_end(&self, end: End) -> Option<Run> {
        let points = (0..self.len()).filter(|it| self.what(*it) == What::End(end));
        points.min_by_key(|it| self.level[*it]).map(|it| self.run_at(it))
    }

    /// Returns a run to a circle and once around it.
    pub(crate) fn run_around(&self, circle: &Circle) -> Run {
        let walk = self.walk(circle);
        let Some(&first) = walk.first() else { return Run::default() };
        let start = circle.edges.iter().find(|it| it.1 as usize == first).map_or(0, |it| it.0);
        let mut run = self.run_at(start as usize);
        let from = run.steps.len();
        run.steps.extend(self.run_along(&walk).steps);
        run.again_from = Some(from);
        run
    }

    /// Returns the runs of what has no pair: stuck, never ending, restarted, spinning.
    pub fn run_of_stuck(&self, facts: &Facts) -> Option<Run> {
        facts.stuck_at.map(|it| self.run_at(it as usize))
    }

    /// Returns a fair run that never ends.
    pub fn run_forever(&self, facts: &Facts) -> Option<Run> {
        facts.forever_at.as_ref().map(|it| self.run_around(it))
    }

    /// Returns a run in which the n-th action restarted for ever is so.
    pub fn run_restarted(&self, facts: &Facts, at: usize) -> Option<Run> {
        facts.restarted_at.get(at).map(|it| self.run_around(it))
    }

    /// Returns a run in which `tickOnce` does not return.
    pub fn run_spinning(&self, facts: &Facts) -> Option<Run> {
        facts.spins_at.as_ref().map(|it| self.run_around(it))
    }
}
