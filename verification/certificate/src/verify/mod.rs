//! The checker of certificates, without an engine: with all that it shares with the crate, fewer
//! than 600 lines that say something.
//!
//! What it shares with the rest of the crate decides nothing about evidence: the data types of a
//! file, their reading with numbers for names (`read.rs`), weighted sums (`sum.rs`), the words of
//! the answer ([`Verified`]). Here is what evidence has to show; in `truth` the firing rule, what
//! questions mean and where formulas hold; in `refutation` proofs without markings.

mod refutation;
#[cfg(test)]
mod tests;
mod truth;

use super::read::{self, Claim, Numbered, marking_bytes};
use super::sum::Marking;
use super::verified::{Checked, Verified, VerifyError, at, each, ensure, error};
use super::{Evidence, Formula, Question};
use Evidence::{Each, Graph, Growth, Lasso, One, Refutation, State, Trace};
use Formula::{All, AllNext, And, Exists, ExistsNext, Finally, Globally, Not, Or, Until};

pub use super::read::{MAX_BYTES, MAX_MEMORY, MAX_WORK};
pub(super) use refutation::Known;

/// Checks a certificate.
///
/// # Errors
/// When the text is no certificate, is beyond the limits of [this module](self), or does not show
/// what it claims. A certificate that is refused does not show that its verdict is wrong.
pub fn verify(text: &str) -> Result<Verified, VerifyError> {
    let read = read::certificate(text)?;
    let net = Numbered::new(&read.net).map_err(at("net"))?;
    let shown = match (&read.question, &read.evidence) {
        (Question::Unbounded { places }, Growth(by)) if read.verdict => net.grows(places, by),
        (question, by) => {
            let formula = net.meaning(question).map_err(at("question"))?;
            net.prove(&net.initial, (&formula, read.verdict), by)
        }
    };
    shown.map(|()| Verified::of(&read)).map_err(at("evidence"))
}

/// A claim about a path as `a U b`: its `a`, unless that is `true`, and the claim `b`.
fn until((path, truth): Claim<'_>) -> Option<(Option<&Formula>, Claim<'_>)> {
    match (path, truth) {
        (Not(path), _) => until((path, !truth)),
        (Finally(goal), true) | (Globally(goal), false) => Some((None, (goal, truth))),
        (Until(both), true) => Some((Some(&both.0), (&both.1, true))),
        _ => None,
    }
}

impl Numbered<'_> {
    /// Checks the evidence that the claim is true at this marking.
    fn prove(&self, from: &Marking, claim: Claim<'_>, by: &Evidence) -> Checked<()> {
        let (formula, truth) = claim;
        let misfit = || error("this kind of evidence does not fit the claim");
        // Whether something is claimed of every part, marking or run; else of one.
        let every = truth == matches!(formula, And(_) | All(_) | AllNext(_));
        match (by, formula) {
            (Evidence::None, _) => Err(error("there is no evidence")),
            (_, Not(inner)) => self.prove(from, (inner, !truth), by),
            (State, _) => self.holds(from, claim),
            (Graph(count), _) => {
                self.graph(from, *count).and_then(|it| self.shows(&it, claim)).map_err(at(".graph"))
            }
            (Each(by), And(parts) | Or(parts)) if every => {
                let (all, claims) = (by.len(), parts.len());
                let other = format!("there are {all} parts of evidence for {claims} claims");
                ensure(all == claims, other)?;
                let all = each(by.iter().zip(parts), |(by, it)| self.prove(from, (it, truth), by));
                all.map(drop).map_err(at(".each"))
            }
            (One(one), And(parts) | Or(parts)) if !every => {
                let none = || error(format_args!("there are {} parts", parts.len()));
                let part = parts.get(one.part).ok_or_else(none).map_err(at(".one.part"))?;
                self.prove(from, (part, truth), &one.by).map_err(at(".one.by"))
            }
            (Trace(it), ExistsNext(goal) | AllNext(goal)) if !every && it.fire.len() == 1 => {
                let (_, end) = self.path(from, &it.fire).map_err(at(".trace.fire"))?;
                self.prove(&end, (goal, truth), &it.then).map_err(at(".trace.then"))
            }
            (Trace(it), Exists(path) | All(path)) if !every => {
                let (first, goal) = until((path, truth)).ok_or_else(misfit)?;
                let (way, end) = self.path(from, &it.fire).map_err(at(".trace.fire"))?;
                let kept = |at| first.map_or(Ok(()), |it| self.holds(at, (it, true)));
                each(&way, kept).map_err(at(".trace.fire"))?;
                self.prove(&end, goal, &it.then).map_err(at(".trace.then"))
            }
            (Lasso(by), Exists(it) | All(it)) if !every => {
                self.run(from, by).and_then(|on| self.shows(&on, (it, truth))).map_err(at(".lasso"))
            }
            (Refutation(by), Exists(path) | All(path)) if every => {
                let (_, goal) = until((path, !truth)).ok_or_else(misfit)?;
                self.refute(from, goal, by).map_err(at(".refutation"))
            }
            _ => Err(misfit()),
        }
    }

    /// Checks that the repeated sequence takes nothing away, and adds tokens to some of these
    /// places.
    fn grows(&self, places: &[String], by: &super::Growth) -> Checked<()> {
        let special = "what has fired may be inhibited, or not go first, another time";
        ensure(self.is_plain, special).map_err(at(".growth"))?;
        let (_, before) = self.path(&self.initial, &by.stem).map_err(at(".growth.stem"))?;
        let (_, after) = self.path(&before, &by.pump).map_err(at(".growth.pump"))?;
        let kept = before.iter().zip(&after).all(|(before, after)| before <= after);
        let grows = self.places(places)?.into_iter().any(|it| before[it] < after[it]);
        ensure(kept && grows, "takes tokens away, or adds none where asked")
            .map_err(at(".growth.pump"))
    }
}
