//! One number for every subset of the variables, from which all scores of families follow.
//!
//! With `f` of the sizes of the cells into which a subset cuts the rows, the score of a family is
//! the difference of two subsets, less a penalty (Silander and Myllymaki, UAI 2006, count families
//! one by one). All subsets are counted by one walk down a binary tree: at each level one variable
//! is taken in, and cuts the cells, or left out. What is left of a row are its states at the levels
//! below: equal rests in one cell are one entry with a weight, and the entries lie in the order of
//! their rests, so that they meet. A cell with up to three light entries is not followed any
//! further: which subsets keep its entries together is known, and is counted for all of them
//! at once. The [last levels](super::tail) are one step.

use super::score::Score;
use super::states::{evenness, products, row_bits, strides, table, tables, weight_bits, width};
use super::tail::{LANES, Tail};
use crate::data::Data;

/// Weights up to this are counted by their numbers.
const LIGHT: usize = 8;

/// Sizes of light cells, by their number.
type Light = [i32; LIGHT];

/// An entry of a cell: rows with one rest, in one number. States stand above the weight, those of
/// the last level in the most significant bits.
type Entry = u64;

/// Numbers of all subsets.
pub(super) struct Subsets {
    /// The variable of each bit of a mask.
    pub(super) variables: Vec<usize>,
    /// For each mask the sum over cells; of masks that were left out any number.
    pub(super) values: Vec<f64>,
    /// For each mask the product of its states.
    pub(super) configurations: Vec<f64>,
}

/// Bounds of the subsets that are wanted.
#[derive(Clone)]
pub(super) struct Wanted {
    /// For each variable the most configurations of it and its parents.
    pub(super) configurations: Vec<f64>,
    /// The most variables of a subset.
    pub(super) variables: usize,
}

/// An entry that no row makes.
const APART: Entry = 1 << 63;

/// For each byte of a rest and each of its values the bits of the levels that it touches.
fn differ(shifts: &[u32]) -> Vec<[u32; 256]> {
    let levels = shifts.len() - 1;
    let last = shifts.last().copied().unwrap_or(0);
    let mut all = vec![[0; 256]; last.div_ceil(8) as usize];
    for level in 0..levels {
        for bit in shifts[level]..shifts[level + 1] {
            let bytes = &mut all[bit as usize / 8];
            for (value, mask) in bytes.iter_mut().enumerate() {
                *mask |= ((value >> (bit % 8) & 1) as u32) << (levels - 1 - level);
            }
        }
    }
    all
}

struct Walk {
    /// Shift of the states of each level, and behind the last.
    shifts: Vec<u32>,
    states: Vec<usize>,
    strides: Vec<usize>,
    /// The bits of a weight in an entry.
    weights: Entry,
    tables: Vec<Option<Vec<f64>>>,
    wanted: Wanted,
    /// For each level the most configurations that its variable wants, and the largest of those
    /// from a level on.
    most: Vec<f64>,
    rest: Vec<f64>,
    score: Score,
    rows: usize,
    values: Vec<f64>,
    light: Vec<Light>,
    entries: Vec<Entry>,
    /// Ends of cells.
    cells: Vec<usize>,
    /// Entries of a cell by their state, while it is cut, and how many these are.
    cut: Vec<Vec<Entry>>,
    lengths: Vec<usize>,
    tail: Tail,
    /// Counts of some cells.
    grid: Vec<[u32; LANES]>,
    /// For each byte of a rest and each value the levels whose states have one of its bits.
    differ: Vec<[u32; 256]>,
}

/// A place in the tree.
#[derive(Clone, Copy)]
struct Place {
    level: usize,
    mask: usize,
    table: usize,
    configurations: f64,
    taken: usize,
    /// The most configurations, as far as variables taken or left out want them.
    most: f64,
}

