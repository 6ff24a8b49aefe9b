//! The decisional level of the delivery robot, a period at a time: the component that the simulator
//! drives ([`Decider`]), its trace, and what of it survives a power cut.

use crate::message::{self, Period};
use crate::trace::{Sink, Trace};
use cotama_core::checksum::crc32;
use cotama_core::executive::Executive;
use cotama_core::player::{Checked, Firing, Observer, Snapshot};
use cotama_core::units::Millis;
use cotama_models::cotama::Configuration::FollowingOptimal;
use cotama_models::cotama::load::{self, Load, MOST, SPARE};
use cotama_models::cotama::{
    Cause, Decider, Diagnosis, FailureMode, FailureModes, Finding, Health, Level, Modules, Plans,
    Requests, Resources, delivery,
};

const WORDS: usize = delivery::SIZE.words;
const CLOCKS: usize = delivery::SIZE.clocks;
const SLOTS: usize = delivery::SIZE.slots;
/// Checks every firing: what was restored from flash is not known to be reachable.
pub type Program = Checked<delivery::Program>;
type Stored = Snapshot<WORDS, CLOCKS, SLOTS, Cause>;

/// So long is a period, in milliseconds.
pub const PERIOD_MS: u64 = 100;
/// Each activity of the mission is an objective.
const OBJECTIVES: u32 = 4;

/// The decisional level, between two periods.
#[derive(Clone, Debug)]
pub struct Control {
    decider: Decider<Program, WORDS, CLOCKS, SLOTS>,
    told: Option<Requests>,
}

/// Bytes of the stored state: the supervisors with their checksum, then the parts known to be
/// broken with a checksum over that of the supervisors and them.
pub const STORED_BYTES: usize = Stored::BYTES + 14;
/// Start of what the second checksum covers: the first one.
const BOUND: usize = Stored::BYTES - 4;

impl Default for Control {
    fn default() -> Self {
        Self::new(at_rest())
    }
}

/// The supervisors of a mission.
pub type Supervisors = Level<Program, WORDS, CLOCKS, SLOTS>;

/// The supervisors at rest. Not inlined: their start is over before a decider is made of them, so
/// that the stack is not as deep as both together.
#[inline(never)]
pub fn at_rest() -> Supervisors {
    Level::start(Checked(delivery::Program))
}

impl Control {
    /// With these supervisors; all works.
    pub fn new(supervisors: Supervisors) -> Self {
        Self { decider: Decider::resume(supervisors, OBJECTIVES, Health::SOUND), told: None }
    }

    /// Goes on where a stored one was. False, and nothing changes, when the bytes are damaged, of
    /// other supervisors, or cannot be.
    #[inline(never)]
    pub fn restore(&mut self, bytes: &[u8], now: Millis) -> bool {
        self.go_on(bytes, now).is_some()
    }

    fn go_on(&mut self, bytes: &[u8], now: Millis) -> Option<()> {
        let (content, checksum) = bytes.split_last_chunk::<4>()?;
        if crc32(content.get(BOUND..)?) != u32::from_le_bytes(*checksum) {
            return None;
        }
        let (level, known) = content.split_at_checked(Stored::BYTES)?;
        let known: &[u8; 10] = known.try_into().ok()?;
        let [f0, f1, f2, f3, s0, s1, s2, s3, l0, l1] = *known;
        let known = Health {
            faulty: Modules::from_bits(u32::from_le_bytes([f0, f1, f2, f3]))?,
            suspected: Modules::from_bits(u32::from_le_bytes([s0, s1, s2, s3]))?,
            lost: Resources::from_bits(u16::from_le_bytes([l0, l1]))?,
        };
        let stored = Stored::read(level)?;
        let level = Level::restore(Checked(delivery::Program), now, &stored).ok()?;
        self.decider.restart(level, known);
        self.told = None;
        Some(())
    }

    /// Returns the state that has to survive a power cut.
    pub fn store(&self) -> [u8; STORED_BYTES] {
        let mut bytes = [0; STORED_BYTES];
        let known = self.decider.health();
        let (content, checksum) = bytes.split_at_mut(STORED_BYTES - 4);
        let (level, rest) = content.split_at_mut(Stored::BYTES);
        let _ = self.decider.level().snapshot().write(level); // the room is its length
        rest[..4].copy_from_slice(&known.faulty.bits().to_le_bytes());
        rest[4..8].copy_from_slice(&known.suspected.bits().to_le_bytes());
        rest[8..].copy_from_slice(&known.lost.bits().to_le_bytes());
        checksum.copy_from_slice(&crc32(&content[BOUND..]).to_le_bytes());
        bytes
    }

    /// A period: what is seen is diagnosed and planned around, the supervisors take a round, and
    /// what is to be done comes out.
    #[inline(never)]
    pub fn period(
        &mut self,
        now: Millis,
        given: &Period,
        plans: &mut impl Plans,
        trace: &mut Trace<'_, impl Sink>,
    ) -> Requests {
        if let Some(found) = self.decider.perceive(now, given.seen, plans) {
            diagnosed(trace, now, &found);
        }
        let round = self.decider.round(now, given.said, given.body, &mut Recorder(trace));
        if let Some(found) = round.finding {
            diagnosed(trace, now, &found);
        }
        if let Some(told) = round.told {
            trace.told(now, told.event());
        }
        let requests = self.decider.requests();
        if self.told != Some(requests) {
            self.told = Some(requests);
            let adjusted = [requests.adjusted.speed, requests.adjusted.quality];
            let (configuration, bits) =
                (message::configuration(&requests), message::bits(&requests));
            trace.requests(now, configuration, bits, requests.speed.0 as u32, adjusted);
        }
        requests
    }

    /// The decider, to be looked at.
    pub const fn decider(&self) -> &Decider<Program, WORDS, CLOCKS, SLOTS> {
        &self.decider
    }
}

/// Writes down what fires.
struct Recorder<'t, 's, S>(&'t mut Trace<'s, S>);

impl<S: Sink> Observer<Program, Cause> for Recorder<'_, '_, S> {
    fn on_fire(&mut self, firing: &Firing<'_, Program, Cause>) {
        self.0.fired(firing.at, firing.id, firing.carries.0);
    }
}

fn diagnosed(trace: &mut Trace<'_, impl Sink>, now: Millis, found: &Finding) {
    let one = |mode: FailureMode| FailureModes::of(&[mode]).bits();
    let (kind, modes) = match found.diagnosis {
        Diagnosis::None => (0, 0),
        Diagnosis::Unique(mode) => (1, one(mode)),
        Diagnosis::Ambiguous(modes) => (2, modes.bits()),
        Diagnosis::Unexplained => (3, 0),
    };
    trace.diagnosed(now, found.cause.0, found.flags.bits(), kind, modes);
}

/// The tasks of the optimal path following: its modules, and the load of the computer.
pub const TASKS: usize = FollowingOptimal.scheduled().len() + 1;

/// The executive of the control loop, with localisation by as many particles as the processor
/// affords when it is busy; `None` when there is not time even for none.
pub fn executive() -> Option<Executive<TASKS>> {
    let mut tasks = [SPARE; MOST];
    let particles = load::most_particles(FollowingOptimal, Load::Busy, &mut tasks).ok()??;
    let tasks = load::tasks(FollowingOptimal, Load::Busy, particles, &mut tasks);
    Executive::new(tasks.try_into().ok()?).ok()
}
