//! The robot on its mission: where it is, what it used, what it plans; one step after the other.
//!
//! *Exactness.* Time is counted in µs, positions in nm (mm/s times µs), energy in pJ (µW times µs),
//! all without rounding, but that a leg ends at the first whole µs at which its end is reached. The
//! monitor sees the time and the energy used, rounded half up to ms and mJ. The planned rest of the
//! current activity is rounded as the mission files say: the duration of the rest of the way, half
//! up to ms, and the energy that the modelled power takes in it, half up to mJ. A replan takes the
//! rest of the way rounded up to mm.
//!
//! *Order.* On arrival at a place, first what happens there, with a check after each event, then
//! the next activity, with a check as it starts. An event on the border of two activities happens
//! at the end of the one that arrives. While the robot is held up it is checked in the periods of
//! the monitor, as on its way.

use crate::kernel::Queue;
use crate::plan::{NM_PER_MM, Planning, Progress};
use crate::record::{Recorder, Silent};
use crate::run::{EventCounts, NoPlan, Outcome, Reason, Run};
use crate::setup::{Course, Pending, SetupError, Simulation};
use cotama_core::hardware::Equipment;
use cotama_core::units::Millimetres;
use cotama_models::missions::faults::Faults;
use cotama_models::missions::tables::Alternative;
use hindrance::Hindrance;
use std::borrow::Cow;

mod checks;
mod happenings;
mod hindrance;
mod records;

/// The next event.
#[derive(Clone, Copy, Debug)]
enum Next {
    /// The end of the leg: an event, a border, or the end of the activity; of a hindrance, if the
    /// robot is held up.
    Arrival,
    /// A check of the margins.
    Check,
}

/// The pace of an activity from here on: its alternative under the real power of this place.
#[derive(Clone, Copy, Debug)]
struct Leg {
    alternative: Alternative,
    /// The real power in µW.
    real_uw: u64,
}

/// A robot on its mission. A clone goes on exactly as the original does.
///
/// ```
/// use cotama_models::missions::{Mission, embedded};
/// use cotama_sim::record::Silent;
/// use cotama_sim::{options::Options, setup::Simulation, world::World};
/// let patrol = embedded::mission("patrol").unwrap();
/// let mission = Mission::parse(patrol.name, patrol.text).unwrap();
/// let simulation = Simulation::new(&mission, &Options::default()).unwrap();
/// let mut world = World::start(&simulation, 0, &mut Silent).unwrap();
/// while world.x_nm() < 1_000_000_000 {
///     assert!(world.step(&mut Silent).is_none()); // still under way
/// }
/// assert_eq!(world.time_us(), 3_000_000); // 1 m, seen at the next check of the margins
/// ```
#[derive(Clone, Debug)]
pub struct World<'s> {
    simulation: &'s Simulation<'s>,
    queue: Queue<Next>,
    events: Cow<'s, [Pending]>,
    next_event: usize,
    segments: Cow<'s, [(u64, u64)]>,
    time_us: u64,
    energy_pj: u128,
    x_nm: u64,
    /// End of the current leg, in nm, if it travels.
    leg_end_nm: u64,
    /// Rest of the current activity, if it does not travel, in µs.
    standing_us: u64,
    /// Whether the current activity has not begun to take time; what does not travel is then
    /// replanned whole.
    fresh: bool,
    /// The current activity, and whether it is done (the next one starts after what happens here).
    activity: usize,
    done: bool,
    leg: Leg,
    /// The hindrance that holds the robot up.
    hindrance: Option<Hindrance>,
    /// Whether the first activity has begun: what happens at the start comes before it.
    begun: bool,
    segment: usize,
    planning: Planning<'s>,
    available: Equipment,
    /// The hardware that failed last, and how many units of it: what a request for it is about.
    lost: (usize, u8),
    checked_us: Option<u64>,
    checks: u64,
    counts: EventCounts,
    ended: Option<(Outcome, Option<Reason>)>,
}

impl Simulation<'_> {
    /// Runs the mission, without a trace.
    ///
    /// # Errors
    /// [`NoPlan`] when there is no plan at the start; nothing is run then.
    pub fn run(&self, seed: u64) -> Result<Run, NoPlan> {
        self.run_recorded(seed, &mut Silent)
    }

    /// Runs the mission with these scripted faults in place of its own, without a trace; random
    /// events of either are left out, as whoever draws faults has drawn them.
    ///
    /// # Errors
    /// A [`SetupError`] for faults of another mission; inside, [`NoPlan`] when there is no plan at
    /// the start.
    pub fn run_with(&self, faults: &Faults) -> Result<Result<Run, NoPlan>, SetupError> {
        let course = self.course(faults)?;
        Ok(World::start_on(self, course, &mut Silent).map(|mut world| {
            loop {
                if let Some(run) = world.step(&mut Silent) {
                    return run;
                }
            }
        }))
    }

    /// Runs the mission and records what happens.
    ///
    /// # Errors
    /// [`NoPlan`] when there is no plan at the start; nothing is run or recorded then.
    pub fn run_recorded<R: Recorder>(&self, seed: u64, recorder: &mut R) -> Result<Run, NoPlan> {
        let mut world = World::start(self, seed, recorder)?;
        loop {
            if let Some(run) = world.step(recorder) {
                return Ok(run);
            }
        }
    }
}

