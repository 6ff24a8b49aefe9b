//! One mission of a robot, period after period.
//!
//! In each period, in this order: what is to fail fails; the robot goes on; observers raise and
//! lower their flags, which are diagnosed; the supervisors take a round and are told one thing. So
//! a run is a run of the nets that were checked.

use super::failing::{Demand, Failures, mode, moves};
use super::hindered::Hindered;
use super::operator::{Operator, View};
use super::records::Recording;
use super::{Conduct, Injection, Run, Script};
use crate::body::Drive;
use crate::plan::{Planning, Progress};
use crate::record::{Recorder, Silent};
use crate::run::{LONGEST, Outcome, PlanCause};
use crate::supervised::{Violation, Watching};
use cotama_core::net::TransitionId;
use cotama_core::player::{Firing, Names, Observer, Program};
use cotama_core::system::Of;
use cotama_core::units::{Millimetres, MillimetresPerSecond, Millis, Milliwatts};
use cotama_models::cotama::Cause;
use cotama_models::missions::Mission;
use cotama_models::missions::tables::Rest;
use cotama_models::robots::{
    Body, Decision, Global, Level, Mode, Moment, Parts, Robot, Told, Where, diagnose,
};
use std::collections::{BTreeSet, VecDeque};

/// How far a mission has come when it starts.
pub(super) const START: Progress =
    Progress { activity: 0, rest: None, now: Millis(0), x_mm: 0, used: [0; 2] };

/// A mission under way.
pub(super) struct World<'m, P, const W: usize, const S: usize> {
    pub(super) mission: &'m Mission,
    pub(super) robot: &'m Robot,
    body: &'m Body,
    pub(super) level: Level<'m, P, W, 0, S>,
    pub(super) planning: Planning<'m, usize>,
    pub(super) now: Millis,
    pub(super) drive: Drive,
    energy_uj: u64,
    waiting: Vec<Injection>,
    until: Vec<Option<Moment>>,
    failures: Failures,
    hindered: Hindered,
    operator: Operator,
    /// The parts that are known to be lost.
    pub(super) known: Parts,
    /// Reports that the supervisors were not told yet, with the failure that they go back to.
    untold: VecDeque<(usize, Cause)>,
    /// The objective of the mission, and since when it is under way.
    pub(super) objective: usize,
    objective_since: Millis,
    /// Since when the robot is where it is in its drive, and when it came to places first.
    place: Where,
    place_since: Millis,
    first: Vec<(Option<usize>, Millis)>,
    withdrawn: Option<Millimetres>,
    permitted: bool,
    pub(super) period: Millis,
    pub(super) run: Run,
    watching: Watching<'m>,
    /// When transitions fired last, and which.
    last: (Millis, Vec<String>),
    /// Whether nothing happened in the last period.
    calm: bool,
}

impl<'m, P: Program<W, 0, S>, const W: usize, const S: usize> World<'m, P, W, S> {
    /// A robot at the start of its mission, with its plan; `None` where the mission has no robot
    /// with a body.
    pub(super) fn start(
        mission: &'m Mission,
        program: P,
        planning: Planning<'m, usize>,
        script: &Script,
        period: Millis,
        watching: Watching<'m>,
    ) -> Option<Self> {
        let robot = mission.robot()?.robot();
        let body = robot.body.as_ref()?;
        let run = Run {
            outcome: Outcome::Failed,
            time: Millis(0),
            x: Millimetres(0),
            used: [0; 2],
            operator_requests: 0,
            told: Vec::new(),
            rounds: 0,
            conduct: Vec::new(),
            configurations: Vec::new(),
            plans: Vec::new(),
            exposed: Millis(0),
            braked: Millimetres(0),
            moved_when_safe: false,
            ended_by: None,
            fired: BTreeSet::new(),
            violated: None,
        };
        Some(Self {
            mission,
            robot,
            body,
            level: Level::start(robot, program),
            planning,
            now: Millis(0),
            drive: Drive::new(body.acceleration.max(1)),
            energy_uj: 0,
            waiting: script.injections.clone(),
            until: Vec::new(),
            failures: Failures { period: body.period, ..Failures::default() },
            hindered: Hindered::new(&script.events, &script.power_errors),
            operator: Operator::new(&script.answers),
            known: Parts::NONE,
            untold: VecDeque::new(),
            objective: 0,
            objective_since: Millis(0),
            place: Where::Rests,
            place_since: Millis(0),
            first: Vec::new(),
            withdrawn: None,
            permitted: false,
            period,
            run,
            watching,
            last: (Millis(0), Vec::new()),
            calm: false,
        })
    }

