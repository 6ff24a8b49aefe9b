//! The part of planning that is the same for every run of a mission.

use crate::options::{Options, Planner};
use cotama_core::hold::Hold;
use cotama_core::monitor::{Monitor, MonitorError};
use cotama_core::problem::Candidate;
use cotama_models::margins::Promise;
use cotama_models::missions::tables::Activity;
use cotama_models::missions::{Mission, Remaining};

/// All that planning needs of a mission, made once for any number of runs.
#[derive(Clone, Debug)]
pub(crate) struct Plannable<'m> {
    pub(crate) mission: &'m Mission,
    pub(crate) planner: Planner,
    pub(crate) activities: Vec<Activity<'m>>,
    /// For each activity all its alternatives as candidates of the whole activity; the id is the
    /// index.
    pub(super) whole: Vec<Vec<Candidate<2>>>,
    /// The same as the plan of the start needs them: every run begins with it.
    pub(super) start: Option<Remaining>,
    /// The configuration of each alternative, for activities that a robot's file drives.
    pub(super) configurations: Vec<Vec<Option<usize>>>,
    pub(super) monitor: Monitor<2>,
    /// Whether plans are made again.
    pub(super) adapts: bool,
    /// For each activity what is held back from its start on; empty where nothing is.
    pub(super) holds: Vec<Hold<2>>,
}

impl<'m> Plannable<'m> {
    /// Makes a mission ready to be planned as the options say.
    ///
    /// # Errors
    /// A [`MonitorError`] for limits that cannot be watched.
    pub(crate) fn new(mission: &'m Mission, options: &Options) -> Result<Self, MonitorError> {
        let scenario = mission.scenario();
        let mut monitor = Monitor::new(scenario.limits, scenario.order)?;
        if let Some(upward) = options.upward {
            monitor = monitor.with_upward(upward);
        }
        let activities = scenario.activities();
        let named = |label: &String| {
            let all = &mission.robot()?.robot().configurations;
            let option = |id| mission.tios.iter().find(|it| it.id == id);
            let option = label.split(' ').find_map(option)?;
            all.iter().position(|it| it.name == option.id)
        };
        let configurations = scenario.activities.iter();
        Ok(Self {
            mission,
            planner: options.planner.unwrap_or_else(|| Planner::of(mission)),
            whole: activities.iter().map(whole).collect(),
            start: Remaining::new(&activities, None, scenario.available).ok(),
            configurations: configurations
                .map(|it| it.labels.iter().map(named).collect())
                .collect(),
            activities,
            monitor,
            adapts: !options.rigid,
            holds: options.margins.iter().flat_map(|it| &it.from).map(Promise::hold).collect(),
        })
    }
}

fn whole(activity: &Activity<'_>) -> Vec<Candidate<2>> {
    let alternatives = activity.alternatives.iter().zip(0u16..);
    alternatives.filter_map(|(it, id)| it.candidate(activity.whole(it), id)).collect()
}
