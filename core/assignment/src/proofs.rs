//! Costs, the assignment and its proof, and coalitions, against all solutions of small instances.

use super::assignment::Work;
use super::scan::Row;
use super::*;
use cotama_units::proofs::few;

/// Any cost below three, or none.
fn any_entry() -> Option<Cost> {
    match few::<2>() {
        3 => None,
        cost => Cost::new(u32::from(cost)),
    }
}

/// The orders of three.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// The totals of all assignments of up to three rows to three columns.
fn totals(costs: &Costs<'_>) -> impl Iterator<Item = u64> {
    ORDERS.into_iter().filter_map(move |order| {
        let mut costs = (0..costs.rows()).map(|row| costs.cost(row, order[row]));
        costs.try_fold(0, |sum, it| Some(sum + u64::from(it?.get())))
    })
}

/// A cost is stored as its number, compared as its number, and refused when it is above the most.
#[kani::proof]
pub fn a_cost_is_its_number() {
    let (a, b): (u32, u32) = (kani::any(), kani::any());
    let (one, other) = (Cost::new(a), Cost::new(b));
    assert!(one.is_some() == (a <= Cost::MOST));
    if let (Some(one), Some(other)) = (one, other) {
        assert!(one.get() == a && (one < other) == (a < b) && (one == other) == (a == b));
    }
    kani::cover!(one.is_none(), "refused");
    kani::cover!(one.is_some() && other.is_some() && a < b, "two");
}

/// A table under a limit has the costs that are within it, and knows whether any lacks and what is
/// the most.
#[kani::proof]
#[kani::unwind(7)]
pub fn a_table_under_a_limit_has_the_costs_within() {
    let entries: [Option<Cost>; 6] = core::array::from_fn(|_| any_entry());
    let (limit, strict) = (u32::from(few::<1>()), kani::any());
    let (Some(all), Some(at)) = (Costs::new(&entries, 3), Cost::new(limit)) else { unreachable!() };
    let table = if strict { all.below(at) } else { all.at_most(at) };
    let within = |it: &Cost| if strict { it.get() < limit } else { it.get() <= limit };
    let mut lacks = false;
    for row in 0..2 {
        for (column, said) in table.row(row).enumerate() {
            let own = entries[3 * row + column].filter(within);
            assert!(said == own && table.cost(row, column) == own);
            assert!(own.is_none_or(|it| it.get() <= table.most()));
            lacks |= own.is_none();
        }
    }
    assert!(table.lacks_any() || !lacks);
    assert!(table.rows() == 2 && table.cost(2, 0).is_none() && table.cost(0, 3).is_none());
    assert!(Costs::new(&entries, 4).is_none());
    kani::cover!(lacks && strict && limit == 1, "some are cut");
}

/// An assignment of three rows is the cheapest of all, and its prices prove it; where there is
/// none, the rows in conflict could have fewer columns than they are.
#[kani::proof]
#[kani::unwind(10)]
pub fn an_assignment_is_the_least_and_is_proven() {
    let entries: [Option<Cost>; 9] = core::array::from_fn(|_| any_entry());
    let Some(costs) = Costs::new(&entries, 3) else { unreachable!() };
    let mut memory = Fixed::<i32, 3, 3>::new();
    let mut memory = memory.memory();
    let said = assign(&costs, &mut memory);
    let least = totals(&costs).min();
    match said {
        Ok(total) => {
            assert!(least == Some(total));
            assert!(is_least(&costs, |it| memory.column(it), |it| memory.price(it)) == Ok(total));
            assert!((0..3).all(|it| memory.row(it).is_some_and(|r| memory.column(r) == Some(it))));
        }
        Err(AssignmentError::Infeasible { rows, columns }) => {
            assert!(least.is_none() && columns < rows);
            assert!(conflict(&costs, |it| memory.in_conflict(it)) == (rows, columns));
        }
        Err(_) => unreachable!(),
    }
    kani::cover!(said == Ok(4), "two have no other choice");
    kani::cover!(least.is_none() && !memory.in_conflict(0), "the first row is not in conflict");
}

