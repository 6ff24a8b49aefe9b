//! Runs a harness on every combination of inputs, or on a sample; tells and replays the one that
//! fails.
//!
//! A run is a tape of choices. The next run raises the last choice that can be raised and forgets
//! what comes after it, so what an early assumption rejects is never tried with the rest.

#[path = "../../../../fuzz/split_mix.rs"]
mod split_mix;

use crate::Harness;
use std::cell::RefCell;
use std::collections::VecDeque;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind, set_hook, take_hook};
use std::sync::Once;

/// The most bits of one choice that are worth trying all.
const WIDEST: u32 = 16;
/// The most runs to try all combinations; more are sampled.
const MOST: u64 = 5_000_000;
/// The runs of a sample.
const SAMPLE: u64 = 200_000;
/// How often a random value is drawn again when it does not hold.
const DRAWS: u32 = 100;

#[derive(Default)]
struct Tape {
    /// Values and their bits.
    choices: Vec<(u64, u32)>,
    next: usize,
    /// Some choice has too many values to try all.
    wide: bool,
    source: Source,
    draws: u32,
    covers: Vec<(&'static str, u64)>,
    /// The message of the last panic.
    panic: String,
}

#[derive(Default)]
enum Source {
    /// Every value, from 0.
    #[default]
    Count,
    /// By a state.
    Random(u64),
    /// From a fuzzer; zeros where they end.
    Bytes(VecDeque<u8>),
    /// These, and no others.
    Told,
}

/// An assumption does not hold.
struct Rejected;

thread_local!(static TAPE: RefCell<Tape> = RefCell::default());

impl Tape {
    fn choose(&mut self, bits: u32) -> u64 {
        if self.next == self.choices.len() {
            let mask = u64::MAX >> (64 - bits);
            let value = match &mut self.source {
                Source::Count => 0,
                Source::Random(state) => random(state, bits) & mask,
                Source::Bytes(bytes) => {
                    let taken = bytes.drain(..bytes.len().min(bits.div_ceil(8) as usize));
                    taken.fold(0, |sum, byte| sum << 8 | u64::from(byte)) & mask
                }
                Source::Told => panic!("the replay has too few numbers"),
            };
            self.wide |= bits > WIDEST;
            self.choices.push((value, bits));
        }
        self.next += 1;
        self.choices[self.next - 1].0
    }

    /// Raises the last choice from `mark` on that can be raised.
    fn raise(&mut self, mark: usize) -> bool {
        while self.choices.len() > mark {
            let (value, bits) = &mut self.choices.last_mut().expect("there is one");
            if *bits < 64 && *value + 1 < 1 << *bits {
                *value += 1;
                return true;
            }
            self.choices.pop();
        }
        false
    }

    /// Another value for the choices from `mark` on, if there is one.
    fn again(&mut self, mark: usize) -> bool {
        let is_there = match self.source {
            Source::Count if self.wide => false,
            Source::Count => self.raise(mark),
            Source::Random(_) => {
                self.draws += 1;
                self.choices.truncate(mark);
                self.draws < DRAWS
            }
            Source::Bytes(_) | Source::Told => false,
        };
        self.next = mark;
        is_there
    }
}

/// One value in two is uniform; the others are small, large, or next to a power of two.
fn random(state: &mut u64, bits: u32) -> u64 {
    let (kind, value) = (split_mix::split_mix(state), split_mix::split_mix(state));
    let power = 1_u64 << (value % u64::from(bits));
    match kind % 8 {
        0 => value % 8,
        1 => u64::MAX - value % 8,
        2 => power,
        3 => power - 1,
        _ => value,
    }
}

pub(crate) fn choose(bits: u32) -> u64 {
    TAPE.with_borrow_mut(|tape| tape.choose(bits))
}

pub(crate) fn mark() -> usize {
    TAPE.with_borrow(|tape| tape.next)
}

pub(crate) fn again(mark: usize) {
    assume(TAPE.with_borrow_mut(|tape| tape.again(mark)));
}

/// Goes on only where `condition` holds.
pub fn assume(condition: bool) {
    if !condition {
        resume_unwind(Box::new(Rejected));
    }
}

/// The function behind [`cover!`](crate::cover!).
pub fn covered(text: &'static str, condition: bool) {
    TAPE.with_borrow_mut(|tape| {
        let hits = u64::from(condition);
        match tape.covers.iter_mut().find(|it| it.0 == text) {
            Some(cover) => cover.1 += hits,
            None => tape.covers.push((text, hits)),
        }
    });
}

/// The report of a harness after its run.
#[derive(Debug)]
pub struct Report {
    /// Runs that no assumption rejected.
    pub cases: u64,
    /// Every combination of inputs was run.
    pub exhaustive: bool,
    /// Each `cover!` and in how many runs it held.
    pub covers: Vec<(&'static str, u64)>,
    /// Why it fails, and how it is run again.
    pub failure: Option<String>,
}

/// One run; whether all assumptions held, or why it fails.
fn once(run: fn()) -> Result<bool, String> {
    TAPE.with_borrow_mut(|tape| (tape.next, tape.draws) = (0, 0));
    let Err(cause) = catch_unwind(AssertUnwindSafe(run)) else { return Ok(true) };
    if cause.is::<Rejected>() {
        return Ok(false);
    }
    TAPE.with_borrow(|tape| {
        let inputs: Vec<_> = tape.choices.iter().map(|it| it.0.to_string()).collect();
        Err(format!("{}\n    KANI_SHIM_REPLAY={}", tape.panic, inputs.join(",")))
    })
}

fn keep_messages() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let usual = take_hook();
        set_hook(Box::new(move |panic| {
            let text = panic.to_string();
            if TAPE.try_with(|it| it.try_borrow_mut().map(|mut it| it.panic = text)).is_err() {
                usual(panic);
            }
        }));
    });
}

