//! A small world around the control loop, closed over its requests: a path, an object, an operator,
//! and what fails where. It is a script, not a simulator: `cotama run delivery` has that.

use crate::control::{Control, PERIOD_MS};
use crate::dice::Dice;
use crate::message::{Period, WORDS};
use cotama_core::units::Millis;
use cotama_models::cotama::{
    Body, FailureMode, Flag, Flags, Module, Modules, Perceived, Requests, Word, local, operator,
};

/// Each of the two drives is so long, in mm.
const DRIVE_MM: u64 = 40_000;
/// Planning a path and an operator's answer take so long, in ms.
const PLANNING_MS: u64 = 2_000;
const ANSWER_MS: u64 = 8_000;
/// The object is taken and given in so long, in ms.
const HANDLING_MS: u64 = 30_000;
/// A flag stays up for so many periods, where the failure passes.
const SHOWN: u8 = 30;

/// A failure on the way.
#[derive(Clone, Copy, Debug)]
pub struct Incident {
    /// Start on the path of both drives, in mm.
    pub at_mm: u64,
    /// The failure mode whose flags it raises.
    pub mode: FailureMode,
    /// The module that it is about, where that is not clear from the flags.
    pub part: Modules,
}

/// The incidents of the published run (Durand et al., TAROS 2010, Section VI), at places of ours.
pub const SEVEN_POINTS: [Incident; 4] = {
    const fn incident(at_mm: u64, mode: FailureMode) -> Incident {
        Incident { at_mm, mode, part: Modules::NONE }
    }
    [
        Incident { part: Modules::of(&[Module::Mcl]), ..incident(45_000, FailureMode::Rt1) },
        incident(52_000, FailureMode::Loc2),
        incident(63_000, FailureMode::Son1),
        incident(72_000, FailureMode::Loc3),
    ]
};

/// A world with a script.
#[derive(Clone, Debug)]
pub struct Surroundings<'i> {
    incidents: &'i [Incident],
    /// How far the robot has come, both drives together.
    x_mm: u64,
    stands: bool,
    /// Since when the global and the local supervisor are where they are.
    since: [Millis; 2],
    place: (u32, local::State),
    /// Flags that are up, and for how many periods.
    up: Option<(Flags, u8)>,
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
            place: (0, local::State::Idle),
            up: None,
            taught: false,
        }
    }

    /// Returns the input of the loop now.
    pub fn before(&mut self, now: Millis, control: &Control) -> Period {
        let decider = control.decider();
        let place = (decider.global().0, decider.situation().local);
        if place.0 != self.place.0 {
            self.since[0] = now;
        }
        if place.1 != self.place.1 {
            self.since[1] = now;
        }
        self.place = place;
        let mut seen = Perceived::nothing(Modules::ALL);
        if let Some((incident, later)) = self.incidents.split_first()
            && incident.at_mm <= self.x_mm
        {
            self.incidents = later;
            seen.raised = incident.mode.rule().signature.always;
            seen.part = incident.part;
            self.up = Some((seen.raised, SHOWN));
        } else if let Some((flags, left)) = self.up {
            self.up = (left > 0).then_some((flags, left.saturating_sub(1)));
            if left == 0 {
                seen.lowered = flags;
            }
        }
        let goal = if place.0 <= 1 { DRIVE_MM } else { 2 * DRIVE_MM };
        let body = Body { at_goal: self.x_mm >= goal, stands: self.stands };
        Period { seen, body, said: self.says(now, body) }
    }

    /// Moves the robot by the requests.
    pub fn after(&mut self, requests: &Requests) {
        let speed = if requests.drive && !requests.halt { requests.speed.0 } else { 0 };
        let moved = speed * u64::from(requests.adjusted.speed) / 1_000 * PERIOD_MS / 1_000;
        let goal = if self.place.0 <= 1 { DRIVE_MM } else { 2 * DRIVE_MM };
        let x = (self.x_mm + moved).min(goal).max(self.x_mm);
        (self.stands, self.x_mm) = (x == self.x_mm, x);
    }

    fn says(&mut self, now: Millis, body: Body) -> Option<Word> {
        use local::State::{HandOver, Planning, Teleoperated, Teleprogrammed};
        let [global, local] = self.since.map(|it| now.0.saturating_sub(it.0));
        let in_time = |word, waited, least| (waited >= least).then_some(word);
        match self.place {
            (0, _) => Some(Word::MissionReceived),
            (2, _) => in_time(Word::ObjectReceived, global, HANDLING_MS),
            (4, _) => in_time(Word::ObjectDelivered, global, HANDLING_MS),
            (_, Planning) => in_time(Word::PathReady, local, PLANNING_MS),
            (_, HandOver) => {
                in_time(Word::Operator(operator::Event::teleoperate), local, ANSWER_MS)
            }
            // The first time he gives a path, and the robot goes on alone.
            (_, Teleoperated) if !self.taught => {
                in_time(Word::Operator(operator::Event::teleprogram), local, ANSWER_MS)
            }
            (_, Teleprogrammed) => {
                self.taught = true;
                in_time(Word::Operator(operator::Event::new_path), local, ANSWER_MS)
            }
            (_, Teleoperated) if body.at_goal => Some(Word::Operator(operator::Event::arrived)),
            _ => None,
        }
    }
}

/// Anything at any time: what a loop is given by a broken world.
#[derive(Clone, Debug)]
pub struct Noise {
    dice: Dice,
    up: Flags,
    works: Modules,
}

impl Noise {
    /// Another for each seed.
    pub const fn new(seed: u64) -> Self {
        Self { dice: Dice::new(seed), up: Flags::NONE, works: Modules::ALL }
    }

    /// Returns the input of the loop now.
    pub fn period(&mut self) -> Period {
        let dice = &mut self.dice;
        let mut seen = Perceived::nothing(self.works);
        if dice.once_in(40) {
            let modes = FailureMode::ALL;
            let mode = modes[dice.roll(modes.len() as u32) as usize];
            seen.raised = mode.rule().signature.always;
        }
        if dice.once_in(200) {
            let flag = Flag::ALL[dice.roll(Flag::ALL.len() as u32) as usize];
            seen.raised = seen.raised.with(flag);
        }
        if dice.once_in(3) {
            seen.part = Modules::of(&[Module::ALL[dice.roll(Module::ALL.len() as u32) as usize]]);
        }
        if dice.once_in(60) {
            seen.lowered = self.up;
        }
        self.up = self.up.union(seen.raised).without(seen.lowered);
        if dice.once_in(100) {
            let module = Module::ALL[dice.roll(Module::ALL.len() as u32) as usize];
            let one = Modules::of(&[module]);
            self.works = if self.works.has(module) {
                self.works.without(one)
            } else {
                self.works.union(one)
            };
        }
        let body = Body { at_goal: dice.once_in(30), stands: dice.once_in(2) };
        let said = dice.once_in(4).then(|| WORDS[dice.roll(WORDS.len() as u32) as usize]);
        Period { seen, body, said }
    }
}
