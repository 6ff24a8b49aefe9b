//! Capabilities of robots.

use super::reliability::{Probability, Reliability};

/// A capability, by its number below [`Capability::COUNT`]: moving, grasping with two fingers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Capability(u8);

impl Capability {
    /// So many can be told apart.
    pub const COUNT: u8 = 32;

    /// The one of this number; none from [`COUNT`](Self::COUNT) on.
    #[must_use]
    pub const fn new(number: u8) -> Option<Self> {
        if number < Self::COUNT { Some(Self(number)) } else { None }
    }

    /// Returns the number of the capability.
    pub const fn number(self) -> u8 {
        self.0
    }
}

/// A set of capabilities.
///
/// ```
/// use cotama_models::team::{CapabilitySet, service::{DETECT, MOVE}};
/// let set = CapabilitySet::of(&[MOVE, DETECT]);
/// assert_eq!((set.len(), set.has(MOVE)), (2, true));
/// assert_eq!(set.without(CapabilitySet::of(&[MOVE])), CapabilitySet::of(&[DETECT]));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct CapabilitySet(u32);

impl CapabilitySet {
    /// No capability.
    pub const NONE: Self = Self(0);

    /// These.
    #[must_use]
    pub const fn of(mut list: &[Capability]) -> Self {
        let mut set = Self::NONE;
        while let [first, rest @ ..] = list {
            set = set.with(*first);
            list = rest;
        }
        set
    }

    /// With one more.
    #[must_use]
    pub const fn with(self, capability: Capability) -> Self {
        Self(self.0 | 1_u32.wrapping_shl(capability.0 as u32))
    }

    /// Returns the intersection.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Without those of the other.
    #[must_use]
    pub const fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Returns the symmetric difference: the members of exactly one of the two sets.
    #[must_use]
    pub const fn difference(self, other: Self) -> Self {
        Self(self.0 ^ other.0)
    }

    /// Whether it has this one.
    pub const fn has(self, capability: Capability) -> bool {
        self.0 & Self::NONE.with(capability).0 != 0
    }

    /// Whether it has all of these.
    pub const fn has_all(self, others: Self) -> bool {
        others.without(self).0 == 0
    }

    /// Whether it has one of these.
    pub const fn has_any(self, others: Self) -> bool {
        self.0 & others.0 != 0
    }

    /// The members, by their numbers.
    pub fn iter(self) -> impl Iterator<Item = Capability> {
        (0..Capability::COUNT).filter_map(Capability::new).filter(move |it| self.has(*it))
    }

    /// Returns the number of members.
    pub const fn len(self) -> u32 {
        self.0.count_ones()
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// One bit each.
    pub const fn bits(self) -> u32 {
        self.0
    }

    /// One bit each.
    #[must_use]
    pub const fn from_bits(bits: u32) -> Self {
        Self(bits)
    }
}

/// A capability that a robot has, and how reliable it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Skill {
    /// The capability.
    pub capability: Capability,
    /// How reliably.
    pub reliability: Reliability,
}

impl Skill {
    /// One that is as certain as can be.
    #[must_use]
    pub const fn certain(capability: Capability) -> Self {
        Self { capability, reliability: Reliability::CERTAIN }
    }
}

/// A robot. Where skills name a capability twice, the first one counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Robot<'a> {
    /// Name of the robot.
    pub name: &'a str,
    /// The skills of the robot (3.4).
    pub skills: &'a [Skill],
}

impl Robot<'_> {
    /// Returns the capabilities of the robot: those of a value above 0 (def. 3.6).
    pub fn capabilities(&self) -> CapabilitySet {
        let there = |it: &Capability| self.reliability(*it).is_some();
        let all = self.skills.iter().map(|it| it.capability).filter(there);
        all.fold(CapabilitySet::NONE, CapabilitySet::with)
    }

    /// How reliably it can do something; none where it cannot.
    pub fn reliability(&self, capability: Capability) -> Option<Probability> {
        let skill = self.skills.iter().find(|it| it.capability == capability)?;
        skill.reliability.is_there().then(|| skill.reliability.probability())
    }
}
