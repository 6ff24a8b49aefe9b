//! The robot's laptop: the modules under the scheduler of `cotama_core::executive`, period by
//! period, and what the scheduler sees of them.
//!
//! Costs are those of [`load`]; late, silent and hanging modules arise from it: a busier processor
//! makes localisation late, a module that computes too long is skipped, a module that crashed makes
//! nothing any more, and the data of each has an age.

use super::PERIOD;
use cotama_core::executive::{Executive, Latest, Request, Task, Watchdog, What};
use cotama_core::units::{Micros, Millis};
use cotama_models::cotama::load::{COSTS, DEADLINE, EXTRA, MOST, PARTICLE, PARTICLES};
use cotama_models::cotama::{Flag, Flags, Module, Modules};

/// The other work of the processor comes first: it is the most urgent task.
const OTHER_WORK: usize = 0;
/// So much longer is a job that is late once (FMECA, row RT2).
const LATE_ONCE: Micros = Micros(30_000);
/// So many periods without data are silence (FMECA, row SW1).
const SILENCE: u64 = 3;

/// The disturbances of the modules.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Disturbances {
    /// How many other programs want the processor.
    pub(crate) programs: usize,
    /// Modules that compute too long.
    pub(crate) slow: Modules,
    /// Modules that are no more.
    pub(crate) crashed: Modules,
    /// One job of the link to the robot, the most urgent module, takes longer.
    pub(crate) hiccup: bool,
}

/// The observations of the scheduler in a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Seen {
    pub(crate) flags: Flags,
    /// The module that is late or silent, where it is not localisation.
    pub(crate) part: Modules,
}

/// The modules at work.
#[derive(Clone, Debug)]
pub(crate) struct Laptop {
    executive: Executive<MOST>,
    now: Micros,
    wanted: Modules,
    /// Since when a module is wanted, and what it made last.
    since: [Micros; COSTS.len()],
    made: [Latest<()>; COSTS.len()],
    silent: Modules,
    particles: u32,
    /// Under these disturbances every job of the last period was in time, so each further period is
    /// as that one was: the modules' own time stands still meanwhile.
    steady: Option<Disturbances>,
}

impl Laptop {
    pub(crate) fn new() -> Self {
        let task = |task: usize| match COSTS.get(task.wrapping_sub(1)) {
            Some(it) => {
                let cost = cost(it.module, PARTICLES[2]);
                Task { deadline: DEADLINE, extra: EXTRA, ..Task::new(micros(PERIOD), cost) }
            }
            None => Task::new(Micros(10_000), work(1)),
        };
        let tasks: [Task; MOST] = std::array::from_fn(task);
        let mut executive = Executive::new(tasks).expect("the costs of the table make sense");
        for task in 0..MOST {
            executive.request(task, Request::Kill, Micros::ZERO);
        }
        Self {
            executive,
            now: Micros::ZERO,
            wanted: Modules::NONE,
            since: [Micros::ZERO; COSTS.len()],
            made: [const { Latest::empty() }; COSTS.len()],
            silent: Modules::NONE,
            particles: PARTICLES[2],
            steady: None,
        }
    }

    /// Runs the modules requested by the decisional level from now on, with so many particles.
    pub(crate) fn run(&mut self, wanted: Modules, particles: u32) {
        if (wanted, particles) == (self.wanted, self.particles) {
            return;
        }
        self.steady = None;
        for (at, it) in COSTS.iter().enumerate() {
            let (task, module) = (at + 1, it.module);
            match (self.wanted.has(module), wanted.has(module)) {
                (false, true) => {
                    self.since[at] = self.now;
                    self.executive.request(task, Request::Activate, self.now);
                }
                (true, false) => {
                    self.executive.request(task, Request::Kill, self.now);
                    self.silent = self.silent.without(Modules::of(&[module]));
                }
                _ => {}
            }
            if module == Module::Mcl {
                self.executive.request(task, Request::Cost(cost(module, particles)), self.now);
            }
        }
        (self.wanted, self.particles) = (wanted, particles);
    }

    /// The supervisors have answered: modules in fault go on.
    pub(crate) fn answered(&mut self) {
        for task in 0..MOST {
            if self.executive.watchdog(task) == Some(Watchdog::Fault) {
                let _ = self.executive.acknowledge(task, self.now);
            }
        }
    }

