//! A small world around the control loop, closed over its requests: a path, an object, an operator,
//! and what fails where. It is a script, not a simulator: `cotama run delivery` has that.

use crate::control::{Control, PERIOD_MS};
use crate::dice::Dice;
use crate::message::Period;
use crate::robots::delivery;
use cotama_core::player::Program;
use cotama_core::units::Millis;
use cotama_models::level::{
    Drive, Global, Level, Mode, Perceived, Requests, SubObjective, Tables, Told, Where,
};

/// Each drive is so long, in mm.
const DRIVE_MM: u64 = 40_000;
/// Planning a path and an operator's answer take so long, in ms.
const PLANNING_MS: u64 = 2_000;
const ANSWER_MS: u64 = 8_000;
/// An object is taken or given in so long, in ms.
const HANDLING_MS: u64 = 30_000;
/// A flag stays up for so many periods, where the failure passes.
const SHOWN: u8 = 30;

/// A failure on the way.
#[derive(Clone, Copy, Debug)]
pub struct Incident {
    /// Start on the path of all drives, in mm.
    pub at_mm: u64,
    /// The number of the failure whose flags it raises.
    pub failure: usize,
}

/// The incidents of the published run (Durand et al., TAROS 2010, Section VI), at places of ours.
pub const SEVEN_POINTS: [Incident; 4] = [
    incident(45_000, b"RT1"),
    incident(52_000, b"LOC2"),
    incident(63_000, b"SON1"),
    incident(72_000, b"LOC3"),
];

const fn incident(at_mm: u64, id: &[u8]) -> Incident {
    let mut failure = 0;
    while !is(delivery::names::FAILURES[failure].as_bytes(), id) {
        failure += 1;
    }
    Incident { at_mm, failure }
}

const fn is(one: &[u8], other: &[u8]) -> bool {
    let mut at = 0;
    while at < one.len() && at < other.len() {
        if one[at] != other[at] {
            return false;
        }
        at += 1;
    }
    one.len() == other.len()
}

/// A world with a script.
#[derive(Clone, Debug)]
pub struct Surroundings<'i> {
    incidents: &'i [Incident],
    /// Position of the robot, all drives together.
    x_mm: u64,
    stands: bool,
    /// Since when the global and the local supervisor are where they are.
    since: [Millis; 2],
    global: Global,
    place: Where,
    /// Flags that are up, and for how many periods.
    up: Option<(u64, u8)>,
    /// The operator has given a path.
    taught: bool,
}

impl<'i> Surroundings<'i> {
    /// With these incidents, in the order of their places.
    pub const fn new(incidents: &'i [Incident]) -> Self {
        Self {
            incidents,
            x_mm: 0,
            stands: true,
            since: [Millis(0); 2],
            global: Global::Waits,
            place: Where::Rests,
            up: None,
            taught: false,
        }
    }

