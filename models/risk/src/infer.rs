//! Posteriors by variable elimination (Zhang and Poole, JAIR 5, 1996): the order is fixed once for
//! a query, least table first, and variables that are no ancestors of what is asked are left out.

use crate::network::{MAX_CELLS, Network};
use std::fmt;

/// Reasons for which a query has no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoAnswer {
    /// The evidence has probability 0 in this network.
    Impossible,
    /// A table on the way would have more than [`MAX_CELLS`] cells, or there are too many pairs.
    TooLarge,
    /// A variable stands twice in the query or in its evidence, or is not there.
    Malformed,
}

impl fmt::Display for NoAnswer {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Impossible => write!(to, "the evidence has probability 0 in this network"),
            Self::TooLarge => {
                write!(
                    to,
                    "too large: a table passes {MAX_CELLS} cells, or there are too many pairs"
                )
            }
            Self::Malformed => write!(to, "a variable stands twice, or is not in the network"),
        }
    }
}

impl std::error::Error for NoAnswer {}

/// A distribution given evidence.
#[derive(Clone, Debug, PartialEq)]
pub struct Posterior {
    /// The probability of the evidence; 1 without any.
    pub probability_of_evidence: f64,
    /// Probabilities of the states; of several variables those of their combinations, the last
    /// variable fastest.
    pub posterior: Vec<f64>,
}

/// A table that a step multiplies, and how its cells are found.
#[derive(Clone, Debug)]
pub(crate) struct Operand {
    /// A node of the network, or behind these the result of a step.
    pub(crate) source: usize,
    /// For each variable of the step's result the distance of its states.
    pub(crate) strides: Vec<usize>,
    /// The distance of the states of the variable that is summed out.
    pub(crate) inner: usize,
    /// Evidence, by its number, and the distance of its states.
    pub(crate) fixed: Vec<(usize, usize)>,
}

/// Tables multiplied, and a variable summed out.
#[derive(Clone, Debug)]
pub(crate) struct Step {
    pub(crate) operands: Vec<Operand>,
    /// States of the variables of the result, the last fastest.
    pub(crate) shape: Vec<usize>,
    pub(crate) size: usize,
    /// States of the variable that is summed out; 1 in the last step, which sums none.
    pub(crate) summed: usize,
}

/// A query prepared: it is answered for any states of its evidence.
///
/// ```
/// use cotama_risk::{Network, Plan};
/// let text = "network door { }
///     variable open { type discrete [ 2 ] { yes, no }; }
///     variable seen { type discrete [ 2 ] { yes, no }; }
///     probability ( open ) { table 0.25, 0.75; }
///     probability ( seen | open ) { (yes) 0.9, 0.1; (no) 0.2, 0.8; }";
/// let (net, _) = Network::from_bif(text).unwrap();
/// let (open, seen) = (net.variable("open").unwrap(), net.variable("seen").unwrap());
/// let plan = Plan::new(&net, &[open], &[seen]).unwrap();
/// let answer = plan.answer(&net, &[0]).unwrap(); // seen is `yes`
/// assert!((answer.probability_of_evidence - 0.375).abs() < 1e-15);
/// assert!((answer.posterior[0] - 0.6).abs() < 1e-15);
/// ```
#[derive(Clone, Debug)]
pub struct Plan {
    pub(crate) steps: Vec<Step>,
    /// States of the variables that are evidence.
    pub(crate) evidence: Vec<usize>,
    pub(crate) nodes: usize,
}

/// Memory that answers use again.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    results: Vec<Vec<f64>>,
    offsets: Vec<usize>,
    digits: Vec<usize>,
}

/// Results below this are multiplied by [`RAISE`]: they would get lost by and by.
const LOW: f64 = 1e-150;
const RAISE: f64 = 1e150;

/// A table while the order is looked for: its source, and the variables it is about.
struct Open {
    source: usize,
    scope: Vec<usize>,
}

impl Plan {
    /// Prepares the query for the joint distribution of these variables, given others.
    ///
    /// # Errors
    /// [`NoAnswer::TooLarge`] and [`NoAnswer::Malformed`].
    pub fn new(net: &Network, query: &[usize], evidence: &[usize]) -> Result<Self, NoAnswer> {
        let nodes = net.nodes().len();
        let all: Vec<usize> = query.iter().chain(evidence).copied().collect();
        let twice = all.iter().enumerate().any(|(at, it)| all[..at].contains(it) || *it >= nodes);
        if query.is_empty() || twice {
            return Err(NoAnswer::Malformed);
        }
        let mut maker = Maker::new(net, &all, evidence);
        let mut left: Vec<usize> = maker.hidden(query);
        while let Some((at, scope)) = maker.cheapest(&left) {
            maker.step(&scope, Some(left.remove(at)))?;
        }
        maker.step(query, None)?;
        let evidence = evidence.iter().map(|it| net.states(*it)).collect();
        Ok(Self { steps: maker.steps, evidence, nodes })
    }

