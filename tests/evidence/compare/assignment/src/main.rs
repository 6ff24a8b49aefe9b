//! Assignment of rows to columns, here and by lapjv 0.3, on the same tables in one process.
//!
//! Every figure is the median of runs that take turns, so that whatever else the machine does meets
//! both alike. The totals must agree. The other tables of ours are compared with the full one.
#![allow(clippy::cast_precision_loss)] // a ratio needs no more than a double's digits

#[path = "../../../../../core/tests/common/draw.rs"]
mod draw;

use cotama_core::team::{Amount, Cost, Costs, Fixed, Memory, assign};
use draw::Draw;
use rustix::time::{ClockId, clock_gettime};
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::Duration;

fn main() {
    let mut arguments = std::env::args().skip_while(|it| it != "--export").skip(1);
    if let Some(folder) = arguments.next().map(PathBuf::from) {
        return export(&folder);
    }
    println!("n x n, costs          ours i32    ours i64       lapjv   i32/lapjv   i64/lapjv");
    let sizes = std::env::args().skip(1).filter_map(|it| it.parse().ok());
    let mut sizes: Vec<usize> = sizes.collect();
    if sizes.is_empty() {
        sizes = vec![8, 100, 500, 1_000, 2_000];
    }
    for n in sizes {
        for most in [100, 1_000_000] {
            squares(n, most);
        }
    }
    println!("\nn x n, costs                    table    ours i32   of the full one");
    for n in [100, 500, 1_000, 2_000] {
        lacking(n, 1_000_000);
        lacking(n, 100);
    }
    println!("\nrows x columns        ours i32    ours i64   (µs)");
    rectangles::<4, 8>();
    rectangles::<8, 8>();
    rectangles::<8, 64>();
    rectangles::<16, 64>();
}

/// Writes squares as 32-bit numbers, and a line of JSON for each size with their totals and the
/// median time, for `../teams.py`.
fn export(folder: &Path) {
    std::fs::create_dir_all(folder).expect("the folder can be made");
    let mut results = String::new();
    for n in [100, 500, 1_000, 2_000] {
        for most in [100, 1_000_000] {
            let mut draw = Draw::new(n as u64 + most);
            let mut room = Room::<i32>::new(n);
            let (mut times, mut totals, mut bytes) = (vec![], vec![], vec![]);
            // Each run has a table of its own: a processor learns what it has seen.
            for _ in 0..if n > 500 { 5 } else { 25 } {
                let entries = table(&mut draw, n, n, most, 0);
                let costs = Costs::new(&entries, n).expect("a square");
                let (time, total) = timed(|| room.assign(black_box(&costs)));
                times.push(time);
                totals.push(total.expect("a full table has an assignment"));
                bytes.extend(entries.iter().flat_map(|it| it.map_or(0, Cost::get).to_le_bytes()));
            }
            let name = format!("{n}-{most}");
            std::fs::write(folder.join(format!("{name}.bin")), bytes).expect("it can be written");
            let seconds = median(times) / 1e6;
            results += &format!(
                "{{\"name\": \"{name}\", \"n\": {n}, \"most\": {most}, \"totals\": {totals:?}, \
                 \"seconds\": {seconds:.9}}}\n"
            );
        }
    }
    std::fs::write(folder.join("results.jsonl"), results).expect("it can be written");
}

/// A table of so many rows and columns, with a share of its edges missing.
fn table(
    draw: &mut Draw,
    rows: usize,
    columns: usize,
    most: u64,
    percent: u64,
) -> Vec<Option<Cost>> {
    let entry = |_| {
        let cost = Cost::new(draw.between(1, most) as u32);
        cost.filter(|_| draw.between(1, 100) > percent)
    };
    (0..rows * columns).map(entry).collect()
}

/// How much time of the processor something takes, and what it gives.
fn timed<R>(act: impl FnOnce() -> R) -> (Duration, R) {
    let start = clock_gettime(ClockId::ThreadCPUTime);
    let result = act();
    let end = clock_gettime(ClockId::ThreadCPUTime);
    let nanoseconds = (end.tv_sec - start.tv_sec) * 1_000_000_000 + end.tv_nsec - start.tv_nsec;
    (Duration::from_nanos(nanoseconds as u64), result)
}

fn median(mut times: Vec<Duration>) -> f64 {
    times.sort();
    times[times.len() / 2].as_secs_f64() * 1e6
}

/// Memory for squares.
struct Room<N> {
    words: Vec<u32>,
    amounts: Vec<N>,
}

impl<N: Amount + From<u8>> Room<N> {
    fn new(n: usize) -> Self {
        let (words, amounts) = (Memory::<N>::words(n, n), Memory::<N>::amounts(n));
        Self { words: vec![0; words], amounts: vec![0.into(); amounts] }
    }

    fn assign(&mut self, costs: &Costs<'_>) -> Option<u64> {
        let (rows, columns) = (costs.rows(), costs.columns());
        let memory = Memory::new(rows, columns, &mut self.words, &mut self.amounts);
        assign(costs, &mut memory.expect("there is room")).ok()
    }
}