    /// Runs to the end.
    pub(super) fn run<R: Recorder>(&mut self, recorder: &mut R) {
        let mut recording = Recording::new(recorder);
        self.record_plans(&mut recording);
        loop {
            self.step(&mut recording);
            self.record_progress(&mut recording);
            if let Some(outcome) = self.end() {
                self.run.outcome = outcome;
                break;
            }
            if !R::WANTED {
                self.pass_over();
            }
        }
        self.record_end(&mut recording);
    }

    /// Goes on for a time after the robot was made safe, and notes whether it moves.
    pub(super) fn stand_for(&mut self, after: Millis) {
        let (until, from) = (self.now.0.saturating_add(after.0), self.drive.x());
        let (used, now) = (self.used(), self.now);
        let mut silent = Silent;
        let mut recording = Recording::new(&mut silent);
        while self.run.outcome == Outcome::Safe && self.now.0 < until {
            self.step(&mut recording);
        }
        self.run.moved_when_safe |= self.drive.x() > from;
        (self.run.time, self.run.x, self.run.used) = (now, from, used);
    }

    /// The run, when it is over.
    pub(super) fn into_run(mut self) -> Run {
        self.run.plans = self.planning.made;
        self.run
    }

    fn step<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let before = self.drive;
        self.calm = true;
        self.fail(recording);
        let happened = self.hindered.happen(self.now, self.drive.x());
        self.travel();
        self.calm &= self.drive.is_steady_since(&before, self.body.period);
        if self.failures.thinks(self.robot) {
            self.observe(recording);
            if !happened.is_empty()
                || self.now.0 / 1_000 != self.now.0.saturating_sub(self.body.period.0) / 1_000
            {
                self.watch_margins(recording);
            }
            self.round(recording);
        }
        self.now.0 += self.body.period.0;
    }

    /// How the mission ends, if it does.
    fn end(&self) -> Option<Outcome> {
        if self.run.violated.is_some() {
            return Some(Outcome::Failed);
        }
        let stands = self.drive.speed().0 == 0;
        let left_alone = !self.failures.thinks(self.robot)
            && stands
            && (!self.level.permits() || self.failures.is_abandoned(self.robot, self.now));
        match self.level.global() {
            Global::Safe if stands => Some(self.within(Outcome::Safe)),
            _ if left_alone => Some(self.within(Outcome::Safe)),
            Global::Waits if self.objective >= self.mission.objectives.len() => {
                Some(self.within(Outcome::Completed))
            }
            _ if self.now >= LONGEST => Some(Outcome::Failed),
            _ => None,
        }
    }

    fn within(&self, outcome: Outcome) -> Outcome {
        let limits = self.mission.scenario().limits;
        let within = self.used().iter().zip(limits).all(|(used, limit)| *used <= limit);
        if within { outcome } else { Outcome::Failed }
    }

    /// Duration and energy used, in ms and mJ.
    pub(super) const fn used(&self) -> [u64; 2] {
        [self.now.0, self.energy_uj / 1_000]
    }

    fn is_due(&self, when: Moment) -> bool {
        let since = |place: Option<usize>, after: Millis| {
            let first = self.first.iter().find(|it| it.0 == place);
            first.is_some_and(|it| self.now.0 >= it.1.0 + after.0)
        };
        match when {
            Moment::Place(x) => self.drive.x() >= x,
            Moment::At(at) => self.now >= at,
            Moment::During(place, after) => since(Some(place), after),
            Moment::Waiting(after) => since(None, after),
        }
    }

    /// Injects the failures that are due, and ends those that are over.
    fn fail<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let (due, wait): (Vec<_>, Vec<_>) =
            std::mem::take(&mut self.waiting).into_iter().partition(|it| self.is_due(it.when));
        self.waiting = wait;
        let ended: Vec<bool> =
            self.until.iter().map(|it| it.is_some_and(|it| self.is_due(it))).collect();
        let ends = |it: usize| ended.get(it).copied().unwrap_or(false);
        self.failures.end(self.robot, self.now, ends);
        self.calm &= due.is_empty();
        for it in due {
            self.failures.fail(self.now, it.failure);
            self.until.push(it.until);
            self.run.conduct.push(Conduct {
                failure: it.failure,
                injected: self.now,
                x: self.drive.x(),
                detected: None,
                taken_for: Vec::new(),
                decided: None,
                answered: None,
                exposed: Millis(0),
            });
            self.record_failure(recording, it.failure);
        }
    }

    /// The robot goes on for a period: who holds a permit moves it.
    fn travel(&mut self) {
        let before = self.drive.x();
        let permitted = self.level.permits();
        let held = self.hindered.waits();
        let speed = if permitted && !held { self.pace().0 } else { MillimetresPerSecond(0) };
        if held {
            self.drive.stand();
        }
        let demand = Demand {
            speed,
            most: self.body.speed_max,
            halt: self.level.is_halted(),
            end: Millimetres(self.goal().0 + self.hindered.owed().0),
            led: mode(self.robot, self.place) == Some(Mode::Operator),
        };
        self.failures.go(self.robot, self.now, &demand, &mut self.drive);
        let moved = self.drive.x() > before;
        self.hindered.take(&mut self.drive, before);
        let power = self.hindered.real(self.mission, before, self.power(moved));
        self.energy_uj = self.energy_uj.saturating_add(power.0.saturating_mul(self.body.period.0));
        self.run.moved_when_safe |= moved && self.level.global() == Global::Safe;
        self.measure(before, permitted);
    }

    /// Measures the conditions that must never hold, or not for long; the period began here.
    fn measure(&mut self, before: Millimetres, permitted: bool) {
        if let Where::Runs { configuration, .. } = self.place
            && self.drive.speed().0 > 0
            && let Some(required) = self.robot.configurations.get(configuration)
        {
            let lacks = |lost: Parts| required.required & !self.robot.available(lost) != 0;
            if !self.failures.all.is_empty() && lacks(self.failures.broken(self.robot)) {
                for (it, conduct) in self.failures.all.iter().zip(&mut self.run.conduct) {
                    let row = self.robot.failures.get(it.number);
                    if !it.over && row.is_some_and(|it| lacks(it.loses)) {
                        conduct.exposed.0 += self.body.period.0;
                        self.run.exposed = self.run.exposed.max(conduct.exposed);
                    }
                }
            }
        }
        if self.permitted && !permitted {
            self.withdrawn = Some(before);
        }
        if (permitted || self.drive.speed().0 == 0)
            && let Some(from) = self.withdrawn.take()
        {
            let way = Millimetres(self.drive.x().0.saturating_sub(from.0));
            self.run.braked = self.run.braked.max(way);
        }
        self.permitted = permitted;
    }

    /// The configuration that runs.
    pub(super) const fn configuration(&self) -> Option<usize> {
        match self.place {
            Where::Runs { configuration, .. } => Some(configuration),
            Where::Rests | Where::Waits => None,
        }
    }

    /// Speed and power of what runs: as planned with it, and no faster than it allows.
    fn pace(&self) -> (MillimetresPerSecond, Milliwatts) {
        let runs = self.configuration();
        let (speed, power) = self.planning.pace(self.activity(), runs);
        let allowed = runs.and_then(|it| self.robot.configurations.get(it)).map(|it| it.speed);
        let allowed = allowed.unwrap_or(MillimetresPerSecond(0));
        // Who drives by hand has no planned option.
        let by_hand = mode(self.robot, self.place) == Some(Mode::Operator);
        if by_hand {
            (allowed, self.body.motion_power.at(allowed))
        } else {
            (speed.min(allowed), power)
        }
    }

    /// Returns the power of the robot: that of its pace while it moves, or that of its task where
    /// it stands for one; else that of rest.
    pub(super) fn power(&self, moved: bool) -> Milliwatts {
        let stands = self.level.global() == Global::Waits && self.objective_stands();
        if stands {
            return self.planning.pace(self.activity(), None).1;
        }
        if moved || self.drive.speed().0 > 0 {
            return self.pace().1;
        }
        self.planning.rest_power(self.activity(), self.configuration())
    }

    fn objective_stands(&self) -> bool {
        self.mission.objectives.get(self.objective).is_some_and(|it| !it.travels())
    }

    /// The end of the drive; where there is none, so far that the robot can brake.
    fn goal(&self) -> Millimetres {
        let braked = Millimetres(self.drive.x().0 + self.drive.braking_distance().0 + 1);
        let drives = self.level.global() == Global::Drives;
        match self.mission.objectives.get(self.objective).filter(|it| drives && it.travels()) {
            Some(it) => it.x_end,
            None => braked,
        }
    }

    fn at_goal(&self) -> bool {
        let goal = self.mission.objectives.get(self.objective).map(|it| it.x_end);
        goal.is_some_and(|it| self.drive.x() >= it)
    }

    /// The activity under way.
    pub(super) fn activity(&self) -> usize {
        let last = self.mission.scenario().activities.len().saturating_sub(1);
        self.progress().activity.min(last)
    }

    /// How far the mission has come.
    pub(super) fn progress(&self) -> Progress {
        let x_mm = self.drive.x().0;
        let (now, used) = (self.now, self.used());
        let Some(objective) = self.mission.objectives.get(self.objective) else {
            let activity = self.mission.scenario().activities.len();
            return Progress { activity, rest: None, now, x_mm, used };
        };
        let activity = self.planning.activity(self.objective, x_mm);
        let rest = if objective.travels() {
            let end = self.mission.scenario().activities.get(activity).map_or(0, |it| it.x_end.0);
            let left = end.saturating_sub(x_mm) + self.hindered.owed().0;
            Rest::Travel(Millimetres(left.max(1)))
        } else {
            let done = self.now.0.saturating_sub(self.objective_since.0);
            Rest::Time(Millis(self.planning.standing(activity).0.saturating_sub(done)))
        };
        Progress { activity, rest: Some(rest), now, x_mm, used }
    }

    /// Observers raise flags, and what they show is reported.
    fn observe<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let seen = self.failures.look(self.robot, self.place);
        let Some(first) = seen.first().copied() else { return };
        self.calm = false;
        let up = self.failures.flags(self.robot);
        let rows = seen.iter().filter_map(|it| self.failures.all.get(*it));
        let rows = rows.filter_map(|it| self.robot.failures.get(it.number));
        let mut raised: Vec<usize> = rows.flat_map(|it| it.flags.iter().copied()).collect();
        raised.sort_unstable();
        raised.dedup();
        let taken = diagnose(self.robot, &up, &raised);
        for it in &seen {
            if let Some(conduct) = self.run.conduct.get_mut(*it) {
                conduct.detected = Some(self.now);
                conduct.taken_for.clone_from(&taken);
            }
        }
        self.record_diagnosis(recording, &seen, &raised, &taken);
        for failure in taken {
            let its_own = seen
                .iter()
                .find(|it| self.failures.all.get(**it).is_some_and(|it| it.number == failure));
            let cause = Cause(u16::try_from(its_own.unwrap_or(&first) + 1).unwrap_or(u16::MAX));
            let reports = &self.robot.losses.reports;
            let report = reports.iter().position(|it| it.failures.contains(&failure));
            if let Some(report) = report
                && !self.untold.iter().any(|it| it.0 == report)
            {
                self.untold.push_back((report, cause));
            }
        }
    }

    /// Plans around what is known to be lost with a failure.
    fn lose<R: Recorder>(&mut self, failure: usize, recording: &mut Recording<'_, R>) {
        let Some(row) = self.robot.failures.get(failure) else { return };
        let before = self.known;
        self.known = before.union(row.loses);
        let Some(under) = &self.mission.under else { return };
        if self.known == before || self.objective >= self.mission.objectives.len() {
            return;
        }
        let left = under.units(self.mission, self.known);
        // Hardware that the plan in force does not use changes it no more (Lambert et al. 2024,
        // 7.3.2).
        let at = self.progress();
        if !self.planning.needs_no_more(at, left) {
            let _ = self.planning.plan(PlanCause::Failure(failure), at, left);
            self.record_plans(recording);
        }
    }

    /// Plans again when the plan in force no longer keeps a limit.
    fn watch_margins<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let at = self.progress();
        let drives = self.level.global() == Global::Drives;
        let (Some(axis), true, Some(under)) =
            (self.planning.short(at), drives, &self.mission.under)
        else {
            return;
        };
        let left = under.units(self.mission, self.known);
        if self.planning.plan(PlanCause::Margin { axis }, at, left).is_ok() {
            self.record_plans(recording);
        }
    }

    /// The supervisors take a round, and are told one thing.
    fn round<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let mut seen = Seen::default();
        self.level.round(self.now, &mut seen);
        self.run.rounds += 1;
        self.note_all(recording, &mut seen);
        let (told, cause) = match self.untold.pop_front() {
            Some((report, cause)) => (Some(Told::Report(report)), cause),
            None => self.says(),
        };
        if let Some(told) = told {
            self.calm = false;
            if self.level.tell(self.now, told, cause, &mut seen) {
                self.run.told.push((self.run.rounds, told));
                self.record_told(recording, told);
            }
        }
        self.note_all(recording, &mut seen);
        self.arrive(recording);
        if let Some(monitor) = self.watching.look(self.now, self.level.player())
            && self.run.violated.is_none()
        {
            let fired = self.last.1.clone();
            self.run.violated = Some(Violation { at: self.now, monitor, fired });
        }
    }

    /// Notes all that fired.
    fn note_all<R: Recorder>(&mut self, recording: &mut Recording<'_, R>, seen: &mut Seen) {
        for (id, cause) in std::mem::take(&mut seen.fired) {
            self.calm = false;
            self.note(recording, id, cause);
        }
    }

    /// Returns the word of the mission or the operator, if any.
    fn says(&mut self) -> (Option<Told>, Cause) {
        let stands = self.drive.speed().0 == 0;
        let none = (None, Cause(0));
        match self.level.global() {
            Global::Secures => (stands.then_some(Told::Stopped), Cause(0)),
            Global::Safe => none,
            Global::Waits => {
                let Some(objective) = self.mission.objectives.get(self.objective) else {
                    return none;
                };
                if objective.travels() {
                    return (Some(Told::DriveWanted), Cause(0));
                }
                let activity = self.planning.activity(self.objective, self.drive.x().0);
                if self.now.0 - self.objective_since.0 < self.planning.standing(activity).0 {
                    return none;
                }
                self.advance();
                self.says()
            }
            Global::Drives => (self.drive_says(), Cause(0)),
        }
    }

    fn drive_says(&mut self) -> Option<Told> {
        let view = View {
            place: self.place,
            x: self.drive.x(),
            lost: self.robot.lost(self.known),
            link: self.link(),
            at_goal: self.at_goal() && self.drive.speed().0 == 0,
        };
        if let Some(word) = self.operator.says(self.robot, self.now, view) {
            return Some(word);
        }
        let Where::Runs { sub_objective, configuration } = self.place else { return None };
        if mode(self.robot, self.place) != Some(Mode::Autonomous) {
            return None;
        }
        let takes = self.robot.configurations.get(configuration).map_or(0, |it| it.takes.0);
        let reached = if moves(self.robot, self.place) {
            view.at_goal
        } else {
            self.now.0 - self.place_since.0 >= takes
        };
        reached.then_some(Told::Reached(sub_objective))
    }

    /// Whether the operator is reached.
    fn link(&self) -> bool {
        let available = self.robot.available(self.failures.broken(self.robot));
        self.robot.operator.is_some_and(|needs| needs & !available == 0)
    }

    /// The next objective.
    fn advance(&mut self) {
        self.objective += 1;
        self.objective_since = self.now;
        self.calm = false;
    }

    /// Notes what fired.
    fn note<R: Recorder>(
        &mut self,
        recording: &mut Recording<'_, R>,
        id: Of<TransitionId>,
        cause: Cause,
    ) {
        let Some(fired) = self.level.fired(id) else { return };
        let (net, asks) = (fired.net, fired.outputs.contains(&"op_request"));
        if net == "faults" || net == "operator" {
            return;
        }
        let name = format!("{net}.{}", fired.transition);
        let (now, conduct) = (self.now, usize::from(cause.0).checked_sub(1));
        let said = fired.outputs.first().copied().unwrap_or("");
        let restart = fired.restarts;
        let decision = match said {
            "global_event" => Some(Decision::Stop),
            "local_event" => Some(Decision::Ask),
            _ if net == "cs" => Some(Decision::Adapt),
            _ => None,
        };
        let ends = net == "gs" && fired.outputs.contains(&"halt");
        let done = net == "gs" && fired.transition == "done";
        self.record_fired(recording, id, cause);
        if self.last.0 != now {
            self.last = (now, Vec::new());
        }
        self.last.1.push(name.clone());
        self.run.fired.insert(name);
        let mut known = None;
        if let Some(it) = conduct.and_then(|it| self.run.conduct.get_mut(it)) {
            match net {
                "cs" => {
                    if let (Some(decision), None) = (decision, it.decided) {
                        it.decided = Some((now, decision));
                    }
                }
                "gom" if restart.is_none() => known = Some(it.taken_for.clone()),
                "gom" | "permit" => {}
                _ => {
                    it.answered.get_or_insert(now);
                }
            }
        }
        if let (true, Some(decision), Some(at)) = (net == "cs", decision, conduct) {
            self.record_decision(recording, at, decision, id);
        }
        // What a report takes is known when it was told, not when a module is started anew first.
        for failure in known.into_iter().flatten() {
            self.lose(failure, recording);
        }
        if let Some(module) = restart {
            self.failures.restart(self.robot, module);
        }
        if asks {
            self.run.operator_requests += 1;
            self.record_request(recording, conduct);
        }
        if ends {
            self.run.ended_by = conduct;
        }
        if done {
            self.advance();
        }
    }

    /// Notes where the supervisors have come to.
    fn arrive<R: Recorder>(&mut self, recording: &mut Recording<'_, R>) {
        let place = self.level.place();
        if place == self.place {
            return;
        }
        self.calm = false;
        let before = std::mem::replace(&mut self.place, place);
        let of = |it: Where| match it {
            Where::Runs { sub_objective, .. } => Some(sub_objective),
            Where::Rests | Where::Waits => None,
        };
        if of(before) != of(place) || before == Where::Waits || place == Where::Waits {
            self.place_since = self.now;
        }
        if place != Where::Rests && !self.first.iter().any(|it| it.0 == of(place)) {
            self.first.push((of(place), self.now));
        }
        let helped = mode(self.robot, before) == Some(Mode::Operator) && of(before) != of(place);
        if helped {
            self.failures.is_helped(self.robot);
        }
        let runs = self.configuration();
        self.run.configurations.push((self.now, runs));
        self.record_configuration(recording);
    }

    /// Passes over periods in which nothing happens, up to the next second, in which margins are
    /// looked at.
    fn pass_over(&mut self) {
        let busy = !self.calm || !self.untold.is_empty() || self.level.player().round_is_due();
        let held = self.hindered.waits() || self.hindered.owed() > Millimetres(0);
        if busy || held || !self.failures.thinks(self.robot) {
            return;
        }
        let until =
            |it: Millis| (it.0.saturating_sub(self.now.0) / self.body.period.0).saturating_sub(1);
        let mut most = until(Millis((self.now.0 / 1_000 + 1) * 1_000));
        most = most.min(until(LONGEST)).min(self.failures.unseen_for(self.robot, self.place));
        most = self.watching.late_at().map_or(most, |it| most.min(until(it)));
        let changes = self.failures.changes(self.robot, self.now);
        most = changes.map_or(most, |it| most.min(until(it)));
        let moments = self.waiting.iter().map(|it| it.when);
        for it in moments.chain(self.until.iter().flatten().copied()) {
            most = most.min(self.periods_before(it));
        }
        let activities = &self.mission.scenario().activities;
        let borders = activities.iter().flat_map(|it| [it.x_start, it.x_end]);
        for border in borders.chain(self.hindered.next()).filter(|it| *it > self.drive.x()) {
            most = most.min(self.drive.times_before(border, self.body.period).unwrap_or(0));
        }
        let waits = match self.level.global() {
            Global::Waits => {
                let activity = self.planning.activity(self.objective, self.drive.x().0);
                until(Millis(self.objective_since.0 + self.planning.standing(activity).0))
            }
            Global::Drives => match (self.place, mode(self.robot, self.place)) {
                (Where::Runs { .. }, Some(Mode::Autonomous)) if moves(self.robot, self.place) => {
                    u64::MAX
                }
                (Where::Runs { configuration, .. }, Some(Mode::Autonomous)) => {
                    let of = self.robot.configurations.get(configuration);
                    until(Millis(self.place_since.0 + of.map_or(0, |it| it.takes.0)))
                }
                _ => until(self.operator.waits_until()),
            },
            Global::Secures | Global::Safe => 0,
        };
        most = most.min(waits);
        if most == 0 {
            return;
        }
        let power = self.power(self.drive.speed().0 > 0);
        let power = self.hindered.real(self.mission, self.drive.x(), power);
        self.drive.glide(most, self.body.period);
        self.failures.look_on(self.robot, self.place, most);
        self.energy_uj = self
            .energy_uj
            .saturating_add(power.0.saturating_mul(self.body.period.0).saturating_mul(most));
        self.exposed_on(most);
        self.now.0 += self.body.period.0 * most;
        self.run.rounds += most;
    }

    /// The exposures of the last period go on for so many.
    fn exposed_on(&mut self, periods: u64) {
        for _ in 0..if self.failures.all.is_empty() { 0 } else { periods } {
            self.measure(self.drive.x(), self.permitted);
        }
    }

    /// In how many periods a moment has not come yet, with everything as it is.
    fn periods_before(&self, when: Moment) -> u64 {
        let until =
            |it: u64| (it.saturating_sub(self.now.0) / self.body.period.0).saturating_sub(1);
        let since = |place: Option<usize>, after: Millis| {
            let first = self.first.iter().find(|it| it.0 == place);
            first.map_or(u64::MAX, |it| until(it.1.0 + after.0))
        };
        if self.is_due(when) {
            return u64::MAX; // it has come
        }
        match when {
            Moment::Place(x) => self.drive.times_before(x, self.body.period).unwrap_or(0),
            Moment::At(at) => until(at.0),
            Moment::During(place, after) => since(Some(place), after),
            Moment::Waiting(after) => since(None, after),
        }
    }
}

/// The transitions that fired, with their cause.
#[derive(Debug, Default)]
struct Seen {
    fired: Vec<(Of<TransitionId>, Cause)>,
}

impl<P: Names> Observer<P, Cause> for Seen {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        self.fired.push((firing.id, firing.carries));
    }
}
