//! Assignments against all assignments, and what proves them.

use crate::draw::Draw;
use crate::tables::{below, least, table};
use cotama_core::team::{
    Amount, AssignmentError, Cost, Costs, Fixed, Memory, ProofError, assign, bottleneck, conflict,
    is_least,
};

/// The answer for a table, proven by the prices or by the rows in conflict.
fn proven<N: Amount>(costs: &Costs<'_>, memory: &mut Memory<'_, N>) -> Option<u64> {
    match assign(costs, memory) {
        Ok(total) => {
            let again = is_least(costs, |row| memory.column(row), |column| memory.price(column));
            assert_eq!(again, Ok(total));
            Some(total)
        }
        Err(error) => {
            let (rows, columns) = conflict(costs, |row| memory.in_conflict(row));
            assert_eq!(error, AssignmentError::Infeasible { rows, columns });
            assert!(rows > columns);
            None
        }
    }
}

#[test]
fn an_assignment_is_the_least_of_all_and_its_prices_prove_it() {
    let (mut draw, mut feasible, mut conflicts) = (Draw::new(18), 0, 0);
    let (mut narrow, mut wide) = (Fixed::<i32, 7, 8>::new(), Fixed::<i64, 7, 8>::new());
    for _ in 0..20_000 {
        let (rows, columns) = (1 + below(&mut draw, 7) as usize, 1 + below(&mut draw, 8) as usize);
        let most = [3, 100, 1_000_000][below(&mut draw, 3) as usize];
        let missing = below(&mut draw, 80);
        let entries = table(&mut draw, rows, columns, most, missing);
        let costs = Costs::new(&entries, columns).unwrap();
        let expected = least(&costs, |a, b| a + b);
        assert_eq!(proven(&costs, &mut narrow.memory()), expected);
        assert_eq!(proven(&costs, &mut wide.memory()), expected);
        feasible += usize::from(expected.is_some());
        conflicts += usize::from(expected.is_none());
    }
    assert!(feasible > 5_000 && conflicts > 5_000, "{feasible} {conflicts}");
}

#[test]
fn a_bottleneck_is_the_least_of_all_and_rows_in_conflict_prove_it() {
    let (mut draw, mut feasible) = (Draw::new(19), 0);
    let mut fixed = Fixed::<i32, 6, 7>::new();
    for _ in 0..20_000 {
        let (rows, columns) = (1 + below(&mut draw, 6) as usize, 1 + below(&mut draw, 7) as usize);
        let (most, missing) = ([4, 30][below(&mut draw, 2) as usize], below(&mut draw, 60));
        let entries = table(&mut draw, rows, columns, most, missing);
        let costs = Costs::new(&entries, columns).unwrap();
        let mut memory = fixed.memory();
        let found = bottleneck(&costs, &mut memory);
        let Some(largest) = least(&costs, u64::max) else {
            let (rows, columns) = conflict(&costs, |row| memory.in_conflict(row));
            assert_eq!(found, Err(AssignmentError::Infeasible { rows, columns }));
            assert!(rows > columns);
            continue;
        };
        let found = found.unwrap();
        let limit = found.largest.unwrap();
        let within = costs.at_most(limit);
        assert_eq!(u64::from(limit.get()), largest);
        assert_eq!(Some(found.total), least(&within, |a, b| a + b));
        let again = is_least(&within, |row| memory.column(row), |column| memory.price(column));
        assert_eq!(again, Ok(found.total));
        let (rows, columns) = conflict(&costs.below(limit), |row| memory.in_conflict(row));
        assert!(rows > columns);
        feasible += 1;
    }
    assert!(feasible > 5_000, "{feasible}");
}

/// A table from its numbers.
fn of<const N: usize>(entries: [Option<u32>; N]) -> [Option<Cost>; N] {
    entries.map(|it| it.and_then(Cost::new))
}

#[test]
fn two_rows_of_three_with_missing_edges_cost_16() {
    // gatagat/lap #20 has 18.
    let entries = of([None, Some(11), Some(8), Some(8), None, Some(7)]);
    let costs = Costs::new(&entries, 3).unwrap();
    assert_eq!(proven(&costs, &mut Fixed::<i32, 2, 3>::new().memory()), Some(16));
}

