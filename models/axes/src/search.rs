//! Undominated sums of one candidate for each activity: a dynamic programme over merged states.
//!
//! Sums are of columns of which little is good; a limit holds after an activity. A state is the
//! sums so far. One that is nowhere below another, and above it somewhere, leads to nothing
//! better, so it goes. A column that is limited alone is raised to the value from which even the
//! most expensive rest fits: below it, differences do not matter.

use crate::dominance::{Undominated, within};
use crate::steps::{Steps, Stop};

/// No limit.
pub(crate) const FREE: i64 = i64::MAX / 4;
/// A search keeps at most so many partial plans, and makes so many numbers at once.
const MAX_KEPT: usize = 1 << 23;
const MAX_NUMBERS: usize = 1 << 24;

/// A sum of which little is good.
#[derive(Clone, Debug)]
pub(crate) struct Column {
    /// For each activity the values of its candidates.
    pub(crate) values: Vec<Vec<i64>>,
    /// The most that the sum may be after each activity, or [`FREE`].
    pub(crate) limits: Vec<i64>,
    /// Whether less is better, and not just within the limits.
    pub(crate) wanted: bool,
}

/// Sums in the wanted columns, and for each activity its candidate.
pub(crate) type Found = (Vec<i64>, Vec<u16>);

/// Rows one behind the other, and for each the state before it and the candidate taken.
type Sifted = (Vec<i64>, Vec<(u32, u16)>);

/// A stage of the search: an activity, with bounds on the sums after it.
struct Stage {
    activity: usize,
    /// Candidates that no other one is better than, each with its row.
    candidates: Vec<(u16, Vec<i64>)>,
    /// Above it no rest fits.
    caps: Vec<i64>,
    /// Below it every rest fits, and nothing is wanted.
    floors: Vec<i64>,
}

/// Returns the undominated sums of the wanted columns with a plan for each, in rising order; none
/// if no plan is within the limits.
pub(crate) fn undominated(
    columns: &[Column],
    counts: &[usize],
    steps: &mut Steps,
) -> Result<Vec<Found>, Stop> {
    Ok(within_width(columns, counts, (usize::MAX, false), steps)?.0)
}

/// Returns the same of a search that goes on with at most so many states after each activity, and
/// whether there were more: then nothing is proven. Where the first column guides, half of them are
/// those with the least there.
pub(crate) fn within_width(
    columns: &[Column],
    counts: &[usize],
    (most, is_guided): (usize, bool),
    steps: &mut Steps,
) -> Result<(Vec<Found>, bool), Stop> {
    let mut was_cut = false;
    let stages = stages(columns, counts);
    let width = columns.len();
    let mut rows = vec![0; width];
    let mut number = 1;
    let mut links: Vec<Vec<(u32, u16)>> = Vec::new();
    let mut kept = 0;
    for stage in &stages {
        let mut fresh = Vec::new();
        let mut origins = Vec::new();
        for parent in 0..number {
            let from = rows.get(parent * width..(parent + 1) * width).unwrap_or(&[]);
            steps.take(stage.candidates.len() as u64)?;
            for (choice, more) in &stage.candidates {
                let start = fresh.len();
                let sums = from.iter().zip(more).zip(&stage.floors);
                fresh.extend(sums.map(|((a, b), floor)| raised(a + b, *floor)));
                if within(fresh.get(start..).unwrap_or(&[]), &stage.caps) {
                    origins.push((parent as u32, *choice));
                } else {
                    fresh.truncate(start);
                }
            }
            if fresh.len() > MAX_NUMBERS {
                return Err(Stop::Limit);
            }
        }
        let mut own;
        (rows, own) = sifted(width, &fresh, &origins, steps)?;
        if own.len() > most {
            // Rows are in rising order: evenly taken, they differ much.
            let half = if is_guided { most / 2 } else { 0 };
            let step = |it: usize| half + it * (own.len() - half) / (most - half);
            let taken: Vec<_> = (0..half).chain((0..most - half).map(step)).collect();
            let row = |it: &usize| rows.get(it * width..(it + 1) * width).unwrap_or(&[]).to_vec();
            rows = taken.iter().flat_map(row).collect();
            own = taken.iter().filter_map(|&it| own.get(it).copied()).collect();
            was_cut = true;
        }
        number = own.len();
        kept += number;
        if kept > MAX_KEPT {
            return Err(Stop::Limit);
        }
        links.push(own);
    }
    let wanted: Vec<_> = columns.iter().map(|it| it.wanted).collect();
    let last: Vec<i64> = if width == 0 {
        Vec::new()
    } else {
        let rows = rows.chunks(width);
        let of = |row: &[i64]| row.iter().zip(&wanted).filter(|it| *it.1).map(|it| *it.0).collect();
        rows.flat_map(|row| -> Vec<i64> { of(row) }).collect()
    };
    let origins: Vec<_> = (0..number).map(|it| (it as u32, 0)).collect();
    let width = wanted.iter().filter(|it| **it).count();
    let (rows, ends) = sifted(width, &last, &origins, steps)?;
    let plan = |end: u32| {
        let mut plan = vec![0; counts.len()];
        let mut at = end;
        for (stage, links) in stages.iter().zip(&links).rev() {
            let Some(&(parent, choice)) = links.get(at as usize) else { break };
            if let Some(it) = plan.get_mut(stage.activity) {
                *it = choice;
            }
            at = parent;
        }
        plan
    };
    let row =
        |number: usize| rows.get(number * width..(number + 1) * width).unwrap_or(&[]).to_vec();
    let found = ends.iter().enumerate().map(|(number, end)| (row(number), plan(end.0))).collect();
    Ok((found, was_cut))
}