/// With fewer rows than columns the assignment is the cheapest as well, by 64 bits as by 32, and
/// columns that nobody has cost nothing.
#[kani::proof]
#[kani::unwind(10)]
pub fn a_wide_assignment_is_the_least_and_is_proven() {
    let entries: [Option<Cost>; 6] = core::array::from_fn(|_| any_entry());
    let Some(costs) = Costs::new(&entries, 3) else { unreachable!() };
    let (mut short, mut long) = (Fixed::<i32, 2, 3>::new(), Fixed::<i64, 2, 3>::new());
    let (mut short, mut long) = (short.memory(), long.memory());
    let said = assign(&costs, &mut long);
    assert!(assign(&costs, &mut short) == said);
    let least = totals(&costs).min();
    assert!(said.ok() == least);
    if let Ok(total) = said {
        assert!(is_least(&costs, |it| long.column(it), |it| long.price(it)) == Ok(total));
        assert!((0..3).all(|it| long.row(it).is_some() || long.price(it) == 0));
    }
    kani::cover!(said == Ok(0) && long.column(1) == Some(0), "the second has the first");
    kani::cover!(said.is_err(), "none");
}

/// Shortest paths alone, without what is tried before them, find the cheapest assignment and prices
/// that prove it.
#[kani::proof]
#[kani::unwind(10)]
pub fn shortest_paths_assign_the_least() {
    let entries: [Option<Cost>; 9] = core::array::from_fn(|_| any_entry());
    let Some(costs) = Costs::new(&entries, 3) else { unreachable!() };
    let mut fixed = Fixed::<i32, 3, 3>::new();
    let mut memory = fixed.memory();
    let Ok(mut work) = Work::start(&costs, &mut memory) else { unreachable!() };
    let grown = (0..3).try_for_each(|row| work.grow(row));
    let memory = work.memory;
    let said = is_least(&costs, |it| memory.column(it), |it| memory.price(it));
    let least = totals(&costs).min();
    assert!(grown.is_ok() == least.is_some());
    assert!(grown.is_err() || said.ok() == least);
    kani::cover!(memory.column(2) == Some(0) && memory.price(0) < -1, "a long way");
    kani::cover!(grown.is_err(), "none");
}

/// An assignment that the checker accepts is the cheapest of all, whoever made it and whatever its
/// prices.
#[kani::proof]
#[kani::unwind(7)]
pub fn a_proof_that_is_accepted_is_true() {
    let entries: [Option<Cost>; 6] = core::array::from_fn(|_| any_entry());
    let Some(costs) = Costs::new(&entries, 3) else { unreachable!() };
    let chosen = [usize::from(few::<2>()), usize::from(few::<2>())];
    let prices = [0; 3].map(|_: i64| i64::from(few::<2>()) - 2);
    let said = is_least(&costs, |row| chosen.get(row).copied(), |column| prices[column]);
    if let Ok(total) = said {
        assert!(chosen[0] != chosen[1] && totals(&costs).min() == Some(total));
    }
    kani::cover!(said.is_ok() && prices != [0; 3], "accepted for its prices");
    kani::cover!(matches!(said, Err(ProofError::Price { .. })), "refused for its prices");
}

/// The largest cost of a bottleneck assignment is the least possible, and so is its total among
/// those.
#[kani::proof]
#[kani::unwind(10)]
pub fn a_bottleneck_is_the_least() {
    let entries: [Option<Cost>; 6] = core::array::from_fn(|_| any_entry());
    let fixed = [Cost::new(1), Cost::new(2), Cost::new(0)];
    let entries: [Option<Cost>; 9] =
        core::array::from_fn(|at| if at < 6 { entries[at] } else { fixed[at - 6] });
    let Some(costs) = Costs::new(&entries, 3) else { unreachable!() };
    let mut memory = Fixed::<i32, 3, 3>::new();
    let said = bottleneck(&costs, &mut memory.memory());
    let dearest = |order: [usize; 3]| {
        let costs = [0, 1, 2].map(|row| costs.cost(row, order[row]));
        costs.into_iter().try_fold(0, |most, it| Some(u32::max(most, it?.get())))
    };
    let largest = ORDERS.into_iter().filter_map(dearest).min();
    match said {
        Ok(found) => {
            assert!(found.largest.map(Cost::get) == largest);
            let within = found.largest.map_or(costs, |it| costs.at_most(it));
            assert!(totals(&within).min() == Some(found.total));
            kani::cover!(Some(found.total) > totals(&costs).min(), "dearer, and more even");
        }
        Err(_) => assert!(largest.is_none()),
    }
}

