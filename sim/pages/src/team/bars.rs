//! The lane of a robot: what it did, stretch by stretch.

use crate::format::seconds;
use cotama_models::team::scenario::Stage;
use cotama_sim::fleet::record::Record;
use cotama_sim::fleet::trace::Trace;

/// A stretch of a lane.
pub(super) struct Bar {
    pub(super) from: u64,
    pub(super) to: u64,
    pub(super) class: &'static str,
    pub(super) does: &'static str,
    pub(super) label: String,
    pub(super) title: String,
}

/// Returns since when the partner of an exchange is there as well, if a robot takes from a partner
/// or gives to one from a time on; none where it does neither. The robots of an award stand in the
/// order in which they hand over.
fn partner_comes(
    trace: &Trace,
    robot: usize,
    task: usize,
    stage: Stage,
    from_ms: u64,
) -> Option<u64> {
    let award = trace.records.iter().rev().find_map(|it| match it {
        Record::Awarded { t_ms, task: of, robots, .. } if *of == task && *t_ms <= from_ms => {
            Some((*t_ms, robots))
        }
        _ => None,
    });
    let (awarded_ms, robots) = award?;
    let role = robots.iter().position(|it| *it == robot)?;
    let (partner, theirs) = match stage {
        Stage::Gives => (*robots.get(role + 1)?, Stage::Takes),
        Stage::Takes => (*robots.get(role.checked_sub(1)?)?, Stage::Gives),
        _ => return None,
    };
    let comes = trace.records.iter().find_map(|it| match it {
        Record::Stage { t_ms, robot, task: Some(of), stage }
            if *t_ms >= awarded_ms && (*robot, *of, *stage) == (partner, task, theirs) =>
        {
            Some(*t_ms)
        }
        _ => None,
    });
    Some(comes.unwrap_or(u64::MAX))
}

/// Returns the stretches of a robot's lane, in their order.
pub(super) fn bars(trace: &Trace, robot: usize, end_ms: u64) -> Vec<Bar> {
    let mut bars = Vec::new();
    let mut current: Option<(u64, Option<usize>, Stage)> = None;
    // On its way home, or charged there.
    let mut for_itself = false;
    let own = trace.records.iter().filter_map(|it| match it {
        Record::Stage { t_ms, robot: of, task, stage } if *of == robot => {
            Some(((*t_ms, *task, *stage), None))
        }
        Record::GoesHome { t_ms, robot: of, .. } if *of == robot => {
            Some(((*t_ms, None, Stage::Rests), Some(true)))
        }
        Record::Charged { t_ms, robot: of } if *of == robot => {
            Some(((*t_ms, None, Stage::Rests), Some(false)))
        }
        _ => None,
    });
    for (next, turns) in own.chain([((end_ms, None, Stage::Rests), None)]) {
        if let Some((from, task, stage)) = current.filter(|it| it.0 < next.0) {
            let (class, does) = match stage {
                Stage::ToTake if for_itself => ("f1", "drives home"),
                Stage::Rests if for_itself => ("f3", "is charged"),
                Stage::ToTake => ("f6", "drives to take"),
                Stage::Takes => ("f5", "takes"),
                Stage::ToGive => ("f0", "drives to give"),
                Stage::Gives => ("f5", "gives"),
                Stage::Stops | Stage::Safe => ("gone", "is out of work"),
                Stage::Rests | Stage::Done => {
                    current = Some(next);
                    for_itself = turns.unwrap_or(for_itself);
                    continue;
                }
            };
            let label = task.map_or(String::new(), |it| trace.task(it).to_owned());
            let comes = task.and_then(|it| partner_comes(trace, robot, it, stage, from));
            let comes = comes.map_or(from, |it| it.clamp(from, next.0));
            let parts =
                [(from, comes, "f2", "waits for its partner"), (comes, next.0, class, does)];
            for (from, to, class, does) in parts.into_iter().filter(|it| it.0 < it.1) {
                let title = format!(
                    "{}: {does}, {} to {}",
                    if label.is_empty() { trace.robot(robot) } else { &label },
                    seconds(from),
                    seconds(to)
                );
                bars.push(Bar { from, to, class, does, label: label.clone(), title });
            }
        }
        current = Some(next);
        for_itself = turns.unwrap_or(for_itself);
    }
    bars
}
