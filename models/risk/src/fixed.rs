//! Queries in fixed point for a robot: made here, run by `cotama-inference` without heap or floats.

#![allow(clippy::cast_sign_loss)] // probabilities are at least 0

use crate::infer::{NoAnswer, Operand, Plan};
use crate::network::Network;
use cotama_inference::{self as robot, MAX_RANK, ONE};
use std::fmt::Write;

/// The most cells of the tables, and of the results, of a query in fixed point.
const MAX_CELLS: usize = 1 << 20;

/// A query in fixed point.
///
/// ```
/// use cotama_risk::{EMBEDDED, Fixed, Network};
/// let (asia, _) = Network::from_bif(EMBEDDED[1].2).unwrap();
/// let number = |name| asia.variable(name).unwrap();
/// let fixed = Fixed::new(&asia, number("lung"), &[number("dysp"), number("xray")]).unwrap();
/// let (posterior, answer) = fixed.answer(&[0, 0]).unwrap();
/// let share = f64::from(posterior[0]) / f64::from(1 << 30);
/// assert!((share - 0.621_252_796_677_629).abs() * f64::from(1 << 30) < f64::from(answer.error));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fixed {
    tables: Vec<u32>,
    steps: Vec<Step>,
    evidence: Vec<u16>,
    scratch: usize,
    rounded: u64,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Step {
    operands: Vec<Cells>,
    shape: Vec<u16>,
    summed: u16,
    to: u32,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Cells {
    is_result: bool,
    at: u32,
    strides: Vec<u32>,
    inner: u32,
    fixed: Vec<(u8, u32)>,
}

impl Fixed {
    /// The query for a variable, given states of others.
    ///
    /// # Errors
    /// As [`Plan::new`], and [`NoAnswer::TooLarge`] where a step leaves more than
    /// [`MAX_RANK`] variables, a variable has more than 255 states, or tables are too large for a
    /// robot.
    pub fn new(net: &Network, query: usize, evidence: &[usize]) -> Result<Self, NoAnswer> {
        let plan = Plan::new(net, &[query], evidence)?;
        let small = |it: usize| u16::try_from(it).ok().filter(|it| *it < 256);
        let states = |it: usize| small(it).ok_or(NoAnswer::TooLarge);
        let mut fixed = Self {
            tables: Vec::new(),
            steps: Vec::new(),
            evidence: plan.evidence.iter().map(|it| states(*it)).collect::<Result<_, _>>()?,
            scratch: 0,
            rounded: 0,
        };
        for step in &plan.steps {
            if step.shape.len() > MAX_RANK {
                return Err(NoAnswer::TooLarge);
            }
            let operands = step.operands.iter().map(|it| fixed.cells(net, &plan, it)).collect();
            let shape = step.shape.iter().map(|it| states(*it)).collect::<Result<_, _>>()?;
            let to = fixed.scratch as u32;
            fixed.steps.push(Step { operands, shape, summed: states(step.summed)?, to });
            fixed.scratch += step.size;
            if fixed.scratch > MAX_CELLS || fixed.tables.len() > MAX_CELLS {
                return Err(NoAnswer::TooLarge);
            }
        }
        Ok(fixed)
    }

    fn cells(&mut self, net: &Network, plan: &Plan, operand: &Operand) -> Cells {
        let result = operand.source.checked_sub(plan.nodes).and_then(|it| self.steps.get(it));
        let (is_result, at) = match result {
            Some(step) => (true, step.to),
            None => (false, self.table(net, operand.source)),
        };
        Cells {
            is_result,
            at,
            strides: operand.strides.iter().map(|it| *it as u32).collect(),
            inner: operand.inner as u32,
            fixed: operand.fixed.iter().map(|it| (it.0 as u8, it.1 as u32)).collect(),
        }
    }

    /// Adds the table of a node; returns where it begins.
    fn table(&mut self, net: &Network, node: usize) -> u32 {
        let (at, states) = (self.tables.len(), net.states(node));
        let mut most = 0;
        for row in net.nodes()[node].table.chunks(states) {
            let units = rounded(row);
            // A double misses its decimal number by 2^-54 at most: 64 units of 2^-60.
            let off = |it: (&f64, &u32)| {
                let wanted = it.0 * f64::from(ONE);
                let off = if wanted > f64::from(*it.1) {
                    wanted - f64::from(*it.1)
                } else {
                    f64::from(*it.1) - wanted
                };
                (off * f64::from(ONE)).ceil() as u64 + 128
            };
            most = most.max(row.iter().zip(&units).map(off).sum());
            self.tables.extend(units);
        }
        self.rounded += most;
        at as u32
    }

    /// Calls with the query as a robot has it.
    fn with<R>(&self, call: impl FnOnce(&robot::Query<'_>) -> R) -> R {
        let operands: Vec<Vec<robot::Operand<'_>>> =
            self.steps.iter().map(|it| it.operands.iter().map(Cells::borrowed).collect()).collect();
        let steps: Vec<robot::Step<'_>> = self
            .steps
            .iter()
            .zip(&operands)
            .map(|(it, operands)| robot::Step {
                operands,
                shape: &it.shape,
                summed: it.summed,
                to: it.to,
            })
            .collect();
        call(&robot::Query {
            tables: &self.tables,
            steps: &steps,
            evidence: &self.evidence,
            scratch: self.scratch,
            rounded: self.rounded,
        })
    }

    /// Answers as the robot does: probabilities in units of 2⁻³⁰, and the bound of their error.
    ///
    /// # Errors
    /// As [`robot::Query::answer`].
    pub fn answer(&self, states: &[u8]) -> Result<(Vec<u32>, robot::Answer), robot::NoAnswer> {
        let mut scratch = vec![0; self.scratch];
        self.with(|query| {
            let mut posterior = vec![0; query.states()];
            query.answer(states, &mut scratch, &mut posterior).map(|it| (posterior, it))
        })
    }

    /// Bytes of constants, and of memory while an answer is computed.
    pub fn bytes(&self) -> (usize, usize) {
        let cells = |it: &Cells| 20 + 4 * it.strides.len() + 8 * it.fixed.len();
        let step =
            |it: &Step| 20 + 2 * it.shape.len() + it.operands.iter().map(cells).sum::<usize>();
        let steps: usize = self.steps.iter().map(step).sum();
        (4 * self.tables.len() + steps, 8 * self.scratch)
    }

    /// Prints the query as a constant of Rust, for `cotama-inference`; `about` is its comment.
    pub fn to_rust(&self, about: &str) -> String {
        let mut text = format!(
            "use cotama_inference::{{Operand, Query, Step}};\n\n/// {about}.\n\
             pub const QUERY: Query<'_> = Query {{\n    tables: &[\n"
        );
        for cells in self.tables.chunks(8) {
            let cells: Vec<_> = cells.iter().map(u32::to_string).collect();
            let _ = writeln!(text, "        {},", cells.join(", "));
        }
        text.push_str("    ],\n    steps: &[\n");
        for step in &self.steps {
            text.push_str("        Step {\n            operands: &[\n");
            for it in &step.operands {
                let Cells { is_result, at, strides, inner, fixed } = it;
                let _ = writeln!(
                    text,
                    "                Operand {{ is_result: {is_result}, at: {at}, strides: \
                     &{strides:?}, inner: {inner}, fixed: &{fixed:?} }},"
                );
            }
            let Step { shape, summed, to, .. } = step;
            let _ = writeln!(
                text,
                "            ],\n            shape: &{shape:?},\n            summed: {summed},\n\
                 \x20           to: {to},\n        }},"
            );
        }
        let Self { evidence, scratch, rounded, .. } = self;
        let _ = writeln!(
            text,
            "    ],\n    evidence: &{evidence:?},\n    scratch: {scratch},\n\
             \x20   rounded: {rounded},\n}};"
        );
        text
    }
}

impl Cells {
    fn borrowed(&self) -> robot::Operand<'_> {
        robot::Operand {
            is_result: self.is_result,
            at: self.at,
            strides: &self.strides,
            inner: self.inner,
            fixed: &self.fixed,
        }
    }
}

/// A row in units of 2⁻³⁰ with a sum of exactly 2³⁰: the largest remainders are rounded up, of
/// equal ones the first.
fn rounded(row: &[f64]) -> Vec<u32> {
    let sum: f64 = row.iter().sum();
    let scaled: Vec<f64> = row.iter().map(|it| it / sum * f64::from(ONE)).collect();
    let mut units: Vec<u32> = scaled.iter().map(|it| it.floor() as u32).collect();
    let mut order: Vec<usize> = (0..row.len()).collect();
    let rest = |it: usize| scaled[it] - scaled[it].floor();
    order.sort_by(|a, b| rest(*b).total_cmp(&rest(*a)).then(a.cmp(b)));
    let missing = ONE.saturating_sub(units.iter().sum());
    order.iter().take(missing as usize).for_each(|it| units[*it] += 1);
    units
}
