//! The modules of a robot under its executive: who publishes in a period, and who is late.

use cotama_core::executive::{Executive, Happening, Request, Task, What};
use cotama_core::units::{Micros, Millis};
use cotama_devices::SettingsError;
use cotama_models::robots::{Harm, Harmed, Module, Robot, Role, Watch};

/// The most scheduled modules of a robot that senses by itself.
const MOST: usize = 32;
/// The time after which a module that publishes nothing counts as silent, in its periods.
const SILENT_AFTER: u64 = 3;

/// The scheduled modules of a robot, the most urgent first.
#[derive(Clone, Debug)]
pub(crate) struct Modules {
    executive: Executive<MOST>,
    all: Vec<Scheduled>,
}

/// A module and its jobs.
#[derive(Clone, Copy, Debug)]
struct Scheduled {
    /// Number in the robot's file.
    number: usize,
    /// The time of a job without that of its particles, and of each of them.
    cost: u64,
    particle: u64,
    localises: bool,
    period: Millis,
    runs: bool,
    pace: Pace,
    /// Since when it runs, or when it published last.
    heard: Micros,
}

/// Jobs of a module since the last one in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pace {
    InTime,
    /// Some have missed their deadline.
    Missed,
    /// So many in a row that it was a fault.
    Late,
}

/// Jobs of a period, as the scheduler observes them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Jobs {
    /// The modules that published, each with the end of its job.
    done: Vec<(usize, Happening)>,
    /// The signals of modules that show themselves.
    shown: Vec<Watch>,
}

impl Jobs {
    /// Whether a signal of modules shows itself in this period.
    pub(crate) fn shows(&self, watch: Watch) -> bool {
        self.shown.contains(&watch)
    }

    /// Returns the end of the job of a module with a role, if it published.
    pub(crate) fn of(&self, robot: &Robot, role: Role) -> Option<&Happening> {
        let has = |it: usize| robot.modules.get(it).is_some_and(|it| it.roles.contains(&role));
        self.done.iter().rev().find(|it| has(it.0)).map(|it| &it.1)
    }
}

impl Modules {
    /// All modules that have a period and a cost, or a role: such a one without times runs in each
    /// period, in next to no time; none runs yet.
    ///
    /// # Errors
    /// More than 32 of them.
    pub(crate) fn new(robot: &Robot) -> Result<Self, SettingsError> {
        let scheduled = |it: &usize| {
            let has_times = |it: &Module| it.period.is_some() && it.cost.is_some();
            robot.modules.get(*it).is_some_and(|it| has_times(it) || !it.roles.is_empty())
        };
        let mut numbers: Vec<_> = (0..robot.modules.len()).filter(scheduled).collect();
        numbers.sort_by_key(|it| robot.modules.get(*it).map(|it| (it.priority, it.deadline)));
        cotama_devices::within("the scheduled modules", numbers.len() as f64, 0.0, MOST as f64)?;
        let idle = Task::new(Micros(100_000), Micros(1));
        let (mut tasks, mut all) = ([idle; MOST], Vec::new());
        for (task, number) in tasks.iter_mut().zip(numbers) {
            let Some(it) = robot.modules.get(number) else { continue };
            let (period, cost) = (it.period.unwrap_or(Millis(100)), it.cost.unwrap_or(Micros(1)));
            let deadline = it.deadline.unwrap_or(period);
            let localises = it.roles.contains(&Role::Localisation);
            let (mut rest, mut particle) = (cost.0, 0);
            for of in &it.parameters {
                if localises && of.name == PARTICLES {
                    particle = of.cost.0;
                } else {
                    rest = rest.saturating_add(of.cost.0.saturating_mul(of.default));
                }
            }
            let whole = it.parameters.iter().map(|it| it.cost.0.saturating_mul(it.default));
            let most = whole.fold(cost.0, u64::saturating_add);
            *task = Task {
                deadline: Micros(deadline.0 * 1_000),
                extra: Micros((period.0 - deadline.0) * 1_000),
                ..Task::new(Micros(period.0 * 1_000), Micros(most))
            };
            all.push(Scheduled {
                number,
                cost: rest,
                particle,
                localises,
                period,
                runs: false,
                pace: Pace::InTime,
                heard: Micros(0),
            });
        }
        // The robot's file was read: its modules make sense, and are in time.
        let mut executive = Executive::new(tasks).map_err(|it| SettingsError {
            name: "the number of a task that makes no sense",
            given: it.task as f64,
            least: MOST as f64,
            most: MOST as f64,
        })?;
        for task in 0..MOST {
            executive.request(task, Request::Kill, Micros(0));
        }
        Ok(Self { executive, all })
    }

    /// Modules begin anew, a bit each: what they missed counts no more.
    pub(crate) fn restart(&mut self, modules: u64) {
        let now = self.executive.now();
        for (task, it) in self.all.iter_mut().enumerate() {
            if it.runs && modules >> it.number & 1 == 1 {
                self.executive.request(task, Request::Kill, now);
                it.runs = false;
            }
        }
    }