/// Returns a sum raised to the value from which every rest fits; without limits to come all are
/// one.
const fn raised(sum: i64, floor: i64) -> i64 {
    if floor >= FREE / 2 {
        return 0;
    }
    if sum > floor { sum } else { floor }
}

/// Returns the undominated rows, one of equals, in rising order, each with its origin.
fn sifted(
    width: usize,
    rows: &[i64],
    origins: &[(u32, u16)],
    steps: &mut Steps,
) -> Result<Sifted, Stop> {
    if width == 0 {
        return Ok((Vec::new(), origins.iter().take(1).copied().collect()));
    }
    let row = |it: u32| rows.get(it as usize * width..(it as usize + 1) * width).unwrap_or(&[]);
    let mut order: Vec<_> = (0..origins.len() as u32).collect();
    order.sort_by(|&a, &b| row(a).cmp(row(b)));
    let mut kept = Vec::new();
    let mut tree = Undominated::new(width);
    for it in order {
        let (is_new, looked) = tree.offer(row(it));
        steps.take(looked)?;
        if is_new {
            kept.extend(origins.get(it as usize));
        }
    }
    Ok((tree.into_rows(), kept))
}

/// Returns the stages: as the activities follow if a limit holds before the end, else those first
/// whose candidates differ most.
fn stages(columns: &[Column], counts: &[usize]) -> Vec<Stage> {
    let value = |column: &Column, activity: usize, choice: usize| {
        column.values.get(activity).and_then(|it| it.get(choice)).copied().unwrap_or(0)
    };
    let least_and_most = |column: &Column, activity: usize| {
        let values = column.values.get(activity).map_or(&[][..], Vec::as_slice);
        let least = values.iter().min().copied().unwrap_or(0);
        (least, values.iter().max().copied().unwrap_or(0))
    };
    let mut order: Vec<_> = (0..counts.len()).collect();
    let last = counts.len().saturating_sub(1);
    let is_early = |it: &Column| it.limits.iter().take(last).any(|&it| it < FREE);
    if !columns.iter().any(is_early) {
        let spread = |activity: usize| {
            let one = |it: &Column| {
                let (least, most) = least_and_most(it, activity);
                most - least
            };
            columns.iter().map(one).max().unwrap_or(0)
        };
        order.sort_by_key(|&it| std::cmp::Reverse(spread(it)));
    }
    let mut stages = Vec::new();
    let mut caps = vec![FREE; columns.len()];
    let mut floors: Vec<_> =
        columns.iter().map(|it| if it.wanted { -FREE } else { FREE }).collect();
    for (place, &activity) in order.iter().enumerate().rev() {
        // A limit of the end holds after the stage that comes last, whatever activity that is.
        let at = if place == last { last } else { activity };
        let is_last = place == last;
        for (column, (cap, floor)) in columns.iter().zip(caps.iter_mut().zip(&mut floors)) {
            let limit = column.limits.get(at).copied().unwrap_or(FREE);
            let limit = if at == last && !is_last { FREE } else { limit };
            *cap = limit.min(*cap);
            *floor = limit.min(*floor);
        }
        let rows = (0..counts.get(activity).copied().unwrap_or(0)).map(|choice| {
            let row = columns.iter().map(|it| value(it, activity, choice)).collect();
            (choice as u16, row)
        });
        stages.push(Stage {
            activity,
            candidates: best(&rows.collect::<Vec<_>>()),
            caps: caps.clone(),
            floors: floors.clone(),
        });
        for (column, (cap, floor)) in columns.iter().zip(caps.iter_mut().zip(&mut floors)) {
            let (least, most) = least_and_most(column, activity);
            *cap = if *cap >= FREE / 2 { *cap } else { *cap - least };
            *floor = if floor.abs() >= FREE / 2 { *floor } else { *floor - most };
        }
    }
    stages.reverse();
    stages
}

/// Returns the candidates that none is better than, the first of equals.
fn best(rows: &[(u16, Vec<i64>)]) -> Vec<(u16, Vec<i64>)> {
    let is_worse = |(choice, row): &(u16, Vec<i64>)| {
        rows.iter().any(|(other, than)| within(than, row) && (than != row || other < choice))
    };
    rows.iter().filter(|it| !is_worse(it)).cloned().collect()
}
