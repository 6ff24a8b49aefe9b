//! Allocation: one candidate of each activity, so that every limit is kept; by PANORAMA's rule, or
//! the best one, proven.

use crate::error::{Done, cotama_error};
use crate::firings::COTAMA_NONE;
use crate::memory::{Carver, Pieces};
use core::ffi::c_void;
use cotama_core::allocation::{Allocator, Answer};
use cotama_core::exact::{Exact, Item, Objective, Stage};
use cotama_core::hardware::Equipment;
use cotama_core::panorama::Panorama;
use cotama_core::problem::{Candidate, Problem, ProblemError};

/// The axes of a mission: 0 is the duration in ms, 1 the energy in mJ.
pub const COTAMA_AXES: usize = 2;
/// cbindgen:ignore
type Axes<T> = [T; COTAMA_AXES];
/// cbindgen:ignore
type Way = Candidate<COTAMA_AXES>;

/// One way to do an activity.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_candidate {
    /// The hardware that it needs: 0 to 7 units of each of 16 kinds, four bits a kind, the top one
    /// of them 0. Kind 0 is lowest.
    pub units: u64,
    /// Cost on each axis.
    pub cost: [u32; COTAMA_AXES],
    /// How good the activity is done this way; larger is better. Qualities add up.
    pub quality: u32,
}

/// Activities in sequence with their candidates, and limits.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct cotama_problem {
    /// The candidates of all activities, one activity after the other.
    pub candidates: *const cotama_candidate,
    /// How many there are in all.
    pub candidate_count: usize,
    /// How many of them each activity has.
    pub counts: *const u32,
    /// How many activities there are; at most 65,535, as of the candidates of one.
    pub activity_count: usize,
    /// The hardware that there is, as in `units`: candidates that need more are left out.
    pub available: u64,
    /// The most that a plan may cost on each axis.
    pub limits: [u64; COTAMA_AXES],
    /// The axes in their order of treatment: each once.
    pub order: [u32; COTAMA_AXES],
}

/// The criterion by which a plan is chosen.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_objective {
    /// The most total quality.
    MostQuality = 0,
    /// The least total duration.
    LeastDuration = 1,
    /// The least total energy.
    LeastEnergy = 2,
    /// The most total duration within its limit; objectives behind it are not treated.
    MostDuration = 3,
    /// The most total energy within its limit; objectives behind it are not treated.
    MostEnergy = 4,
}

/// The most objectives of a call.
pub const COTAMA_OBJECTIVES: usize = 4;

/// The verdict of an allocator.
#[repr(i32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum cotama_verdict {
    /// A plan within every limit.
    Planned = 0,
    /// No plan: proven by the exact one; the rule may miss a plan.
    Infeasible = 1,
    /// The steps ended before a plan was found or excluded.
    OutOfBudget = 2,
    /// An activity has no candidate with the hardware that there is.
    WithoutHardware = 3,
}

/// The answer of an allocator. What is not said of its verdict is 0; `axis` is `COTAMA_NONE` then.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct cotama_answer {
    /// Verdict of the allocator.
    pub verdict: cotama_verdict,
    /// For a plan: no plan is better in the objectives.
    pub optimal: bool,
    /// `bound` is known.
    pub bounded: bool,
    /// For a plan: its cost on each axis.
    pub cost: [u64; COTAMA_AXES],
    /// For a plan: its quality.
    pub quality: u64,
    /// No plan has more in the first objective; or less, where the least is asked for.
    pub bound: u64,
    /// The work done, in the allocator's steps.
    pub steps: u64,
    /// Without a plan: the axis whose limit is not met; `COTAMA_NONE` where that is not known.
    pub axis: u32,
    /// Without hardware: the activity.
    pub activity: u32,
    /// Without a plan: the limit of that axis,
    pub limit: u64,
    /// and the least that can be reached there.
    pub least: u64,
}

impl cotama_answer {
    const NOTHING: Self = Self {
        verdict: cotama_verdict::OutOfBudget,
        optimal: false,
        bounded: false,
        cost: [0; COTAMA_AXES],
        quality: 0,
        bound: 0,
        steps: 0,
        axis: COTAMA_NONE,
        activity: 0,
        limit: 0,
        least: 0,
    };
}

impl From<Answer<COTAMA_AXES>> for cotama_answer {
    fn from(answer: Answer<COTAMA_AXES>) -> Self {
        match answer {
            Answer::Planned(it) => Self {
                verdict: cotama_verdict::Planned,
                optimal: it.optimal,
                bounded: it.bound.is_some(),
                cost: it.cost,
                quality: it.quality,
                bound: it.bound.unwrap_or(0),
                steps: it.steps,
                ..Self::NOTHING
            },
            Answer::Infeasible { shortfall, steps } => {
                let verdict = cotama_verdict::Infeasible;
                let mut answer = Self { verdict, steps, ..Self::NOTHING };
                if let Some(it) = shortfall {
                    answer.axis = it.axis() as u32;
                    (answer.limit, answer.least) = (it.limit(), it.least());
                }
                answer
            }
            Answer::Unknown { bound, steps } => {
                Self { bounded: true, bound, steps, ..Self::NOTHING }
            }
        }
    }
}

