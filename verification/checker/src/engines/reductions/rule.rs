//! The rules, by name.

use super::Goal;

/// A rule by which a net is reduced. "Visible" is a place that the goal looks at, and a transition
/// that changes one.
///
/// `R` is [`Goal::Reachability`] and [`Goal::Bounds`], `D` [`Goal::Deadlock`], `L`
/// [`Goal::StutterInvariantLtl`], `C` [`Goal::Ctl`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Rule {
    /// `R D L C`. A transition that can never fire, because it needs tokens that no place has at
    /// the start and no transition that might fire brings: it takes from an unmarked siphon (Murata
    /// 1989).
    DeadTransition,
    /// `R D L C`. A place that no transition changes: transitions that need more than it has are
    /// dead, for others it does not matter (Berthelot 1986).
    ConstantPlace,
    /// `R D L C`. An invisible place that no transition takes from and that has at the start what
    /// any needs (sink places are such): it never holds anything up (Berthelot 1986).
    UnlimitedPlace,
    /// `R D L C`. A place whose changes have a common divisor: it holds so many tokens fewer.
    ScaledPlace,
    /// `R D L C`. A place that changes in proportion to another and is never the one that holds up
    /// a transition (Berthelot 1986; Murata 1989 for equal places: fusion of parallel places).
    ProportionalPlace,
    /// `R D L C`. A place that holds a constant more or less than several others together and is
    /// never the one that holds up a transition (Berthelot 1986).
    ImpliedPlace,
    /// `R D L C`. A transition with the effect of another that needs no more (Murata 1989 for equal
    /// ones: fusion of parallel transitions; Bonneland et al. 2019, rule G).
    EqualTransition,
    /// `R D L`. A transition that does at once what another does when it fires several times, and
    /// needs no less. For `L` it must be invisible, since there are markings in between (Bonneland
    /// et al. 2019, rule K).
    RepeatedTransition,
    /// `R`. Places and transitions that cannot matter to what is visible: of the transitions matter
    /// those that change a visible place, or give to a place that one that matters needs (Rakow
    /// 2012; Thierry-Mieg 2020, prefix of interest). Transitions without an effect, that only lose
    /// tokens, and sinks are such.
    Slice,
    /// `D L`. An invisible part at the end of the net that nothing else needs anything of and that
    /// always comes to rest, as its places lie on no cycle (Thierry-Mieg 2020, prefix of interest
    /// for deadlocks).
    Suffix,
    /// `D`. A transition that needs nothing: then there is no deadlock, and nothing else matters.
    AlwaysEnabled,
    /// `R`. Invisible places that a transition fills that needs nothing: they hold as much as one
    /// likes (Thierry-Mieg 2020, source transitions).
    Source,
    /// `R`. Invisible places among which single tokens move freely on cycles: one place
    /// (Thierry-Mieg 2020, free strongly connected components).
    FreeCycle,
    /// `R D L`. An invisible place whose consumers are invisible and need one token of it and
    /// nothing else: they fire right after what gives to it. Tokens at the start are taken at once
    /// if there is one consumer (Berthelot 1986).
    PostAgglomeration,
    /// `D L`. An invisible unmarked place that each of its producers gives one token to and nothing
    /// to others; they are invisible, and what they need, at least something, nothing else needs:
    /// they fire right before what takes from it (Berthelot 1986).
    PreAgglomeration,
    /// `R`. As before, but what the producers need others may need too
    /// (Thierry-Mieg 2020, free agglomeration).
    FreeAgglomeration,
}

impl Rule {
    /// All, in the order in which they are tried.
    pub const ALL: [Self; 16] = [
        Self::DeadTransition,
        Self::ConstantPlace,
        Self::UnlimitedPlace,
        Self::ScaledPlace,
        Self::EqualTransition,
        Self::RepeatedTransition,
        Self::ProportionalPlace,
        Self::AlwaysEnabled,
        Self::Slice,
        Self::Suffix,
        Self::Source,
        Self::FreeCycle,
        Self::PostAgglomeration,
        Self::PreAgglomeration,
        Self::FreeAgglomeration,
        Self::ImpliedPlace,
    ];

    /// Whether the rule keeps what is asked.
    pub fn keeps(self, goal: Goal) -> bool {
        use Goal::{Bounds, Ctl, Deadlock, Reachability};
        match self {
            Self::DeadTransition
            | Self::ConstantPlace
            | Self::UnlimitedPlace
            | Self::ScaledPlace
            | Self::ProportionalPlace
            | Self::ImpliedPlace
            | Self::EqualTransition => true,
            Self::RepeatedTransition | Self::PostAgglomeration => goal != Ctl,
            Self::Slice | Self::Source | Self::FreeCycle | Self::FreeAgglomeration => {
                matches!(goal, Reachability | Bounds)
            }
            Self::Suffix | Self::PreAgglomeration => {
                matches!(goal, Deadlock | Goal::StutterInvariantLtl)
            }
            Self::AlwaysEnabled => goal == Deadlock,
        }
    }

    /// Returns the name of the rule.
    pub fn name(self) -> &'static str {
        match self {
            Self::DeadTransition => "dead transition",
            Self::ConstantPlace => "constant place",
            Self::UnlimitedPlace => "unlimited place",
            Self::ScaledPlace => "scaled place",
            Self::ProportionalPlace => "proportional place",
            Self::ImpliedPlace => "implied place",
            Self::EqualTransition => "equal transition",
            Self::RepeatedTransition => "repeated transition",
            Self::Slice => "slice",
            Self::Suffix => "suffix",
            Self::AlwaysEnabled => "always enabled",
            Self::Source => "source",
            Self::FreeCycle => "free cycle",
            Self::PostAgglomeration => "post-agglomeration",
            Self::PreAgglomeration => "pre-agglomeration",
            Self::FreeAgglomeration => "free agglomeration",
        }
    }
}
