//! Bayesian networks: variables, parents, tables of conditional probabilities.

use crate::data::{MAX_STATES, MAX_VARIABLES, Variable, named};
use crate::wrong::Wrong;

/// The most probabilities of all tables together.
pub const MAX_CELLS: usize = 1 << 24;

/// Distance that the sum of a row of a table may have from 1.
pub(crate) const SUM: f64 = 1e-9;

/// A variable with its parents and its table.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The variable.
    pub variable: Variable,
    /// The numbers of its parents, in the order in which the table counts them.
    pub parents: Vec<usize>,
    /// Probabilities: for each configuration of the parents, the last of which runs fastest, one
    /// for each state.
    pub table: Vec<f64>,
}

/// A Bayesian network. It has no cycle, and every row of a table sums to 1.
///
/// ```
/// use cotama_risk::Network;
/// let text = "network door { }
///     variable open { type discrete [ 2 ] { yes, no }; }
///     variable seen { type discrete [ 2 ] { yes, no }; }
///     probability ( open ) { table 0.25, 0.75; }
///     probability ( seen | open ) { (yes) 0.9, 0.1; (no) 0.2, 0.8; }";
/// let (net, notes) = Network::from_bif(text).unwrap();
/// assert!(notes.is_empty());
/// let seen = net.variable("seen").unwrap();
/// assert_eq!(net.nodes()[seen].table, [0.9, 0.1, 0.2, 0.8]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    name: String,
    nodes: Vec<Node>,
    /// Invariant: every parent stands before its children.
    order: Vec<usize>,
}

impl Network {
    /// A network of these nodes.
    ///
    /// # Errors
    /// When names are not unique, a table has another size than its variables say, a probability is
    /// negative or not finite, a row does not sum to 1 within 1e-9, arcs make a cycle, or a limit
    /// is passed.
    pub fn new(name: impl Into<String>, nodes: Vec<Node>) -> Result<Self, Wrong> {
        if nodes.len() > MAX_VARIABLES {
            return Err(Wrong::whole(format!("more than {MAX_VARIABLES} variables")));
        }
        let mut cells = 0;
        for (at, node) in nodes.iter().enumerate() {
            let name = &node.variable.name;
            if nodes[..at].iter().any(|it| it.variable.name == *name) {
                return Err(Wrong::whole(format!("two variables are called {name}")));
            }
            let states = node.variable.states.len();
            if !(1..=MAX_STATES).contains(&states) {
                return Err(Wrong::whole(format!("{name} has {states} states")));
            }
            let size = configurations(&nodes, &node.parents)?
                .checked_mul(states)
                .filter(|it| *it <= MAX_CELLS)
                .ok_or_else(|| too_large(name))?;
            cells += size;
            if cells > MAX_CELLS {
                return Err(too_large(name));
            }
            if node.table.len() != size {
                let has = node.table.len();
                return Err(Wrong::whole(format!("{name} has {has} probabilities, not {size}")));
            }
            let good = |it: &f64| it.is_finite() && *it >= 0.0;
            let sums = node
                .table
                .chunks(states)
                .all(|row| row.iter().all(good) && (row.iter().sum::<f64>() - 1.0).abs() <= SUM);
            if !sums {
                return Err(Wrong::whole(format!("a row of {name} is no distribution")));
            }
        }
        let parents: Vec<&[usize]> = nodes.iter().map(|it| it.parents.as_slice()).collect();
        let order = sorted(&parents).map_err(|cycle| {
            let name = |it: &usize| nodes[*it].variable.name.as_str();
            let names: Vec<_> = cycle.iter().chain(cycle.first()).map(name).collect();
            Wrong::whole(format!("{} is a cycle", names.join(" -> ")))
        })?;
        Ok(Self { name: name.into(), nodes, order })
    }

    /// The name of the network.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The nodes; variables are named by their numbers here.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// All variables, parents before their children.
    pub fn order(&self) -> &[usize] {
        &self.order
    }

    /// The number of the variable of this name.
    ///
    /// # Errors
    /// When there is none; the message has the near name.
    pub fn variable(&self, name: &str) -> Result<usize, Wrong> {
        let variables: Vec<_> = self.nodes.iter().map(|it| it.variable.clone()).collect();
        named(&variables, name)
    }

    /// The numbers of a variable and of one of its states.
    ///
    /// # Errors
    /// When there is no such variable or state; the message has the near name.
    pub fn state(&self, variable: &str, state: &str) -> Result<(usize, usize), Wrong> {
        let at = self.variable(variable)?;
        let states = &self.nodes[at].variable.states;
        let found = self.nodes[at].variable.state(state).ok_or_else(|| {
            let names = states.iter().map(String::as_str);
            let wrong = Wrong::whole(format!("{variable} has no state {state}"));
            let near = wrong.near(state, names);
            if near.help.is_some() {
                near
            } else {
                near.help(format!("it has {}", states.join(", ")))
            }
        })?;
        Ok((at, found))
    }

    /// Returns the number of states of a variable.
    pub(crate) fn states(&self, variable: usize) -> usize {
        self.nodes[variable].variable.states.len()
    }

    /// Children of each variable, rising.
    pub(crate) fn children(&self) -> Vec<Vec<usize>> {
        let mut children = vec![Vec::new(); self.nodes.len()];
        for (at, node) in self.nodes.iter().enumerate() {
            node.parents.iter().for_each(|it| children[*it].push(at));
        }
        children
    }
}

fn too_large(name: &str) -> Wrong {
    let message = format!("the table of {name} passes {MAX_CELLS} probabilities");
    Wrong::whole(message).help("give it fewer parents, or fewer states")
}

/// Returns the number of configurations of these parents.
pub(crate) fn configurations(nodes: &[Node], parents: &[usize]) -> Result<usize, Wrong> {
    let states = |it: &usize| nodes.get(*it).map(|it| it.variable.states.len());
    let all = parents.iter().try_fold(1_usize, |all, it| all.checked_mul(states(it)?));
    all.filter(|it| *it <= MAX_CELLS).ok_or_else(|| Wrong::whole("a table is too large"))
}

/// Sorts nodes so that parents stand before their children, the smallest number first wherever
/// there is a choice; or returns a cycle, each node of it a parent of the next.
pub(crate) fn sorted(parents: &[&[usize]]) -> Result<Vec<usize>, Vec<usize>> {
    let mut children = vec![Vec::new(); parents.len()];
    let mut open: Vec<usize> = parents.iter().map(|it| it.len()).collect();
    for (at, parents) in parents.iter().enumerate() {
        parents.iter().for_each(|it| children[*it].push(at));
    }
    let mut free: std::collections::BTreeSet<usize> =
        (0..parents.len()).filter(|it| open[*it] == 0).collect();
    let mut order = Vec::with_capacity(parents.len());
    while let Some(next) = free.pop_first() {
        order.push(next);
        for child in &children[next] {
            open[*child] -= 1;
            if open[*child] == 0 {
                free.insert(*child);
            }
        }
    }
    if order.len() == parents.len() {
        return Ok(order);
    }
    // Every node left has a parent left: to go from one to the next comes back to one.
    let left = |it: &usize| open[*it] > 0;
    let mut path: Vec<usize> = (0..parents.len()).find(left).into_iter().collect();
    while let Some(next) = path.last().and_then(|it| parents[*it].iter().copied().find(left)) {
        if let Some(first) = path.iter().position(|it| *it == next) {
            path.drain(..first);
            break;
        }
        path.push(next);
    }
    path.reverse();
    let least = path.iter().enumerate().min_by_key(|it| it.1).map_or(0, |it| it.0);
    path.rotate_left(least);
    Err(path)
}