    /// A period of work.
    pub(crate) fn work(&mut self, disturbed: Disturbances) -> Seen {
        if self.steady == Some(disturbed) {
            return Seen::default();
        }
        let (mut seen, end) = (Seen::default(), Micros(self.now.0 + micros(PERIOD).0));
        self.disturb(disturbed);
        let mut needs = self.executive.tasks().map(|it| it.cost);
        for (it, need) in COSTS.iter().zip(&mut needs[1..]) {
            if disturbed.slow.has(it.module) {
                *need = Micros(u64::from(u32::MAX)); // whatever its budget is
            }
            if disturbed.hiccup && it.module == Module::P3d {
                need.0 += LATE_ONCE.0;
            }
        }
        let mut missed = [0; MOST];
        // Events due when the period ends belong to the next one, after its requests.
        let last = Micros(end.0 - 1);
        loop {
            for (task, before) in missed.iter_mut().enumerate() {
                *before = self.executive.misses(task).unwrap_or(0);
            }
            let Some(it) = self.executive.simulate(last, &needs) else { break };
            let Some(at) = it.task.checked_sub(1) else { continue };
            let module = COSTS[at].module;
            if let Some(right) = it.publication() {
                self.made[at].publish(right, ());
            }
            match it.what {
                // The module was late before, and has caught up.
                What::Done if missed[it.task] > 0 => seen.flags = seen.flags.with(Flag::OneLate),
                _ if it.rt_fault() && module == Module::Mcl => {
                    seen.flags = seen.flags.with(Flag::MclLate);
                }
                _ if it.rt_fault() => seen.names(Flag::ModuleLate, module),
                _ => {}
            }
        }
        self.now = end;
        self.listen(&mut seen);
        let in_time = |task| {
            let at_rest = self.executive.watchdog(task) == Some(Watchdog::Idle);
            at_rest && self.executive.misses(task) == Some(0)
        };
        let gone = !disturbed.crashed.common(self.wanted).is_empty();
        let steady = !gone && seen == Seen::default() && (0..MOST).all(in_time);
        self.steady = steady.then_some(disturbed);
        seen
    }

    /// Whether each further period under these disturbances is as the last one was.
    pub(crate) fn is_steady(&self, disturbed: Disturbances) -> bool {
        self.steady == Some(disturbed)
    }

    /// The age of what a module made last; none before it made anything.
    pub(crate) fn age(&self, module: Module) -> Option<Millis> {
        let at = COSTS.iter().position(|it| it.module == module)?;
        self.made[at].read(self.now).map(|((), age)| Millis(age.0 / 1_000))
    }

    /// Programs come and go, modules crash and start again.
    fn disturb(&mut self, disturbed: Disturbances) {
        let (now, executive) = (self.now, &mut self.executive);
        if disturbed.programs > 0 {
            executive.request(OTHER_WORK, Request::Cost(work(disturbed.programs)), now);
            executive.request(OTHER_WORK, Request::Activate, now);
        } else {
            executive.request(OTHER_WORK, Request::Stop, now);
        }
        for (it, task) in COSTS.iter().zip(1..).filter(|(it, _)| self.wanted.has(it.module)) {
            let crashed = disturbed.crashed.has(it.module);
            let request = if crashed { Request::Kill } else { Request::Activate };
            executive.request(task, request, now);
        }
    }

    /// Raises flags of modules whose data is too old, and of those without a job: silent.
    fn listen(&mut self, seen: &mut Seen) {
        for (at, it) in COSTS.iter().enumerate() {
            let gone = self.executive.is_active(at + 1) == Some(false);
            let last = self.made[at].read(self.now).map_or(self.now.0, |((), age)| age.0);
            let silence = last.min(self.now.0 - self.since[at].0);
            let only = Modules::of(&[it.module]);
            if !gone || !self.wanted.has(it.module) {
                self.silent = self.silent.without(only);
            } else if silence >= SILENCE * micros(PERIOD).0 && !self.silent.has(it.module) {
                self.silent = self.silent.union(only);
                seen.names(Flag::ModuleSilent, it.module);
            }
        }
    }
}

impl Seen {
    fn names(&mut self, flag: Flag, module: Module) {
        self.flags = self.flags.with(flag);
        self.part = self.part.with(module);
    }
}

/// The modules whose jobs are those of these: parts of a module run in its jobs, and the scheduler
/// runs all.
pub(crate) fn jobs(modules: Modules) -> Modules {
    if modules.has(Module::Sch) {
        return COSTS.iter().fold(Modules::NONE, |all, it| all.with(it.module));
    }
    modules.iter().map(|it| it.facts().part_of.unwrap_or(it)).fold(Modules::NONE, Modules::with)
}

const fn micros(time: Millis) -> Micros {
    Micros(time.0 * 1_000)
}