impl<'s> World<'s> {
    /// A robot at the start of its mission, with its first plan.
    ///
    /// # Errors
    /// [`NoPlan`] when there is none.
    pub fn start<R: Recorder>(
        simulation: &'s Simulation<'s>,
        seed: u64,
        recorder: &mut R,
    ) -> Result<Self, NoPlan> {
        let segments = Cow::Borrowed(simulation.segments.as_slice());
        let course = Course { events: simulation.events(seed), segments };
        Self::start_on(simulation, course, recorder)
    }

    /// A robot at the start of its mission, which meets this on its way.
    fn start_on<R: Recorder>(
        simulation: &'s Simulation<'s>,
        course: Course<'s>,
        recorder: &mut R,
    ) -> Result<Self, NoPlan> {
        let of = &simulation.plannable;
        let x_start = of.activities.first().map_or(Millimetres(0), |activity| activity.x_start);
        let (start, available) = (Progress::start(x_start), simulation.all_hardware());
        let planning = Planning::start(of, &start, available)?;
        let nothing = Alternative::standing(0, 0, Equipment::NONE, 0);
        let mut world = Self {
            simulation,
            queue: Queue::new(),
            events: course.events,
            segments: course.segments,
            next_event: 0,
            time_us: 0,
            energy_pj: 0,
            x_nm: start.x_nm,
            leg_end_nm: 0,
            standing_us: 0,
            fresh: true,
            activity: 0,
            done: false,
            leg: Leg { alternative: nothing, real_uw: 0 },
            hindrance: None,
            begun: false,
            segment: 0,
            planning,
            available,
            lost: (0, 0),
            checked_us: None,
            checks: 0,
            counts: EventCounts::default(),
            ended: None,
        };
        world.find_segment();
        world.set_leg();
        world.record_plan(recorder);
        world.proceed(recorder);
        Ok(world)
    }

    /// Goes on to the next thing that happens; the result when the mission is over.
    pub fn step<R: Recorder>(&mut self, recorder: &mut R) -> Option<Run> {
        if self.ended.is_none() {
            match self.queue.pop() {
                Some((time_us, Next::Check)) => {
                    self.advance(time_us);
                    let plans = self.planning.made.len();
                    self.check(recorder);
                    if self.planning.made.len() > plans {
                        self.schedule();
                    } else if self.ended.is_none() {
                        self.push_check();
                    }
                }
                Some((time_us, Next::Arrival)) => {
                    self.advance(time_us);
                    if self.hindrance.is_some() {
                        self.freed(recorder);
                    } else {
                        self.arrive(recorder);
                    }
                }
                // An arrival always waits; without one there is nothing left to do.
                None => self.finish(),
            }
        }
        debug_assert!(self.is_sound());
        let (outcome, reason) = self.ended?;
        let run = self.result(outcome, reason);
        if R::WANTED {
            recorder.record(self.end_record(&run));
        }
        Some(run)
    }

    /// The time since the start, in µs.
    pub fn time_us(&self) -> u64 {
        self.time_us
    }

    /// The position, in nm of path.
    pub fn x_nm(&self) -> u64 {
        self.x_nm
    }

    /// The energy used, in pJ.
    pub fn energy_pj(&self) -> u128 {
        self.energy_pj
    }

    /// The hardware that works.
    pub fn available(&self) -> Equipment {
        self.available
    }

    /// Lets time pass on the current leg.
    fn advance(&mut self, time_us: u64) {
        debug_assert!(time_us >= self.time_us, "time goes back");
        let passed = time_us - self.time_us;
        if passed == 0 {
            return;
        }
        self.time_us = time_us;
        self.take(passed, self.real_now_uw());
        if self.hindrance.is_some() {
            self.pass_hindered(passed);
            return;
        }
        self.fresh = false;
        if self.travels() {
            let way = self.leg.alternative.speed.0.saturating_mul(passed);
            self.x_nm = self.x_nm.saturating_add(way).min(self.leg_end_nm);
        } else {
            self.standing_us = self.standing_us.saturating_sub(passed);
        }
    }

    /// Returns whether it is within its activity, and its power error and next event are of here.
    fn is_sound(&self) -> bool {
        let activities = &self.simulation.plannable.activities;
        let within = activities.get(self.activity).is_some_and(|it| {
            let (start, end) = (it.x_start.0 * NM_PER_MM, it.x_end.0 * NM_PER_MM);
            start <= self.x_nm && self.x_nm <= end && (!self.done || self.x_nm == end)
        });
        let next = self.events.get(self.next_event).is_none_or(|it| it.x_nm >= self.x_nm);
        let last = self.next_event.checked_sub(1).and_then(|it| self.events.get(it));
        let last = last.is_none_or(|it| it.x_nm <= self.x_nm);
        let here = self.segments.get(self.segment).is_some_and(|it| it.0 <= self.x_nm);
        within && last && next && here
    }

