//! `cotama simulate`: plays a net, with a list of events or by hand.

mod game;
mod interactive;
mod playable;
mod refusal;
mod session;
mod step;

use crate::answers::model::SimulateAnswer;
use crate::args::SimulateArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::model;
use crate::output::Screen;
use crate::render;
use cotama_core::units::Millis;
use session::{Endless, Session};
use std::io::IsTerminal;
use step::{Step, Words};

/// Plays a net.
pub(crate) fn simulate(args: &SimulateArgs, screen: &Screen) -> Result<Exit, Failure> {
    let loaded = model::load(&args.model.model)?;
    let taken = args.model.model == "-";
    let here = || std::io::stdin().is_terminal() && std::io::stdout().is_terminal();
    let by_hand = args.interactive || args.events.is_empty() && !taken && !args.json.json && here();
    if by_hand && taken {
        return Err(Failure::new(
            "standard input cannot hold both the model and what to do with it",
        )
        .help("give the path of the model"));
    }
    let script = if args.events.is_empty() && !by_hand && !taken {
        step::lines(&input::text("-", "a list of events", input::SCRIPT_BYTES)?)
    } else {
        args.events.clone()
    };
    let (net, by_name) = playable::playable(loaded.net);
    let view = net.view();
    let net = view.net();
    game::play(&net, &mut |game, fired| {
        let mut session = Session::new(&net, game, args.rounds);
        let begun = session.begin(&fired);
        if by_hand {
            return interactive::run(session, begun, by_name, args.rounds, &net, screen);
        }
        let steps = Words::new(&net, by_name, args.rounds).script(&script)?;
        let played = begun.and_then(|()| play(&mut session, &steps));
        let answer = session.answer(by_name, played.is_ok(), 0);
        if args.json.json {
            Screen::json(&answer)?;
        } else {
            screen.print(&render::simulate::screen(&answer, &net, screen.width()))?;
        }
        Ok(ended(&answer, args.strict))
    })
}

fn play(session: &mut Session<'_, '_>, steps: &[Step]) -> Result<(), Endless> {
    steps.iter().try_for_each(|step| session.apply(step))
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
