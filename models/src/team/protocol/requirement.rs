//! The requirements of the protocol, as questions to the checker.

use super::team::{Job, Team};
use cotama_core::net::owned::OwnedNet;
use std::collections::BTreeSet;

/// A requirement.
///
/// ```
/// use cotama_models::team::protocol::{Team, net, requirements};
/// let team = Team::rivals();
/// let last = requirements(&team, &net(&team)).pop().unwrap();
/// assert_eq!(last.id, "L4");
/// assert_eq!(last.text, "AF (failed > 0 | t1.done & t2.done) assuming weak(network.settles)");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Requirement {
    /// S1 to S9 are about what never happens, L1 to L4 about what happens at last.
    pub id: &'static str,
    /// The requirement in a sentence.
    pub sentence: &'static str,
    /// The property, in the language of the checker. What is to happen at last is asked of the runs
    /// on which the network settles.
    pub text: String,
    /// The same, where what is to happen at last is asked of the runs on which nobody is for ever
    /// kept from a step either: what does not hold then is no matter of patience.
    pub fair: String,
}

/// The numbers of the requirements, each with its sentence, in their order.
pub const REQUIREMENTS: [(&str, &str); 13] = [
    ("S1", "No task is executed under two awards."),
    ("S2", "A robot is in at most one coalition and role."),
    ("S3", "Nobody executes a role before every member has acknowledged."),
    ("S4", "Executing robots are capable, and were alive at the award."),
    ("S5", "An award names only robots that bid in this round."),
    ("S6", "A completed task is never announced again."),
    ("S7", "A task has at most one active auctioneer."),
    ("S8", "No message of an old round changes a state."),
    ("S9", "After a member fails, its partners leave their roles."),
    ("L1", "Every announced task ends done or reported."),
    ("L2", "A robot is not kept waiting by a dead partner."),
    ("L3", "After the auctioneer fails one takes over, and the task ends."),
    ("L4", "Auctioneers do not announce for ever: without failures all is done."),
];

/// Steps that nobody is obliged to: failures, and deadlines that are too early.
const ENVIRONMENT: [&str; 4] = [".crash.", ".give_up.", ".deadline", "failure."];

pub(super) fn any(parts: impl IntoIterator<Item = String>) -> String {
    let parts: Vec<_> = parts.into_iter().collect();
    if parts.is_empty() { "false".to_owned() } else { format!("({})", parts.join(" | ")) }
}

/// For every task and robot; the robot's partners, where there may be some.
struct Pair<'a> {
    t: usize,
    r: usize,
    is_capable: bool,
    partners: &'a [usize],
}

/// For each robot, the others of its coalitions, all counted from 1.
fn partners(job: &Job, team: &Team) -> Vec<Vec<usize>> {
    let mut all = vec![BTreeSet::new(); team.robots];
    for coalition in job.coalitions() {
        for &r in &coalition {
            all[r].extend(coalition.iter().filter(|p| **p != r).map(|p| p + 1));
        }
    }
    all.into_iter().map(|it| it.into_iter().collect()).collect()
}

