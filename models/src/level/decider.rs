//! From flags to requests: the decisional level as one component.

use super::adapted::Adapted;
use super::asked::Asked;
use super::diagnosis::Rows;
use super::masked::{Hidden, Masked};
use super::sets::bits;
use super::supervisors::Level;
use super::tables::{Act, Tables};
use super::told::{Cause, Global, Mode, Told, Where};
use super::untold::Untold;
use cotama_core::net::EventId;
use cotama_core::player::{Firing, Names, Observer, Program};
use cotama_core::system::Of;
use cotama_core::units::{MillimetresPerSecond, Millis};

/// The time after which an operator who is waited for counts as silent (assumed).
pub const PATIENCE: Millis = Millis(120_000);

/// The news of observers and of the scheduler in a period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Perceived {
    /// Flags that are raised now, a bit each.
    pub raised: u64,
    /// Flags that were raised and have gone back: what they showed has passed, or was set right.
    pub lowered: u64,
    /// The modules that say that they work, in use or not, a bit each: what was lost may return
    /// with them.
    pub works: u64,
}

/// State of the drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drive {
    /// The goal of the drive is reached.
    pub at_goal: bool,
    /// The robot does not move.
    pub stands: bool,
}

/// The outcome of a round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    /// The event that the supervisors accepted.
    pub told: Option<Told>,
    /// The modules that are to be started anew now, a bit each.
    pub restarts: u64,
}

/// The requests to the robot; they hold until the next round.
#[allow(clippy::struct_excessive_bools, reason = "each goes to another part of the robot")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Requests {
    /// The configuration whose modules are to run, by its number; none where nothing does.
    pub configuration: Option<usize>,
    /// Motion may be commanded.
    pub drive: bool,
    /// The fastest it may go, as the configuration and the settings leave it.
    pub speed: MillimetresPerSecond,
    /// The reports whose settings hold, a bit each.
    pub settings: u64,
    /// Motor power is to be cut for good.
    pub halt: bool,
    /// The operator is asked.
    pub ask: bool,
    /// The mission was given up and the robot stands: alarm.
    pub alarm: bool,
}

/// The decisional level of a robot in a mission. `P` is its packed system, as for [`Level`].
#[derive(Clone, Copy, Debug)]
pub struct Decider<'t, P, const W: usize, const C: usize, const S: usize> {
    level: Level<'t, P, W, C, S>,
    untold: Untold,
    adapted: Adapted,
    asked: Asked,
    masked: Masked,
    /// Flags that are raised, and those that were masked when they were looked at last.
    up: u64,
    hides: u64,
    findings: u16,
    /// The place of the robot, and since when it is there.
    place: Where,
    since: Millis,
    /// Since when the robot stands.
    stands_since: Millis,
}

