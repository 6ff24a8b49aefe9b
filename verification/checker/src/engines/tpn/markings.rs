//! Markings, numbered, with what they enable and where firings lead.

use super::bound::Bound;
use super::index::{Index, hash, room, taken};
use cotama_property::pt::{Lists, Pt};
use cotama_property::time::TimeNet;

/// A net as class graphs are built from.
#[derive(Debug)]
pub(super) struct Rules {
    /// Needs, and what firings change.
    pub(super) pt: Pt,
    take: Lists<u32>,
    /// For each transition the bounds of its negated clock and of its clock.
    pub(super) intervals: Vec<(Bound, Bound)>,
}

impl Rules {
    pub(super) fn new(net: &TimeNet) -> Self {
        let take =
            net.transitions().iter().map(|it| it.take.iter().map(|arc| (arc.place.0, arc.weight)));
        let intervals = net
            .transitions()
            .iter()
            .map(|it| (Bound::lower(it.interval), Bound::upper(it.interval)));
        Self { pt: net.untimed(), take: Lists::new(take), intervals: intervals.collect() }
    }

    /// The intermediate marking of a firing: what is taken is gone, what is given is not there yet.
    pub(super) fn between(&self, marking: &[u32], transition: u32) -> Vec<u32> {
        let mut between = marking.to_vec();
        for &(place, weight) in self.take.of(transition) {
            between[place as usize] -= weight;
        }
        between
    }
}

/// In a marking, the firing of one of the transitions that it enables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// The marking after it.
    pub(super) target: u32,
    /// Start of its list of kept clocks.
    kept: u32,
}

/// In [`Markings::kept`]: the clock of this transition starts anew.
pub(super) const ANEW: u32 = u32::MAX;
const UNKNOWN: Step = Step { target: u32::MAX, kept: 0 };

/// All markings that were met so far.
#[derive(Debug)]
pub(super) struct Markings {
    width: usize,
    tokens: Vec<u32>,
    index: Index,
    /// Start of the enabled transitions of each marking, and the end of the last ones.
    starts: Vec<usize>,
    enabled: Vec<u32>,
    /// For each enabled transition of each marking its firing, once it was asked for.
    steps: Vec<Step>,
    kept: Vec<u32>,
}

impl Markings {
    pub(super) fn new(rules: &Rules) -> Self {
        let mut markings = Self {
            width: rules.pt.initial.len(),
            tokens: Vec::new(),
            index: Index::new(),
            starts: vec![0],
            enabled: Vec::new(),
            steps: Vec::new(),
            kept: Vec::new(),
        };
        markings.number(rules, &rules.pt.initial);
        markings
    }

    fn number(&mut self, rules: &Rules, marking: &[u32]) -> u32 {
        let next = self.len() as u32;
        let Self { width, tokens, .. } = self;
        let is = |number: u32| tokens[number as usize * *width..][..*width] == *marking;
        if let Some(number) =
            self.index.find_or_insert(hash(marking.iter().map(|&it| it.into())), next, is)
        {
            return number;
        }
        room(tokens, marking.len());
        self.tokens.extend(marking);
        let all = 0..rules.pt.transitions.len() as u32;
        room(&mut self.enabled, rules.pt.transitions.len());
        self.enabled.extend(all.filter(|&transition| rules.pt.enabled(marking, transition)));
        let more = self.enabled.len() - self.steps.len();
        room(&mut self.steps, more);
        self.steps.resize(self.enabled.len(), UNKNOWN);
        room(&mut self.starts, 1);
        self.starts.push(self.enabled.len());
        next
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// The tokens of one.
    pub(super) fn tokens(&self, marking: u32) -> &[u32] {
        &self.tokens[marking as usize * self.width..][..self.width]
    }

    /// The transitions that it enables, in their order.
    pub(super) fn enabled(&self, marking: u32) -> &[u32] {
        &self.enabled[self.starts[marking as usize]..self.starts[marking as usize + 1]]
    }

    /// The firing of an enabled transition, named by its position in the list; `None` when a place
    /// would hold too much.
    #[inline]
    pub(super) fn step(&mut self, rules: &Rules, marking: u32, position: usize) -> Option<Step> {
        let at = self.starts[marking as usize] + position;
        let known = self.steps[at];
        if known.target == UNKNOWN.target { self.new_step(rules, marking, at) } else { Some(known) }
    }

    /// The position of a transition among the enabled ones of a marking, and its firing if it was
    /// asked for before.
    pub(super) fn known_step(&self, marking: u32, transition: u32) -> Option<(usize, Step)> {
        let position = self.enabled(marking).binary_search(&transition).ok()?;
        let step = self.steps[self.starts[marking as usize] + position];
        (step.target != UNKNOWN.target).then_some((position, step))
    }

    fn new_step(&mut self, rules: &Rules, marking: u32, at: usize) -> Option<Step> {
        let fired = self.enabled[at];
        let between = rules.between(self.tokens(marking), fired);
        let after = rules.pt.fire(self.tokens(marking), fired)?;
        let target = self.number(rules, &after);
        let step = Step { target, kept: u32::try_from(self.kept.len()).ok()? };
        let enabled = self.starts[target as usize]..self.starts[target as usize + 1];
        room(&mut self.kept, enabled.len());
        for next in enabled {
            let transition = self.enabled[next];
            // Whatever is enabled in the intermediate marking was enabled before.
            let keeps = transition != fired && rules.pt.enabled(&between, transition);
            let before = self.enabled(marking).binary_search(&transition);
            self.kept.push(before.ok().filter(|_| keeps).map_or(ANEW, |before| before as u32));
        }
        self.steps[at] = step;
        Some(step)
    }

    /// For each transition that is enabled after a firing, its position in the list of those that
    /// were before, if its clock goes on, or [`ANEW`].
    #[inline]
    pub(super) fn kept(&self, step: Step) -> &[u32] {
        let length = self.starts[step.target as usize + 1] - self.starts[step.target as usize];
        &self.kept[step.kept as usize..][..length]
    }

    pub(super) fn bytes(&self) -> usize {
        let words = taken(&self.tokens) + taken(&self.enabled) + taken(&self.kept);
        words + taken(&self.starts) + taken(&self.steps) + self.index.bytes()
    }
}
