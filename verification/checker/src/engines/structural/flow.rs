//! Invariants of places and transitions: solutions of homogeneous equations, in integers.

use super::Limit;
use super::row::{Row, at, cancelling, combined};
use super::work::Work;
use cotama_property::pt::{Lists, Pt};
use std::collections::BTreeMap;

/// Numbers and rows that the method of Farkas looks at before it ends: some tenths of a second.
const WORK: usize = 5_000_000;

/// Weights of places or of transitions, sorted by id, without a common divisor.
///
/// Of places: the weighted sum of tokens never changes. Of transitions: firing each so often
/// changes nothing.
pub type Flow = Vec<(u32, i64)>;

/// Flows without negative weights whose places (or transitions) contain those of no other one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Semiflows {
    /// The flows found, sorted.
    pub flows: Vec<Flow>,
    /// Whether these are all; otherwise a limit was reached, or numbers got too large.
    pub complete: bool,
}

/// A basis of all place invariants: each is a rational combination of these. `None` when a number
/// passes 63 bits.
///
/// ```
/// use cotama_core::net::owned::{OwnedNet, OwnedPlace, OwnedTransition};
/// use cotama_verification::{pt::Pt, structural};
///
/// let mut net = OwnedNet::new("pairs", "");
/// let one = net.place(OwnedPlace::new("one", 4)).unwrap();
/// let pair = net.place(OwnedPlace::new("pair", 0)).unwrap();
/// net.transition(OwnedTransition::new("join").take(one, 2).give(pair, 1)).unwrap();
/// let net = Pt::from(&net.view().net());
/// assert_eq!(structural::place_invariants(&net), Some(vec![vec![(0, 1), (1, 2)]]));
/// assert_eq!(structural::transition_invariants(&net), Some(vec![]));
/// ```
pub fn place_invariants(pt: &Pt) -> Option<Vec<Flow>> {
    basis(&pt.changers, pt.transitions.len() as u32, &mut Work::unlimited()).ok()
}

/// A basis of all transition invariants: each is a rational combination of these. `None` when a
/// number passes 63 bits.
///
/// ```
/// use cotama_checker::structural::transition_invariants;
/// use cotama_verification::tina;
/// let net = tina::read("lamp.net", b"tr on a -> b*2  tr off b -> a  pl a (1)").unwrap().untimed();
/// assert_eq!(transition_invariants(&net), Some(vec![])); // what fires leaves its traces
/// let net = tina::read("lamp.net", b"tr on a -> b  tr off b -> a  pl a (1)").unwrap().untimed();
/// assert_eq!(transition_invariants(&net), Some(vec![vec![(0, 1), (1, 1)]]));
/// ```
pub fn transition_invariants(pt: &Pt) -> Option<Vec<Flow>> {
    basis(&pt.effects, pt.places.len() as u32, &mut Work::unlimited()).ok()
}

/// The minimal semiflows of places, by the method of Farkas with at most `limit` rows at a time.
///
/// ```
/// use cotama_checker::structural::place_semiflows;
/// use cotama_verification::tina;
/// let net = b"tr take free tool -> busy  tr give busy -> free tool  pl free (1) pl tool (1)";
/// let net = tina::read("tool.net", net).unwrap().untimed();
/// let found = place_semiflows(&net, 1_000);
/// let names = |flow: &Vec<(u32, i64)>| -> Vec<&str> {
///     flow.iter().map(|it| net.places[it.0 as usize].as_str()).collect()
/// };
/// let sums: Vec<_> = found.flows.iter().map(names).collect();
/// assert!(found.complete);
/// assert_eq!(sums, [["free", "busy"], ["tool", "busy"]]);
/// ```
pub fn place_semiflows(pt: &Pt, limit: usize) -> Semiflows {
    semiflows(&pt.changers, pt.transitions.len() as u32, limit)
}

/// The minimal semiflows of transitions, by the method of Farkas with at most `limit` rows at a
/// time.
pub fn transition_semiflows(pt: &Pt, limit: usize) -> Semiflows {
    semiflows(&pt.effects, pt.places.len() as u32, limit)
}

/// Each row of the matrix, and behind it in columns of their own which rows were added up.
fn augmented(matrix: &Lists<i64>, width: u32) -> impl Iterator<Item = Row> {
    (0..matrix.len() as u32).map(move |id| {
        let mut row = matrix.of(id).to_vec();
        row.push((width + id, 1));
        row
    })
}

fn flow(row: &Row, width: u32) -> Flow {
    row.iter().map(|&(column, weight)| (column - width, weight)).collect()
}