/// Bytes of memory that planning by the rule needs for each activity,
pub const COTAMA_RULE_ACTIVITY_BYTES: usize = 24;
/// for each candidate,
pub const COTAMA_RULE_CANDIDATE_BYTES: usize = 16;
/// bytes that planning exactly needs for each activity,
pub const COTAMA_EXACT_ACTIVITY_BYTES: usize = 288;
/// for each candidate,
pub const COTAMA_EXACT_CANDIDATE_BYTES: usize = 48;
/// and what either needs beside these.
pub const COTAMA_PLANNING_BYTES: usize = 64;
const _: () = {
    let list = size_of::<&[Way]>();
    assert!(list + size_of::<Axes<u32>>() <= COTAMA_RULE_ACTIVITY_BYTES);
    assert!(size_of::<Way>() <= COTAMA_RULE_CANDIDATE_BYTES);
    assert!(list + size_of::<Stage<COTAMA_AXES>>() <= COTAMA_EXACT_ACTIVITY_BYTES);
    assert!(size_of::<Way>() + size_of::<Item<COTAMA_AXES>>() <= COTAMA_EXACT_CANDIDATE_BYTES);
    assert!(4 * Carver::LOST <= COTAMA_PLANNING_BYTES);
};

/// The axes in their order of treatment.
pub(crate) fn order_of(order: &[u32]) -> Result<Axes<usize>, cotama_error> {
    let mut axes = [COTAMA_AXES; COTAMA_AXES];
    axes.iter_mut().zip(order).for_each(|(axis, it)| *axis = *it as usize);
    let all = (0..COTAMA_AXES).all(|axis| axes.contains(&axis));
    if all { Ok(axes) } else { Err(cotama_error::BadNumber) }
}

/// A problem with its candidates in the caller's memory, or the activity that has none with the
/// hardware that there is.
///
/// cbindgen:ignore
type Loaded<'m> = Result<Problem<'m, COTAMA_AXES>, u32>;

/// Copies the candidates that the hardware allows for; their `id` is their place in their activity.
fn load<'m>(
    given: &cotama_problem,
    (mut rest, counts): (&[cotama_candidate], &[u32]),
    memory: &mut Carver,
) -> Result<Loaded<'m>, cotama_error> {
    let order = order_of(&given.order)?;
    let available = Equipment::from_bits(given.available).ok_or(cotama_error::BadNumber)?;
    let none = Way { cost: [0; COTAMA_AXES], quality: 0, id: 0 };
    let lists = memory.take::<&'m [Way]>(counts.len(), &[])?;
    let mut free = memory.take(rest.len(), none)?;
    let mut lacking = None;
    for ((slot, &count), activity) in lists.iter_mut().zip(counts).zip(0..u32::MAX) {
        let (own, others) = rest.split_at_checked(count as usize).ok_or(cotama_error::BadNumber)?;
        rest = others;
        if own.is_empty() {
            return Err(cotama_error::NoCandidates);
        }
        let mut kept = 0;
        for (at, it) in own.iter().enumerate() {
            let needs = Equipment::from_bits(it.units).ok_or(cotama_error::BadNumber)?;
            let id = u16::try_from(at).map_err(|_| cotama_error::BadNumber)?;
            if let (true, Some(place)) = (available.covers(needs), free.get_mut(kept)) {
                *place = Way { cost: it.cost, quality: it.quality, id };
                kept = kept.saturating_add(1);
            }
        }
        if kept == 0 {
            lacking = lacking.or(Some(activity));
        }
        let (filled, left) = free.split_at_mut_checked(kept).ok_or(cotama_error::TooSmall)?;
        (*slot, free) = (filled, left);
    }
    if !rest.is_empty() {
        return Err(cotama_error::BadNumber);
    }
    if let Some(activity) = lacking {
        return Ok(Err(activity));
    }
    match Problem::new(lists, given.limits, order) {
        Ok(problem) => Ok(Ok(problem)),
        Err(ProblemError::NoCandidates { .. }) => Err(cotama_error::NoCandidates),
        Err(_) => Err(cotama_error::BadNumber),
    }
}