impl Subsets {
    /// Counts all subsets that are wanted, of at least 2 variables and at most 30, which have 63
    /// bits of states.
    pub(super) fn count(data: &Data, score: Score, wanted: Wanted) -> Self {
        let count = data.variables().len();
        debug_assert!((2..=30).contains(&count) && row_bits(data) <= 63, "too many variables");
        // Variables that cut cells small come first.
        let mut variables: Vec<usize> = (0..count).collect();
        let mut order: Vec<(f64, usize)> =
            variables.iter().map(|it| (evenness(data, *it), *it)).collect();
        order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        variables.clear();
        variables.extend(order.iter().map(|it| it.1));
        let states: Vec<usize> = variables.iter().map(|it| data.states(*it)).collect();
        let mut shifts = vec![weight_bits(data)];
        for it in &states {
            shifts.push(shifts[shifts.len() - 1] + width(*it));
        }
        let mut rests = vec![0_u64; data.rows()];
        for (level, variable) in variables.iter().enumerate() {
            for (rest, state) in rests.iter_mut().zip(data.column(*variable)) {
                *rest |= u64::from(*state) << shifts[level];
            }
        }
        rests.sort_unstable();
        let strides = strides(data, score, &states);
        let most = states.iter().copied().max().unwrap_or(1);
        let configurations = products(&states);
        let wants: Vec<f64> = variables.iter().map(|it| wanted.configurations[*it]).collect();
        let mut rest = vec![0.0; count + 1];
        for level in (0..count).rev() {
            rest[level] = larger(rest[level + 1], wants[level]);
        }
        let tail = Tail::new(&states, &shifts, &strides);
        let mut walk = Walk {
            tables: vec![None; tables(data, score)],
            values: vec![0.0; 1 << count],
            light: vec![[0; LIGHT]; 1 << count],
            entries: Vec::new(),
            cells: Vec::new(),
            cut: vec![vec![APART; rests.len() + 1]; most],
            lengths: vec![1; most],
            grid: vec![[0; LANES]; tail.size()],
            tail,
            differ: differ(&shifts),
            rows: data.rows(),
            weights: (1 << shifts[0]) - 1,
            shifts,
            states,
            strides,
            wanted,
            most: wants,
            rest,
            score,
        };
        for rest in rests {
            walk.entries.push(rest + 1);
        }
        let top = Place { level: 0, mask: 0, table: 0, configurations: 1.0, taken: 0, most: 1.0 };
        walk.cells.push(walk.entries.len());
        walk.merge(top, 0, 0);
        walk.visit(top, 0, 0);
        walk.finish(&configurations);
        // The first level has the most significant bit.
        variables.reverse();
        Self { variables, values: walk.values, configurations }
    }
}

fn larger(one: f64, two: f64) -> f64 {
    if two > one { two } else { one }
}

impl Walk {
    /// Bit of a level in a mask.
    fn bit(&self, level: usize) -> usize {
        1 << (self.states.len() - 1 - level)
    }

    /// Follows the cells whose ends begin at `cells` and whose entries begin at `entries`; they are
    /// the last ones.
    fn visit(&mut self, at: Place, entries: usize, cells: usize) {
        let Place { level, mask, table, configurations, taken, most } = at;
        if level + self.tail.levels == self.states.len() {
            return self.leaves(at, entries, cells);
        }
        let bit = self.bit(level);
        let states = self.states[level];
        // A subset is wanted with one of its variables as the child, and without a child.
        let (own, rest) = (self.most[level], self.rest[level + 1]);
        let with = Place {
            level: level + 1,
            mask: mask | bit,
            table: table + self.strides[level],
            configurations: configurations * states as f64,
            taken: taken + 1,
            most: larger(most, own),
        };
        let without = Place { level: level + 1, most: larger(most, own / states as f64), ..at };
        let is_wanted =
            taken < self.wanted.variables && with.configurations <= larger(with.most, rest);
        self.push(mask, bit);
        let (end_entries, end_cells) = (self.entries.len(), self.cells.len());
        if is_wanted {
            self.split(with, entries, cells, end_cells);
            self.visit(with, end_entries, end_cells);
            self.entries.truncate(end_entries);
            self.cells.truncate(end_cells);
        }
        // The entries themselves are not needed any more: those left take their place.
        if configurations <= larger(without.most, rest) {
            self.merge(without, entries, cells);
            self.visit(without, entries, cells);
        }
    }

    /// Hands light cells down a level: all of the subset with a variable are in the one without.
    fn push(&mut self, mask: usize, bit: usize) {
        let (without, with) = self.light[mask..mask + 2 * bit].split_at_mut(bit);
        for (to, from) in without.iter_mut().zip(with) {
            to.iter_mut().zip(from).for_each(|(to, from)| *to += *from);
        }
    }

