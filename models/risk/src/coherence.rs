//! Coherence of two variables: mutual information over joint entropy.

use crate::infer::{NoAnswer, Plan, Scratch};
use crate::network::Network;

/// Two variables, and how strongly they hang together in a network.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coherence {
    /// The first variable.
    pub x: usize,
    /// The second variable, behind the first.
    pub y: usize,
    /// Mutual information in nats (Rohrmueller 2011, eq. 4.7).
    pub information: f64,
    /// Joint entropy in nats (eq. 4.8).
    pub entropy: f64,
    /// Information over entropy (eq. 4.9): 0 if and only if the two are independent, 1 if and only
    /// if each fixes the other; 0 where both are constant. `1 - eta` is a metric (Rajski, Inf.
    /// Control 4, 1961), `eta` itself is not.
    pub eta: f64,
}

impl Coherence {
    /// The same of a joint distribution, in which `columns` states of the second variable follow
    /// each other for each state of the first.
    fn of(x: usize, y: usize, joint: &[f64], columns: usize) -> Self {
        let rows: Vec<f64> = joint.chunks(columns).map(|it| it.iter().sum()).collect();
        let sums = |at: usize| joint.iter().skip(at).step_by(columns).sum::<f64>();
        let sums: Vec<f64> = (0..columns).map(sums).collect();
        let (mut information, mut entropy) = (0.0, 0.0);
        for (row, own) in joint.chunks(columns).zip(&rows) {
            for (cell, sum) in row.iter().zip(&sums).filter(|it| *it.0 > 0.0) {
                information += cell * libm::log(cell / (own * sum));
                entropy -= cell * libm::log(*cell);
            }
        }
        let information = if information > 0.0 { information } else { 0.0 };
        let eta = if entropy > 0.0 { information / entropy } else { 0.0 };
        Self { x, y, information, entropy, eta }
    }
}

/// The most variables of a network whose pairs are all looked at.
const MOST: usize = 256;

/// The coherence of all pairs of variables, from the marginals of the network.
///
/// # Errors
/// [`NoAnswer::TooLarge`] of a network with more than 256 variables, or too wide a one.
pub fn coherence(net: &Network) -> Result<Vec<Coherence>, NoAnswer> {
    let (mut all, mut scratch, mut joint) = (Vec::new(), Scratch::default(), Vec::new());
    if net.nodes().len() > MOST {
        return Err(NoAnswer::TooLarge);
    }
    for x in 0..net.nodes().len() {
        for y in x + 1..net.nodes().len() {
            Plan::new(net, &[x, y], &[])?.answer_in(net, &[], &mut scratch, &mut joint)?;
            all.push(Coherence::of(x, y, &joint, net.states(y)));
        }
    }
    Ok(all)
}
