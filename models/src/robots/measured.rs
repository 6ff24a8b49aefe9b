//! Detection of a robot's failures as runs by signals have shown it: how often, after how long, and
//! taken for what.
//!
//! A `cotama-measurement/1` file keeps every run: of each failure the delays, by the rows for which
//! it was taken. A run that is told its failures draws one of these runs ([`Detection::run`]), so
//! that shares, delays and confusions come back as they were measured.

mod reader;

use super::Robot;
use crate::toml_text::quoted;
use cotama_core::units::{Millimetres, Millis};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Value of `format` in the files.
pub const MEASURED_FORMAT: &str = "cotama-measurement/1";
/// The most runs of a failure that are kept.
pub const MAX_MEASURED_RUNS: u32 = 10_000;

/// The detection of one failure in several runs.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::robots::Detection;
/// let mut it = Detection { runs: 4, ..Detection::default() };
/// it.taken_for.insert(vec![7], vec![Millis(300), Millis(500)]);
/// it.taken_for.insert(vec![2, 9], vec![Millis(100)]);
/// assert_eq!((it.found(), it.named(7), it.missed()), (3, 2, 1));
/// assert_eq!((it.median(), it.worst()), (Some(Millis(300)), Some(Millis(500))));
/// assert_eq!(it.run(0), Some((&[2, 9][..], Millis(100))));
/// assert_eq!((it.run(2), it.run(3)), (Some((&[7][..], Millis(500))), None));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Detection {
    /// The runs in which it happened.
    pub runs: u64,
    /// The runs in which something was diagnosed before.
    pub false_alarms: u64,
    /// The rows that it was taken for, by their numbers, the worst first; and in each run in which
    /// it was, the time from the failure to that diagnosis, the shortest first.
    ///
    /// Invariant: there are not more delays than runs.
    pub taken_for: BTreeMap<Vec<usize>, Vec<Millis>>,
}

impl Detection {
    /// Returns in how many runs something was diagnosed.
    pub fn found(&self) -> u64 {
        self.taken_for.values().map(|it| it.len() as u64).sum()
    }

    /// Returns in how many runs nothing was.
    pub fn missed(&self) -> u64 {
        self.runs.saturating_sub(self.found())
    }

    /// Returns in how many runs a row was among those that it was taken for.
    pub fn named(&self, failure: usize) -> u64 {
        self.delays_of(failure).count() as u64
    }

    /// The delays of the runs in which a row was named.
    fn delays_of(&self, failure: usize) -> impl Iterator<Item = Millis> {
        let named = self.taken_for.iter().filter(move |it| it.0.contains(&failure));
        named.flat_map(|it| it.1).copied()
    }

    /// Returns the delays of all runs in which something was diagnosed, the shortest first.
    pub fn delays(&self) -> Vec<Millis> {
        let mut all: Vec<_> = self.taken_for.values().flatten().copied().collect();
        all.sort_unstable();
        all
    }

    /// Returns the delay in the middle, of two the shorter one; `None` where it was never found.
    pub fn median(&self) -> Option<Millis> {
        let all = self.delays();
        all.get(all.len().checked_sub(1)? / 2).copied()
    }

    /// Returns the longest delay.
    pub fn worst(&self) -> Option<Millis> {
        self.taken_for.values().flatten().max().copied()
    }

    /// Returns the longest delay of the runs in which a row was named.
    pub fn worst_named(&self, failure: usize) -> Option<Millis> {
        self.delays_of(failure).max()
    }

    /// Notes a run: the delay and the rows, where something was diagnosed.
    pub fn note(&mut self, diagnosed: Option<(Vec<usize>, Millis)>) {
        self.runs += 1;
        if let Some((rows, delay)) = diagnosed {
            let delays = self.taken_for.entry(rows).or_default();
            delays.insert(delays.partition_point(|it| *it <= delay), delay);
        }
    }

