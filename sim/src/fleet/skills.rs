//! The skills of a robot: which of their uses fail, and what the robot learns of it.

use crate::streams::{Stream, Streams};
use cotama_models::team::scenario::{FailureRates, Needs, RobotSpec, Trust};
use cotama_models::team::{Capability, CapabilitySet, Probability, Reliability, Robot, Skill};

/// The skills of a robot, as it takes them to be, and the draws that decide their uses.
#[derive(Clone, Debug)]
pub(super) struct Skills {
    /// As bids take them.
    trusted: Vec<Skill>,
    /// As they are.
    known: Vec<Skill>,
    capabilities: CapabilitySet,
    learns: bool,
    fails: FailureRates,
    /// A stream for each skill whose uses may fail: the use of a number fails or not, whenever it
    /// is and whatever was learned before.
    draws: Vec<(Capability, Stream)>,
    /// Uses of each capability, and how many failed.
    uses: [(u32, u32); Capability::COUNT as usize],
}

/// The failure of a use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FailedUse {
    pub(super) capability: Capability,
    /// The number of the use of this capability in the run, from 1.
    pub(super) number: u32,
    /// What the robot takes its reliability to be from now on.
    pub(super) reliability: Probability,
}

impl Skills {
    pub(super) fn new(spec: &RobotSpec, names: &[String], trust: Trust, streams: Streams) -> Self {
        let may_fail = spec.skills.iter().map(|it| it.capability);
        let may_fail = may_fail.filter(|it| spec.fails.of(*it) > 0);
        let name = |it: Capability| names.get(usize::from(it.number())).map_or("?", |it| it);
        let stream = |it| streams.stream(&format!("uses of {} by {}", name(it), spec.name));
        let trusted = spec.trusted(trust);
        Self {
            capabilities: of(&trusted).capabilities(),
            trusted,
            known: spec.trusted(Trust::Known),
            learns: trust == Trust::Learned,
            fails: spec.fails,
            draws: may_fail.map(|it| (it, stream(it))).collect(),
            uses: [(0, 0); Capability::COUNT as usize],
        }
    }

    /// Returns the skills as bids take them.
    pub(super) fn trusted(&self) -> &[Skill] {
        &self.trusted
    }

    /// Returns the skills as they are, which no bid knows.
    pub(super) fn known(&self) -> &[Skill] {
        &self.known
    }

    /// Returns how often skills that may fail were used.
    pub(super) fn risky_uses(&self) -> Option<u32> {
        let uses = |it: &(Capability, Stream)| self.uses[usize::from(it.0.number())].0;
        (!self.draws.is_empty()).then(|| self.draws.iter().map(uses).sum())
    }

    pub(super) fn capabilities(&self) -> CapabilitySet {
        self.capabilities
    }

    /// Whether bids take each skill as certain: they count no failures in.
    pub(super) fn is_certain(&self) -> bool {
        self.trusted.iter().all(|it| it.reliability == Reliability::CERTAIN)
    }

    /// Uses the skills that these actions need, one after the other; the first one that fails ends
    /// them. What comes behind it is not used, so no skill counts the failure of another one.
    pub(super) fn act(&mut self, actions: &[Needs]) -> Result<(), FailedUse> {
        let used = actions.iter().flat_map(|it| it.used(&self.trusted));
        let used: Vec<Capability> = used.collect();
        used.into_iter().try_for_each(|it| self.make_use(it))
    }

    fn make_use(&mut self, capability: Capability) -> Result<(), FailedUse> {
        let rate = self.fails.of(capability);
        let draw = self.draws.iter_mut().find(|it| it.0 == capability);
        let fails = draw.is_some_and(|it| it.1.below(1_000) < u64::from(rate));
        let uses = &mut self.uses[usize::from(capability.number())];
        *uses = (uses.0 + 1, uses.1 + u32::from(fails));
        let number = uses.0;
        let skill = self.trusted.iter_mut().find(|it| it.capability == capability);
        let Some(skill) = skill else { return Ok(()) };
        if self.learns {
            skill.reliability = skill.reliability.after(!fails);
        }
        if !fails {
            return Ok(());
        }
        let reliability = skill.reliability.probability();
        // A capability that has never worked is none (def. 3.6).
        self.capabilities = of(&self.trusted).capabilities();
        Err(FailedUse { capability, number, reliability })
    }

    /// Returns the skills that may fail or are counted, with their uses, those that failed, and
    /// what the robot takes their reliability to be.
    pub(super) fn used(&self) -> impl Iterator<Item = (Capability, u32, u32, Probability)> {
        let known = self.trusted.iter().filter(|it| {
            let counted = matches!(it.reliability, Reliability::Uses { .. });
            counted || self.fails.of(it.capability) > 0
        });
        known.map(|it| {
            let (uses, failed) = self.uses[usize::from(it.capability.number())];
            (it.capability, uses, failed, it.reliability.probability())
        })
    }
}

const fn of(skills: &[Skill]) -> Robot<'_> {
    Robot { name: "", skills }
}
