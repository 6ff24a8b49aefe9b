//! Networks that come with the project, and rows drawn from a network.

use crate::data::Data;
use crate::network::Network;
use crate::wrong::Wrong;
use cotama_streams::Streams;

/// Networks by name, each with one line about it and its text in BIF; `data/README.md` has their
/// sources.
pub const EMBEDDED: [(&str, &str, &str); 3] = [
    (
        "two-ways",
        "A short way and a long way round an obstacle, with objects that move across them",
        include_str!("../data/two_ways.bif"),
    ),
    (
        "asia",
        "A visit to Asia (Lauritzen and Spiegelhalter, J. R. Stat. Soc. B 50, 1988)",
        include_str!("../data/asia.bif"),
    ),
    (
        "cancer",
        "Causes and signs of cancer (Korb and Nicholson, Bayesian Artificial Intelligence)",
        include_str!("../data/cancer.bif"),
    ),
];

/// The choice of a way in the network `two-ways`, as a file of `cotama risk choose`.
pub const TWO_WAYS: &str = include_str!("../data/two_ways.toml");

impl Network {
    /// Draws rows from the network, the same ones for the same seed.
    ///
    /// # Errors
    /// When no row is asked for.
    pub fn sample(&self, rows: usize, seed: u64) -> Result<Data, Wrong> {
        let mut stream = Streams::new(seed).stream("rows");
        let mut columns = vec![Vec::with_capacity(rows); self.nodes().len()];
        let mut row = vec![0_usize; self.nodes().len()];
        for _ in 0..rows {
            for at in self.order() {
                let node = &self.nodes()[*at];
                let place = node.parents.iter().fold(0, |it, of| it * self.states(*of) + row[*of]);
                let states = self.states(*at);
                let (mut drawn, mut state) = (stream.part(), 0);
                for share in &node.table[place * states..(place + 1) * states] {
                    drawn -= share;
                    if drawn < 0.0 {
                        break;
                    }
                    state += 1;
                }
                // The sum may miss 1 by rounding.
                row[*at] = state.min(states - 1);
            }
            row.iter().zip(&mut columns).for_each(|(state, column)| column.push(*state as u16));
        }
        Data::new(self.nodes().iter().map(|it| it.variable.clone()).collect(), columns)
    }
}
