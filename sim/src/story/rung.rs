//! The rungs of reactions, from a number that changes to the end of the mission.

/// How far up a reaction went, from the change of a number to the end of the mission: the first two
/// and the fourth are levels of Durand et al. (TAROS 2010, Sections III.C and V.C), planning the
/// rest again is that of Lambert et al. (J. Intell. Robot. Syst. 110, 2024, Section 7.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rung {
    /// A module goes on with other parameters.
    Parameter,
    /// Another set of modules serves the same activity.
    Set,
    /// Another activity: the operator is asked, or acts.
    Activity,
    /// The rest of the objectives is planned again.
    Objective,
    /// The mission is ended.
    Mission,
}

impl Rung {
    /// All, from the lowest.
    pub const ALL: [Self; 5] =
        [Self::Parameter, Self::Set, Self::Activity, Self::Objective, Self::Mission];

    /// Returns the name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::Set => "set",
            Self::Activity => "activity",
            Self::Objective => "objective",
            Self::Mission => "mission",
        }
    }
}