    /// Answers for these states of the evidence, in the order in which it was named.
    ///
    /// # Errors
    /// [`NoAnswer::Impossible`]; [`NoAnswer::Malformed`] for another number of states than there is
    /// evidence, a state that is none, or another network.
    pub fn answer(&self, net: &Network, states: &[usize]) -> Result<Posterior, NoAnswer> {
        let mut scratch = Scratch::default();
        let mut posterior = Vec::new();
        let probability_of_evidence = self.answer_in(net, states, &mut scratch, &mut posterior)?;
        Ok(Posterior { probability_of_evidence, posterior })
    }

    /// Answers as [`Self::answer`] in memory that is there already: fills `posterior`, returns the
    /// probability of the evidence.
    ///
    /// # Errors
    /// As those of [`Self::answer`].
    pub fn answer_in(
        &self,
        net: &Network,
        states: &[usize],
        scratch: &mut Scratch,
        posterior: &mut Vec<f64>,
    ) -> Result<f64, NoAnswer> {
        let is_state = |(state, states): (&usize, &usize)| state < states;
        let fits = net.nodes().len() == self.nodes && states.len() == self.evidence.len();
        if !fits || !states.iter().zip(&self.evidence).all(is_state) {
            return Err(NoAnswer::Malformed);
        }
        scratch.results.resize_with(self.steps.len(), Vec::new);
        let mut raised = 0;
        for (number, step) in self.steps.iter().enumerate() {
            let (done, rest) = scratch.results.split_at_mut(number);
            let Some(result) = rest.first_mut() else { break };
            result.clear();
            let table = |it: usize| match it.checked_sub(self.nodes) {
                None => net.nodes()[it].table.as_slice(),
                Some(result) => done[result].as_slice(),
            };
            step.run(states, table, result, &mut scratch.offsets, &mut scratch.digits);
            let largest =
                result.iter().fold(0.0, |most: f64, it| if *it > most { *it } else { most });
            if largest > 0.0 && largest < LOW {
                result.iter_mut().for_each(|it| *it *= RAISE);
                raised += 1;
            }
        }
        posterior.clear();
        posterior.extend_from_slice(scratch.results.last().map_or(&[], Vec::as_slice));
        let sum: f64 = posterior.iter().sum();
        if sum <= 0.0 {
            return Err(NoAnswer::Impossible);
        }
        posterior.iter_mut().for_each(|it| *it /= sum);
        Ok((0..raised).fold(sum, |sum, _| sum / RAISE))
    }

    /// Cells of the largest table on the way.
    pub fn largest(&self) -> usize {
        self.steps.iter().map(|it| it.size).max().unwrap_or(0)
    }
}

impl Step {
    fn run<'t>(
        &self,
        states: &[usize],
        table: impl Fn(usize) -> &'t [f64],
        result: &mut Vec<f64>,
        offsets: &mut Vec<usize>,
        digits: &mut Vec<usize>,
    ) {
        offsets.clear();
        let fixed =
            |it: &Operand| it.fixed.iter().map(|(at, far)| states[*at] * far).sum::<usize>();
        offsets.extend(self.operands.iter().map(fixed));
        digits.clear();
        digits.resize(self.shape.len(), 0);
        for _ in 0..self.size {
            let mut sum = 0.0;
            for state in 0..self.summed {
                let mut product = 1.0;
                for (operand, offset) in self.operands.iter().zip(offsets.iter()) {
                    product *= table(operand.source)[offset + state * operand.inner];
                }
                sum += product;
            }
            result.push(sum);
            // The last digit runs fastest, as on a clock.
            for (place, digit) in digits.iter_mut().enumerate().rev() {
                *digit += 1;
                let back = (*digit == self.shape[place]).then_some(*digit - 1);
                for (operand, offset) in self.operands.iter().zip(offsets.iter_mut()) {
                    match back {
                        None => *offset += operand.strides[place],
                        Some(steps) => *offset -= steps * operand.strides[place],
                    }
                }
                if back.is_none() {
                    break;
                }
                *digit = 0;
            }
        }
    }
}

struct Maker<'n> {
    net: &'n Network,
    /// The number of each variable in the evidence.
    given: Vec<Option<usize>>,
    open: Vec<Open>,
    /// Variables of the result of each step.
    scopes: Vec<Vec<usize>>,
    steps: Vec<Step>,
    /// Variables that were counted, by the number of the count.
    marks: Vec<usize>,
    mark: usize,
}

impl<'n> Maker<'n> {
    fn new(net: &'n Network, asked: &[usize], evidence: &[usize]) -> Self {
        let mut given = vec![None; net.nodes().len()];
        evidence.iter().enumerate().for_each(|(at, it)| given[*it] = Some(at));
        let (mut is_needed, mut stack) = (vec![false; net.nodes().len()], asked.to_vec());
        while let Some(next) = stack.pop() {
            if !is_needed[next] {
                is_needed[next] = true;
                stack.extend(&net.nodes()[next].parents);
            }
        }
        let scope = |at: usize| {
            let own = net.nodes()[at].parents.iter().chain([&at]).copied();
            Open { source: at, scope: own.filter(|it| given[*it].is_none()).collect() }
        };
        let needed = (0..is_needed.len()).filter(|it| is_needed[*it]);
        let open: Vec<Open> = needed.map(scope).collect();
        let (steps, marks) = (Vec::with_capacity(open.len()), vec![0; net.nodes().len()]);
        Self { net, given, scopes: Vec::with_capacity(open.len()), open, steps, marks, mark: 0 }
    }

