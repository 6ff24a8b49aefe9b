//! A trail while it is written.

use super::supply::Supply;
use super::trail::{Layer, Step, Tokens, Trail};
use cotama_core::net::PlaceId;

/// A trail while it is written.
#[derive(Clone, Debug)]
pub(super) struct Record {
    layers: Vec<Layer>,
    top: Layer,
    /// `tokens of place = these`, from when it was written on.
    values: Vec<(u32, Tokens)>,
}

impl Record {
    pub(super) fn new(transitions: usize) -> Self {
        Self { layers: Vec::new(), top: Layer::new(transitions, None), values: Vec::new() }
    }

    /// A step that stands for one after another, each so many times.
    pub(super) fn step(&mut self, first: (u32, u32), second: (u32, u32)) -> u32 {
        self.top.steps.push(Step::Steps([first, second]));
        self.top.steps.len() as u32 - 1
    }

    pub(super) fn at_start(&mut self, step: u32, times: u32) {
        self.top.start.push((step, times));
    }

    pub(super) fn at_rest(&mut self, steps: Vec<u32>) {
        self.top.rests.push(steps);
    }

    pub(super) fn value(&mut self, place: u32, constant: i64, weights: &[(u32, i64)]) {
        let weights = weights.iter().map(|&(place, weight)| (PlaceId(place), weight)).collect();
        self.values.push((place, Tokens { constant, weights }));
    }

    /// How a transition is called that stands for these.
    fn name(&self, step: u32, below: &[String]) -> String {
        let (mut names, mut stack) = (Vec::new(), vec![step]);
        while let Some(step) = stack.pop() {
            match &self.top.steps[step as usize] {
                _ if names.len() == 8 => return names.join(".") + "...",
                Step::Below(transition) => names.push(below[*transition as usize].as_str()),
                Step::Steps([first, second]) => stack.extend([second.0, first.0]),
            }
        }
        names.join(".")
    }

    /// The names of the transitions of a draft, of which `below` are those of the layer below.
    pub(super) fn names(&self, roots: &[u32], below: &[String]) -> Vec<String> {
        roots.iter().map(|&step| self.name(step, below)).collect()
    }

    /// Begins a new layer, above one with these transitions that is supplied.
    pub(super) fn supplied(&mut self, roots: Vec<u32>, supply: Supply) {
        let top = std::mem::replace(&mut self.top, Layer::new(roots.len(), Some(supply)));
        self.layers.push(Layer { roots, ..top });
    }

    /// The trail, of which these are the transitions at the top and the places that are left.
    pub(super) fn trail(mut self, roots: Vec<u32>, values: Vec<Option<Tokens>>) -> Trail {
        self.layers.push(Layer { roots, ..self.top });
        let mut trail = Trail { layers: self.layers, values };
        for (place, value) in self.values.iter().rev() {
            trail.values[*place as usize] = trail.tokens(value);
        }
        trail
    }
}
