//! A supervisor is checked, found wrong, and its counterexample is proven:
//! `cargo run -p cotama-verification --example check_supervisor`.
//!
//! A robot charges at a dock. Its author forgot one guard: that it leaves only when no current
//! flows.

use cotama_core::net;
use cotama_verification::certificate::verify;
use cotama_verification::check::{Model, Options, Verdict, check};
use cotama_verification::diagnosis::{Case, Diagnosis};
use cotama_verification::explicit::{Limits, statespace};
use cotama_verification::property;
use std::error::Error;
use std::io::{self, Write};

net! {
    /// Charges the robot at its dock.
    pub mod dock {
        places { Away: 1, Docked, Off: 1, Current }
        events { contact, start, full, go }
        transitions {
            arrive on contact: Away => Docked;
            charge on start:   Off => Current read Docked;
            stop on full:      Current => Off;
            leave on go:       Docked => Away;
        }
    }
}
net! {
    /// The same with the guard.
    pub mod guarded extends dock {
        instead { leave on go: Docked => Away read Off; }
    }
}

/// Runs the program.
pub(crate) fn run(out: &mut impl Write) -> Result<(), Box<dyn Error>> {
    // 1. How large is it? Every marking is met once.
    let model = Model::from(&dock::NET);
    let space = statespace(model.pt(), &Limits::default(), 1, &|_| {});
    writeln!(out, "{} markings, {} arcs, {} dead", space.states, space.arcs, space.dead_markings)?;

    // 2. The wish: no current flows into a dock that nobody stands in.
    let wish = property::parse("AG !(Current & Away)", model.pt())?;
    let options = Options { evidence: true, ..Options::default() };
    let answer = check(&model, &wish, &options);
    writeln!(out, "{}: {:?} ({})", wish.name, answer.verdict, answer.engine())?;

    // 3. Why not? The shortest way there, in the words of the net.
    let run = answer.run.clone().ok_or("a broken wish has a run")?;
    let case = Case::new(model.pt(), &wish, false, &run).with_net(&dock::NET);
    for (at, step) in Diagnosis::new(&case)?.trace.iter().enumerate() {
        let event = step.event.as_deref().unwrap_or("-");
        writeln!(out, "  {}. {} on {event}", at + 1, step.transition)?;
    }

    // 4. Nobody has to believe the engine: a small checker reads the evidence as a file.
    let certificate = answer.certificate(model.pt(), &wish)?.text();
    let verified = verify(&certificate)?;
    writeln!(out, "verified: {} by {}", verified.verdict, verified.evidence)?;

    // 5. The net with the guard keeps the wish.
    let model = Model::from(&guarded::NET);
    let answer = check(&model, &wish, &options);
    writeln!(out, "guarded: {}", answer.verdict == Verdict::Holds(true))?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