/// Plans; the choices that are written are places in the caller's lists.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
unsafe fn plan<'m>(
    mut pieces: Pieces,
    problem: *const cotama_problem,
    memory: (*mut c_void, usize),
    plan: (*mut u16, usize),
    answer: *mut cotama_answer,
    allocate: impl FnOnce(
        &Problem<'m, COTAMA_AXES>,
        &mut Carver,
        &mut [u16],
    ) -> Result<Answer<COTAMA_AXES>, cotama_error>,
) -> Done {
    // SAFETY: the caller promises the same.
    let (given, lists, answer, mut carver, plan) = unsafe {
        let given = pieces.read(problem)?;
        let candidates = pieces.list(given.candidates, given.candidate_count)?;
        let counts = pieces.list(given.counts, given.activity_count)?;
        let answer = pieces.out(answer)?;
        let carver = pieces.carver(memory.0, memory.1)?;
        (given, (candidates, counts), answer, carver, pieces.list_to_write(plan.0, plan.1)?)
    };
    let plan = plan.get_mut(..given.activity_count).ok_or(cotama_error::TooSmall)?;
    let became = match load(&given, lists, &mut carver)? {
        Err(activity) => {
            let verdict = cotama_verdict::WithoutHardware;
            cotama_answer { verdict, activity, ..cotama_answer::NOTHING }
        }
        Ok(problem) => {
            let became = allocate(&problem, &mut carver, plan)?;
            if let Answer::Planned(_) = became {
                for (choice, ways) in plan.iter_mut().zip(problem.activities()) {
                    *choice = ways.get(usize::from(*choice)).map_or(*choice, |it| it.id);
                }
            }
            became.into()
        }
    };
    answer.put(became);
    Ok(())
}

/// Plans by the rule of PANORAMA (Lambert et al. 2024), in memory of `COTAMA_RULE_BYTES` bytes.
///
/// `plan` has room for a number of each activity: the place of its candidate among those of the
/// activity. It is written when the verdict is `COTAMA_VERDICT_PLANNED`. The memory is free again
/// afterwards, and none of it may overlap the problem, the plan or the answer, nor they each other.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
// SAFETY: no other function of the program has this name; so for all below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_plan_by_rule(
    problem: *const cotama_problem,
    memory: *mut c_void,
    bytes: usize,
    plan: *mut u16,
    plan_length: usize,
    answer: *mut cotama_answer,
) -> cotama_error {
    let pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let done = unsafe {
        self::plan(
            pieces,
            problem,
            (memory, bytes),
            (plan, plan_length),
            answer,
            |it, memory, plan| {
                let caps = memory.take(it.activities().len(), [0; COTAMA_AXES])?;
                Panorama::new(caps).allocate(it, plan).map_err(|_| cotama_error::TooSmall)
            },
        )
    };
    done.into()
}

/// Plans exactly, for up to `COTAMA_OBJECTIVES` of `cotama_objective` in lexicographic order, in
/// memory of `COTAMA_EXACT_BYTES` bytes and at most `steps` steps.
///
/// Without an objective any plan within the limits will do. The rest is as for
/// `cotama_plan_by_rule`.
///
/// # Safety
/// The pointers are null or point to what their types say, of the lengths given.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cotama_plan_exactly(
    problem: *const cotama_problem,
    objectives: *const u32,
    objective_count: usize,
    steps: u64,
    memory: *mut c_void,
    bytes: usize,
    plan: *mut u16,
    plan_length: usize,
    answer: *mut cotama_answer,
) -> cotama_error {
    let mut wanted = [Objective::MostQuality; COTAMA_OBJECTIVES];
    let mut pieces = Pieces::new();
    // SAFETY: the caller promises the same.
    let named = unsafe { objectives_of(&mut pieces, objectives, objective_count, &mut wanted) };
    let objectives = match named {
        Ok(it) => it,
        Err(error) => return error,
    };
    // SAFETY: the caller promises the same.
    let done = unsafe {
        self::plan(
            pieces,
            problem,
            (memory, bytes),
            (plan, plan_length),
            answer,
            |it, memory, plan| {
                let candidates =
                    it.activities().iter().map(|it| it.len()).fold(0, usize::saturating_add);
                let items = memory.take(candidates, Item::EMPTY)?;
                let stages = memory.take(it.activities().len(), Stage::EMPTY)?;
                let mut exact = Exact::new(objectives, steps, items, stages);
                exact.allocate(it, plan).map_err(|_| cotama_error::TooSmall)
            },
        )
    };
    done.into()
}

/// Objectives from their numbers.
///
/// # Safety
/// `objectives` is null or points to `count` numbers.
unsafe fn objectives_of<'w>(
    pieces: &mut Pieces,
    objectives: *const u32,
    count: usize,
    wanted: &'w mut [Objective],
) -> Result<&'w [Objective], cotama_error> {
    let wanted = wanted.get_mut(..count).ok_or(cotama_error::BadNumber)?;
    // SAFETY: the caller promises the same.
    let numbers = unsafe { pieces.list(objectives, count) }?;
    for (slot, number) in wanted.iter_mut().zip(numbers) {
        *slot = match number {
            0 => Objective::MostQuality,
            1 => Objective::Least(0),
            2 => Objective::Least(1),
            3 => Objective::Most(0),
            4 => Objective::Most(1),
            _ => return Err(cotama_error::BadNumber),
        };
    }
    Ok(wanted)
}
