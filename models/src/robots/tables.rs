//! The tables by which a robot's decisional level works: numbers of the parts of its supervisors,
//! found by their names once, and facts.

use super::supervisors::{OwnedSystem, Step, begins, lost, place_of, word};
use super::{Failure, Robot};
use crate::level::{
    self, Act, Acting, Configuration, Loss, Mask, Report, Setting, SubObjective, Tables,
};
use cotama_core::net::{EventId, PlaceId, TransitionId};
use cotama_core::system::{Of, System};

/// The tables of a robot with the objectives of its mission, on the heap.
///
/// ```
/// use cotama_core::units::Millis;
/// use cotama_models::level::{Cause, Decider, Level, Told, Where};
/// use cotama_models::robots::{OwnedTables, Robot, supervisors};
/// use cotama_core::player::Packed;
///
/// let robot = Robot::shipped("transport").unwrap();
/// let system = supervisors::system(&robot);
/// let tables = OwnedTables::of(&robot, &[], &system);
/// let tables = tables.view();
/// system.with(|system| {
///     let packed = Packed::<8, 0, 256>::of(system).unwrap();
///     let mut level = Level::start(&tables, packed.load(system));
///     assert!(level.tell(Millis(0), Told::Begins, Cause(0), &mut ()));
///     level.round(Millis(100), &mut ());
///     let first = Where::Runs { sub_objective: 0, configuration: 0 };
///     assert_eq!(level.place(), first);
///     // A lidar that shows no return is lost: what waits is told in the next period.
///     let mut decider = Decider::new(level);
///     decider.report(robot.failure("LID1").unwrap(), Cause(1));
///     assert_eq!(decider.next_untold(), Some((Told::Report(0), Cause(1))));
/// });
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OwnedTables {
    fixed: Tables<'static>,
    steps: Vec<level::Step>,
    sub_objectives: Vec<SubObjective>,
    configurations: Vec<Configuration>,
    losses: Vec<Loss>,
    reports: Vec<Report>,
    failures: Vec<level::Failure>,
    masks: Vec<Mask>,
    acting: Vec<Acting>,
}

impl OwnedTables {
    /// The tables of a robot; the system is that of
    /// [`of_mission`](super::supervisors::of_mission) of the same robot and the same objectives.
    pub fn of(robot: &Robot, steps: &[Step], system: &OwnedSystem) -> Self {
        system.with(|system| Self::found(robot, steps, system))
    }

    fn found(robot: &Robot, steps: &[Step], system: &System<'_>) -> Self {
        let parts = Parts(system);
        let acting = parts.acting(robot);
        let gs = |name: &str| parts.place("gs", name);
        let fixed = Tables {
            begins: parts.event("gs", begins(steps)),
            stopped: parts.event("gs", "stopped"),
            gives_up: robot.operator.map(|_| parts.event("operator", "gives_up")),
            before: gs("Wait"),
            done: (!steps.is_empty()).then(|| gs("Done")),
            secures: gs("Security"),
            safe: gs("Safe"),
            waits: parts.place("ls", "Waits"),
            granted: parts.place("permit", "Granted"),
            destroyed: parts.place("permit", "Destroyed"),
            steps: &[],
            sub_objectives: &[],
            configurations: &[],
            losses: &[],
            reports: &[],
            failures: &[],
            masks: &[],
            acting: &[],
        };
        let drive = steps.is_empty().then(|| level::Step { place: gs("Drive"), over: None });
        let does = steps.iter().map(|it| level::Step {
            place: gs(&it.place()),
            over: it.ends.as_ref().map(|it| parts.event("gs", it)),
        });
        Self {
            fixed,
            steps: drive.into_iter().chain(does).collect(),
            sub_objectives: parts.sub_objectives(robot),
            configurations: parts.configurations(robot),
            losses: parts.losses(robot),
            reports: parts.reports(robot),
            failures: robot.failures.iter().enumerate().map(|it| failure(robot, it)).collect(),
            masks: masking(robot).map(|(report, it)| mask(robot, report, it)).collect(),
            acting,
        }
    }

    /// Lends them.
    pub fn view(&self) -> Tables<'_> {
        Tables {
            steps: &self.steps,
            sub_objectives: &self.sub_objectives,
            configurations: &self.configurations,
            losses: &self.losses,
            reports: &self.reports,
            failures: &self.failures,
            masks: &self.masks,
            acting: &self.acting,
            ..self.fixed
        }
    }
}

/// The parts of a system by their names. A name that is not there is a mistake of the program.
struct Parts<'s>(&'s System<'s>);

