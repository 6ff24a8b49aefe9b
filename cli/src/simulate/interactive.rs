//! Playing by hand: what can be done is shown, and what is typed is done.

use super::step::Words;
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use crate::render::simulate as render;
use crate::render::style::{FAINT, NAME, NOTICE};
use crate::render::visible;
use cotama_core::net::Net;
use cotama_verification::play::{Endless, MOST_FIRINGS, Session};
use std::io::{BufRead, IsTerminal, Read};

/// The most bytes of a line.
const LINE: u64 = 64 << 10;

const HELP: &str = "  EVENT, or the beginning of its name, or its number: offers it now
  EVENT@MS: at this time   +MS: lets time pass   A,B: one round (with --rounds)
  back: makes the last step undone   marking: all places   help   quit
";

/// Plays a session that has begun until its player has had enough.
pub(super) fn run(
    mut session: Session<'_, '_>,
    begun: Result<(), Endless>,
    by_name: bool,
    rounds: bool,
    net: &Net<'_>,
    screen: &Screen,
) -> Result<Exit, Failure> {
    let words = Words::new(net, by_name, rounds).loose();
    let mut history = vec![];
    let mut shown = 0;
    let mut input = std::io::stdin().lock();
    // Text typed on a terminal stands there already.
    let typed = std::io::stdin().is_terminal();
    screen.print(&format!("{NAME}{}{NAME:#}\n{FAINT}{HELP}{FAINT:#}", visible(net.name)))?;
    if begun.is_err() {
        return endless(screen).map(|()| Exit::Unknown);
    }
    let mut moved = true;
    loop {
        if moved {
            let answer = super::answer::answer(&session, by_name, true, shown);
            screen.print(&render::position(&answer, net, screen.width()))?;
        }
        screen.print("> ")?;
        (moved, shown) = (false, session.records().len());
        let Some(line) = read(&mut input)? else {
            screen.print("\n")?;
            return Ok(Exit::Success);
        };
        if !typed {
            screen.print(&format!("{}\n", visible(line.trim())))?;
        }
        match line.trim() {
            "" => {}
            "quit" | "exit" => return Ok(Exit::Success),
            "help" => screen.print(&format!("{FAINT}{HELP}{FAINT:#}"))?,
            "marking" => {
                let answer = super::answer::answer(&session, by_name, true, shown);
                screen.print(&render::whole_marking(&answer, screen.width()))?;
            }
            "back" => match history.pop() {
                Some(saved) => {
                    session.restore(saved);
                    (moved, shown) = (true, session.records().len());
                }
                None => screen.print(&format!("{NOTICE}this is the start{NOTICE:#}\n"))?,
            },
            word => match words.step(word, session.now()) {
                Err(failure) => screen.explain(&failure),
                Ok(step) => {
                    let saved = session.save();
                    if session.apply(step.at, &step.events) == Err(Endless) {
                        session.restore(saved);
                        endless(screen)?;
                    } else {
                        history.push(saved);
                        moved = true;
                    }
                }
            },
        }
    }
}

fn endless(screen: &Screen) -> Result<(), Failure> {
    screen.print(&format!(
        "{NOTICE}more than {MOST_FIRINGS} transitions would fire: not done{NOTICE:#}\n"
    ))
}

/// A line; none when there is no more.
fn read(input: &mut impl BufRead) -> Result<Option<String>, Failure> {
    let mut line = vec![];
    let read = input.take(LINE).read_until(b'\n', &mut line);
    read.map_err(|error| Failure::new(format!("standard input cannot be read: {error}")))?;
    Ok((!line.is_empty()).then(|| String::from_utf8_lossy(&line).into_owned()))
}
