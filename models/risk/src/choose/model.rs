//! A choice under risk as numbers, made of a network and the names of its parts.

use crate::infer::{NoAnswer, Plan};
use crate::network::Network;
use crate::wrong::Wrong;

/// Names of the parts that variables of a network play in a choice.
#[derive(Clone, Debug, PartialEq)]
pub struct Names {
    /// Gain of a success.
    pub utility: f64,
    /// The most trials, from 1 to [`Model::MAX_TRIALS`].
    pub trials: usize,
    /// The variable that the robot sets.
    pub choice: String,
    /// The variable that it only believes something about.
    pub hidden: String,
    /// Evidence before the choice: variables and their states.
    pub given: Vec<(String, String)>,
    /// The variable that says how a trial ended, its state of success and that of failure.
    pub outcome: (String, String, String),
    /// Observation after a failed trial.
    pub observed: Vec<String>,
    /// The variable of the cost of a trial.
    pub cost: String,
    /// For each of its states the lower and the upper bound of the cost.
    pub bounds: Vec<(String, f64, f64)>,
}

/// A choice between ways, each trial of which may fail.
#[derive(Clone, Debug, PartialEq)]
pub struct Model {
    utility: f64,
    trials: usize,
    ways: Vec<String>,
    hidden: Vec<String>,
    prior: Vec<f64>,
    bounds: Vec<(f64, f64)>,
    /// For each combination of what is seen after a failure its name.
    seen: Vec<String>,
    /// For each way and each hidden state.
    cells: Vec<Vec<Cell>>,
}

/// A way in a hidden state.
#[derive(Clone, Debug, Default, PartialEq)]
struct Cell {
    success: f64,
    /// Distributions of the cost given success and given failure.
    won: Vec<f64>,
    lost: Vec<f64>,
    /// Distribution of what is seen, given failure.
    seen: Vec<f64>,
}

impl Model {
    /// The most trials: sequences of ways are tried out.
    pub const MAX_TRIALS: usize = 8;
    /// The most ways, and the most combinations that are seen.
    pub const MAX_WAYS: usize = 16;

    /// The choice that a network and names make.
    ///
    /// # Errors
    /// When a name is none of the network, a number is out of its range, a variable has two parts,
    /// or what is given is impossible.
    pub fn new(net: &Network, names: &Names) -> Result<Self, Wrong> {
        let at = |name: &String| net.variable(name);
        let (choice, hidden, cost) = (at(&names.choice)?, at(&names.hidden)?, at(&names.cost)?);
        let (outcome, success, failure) = &names.outcome;
        let (outcome, success) = net.state(outcome, success)?;
        let (_, failure) = net.state(&names.outcome.0, failure)?;
        let given: Vec<(usize, usize)> =
            names.given.iter().map(|it| net.state(&it.0, &it.1)).collect::<Result<_, _>>()?;
        let observed: Vec<usize> = names.observed.iter().map(at).collect::<Result<_, _>>()?;
        let mut parts = vec![choice, hidden, cost, outcome];
        parts.extend(given.iter().map(|it| it.0).chain(observed.iter().copied()));
        if let Some(twice) = (1..parts.len()).find(|it| parts[..*it].contains(&parts[*it])) {
            let name = &net.nodes()[parts[twice]].variable.name;
            return Err(Wrong::whole(format!("{name} has two parts in the choice")));
        }
        if success == failure {
            return Err(Wrong::whole("success and failure are the same state"));
        }
        if !(1..=Self::MAX_TRIALS).contains(&names.trials) {
            let most = Self::MAX_TRIALS;
            return Err(Wrong::whole(format!("trials: 1 to {most}, not {}", names.trials)));
        }
        if !(names.utility.is_finite() && names.utility > 0.0) {
            return Err(Wrong::whole("the utility is a number above 0"));
        }
        let combinations: usize = observed.iter().map(|it| net.states(*it)).product();
        let each = libm::log2(net.states(choice) as f64 * combinations as f64);
        let sequences = each * names.trials as f64;
        if net.states(choice) > Self::MAX_WAYS || combinations > Self::MAX_WAYS || sequences > 20.0
        {
            return Err(Wrong::whole("there are too many ways, trials or observations to try out"));
        }
        let impossible = |why: NoAnswer| Wrong::whole(format!("{}: {why}", names.choice));
        let asks = Asks { net, choice, hidden, outcome, given, states: (success, failure) };
        let cells = (0..net.states(choice)).map(|way| {
            let cell = |hidden| asks.cell(way, hidden, cost, &observed);
            (0..net.states(hidden)).map(cell).collect::<Result<Vec<_>, _>>()
        });
        let prior = net.infer(hidden, &asks.given).map_err(impossible)?.posterior;
        Ok(Self {
            utility: names.utility,
            trials: names.trials,
            ways: net.nodes()[choice].variable.states.clone(),
            hidden: net.nodes()[hidden].variable.states.clone(),
            prior,
            bounds: bounds(net, cost, names)?,
            seen: combined(net, &observed),
            cells: cells.collect::<Result<_, _>>().map_err(impossible)?,
        })
    }

    /// Gain of a success.
    pub const fn utility(&self) -> f64 {
        self.utility
    }