/// Runs a harness: on the inputs in `KANI_SHIM_REPLAY` alone, or on all, or else on a sample.
/// `KANI_SHIM_RUNS` is the most runs of both.
pub fn explore(harness: &Harness) -> Report {
    keep_messages();
    let setting = |name| std::env::var(name).ok();
    let mut report = Report { cases: 0, exhaustive: false, covers: Vec::new(), failure: None };
    let run = |report: &mut Report| match once(harness.run) {
        Ok(kept) => report.cases += u64::from(kept),
        Err(why) => report.failure = Some(why),
    };
    if let Some(case) = setting("KANI_SHIM_REPLAY") {
        let choices = case.split(',').filter_map(|it| it.trim().parse().ok());
        let choices = choices.map(|it| (it, 64)).collect();
        TAPE.set(Tape { choices, source: Source::Told, ..Tape::default() });
        run(&mut report);
        return report;
    }
    let asked = setting("KANI_SHIM_RUNS").and_then(|it| it.parse().ok());
    TAPE.set(Tape::default());
    for _ in 0..asked.unwrap_or(MOST) {
        run(&mut report);
        let raised = TAPE.with_borrow_mut(|it| !it.wide && it.raise(0));
        report.exhaustive = !raised && !TAPE.with_borrow(|it| it.wide);
        if report.failure.is_some() || !raised {
            break;
        }
    }
    if report.failure.is_none() && !report.exhaustive {
        report.cases = 0;
        TAPE.set(Tape::default());
        for seed in 0..asked.unwrap_or(SAMPLE) {
            let source = Source::Random(seed.wrapping_mul(0x2545_F491_4F6C_DD1D));
            TAPE.with_borrow_mut(|it| (it.source, it.choices) = (source, Vec::new()));
            run(&mut report);
            if report.failure.is_some() {
                break;
            }
        }
    }
    report.covers = TAPE.take().covers;
    let never = report.covers.iter().find(|it| it.1 == 0);
    if report.failure.is_none() {
        report.failure = match never {
            _ if report.cases == 0 => Some("every case is rejected".into()),
            Some((text, _)) => Some(format!("never covered: {text}")),
            None => None,
        };
    }
    report
}

/// One run with inputs from a fuzzer's bytes; a failure goes on as a panic.
pub fn drive(bytes: &[u8], run: fn()) {
    TAPE.set(Tape { source: Source::Bytes(bytes.iter().copied().collect()), ..Tape::default() });
    if let Err(cause) = catch_unwind(run)
        && !cause.is::<Rejected>()
    {
        resume_unwind(cause);
    }
}

#[cfg(test)]
mod tests {
    use crate::{Harness, Report, any, any_where, assume, cover, explore};

    fn run(run: fn()) -> Report {
        explore(&Harness { name: "", says: "", run, must_fail: false })
    }

    fn failure(of: fn()) -> String {
        run(of).failure.unwrap_or_default()
    }

    #[test]
    fn the_one_bad_case_of_all_is_found_and_can_be_run_again() {
        let said = failure(|| assert!(any::<[u8; 2]>() != [200, 201], "one in 65,536"));
        assert!(said.contains("one in 65,536") && said.ends_with("REPLAY=200,201"), "{said}");
    }

    #[test]
    fn a_case_that_an_assumption_rejects_does_not_count() {
        let report = run(|| {
            let a = any_where(|it: &u8| *it < 10);
            let b = any_where(|it: &u8| *it > a);
            assume(b < 20);
            assert!(a < b && b < 20);
            cover!(a == 9 && b == 19, "the last");
        });
        assert!(report.exhaustive && report.failure.is_none(), "{report:?}");
        assert_eq!(report.cases, (10..20).sum::<u64>());
        assert_eq!(report.covers, [("the last", 1)]);
    }

    #[test]
    fn wide_inputs_are_sampled_alike_each_time() {
        let sampled = || run(|| cover!(any::<u64>() == u64::MAX, "the largest"));
        let (one, other) = (sampled(), sampled());
        assert!(!one.exhaustive && one.failure.is_none(), "{one:?}");
        assert_eq!((one.cases, one.covers), (other.cases, other.covers));
    }

    #[test]
    fn a_harness_that_shows_nothing_fails() {
        assert_eq!(failure(|| assume(any_where(|it: &u8| *it > 9) < 9)), "every case is rejected");
        let uncovered = failure(|| cover!(any_where(|it: &u8| *it < 7) == 7, "seven"));
        assert_eq!(uncovered, "never covered: seven");
    }

    #[test]
    fn bytes_are_inputs() {
        let fails = |bytes: &[u8]| {
            let bytes = bytes.to_vec();
            std::panic::catch_unwind(move || {
                super::drive(&bytes, || assert!(any::<u16>() != 0x0102, "met"));
            })
            .is_err()
        };
        assert!(fails(&[1, 2]) && !fails(&[2, 1]) && !fails(&[]));
    }
}
