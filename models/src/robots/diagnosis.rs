//! From flags to failures.

use super::Robot;

/// Returns the failures that flags are taken for: one is a unique diagnosis; several are told apart
/// by nothing, and all of them are taken to be there (Durand et al., TAROS 2010, Section III.B;
/// that all are taken is assumed, as it is the safe side). `up` has an entry for each
/// [flag](Robot::flags), `raised` are those that are new.
///
/// A failure is a candidate when all of its flags are up and one of them is new; one whose flags
/// another candidate shows as well, with more, is left out. Where none is a candidate, all failures
/// are that a new flag always shows. The worst stand first.
///
/// ```
/// use cotama_models::robots::{Robot, diagnose};
/// let robot = Robot::shipped("transport").unwrap();
/// let names: Vec<_> = robot.flags().map(|it| it.1).collect();
/// let late = names.iter().position(|it| *it == "depth_late").unwrap();
/// let mut up = vec![false; names.len()];
/// up[late] = true;
/// let found = diagnose(&robot, &up, &[late]);
/// assert_eq!(found.iter().map(|it| &robot.failures[*it].id[..]).collect::<Vec<_>>(), ["CAM1"]);
/// ```
pub fn diagnose(robot: &Robot, up: &[bool], raised: &[usize]) -> Vec<usize> {
    let is_up = |flag: &usize| up.get(*flag).copied().unwrap_or(false);
    let flags = |it: usize| robot.failures.get(it).map_or(&[][..], |it| &it.flags[..]);
    let is_new = |it: usize| flags(it).iter().any(|flag| raised.contains(flag));
    let all = || 0..robot.failures.len();
    let whole: Vec<usize> =
        all().filter(|it| is_new(*it) && flags(*it).iter().all(is_up)).collect();
    let says_less = |one: usize, other: usize| {
        flags(one).len() < flags(other).len()
            && flags(one).iter().all(|it| flags(other).contains(it))
    };
    let mut found: Vec<usize> = if whole.is_empty() {
        all().filter(|it| is_new(*it)).collect()
    } else {
        let said = |it: &usize| whole.iter().any(|other| says_less(*it, *other));
        whole.iter().copied().filter(|it| !said(it)).collect()
    };
    let severity = |it: &usize| robot.failures.get(*it).map(|it| it.autonomous.max(it.operator));
    found.sort_by_key(|it| std::cmp::Reverse(severity(it)));
    found
}