#[test]
fn four_rows_on_three_columns_end_at_once_whatever_the_costs() {
    // A price war, where a large number stands for what is missing: linear in that number.
    let mut draw = Draw::new(4);
    for _ in 0..1_000 {
        let mut entries = table(&mut draw, 4, 5, 99, 0);
        for row in 0..4 {
            entries[row * 5 + 3] = None;
            entries[row * 5 + 4] = if row == 0 { Cost::new(Cost::MOST) } else { None };
        }
        let costs = Costs::new(&entries, 5).unwrap();
        assert!(proven(&costs, &mut Fixed::<i64, 4, 5>::new().memory()).is_some());
        let cheap = costs.below(Cost::new(100).unwrap());
        assert_eq!(proven(&cheap, &mut Fixed::<i32, 4, 5>::new().memory()), None);
    }
}

#[test]
fn large_tables_are_proven_too_whole_and_with_half_of_their_edges_missing() {
    let mut draw = Draw::new(20);
    for (rows, columns) in [(60, 60), (40, 100), (61, 67), (100, 100), (9, 1_100)] {
        for (most, missing) in [(10, 50), (1_000, 50), (1_000, 0), (100_000_000, 50)] {
            let entries = table(&mut draw, rows, columns, most, missing);
            let costs = Costs::new(&entries, columns).unwrap();
            let narrow = proven(&costs, &mut Fixed::<i32, 100, 1_100>::new().memory());
            let wide = proven(&costs, &mut Fixed::<i64, 100, 1_100>::new().memory());
            assert!(narrow.is_some());
            assert_eq!(narrow, wide);
        }
    }
}

#[test]
fn large_tables_that_are_nearly_empty_are_assigned_or_in_conflict() {
    let (mut draw, mut feasible) = (Draw::new(21), 0);
    let mut fixed = Fixed::<i32, 90, 100>::new();
    for _ in 0..400 {
        let rows = 64 + below(&mut draw, 27) as usize;
        let columns = rows + below(&mut draw, 11) as usize;
        let missing = 91 + below(&mut draw, 6);
        let mut entries = table(&mut draw, rows, columns, 1_000, missing);
        // The last rows have few columns among themselves, just enough or one too few.
        let (few, own) = (rows / 8, rows / 8 - below(&mut draw, 2) as usize);
        for row in rows - few..rows {
            for column in 0..columns {
                entries[row * columns + column] = Cost::new(column as u32).filter(|_| column < own);
            }
        }
        let costs = Costs::new(&entries, columns).unwrap();
        let found = proven(&costs, &mut fixed.memory());
        assert!(found.is_none() || own == few);
        feasible += usize::from(found.is_some());
    }
    assert!((100..200).contains(&feasible), "{feasible}");
}