    /// Variables to sum out, rising.
    fn hidden(&self, query: &[usize]) -> Vec<usize> {
        // Each variable has a table of its own.
        let own = self.open.iter().map(|it| it.source);
        own.filter(|it| self.given[*it].is_none() && !query.contains(it)).collect()
    }

    /// The place in `left` of the variable whose sum leaves the smallest table, and its variables.
    fn cheapest(&mut self, left: &[usize]) -> Option<(usize, Vec<usize>)> {
        let mut best: Option<(f64, usize)> = None;
        for (at, variable) in left.iter().enumerate() {
            self.mark += 1;
            let mut size = 1.0;
            for open in self.open.iter().filter(|it| it.scope.contains(variable)) {
                for it in open.scope.iter().filter(|it| *it != variable) {
                    if self.marks[*it] != self.mark {
                        self.marks[*it] = self.mark;
                        size *= self.net.states(*it) as f64;
                    }
                }
            }
            if best.is_none_or(|it| size < it.0) {
                best = Some((size, at));
            }
        }
        let (_, at) = best?;
        let mut scope = Vec::with_capacity(8);
        for open in self.open.iter().filter(|it| it.scope.contains(&left[at])) {
            for it in open.scope.iter().filter(|it| **it != left[at]) {
                if !scope.contains(it) {
                    scope.push(*it);
                }
            }
        }
        scope.sort_unstable();
        Some((at, scope))
    }

    /// Adds a step that leaves these variables and sums one out; without one it multiplies all
    /// tables that are left.
    fn step(&mut self, scope: &[usize], summed: Option<usize>) -> Result<(), NoAnswer> {
        let shape: Vec<usize> = scope.iter().map(|it| self.net.states(*it)).collect();
        let states = summed.map_or(1, |it| self.net.states(it));
        let size = shape.iter().try_fold(1_usize, |all, it| all.checked_mul(*it));
        let size = size.filter(|it| it.saturating_mul(states) <= MAX_CELLS);
        let size = size.ok_or(NoAnswer::TooLarge)?;
        let is_used = |it: &Open| summed.is_none_or(|variable| it.scope.contains(&variable));
        let used = self.open.iter().filter(|it| is_used(it));
        let operands = used.map(|it| self.operand(it.source, scope, summed)).collect();
        self.open.retain(|it| !is_used(it));
        self.steps.push(Step { operands, shape, size, summed: states });
        let source = self.net.nodes().len() + self.scopes.len();
        self.scopes.push(scope.to_vec());
        self.open.push(Open { source, scope: scope.to_vec() });
        Ok(())
    }

    fn operand(&self, source: usize, scope: &[usize], summed: Option<usize>) -> Operand {
        let nodes = self.net.nodes();
        // The variables of its cells, the last fastest: the node behind its parents.
        let (own, last) = match source.checked_sub(nodes.len()) {
            None => (nodes[source].parents.as_slice(), Some(&source)),
            Some(result) => (self.scopes[result].as_slice(), None),
        };
        let mut operand =
            Operand { source, strides: vec![0; scope.len()], inner: 0, fixed: Vec::new() };
        let mut far = 1;
        for variable in own.iter().chain(last).rev() {
            if Some(*variable) == summed {
                operand.inner = far;
            } else if let Some(at) = self.given[*variable].filter(|_| source < nodes.len()) {
                operand.fixed.push((at, far));
            } else if let Some(at) = scope.iter().position(|it| it == variable) {
                operand.strides[at] = far;
            }
            far *= self.net.states(*variable);
        }
        operand
    }
}

impl Network {
    /// The distribution of a variable given states of others.
    ///
    /// ```
    /// # use cotama_risk::{Network, NoAnswer};
    /// let text = "network n { } variable a { type discrete [ 2 ] { yes, no }; }
    ///     variable b { type discrete [ 2 ] { yes, no }; }
    ///     probability ( a ) { table 0.5, 0.5; }
    ///     probability ( b | a ) { (yes) 1, 0; (no) 1, 0; }";
    /// let (net, _) = Network::from_bif(text).unwrap();
    /// assert_eq!(net.infer(0, &[(1, 0)]).unwrap().posterior, [0.5, 0.5]);
    /// assert_eq!(net.infer(0, &[(1, 1)]), Err(NoAnswer::Impossible));
    /// ```
    ///
    /// # Errors
    /// When the evidence is impossible, the network is too wide, or a number is none of its own.
    pub fn infer(&self, query: usize, evidence: &[(usize, usize)]) -> Result<Posterior, NoAnswer> {
        let (given, states): (Vec<_>, Vec<_>) = evidence.iter().copied().unzip();
        Plan::new(self, &[query], &given)?.answer(self, &states)
    }
}
