//! Steps made of measurements: of equal width, of equal frequency, or those that tell most of a
//! class.

use crate::csv::{Cells, measured};
use crate::wrong::Wrong;
use std::collections::BTreeMap;

/// The most steps that a column is cut into.
pub const MAX_BINS: usize = 256;

/// A rule by which a column of measurements is cut into steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rule {
    /// All steps have the same width, from the smallest value to the largest.
    Width {
        /// Number of steps.
        bins: usize,
    },
    /// All steps have the same number of values, as far as equal values allow.
    Frequency {
        /// Number of steps.
        bins: usize,
    },
    /// Cuts that tell most of another column, as long as each pays for its description: the
    /// principle of minimum description length (Fayyad and Irani, IJCAI 1993, section 3).
    Mdl {
        /// The column of the class, which stays as it is.
        class: String,
    },
}

/// A column of measurements and its cuts.
#[derive(Clone, Debug, PartialEq)]
pub struct Cuts {
    /// The name of the column.
    pub name: String,
    /// The cuts, rising: a step holds the values from a cut up to, but without, the next one.
    pub cuts: Vec<f64>,
    /// Number of values in each step; the steps are one more than the cuts.
    pub counts: Vec<usize>,
}

/// Cuts every column whose cells are all numbers, and that has more different ones than steps are
/// asked for; each cell becomes the name of its step, as `<2.5`, `2.5..4` and `>=4`. Other columns
/// stay as they are.
///
/// ```
/// use cotama_risk::{Cells, Rule, discretise};
/// let cells = Cells::parse("l,way\n1,short\n2,short\n3,long\n10,long\n").unwrap();
/// let (steps, cuts) = discretise(&cells, &Rule::Width { bins: 3 }).unwrap();
/// assert_eq!(cuts[0].cuts, [4.0, 7.0]);
/// assert_eq!(steps.columns[0], ["<4", "<4", "<4", ">=7"]);
/// ```
///
/// # Errors
/// When fewer than 2 or more than [`MAX_BINS`] steps are asked for, or the class is no column.
pub fn discretise(cells: &Cells, rule: &Rule) -> Result<(Cells, Vec<Cuts>), Wrong> {
    let (bins, class) = match rule {
        Rule::Width { bins } | Rule::Frequency { bins } => (*bins, None),
        Rule::Mdl { class } => (2, Some(class_of(cells, class)?)),
    };
    if !(2..=MAX_BINS).contains(&bins) {
        return Err(Wrong::whole(format!("{bins} steps; 2 to {MAX_BINS} are possible")));
    }
    let (mut made, mut all) = (cells.clone(), Vec::new());
    for (at, column) in cells.columns.iter().enumerate() {
        let Some(values) = column.iter().map(|it| measured(it)).collect::<Option<Vec<_>>>() else {
            continue;
        };
        let mut sorted: Vec<f64> = values.iter().map(|it| it + 0.0).collect();
        sorted.sort_by(f64::total_cmp);
        let mut different = sorted.clone();
        different.dedup();
        let is_class = class.as_ref().is_some_and(|it| it.0 == at);
        if is_class || different.len() <= bins {
            continue;
        }
        let cuts = match (rule, &class) {
            (Rule::Width { .. }, _) => by_width(&sorted, bins),
            (Rule::Frequency { .. }, _) => by_frequency(&sorted, bins),
            (Rule::Mdl { .. }, Some((_, class))) => by_class(&values, class),
            (Rule::Mdl { .. }, None) => Vec::new(),
        };
        let step = |value: &f64| cuts.partition_point(|cut| cut <= value);
        let mut counts = vec![0; cuts.len() + 1];
        values.iter().for_each(|it| counts[step(it)] += 1);
        made.columns[at] = values.iter().map(|it| name(&cuts, step(it))).collect();
        all.push(Cuts { name: cells.header[at].clone(), cuts, counts });
    }
    Ok((made, all))
}

/// The number of a column, and its cells as numbers.
fn class_of(cells: &Cells, class: &str) -> Result<(usize, Vec<usize>), Wrong> {
    let Some(at) = cells.header.iter().position(|it| it == class) else {
        let names = cells.header.iter().map(String::as_str);
        return Err(Wrong::whole(format!("no column {class}")).near(class, names));
    };
    let mut numbers = BTreeMap::new();
    let number = |cell: &String| {
        let next = numbers.len();
        *numbers.entry(cell.clone()).or_insert(next)
    };
    Ok((at, cells.columns[at].iter().map(number).collect()))
}