    /// The most trials.
    pub const fn trials(&self) -> usize {
        self.trials
    }

    /// Number of ways.
    pub fn ways(&self) -> usize {
        self.ways.len()
    }

    /// The name of a way.
    pub fn way(&self, name: usize) -> &str {
        self.ways.get(name).map_or("", String::as_str)
    }

    /// The number of the way of this name.
    pub fn way_of(&self, name: &str) -> Option<usize> {
        self.ways.iter().position(|it| it == name)
    }

    /// Number of hidden states.
    pub fn hidden(&self) -> usize {
        self.hidden.len()
    }

    /// The names of the hidden states.
    pub fn hidden_states(&self) -> &[String] {
        &self.hidden
    }

    /// Belief at first: the network's own distribution of the hidden variable.
    pub fn prior(&self) -> &[f64] {
        &self.prior
    }

    /// Names of what can be seen after a failure, states of all observed variables behind each
    /// other with a comma.
    pub fn observations(&self) -> &[String] {
        &self.seen
    }

    /// The probability of success.
    pub fn success(&self, hidden: usize, way: usize) -> f64 {
        self.cells[way][hidden].success
    }

    /// The distribution of the cost given how the trial ended.
    pub(crate) fn costs(&self, hidden: usize, way: usize, is_success: bool) -> &[f64] {
        let cell = &self.cells[way][hidden];
        if is_success { &cell.won } else { &cell.lost }
    }

    /// The distribution of what is seen after a failure.
    pub(crate) fn seen(&self, hidden: usize, way: usize) -> &[f64] {
        &self.cells[way][hidden].seen
    }

    pub(crate) fn bounds(&self) -> &[(f64, f64)] {
        &self.bounds
    }
}

struct Asks<'n> {
    net: &'n Network,
    choice: usize,
    hidden: usize,
    outcome: usize,
    given: Vec<(usize, usize)>,
    /// Success and failure.
    states: (usize, usize),
}

impl Asks<'_> {
    fn cell(
        &self,
        way: usize,
        hidden: usize,
        cost: usize,
        observed: &[usize],
    ) -> Result<Cell, NoAnswer> {
        let mut evidence = self.given.clone();
        evidence.extend([(self.choice, way), (self.hidden, hidden)]);
        let ends = match self.net.infer(self.outcome, &evidence) {
            // The hidden state is not possible: its cell is never weighted.
            Err(NoAnswer::Impossible) => return Ok(Cell::none(self.net, cost, observed)),
            ends => ends?.posterior,
        };
        let (won, lost) = (ends[self.states.0], ends[self.states.1]);
        let mut cell = Cell::none(self.net, cost, observed);
        cell.success = won / (won + lost);
        let asked = |of: &[usize], end: usize| {
            let mut evidence = evidence.clone();
            evidence.push((self.outcome, end));
            let (given, states): (Vec<_>, Vec<_>) = evidence.into_iter().unzip();
            Ok::<_, NoAnswer>(Plan::new(self.net, of, &given)?.answer(self.net, &states)?.posterior)
        };
        if won > 0.0 {
            cell.won = asked(&[cost], self.states.0)?;
        }
        if lost > 0.0 {
            cell.lost = asked(&[cost], self.states.1)?;
            if !observed.is_empty() {
                cell.seen = asked(observed, self.states.1)?;
            }
        }
        Ok(cell)
    }
}

impl Cell {
    /// A cell without what is impossible.
    fn none(net: &Network, cost: usize, observed: &[usize]) -> Self {
        let even = |count: usize| vec![1.0 / count as f64; count];
        let seen = observed.iter().map(|it| net.states(*it)).product();
        let cost = even(net.states(cost));
        Self { success: 0.0, won: cost.clone(), lost: cost, seen: even(seen) }
    }
}

fn bounds(net: &Network, cost: usize, names: &Names) -> Result<Vec<(f64, f64)>, Wrong> {
    let states = &net.nodes()[cost].variable.states;
    for (at, (state, low, high)) in names.bounds.iter().enumerate() {
        net.state(&names.cost, state)?;
        if names.bounds[..at].iter().any(|it| it.0 == *state) {
            return Err(Wrong::whole(format!("{state} has two intervals")));
        }
        if !(low.is_finite() && high.is_finite() && low <= high) {
            return Err(Wrong::whole(format!("{state}: an interval is [low, high]")));
        }
    }
    let bound = |state: &String| {
        let found = names.bounds.iter().find(|it| it.0 == *state).map(|it| (it.1, it.2));
        found.ok_or_else(|| Wrong::whole(format!("{state} of {} has no interval", names.cost)))
    };
    states.iter().map(bound).collect()
}

fn combined(net: &Network, observed: &[usize]) -> Vec<String> {
    observed.iter().fold(vec![String::new()], |all, it| {
        let states = &net.nodes()[*it].variable.states;
        let with = |first: &String| {
            let first = if first.is_empty() { String::new() } else { format!("{first},") };
            states.iter().map(move |it| format!("{first}{it}")).collect::<Vec<_>>()
        };
        all.iter().flat_map(with).collect()
    })
}