/// Returns the cost of a job of a module.
fn cost(module: Module, particles: u32) -> Micros {
    let base = COSTS.iter().find(|it| it.module == module).map_or(0, |it| it.cost.0);
    let particles = if module == Module::Mcl { u64::from(particles) } else { 0 };
    Micros(base + particles * PARTICLE.0)
}

/// Returns the load of other programs in every 10 ms: 3 ms, 4 ms as the heaviest load for which the
/// floor of particles is meant, then 5 ms.
const fn work(programs: usize) -> Micros {
    Micros(match programs {
        0 | 1 => 3_000,
        2 => 4_000,
        _ => 5_000,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_models::cotama::Configuration::{FollowingOdometric, FollowingOptimal};

    const QUIET: Disturbances =
        Disturbances { programs: 0, slow: Modules::NONE, crashed: Modules::NONE, hiccup: false };

    fn following(particles: u32) -> Laptop {
        let mut laptop = Laptop::new();
        laptop.run(FollowingOptimal.scheduled(), particles);
        laptop
    }

    /// Returns the observations in each of so many periods.
    fn seen(laptop: &mut Laptop, disturbed: Disturbances, periods: usize) -> Vec<Seen> {
        (0..periods).map(|_| laptop.work(disturbed)).collect()
    }

    #[test]
    fn a_sound_laptop_is_in_time_with_all_particles() {
        let mut laptop = following(PARTICLES[2]);
        assert_eq!(seen(&mut laptop, QUIET, 100), [Seen::default(); 100]);
        assert_eq!(laptop.age(Module::Mcl), Some(Millis(20)));
        assert_eq!(laptop.now, micros(PERIOD)); // the first period stands for all
        assert_eq!(laptop.age(Module::Dvz), None); // it does not run here
    }

    #[test]
    fn each_further_program_takes_a_level_of_particles() {
        // Skipped, it is late when its extra time ends; done late, when it is done.
        for (programs, level, after) in [(1, 1, 3), (2, 0, 2)] {
            let busy = Disturbances { programs, ..QUIET };
            let mut laptop = following(PARTICLES[level + 1]);
            let flags: Vec<_> = seen(&mut laptop, busy, 4).into_iter().map(|it| it.flags).collect();
            let late =
                |period| if period == after { Flags::of(&[Flag::MclLate]) } else { Flags::NONE };
            assert_eq!(flags, [0, 1, 2, 3].map(late));
            laptop.run(FollowingOptimal.scheduled(), PARTICLES[level]);
            laptop.answered();
            assert_eq!(seen(&mut laptop, busy, 50), [Seen::default(); 50]);
        }
        let mut laptop = following(PARTICLES[0]);
        let too_busy = Disturbances { programs: 3, ..QUIET };
        assert!(seen(&mut laptop, too_busy, 3)[2].flags.has(Flag::MclLate));
        laptop.run(FollowingOdometric.scheduled(), PARTICLES[0]);
        laptop.answered();
        assert_eq!(seen(&mut laptop, too_busy, 50), [Seen::default(); 50]);
    }

    #[test]
    fn a_module_that_computes_too_long_is_late_and_one_that_crashed_is_silent() {
        let smz = Modules::of(&[Module::Smz]);
        let late = Seen { flags: Flags::of(&[Flag::ModuleLate]), part: smz };
        let silent = Seen { flags: Flags::of(&[Flag::ModuleSilent]), part: smz };
        let none = Seen::default();
        let slow = Disturbances { slow: smz, ..QUIET };
        // In fault it stands still until it is answered.
        let mut laptop = following(PARTICLES[0]);
        assert_eq!(seen(&mut laptop, slow, 6), [none, none, none, late, none, none]);
        let crashed = Disturbances { crashed: smz, ..QUIET };
        let mut laptop = following(PARTICLES[0]);
        assert_eq!(seen(&mut laptop, QUIET, 2), [none; 2]);
        assert_eq!(seen(&mut laptop, crashed, 5), [none, none, silent, none, none]);
        assert_eq!(laptop.age(Module::Smz).map(|it| it.0 / 100), Some(5));
        // The module starts again.
        assert_eq!(seen(&mut laptop, QUIET, 3), [none; 3]);
        assert_eq!(laptop.age(Module::Smz).map(|it| it.0 / 100), Some(0));
    }

    #[test]
    fn one_late_job_is_said_when_the_next_is_in_time() {
        let mut laptop = following(PARTICLES[0]);
        let hiccup = Disturbances { hiccup: true, ..QUIET };
        assert_eq!(laptop.work(hiccup), Seen::default());
        assert_eq!(laptop.work(QUIET).flags, Flags::of(&[Flag::OneLate]));
        assert_eq!(laptop.work(QUIET), Seen::default());
    }
}
