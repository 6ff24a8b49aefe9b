//! Runs that are compared byte by byte: a host and a chip that do the same leave the same trace.

mod ace;
mod delivery;
mod patrol;
mod periodic;
mod power;
mod uart;

use crate::patrol::{Tables, Workspace};
use crate::trace::{Sink, Trace};

pub use periodic::{TICK_US, TICKS};
pub use power::{CUTS, FlashModel, PAGE, Power};
pub use uart::{Channel, FRAMES, Fates, send};

/// The memory that the scenes need beside the stack.
#[derive(Clone, Debug)]
pub struct Memory {
    /// Tables of problems.
    pub tables: Tables,
    /// Workspace of the exact allocator.
    pub workspace: Workspace,
}

impl Memory {
    /// Unused.
    pub const EMPTY: Self = Self { tables: Tables::EMPTY, workspace: Workspace::EMPTY };
}

/// A scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Scene {
    /// The patrol, planned by the rule, and planned again three times.
    PatrolByRule,
    /// The same, exactly.
    PatrolExactly,
    /// 200 random situations of the patrol, by the rule and exactly.
    RandomPlans,
    /// The delivery with the seven points.
    SevenPoints,
    /// The decisional level under 1,000 random scripts.
    RandomScripts,
    /// The executive, on a timer of 1 kHz.
    Periodic,
    /// Behaviour selection of ACE under random triggers.
    Ace,
    /// Power that fails while the state is stored, 500 times.
    PowerCuts,
    /// Frames over a UART with bit errors.
    Uart,
}

impl Scene {
    /// All of them, in the order in which they are played.
    pub const ALL: [Self; 9] = [
        Self::PatrolByRule,
        Self::PatrolExactly,
        Self::RandomPlans,
        Self::SevenPoints,
        Self::RandomScripts,
        Self::Periodic,
        Self::Ace,
        Self::PowerCuts,
        Self::Uart,
    ];

    /// Returns the name in print.
    pub const fn name(self) -> &'static str {
        match self {
            Self::PatrolByRule => "patrol, by the rule",
            Self::PatrolExactly => "patrol, exactly",
            Self::RandomPlans => "random plans",
            Self::SevenPoints => "the seven points",
            Self::RandomScripts => "1,000 random scripts",
            Self::Periodic => "executive, 1 kHz",
            Self::Ace => "ACE, random triggers",
            Self::PowerCuts => "500 power cuts",
            Self::Uart => "frames with bit errors",
        }
    }

    /// Plays it. `tick` waits for the next millisecond of a timer. What a person wants to know of
    /// it comes back: two numbers that [`Self::says`] names.
    pub fn play(
        self,
        memory: &mut Memory,
        tick: &mut dyn FnMut(),
        trace: &mut Trace<'_, impl Sink>,
    ) -> [u32; 2] {
        trace.scene(self as u8);
        match self {
            Self::PatrolByRule => patrol::by_rule(memory, trace),
            Self::PatrolExactly => patrol::exactly(memory, trace),
            Self::RandomPlans => patrol::random(memory, trace),
            Self::SevenPoints => delivery::seven_points(trace),
            Self::RandomScripts => delivery::random(trace),
            Self::Periodic => periodic::play(tick, trace),
            Self::Ace => ace::play(trace),
            Self::PowerCuts => power::play(trace),
            Self::Uart => uart::play(FRAMES, trace),
        }
    }

    /// Returns the meanings of its two numbers.
    pub const fn says(self) -> [&'static str; 2] {
        match self {
            Self::PatrolByRule | Self::PatrolExactly => ["replans", "without plan"],
            Self::RandomPlans => ["plans", "without plan"],
            Self::SevenPoints => ["seconds", "delivered"],
            Self::RandomScripts => ["periods", "ended in safety"],
            Self::Periodic => ["jobs done", "real-time faults"],
            Self::Ace => ["triggers", "accepted"],
            Self::PowerCuts => ["restored whole", "started anew"],
            Self::Uart => ["accepted", "wrong"],
        }
    }
}

/// Sends the trace of all scenes on to the sink of one.
pub fn play_all<S: Sink>(
    memory: &mut Memory,
    tick: &mut dyn FnMut(),
    sink: &mut S,
    mut said: impl FnMut(Scene, [u32; 2], (u64, u64)),
) -> (u64, u64) {
    let mut whole = Trace::new(sink);
    for scene in Scene::ALL {
        let mut within = Within(&mut whole);
        let mut trace = Trace::new(&mut within);
        let numbers = scene.play(memory, tick, &mut trace);
        said(scene, numbers, trace.digest());
    }
    whole.digest()
}

/// The trace of a scene goes into that of all.
struct Within<'t, 's, S>(&'t mut Trace<'s, S>);

impl<S: Sink> Sink for Within<'_, '_, S> {
    fn put(&mut self, bytes: &[u8]) {
        self.0.raw(bytes);
    }
}
