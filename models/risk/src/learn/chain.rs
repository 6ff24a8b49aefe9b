//! A chain over graphs: Markov chain Monte Carlo.

use super::constraints::Constraints;
use super::score::Families;
use super::search::neighbours;
use crate::dag::Dag;
use cotama_streams::Streams;

/// A finished chain.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// The best graph seen; its topological order is the order that the thesis gives to K2.
    pub best: Dag,
    /// The score.
    pub score: f64,
    /// Steps that were accepted.
    pub accepted: u64,
    /// Steps that were refused.
    pub refused: u64,
}

impl Chain {
    /// Accepted over refused steps, as the thesis counts them; none where none was refused.
    pub fn acceptance(&self) -> Option<f64> {
        (self.refused > 0).then(|| self.accepted as f64 / self.refused as f64)
    }
}

/// Walks over graphs (Madigan and York, Int. Stat. Rev. 63, 1995; the thesis, section 4.4): a
/// neighbour, one arc away, is proposed with equal chance, and accepted with the chance
/// `min(1, exp(score' - score) nb / nb')`, in which `nb` counts the neighbours. The score stands
/// for the logarithm of the marginal likelihood. Proves nothing about its best graph.
pub fn chain(
    families: &mut Families<'_>,
    constraints: &Constraints,
    steps: u64,
    seed: u64,
) -> Chain {
    let mut stream = Streams::new(seed).stream("chain");
    let mut now = constraints.least();
    let mut score = families.of(&now);
    let mut chain = Chain { best: now.clone(), score, accepted: 0, refused: 0 };
    let mut around = neighbours(&now, constraints);
    for _ in 0..steps {
        let Some(change) = around.get(stream.below(around.len() as u64) as usize) else { break };
        let gain = change.gain(&now, families);
        let mut next = now.clone();
        change.make(&mut next);
        let beyond = neighbours(&next, constraints);
        let ratio = libm::log(around.len() as f64 / beyond.len() as f64);
        if stream.part() >= libm::exp(gain + ratio) {
            chain.refused += 1;
            continue;
        }
        chain.accepted += 1;
        score += gain;
        (now, around) = (next, beyond);
        if score > chain.score + super::search::GAIN {
            (chain.best, chain.score) = (now.clone(), score);
        }
    }
    chain.score = families.of(&chain.best);
    chain
}
