//! The supervisors of the robots of a team: made of each file once, and shared by its robots.

use cotama_core::player::{Loaded, Packed};
use cotama_core::units::{Millis, Milliwatts};
use cotama_models::level::{Cause, Level, Tables, Told};
use cotama_models::robots::supervisors;
use cotama_models::robots::{Body, OwnedTables, Robot, RobotFile};
use cotama_models::team::scenario::{self, SLOTS, WORDS};
use std::sync::{Mutex, PoisonError};

/// The supervisors of a robot, running.
pub(super) type Supervisors = Level<'static, Loaded<'static, WORDS, 0, SLOTS>, WORDS, 0, SLOTS>;

/// The parts that all robots of a file share.
#[derive(Debug)]
pub(super) struct Kind {
    pub(super) robot: &'static Robot,
    pub(super) body: &'static Body,
    pub(super) tables: Tables<'static>,
    /// The supervisors of a robot without a task of which nothing is known to be lost.
    at_rest: Supervisors,
    /// The number of the observation module among the nets.
    pub(super) observation: Option<usize>,
    /// The power of the hardware of each configuration.
    powers: Vec<Milliwatts>,
}

/// A module is started anew, or set, no more often before a report of it is told.
const MOST_TRIES: usize = 20;

/// The kinds that were made so far: one for each robot's file, kept for good.
static KINDS: Mutex<Vec<(RobotFile, &'static Kind)>> = Mutex::new(Vec::new());

/// Returns the kind of the robots of this file.
pub(super) fn kind_of(file: &RobotFile) -> &'static Kind {
    let mut kinds = KINDS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = kinds.iter().find(|it| it.0 == *file) {
        return known.1;
    }
    let kind: &'static Kind = Box::leak(Box::new(Kind::of(Box::leak(Box::new(file.clone())))));
    kinds.push((file.clone(), kind));
    kind
}

impl Kind {
    /// Makes the supervisors of a robot's file, which the reader of teams found to be playable.
    fn of(file: &'static RobotFile) -> Self {
        let robot = file.robot();
        let steps = scenario::steps();
        let system = supervisors::of_mission(robot, &steps);
        let tables = Box::leak(Box::new(OwnedTables::of(robot, &steps, &system)));
        let tables: &'static Tables<'static> = Box::leak(Box::new(tables.view()));
        let system = system.leak();
        let packed = Packed::of(&system).expect("a team's robots can be played");
        let packed: &'static Packed<WORDS, 0, SLOTS> = Box::leak(Box::new(packed));
        let configurations = 0..robot.configurations.len();
        Self {
            robot,
            body: robot.body.as_ref().expect("a team's robots have bodies"),
            tables: *tables,
            at_rest: Level::start(tables, packed.load(&system)),
            observation: system.components.iter().position(|it| it.name == "gom"),
            powers: configurations.map(|it| scenario::power(robot, it)).collect(),
        }
    }

    /// The supervisors of a robot without a task to which these reports were told before: what is
    /// lost stays known.
    pub(super) fn at_rest(&self, told: &[usize]) -> Supervisors {
        let (mut level, none) = (self.at_rest, Cause(0));
        for &report in told {
            let loss = self.robot.losses.reports.get(report).and_then(|it| it.loss);
            let Some(loss) = loss else { continue };
            for _ in 0..MOST_TRIES {
                if level.lost() >> loss & 1 == 1 {
                    break;
                }
                // Told, observed, decided.
                level.tell(Millis(0), Told::Report(report), none, &mut ());
                level.round(Millis(0), &mut ());
                level.round(Millis(0), &mut ());
            }
        }
        level
    }

    /// Returns the power of the hardware in a configuration.
    pub(super) fn power(&self, configuration: Option<usize>) -> Milliwatts {
        configuration.and_then(|it| self.powers.get(it)).copied().unwrap_or(Milliwatts(0))
    }

    /// Returns the period of the control loop and of rounds, in ms.
    pub(super) fn period(&self) -> u64 {
        self.body.period.0.max(1)
    }
}