    /// The last levels at once: each cell is a table of their states, with its sums.
    fn leaves(&mut self, at: Place, mut start: usize, cells: usize) {
        let Place { mask, table, .. } = at;
        let tail = std::mem::take(&mut self.tail);
        for level in (0..tail.levels).rev() {
            let masks = (0..1 << tail.levels).step_by(2 << level);
            masks.for_each(|it| self.push(mask + it, 1 << level));
        }
        tail.parts.iter().for_each(|it| self.make(table + it.stride));
        let mut grid = std::mem::take(&mut self.grid);
        let mut sums = vec![[0.0; LANES]; tail.parts.len()];
        for ends in self.cells[cells..].chunks(LANES) {
            grid.fill([0; LANES]);
            for (lane, end) in ends.iter().enumerate() {
                for entry in &self.entries[start..*end] {
                    grid[tail.place(*entry)][lane] += (entry & self.weights) as u32;
                }
                start = *end;
            }
            tail.add_up(&mut grid);
            for (part, sums) in tail.parts.iter().zip(&mut sums) {
                let Some(Some(of)) = self.tables.get(table + part.stride) else { continue };
                // In registers, as no row of the grid is read while a sum waits for memory.
                let mut own = *sums;
                for place in &part.places {
                    let counts = grid[usize::from(*place)];
                    own = std::array::from_fn(|it| own[it] + of[counts[it] as usize]);
                }
                *sums = own;
            }
        }
        for (value, sums) in self.values[mask..].iter_mut().zip(&sums) {
            *value = sums.iter().sum();
        }
        (self.grid, self.tail) = (grid, tail);
    }

    fn make(&mut self, at: usize) {
        if self.tables[at].is_none() {
            let (mut number, mut product) = (at, 1.0);
            let mut groups: Vec<(usize, usize)> =
                self.strides.iter().copied().zip(self.states.iter().copied()).collect();
            groups.sort_unstable();
            groups.dedup();
            for (stride, states) in groups.iter().rev().filter(|it| it.0 > 0) {
                product *= libm::pow(*states as f64, (number / stride) as f64);
                number %= stride;
            }
            self.tables[at] = Some(table(self.score, self.rows, product));
        }
    }

    /// Cuts cells by the variable of the level above `at`; the new cells stand behind all others.
    fn split(&mut self, at: Place, mut start: usize, cells: usize, end_cells: usize) {
        let level = at.level - 1;
        let (shift, below) = (self.shifts[level], self.shifts[at.level]);
        let states = self.states[level];
        let field = (1_u64 << (below - shift)) - 1;
        let mut cut = std::mem::take(&mut self.cut);
        let mut lengths = std::mem::take(&mut self.lengths);
        for cell in cells..end_cells {
            let end = self.cells[cell];
            // An entry that is never the same as another one stands first.
            lengths[..states].fill(1);
            for entry in &self.entries[start..end] {
                let state = (entry >> shift & field) as usize;
                let (part, length) = (&mut cut[state], &mut lengths[state]);
                let last = part[*length - 1];
                // Which of both is not foreseen by a machine: no branch.
                let same = (last ^ entry) >> below == 0;
                let place = *length - usize::from(same);
                part[place] = entry + if same { last & self.weights } else { 0 };
                *length = place + 1;
            }
            start = end;
            for state in 0..states {
                let part = &cut[state][1..lengths[state]];
                if !part.is_empty() && !self.is_resolved(at, part) {
                    self.entries.extend_from_slice(part);
                    self.cells.push(self.entries.len());
                }
            }
        }
        self.cut = cut;
        self.lengths = lengths;
    }

