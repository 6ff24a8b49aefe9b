//! Searches unrecorded firings: every state in which the model can be when the time of a line
//! comes.

use super::allowed::window;
use super::names::OutputNumber;
use super::pending::{Pending, Stop};
use super::read::{Recording, What};
use super::rules::Rules;
use super::way::Way;
use cotama_core::net::TransitionId;
use cotama_core::units::Millis;
use std::collections::{HashSet, VecDeque};

/// How often the most states at one instant may be passed in a whole recording.
const MOST_INSTANTS: usize = 50;

/// Tells two ways apart.
type Key = (Vec<u64>, Millis, Millis, Option<usize>, Vec<Pending>);

/// A search through all ways to follow a recording.
pub(super) struct Search<'r> {
    rules: &'r Rules<'r>,
    recording: &'r Recording,
    /// For each output that is recorded: when.
    said: Vec<Vec<u64>>,
    most: usize,
    /// How many more ways may be looked at.
    left: usize,
    cut: bool,
}

impl<'r> Search<'r> {
    pub(super) fn new(rules: &'r Rules<'r>, recording: &'r Recording, most: usize) -> Self {
        let mut said = Vec::new();
        for line in &recording.lines {
            if let What::Output(name) = &line.what
                && let Some(output) = rules.names.output(name)
            {
                if said.len() <= output as usize {
                    said.resize(output as usize + 1, Vec::new());
                }
                said[output as usize].push(line.at.0);
            }
        }
        let left = most.saturating_mul(MOST_INSTANTS);
        Self { rules, recording, said, most, left, cut: false }
    }

    /// Whether a way was left out because there were too many.
    pub(super) fn is_cut(&self) -> bool {
        self.cut
    }

    /// Leaves one of several equal ways, and no more than there may be.
    pub(super) fn limit(&mut self, ways: &mut Vec<Way<'_>>) {
        if ways.len() < 2 {
            return;
        }
        let mut seen = HashSet::new();
        ways.retain(|it| seen.insert(key(it)));
        if ways.len() > self.most {
            ways.truncate(self.most);
            self.cut = true;
        }
    }

    /// All ways when the time of a line has come, with all that may have fired unrecorded; and why
    /// some do not get there.
    pub(super) fn reach<'c>(&mut self, ways: &[Way<'c>], line: usize) -> (Vec<Way<'c>>, Vec<Stop>) {
        let Some(line) = self.recording.lines.get(line) else { return (Vec::new(), Vec::new()) };
        let (mut reached, mut stops) = (Vec::new(), Vec::new());
        let (mut seen, mut there) = (HashSet::new(), HashSet::new());
        let alone = self.rules.hidden.is_empty() && ways.len() == 1;
        let mut work: VecDeque<_> = ways.iter().cloned().collect();
        while let Some(mut way) = work.pop_front() {
            let (rounds, next_round) = (way.counts.rounds, way.next_round);
            let (stop, is_round) = way.stop_before(self.rules, line.at);
            for (id, at) in self.firings(&way, stop) {
                // A round is before anything else of its instant.
                if is_round && at == stop {
                    continue;
                }
                let Some(event) = self.rules.numbered.choice(id) else { continue };
                let (mut other, mut fired) = (way.clone(), Vec::new());
                (other.counts.rounds, other.next_round) = (rounds, next_round);
                other.leave_out_rounds(self.rules, at);
                if other.pass(self.rules, at, None).is_err()
                    || other.game.offer(at, event, &mut fired).is_err()
                {
                    continue;
                }
                other.hear(self.rules, &fired, true);
                if let Err(stop) = other.rest(self.rules, at) {
                    stops.push((at, stop));
                    continue;
                }
                if seen.insert(key(&other)) {
                    if self.left == 0 || seen.len() > self.most {
                        self.cut = true;
                        break;
                    }
                    self.left -= 1;
                    work.push_back(other);
                }
            }
            let passed = way.pass(self.rules, stop, (!is_round).then_some(line));
            if let Err(stop) = passed {
                stops.push((way.game.now(), stop));
                continue;
            }
            if is_round {
                if let Err(stop) = way.round(self.rules, stop) {
                    stops.push((way.game.now(), stop));
                    continue;
                }
                let every = self.rules.round_every.map_or(1, |it| it.0);
                way.next_round = Millis(way.next_round.0.saturating_add(every));
                work.push_front(way);
            } else if alone || there.insert(key(&way)) {
                reached.push(way);
            }
        }
        // The way that came furthest tells most.
        stops.sort_by_key(|it: &(Millis, Stop)| std::cmp::Reverse(it.0));
        (reached, stops.into_iter().map(|it| it.1).collect())
    }

    /// Returns firings that may go unrecorded up to an instant: first at the earliest and at the
    /// latest date.
    fn firings(&self, way: &Way<'_>, stop: Millis) -> Vec<(TransitionId, Millis)> {
        let mut firings = Vec::new();
        let rules = self.rules;
        for &id in &rules.hidden {
            let Some((first, last)) = window(rules.numbered, &*way.game, id) else { continue };
            let timed = rules.numbered.whole().transitions.get(id.0 as usize);
            let timed = timed.is_some_and(|it| it.within.is_some());
            // Without time it does not matter when: only what comes before.
            let first = if timed { first } else { stop };
            let last = last.map_or(stop, |it| it.min(stop));
            if first > last {
                continue;
            }
            if let Some(&output) = rules.says(id).first() {
                let dates = self.dates(output, first.0, last.0);
                firings.extend(dates.into_iter().map(|at| (id, Millis(at))));
            } else {
                // One more than there may be, so that the search finds that they are too many.
                let most = (self.most as u64).saturating_add(1);
                let end = first.0.saturating_add(most).min(last.0);
                firings.push((id, last));
                firings.extend((first.0..=end).map(|at| (id, Millis(at))));
            }
        }
        firings
    }

    /// The dates within which an output, once said, is recorded in time.
    fn dates(&self, output: OutputNumber, first: u64, last: u64) -> Vec<u64> {
        let said = self.said.get(output as usize).map_or(&[][..], Vec::as_slice);
        let from = said.partition_point(|&it| it < first);
        let mut dates = Vec::new();
        for &it in said.get(from..).unwrap_or(&[]) {
            let begin = it.saturating_sub(self.rules.tolerance).max(first);
            if begin > last {
                break;
            }
            let begin = dates.last().map_or(begin, |&before: &u64| begin.max(before + 1));
            dates.extend(begin..=it.min(last));
        }
        dates
    }
}

fn key(way: &Way<'_>) -> Key {
    let pending = way.pending.iter().copied().collect();
    (way.game.state(), way.game.now(), way.next_round, way.untold, pending)
}
