//! Seeded defects of the repaired protocol, and the requirement that each breaks.

use crate::team::Asked;
use cotama_models::team::protocol::Defect::{self, *};
use cotama_models::team::protocol::Team;
use cotama_verification::check::{Options, Verdict, check};
use cotama_verification::property;
use std::collections::BTreeSet;

/// Each with the requirement that it breaks.
const MUTANTS: &[(Defect, &str)] = &[
    (WaitsForAllBids, "L1"),
    (NoDeadlineForAcks, "L2"),
    (NoDeadlineForWork, "S9"),
    (NoRelease, "L2"),
    (ReopensAtOnce, "S1"),
    (AsksAllAtOnce, "L4"),
    (TasksNotCopied, "S1"),
    (TasksForgotten, "L3"),
    (CountsOldAcks, "S8"),
    (StartsOnOldAck, "S3"),
    (FollowsOldAssign, "S8"),
    (NamesOldBidders, "S5"),
    (StartsAlone, "S3"),
    (AcksWhileBusy, "S2"),
    (NamesIncapable, "S4"),
    (SilenceIsConsent, "S4"),
    (OpensDone, "S6"),
    (CompletedIsLeft, "S6"),
    (TakesOverEarly, "S7"),
    (NobodyTakesOver, "L3"),
    (ExecutesOn, "S9"),
    (StaysReserved, "L1"),
    (ObeysOldRelease, "L4"),
    (NeverReports, "L1"),
    (ReportsAwarded, "S1"),
    (FailureUnsaid, "L1"),
];

/// The defects that look at messages of older rounds.
const OLD: &[Defect] =
    &[CountsOldAcks, StartsOnOldAck, FollowsOldAssign, NamesOldBidders, ObeysOldRelease, OpensDone];

/// Whether a requirement does not hold of a team, on fair runs.
fn breaks(team: &Team, id: &str) -> bool {
    let asked = Asked::new(team);
    let requirement = asked.requirements.iter().find(|it| it.id == id).unwrap();
    let property = property::parse(&requirement.fair, asked.model.pt()).unwrap();
    match check(&asked.model, &property, &Options::default()).verdict {
        Verdict::Holds(holds) => !holds,
        other => panic!("{id}: {other:?}"),
    }
}

#[test]
fn every_mutant_breaks_its_requirement() {
    for &(defect, id) in MUTANTS {
        let team = if defect == AsksAllAtOnce { Team::rivals() } else { Team::new(2, 1) };
        let team = if OLD.contains(&defect) { team } else { team.without_old_messages() };
        assert!(!breaks(&team, id), "{id}");
        assert!(breaks(&team.with(&[defect]), id), "{defect:?} breaks {id}");
    }
}

#[test]
fn every_requirement_is_broken_by_some_mutant() {
    let broken: BTreeSet<_> = MUTANTS.iter().map(|it| it.1).collect();
    let all = Asked::new(&Team::new(2, 1)).requirements;
    assert_eq!(broken, all.iter().map(|it| it.id).collect());
    let seeded: BTreeSet<_> = MUTANTS.iter().map(|it| it.0).collect();
    assert_eq!(seeded, Defect::ALL.iter().copied().collect());
    assert_eq!(MUTANTS.len(), 26);
}