impl<'t, P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>
    Decider<'t, P, W, C, S>
{
    /// Begins where these supervisors are.
    pub fn new(level: Level<'t, P, W, C, S>) -> Self {
        let place = level.place();
        Self {
            level,
            untold: Untold::default(),
            adapted: Adapted::default(),
            asked: Asked::default(),
            masked: Masked::default(),
            up: 0,
            hides: 0,
            findings: 0,
            place,
            since: Millis(0),
            stands_since: Millis(0),
        }
    }

    /// Begins anew where these supervisors are, in the same memory.
    pub fn restart(&mut self, level: Level<'t, P, W, C, S>) {
        self.level = level;
        self.untold = Untold::default();
        self.adapted = Adapted::default();
        self.asked = Asked::default();
        self.masked = Masked::default();
        (self.up, self.hides, self.findings) = (0, 0, 0);
        (self.place, self.since, self.stands_since) = (self.level.place(), Millis(0), Millis(0));
    }

    /// Observers tell what they see. New flags are taken for failures, which wait to be told; their
    /// [`Cause`] is the number of the finding, from 1 on.
    pub fn perceive(&mut self, now: Millis, seen: Perceived) -> Rows {
        self.up = (self.up | seen.raised) & !seen.lowered;
        let tables = self.level.tables();
        let raised = seen.raised | self.unmasked(now) & self.up;
        let hidden = self.hidden(now);
        let found = if raised & !hidden.flags == 0 {
            Rows::default()
        } else {
            self.findings = self.findings.saturating_add(1);
            hidden.diagnose(tables.failures, self.up, raised & self.up)
        };
        for row in found.worst_first(tables.failures) {
            self.report(row, Cause(self.findings));
        }
        self.see(now, tables.shown(self.up), tables.broken(seen.works));
        found
    }

    /// A period of the supervisors: they take a round and are told one thing, the oldest report,
    /// else what the drive shows, else what is said. What is said is not heard unless they
    /// [listen](Self::listens).
    pub fn period(
        &mut self,
        now: Millis,
        said: Option<Told>,
        drive: Drive,
        observer: &mut impl Observer<P, Cause>,
    ) -> Round {
        if !drive.stands {
            self.stands_since = now;
        }
        let mut restarts = self.round(now, observer);
        let (told, cause) = match self.next_untold() {
            Some((told, cause)) => (Some(told), cause),
            None => (self.shows(now, drive).or(said), Cause(0)),
        };
        let mut accepted = None;
        if let Some(told) = told {
            let (is_accepted, more) = self.tell(now, told, cause, observer);
            accepted = is_accepted.then_some(told);
            restarts |= more;
        }
        let place = self.level.place();
        if self.place.is_left_for(place) {
            (self.since, self.stands_since) = (now, now);
        }
        self.place = place;
        Round { told: accepted, restarts }
    }

    /// Returns what the drive shows that the supervisors have to be told.
    fn shows(&self, now: Millis, drive: Drive) -> Option<Told> {
        let tables = self.level.tables();
        match self.level.global() {
            Global::Secures => return drive.stands.then_some(Told::Stopped),
            Global::Waits | Global::Done | Global::Safe => return None,
            Global::Does(_) => {}
        }
        let place = self.level.place();
        let mode = tables.mode(place);
        if place == Where::Waits || mode == Some(Mode::Operator) {
            let silent = now.0.saturating_sub(self.since.0) > PATIENCE.0
                && now.0.saturating_sub(self.stands_since.0) > PATIENCE.0;
            return silent.then_some(Told::GivesUp);
        }
        let it = place.sub_objective()?;
        let moves = tables.sub_objectives.get(it).is_some_and(|it| it.moves);
        (moves && drive.at_goal && drive.stands).then_some(Told::Reached(it))
    }

    /// Returns the requests to the robot now.
    pub fn requests(&self, now: Millis) -> Requests {
        let tables = self.level.tables();
        let (place, drive) = (self.level.place(), self.level.permits());
        let configuration = place.configuration();
        let fastest = configuration.and_then(|it| tables.configurations.get(it));
        let fastest = fastest.filter(|_| drive).map_or(0, |it| it.speed.0);
        let left = u64::from(self.adapted.speed(tables, now, tables.mode(place)));
        Requests {
            configuration,
            drive,
            speed: MillimetresPerSecond(fastest.saturating_mul(left) / 1_000),
            settings: self.adapted.holding(tables, now),
            halt: self.level.is_halted(),
            ask: place == Where::Waits,
            alarm: self.level.global() == Global::Safe,
        }
    }

    /// Lets a failure wait to be told.
    pub fn report(&mut self, row: usize, cause: Cause) {
        if let Some(it) = self.level.tables().failures.get(row) {
            self.untold.push(Told::Report(usize::from(it.report)), cause);
        }
    }

    /// Returns what masks hide at a time.
    pub fn hidden(&self, now: Millis) -> Hidden {
        self.masked.hidden(self.level.tables(), now)
    }

    /// Returns the flags whose masks are over since this was asked last, a bit each: they count as
    /// new where they are up.
    pub fn unmasked(&mut self, now: Millis) -> u64 {
        let hides = self.hidden(now).flags;
        core::mem::replace(&mut self.hides, hides) & !hides
    }

    /// Returns when the next mask is over; `None` where none ends.
    pub fn unmasks_at(&self, now: Millis) -> Option<Millis> {
        self.masked.ends_at(now)
    }

    /// Notes which reports show themselves now, and which losses are there, a bit each; what has
    /// been over for long enough waits to be told, and what the operator was asked for and is done
    /// with, but which is not over.
    pub fn see(&mut self, now: Millis, shown: u64, broken: u32) {
        let hidden = self.hidden(now);
        for (report, cause) in self.asked.again(shown & !hidden.reports) {
            self.untold.push(Told::Report(report), cause);
        }
        self.adapted.see(shown, broken | hidden.losses, now);
        let back = self.adapted.back(self.level.tables(), self.level.lost(), now);
        for loss in bits(u64::from(back)) {
            self.untold.push(Told::Back(loss), Cause(0));
        }
    }

    /// The supervisors take a round; returns the modules that are to be started anew, a bit each.
    pub fn round(&mut self, now: Millis, observer: &mut impl Observer<P, Cause>) -> u64 {
        let mut acts = Acts::new(self.level.tables(), observer, &mut self.asked);
        self.level.round(now, &mut acts);
        let done = acts.done;
        self.react(now, done)
    }

    /// Takes the oldest of what waits to be told.
    pub fn next_untold(&mut self) -> Option<(Told, Cause)> {
        self.untold.pop()
    }

    /// Whether what is said in the coming round is heard: reports go first.
    pub const fn listens(&self) -> bool {
        self.untold.is_empty()
    }

    /// Tells the supervisors something; returns whether they accepted it, and the modules that are
    /// to be started anew, a bit each.
    pub fn tell(
        &mut self,
        now: Millis,
        told: Told,
        cause: Cause,
        observer: &mut impl Observer<P, Cause>,
    ) -> (bool, u64) {
        let mut acts = Acts::new(self.level.tables(), observer, &mut self.asked);
        let accepted = self.level.tell(now, told, cause, &mut acts);
        let done = acts.done;
        let restarts = self.react(now, done);
        match told {
            Told::Back(loss) if accepted => self.adapted.is_back(loss),
            Told::Chooses(_) if accepted => {
                self.masked.order(self.level.tables(), self.level.lost(), now);
            }
            Told::Done(_) if accepted => self.asked.is_answered(),
            _ => {}
        }
        (accepted, restarts)
    }

    /// Makes settings and masks; returns the modules that are to be started anew, a bit each.
    fn react(&mut self, now: Millis, done: Reactions) -> u64 {
        for report in bits(done.sets) {
            self.adapted.set(report, now);
        }
        for mask in bits(done.masks) {
            self.masked.tell(self.level.tables(), mask, now);
        }
        done.restarts
    }

    /// The supervisors, to be looked at or stored.
    pub const fn level(&self) -> &Level<'t, P, W, C, S> {
        &self.level
    }

    /// The settings that are made, and what may come back.
    pub const fn adapted(&self) -> &Adapted {
        &self.adapted
    }

    /// The flags that are up, a bit each.
    pub const fn up(&self) -> u64 {
        self.up
    }
}