/// All requirements of a team, S1 first.
///
/// ```
/// use cotama_models::team::protocol::{Team, net, requirements};
/// let team = Team::new(2, 1);
/// let asked = requirements(&team, &net(&team));
/// let ids: Vec<_> = asked.iter().map(|it| it.id).collect();
/// assert_eq!(ids.join(" "), "S1 S2 S3 S4 S5 S6 S7 S8 S9 L1 L2 L3 L4");
/// assert_eq!(asked[5].text, "AG !(t1.completed & t1.announced | t2.completed & t2.announced)");
/// ```
pub fn requirements(team: &Team, net: &OwnedNet) -> Vec<Requirement> {
    let robots: Vec<_> = (1..=team.robots).collect();
    let tasks: Vec<_> = (1..=team.tasks.len()).collect();
    let capable: Vec<_> = team.tasks.iter().map(Job::capable).collect();
    // The other robots of each robot's coalitions, task by task; these count from 1.
    let others: Vec<Vec<Vec<usize>>> = team.tasks.iter().map(|it| partners(it, team)).collect();
    let pairs = |of: &dyn Fn(&Pair<'_>) -> Vec<String>| -> Vec<String> {
        let all = tasks.iter().flat_map(|&t| robots.iter().map(move |&r| (t, r)));
        all.flat_map(|(t, r)| {
            let is_capable = capable[t - 1].contains(&(r - 1));
            of(&Pair { t, r, is_capable, partners: &others[t - 1][r - 1] })
        })
        .collect()
    };
    let never = |bad: Vec<String>| format!("AG !{}", any(bad));
    let sum = |parts: Vec<String>, most: usize| format!("{} > {most}", parts.join(" + "));
    let leads_to = |all: Vec<(String, String)>| {
        let each = all.iter().map(|(from, to)| format!("AG ({from} -> AF {to})"));
        let each: Vec<_> = each.collect();
        if each.is_empty() { "AG true".to_owned() } else { each.join(" & ") }
    };
    let followed = |of: &dyn Fn(&Pair<'_>) -> Vec<(String, String)>| {
        let all = std::cell::RefCell::new(vec![]);
        pairs(&|pair| {
            all.borrow_mut().extend(of(pair));
            vec![]
        });
        leads_to(all.into_inner())
    };

    let executing = |t: usize| robots.iter().map(move |r| format!("r{r}.executing.t{t}"));
    let two_awards = pairs(&|Pair { t, r, .. }| {
        vec![
            format!("r{r}.executing.t{t} & !t{t}.acked.r{r}"),
            format!(
                "r{r}.executing.t{t} & (t{t}.open | t{t}.announced | t{t}.done | t{t}.reported)"
            ),
        ]
    });
    let crowds = tasks.iter().map(|&t| sum(executing(t).collect(), team.tasks[t - 1].most_roles()));
    let s1 = never(two_awards.into_iter().chain(crowds).collect());
    let s2 = never(
        robots
            .iter()
            .map(|r| {
                let busy = tasks
                    .iter()
                    .flat_map(|t| [format!("r{r}.waiting.t{t}"), format!("r{r}.executing.t{t}")]);
                sum(std::iter::once(format!("r{r}.idle")).chain(busy).collect(), 1)
            })
            .collect(),
    );
    let s3 = never(pairs(&|&Pair { t, r, partners, .. }| {
        let unasked =
            |p: &usize| format!("r{r}.executing.t{t} & (t{t}.named.r{p} | t{t}.refused.r{p})");
        partners.iter().map(unasked).collect()
    }));
    let s4 = never(pairs(&|&Pair { t, r, is_capable, .. }| {
        let dead = format!("t{t}.executing & t{t}.named.r{r} & r{r}.down");
        let cannot = format!("t{t}.named.r{r} | r{r}.executing.t{t}");
        if is_capable { vec![dead] } else { vec![dead, cannot] }
    }));
    let s5 = never(pairs(&|Pair { t, r, .. }| {
        let awards = net.transitions.iter().map(|it| it.name.as_str()).filter(|name| {
            let coalition = name.strip_prefix(&format!("t{t}.award"));
            let coalition = coalition.map(|it| it.split(".not").next().unwrap_or(it));
            coalition.is_some_and(|it| it.split('.').any(|it| it == format!("r{r}")))
        });
        let awards: Vec<_> = awards.collect();
        if awards.is_empty() {
            return vec![];
        }
        vec![format!("fireable({}) & !t{t}.bid.r{r}", awards.join(", "))]
    }));
    let s6 = tasks.iter().map(|t| format!("t{t}.completed & t{t}.announced"));
    let s6 = never(s6.collect());
    let leaders = |t: usize| robots.iter().map(move |r| format!("t{t}.leader.r{r}")).collect();
    let s7 = never(tasks.iter().map(|&t| sum(leaders(t), 1)).collect());
    let s8 = never(pairs(&|Pair { t, r, .. }| {
        vec![
            format!("t{t}.executing & t{t}.named.r{r}"),
            format!("r{r}.waiting.t{t} & !t{t}.acked.r{r}"),
        ]
    }));
    let s9 = followed(&|&Pair { t, r, partners, .. }| {
        let gone = partners
            .iter()
            .map(|p| format!("r{p}.down & (t{t}.named.r{p} | t{t}.acked.r{p}) | t{t}.left.r{p}"));
        let from = format!("r{r}.executing.t{t} & {}", any(gone));
        if partners.is_empty() { vec![] } else { vec![(from, format!("!r{r}.executing.t{t}"))] }
    });
    let ended = |t: usize| format!("(t{t}.done | t{t}.reported)");
    let l1 = leads_to(tasks.iter().map(|&t| (format!("t{t}.announced"), ended(t))).collect());
    let l2 = followed(&|&Pair { t, r, partners, .. }| {
        let dead =
            partners.iter().map(|p| format!("r{p}.down & (t{t}.named.r{p} | t{t}.acked.r{p})"));
        let from = format!("r{r}.waiting.t{t} & {}", any(dead));
        if partners.is_empty() { vec![] } else { vec![(from, format!("!r{r}.waiting.t{t}"))] }
    });
    let l3 = tasks.iter().flat_map(|&t| {
        [(format!("t{t}.vacant"), format!("t{t}.led")), (format!("t{t}.vacant"), ended(t))]
    });
    let l3 = leads_to(l3.collect());
    let done: Vec<_> = tasks.iter().map(|t| format!("t{t}.done")).collect();
    let l4 = format!("AF (failed > 0 | {})", done.join(" & "));

    let all = [s1, s2, s3, s4, s5, s6, s7, s8, s9, l1, l2, l3, l4];
    let steps = net.transitions.iter().map(|it| it.name.as_str());
    let steps = steps.filter(|name| !ENVIRONMENT.iter().any(|word| name.contains(word)));
    let steps = steps.collect::<Vec<_>>().join(", ");
    let requirement = |((id, sentence), text): (&(&'static str, &'static str), String)| {
        let assuming = |steps: &str| {
            let assumed = text.contains("AF").then(|| format!(" assuming weak({steps})"));
            format!("{text}{}", assumed.unwrap_or_default())
        };
        let (fair, text) = (assuming(&steps), assuming("network.settles"));
        Requirement { id, sentence, text, fair }
    };
    REQUIREMENTS.iter().zip(all).map(requirement).collect()
}