    /// Returns one of the runs, from 0, in the order of the file: the rows that the failure was
    /// taken for, and the delay; `None` where nothing was diagnosed in it.
    pub fn run(&self, number: u64) -> Option<(&[usize], Millis)> {
        let runs =
            self.taken_for.iter().flat_map(|it| it.1.iter().map(|delay| (&it.0[..], *delay)));
        usize::try_from(number).ok().and_then(|it| runs.into_iter().nth(it))
    }
}

/// The detection of the failures of a robot, measured on a mission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Measurement {
    /// Name of the robot.
    pub robot: String,
    /// Name of the mission.
    pub mission: String,
    /// Seeds of the runs of each failure: from 0, one a run.
    pub seeds: u64,
    /// Place of the robot on its path when a failure happened.
    pub x: Millimetres,
    /// Time in which a failure was to be found.
    pub window: Millis,
    /// The failures that were measured, by their numbers.
    pub rows: BTreeMap<usize, Detection>,
}

impl Measurement {
    /// Returns the measurement as a file, with its origin as a comment.
    ///
    /// ```
    /// use cotama_core::units::{Millimetres, Millis};
    /// use cotama_models::robots::{Detection, Measurement, Robot};
    /// let robot = Robot::shipped("p3dx-delivery").unwrap();
    /// let mut detection = Detection::default();
    /// detection.note(Some((vec![0], Millis(5_300))));
    /// detection.note(None);
    /// let it = Measurement {
    ///     robot: robot.name.clone(),
    ///     mission: "delivery".into(),
    ///     seeds: 2,
    ///     x: Millimetres(9_000),
    ///     window: Millis(120_000),
    ///     rows: [(0, detection)].into(),
    /// };
    /// let text = it.to_toml(&robot, "cotama fmeca --measure delivery --seeds 2");
    /// assert!(text.contains("taken = [{ for = [\"SON1\"], delays_ms = [5300] }]"), "{text}");
    /// assert_eq!(Measurement::parse("it.toml", &text, &robot).unwrap(), it);
    /// ```
    #[must_use]
    pub fn to_toml(&self, robot: &Robot, origin: &str) -> String {
        let mut text = format!("# Measured by: {origin}\n");
        let mut put = |line: String| {
            text += &line;
            text.push('\n');
        };
        put(format!("format = {}", quoted(MEASURED_FORMAT)));
        put(format!("robot = {}", quoted(&self.robot)));
        put(format!("mission = {}", quoted(&self.mission)));
        put(format!("seeds = {}", self.seeds));
        put(format!("x_mm = {}", self.x.0));
        put(format!("window_ms = {}", self.window.0));
        let id = |row: usize| robot.failures.get(row).map_or("", |it| it.id.as_str());
        for (row, it) in &self.rows {
            let took =
                |it: Option<Millis>| it.map_or_else(|| "-".to_owned(), |it| format!("{} ms", it.0));
            let (median, worst) = (took(it.median()), took(it.worst()));
            put("\n[[failure]]".to_owned());
            put(format!("id = {}", quoted(id(*row))));
            put(format!(
                "# found {}, named {}, median {median}, worst {worst}",
                it.found(),
                it.named(*row)
            ));
            put(format!("runs = {}", it.runs));
            put(format!("missed = {}", it.missed()));
            if it.false_alarms > 0 {
                put(format!("false_alarms = {}", it.false_alarms));
            }
            let taken: Vec<_> = it.taken_for.iter().map(|it| taken(it, id)).collect();
            match taken.as_slice() {
                [] => {}
                [one] => put(format!("taken = [{one}]")),
                all => put(format!("taken = [\n  {},\n]", all.join(",\n  "))),
            }
        }
        text
    }
}

/// The runs of one diagnosis.
fn taken<'r>((rows, delays): (&Vec<usize>, &Vec<Millis>), id: impl Fn(usize) -> &'r str) -> String {
    let rows: Vec<_> = rows.iter().map(|it| quoted(id(*it))).collect();
    let mut text = format!("{{ for = [{}], delays_ms = [", rows.join(", "));
    for (at, delay) in delays.iter().enumerate() {
        let comma = if at == 0 { "" } else { ", " };
        let _ = write!(text, "{comma}{}", delay.0); // writing into a string cannot fail
    }
    text + "] }"
}
