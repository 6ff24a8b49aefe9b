//! The records of a run of a robot, in the terms of every trace.

use super::World;
use crate::record::Recorder;
use crate::run::Reason;
use crate::trace::supervised::{
    Autonomy, Configured, Decision, Diagnosis, Exposure, Failure, Fired, Status, Told,
};
use crate::trace::{Activity, End, Event, Occurrence, Pose, Record, Request, Sample};
use cotama_core::net::TransitionId;
use cotama_core::player::Program;
use cotama_core::system::Of;
use cotama_core::units::{Millimetres, Millis};
use cotama_models::level::Cause;
use cotama_models::robots::{self, Mode, Where, members};
use cotama_models::severity::Class;

/// The recorder, and how much of a run it has.
pub(in crate::robots) struct Recording<'r, R> {
    to: &'r mut R,
    activity: Option<usize>,
    next_sample: Millis,
    /// For each failure how long the robot was exposed to it, and whether it is now.
    exposed: Vec<(Millis, bool)>,
}

impl<'r, R: Recorder> Recording<'r, R> {
    pub(super) fn new(to: &'r mut R) -> Self {
        Self { to, activity: None, next_sample: Millis(0), exposed: Vec::new() }
    }

    fn put(&mut self, record: impl FnOnce() -> Record) {
        if R::WANTED {
            self.to.record(record());
        }
    }
}

/// The class of a decision, as traces name it.
pub(super) const fn class(decision: robots::Decision) -> Class {
    match decision {
        robots::Decision::Record => Class::Record,
        robots::Decision::Adapt => Class::Adapter,
        robots::Decision::Ask => Class::Local,
        robots::Decision::Stop => Class::Global,
    }
}