impl Parts<'_> {
    fn component(&self, net: &str) -> u16 {
        let at = self.0.components.iter().position(|it| it.name == net);
        debug_assert!(at.is_some(), "the net {net}");
        at.map_or(u16::MAX, |it| it as u16)
    }

    fn place(&self, net: &str, name: &str) -> Of<PlaceId> {
        let component = self.component(net);
        let of = self.0.components.get(usize::from(component));
        let id = of.and_then(|of| of.net.places.iter().position(|it| it.name == name));
        debug_assert!(id.is_some(), "the place {net}.{name}");
        Of { component, id: PlaceId(id.map_or(u32::MAX, |it| it as u32)) }
    }

    fn event(&self, net: &str, name: &str) -> Of<EventId> {
        let component = self.component(net);
        let of = self.0.components.get(usize::from(component));
        let id = of.and_then(|of| of.net.events.iter().position(|it| it.name == name));
        debug_assert!(id.is_some(), "the event {net}.{name}");
        Of { component, id: EventId(id.map_or(u32::MAX, |it| it as u32)) }
    }

    fn sub_objectives(&self, robot: &Robot) -> Vec<SubObjective> {
        let all = robot.sub_objectives.iter().map(|it| {
            let name = word(&it.name);
            let said = |word: &str| self.event("operator", &format!("{word}_{name}"));
            SubObjective {
                place: self.place("ls", &name),
                mode: it.mode,
                moves: it.moves,
                reached: self.event("ls", &format!("{name}_done")),
                operator: (it.mode == super::Mode::Operator)
                    .then(|| [said("choose"), said("finish")]),
            }
        });
        all.collect()
    }

    fn configurations(&self, robot: &Robot) -> Vec<Configuration> {
        let all = robot.configurations.iter().enumerate().map(|(number, it)| {
            let of = robot.sub_objectives.get(it.sub_objective);
            let has_adapter = of.is_some_and(|it| it.configurations.len() > 1);
            let name = place_of(robot, number);
            let place = name.split_once('.').filter(|_| has_adapter);
            Configuration {
                place: place.map(|(net, place)| self.place(net, place)),
                sub_objective: it.sub_objective as u8,
                speed: it.speed,
            }
        });
        all.collect()
    }

    fn losses(&self, robot: &Robot) -> Vec<Loss> {
        let all = robot.losses.losses.iter().enumerate().map(|(number, it)| Loss {
            place: self.place("gom", &lost(robot, number)),
            modules: it.modules,
            back: it.returns.then(|| self.event("faults", &format!("works_{}", word(&it.name)))),
        });
        all.collect()
    }

    fn reports(&self, robot: &Robot) -> Vec<Report> {
        let all = robot.losses.reports.iter().map(|it| Report {
            event: self.event("faults", &format!("fail_{}", word(&it.name))),
            sets: it.sets.as_ref().map(|it| Setting {
                speed: it.speed,
                mode: it.mode,
                holds: it.holds,
                mends: it.mends,
            }),
        });
        all.collect()
    }

    fn acting(&self, robot: &Robot) -> Vec<Acting> {
        let component = self.component("gom");
        let of = self.0.components.get(usize::from(component));
        let transitions = of.into_iter().flat_map(|it| it.net.transitions.iter().zip(0..));
        let all = transitions.filter_map(|(_, id)| {
            let transition = Of { component, id: TransitionId(id) };
            let fired = super::fired(robot, self.0, transition)?;
            let mask = |report| masking(robot).position(|it| it.0 == report);
            let acts = [
                fired.restarts.map(|module| Act::Restart(module as u8)),
                fired.sets.map(|report| Act::Set(report as u8)),
                fired.asks.map(|report| Act::Ask(report as u8)),
                fired.masks.and_then(mask).map(|mask| Act::Hide(mask as u8)),
            ];
            Some(acts.into_iter().flatten().map(move |act| Acting { transition, act }))
        });
        all.flatten().collect()
    }
}

/// The reports that mask flags, by number.
fn masking(robot: &Robot) -> impl Iterator<Item = (usize, &super::Mask)> {
    let all = robot.losses.reports.iter().enumerate();
    all.filter_map(|it| Some((it.0, it.1.masks.as_ref()?)))
}

fn mask(robot: &Robot, report: usize, it: &super::Mask) -> Mask {
    let flags = it.flags.iter().fold(0, |set, flag| set | 1 << flag);
    let loss = robot.losses.reports.get(report).and_then(|it| it.loss).map(|it| it as u8);
    Mask { report: report as u8, loss, flags, lasts: it.lasts, on_order: it.on_order }
}

/// A failure as the level diagnoses it.
pub(super) fn failure(robot: &Robot, (number, it): (usize, &Failure)) -> level::Failure {
    let reports = &robot.losses.reports;
    let report = reports.iter().position(|it| it.failures.contains(&number));
    let set = |flags: &[usize]| flags.iter().fold(0, |set, flag| set | 1 << flag);
    level::Failure {
        flags: set(&it.flags),
        sometimes: set(&it.sometimes),
        report: report.unwrap_or(level::MAX_REPORTS) as u8,
        worst: it.autonomous.max(it.operator),
        persistence: it.persistence,
    }
}
