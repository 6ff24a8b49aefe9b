//! The checker of certificates. This folder is all of it, in fewer than 400 lines; no engine has a
//! part in it.
//!
//! What it shares with the rest of the crate decides nothing about evidence: the data types of a
//! file, their reading with numbers for names (`read.rs`), weighted sums (`sum.rs`), and the words
//! of the answer ([`Verified`]). Here is what evidence has to show; in `truth` the firing rule,
//! what questions mean and where formulas hold; in `refutation` proofs without markings.

mod refutation;
mod truth;

use super::read::{self, Checked, Numbered, at, each, ensure, error, marking_bytes};
use super::sum::Marking;
use super::{Evidence, Formula, Growth, Question, Verified, VerifyError};
use Formula::{All, AllNext, And, Exists, ExistsNext, Finally, Globally, Not, Or, Until};
use truth::Space;

pub use super::read::{MAX_BYTES, MAX_MEMORY, MAX_WORK};
pub(super) use refutation::Known;

/// Checks a certificate.
///
/// # Errors
///
/// When the text is no certificate, is beyond the limits of [this module](self), or does not show
/// what it claims. A certificate that is refused does not show that its verdict is wrong.
pub fn verify(text: &str) -> Result<Verified, VerifyError> {
    let read = read::certificate(text)?;
    let net = Numbered::new(&read.net).map_err(at("net"))?;
    let shown = match (&read.question, &read.evidence) {
        (Question::Unbounded { places }, Evidence::Growth(by)) if read.verdict => {
            net.grows(places, by)
        }
        (question, by) => {
            let formula = net.meaning(question).map_err(at("question"))?;
            net.prove(&net.initial, &formula, read.verdict, by)
        }
    };
    shown.map(|()| Verified::of(&read)).map_err(at("evidence"))
}

const MISFIT: &str = "this kind of evidence does not fit the claim";

/// The operands of `a U b`, as which a path formula is read that holds, or does not: `F b` is `true
/// U b`, and `!G b` is `F !b`. Last, whether the second one is to hold.
fn until(path: &Formula, holds: bool) -> Checked<(Option<&Formula>, &Formula, bool)> {
    match (path, holds) {
        (Not(path), _) => until(path, !holds),
        (Finally(goal), true) | (Globally(goal), false) => Ok((None, goal, holds)),
        (Until(both), true) => Ok((Some(&both.0), &both.1, true)),
        _ => Err(error(MISFIT)),
    }
}

impl Numbered<'_> {
    /// That the formula has this truth at this marking, by this evidence.
    fn prove(&self, from: &Marking, formula: &Formula, truth: bool, by: &Evidence) -> Checked<()> {
        // Whether something is claimed of every part, marking or run; else of one.
        let every = truth == matches!(formula, And(_) | All(_) | AllNext(_));
        match (by, formula) {
            (Evidence::None, _) => Err(error("there is no evidence")),
            (_, Not(inner)) => self.prove(from, inner, !truth, by),
            (Evidence::State, _) => self.shows(&Space::of(from), formula, truth),
            (Evidence::Graph(count), _) => self
                .graph(from, *count)
                .and_then(|it| self.shows(&it, formula, truth))
                .map_err(at(".graph")),
            (Evidence::Each(by), And(parts) | Or(parts)) if every => {
                let (all, claims) = (by.len(), parts.len());
                ensure(
                    all == claims,
                    format_args!("there are {all} parts of evidence for {claims} claims"),
                )?;
                let shown =
                    each(by.iter().zip(parts), |(by, part)| self.prove(from, part, truth, by));
                shown.map(drop).map_err(at(".each"))
            }
            (Evidence::One(one), And(parts) | Or(parts)) if !every => {
                let none = || error(format_args!("there are {} parts", parts.len()));
                let part = parts.get(one.part).ok_or_else(none).map_err(at(".one.part"))?;
                self.prove(from, part, truth, &one.by).map_err(at(".one.by"))
            }
            (Evidence::Trace(it), ExistsNext(goal) | AllNext(goal))
                if !every && it.fire.len() == 1 =>
            {
                let (_, end) = self.way(from, &it.fire).map_err(at(".trace.fire"))?;
                self.prove(&end, goal, truth, &it.then).map_err(at(".trace.then"))
            }
            (Evidence::Trace(it), Exists(path) | All(path)) if !every => {
                let (first, goal, holds) = until(path, truth)?;
                let (way, end) = self.way(from, &it.fire).map_err(at(".trace.fire"))?;
                let first =
                    |at: &_| first.map_or(Ok(()), |it| self.shows(&Space::of(at), it, true));
                each(&way, first).map_err(at(".trace.fire"))?;
                self.prove(&end, goal, holds, &it.then).map_err(at(".trace.then"))
            }
            (Evidence::Lasso(it), Exists(path) | All(path)) if !every => {
                self.run(from, it).and_then(|it| self.shows(&it, path, truth)).map_err(at(".lasso"))
            }
            (Evidence::Refutation(by), Exists(path) | All(path)) if every => {
                let (_, goal, holds) = until(path, !truth)?;
                self.refute(from, goal, holds, by).map_err(at(".refutation"))
            }
            _ => Err(error(MISFIT)),
        }
    }

    /// That what can be repeated takes nothing away, and adds tokens to some of these places.
    fn grows(&self, places: &[String], by: &Growth) -> Checked<()> {
        let (_, before) = self.way(&self.initial, &by.stem).map_err(at(".growth.stem"))?;
        let (_, after) = self.way(&before, &by.pump).map_err(at(".growth.pump"))?;
        let kept = before.iter().zip(&after).all(|(before, after)| before <= after);
        let grows = places.iter().any(|it| self.place(it).is_ok_and(|it| before[it] < after[it]));
        ensure(kept && grows, "takes tokens away, or adds none where asked")
            .map_err(at(".growth.pump"))
    }
}