/// A basis of what multiplied with the rows of a matrix of this width gives zero.
pub(super) fn basis(matrix: &Lists<i64>, width: u32, work: &mut Work) -> Result<Vec<Flow>, Limit> {
    let mut rows: Vec<Row> = augmented(matrix, width).collect();
    rows.sort_by_key(Vec::len);
    let mut leading: BTreeMap<u32, Row> = BTreeMap::new();
    let mut flows = Vec::new();
    for mut row in rows {
        // Each row ends with its own column.
        while let Some(&(column, number)) = row.first() {
            if column >= width {
                flows.push(flow(&row, width));
                break;
            }
            let Some(pivot) = leading.get(&column) else {
                leading.insert(column, row);
                break;
            };
            work.spend(row.len() + pivot.len())?;
            let (a, b) = cancelling(number, at(pivot, column)).ok_or(Limit::Tokens)?;
            row = combined(&row, a, pivot, b).ok_or(Limit::Tokens)?;
        }
    }
    // Most flows of a net have no negative weights: show them that way round.
    for flow in &mut flows {
        if flow.iter().filter(|it| it.1 < 0).count() * 2 > flow.len() {
            for it in flow.iter_mut() {
                it.1 = it.1.checked_neg().ok_or(Limit::Tokens)?;
            }
        }
    }
    flows.sort_unstable();
    debug_assert!(flows.iter().all(|it| is_solution(matrix, it)));
    Ok(flows)
}

/// Whether the rows of a matrix, so often each, add up to zero.
fn is_solution(matrix: &Lists<i64>, flow: &Flow) -> bool {
    let mut sums: BTreeMap<u32, i128> = BTreeMap::new();
    for &(row, weight) in flow {
        for &(column, number) in matrix.of(row) {
            *sums.entry(column).or_default() += i128::from(weight) * i128::from(number);
        }
    }
    sums.values().all(|it| *it == 0)
}

fn semiflows(matrix: &Lists<i64>, width: u32, limit: usize) -> Semiflows {
    let mut rows: Vec<Row> = augmented(matrix, width).collect();
    let mut complete = rows.len() <= limit;
    let mut work = WORK;
    while complete {
        let mut signs = vec![(0_usize, 0_usize); width as usize];
        for &(column, number) in rows.iter().flatten().filter(|it| it.0 < width) {
            let (up, down) = &mut signs[column as usize];
            *if number > 0 { up } else { down } += 1;
        }
        let used = (0..width).filter(|&it| signs[it as usize] != (0, 0));
        let Some(column) = used.min_by_key(|&it| {
            let (up, down) = signs[it as usize];
            (up * down).saturating_sub(up + down)
        }) else {
            break;
        };
        let (touched, mut kept): (Vec<_>, Vec<_>) =
            rows.into_iter().partition(|it| at(it, column) != 0);
        let (up, down): (Vec<_>, Vec<_>) = touched.iter().partition(|it| at(it, column) > 0);
        let mut new = Vec::new();
        'pairs: for (up, down) in up.iter().flat_map(|up| down.iter().map(move |down| (up, down))) {
            // The signs differ, so that both factors are positive.
            let sum = cancelling(at(up, column), at(down, column))
                .and_then(|(a, b)| combined(up, a, down, b));
            match sum {
                Some(row) if new.len() < limit.saturating_mul(4) && work >= row.len() => {
                    work -= row.len();
                    new.push(row);
                }
                _ => {
                    complete = false;
                    break 'pairs;
                }
            }
        }
        // A row is wanted only if no other one has fewer of the things that are added up.
        new.sort_by_cached_key(|it| (support(it, width).count(), it.clone()));
        for row in new {
            work = work.saturating_sub(kept.len());
            if !kept.iter().any(|it| covers(&row, it, width)) {
                kept.push(row);
            }
        }
        complete &= kept.len() <= limit && work > 0;
        rows = kept;
    }
    let is_flow = |it: &&Row| it.first().is_some_and(|it| it.0 >= width);
    let mut flows: Vec<_> = rows.iter().filter(is_flow).map(|it| flow(it, width)).collect();
    flows.sort_unstable();
    debug_assert!(flows.iter().all(|it| is_solution(matrix, it) && it.iter().all(|it| it.1 > 0)));
    Semiflows { flows, complete }
}

fn support(row: &Row, width: u32) -> impl Iterator<Item = u32> {
    row.iter().rev().map(|it| it.0).take_while(move |&it| it >= width)
}

/// Whether the first row adds up everything that the second one does.
fn covers(row: &Row, other: &Row, width: u32) -> bool {
    support(other, width).all(|it| row.binary_search_by_key(&it, |it| it.0).is_ok())
}