    /// Returns the input of the loop now.
    pub fn before<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
        &mut self,
        now: Millis,
        control: &Control<P, W, C, S>,
    ) -> Period {
        self.look(now, control.decider().level());
        let tables = control.decider().level().tables();
        let mut seen = Perceived { works: u64::MAX, ..Perceived::default() };
        if let Some((incident, later)) = self.incidents.split_first()
            && incident.at_mm <= self.x_mm
        {
            self.incidents = later;
            seen.raised = tables.failures.get(incident.failure).map_or(0, |it| it.flags);
            self.up = Some((seen.raised, SHOWN));
        } else if let Some((flags, left)) = self.up {
            self.up = (left > 0).then_some((flags, left.saturating_sub(1)));
            if left == 0 {
                seen.lowered = flags;
            }
        }
        let drive = Drive { at_goal: self.x_mm >= self.goal(tables), stands: self.stands };
        Period { seen, drive, said: self.says(now, drive, tables) }
    }

    fn look<P: Program<W, C, S>, const W: usize, const C: usize, const S: usize>(
        &mut self,
        now: Millis,
        level: &Level<'_, P, W, C, S>,
    ) {
        let (global, place) = (level.global(), level.place());
        if global != self.global {
            (self.global, self.since[0]) = (global, now);
        }
        if self.place.is_left_for(place) {
            self.since[1] = now;
        }
        self.place = place;
    }

    /// Returns the end of the drive under way, on the path of all drives, in mm.
    fn goal(&self, tables: &Tables<'_>) -> u64 {
        let Global::Does(step) = self.global else { return u64::MAX };
        let so_far = tables.steps.iter().take(step + 1);
        so_far.filter(|it| it.over.is_none()).count() as u64 * DRIVE_MM
    }

    /// Moves the robot by the requests.
    pub fn after(&mut self, requests: &Requests, tables: &Tables<'_>) {
        let speed = if requests.drive && !requests.halt { requests.speed.0 } else { 0 };
        let moved = speed * PERIOD_MS / 1_000;
        let x = (self.x_mm + moved).min(self.goal(tables)).max(self.x_mm);
        (self.stands, self.x_mm) = (x == self.x_mm, x);
    }

    fn says(&mut self, now: Millis, drive: Drive, tables: &Tables<'_>) -> Option<Told> {
        let [global, place] = self.since.map(|it| now.0.saturating_sub(it.0));
        let in_time = |told, waited, least| (waited >= least).then_some(told);
        let of_operator = |moves: bool| {
            let is = |it: &SubObjective| it.mode == Mode::Operator && it.moves == moves;
            tables.sub_objectives.iter().position(is)
        };
        match self.global {
            Global::Waits => return Some(Told::Begins),
            Global::Does(step) if tables.steps.get(step).is_some_and(|it| it.over.is_some()) => {
                return in_time(Told::Over(step), global, HANDLING_MS);
            }
            _ => {}
        }
        let Where::Runs { sub_objective: it, .. } = self.place else {
            let asked = self.place == Where::Waits;
            let leads = of_operator(true).filter(|_| asked)?;
            return in_time(Told::Chooses(leads), place, ANSWER_MS);
        };
        let moves = tables.sub_objectives.get(it)?.moves;
        match (tables.mode(self.place)?, moves) {
            (Mode::Autonomous, false) => in_time(Told::Reached(it), place, PLANNING_MS),
            (Mode::Autonomous, true) => None,
            // The first time he gives a path, and the robot goes on alone.
            (Mode::Operator, true) if !self.taught && of_operator(false).is_some() => {
                in_time(Told::Chooses(of_operator(false)?), place, ANSWER_MS)
            }
            (Mode::Operator, false) => {
                self.taught = true;
                in_time(Told::Done(it), place, ANSWER_MS)
            }
            (Mode::Operator, true) => drive.at_goal.then_some(Told::Done(it)),
        }
    }
}

/// Anything at any time: what a loop is given by a broken world.
#[derive(Clone, Debug)]
pub struct Noise {
    dice: Dice,
    tables: &'static Tables<'static>,
    up: u64,
    works: u64,
}

impl Noise {
    /// Another for each seed.
    pub const fn new(seed: u64, tables: &'static Tables<'static>) -> Self {
        Self { dice: Dice::new(seed), tables, up: 0, works: u64::MAX }
    }

    fn one_of(&mut self, count: usize) -> usize {
        self.dice.roll(count as u32) as usize
    }

    /// Returns the input of the loop now.
    pub fn period(&mut self) -> Period {
        let tables = self.tables;
        let mut seen = Perceived { works: self.works, ..Perceived::default() };
        if self.dice.once_in(40) {
            let failure = self.one_of(tables.failures.len());
            seen.raised = tables.failures.get(failure).map_or(0, |it| it.flags);
        }
        if self.dice.once_in(200) {
            seen.raised |= 1 << self.one_of(64);
        }
        if self.dice.once_in(60) {
            seen.lowered = self.up;
        }
        self.up = (self.up | seen.raised) & !seen.lowered;
        if self.dice.once_in(100) {
            self.works ^= 1 << self.one_of(64);
        }
        let drive = Drive { at_goal: self.dice.once_in(30), stands: self.dice.once_in(2) };
        let said = self.dice.once_in(4).then(|| self.word());
        Period { seen, drive, said }
    }

    fn word(&mut self) -> Told {
        let (steps, parts) = (self.tables.steps.len(), self.tables.sub_objectives.len());
        match self.one_of(7) {
            0 => Told::Begins,
            1 => Told::Over(self.one_of(steps)),
            2 => Told::Stopped,
            3 => Told::Reached(self.one_of(parts)),
            4 => Told::Chooses(self.one_of(parts)),
            5 => Told::Done(self.one_of(parts)),
            _ => Told::GivesUp,
        }
    }
}