impl<P: Program<W, 0, S>, const W: usize, const S: usize> World<'_, P, W, S> {
    fn here(&self) -> (u64, u64) {
        (self.now.0 * 1_000, self.drive.x().0)
    }

    /// Returns the names of a transition.
    pub(super) fn fired(&self, id: Of<TransitionId>) -> Option<robots::Fired<'_>> {
        robots::fired(self.robot, &self.level().player().program().system(), id)
    }

    /// Returns the name of an event.
    fn name_of(&self, told: robots::Told) -> String {
        let event = self.tables().event(told);
        let system = self.level().player().program().system();
        event.map_or_else(String::new, |it| robots::name_of(&system, it))
    }

    fn failure_id(&self, number: usize) -> String {
        self.robot.failures.get(number).map_or_else(String::new, |it| it.id.clone())
    }

    pub(super) fn record_failure<R: Recorder>(&self, to: &mut Recording<'_, R>, number: usize) {
        let (t_us, x_mm) = self.here();
        let failure = u16::try_from(self.run.conduct.len()).unwrap_or(u16::MAX);
        let (mode, during) =
            (self.failure_id(number), self.robot.place_name(self.level().place()).to_owned());
        let what = self.robot.failures.get(number).map(|it| match it.item.as_str() {
            "" => it.mode.clone(),
            item => format!("{item}, {}", it.mode),
        });
        to.put(|| Record::Failure(Failure { t_us, x_mm, failure, mode, what, during }));
    }

    pub(super) fn record_diagnosis<R: Recorder>(
        &self,
        to: &mut Recording<'_, R>,
        seen: &[usize],
        raised: &[usize],
        taken: &[usize],
    ) {
        let (t_us, x_mm) = self.here();
        let names: Vec<_> = self.robot.flags().map(|it| it.1).collect();
        let mode = crate::robots::failing::mode(self.robot, self.level().place());
        let worst = taken.iter().filter_map(|it| self.robot.failures.get(*it));
        let worst = worst.map(|it| it.severity(mode.unwrap_or(Mode::Autonomous))).max();
        let Some(severity) = worst else { return };
        let reports = &self.robot.losses.reports;
        let report = reports.iter().find(|it| taken.iter().any(|of| it.failures.contains(of)));
        let decided = reports.iter().position(|it| Some(it) == report).map(|report| {
            let lost = self.robot.lost(self.known);
            robots::decide(self.robot, report, robots::Situation { at: self.level().place(), lost })
        });
        to.put(|| {
            Record::Diagnosis(Diagnosis {
                t_us,
                x_mm,
                failures: seen.iter().map(|it| u16::try_from(it + 1).unwrap_or(u16::MAX)).collect(),
                flags: raised
                    .iter()
                    .filter_map(|it| names.get(*it).map(|it| (*it).to_owned()))
                    .collect(),
                candidates: taken.iter().map(|it| self.failure_id(*it)).collect(),
                report: report.map(|it| it.name.clone()),
                severity,
                by_severity: severity.class(),
                by_availability: decided.map_or(Class::Record, class),
            })
        });
    }

    pub(super) fn record_detour<R: Recorder>(
        &self,
        to: &mut Recording<'_, R>,
        door: usize,
        extra: Millimetres,
    ) {
        let (t_us, x_mm) = self.here();
        let doors = self.mission.way.as_ref().and_then(|it| it.doors.as_ref().ok());
        let door = doors.and_then(|it| it.get(door)).cloned().unwrap_or_default();
        let event = Occurrence::Detour { door, extra_mm: extra.0 };
        to.put(|| Record::Event(Event { t_us, x_mm, event, random: None, lost_us: 0 }));
    }

    pub(super) fn record_told<R: Recorder>(&self, to: &mut Recording<'_, R>, told: robots::Told) {
        let (t_us, x_mm) = self.here();
        let (round, event) = (self.run.rounds, self.name_of(told));
        to.put(|| Record::Told(Told { t_us, x_mm, round, event }));
    }

    pub(super) fn record_fired<R: Recorder>(
        &self,
        to: &mut Recording<'_, R>,
        id: Of<TransitionId>,
        cause: Cause,
    ) {
        let Some(fired) = self.fired(id) else { return };
        let (t_us, x_mm) = self.here();
        to.put(|| {
            Record::Fired(Fired {
                t_us,
                x_mm,
                net: fired.net.to_owned(),
                transition: fired.transition.to_owned(),
                place: fired.place.to_owned(),
                cause: (cause.0 > 0).then_some(cause.0),
                sets: self.setting(fired.sets).map(|it| it.text(self.robot)),
                masks: self.mask(fired.masks).map(|it| it.text(self.robot)),
            })
        });
    }

    /// Returns the setting of a report.
    fn setting(&self, report: Option<usize>) -> Option<&robots::Setting> {
        self.robot.losses.reports.get(report?)?.sets.as_ref()
    }

    /// Returns the mask of a report.
    fn mask(&self, report: Option<usize>) -> Option<&robots::Mask> {
        self.robot.losses.reports.get(report?)?.masks.as_ref()
    }

    pub(super) fn record_decision<R: Recorder>(
        &self,
        to: &mut Recording<'_, R>,
        conduct: usize,
        decision: robots::Decision,
        by: Of<TransitionId>,
    ) {
        let (t_us, x_mm) = self.here();
        let Some(it) = self.run.conduct.get(conduct) else { return };
        let fired = self.fired(by);
        to.put(|| {
            Record::Decision(Decision {
                t_us,
                x_mm,
                failure: u16::try_from(conduct + 1).unwrap_or(u16::MAX),
                decision: class(decision),
                event: fired.as_ref().and_then(|it| it.outputs.first()).map(|it| (*it).to_owned()),
                transition: fired.as_ref().map(|it| it.transition.to_owned()),
                since_ms: self.now.0.saturating_sub(it.injected.0),
            })
        });
    }

    pub(super) fn record_request<R: Recorder>(
        &self,
        to: &mut Recording<'_, R>,
        conduct: Option<usize>,
    ) {
        let (t_us, x_mm) = self.here();
        let it = conduct.and_then(|it| self.run.conduct.get(it));
        let cause = it.map_or_else(
            || "no failure".to_owned(),
            |it| {
                let all: Vec<_> = it.taken_for.iter().map(|it| self.failure_id(*it)).collect();
                all.join(" or ")
            },
        );
        let reason = "the robot cannot go on alone".to_owned();
        to.put(|| Record::Request(Request { t_us, x_mm, cause, reason }));
    }

    pub(super) fn record_configuration<R: Recorder>(&self, to: &mut Recording<'_, R>) {
        let (t_us, x_mm) = self.here();
        let runs = self.configuration().and_then(|it| self.robot.configurations.get(it));
        let configuration = runs.map(|it| it.name.clone());
        let place = self.level().place();
        let mode = match (place, crate::robots::failing::mode(self.robot, place)) {
            (Where::Waits, _) => Autonomy::HandOver,
            (_, Some(Mode::Operator)) => {
                let moves = runs.is_some_and(|it| it.speed.0 > 0);
                if moves { Autonomy::Teleoperated } else { Autonomy::Teleprogrammed }
            }
            _ => Autonomy::Autonomous,
        };
        to.put(|| Record::Configuration(Configured { t_us, x_mm, configuration, mode }));
    }

    /// Records what is known to be lost, and what does not work without it.
    pub(super) fn record_status<R: Recorder>(&self, to: &mut Recording<'_, R>) {
        let (t_us, x_mm) = self.here();
        let known = self.known;
        let works = self.robot.available(known);
        let modules = self.robot.modules.iter().enumerate();
        let hardware = members(known.hardware).filter_map(|it| self.robot.hardware.get(it));
        let is_lost = |it: usize| known.modules >> it & 1 == 1;
        let rest = modules.clone().filter(|(it, _)| works >> it & 1 == 0 && !is_lost(*it));
        let without = rest.map(|it| it.1.name.clone()).collect();
        let modules = modules.filter(|it| is_lost(it.0)).map(|it| it.1.name.clone());
        let lost = hardware.map(|it| it.name.clone()).chain(modules).collect();
        to.put(|| Record::Status(Status { t_us, x_mm, lost, without }));
    }

    /// Records the plan that was made now.
    pub(super) fn record_plan<R: Recorder>(&self, to: &mut Recording<'_, R>) {
        if !R::WANTED {
            return;
        }
        let at = self.progress();
        if let Some(plan) = self.planning.record(&at, self.units()) {
            let after = [plan.after.duration_ms, plan.after.energy_mj];
            to.put(|| Record::Plan(Box::new(plan)));
            to.put(|| self.sample(at.t_us, at.used, after));
        }
    }

    /// Exposures that are over: all of them at the end of the run.
    fn record_exposures<R: Recorder>(&self, to: &mut Recording<'_, R>, is_end: bool) {
        to.exposed.resize(self.run.conduct.len(), (Millis(0), false));
        for (at, it) in self.run.conduct.iter().enumerate() {
            let Some((before, open)) = to.exposed.get(at).copied() else { continue };
            let grows = it.exposed > before;
            if let Some(known) = to.exposed.get_mut(at) {
                *known = (it.exposed, grows);
            }
            if (open || grows) && (!grows || is_end) {
                let (t_us, x_mm) = self.here();
                let failure = u16::try_from(at + 1).unwrap_or(u16::MAX);
                let exposed_ms = it.exposed.0;
                to.put(|| Record::Exposure(Exposure { t_us, x_mm, failure, exposed_ms }));
            }
        }
    }

    /// Activities and samples: where the robot is after the round.
    pub(super) fn record_progress<R: Recorder>(&self, to: &mut Recording<'_, R>) {
        if !R::WANTED {
            return;
        }
        self.record_exposures(to, false);
        let ((t_us, x_mm), at) = (self.here(), self.progress());
        let under_way = self.objective < self.mission.objectives.len();
        if under_way && to.activity != Some(at.first) {
            to.activity = Some(at.first);
            let of = self.mission.scenario().activities.get(at.first);
            let activity = of.map_or_else(String::new, |it| it.id.clone());
            let choice = self.planning.label(at.first).to_owned();
            let speed_mm_s = self.planning.chosen(at.first).speed.0;
            to.put(|| Record::Activity(Activity { t_us, x_mm, activity, choice, speed_mm_s }));
        }
        if self.now >= to.next_sample {
            to.next_sample = Millis(self.now.0.saturating_add(self.period.0));
            to.put(|| self.sample(t_us, self.used(), self.planning.margins(&at)));
            if let Some(rover) = self.drive.rover() {
                let [(at_mm, heading_mrad), (odometry_mm, odometry_mrad)] =
                    [rover.pose(), rover.odometry()].map(whole);
                let person = |it: &cotama_plane::Disc| in_mm(it.centre.x, it.centre.y);
                let people_mm = rover.people().iter().chain(rover.things()).map(person).collect();
                let battery_mv_ma = rover.signals().battery.map(in_milli);
                let believed = self.failures.signals.map(|_| whole(&rover.believed()));
                to.put(|| {
                    Record::Pose(Pose {
                        t_us,
                        x_mm,
                        at_mm,
                        heading_mrad,
                        odometry_mm,
                        odometry_mrad,
                        believed,
                        battery_mv_ma,
                        people_mm,
                    })
                });
            }
        }
    }

    fn sample(&self, t_us: u64, used: [u64; 2], margins: [i64; 2]) -> Record {
        let planned = self.planning.chosen(self.activity()).power;
        Record::Sample(Sample {
            t_us,
            x_mm: self.drive.x().0,
            used: used.into(),
            margins: margins.into(),
            planned_power_mw: planned.0,
            real_power_mw: self.power(false).0,
            speed_mm_s: self.drive.speed().0,
        })
    }

    /// Records the end.
    pub(super) fn record_end<R: Recorder>(&self, to: &mut Recording<'_, R>) {
        if !R::WANTED {
            return;
        }
        self.record_exposures(to, true);
        let mut run = self.run.clone();
        (run.time, run.x, run.used) = (self.now, self.drive.x(), self.used());
        run.plans.clone_from(&self.planning.made);
        let run = run.summary(self.mission);
        to.put(|| {
            Record::End(End {
                t_us: self.now.0 * 1_000,
                x_mm: run.x_mm,
                outcome: run.outcome,
                reason: run.reason.map(|it: Reason| it.text(self.mission)),
                margins: run.margins.into(),
                used: run.used.into(),
                replans: run.replans,
                operator_requests: run.operator_requests,
            })
        });
    }
}

/// Voltage and current in whole mV and mA.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a robot's battery
fn in_milli(it: cotama_plane::BatterySignals) -> [u32; 2] {
    [it.voltage_v, it.current_a].map(|it| (it * 1_000.0).round() as u32)
}

/// A pose in whole mm and thousandths of a radian.
#[allow(clippy::cast_possible_truncation)] // headings are between -π and π
fn whole(pose: &cotama_plane::Pose) -> ([i32; 2], i32) {
    let at = pose.translation.vector;
    (in_mm(at.x, at.y), (pose.rotation.angle() * 1_000.0).round() as i32)
}

#[allow(clippy::cast_possible_truncation)] // places of a floor
fn in_mm(x: f64, y: f64) -> [i32; 2] {
    [x, y].map(|it| (it * 1_000.0).round() as i32)
}
