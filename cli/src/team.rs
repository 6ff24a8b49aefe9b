//! Teams of robots from the command line: those of the program by their names, and files.

use crate::exit::Failure;
use crate::floor;
use crate::input;
use crate::kind::{self, Kind};
use crate::mission;
use crate::render::numbers::count;
use cotama_core::net::owned::OwnedNet;
use cotama_models::team::protocol::{self, MOST_STEPS, Requirement, requirements};
use cotama_models::team::scenario::{Asked, Scenario};
use cotama_sim::fleet::scenarios::{FleetOptions, ServiceOptions, fleet, service};
use std::path::Path;

/// A scenario of a team.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Team {
    Fleet,
    Service,
}

impl Team {
    /// All, with a line of what they are.
    pub(crate) const ALL: [(Self, &'static str); 2] = [
        (Self::Service, "Four robots serve a drink, with what goes wrong in it (Rohrmueller 2011)"),
        (Self::Fleet, "Forty robots carry two hundred deliveries in an office; some robots fail"),
    ];

    /// Returns the name on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Fleet => "fleet",
            Self::Service => "service",
        }
    }

    /// The one of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().map(|it| it.0).find(|it| it.name() == name)
    }
}

/// A team that comes with the program, or that of a file.
pub(crate) enum Chosen {
    Known(Team),
    /// The team of a file.
    File(Box<Scenario>),
}

impl Chosen {
    /// The team of a name, or of a file that begins as one; none for a mission.
    pub(crate) fn of(name: &str) -> Result<Option<Self>, Failure> {
        if let Some(team) = Team::named(name) {
            return Ok(Some(Self::Known(team)));
        }
        if !kind::is(name, Kind::TeamAtWork) {
            return Ok(None);
        }
        let wanted = [Kind::TeamAtWork];
        let text = kind::text(name, "a team's file", input::MISSION_BYTES, &wanted)?;
        Ok(Some(Self::File(Box::new(read(name, name, &text)?))))
    }

    /// Returns the team with its own faults.
    pub(crate) fn scenario(&self) -> Scenario {
        match self {
            Self::Known(Team::Fleet) => fleet(&FleetOptions::default()),
            Self::Known(Team::Service) => {
                service(&ServiceOptions { disturbances: true, ..ServiceOptions::default() })
            }
            Self::File(scenario) => (**scenario).clone(),
        }
    }

    /// Returns the team as the text of a file.
    pub(crate) fn text(&self) -> String {
        self.scenario().to_toml()
    }
}

/// Reads the file of a team at this path, with the floor that it names.
pub(crate) fn read(path: &str, name: &str, text: &str) -> Result<Scenario, Failure> {
    let folder = Path::new(path).parent();
    let mut robots = Vec::new();
    for of in Scenario::files_of(text) {
        // One that is nowhere is left to the reader of teams, which says where it is named.
        if !mission::is_missing(&of, path) {
            robots.push(mission::robot(&of, folder)?.renamed(&of));
        }
    }
    let ways = match Asked::of(text) {
        Some(asked) => floor::ways(asked, folder, &robots)?,
        None => None,
    };
    Ok(Scenario::parse_on(name, text, ways.as_ref(), &robots)?)
}

/// The protocol of a team, and what is asked of it.
#[derive(Debug)]
pub(crate) struct Protocol {
    pub(crate) net: OwnedNet,
    pub(crate) requirements: Vec<Requirement>,
    /// Notes on the team as it is checked.
    pub(crate) notes: Vec<String>,
}

impl Protocol {
    /// The protocol by which this team gives its tasks out; `None` where its net would be too
    /// large.
    pub(crate) fn of(scenario: &Scenario) -> Option<Self> {
        let team = protocol::Team::from(scenario);
        team.steps()?;
        let net = protocol::net(&team);
        let robots = count(team.robots() as u64, "robot");
        let tasks = count(team.tasks() as u64, "task");
        let failures = match team.failures() {
            0 => "no robot fails, as in its file".to_owned(),
            it => format!("at most {}, as in its file", count(it.into(), "failure")),
        };
        let note = format!(
            "the protocol by which {robots} give out {tasks}, all there from the start; {failures}"
        );
        Some(Self { requirements: requirements(&team, &net), net, notes: vec![note] })
    }
}

/// Why a team has no net.
pub(crate) fn too_large(scenario: &Scenario) -> String {
    let (robots, tasks) = (scenario.robots.len(), scenario.tasks.len());
    format!(
        "the protocol of {robots} robots and {tasks} tasks as a net may have more than \
         {MOST_STEPS} transitions"
    )
}
