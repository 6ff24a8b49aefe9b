//! The checker of certificates. It uses nothing of this crate but the data types of [`certificate`](super), and its claims: what
//! questions mean.

pub(super) mod net;
pub(super) mod refutation;
mod space;

use super::claim::Claim::{self, And, Exists, Not, Successor, Unbounded};
use super::{Certificate, Evidence, SCHEMA, Verified, VerifyError};
use net::{Marking, Net};
use std::fmt::Display;

/// The longest text of a certificate, in bytes.
pub const MAX_BYTES: usize = 1 << 26;
/// The most work: about so many arcs and terms are looked at, and bytes are used.
pub const MAX_WORK: u64 = 1 << 30;

pub(super) type Checked<T> = Result<T, VerifyError>;

fn fail<T>(message: impl Display) -> Checked<T> {
    Err(VerifyError { at: String::new(), message: message.to_string() })
}

fn ensure(holds: bool, message: impl Display) -> Checked<()> {
    if holds { Ok(()) } else { fail(message) }
}

/// Puts the part of the certificate in front of where an error is.
fn at(part: impl Display) -> impl FnOnce(VerifyError) -> VerifyError {
    move |it| VerifyError { at: format!("{part}{}", it.at), ..it }
}

/// Checks a certificate.
///
/// # Errors
///
/// When the text is no certificate, is beyond the limits of [this module](self), or does not show what it claims. A
/// certificate that is refused does not show that its verdict is wrong.
pub fn verify(text: &str) -> Result<Verified, VerifyError> {
    let long = format_args!("has {} bytes; at most {MAX_BYTES} are read", text.len());
    ensure(text.len() <= MAX_BYTES, long).map_err(at("certificate"))?;
    let read: Certificate = serde_json::from_str(text).or_else(fail).map_err(at("certificate"))?;
    ensure(read.schema == SCHEMA, format_args!("is `{}`, not `{SCHEMA}`", read.schema))
        .map_err(at("schema"))?;
    let net = Net::read(&read.net).map_err(at("net"))?;
    let claim = net.question(&read.question).map_err(at("question"))?;
    net.prove(&net.initial, &claim, read.verdict, &read.evidence).map_err(at("evidence"))?;
    Ok(Verified::of(&read))
}

impl Net<'_> {
    /// That the claim has this truth at this marking, by this evidence.
    fn prove(&self, from: &Marking, claim: &Claim, truth: bool, by: &Evidence) -> Checked<()> {
        match (by, claim, claim.until()) {
            (Evidence::None, ..) => fail("there is no evidence"),
            (_, Not(inner), _) => self.prove(from, inner, !truth, by),
            (Evidence::State, ..) => self.marking(from).shows(claim, truth),
            (Evidence::Each(all), And(parts), _) if truth => {
                let message =
                    format_args!("there are {} parts of evidence for {} claims", all.len(), parts.len());
                ensure(all.len() == parts.len(), message)?;
                all.iter().zip(parts).enumerate().try_for_each(|(n, (by, part))| {
                    self.prove(from, part, true, by).map_err(at(format_args!(".each[{n}]")))
                })
            }
            (Evidence::One(one), And(parts), _) if !truth => match parts.get(one.part) {
                Some(part) => self.prove(from, part, false, &one.by).map_err(at(".one.by")),
                None => fail(format_args!("there are {} parts", parts.len())).map_err(at(".one.part")),
            },
            (Evidence::Trace(it), Successor(goal), _) if truth && it.fire.len() == 1 => {
                let way = self.way(from, &it.fire).map_err(at(".trace.fire"))?;
                self.prove(&way[1], goal, true, &it.then).map_err(at(".trace.then"))
            }
            (Evidence::Trace(it), _, Some(both)) if truth => {
                let way = self.way(from, &it.fire).map_err(at(".trace.fire"))?;
                for (n, now) in way[..it.fire.len()].iter().enumerate() {
                    self.marking(now).shows(&both.0, true).map_err(at(format!(".trace.fire[{n}]")))?;
                }
                self.prove(&way[it.fire.len()], &both.1, true, &it.then).map_err(at(".trace.then"))
            }
            (Evidence::Lasso(it), Exists(path), _) if truth => {
                self.run(from, it).and_then(|it| it.shows(path, true)).map_err(at(".lasso"))
            }
            (Evidence::Growth(growth), Unbounded(sum), _) if truth => {
                let stem = self.way(from, &growth.stem).map_err(at(".growth.stem"))?;
                let pump = self.way(&stem[growth.stem.len()], &growth.pump).map_err(at(".growth.pump"))?;
                let (before, after) = (&pump[0], &pump[growth.pump.len()]);
                let kept = before.iter().zip(after).all(|(before, after)| before <= after);
                let grows = kept && sum.value(before) < sum.value(after);
                ensure(grows, "takes tokens away, or adds none where asked").map_err(at(".growth.pump"))
            }
            (Evidence::Refutation(by), _, Some(both)) if !truth => {
                self.refute(from, &both.1, by).map_err(at(".refutation"))
            }
            (Evidence::Graph(it), ..) => {
                self.graph(from, *it).and_then(|it| it.shows(claim, truth)).map_err(at(".graph"))
            }
            _ => fail("this kind of evidence does not fit the claim"),
        }
    }
}
