//! Model that is learned from trials, and the choice under risk that it gives.

use crate::maps::Ratio;
use crate::ring::Way;
use crate::trial::Trial;
use cotama_risk::{Counts, Dag, Data, Model, Names, Network, Seen, Variable, Wrong};
use std::fmt::Write;

/// Bounds of the three intervals of path lengths, in metres: thirds of a length a little above that
/// of the long way.
pub const LENGTHS_M: [f64; 2] = [6.0, 12.0];
/// Bounds of the four intervals of run times, in seconds (Rohrmueller 2011, section 4.5.2); the
/// last one is open, and counts as one up to 40 s.
pub const TIMES_S: [f64; 3] = [10.0, 20.0, 30.0];
/// Utility of the goal (section 4.5.2).
pub const UTILITY: f64 = 100.0;
/// The most trials of a map (table 4.2).
pub const TRIALS: usize = 3;

/// States of the intervals.
const LENGTHS: [&str; 3] = ["low", "middle", "high"];
const TIMES: [&str; 4] = ["t0_10", "t10_20", "t20_30", "t30_40"];
/// The most of each interval of times, in seconds.
const MOST_S: [f64; 4] = [10.0, 20.0, 30.0, 40.0];

/// Counts of trials. The graph is made by hand: ratio and way tell of the end, ratio and end of the
/// path's length, and all three of the time (a reading of figure 4.13, which is a drawing).
#[derive(Clone, Debug)]
pub struct Learned {
    counts: Counts,
    rows: usize,
    /// For each ratio and way: trials, and how many of them failed.
    tally: [[[u64; 2]; 2]; 5],
}

/// A trial with its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Discs of the map.
    pub ratio: Ratio,
    /// The way that was taken.
    pub way: Way,
    /// The trial.
    pub trial: Trial,
}

impl Row {
    fn states(&self) -> [u16; 5] {
        let number = |bounds: &[f64], it: f64| bounds.iter().filter(|at| it > **at).count() as u16;
        [
            self.ratio as u16,
            self.way as u16,
            u16::from(!self.trial.is_success()),
            number(&LENGTHS_M, self.trial.length_m),
            number(&TIMES_S, self.trial.cost()),
        ]
    }

    /// The failed trial as beliefs take it.
    pub(crate) fn seen(&self) -> Seen {
        Seen { way: self.way as usize, observation: usize::from(self.states()[3]) }
    }
}

fn variables() -> Vec<Variable> {
    let named = |name: &str, states: &[&str]| Variable {
        name: name.into(),
        states: states.iter().map(|it| (*it).into()).collect(),
    };
    vec![
        named("ratio", &Ratio::ALL.map(Ratio::name)),
        named("way", &Way::ALL.map(Way::name)),
        named("status", &["success", "failed"]),
        named("path_length", &LENGTHS),
        named("run_time", &TIMES),
    ]
}

impl Learned {
    /// Counts of trials, at least one.
    ///
    /// # Errors
    /// When there is no trial.
    pub fn new(rows: &[Row]) -> Result<Self, Wrong> {
        let states: Vec<_> = rows.iter().map(Row::states).collect();
        let columns = (0..5).map(|it| states.iter().map(|row| row[it]).collect()).collect();
        let data = Data::new(variables(), columns)?;
        let dag = Dag::new(vec![0, 0, 0b0_0011, 0b0_0101, 0b0_0111]);
        let Some(dag) = dag else { unreachable!("the graph has no cycle") };
        let counts = Counts::new(&data, &dag, None)?;
        let mut all = Self { counts, rows: 0, tally: [[[0; 2]; 2]; 5] };
        rows.iter().for_each(|it| all.note(it));
        Ok(all)
    }

    /// Adds a trial.
    ///
    /// # Errors
    /// Never: a row has the states of the graph.
    pub fn add(&mut self, row: &Row) -> Result<(), Wrong> {
        self.counts.add(&row.states())?;
        self.note(row);
        Ok(())
    }

    fn note(&mut self, row: &Row) {
        self.rows += 1;
        let [trials, failed] = &mut self.tally[row.ratio as usize][row.way as usize];
        *trials += 1;
        *failed += u64::from(!row.trial.is_success());
    }

    /// Number of trials.
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Trials on a way at a ratio, and how many of them failed.
    pub const fn tally(&self, ratio: Ratio, way: Way) -> [u64; 2] {
        self.tally[ratio as usize][way as usize]
    }

    /// The network with the prior of size one (section 4.5.2).
    ///
    /// # Errors
    /// Never, with the counts of this type.
    pub fn network(&self) -> Result<Network, Wrong> {
        self.counts.network("two_ways_learned", 1.0)
    }

    /// The choice between both ways.
    ///
    /// # Errors
    /// Never, with the counts of this type.
    pub fn model(&self) -> Result<Model, Wrong> {
        let bound = |(at, state): (usize, &&str)| ((*state).into(), MOST_S[at] - 10.0, MOST_S[at]);
        let names = Names {
            utility: UTILITY,
            trials: TRIALS,
            choice: "way".into(),
            hidden: "ratio".into(),
            given: vec![],
            outcome: ("status".into(), "success".into(), "failed".into()),
            observed: vec!["path_length".into()],
            cost: "run_time".into(),
            bounds: TIMES.iter().enumerate().map(bound).collect(),
        };
        Model::new(&self.network()?, &names)
    }
}

/// Writes trials as CSV, with the measured length and time: for `cotama risk discretise`.
pub fn to_csv(rows: &[Row]) -> String {
    let mut text = String::from("ratio,way,status,path_length_m,run_time_s\n");
    for Row { ratio, way, trial } in rows {
        let status = if trial.is_success() { "success" } else { "failed" };
        let (length, time) = (trial.length_m, trial.cost());
        let _ = writeln!(text, "{},{},{status},{length:.3},{time:.2}", ratio.name(), way.name());
    }
    text
}