/// Reactions that transitions ask for: reports whose settings are made, modules that are started
/// anew, masks; a bit each.
#[derive(Clone, Copy, Default)]
struct Reactions {
    sets: u64,
    restarts: u64,
    masks: u64,
}

/// Notes the reactions that transitions ask for, and passes everything on.
struct Acts<'t, 'o, O> {
    tables: &'t Tables<'t>,
    observer: &'o mut O,
    asked: &'o mut Asked,
    done: Reactions,
}

impl<'t, 'o, O> Acts<'t, 'o, O> {
    fn new(tables: &'t Tables<'t>, observer: &'o mut O, asked: &'o mut Asked) -> Self {
        Self { tables, observer, asked, done: Reactions::default() }
    }
}

impl<P: Names, O: Observer<P, Cause>> Observer<P, Cause> for Acts<'_, '_, O> {
    fn on_fire(&mut self, firing: &Firing<'_, P, Cause>) {
        for act in self.tables.acts(firing.id) {
            match act {
                Act::Restart(module) => self.done.restarts |= 1 << (module % 64),
                Act::Set(report) => self.done.sets |= 1 << (report % 64),
                Act::Ask(report) => self.asked.ask(usize::from(report), firing.carries),
                Act::Hide(mask) => self.done.masks |= 1 << (mask % 64),
            }
        }
        self.observer.on_fire(firing);
    }

    fn on_ignore(&mut self, event: Of<EventId>, cause: Cause) {
        self.observer.on_ignore(event, cause);
    }

    fn on_mail(&mut self, to: Of<EventId>, cause: Cause) {
        self.observer.on_mail(to, cause);
    }

    fn on_clear(&mut self, mailbox: Of<EventId>, cause: Cause) {
        self.observer.on_clear(mailbox, cause);
    }
}
