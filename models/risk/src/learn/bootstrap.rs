//! How sure the arcs of a learned graph are: graphs of data that are drawn anew from the rows.

use crate::dag::Dag;
use crate::data::Data;
use cotama_streams::Streams;

/// How often each arc came back in graphs that were learned from resampled data.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArcCounts {
    /// The number of graphs.
    pub resamples: u64,
    variables: usize,
    counts: Vec<u64>,
}

impl ArcCounts {
    /// Returns the number of graphs with this arc.
    pub fn arc(&self, from: usize, to: usize) -> u64 {
        self.counts.get(from * self.variables + to).copied().unwrap_or(0)
    }

    /// Returns the number of graphs in which an arc joins the two, in either direction. Graphs of a
    /// class differ in directions that no data can tell: this number does not depend on them.
    pub fn joined(&self, a: usize, b: usize) -> u64 {
        self.arc(a, b) + self.arc(b, a)
    }

    /// Returns the share of the graphs that so many are.
    pub fn share(&self, graphs: u64) -> f64 {
        graphs as f64 / self.resamples as f64
    }
}

/// Learns a graph of each of so many resamples: as many rows as there are, drawn with replacement
/// (the bootstrap of Friedman, Goldszmidt and Wyner, UAI 1999, section 2). `learn` is the search.
///
/// # Errors
/// The first error of the search.
///
/// ```
/// use cotama_risk::{Constraints, Families, Network, EMBEDDED, Score, bootstrap, hill};
/// let asia = EMBEDDED.iter().find(|it| it.0 == "asia").unwrap();
/// let (asia, _) = Network::from_bif(asia.2).unwrap();
/// let data = asia.sample(2_000, 1).unwrap();
/// let none = Constraints::none(8).unwrap();
/// let learn = |data: &_| Ok::<_, ()>(hill(&mut Families::new(data, Score::Bic), &none, 0, 1));
/// let arcs = bootstrap(&data, 20, 1, learn).unwrap();
/// let [asia, lung, either] = ["asia", "lung", "either"].map(|it| data.variable(it).unwrap());
/// assert_eq!(arcs.joined(lung, either), 20);
/// assert!(arcs.joined(asia, lung) < 5);
/// ```
pub fn bootstrap<E>(
    data: &Data,
    resamples: u64,
    seed: u64,
    mut learn: impl FnMut(&Data) -> Result<Dag, E>,
) -> Result<ArcCounts, E> {
    let variables = data.variables().len();
    let mut all = ArcCounts { resamples, variables, counts: vec![0; variables * variables] };
    let streams = Streams::new(seed);
    for number in 0..resamples {
        let mut stream = streams.stream(&format!("bootstrap {number}"));
        let rows = data.rows();
        let drawn: Vec<usize> = (0..rows).map(|_| stream.below(rows as u64) as usize).collect();
        let dag = learn(&data.of_rows(&drawn))?;
        for (to, parents) in dag.parents().iter().enumerate() {
            for from in (0..variables).filter(|it| parents >> it & 1 == 1) {
                all.counts[from * variables + to] += 1;
            }
        }
    }
    Ok(all)
}
