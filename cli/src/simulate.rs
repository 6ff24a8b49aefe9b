//! `cotama simulate`: plays a net or a system, with a list of events or by hand.

mod answer;
mod interactive;
pub(crate) mod step;

use crate::answers::model::SimulateAnswer;
use crate::args::SimulateArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::model;
use crate::output::{self, Screen};
use crate::render;
use crate::tree;
use cotama_core::text;
use cotama_core::units::Millis;
use cotama_verification::conform::SCHEMA;
use cotama_verification::play::{Endless, Fired, NotPlayed, Numbered, Session};
use serde_json::{Value, json};
use std::io::IsTerminal;
use step::{Step, Words};

/// Plays a net or a system.
pub(crate) fn simulate(args: &SimulateArgs, screen: &Screen) -> Result<Exit, Failure> {
    if tree::is(&args.model.model) {
        return tree::simulate(args, screen);
    }
    tree::idle(args.tree.given(), &args.model.model)?;
    let numbered = model::with_system(&args.model.model, |it, _| Numbered::of(it))?;
    let taken = args.model.model == "-";
    let here = || std::io::stdin().is_terminal() && std::io::stdout().is_terminal();
    let by_hand = args.interactive
        || args.events.is_empty() && !taken && !args.json.json && args.trace.is_none() && here();
    if by_hand && taken {
        return Err(Failure::new(
            "standard input cannot hold both the model and what to do with it",
        )
        .help("give the path of the model"));
    }
    if args.trace.is_some() && args.rounds && !numbered.is_system() {
        return Err(Failure::new(
            "--trace records events one after the other, and synchronous rounds have many at once",
        )
        .help("leave --rounds out"));
    }
    let script = if args.events.is_empty() && !by_hand && !taken {
        step::lines(&input::text("-", "a list of events", input::SCRIPT_BYTES)?)
    } else {
        args.events.clone()
    };
    // In a plain place/transition net, without events and time, no transition would ever wait for
    // anything. There each one gets an event of its own name.
    let by_name = numbered.is_plain();
    let numbered = if by_name { numbered.choosing(|_| true, Millis(0)) } else { numbered };
    let view = numbered.whole().view();
    let net = view.net();
    let mut ended = Ok(Exit::Success);
    let played = numbered.play(Millis(0), &mut |game, fired| {
        let session = Session::new(&numbered, &net, game, args.rounds);
        ended = if by_hand {
            let mut session = session;
            let begun = session.begin(&fired);
            interactive::run(session, begun, by_name, args.rounds, &net, screen)
        } else {
            let words = Words::new(&net, by_name, args.rounds);
            words
                .script(&script)
                .and_then(|steps| said(args, screen, session, &fired, &steps, by_name))
        };
    });
    played.map_err(|why| not_played(&why))?;
    ended
}

/// Why a model cannot be played.
pub(crate) fn not_played(why: &NotPlayed) -> Failure {
    let failure = Failure::new(why.to_string());
    match why.help() {
        Some(help) => failure.help(help),
        None => failure,
    }
}

/// Plays all steps and says what became of them.
fn said(
    args: &SimulateArgs,
    screen: &Screen,
    mut session: Session<'_, '_>,
    fired: &[Fired],
    steps: &[Step],
    by_name: bool,
) -> Result<Exit, Failure> {
    let net = session.net();
    let begun = session.begin(fired);
    let played = begun.and_then(|()| play(&mut session, steps));
    let answer = answer::answer(&session, by_name, played.is_ok(), 0);
    if let Some(path) = &args.trace {
        let lines = text::json(&recording(&answer)).to_string();
        output::file(path, lines.as_bytes())?;
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::simulate::screen(&answer, net, screen.width()))?;
    }
    Ok(ended(&answer, args.strict))
}

/// Returns the recording of the session, for `cotama conform`.
fn recording(answer: &SimulateAnswer) -> String {
    let mut lines = vec![json!({ "schema": SCHEMA })];
    for step in &answer.steps {
        let t_ms = step.time_ms;
        if step.round && answer.rounds {
            lines.push(json!({ "t_ms": t_ms, "round": true }));
        }
        // A transition that is fired by its name is its own event.
        for event in step.events.iter().filter(|_| !answer.by_name) {
            let ignored = step.fired.is_empty();
            lines.push(json!({ "t_ms": t_ms, "event": event, "ignored": ignored }));
        }
        lines.extend(step.fired.iter().map(|it| json!({ "t_ms": t_ms, "fired": it })));
    }
    lines.push(json!({ "t_ms": answer.time_ms, "end": true }));
    lines.iter().map(Value::to_string).collect::<Vec<_>>().join("\n") + "\n"
}

fn play(session: &mut Session<'_, '_>, steps: &[Step]) -> Result<(), Endless> {
    steps.iter().try_for_each(|step| session.apply(step.at, &step.events))
}

fn ended(answer: &SimulateAnswer, strict: bool) -> Exit {
    match answer {
        SimulateAnswer { complete: false, .. } => Exit::Unknown,
        SimulateAnswer { ignored: 1.., .. } if strict => Exit::Violated,
        _ => Exit::Success,
    }
}

/// Milliseconds as plain numbers.
fn ms(Millis(ms): Millis) -> u64 {
    ms
}
