use super::outing;
use cotama_core::units::Millis;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::{Mission, embedded};
use cotama_models::robots::{Incident, IncidentKind, Moment, OwnedTables, supervisors};
use cotama_playground::course::{Course, Mark};
use cotama_playground::{Board, Pilot, encode, encode_tables, outing as page};
use cotama_sim::faults_text::faults_text;
use cotama_sim::options::{FaultChoice, Options};
use cotama_sim::trace::{Record, Trace};

/// A mission with the decider of its page.
struct Stage {
    mission: Mission,
    board: Board,
    pilot: Pilot,
}

impl Stage {
    fn of(name: &str) -> Self {
        let mission = Mission::parse(name, embedded::mission(name).unwrap().text).unwrap();
        let robot = mission.robot().unwrap().robot();
        let system = supervisors::of_mission(robot, &mission.steps());
        let tables = OwnedTables::of(robot, &mission.steps(), &system);
        let bytes = system.with(encode);
        let pilot = Pilot::of(&encode_tables(&tables.view()), &bytes).unwrap();
        Self { board: Board::of(&bytes, true).unwrap(), mission, pilot }
    }

    /// The words that are told, and when, in the simulator and in the page.
    fn both(&self, faults: &Faults) -> [Vec<(u64, String)>; 2] {
        let given = FaultChoice::Given { source: "plan".into(), faults: faults.clone() };
        let options = Options { faults: given, ..Options::default() };
        let (trace, _) = Trace::record(&self.mission, &options).unwrap();
        let told = trace.records.iter().filter_map(|it| match it {
            Record::Told(it) => Some((it.t_us / 1_000, it.event.clone())),
            _ => None,
        });
        let simulated = told.collect();
        let outing = outing(&self.mission, &trace, faults, ("", "")).unwrap();
        let plan = page::plan(&outing.items);
        let course = Course::of(&self.pilot, &self.board, &outing.world, &plan);
        let robot = self.mission.robot().unwrap().robot();
        let system = supervisors::of_mission(robot, &self.mission.steps());
        let tables = OwnedTables::of(robot, &self.mission.steps(), &system);
        let words = |told| {
            let of = tables.view().event(told).unwrap();
            let (name, net) = &system.nets[usize::from(of.component)];
            format!("{name}.{}", net.events[of.id.0 as usize].name)
        };
        let told = course.marks.iter().filter_map(|it| match it.1 {
            Mark::Told(told) => Some((it.0.0, words(told))),
            _ => None,
        });
        [simulated, told.collect()]
    }
}

fn failure(row: usize, at: u64) -> Incident {
    let kind = IncidentKind::Failure { failure: row, until: None };
    Incident { when: Moment::At(Millis(at)), kind }
}

/// Plans of one or two failures, every so many rows: how many there are, of how many the page tells
/// the supervisors the same words in the same order, and of how many each within a second.
fn compared(name: &str, every: usize) -> [usize; 3] {
    let stage = Stage::of(name);
    let rows = stage.mission.robot().unwrap().robot().failures.len();
    let all = (0..rows).step_by(every);
    let one = all.clone().flat_map(|row| [7_000, 61_300].map(|at| vec![failure(row, at)]));
    let two = all.map(|row| vec![failure(row, 20_000), failure((row * 7 + 3) % rows, 35_000)]);
    let mut counts = [0; 3];
    for of_robot in one.chain(two) {
        let faults = Faults { of_robot, ..Faults::default() };
        let [simulated, played] = stage.both(&faults);
        let words = |it: &[(u64, String)]| it.iter().map(|it| it.1.clone()).collect::<Vec<_>>();
        let is_same = words(&simulated) == words(&played);
        let mut pairs = simulated.iter().zip(&played);
        let is_near = is_same && pairs.all(|(a, b)| a.0.abs_diff(b.0) <= 1_000);
        if !is_same {
            println!("{}\n  {:?}\n  {:?}", faults_text(&faults, &stage.mission), simulated, played);
        }
        counts[0] += 1;
        counts[1] += usize::from(is_same);
        counts[2] += usize::from(is_near);
    }
    counts
}

#[test]
fn a_course_tells_the_supervisors_what_the_simulator_tells_them() {
    assert_eq!(compared("delivery", 12), [12, 12, 12]);
}

#[test]
#[ignore = "runs 174 missions: about a quarter of a minute"]
fn courses_of_all_rows_are_nearly_those_of_the_simulator() {
    assert_eq!(compared("delivery", 1), [141, 139, 133]);
    assert_eq!(compared("shift", 1), [33, 33, 13]);
}