/// The two nearest columns of a row are the nearest and how far the next one is, looked at one by
/// one.
#[kani::proof]
#[kani::unwind(11)]
pub fn the_two_nearest_are_found() {
    let entry = |at: usize| if kani::any() { Cost::new(at as u32 % 3) } else { None };
    let row: [Option<Cost>; 10] = core::array::from_fn(entry);
    let prices: [i32; 10] = core::array::from_fn(|at| if at % 4 == 3 { -1 } else { 0 });
    let Some(costs) = Costs::new(&row, 10) else { unreachable!() };
    let scan = Row::new(&costs, 0, &prices);
    let nearest = scan.two_nearest();
    let away = |at: usize| row[at].map_or(i32::MAX, |it| 2 * it.get() as i32 - prices[at]);
    let (mut first, mut place, mut second) = (i32::MAX, 0, i32::MAX);
    for at in 0..10 {
        if away(at) < first {
            (second, first, place) = (first, away(at), at);
        } else {
            second = second.min(away(at));
        }
    }
    assert!(nearest.away == first && nearest.second == second);
    assert!(nearest.column == (first < second).then_some(place));
    let next = scan.next_equal(first, place);
    assert!(away(next) == first && (next != place || second > first));
    kani::cover!(place == 9, "the last one");
    kani::cover!(first == second && first < i32::MAX, "two as near");
}

/// So they are among many columns, which are looked at sixteen at a time: wherever the nearest, the
/// next and a missing one are.
#[kani::proof]
#[kani::unwind(36)]
pub fn the_two_nearest_of_many_are_found() {
    let mut row = [if kani::any() { Cost::new(2) } else { None }; 35];
    let [first, next, missing] = core::array::from_fn(|_| usize::from(few::<5>()) + 3);
    let dearer = u32::from(kani::any::<bool>());
    row[missing] = None;
    row[next] = Cost::new(dearer);
    row[first] = Cost::new(0);
    let Some(costs) = Costs::new(&row, 35) else { unreachable!() };
    let prices = [0; 35];
    let scan = Row::new(&costs, 0, &prices);
    let nearest = scan.two_nearest();
    let second =
        (0..35).filter(|it| *it != first).filter_map(|it| row[it]).min_by_key(|it| it.get());
    let second = second.map_or(i32::MAX, |it| 2 * it.get() as i32);
    assert!(nearest.away == 0 && nearest.second == second);
    assert!(nearest.column == (second > 0).then_some(first));
    let other = if second == 0 { next } else { first };
    assert!(scan.next_equal(0, first) == other);
    kani::cover!(first % 16 == next % 16 && first != next && dearer == 0, "in the same lane");
    kani::cover!(first > 31 && next < 16, "behind the last sixteen");
}

/// The cheapest plan of a task is the cheapest for all ways to staff each plan, for sums, means and
/// the largest cost alike.
#[kani::proof]
#[kani::unwind(10)]
pub fn a_coalition_is_the_cheapest() {
    let (single, pair): ([Option<Cost>; 2], [Option<Cost>; 4]) =
        (core::array::from_fn(|_| any_entry()), core::array::from_fn(|_| any_entry()));
    let (Some(single), Some(pair)) = (Costs::new(&single, 2), Costs::new(&pair, 2)) else {
        unreachable!()
    };
    let combine = match few::<2>() {
        0 => Combine::Sum,
        1 => Combine::Mean,
        _ => Combine::Max,
    };
    let extra = u32::from(few::<1>());
    let plans = [Plan { roles: pair, extra: 0 }, Plan { roles: single, extra }];
    let turned: bool = kani::any();
    let plans = if turned { [plans[1], plans[0]] } else { plans };
    let task = Task { skip: None, combine, plans: &plans };
    let alone = [0, 1].map(|robot| Some(2 * u64::from(single.cost(0, robot)?.get() + extra)));
    let both = [[0, 1], [1, 0]].map(|of: [usize; 2]| {
        let (a, b) = (u64::from(pair.cost(0, of[0])?.get()), u64::from(pair.cost(1, of[1])?.get()));
        Some(match combine {
            Combine::Sum => 2 * (a + b),
            Combine::Mean => a + b,
            Combine::Max => 2 * a.max(b),
        })
    });
    let least = alone.into_iter().chain(both).flatten().min();
    let mut memory = Fixed::<i32, 2, 2>::new();
    let said = coalition(&task, 2, &mut memory.memory());
    assert!(said.as_ref().ok().map(|it| it.cost) == least);
    if let Ok(found) = said {
        let own = if (found.plan == 1) == turned { both } else { alone };
        assert!(own.into_iter().flatten().min() == least);
    }
    let by_two = said.is_ok_and(|it| (it.plan == 1) == turned);
    kani::cover!(by_two && combine == Combine::Mean, "two share");
    kani::cover!(said.is_err(), "nobody can");
}