/// Returns the name of a step.
fn name(cuts: &[f64], step: usize) -> String {
    let below = step.checked_sub(1).and_then(|it| cuts.get(it));
    match (below, cuts.get(step)) {
        (None, None) => "any".to_owned(),
        (None, Some(high)) => format!("<{high}"),
        (Some(low), None) => format!(">={low}"),
        (Some(low), Some(high)) => format!("{low}..{high}"),
    }
}

fn by_width(sorted: &[f64], bins: usize) -> Vec<f64> {
    let (Some(low), Some(high)) = (sorted.first(), sorted.last()) else { return Vec::new() };
    let (low_part, high_part) = (low / bins as f64, high / bins as f64);
    let cut = |step: usize| match high - low {
        width if width.is_finite() => low + width * step as f64 / bins as f64,
        // The widest ranges: each end alone.
        _ => low_part * (bins - step) as f64 + high_part * step as f64,
    };
    rising((1..bins).map(cut), *low)
}

fn by_frequency(sorted: &[f64], bins: usize) -> Vec<f64> {
    let cut = |step: usize| sorted.get(step * sorted.len() / bins).copied();
    rising((1..bins).filter_map(cut), sorted.first().copied().unwrap_or(0.0))
}

/// Keeps the cuts that are larger than all before and than the smallest value.
fn rising(cuts: impl Iterator<Item = f64>, low: f64) -> Vec<f64> {
    let mut last = low;
    cuts.filter(|it| {
        *it > last && {
            last = *it;
            true
        }
    })
    .collect()
}

/// Values with their classes, and the cuts found so far.
struct Classes {
    values: Vec<(f64, usize)>,
    count: usize,
    cuts: Vec<f64>,
}

fn by_class(values: &[f64], class: &[usize]) -> Vec<f64> {
    let mut pairs: Vec<_> = values.iter().copied().zip(class.iter().copied()).collect();
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let count = class.iter().max().map_or(1, |it| it + 1);
    let mut all = Classes { values: pairs, count, cuts: Vec::new() };
    let mut open = vec![(0, values.len())];
    while let Some((from, to)) = open.pop() {
        if all.cuts.len() + 1 < MAX_BINS
            && let Some(at) = all.cut(from, to)
        {
            all.cuts.push(all.values[at].0);
            open.extend([(from, at), (at, to)]);
        }
    }
    all.cuts.sort_by(f64::total_cmp);
    all.cuts
}

impl Classes {
    /// Returns where to cut rows `from..to`, if a cut pays.
    fn cut(&self, from: usize, to: usize) -> Option<usize> {
        let mut right = vec![0_usize; self.count];
        self.values[from..to].iter().for_each(|it| right[it.1] += 1);
        let whole = spread(&right);
        let (rows, mut left) = ((to - from) as f64, vec![0_usize; self.count]);
        let mut best: Option<(f64, usize, Spread, Spread)> = None;
        for at in from..to {
            if at > from && self.values[at].0 > self.values[at - 1].0 {
                let (one, two) = (spread(&left), spread(&right));
                let both = (one.rows * one.entropy + two.rows * two.entropy) / rows;
                if best.as_ref().is_none_or(|it| both < it.0) {
                    best = Some((both, at, one, two));
                }
            }
            let class = self.values[at].1;
            left[class] += 1;
            right[class] -= 1;
        }
        let (both, at, one, two) = best?;
        let known = |it: &Spread| it.classes * it.entropy;
        let delta = libm::log2(libm::pow(3.0, whole.classes) - 2.0)
            - (known(&whole) - known(&one) - known(&two));
        let price = (libm::log2(rows - 1.0) + delta) / rows;
        (whole.entropy - both > price).then_some(at)
    }
}

/// Counts of rows over classes.
struct Spread {
    rows: f64,
    /// Number of classes that occur.
    classes: f64,
    /// In bits.
    entropy: f64,
}

fn spread(counts: &[usize]) -> Spread {
    let rows = counts.iter().sum::<usize>() as f64;
    let some = counts.iter().filter(|it| **it > 0).map(|it| *it as f64 / rows);
    let (classes, entropy) = some.fold((0.0, 0.0), |(classes, entropy), share| {
        (classes + 1.0, entropy - share * libm::log2(share))
    });
    Spread { rows, classes, entropy }
}
