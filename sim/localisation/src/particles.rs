//! Particles: poses with weights, each coordinate in an array of its own.

use crate::angle::sincos;

/// Poses on a map, in metres from its left lower corner and radians, with weights that add up to 1.
///
/// Invariant: all arrays are of the same length, and headings are from -π to π.
#[derive(Clone, Debug, Default)]
pub(crate) struct Particles {
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    pub(crate) heading: Vec<f32>,
    pub(crate) cos: Vec<f32>,
    pub(crate) sin: Vec<f32>,
    pub(crate) weight: Vec<f64>,
}

impl Particles {
    /// None, with room for so many.
    pub(crate) fn with_capacity(most: usize) -> Self {
        let floats = || Vec::with_capacity(most);
        Self {
            x: floats(),
            y: floats(),
            heading: floats(),
            cos: floats(),
            sin: floats(),
            weight: Vec::with_capacity(most),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.weight.len()
    }

    /// Number of poses that were added.
    pub(crate) fn added(&self) -> usize {
        self.x.len()
    }

    pub(crate) fn clear(&mut self) {
        let Self { x, y, heading, cos, sin, weight } = self;
        for it in [x, y, heading, cos, sin] {
            it.clear();
        }
        weight.clear();
    }

    #[cfg(test)]
    pub(crate) fn capacity(&self) -> Vec<usize> {
        let Self { x, y, heading, cos, sin, weight } = self;
        let floats = [x, y, heading, cos, sin].map(Vec::capacity);
        [&floats[..], &[weight.capacity()]].concat()
    }

    /// Adds a pose; when all are there they are [`settle`](Self::settle)d.
    pub(crate) fn push(&mut self, [x, y, heading]: [f32; 3]) {
        self.x.push(x);
        self.y.push(y);
        self.heading.push(heading);
    }

    /// Adds the poses of another set's particles of these numbers.
    pub(crate) fn gather(&mut self, from: &Self, numbers: &[u32]) {
        let all =
            [(&mut self.x, &from.x), (&mut self.y, &from.y), (&mut self.heading, &from.heading)];
        for (to, from) in all {
            to.extend(numbers.iter().map(|it| from.get(*it as usize).copied().unwrap_or(0.0)));
        }
    }

    /// Gives poses that were added their directions, and all the same weight.
    pub(crate) fn settle(&mut self) {
        let count = self.x.len();
        self.cos.resize(count, 1.0);
        self.sin.resize(count, 0.0);
        for ((cos, sin), heading) in self.cos.iter_mut().zip(&mut self.sin).zip(&self.heading) {
            (*sin, *cos) = sincos(*heading);
        }
        self.weight.resize(count, 0.0);
        self.even();
    }

    fn even(&mut self) {
        let each = 1.0 / self.len().max(1) as f64;
        self.weight.fill(each);
    }

    /// Makes the weights add up to 1; all alike if none is left.
    pub(crate) fn normalise(&mut self) {
        let sum: f64 = self.weight.iter().sum();
        if sum > 0.0 && sum.is_finite() {
            let scale = 1.0 / sum;
            self.weight.iter_mut().for_each(|it| *it *= scale);
        } else {
            self.even();
        }
    }

    /// Returns the effective number, 1 / Σ w² (Liu, "Metropolized independent sampling", Statistics
    /// and Computing 6, 1996).
    pub(crate) fn effective(&self) -> f64 {
        1.0 / self.weight.iter().map(|it| it * it).sum::<f64>()
    }
}