#[test]
fn rows_that_find_many_columns_equally_near_are_proven_and_the_same_everywhere() {
    // Few costs, so that paths among equally near columns, and shortest paths beyond them, are
    // taken; in some tables the last rows have few columns, just enough or one too few.
    let (mut draw, mut feasible, mut digest) = (Draw::new(22), 0, 0xcbf2_9ce4_8422_2325_u64);
    let mut narrow = Fixed::<i32, 130, 140>::new();
    let mut wide = Fixed::<i64, 130, 140>::new();
    for number in 0..600 {
        let rows = 64 + below(&mut draw, 67) as usize;
        let columns = rows + [0, 0, 0, 1, 10][below(&mut draw, 5) as usize];
        let most = [1, 2, 4, 20][below(&mut draw, 4) as usize];
        let missing = [0, 30, 60, 85, 93][below(&mut draw, 5) as usize];
        let mut entries = table(&mut draw, rows, columns, most, missing);
        if number % 4 == 0 {
            let few = 1 + below(&mut draw, rows as u64 / 4) as usize;
            let own = (few + below(&mut draw, 3) as usize).saturating_sub(1);
            for row in rows - few..rows {
                entries[row * columns + own.min(columns)..(row + 1) * columns].fill(None);
            }
        }
        let costs = Costs::new(&entries, columns).unwrap();
        let mut memory = narrow.memory();
        let found = proven(&costs, &mut memory);
        let columns: Vec<_> = (0..rows).map(|row| memory.column(row)).collect();
        let mut memory = wide.memory();
        assert_eq!(proven(&costs, &mut memory), found);
        feasible += usize::from(found.is_some());
        if found.is_some() {
            assert!((0..rows).all(|row| !memory.in_conflict(row)));
            assert!((0..rows).all(|row| memory.column(row) == columns[row]));
        }
        if let (Some(_), Ok(found)) = (found, bottleneck(&costs, &mut memory)) {
            let (rows, columns) =
                conflict(&costs.below(found.largest.unwrap()), |row| memory.in_conflict(row));
            assert!(rows > columns);
        }
        for it in columns.into_iter().filter(|_| found.is_some()) {
            digest = (digest ^ it.unwrap() as u64).wrapping_mul(0x100_0000_01b3);
        }
    }
    assert_eq!((feasible, digest), (490, 0xcd27_27ba_43df_7c99));
}

#[test]
fn too_large_for_half_the_width_is_said_and_the_whole_width_has_an_answer() {
    let entries = of([Some(Cost::MOST), Some(0), Some(Cost::MOST), Some(1)]);
    let costs = Costs::new(&entries, 2).unwrap();
    let mut narrow = Fixed::<i32, 2, 2>::new();
    assert_eq!(assign(&costs, &mut narrow.memory()), Err(AssignmentError::TooLarge));
    let total = u64::from(Cost::MOST);
    assert_eq!(proven(&costs, &mut Fixed::<i64, 2, 2>::new().memory()), Some(total));
}

#[test]
fn nothing_costs_nothing_and_memory_that_lacks_is_said() {
    let none = Costs::new(&[], 3).unwrap();
    let mut fixed = Fixed::<i32, 1, 3>::new();
    assert_eq!(assign(&none, &mut fixed.memory()), Ok(0));
    assert_eq!(bottleneck(&none, &mut fixed.memory()).unwrap().largest, None);
    let entries = of([Some(1); 6]);
    let costs = Costs::new(&entries, 3).unwrap();
    assert!(matches!(assign(&costs, &mut fixed.memory()), Err(AssignmentError::Memory(_))));
}

#[test]
fn a_proof_that_is_none_is_refused() {
    let entries = of([Some(1), Some(5), Some(1), Some(3)]);
    let costs = Costs::new(&entries, 2).unwrap();
    let check = |columns: [Option<usize>; 2], prices: [i64; 2]| {
        is_least(&costs, |row| columns[row], |column| prices[column])
    };
    assert_eq!(check([Some(0), Some(1)], [-2, 0]), Ok(4));
    assert_eq!(check([Some(0), None], [-2, 0]), Err(ProofError::NoColumn { row: 1 }));
    assert_eq!(check([Some(0), Some(0)], [-2, 0]), Err(ProofError::Shared { column: 0 }));
    assert_eq!(check([Some(0), Some(1)], [1, 3]), Err(ProofError::Price { column: 0 }));
    assert_eq!(check([Some(0), Some(1)], [0, 0]), Err(ProofError::Better { row: 1, column: 0 }));
}

#[test]
fn with_more_rows_than_columns_all_rows_are_in_conflict() {
    let entries = of([Some(1), None, Some(1), None, None, Some(1)]);
    let costs = Costs::new(&entries, 2).unwrap();
    let mut fixed = Fixed::<i32, 3, 2>::new();
    let mut memory = fixed.memory();
    let all = Err(AssignmentError::Infeasible { rows: 3, columns: 2 });
    assert_eq!(assign(&costs, &mut memory), all);
    assert!((0..3).all(|row| memory.in_conflict(row)));
    assert!(Costs::new(&entries[..5], 2).is_none());
    assert!(Costs::new(&[], 2).is_some() && Costs::new(&entries[..1], 0).is_none());
}