fn squares(n: usize, most: u64) {
    let mut draw = Draw::new(n as u64 + most);
    let (mut narrow, mut wide, mut theirs) = (vec![], vec![], vec![]);
    // Small ones in batches, as a clock takes its time too.
    let batch = (20_000 / (n * n)).max(1);
    let runs = if n >= 1_000 { 7 } else { 25 };
    let (mut small, mut large) = (Room::<i32>::new(n), Room::<i64>::new(n));
    for _ in 0..runs {
        let tables: Vec<_> = (0..batch).map(|_| table(&mut draw, n, n, most, 0)).collect();
        let of = |it: &Option<Cost>| f64::from(it.expect("there is a cost").get());
        let matrices: Vec<_> = tables
            .iter()
            .map(|it| lapjv::Matrix::from_shape_vec((n, n), it.iter().map(of).collect()))
            .map(|it| it.expect("a square"))
            .collect();
        let tables: Vec<_> = tables.iter().map(|it| Costs::new(it, n).expect("a square")).collect();
        let (time, by_narrow) =
            timed(|| tables.iter().map(|it| small.assign(black_box(it))).collect::<Vec<_>>());
        narrow.push(time);
        let (time, by_lapjv) = timed(|| {
            matrices
                .iter()
                .map(|it| lapjv::lapjv(black_box(it)).expect("a result"))
                .collect::<Vec<_>>()
        });
        theirs.push(time);
        let (time, by_wide) =
            timed(|| tables.iter().map(|it| large.assign(black_box(it))).collect::<Vec<_>>());
        wide.push(time);
        assert_eq!(by_narrow, by_wide);
        for ((ours, (columns, _)), matrix) in by_narrow.iter().zip(by_lapjv).zip(&matrices) {
            let total: f64 = columns.iter().enumerate().map(|it| matrix[[it.0, *it.1]]).sum();
            assert_eq!(*ours, Some(total as u64));
        }
    }
    let [narrow, wide, theirs] = [narrow, wide, theirs].map(|it| median(it) / batch as f64);
    println!(
        "{n:5}, 1..{most:<9} {narrow:>10.2} {wide:>11.2} {theirs:>11.2}   {:>9.2}   {:>9.2}",
        narrow / theirs,
        wide / theirs
    );
}

/// Tables with half of their edges missing, and infeasible ones, beside full ones.
fn lacking(n: usize, most: u64) {
    let mut draw = Draw::new(n as u64);
    let mut room = Room::<i32>::new(n);
    let mut times = [const { Vec::new() }; 4];
    for _ in 0..9 {
        let full = table(&mut draw, n, n, most, 0);
        let half = table(&mut draw, n, n, most, 50);
        // The last rows have one column less than they are.
        let mut late = full.clone();
        let few = n / 10;
        for row in n - few..n {
            late[row * n + few - 1..(row + 1) * n].fill(None);
        }
        // The rows have one column less than they are; nothing is missing but that.
        let mut narrow = half.clone();
        (0..n).for_each(|row| narrow[row * n + n / 2] = None);
        for (times, (entries, feasible)) in
            times.iter_mut().zip([(full, true), (half, true), (late, false), (narrow, false)])
        {
            let costs = Costs::new(&entries, n).expect("a square");
            let (time, total) = timed(|| room.assign(black_box(&costs)));
            assert_eq!(total.is_some(), feasible);
            times.push(time);
        }
    }
    let times = times.map(median);
    for (name, time) in
        ["full", "half missing", "a tenth in conflict", "all in conflict"].iter().zip(times)
    {
        println!("{n:5}, 1..{most:<9} {name:>20} {time:>11.2} {:>17.2}", time / times[0]);
    }
}

fn rectangles<const R: usize, const C: usize>() {
    let mut draw = Draw::new((R * C) as u64);
    let tables: Vec<_> = (0..1_000).map(|_| table(&mut draw, R, C, 1_000, 0)).collect();
    let tables: Vec<_> = tables.iter().map(|it| Costs::new(it, C).expect("a table")).collect();
    let (mut small, mut large) = (Fixed::<i32, R, C>::new(), Fixed::<i64, R, C>::new());
    let (mut narrow, mut wide) = (vec![], vec![]);
    for _ in 0..31 {
        let mut memory = small.memory();
        let (time, by_narrow) =
            timed(|| tables.iter().map(|it| assign(black_box(it), &mut memory).ok()).fold(0, sum));
        narrow.push(time);
        let mut memory = large.memory();
        let (time, by_wide) =
            timed(|| tables.iter().map(|it| assign(black_box(it), &mut memory).ok()).fold(0, sum));
        wide.push(time);
        assert_eq!(by_narrow, by_wide);
    }
    let [narrow, wide] = [narrow, wide].map(|it| median(it) / tables.len() as f64);
    println!("{R:3} x {C:<14} {narrow:>10.3} {wide:>11.3}");
}

fn sum(all: u64, it: Option<u64>) -> u64 {
    all + it.expect("a full table has an assignment")
}