    /// Lets the jobs of a period run up to its end, with as many particles as there are. Those run
    /// that are in `runs`, a bit each, but for those that have crashed.
    pub(crate) fn pass(
        &mut self,
        runs: u64,
        harms: &[Harmed],
        particles: usize,
        (now, period): (Millis, Millis),
    ) -> Jobs {
        let begun = Micros((now.0 - period.0) * 1_000);
        let is = |it: &Scheduled, harm: Harm| {
            let mut own = harms.iter().filter(|of| of.harm == harm);
            own.any(|of| usize::from(of.unit) == it.number)
        };
        let mut needs = [Micros(1); MOST];
        for (task, (it, need)) in self.all.iter_mut().zip(&mut needs).enumerate() {
            let works = runs >> it.number & 1 == 1;
            let is_there = works && !is(it, Harm::ModuleCrashed);
            let is_active = self.executive.is_active(task) == Some(true);
            if is_there != is_active {
                let request = if is_there { Request::Activate } else { Request::Kill };
                self.executive.request(task, request, begun);
            }
            if works && !it.runs {
                (it.pace, it.heard) = (Pace::InTime, begun);
            }
            it.runs = works;
            let all = it.cost.saturating_add(it.particle.saturating_mul(particles as u64));
            let longer = harms.iter().filter(|of| {
                let own = of.harm == Harm::ModuleSlow && usize::from(of.unit) == it.number;
                own || of.harm == Harm::ComputerBusy
            });
            let factor = longer.fold(1_000, |all, it| all + u64::from(it.permille));
            *need = Micros((all.saturating_mul(factor) / 1_000).max(1));
        }
        let mut jobs = Jobs::default();
        let end = Micros((now.0 * 1_000).saturating_sub(1));
        while let Some(happening) = self.executive.simulate(end, &needs) {
            if happening.rt_fault() {
                // The decisional level is told by a flag; the module goes on.
                let _ = self.executive.acknowledge(happening.task, happening.at);
            }
            let Some(it) = self.all.get_mut(happening.task) else { continue };
            match (happening.what, it.pace) {
                _ if happening.rt_fault() => it.pace = Pace::Late,
                (What::DeadlineMissed, Pace::InTime) => it.pace = Pace::Missed,
                (What::Done, before) => {
                    it.pace = Pace::InTime;
                    jobs.shown.extend((before == Pace::Missed).then_some(Watch::JobLate));
                }
                _ => {}
            }
            if happening.publication().is_some() {
                it.heard = happening.at;
                if is(it, Harm::ModuleWrong) {
                    // No consumer takes them.
                    jobs.shown.push(Watch::ValueOutside);
                } else {
                    jobs.done.push((it.number, happening));
                }
            }
        }
        for it in self.all.iter().filter(|it| it.runs) {
            let quiet = now.0 * 1_000 - it.heard.0;
            let late = if it.localises { Watch::LocalisationLate } else { Watch::ModuleLate };
            if it.pace == Pace::Late {
                jobs.shown.push(late);
            } else if quiet > (SILENT_AFTER + 1) * it.period.0.max(period.0) * 1_000 {
                jobs.shown.push(Watch::ModuleSilent);
            }
        }
        jobs
    }
}

/// The parameter that bounds the particles of a module that localises.
pub(crate) const PARTICLES: &str = "particles";

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::robots::RobotFile;

    /// Runs the modules of path following for so many periods; counts flags by their name.
    fn run(harms: &[Harmed], periods: u64) -> [u64; 4] {
        let file = RobotFile::shipped("p3dx-delivery").unwrap();
        let robot = file.robot();
        let of = robot.configurations.iter().find(|it| it.name == "PF.OPT").unwrap();
        let mut modules = Modules::new(robot).unwrap();
        let mut found = [0; 4];
        for period in 1..=periods {
            let when = (Millis(period * 100), Millis(100));
            let jobs = modules.pass(of.required | of.optional, harms, 500, when);
            let all =
                [Watch::JobLate, Watch::LocalisationLate, Watch::ModuleLate, Watch::ModuleSilent];
            found.iter_mut().zip(all).for_each(|(all, it)| *all += u64::from(jobs.shows(it)));
        }
        found
    }

    fn module(name: &str) -> u8 {
        let file = RobotFile::shipped("p3dx-delivery").unwrap();
        let at = file.robot().modules.iter().position(|it| it.name == name).unwrap();
        u8::try_from(at).unwrap()
    }

    #[test]
    fn modules_of_a_sound_computer_are_in_time_with_all_particles() {
        assert_eq!(run(&[], 600), [0; 4]);
    }

    #[test]
    fn a_localisation_that_takes_twice_as_long_is_late_from_the_third_job_on() {
        let slow = Harmed { harm: Harm::ModuleSlow, unit: module("MCL"), permille: 1_000 };
        assert_eq!(run(&[slow], 10), [0, 7, 0, 0]); // its third job ends late in the next period
    }

    #[test]
    fn a_module_that_crashed_is_silent_and_not_late() {
        let gone = Harmed { harm: Harm::ModuleCrashed, unit: module("SMZ"), permille: 500 };
        assert_eq!(run(&[gone], 10), [0, 0, 0, 6]);
    }

    #[test]
    fn a_slow_module_that_is_not_the_least_urgent_is_told_from_localisation() {
        let slow = Harmed { harm: Harm::ModuleSlow, unit: module("SMZ"), permille: 20_000 };
        let [_, _, late, silent] = run(&[slow], 10);
        assert_eq!((late, silent), (7, 0));
    }
}
