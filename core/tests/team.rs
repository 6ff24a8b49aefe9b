//! Who does what: assignments against all assignments, and what proves them.
#![allow(missing_docs, clippy::pedantic, clippy::unwrap_used)]

#[path = "common/draw.rs"]
mod draw;

use cotama_core::team::{Assigned, Column, Cost, Costs, Row, assign};
use draw::Draw;

/// A number below another one.
fn below(draw: &mut Draw, end: u64) -> u64 {
    draw.between(0, end - 1)
}

/// A table with so many percent of its edges missing.
fn table(
    draw: &mut Draw,
    rows: usize,
    columns: usize,
    most: u64,
    missing: u64,
) -> Vec<Option<Cost>> {
    let entry = |draw: &mut Draw| {
        let cost = Cost::new(below(draw, most) as u32);
        if below(draw, 100) < missing { None } else { cost }
    };
    (0..rows * columns).map(|_| entry(draw)).collect()
}

/// The least total over all assignments: by the set of columns that the first rows have.
fn least(costs: &Costs<'_>) -> Option<u64> {
    let mut best = vec![None; 1 << costs.columns()];
    best[0] = Some(0_u64);
    for row in 0..costs.rows() {
        let mut next = vec![None; best.len()];
        for (set, total) in best.iter().enumerate().filter_map(|(set, it)| Some((set, (*it)?))) {
            for (column, cost) in costs.row(row).iter().enumerate() {
                let (Some(cost), true) = (cost, set & (1 << column) == 0) else { continue };
                let slot: &mut Option<u64> = &mut next[set | (1 << column)];
                let total = total + u64::from(cost.get());
                *slot = Some(slot.map_or(total, |it| it.min(total)));
            }
        }
        best = next;
    }
    best.into_iter().flatten().min()
}

/// Each row has an edge of its own; no other assignment can cost less, by the prices alone.
fn is_proven(costs: &Costs<'_>, rows: &[Row], columns: &[Column], assigned: Assigned) {
    let (mut total, mut prices) = (0, 0_i64);
    for (row, it) in rows.iter().enumerate() {
        let column = it.column().unwrap();
        assert_eq!(columns[column].row(), Some(row));
        let cost = costs.row(row)[column].unwrap();
        total += u64::from(cost.get());
        let own = i64::from(cost.get()) - columns[column].price();
        prices += own;
        for (cost, column) in costs.row(row).iter().zip(columns) {
            assert!(cost.is_none_or(|it| i64::from(it.get()) >= own + column.price()));
        }
    }
    for it in columns {
        assert!(it.price() <= 0 && (it.row().is_some() || it.price() == 0));
        prices += it.price();
    }
    assert_eq!((total, prices), (assigned.total, assigned.total as i64));
}

#[test]
fn an_assignment_is_the_least_of_all_and_its_prices_prove_it() {
    let (mut draw, mut feasible, mut conflicts) = (Draw::new(18), 0, 0);
    for _ in 0..20_000 {
        let (rows, columns) = (1 + below(&mut draw, 7) as usize, 1 + below(&mut draw, 8) as usize);
        let (most, missing) =
            ([3, 100, 1_000_000][below(&mut draw, 3) as usize], below(&mut draw, 80));
        let entries = table(&mut draw, rows, columns, most, missing);
        let costs = Costs::new(&entries, columns).unwrap();
        let mut of_rows = vec![Row::default(); rows];
        let mut of_columns = vec![Column::default(); columns];
        match assign(&costs, &mut of_rows, &mut of_columns) {
            Ok(assigned) => {
                assert_eq!(Some(assigned.total), least(&costs));
                is_proven(&costs, &of_rows, &of_columns, assigned);
                feasible += 1;
            }
            Err(error) => {
                assert_eq!(least(&costs), None);
                // The rows in conflict have fewer columns than they are.
                let among = (0..rows).filter(|it| error.in_conflict(*it, &of_columns));
                let among: Vec<_> = among.collect();
                let could =
                    |column: &usize| among.iter().any(|it| costs.row(*it)[*column].is_some());
                assert_eq!(
                    (among.len(), (0..columns).filter(could).count()),
                    (error.rows, error.columns)
                );
                assert!(error.rows > error.columns);
                conflicts += 1;
            }
        }
    }
    assert!(feasible > 5_000 && conflicts > 5_000, "{feasible} {conflicts}");
}