    fn take(&mut self, us: u64, power_uw: u64) {
        self.energy_pj = self.energy_pj.saturating_add(u128::from(us) * u128::from(power_uw));
    }

    fn travels(&self) -> bool {
        self.simulation.plannable.activities[self.activity].travels()
    }

    fn end_nm(&self) -> u64 {
        self.simulation.plannable.activities[self.activity].x_end.0 * NM_PER_MM
    }

    /// The end of a leg is reached.
    fn arrive<R: Recorder>(&mut self, recorder: &mut R) {
        self.done = if self.travels() { self.x_nm >= self.end_nm() } else { self.standing_us == 0 };
        self.find_segment();
        self.proceed(recorder);
    }

    /// Lets the events of this place happen, and then lets the robot go on.
    fn proceed<R: Recorder>(&mut self, recorder: &mut R) {
        self.happen(recorder);
        if self.ended.is_some() {
            return;
        }
        if self.hindrance.is_some() {
            self.schedule();
        } else if !self.begun {
            self.begun = true;
            self.begin(recorder);
        } else if !self.done {
            self.set_leg();
            self.schedule();
        } else if self.activity + 1 < self.simulation.plannable.activities.len() {
            self.activity += 1;
            self.done = false;
            self.fresh = true;
            self.begin(recorder);
        } else {
            self.finish();
        }
    }

    /// The current activity starts.
    fn begin<R: Recorder>(&mut self, recorder: &mut R) {
        self.set_leg();
        if R::WANTED {
            recorder.record(self.activity_record());
        }
        self.check(recorder);
        if self.ended.is_none() {
            self.schedule();
        }
    }

    fn real_uw(&self, alternative: &Alternative) -> u64 {
        alternative.power.0.saturating_mul(self.segments[self.segment].1)
    }

    /// The current activity goes on from here as it is planned now.
    fn set_leg(&mut self) {
        let alternative = self.planning.chosen(self.activity);
        self.leg = Leg { alternative, real_uw: self.real_uw(&alternative) };
        if self.fresh {
            self.standing_us = alternative.duration.0.saturating_mul(1000);
        }
    }

    /// The stretch of constant power error that holds this place.
    fn find_segment(&mut self) {
        let segments = &self.segments;
        while segments.get(self.segment + 1).is_some_and(|&(start, _)| start <= self.x_nm) {
            self.segment += 1;
        }
    }

    /// Plans the end of the leg and the next check.
    fn schedule(&mut self) {
        self.queue.clear();
        let left_us = if let Some(left_us) = self.hindered_for() {
            left_us
        } else if self.travels() {
            let mut end = self.end_nm();
            if let Some(event) = self.events.get(self.next_event) {
                end = end.min(event.x_nm);
            }
            if let Some(&(border, _)) = self.segments.get(self.segment + 1) {
                end = end.min(border);
            }
            self.leg_end_nm = end;
            end.saturating_sub(self.x_nm).div_ceil(self.leg.alternative.speed.0.max(1))
        } else {
            self.standing_us
        };
        self.queue.push(self.time_us.saturating_add(left_us), 0, Next::Arrival);
        self.push_check();
    }

    /// The next check: the next multiple of the period at which there was none.
    fn push_check(&mut self) {
        let period = self.simulation.period_us;
        let mut next = self.time_us.div_ceil(period).saturating_mul(period);
        if self.checked_us == Some(next) {
            next = next.saturating_add(period);
        }
        self.queue.push(next, 1, Next::Check);
    }

    /// All activities are done.
    fn finish(&mut self) {
        self.ended = Some(match self.exceeded(true) {
            Some(reason) => (Outcome::Failed, Some(reason)),
            None => (Outcome::Completed, None),
        });
    }

    /// The limit that what was used exceeds, the first in their order; of a mission that is done
    /// also what was to be reached.
    fn exceeded(&self, is_done: bool) -> Option<Reason> {
        let margins = self.left();
        let order = self.simulation.mission().scenario().order;
        if let Some(axis) = order.into_iter().find(|&axis| margins[axis] < 0) {
            return Some(Reason::LimitExceeded { axis, by: margins[axis].unsigned_abs() });
        }
        let missed = self.planning.missed(&self.progress(), is_done);
        missed.map(|(end, by)| Reason::EndMissed { end, by })
    }

    /// Limits less used, when nothing is planned any more.
    fn left(&self) -> [i64; 2] {
        let limits = self.simulation.mission().scenario().limits;
        let used = self.used();
        std::array::from_fn(|axis| limits[axis].cast_signed() - used[axis].cast_signed())
    }

    fn result(&mut self, outcome: Outcome, reason: Option<Reason>) -> Run {
        let at = self.progress();
        let spent = self.planning.spent(&at);
        let plans = std::mem::take(&mut self.planning.made);
        Run {
            outcome,
            reason,
            replans: (plans.len() as u64).saturating_sub(1),
            plans,
            operator_requests: 0, // nobody is there to be asked
            margins: self.left(),
            used: self.used(),
            time_us: self.time_us,
            energy_pj: self.energy_pj,
            x_mm: self.x_nm / NM_PER_MM,
            events: self.counts,
            checks: self.checks,
            spent,
        }
    }
}
