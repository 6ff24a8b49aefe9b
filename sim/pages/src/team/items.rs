//! Tasks over time: the place of their objects, who has them, and how far they are.

use super::tracks::{self, Moment};
use cotama_models::team::scenario::{Place, Scenario, Stage, Take, TaskSpec};
use cotama_sim::fleet::record::Record;
use std::collections::BTreeMap;

/// How far a task is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    /// Nobody works for it yet.
    Waits,
    /// Robots have it.
    Awarded,
    /// A robot has its object on board.
    Carried(usize),
    Done,
    Reported,
}

impl State {
    pub(super) const fn class(self) -> &'static str {
        match self {
            Self::Waits => "waits",
            Self::Awarded => "awarded",
            Self::Carried(_) => "carried",
            Self::Done => "done",
            Self::Reported => "reported",
        }
    }
}

/// A change of a task.
pub(super) struct Change {
    pub(super) t_ms: u64,
    pub(super) state: State,
    /// Pixels of its square; what is on board is drawn beside the robot.
    pub(super) at: [f64; 2],
    /// The robots of the award.
    pub(super) robots: Vec<usize>,
}

/// How far the first square of a task is to the right of its place, and how far squares are apart,
/// in pixels.
const BESIDE: f64 = 20.0;
const APART: f64 = 2.0;
/// The number that stand beside each other.
const ROW: usize = 3;

/// Returns the places where a task begins and ends.
fn ends(task: &TaskSpec) -> [Place; 2] {
    let first = task.plans.first().and_then(|it| it.roles.first());
    match first.map(|it| it.take) {
        Some(Take::Words(place)) => [place; 2],
        _ => [task.start, task.goal],
    }
}

/// Squares beside each place, row upon row.
struct Slots<'p> {
    at: &'p dyn Fn(Place) -> Option<[f64; 2]>,
    side: f64,
    used: BTreeMap<Place, usize>,
}

impl Slots<'_> {
    fn next(&mut self, place: Place) -> [f64; 2] {
        let [x, y] = (self.at)(place).unwrap_or_default();
        let slot = self.used.entry(place).or_default();
        let (row, column) = (*slot / ROW, *slot % ROW);
        *slot += 1;
        let step = self.side + APART;
        [x + BESIDE + step * column as f64, y - step * row as f64]
    }
}

/// Returns the changes of each task, in the order of time; `at` gives the pixels of places, the
/// tracks are those of the robots, and squares have a side.
pub(super) fn changes(
    scenario: &Scenario,
    records: &[Record],
    side: f64,
    at: &dyn Fn(Place) -> Option<[f64; 2]>,
    robots: &[Vec<Moment>],
) -> Vec<Vec<Change>> {
    let mut slots = Slots { at, side, used: BTreeMap::new() };
    let places: Vec<[[f64; 2]; 2]> = scenario
        .tasks
        .iter()
        .map(|task| {
            let [start, goal] = ends(task);
            let first = slots.next(start);
            [first, if start == goal { first } else { slots.next(goal) }]
        })
        .collect();
    let mut all: Vec<Vec<Change>> = scenario.tasks.iter().map(|_| Vec::new()).collect();
    let carries = |task: usize, robot: usize, robots: &[usize], plan: &str| {
        let plan = scenario.tasks.get(task)?.plans.iter().find(|it| it.name == plan)?;
        let role = robots.iter().position(|it| *it == robot)?;
        Some(!matches!(plan.roles.get(role)?.take, Take::Words(_)))
    };
    let mut plans: BTreeMap<usize, (&str, &[usize])> = BTreeMap::new();
    for record in records {
        let (task, t_ms, state) = match record {
            Record::Opened { t_ms, task } => (*task, *t_ms, State::Waits),
            Record::Reopened { t_ms, task } => match last(&all, *task) {
                Some(it @ State::Carried(_)) => (*task, *t_ms, it),
                _ => (*task, *t_ms, State::Waits),
            },
            Record::Awarded { t_ms, task, plan, robots, .. } => {
                plans.insert(*task, (plan, robots));
                let state = match last(&all, *task) {
                    Some(it @ State::Carried(_)) => it,
                    _ => State::Awarded,
                };
                (*task, *t_ms, state)
            }
            Record::Stage { t_ms, robot, task: Some(task), stage: Stage::ToGive } => {
                let has = plans.get(task).and_then(|it| carries(*task, *robot, it.1, it.0));
                if has != Some(true) {
                    continue;
                }
                (*task, *t_ms, State::Carried(*robot))
            }
            Record::Done { t_ms, task, .. } => (*task, *t_ms, State::Done),
            Record::Reported { t_ms, task, .. } => (*task, *t_ms, State::Reported),
            _ => continue,
        };
        let Some([start, goal]) = places.get(task) else { continue };
        let place = match (state, last(&all, task)) {
            (State::Done, _) => *goal,
            (State::Reported, Some(State::Carried(robot))) => {
                robots.get(robot).map_or(*start, |it| tracks::at(it, t_ms))
            }
            _ => *start,
        };
        let team = match state {
            State::Waits | State::Reported => Vec::new(),
            _ => plans.get(&task).map_or_else(Vec::new, |it| it.1.to_vec()),
        };
        if let Some(changes) = all.get_mut(task) {
            changes.push(Change { t_ms, state, at: place, robots: team });
        }
    }
    all
}

fn last(all: &[Vec<Change>], task: usize) -> Option<State> {
    all.get(task)?.last().map(|it| it.state)
}