    /// Joins entries of the last cells that agree from a level on, and leaves out cells that need
    /// not be followed from there.
    fn merge(&mut self, at: Place, start: usize, cells: usize) {
        let below = self.shifts[at.level];
        let (mut to, mut from, mut kept) = (start, start, cells);
        for cell in cells..self.cells.len() {
            let (first, stop) = (to, self.cells[cell]);
            let mut last = APART;
            while from < stop {
                let entry = self.entries[from];
                let same = (last ^ entry) >> below == 0;
                to -= usize::from(same);
                last = entry + if same { last & self.weights } else { 0 };
                self.entries[to] = last;
                to += 1;
                from += 1;
            }
            let small = match self.entries[first..to] {
                [one] => self.is_resolved(at, &[one]),
                [one, two] => self.is_resolved(at, &[one, two]),
                [one, two, three] => self.is_resolved(at, &[one, two, three]),
                _ => to == first,
            };
            if small {
                to = first;
            } else {
                self.cells[kept] = to;
                kept += 1;
            }
        }
        self.entries.truncate(to);
        self.cells.truncate(kept);
    }

    /// Counts a cell of up to three light entries for all subsets below a place; returns whether
    /// the cell was such a one.
    fn is_resolved(&mut self, at: Place, cell: &[Entry]) -> bool {
        let weights = self.weights;
        let weight = |it: Entry| (it & weights) as usize;
        let total = cell.iter().take(4).map(|it| weight(*it)).sum();
        if cell.len() > 3 || total > LIGHT {
            return false;
        }
        let everything = (1 << (self.states.len() - at.level)) - 1;
        // Each entry alone, wherever nothing else is said.
        cell.iter().for_each(|it| self.add(at.mask | everything, weight(*it), 1));
        let agreed = |one: Entry, two: Entry| everything & !self.differing(one ^ two);
        match *cell {
            [one, two] => {
                let both = agreed(one, two);
                self.join(at.mask | both, weight(one), weight(two));
            }
            [one, two, three] => {
                let (first, second, third) =
                    (agreed(one, two), agreed(one, three), agreed(two, three));
                let (one, two, three) = (weight(one), weight(two), weight(three));
                self.join(at.mask | first, one, two);
                self.join(at.mask | second, one, three);
                self.join(at.mask | third, two, three);
                // Where all agree, three pairs were joined.
                let all = at.mask | first & second;
                self.add(all, total, 1);
                for own in [one, two, three] {
                    self.add(all, total - own, -1);
                    self.add(all, own, 1);
                }
            }
            _ => {}
        }
        true
    }

    /// Levels, by their bits, that have one of these bits.
    fn differing(&self, mut bits: u64) -> usize {
        let mut levels = 0;
        for bytes in &self.differ {
            levels |= bytes[(bits & 0xff) as usize];
            bits >>= 8;
        }
        levels as usize
    }

    /// Counts cells of so many rows, in all subsets below a mask; one row counts for nothing.
    fn add(&mut self, mask: usize, weight: usize, count: i32) {
        if weight > 1 {
            self.light[mask][weight - 1] += count;
        }
    }

    /// Counts two entries as one cell.
    fn join(&mut self, mask: usize, one: usize, two: usize) {
        self.add(mask, one + two, 1);
        self.add(mask, one, -1);
        self.add(mask, two, -1);
    }

    /// Adds light cells, and for `BDeu` what all rows have alone.
    fn finish(&mut self, configurations: &[f64]) {
        let stride = |bit: u32| self.strides[self.states.len() - 1 - bit as usize];
        // From one mask to the next a bit is set, and all below it are not any more.
        let steps: Vec<(usize, usize)> = (0..self.states.len() as u32)
            .map(|bit| (stride(bit), (0..bit).map(stride).sum()))
            .collect();
        let mut table = 0;
        let mut alone = vec![None; self.tables.len()];
        for (mask, product) in configurations.iter().enumerate() {
            if mask > 0 {
                let (set, unset) = steps[mask.trailing_zeros() as usize];
                table = table + set - unset;
            }
            self.make(table);
            let Some(Some(own)) = self.tables.get(table) else { continue };
            let light = self.light[mask].iter().enumerate().skip(1);
            let light: f64 = light
                .filter(|it| *it.1 != 0)
                .map(|(at, count)| f64::from(*count) * own.get(at + 1).copied().unwrap_or(0.0))
                .sum();
            let alone = *alone[table].get_or_insert_with(|| match self.score {
                Score::Bic => 0.0,
                Score::Bdeu { ess } => self.rows as f64 * libm::log(ess / product),
            });
            self.values[mask] += light + alone;
        }
    }
}
