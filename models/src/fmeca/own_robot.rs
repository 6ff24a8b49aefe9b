//! The analysis of a robot from its file.

use super::analysis::{Analysis, Flag, Mode};
use super::criticality::measured_rank;
use super::diagnosis::Status;
use super::label::Label;
use super::set::Set;
use crate::robots::{Failure, Measurement, Parts, Robot};

/// A mission of a robot takes minutes; this is a working day (assumed).
const PERIOD_H: u32 = 8;

/// Failures of a robot without `mean_hours`, by their short names: nothing can be said of their
/// criticality.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoRate(pub Vec<String>);

impl std::fmt::Display for NoRate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "no `mean_hours` in {}", self.0.join(", "))
    }
}

impl std::error::Error for NoRate {}

impl TryFrom<&Robot> for Analysis {
    type Error = NoRate;

    /// The rows of a robot: what its file leaves out is said to be so.
    ///
    /// ```
    /// use cotama_models::fmeca::Analysis;
    /// use cotama_models::robots::Robot;
    /// let robot = Robot::shipped("transport").unwrap();
    /// let analysis = Analysis::try_from(&robot).unwrap();
    /// let lidar = &analysis.modes()[0];
    /// assert_eq!((lidar.lost.as_str(), lidar.event.as_str()), ("lidar", "adapter"));
    /// assert_eq!(lidar.reaction, "start scan anew once; then another configuration");
    /// ```
    fn try_from(robot: &Robot) -> Result<Self, NoRate> {
        // That no plan is left follows from other failures, and has no rate of its own.
        let rows = || robot.failures.iter().filter(|it| !it.no_plan);
        let lacking = rows().filter(|it| it.mean_mh.is_none());
        let lacking: Vec<_> = lacking.map(|it| it.id.clone()).collect();
        if !lacking.is_empty() {
            return Err(NoRate(lacking));
        }
        let flags = robot.flags().map(|(observer, name)| Flag {
            name: name.to_owned(),
            doc: String::new(),
            observer: robot.observers.get(observer).map_or_else(String::new, |it| it.name.clone()),
        });
        let title = if robot.title.is_empty() { &robot.name } else { &robot.title };
        Ok(Self {
            title: title.clone(),
            period_h: PERIOD_H,
            flags: flags.collect(),
            probes: Vec::new(),
            modes: rows().map(|it| mode(robot, it)).collect(),
        })
    }
}

impl Analysis {
    /// The same analysis with the detection ranks that runs of the robot have shown.
    ///
    /// ```
    /// use cotama_models::fmeca::Analysis;
    /// use cotama_models::robots::{Measurement, Robot, embedded_measurement};
    /// let robot = Robot::shipped("p3dx-delivery").unwrap();
    /// let file = embedded_measurement("p3dx-delivery").unwrap();
    /// let measurement = Measurement::parse(file.name, file.text, &robot).unwrap();
    /// let analysis = Analysis::try_from(&robot).unwrap().measured(&robot, &measurement);
    /// let son2 = analysis.modes().iter().find(|it| it.id == "SON2").unwrap();
    /// assert_eq!(analysis.criticality(son2).measured, Some(3)); // up to a second, always
    /// ```
    #[must_use]
    pub fn measured(mut self, robot: &Robot, by: &Measurement) -> Self {
        for it in &mut self.modes {
            let row = robot.failure(&it.id);
            it.measured_rank = row.and_then(|row| measured_rank(by.rows.get(&row)?, row));
        }
        self
    }

    /// The rows of a robot that comes with the program; `None` where there is none of this name, or
    /// one without rates.
    pub fn shipped(name: &str) -> Option<Self> {
        Self::try_from(&Robot::shipped(name)?).ok()
    }
}

impl Status {
    /// A robot in which one of its losses, by its number, is known: the flags of observers that
    /// lack something are not raised. Failures and flags are those of its analysis.
    pub fn after(robot: &Robot, loss: usize) -> Self {
        let loss = robot.losses.losses.get(loss);
        let available = !loss.map_or(0, |it| it.modules) & robot.available(Parts::NONE);
        let sees = |observer: usize| {
            let needs = robot.observers.get(observer).map_or(0, |it| it.needs.modules);
            needs & !available == 0
        };
        let flags = robot.flags().enumerate().filter(|it| sees(it.1.0)).map(|it| it.0);
        let rows = robot.failures.iter().filter(|it| !it.no_plan).count();
        Self {
            name: loss.map_or_else(|| "sound".to_owned(), |it| format!("{} lost", it.name)),
            flags: Set::of(robot.flags().count(), flags),
            modes: Set::of(rows, 0..rows),
            probes: Set::of(0, std::iter::empty()),
        }
    }
}

fn mode(robot: &Robot, it: &Failure) -> Mode {
    let said = |text: &str, or: &str| if text.is_empty() { or.to_owned() } else { text.to_owned() };
    let count = robot.flags().count();
    let lost = robot.names_of(it.loses).join(" ");
    let component = if it.item.is_empty() { said(&lost, "the robot") } else { it.item.clone() };
    Mode {
        id: it.id.clone(),
        function: said(&it.function, "do the mission"),
        component,
        failure: it.mode.clone(),
        cause: said(&it.cause, "not said"),
        effect: said(&it.effect, "not said"),
        severity: it.autonomous,
        severity_operator: Some(it.operator),
        persistence: Some(it.persistence),
        lost: said(&lost, "-"),
        observer: observers(robot, it),
        detection: String::new(),
        latency_ms: u32::try_from(it.latency.0).unwrap_or(u32::MAX),
        flags: Set::of(count, it.flags.iter().copied()),
        sometimes: Set::of(count, it.sometimes.iter().copied()),
        silent: it.unseen.clone(),
        detection_rank: None,
        measured_rank: None,
        event: it.autonomous.class().name().to_owned(),
        reaction: it.reaction(robot),
        mtbf_mh: it.mean_mh.unwrap_or(1),
        alpha_permille: None,
        beta_permille: None,
        rate_label: Label::Assumed,
        rate_source: said(&it.source, "not said"),
        injection: String::new(),
    }
}

fn observers(robot: &Robot, of: &Failure) -> String {
    let raised = robot.flags().enumerate().filter(|it| of.flags.contains(&it.0));
    let mut all: Vec<_> = raised.map(|it| it.1.0).collect();
    all.dedup();
    let names = all.into_iter().filter_map(|it| robot.observers.get(it));
    names.map(|it| it.name.as_str()).collect::<Vec<_>>().join("; ")
}
