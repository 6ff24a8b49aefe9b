//! The lanes of a robot's supervisors on a timeline, and the colours of their places.

use cotama_core::net::Role;
use cotama_models::missions::Mission;
use cotama_models::robots::{Mode, Robot, supervisors};
use std::collections::BTreeMap;

/// A lane: a net of the supervisors.
pub(super) struct Lane {
    pub(super) net: String,
    pub(super) label: String,
    /// The place in which it rests: there it has no bar.
    pub(super) rest: String,
}

/// Lanes and colours.
#[derive(Default)]
pub(super) struct Lanes {
    pub(super) all: Vec<Lane>,
    /// A class of [`COLOURS`] for each name.
    tints: BTreeMap<String, &'static str>,
}

/// The legend of the colours, in the order of the legend: a class, and words.
pub(super) const COLOURS: [(&str, &str); 7] = [
    ("f0", "the robot alone, with its best modules"),
    ("f2", "degraded: less is used"),
    ("f3", "the robot stands, the operator is asked or edits"),
    ("f4", "the operator drives"),
    ("f5", "motion is granted"),
    ("f6", "planning, standing at an objective"),
    ("gone", "stopped for good"),
];

/// The most characters of a lane's name.
const MOST: usize = 11;

impl Lanes {
    /// Returns the lanes of the supervisors of a mission; none of a plain one.
    pub(super) fn of(mission: Option<&Mission>) -> Self {
        let Some((mission, file)) = mission.and_then(|it| Some((it, it.robot()?))) else {
            return Self::default();
        };
        let robot = file.robot();
        let system = supervisors::of_mission(robot, &mission.steps());
        let inside = ["gom", "cs", "faults", "operator"];
        let nets = system.nets.iter().filter(|it| !inside.contains(&it.0.as_str()));
        let lane = |(name, net): &(String, cotama_core::net::owned::OwnedNet)| {
            let is_rest = |it: &&cotama_core::net::owned::OwnedPlace| {
                it.initial > 0 && it.role == Role::State
            };
            let label = match name.as_str() {
                "gs" => "Global".to_owned(),
                "ls" => "Local".to_owned(),
                "permit" => "Permit".to_owned(),
                name => {
                    let parts = robot.sub_objectives.iter();
                    let of = { parts }.find(|it| it.name.eq_ignore_ascii_case(name));
                    shortened(of.map_or(name, |it| &it.name))
                }
            };
            let rest =
                net.places.iter().find(is_rest).map_or_else(String::new, |it| it.name.clone());
            Lane { net: name.clone(), label, rest }
        };
        Self { all: nets.map(lane).collect(), tints: tints(mission, robot) }
    }

    /// The colour of a place, a mode or a configuration. The label says the same.
    pub(super) fn tint(&self, name: &str) -> &'static str {
        self.tints.get(name).copied().unwrap_or("f6")
    }
}

/// A name as the margin holds it.
fn shortened(name: &str) -> String {
    if name.chars().count() <= MOST {
        return name.to_owned();
    }
    name.chars().take(MOST - 1).chain(['…']).collect()
}

fn tints(mission: &Mission, robot: &Robot) -> BTreeMap<String, &'static str> {
    let fixed = [
        ("autonomous", "f0"),
        ("hand-over", "f3"),
        ("teleprogrammed", "f3"),
        ("teleoperated", "f4"),
        ("Waits", "f3"),
        ("Granted", "f5"),
        ("Security", "gone"),
        ("Safe", "gone"),
        ("Destroyed", "gone"),
    ];
    let mut tints: BTreeMap<String, &'static str> =
        fixed.into_iter().map(|it| (it.0.to_owned(), it.1)).collect();
    // Places of nets have `_` where names have other letters.
    let mut add = |name: &str, tint: &'static str| {
        let place: String =
            name.chars().map(|it| if it.is_ascii_alphanumeric() { it } else { '_' }).collect();
        tints.insert(place, tint);
        tints.insert(name.to_owned(), tint);
    };
    for it in mission.steps() {
        add(&it.name, if it.drives() { "f0" } else { "f6" });
    }
    for part in &robot.sub_objectives {
        let best = match (part.mode, part.moves) {
            (Mode::Autonomous, true) => "f0",
            (Mode::Autonomous, false) => "f6",
            (Mode::Operator, true) => "f4",
            (Mode::Operator, false) => "f3",
        };
        add(&part.name, best);
        for (rank, it) in part.configurations.iter().enumerate() {
            let name = robot.configurations.get(*it).map_or("", |it| it.name.as_str());
            add(name, if rank == 0 { best } else { "f2" });
        }
    }
    tints
}
