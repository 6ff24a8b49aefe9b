//! Tables of probabilities from counts, with a prior; counts that go on while a robot works.

use crate::dag::{Dag, bits};
use crate::data::Data;
use crate::network::{MAX_CELLS, Network, Node};
use crate::wrong::Wrong;
use std::collections::VecDeque;

/// Counts of a network of fixed structure: a row more or less takes time in proportion to the
/// variables.
///
/// ```
/// use cotama_risk::{Counts, Dag, Data};
/// let data = Data::from_csv("a,b\nx,y\nx,z\nw,z\n").unwrap();
/// let dag = Dag::new(vec![0, 1]).unwrap(); // a -> b
/// let mut counts = Counts::new(&data, &dag, None).unwrap();
/// let p = |counts: &Counts| counts.network("n", 1.0).unwrap().nodes()[0].table.clone();
/// assert_eq!(p(&counts), [0.375, 0.625]); // (1 + 1/2) / (3 + 1)
/// counts.add(&[0, 0]).unwrap();
/// assert_eq!(p(&counts), [0.5, 0.5]);
/// ```
#[derive(Clone, Debug)]
pub struct Counts {
    nodes: Vec<Node>,
    cells: Vec<Vec<u32>>,
    /// Rows that are counted, the oldest first; kept only where old ones are forgotten.
    rows: VecDeque<Vec<u16>>,
    window: Option<usize>,
}

impl Counts {
    /// The counts of a table of data. With a window the last so many rows count, and older ones are
    /// forgotten.
    ///
    /// # Errors
    /// When the graph has another number of variables, or a table is too large.
    pub fn new(data: &Data, dag: &Dag, window: Option<usize>) -> Result<Self, Wrong> {
        if dag.parents().len() != data.variables().len() {
            return Err(Wrong::whole("the graph has another number of variables than the data"));
        }
        let mut nodes = Vec::new();
        let (mut counts, mut size_of_all) = (Vec::new(), 0_usize);
        for (variable, parents) in data.variables().iter().zip(dag.parents()) {
            let parents: Vec<usize> = bits(*parents).collect();
            let all = parents.iter().map(|it| data.states(*it)).chain([variable.states.len()]);
            let size = all.fold(1_usize, usize::saturating_mul);
            size_of_all = size_of_all.saturating_add(size);
            if size_of_all > MAX_CELLS {
                let message = format!("the table of {} is too large", variable.name);
                return Err(Wrong::whole(message).help("allow fewer parents: --max-parents"));
            }
            counts.push(vec![0; size]);
            nodes.push(Node { variable: variable.clone(), parents, table: Vec::new() });
        }
        let mut all = Self { nodes, cells: counts, rows: VecDeque::new(), window };
        let first = data.rows() - window.map_or(data.rows(), |it| it.min(data.rows()));
        for row in first..data.rows() {
            let states = (0..data.variables().len()).map(|it| data.column(it)[row]);
            all.add(&states.collect::<Vec<_>>())?;
        }
        Ok(all)
    }

    /// Adds a row of states, and forgets the oldest one beyond the window.
    ///
    /// # Errors
    /// When the row has another number of states, or one that is none; nothing is changed.
    pub fn add(&mut self, row: &[u16]) -> Result<(), Wrong> {
        let is_state = |it: (&Node, &u16)| usize::from(*it.1) < it.0.variable.states.len();
        if row.len() != self.nodes.len() || !self.nodes.iter().zip(row).all(is_state) {
            return Err(Wrong::whole("a row has states that the network has not"));
        }
        self.count(row, 1);
        if let Some(window) = self.window {
            self.rows.push_back(row.to_vec());
            if self.rows.len() > window
                && let Some(old) = self.rows.pop_front()
            {
                self.count(&old, -1);
            }
        }
        Ok(())
    }

    fn count(&mut self, row: &[u16], by: i32) {
        for (at, node) in self.nodes.iter().enumerate() {
            let place = node.parents.iter().chain([&at]).fold(0, |place, it| {
                place * self.nodes[*it].variable.states.len() + usize::from(row[*it])
            });
            let cell = &mut self.cells[at][place];
            *cell = cell.saturating_add_signed(by);
        }
    }

    /// The network with the expected probabilities under a Dirichlet prior of the equivalent sample
    /// size `ess`, the same for all networks of a class: `(N_ijk + ess / (q r)) / (N_ij + ess / q)`
    /// (the prior of `BDeu`; the thesis has size 1). With 0 they are shares, and equal where a row
    /// never occurred.
    ///
    /// # Errors
    /// When the size is negative or not finite.
    pub fn network(&self, name: &str, ess: f64) -> Result<Network, Wrong> {
        if !(0.0..1e12).contains(&ess) {
            return Err(Wrong::whole("the sample size of a prior is 0 or more"));
        }
        let mut nodes = self.nodes.clone();
        for (node, counts) in nodes.iter_mut().zip(&self.cells) {
            let states = node.variable.states.len();
            let (q, r) = ((counts.len() / states) as f64, states as f64);
            for row in counts.chunks(states) {
                let sum = row.iter().map(|it| f64::from(*it)).sum::<f64>() + ess / q;
                let share = |it: &u32| {
                    if sum > 0.0 { (f64::from(*it) + ess / (q * r)) / sum } else { 1.0 / r }
                };
                node.table.extend(row.iter().map(share));
            }
        }
        Network::new(name, nodes)
    }
}
