//! `cotama simulate` of a behaviour tree: each word is the answer to the next question.

use super::{load, only, warn};
use crate::answers::check::tree::{TreeSimulateAnswer, TreeTickRow};
use crate::args::SimulateArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::output::Screen;
use crate::render;
use cotama_trees::machine::{Machine, Question, Reply, Stop};
use cotama_trees::tree::Tree;
use std::io::IsTerminal;

/// Most ticks that are played without a question.
const QUIET: usize = 1_000;

struct Game<'t> {
    tree: &'t Tree,
    machine: Machine<'t>,
    ticks: Vec<TreeTickRow>,
    stop: Option<Stop>,
    ended: bool,
}

impl Game<'_> {
    /// Ticks until a question, or the end of the run.
    fn go_on(&mut self) -> Option<Question> {
        for _ in 0..QUIET {
            let stop = match self.stop.take() {
                Some(stop) => stop,
                None if self.ended => return None,
                None => self.machine.tick(),
            };
            let status = match stop {
                Stop::Asked(question) => {
                    self.stop = Some(Stop::Asked(question));
                    return Some(question);
                }
                Stop::Answered(answer) => answer.letter().to_string(),
                Stop::Halted => "H".to_owned(),
                Stop::Thrown(thrown) => {
                    let of = thrown.node.map(|it| format!("@{}", self.tree.shown(it)));
                    format!("X{}: {}", of.unwrap_or_default(), thrown.why)
                }
            };
            self.ended = status != "R";
            let events = self.machine.take_events();
            self.ticks.push(TreeTickRow {
                tick: self.ticks.len() + 1,
                events: events.iter().map(|it| it.shown(self.tree)).collect(),
                status,
                blackboard: self.machine.blackboard(),
                marked: self.machine.marked().into_iter().map(str::to_owned).collect(),
            });
        }
        self.ended = true;
        None
    }
}

/// Returns the word for a reply: a letter, or the name of a supervisor's move.
fn word(tree: &Tree, reply: Reply) -> String {
    match (reply, tree.bonds.as_deref()) {
        (Reply::Net(at), Some(bonds)) => bonds.of_move(at).to_owned(),
        _ => reply.letter().to_string(),
    }
}

fn asked(machine: &Machine, question: &Question) -> String {
    let tree = machine.tree();
    let replies = question.replies.iter().filter(|it| !machine.is_idle(**it));
    let words = replies.map(|it| word(tree, *it)).collect::<Vec<_>>();
    let label = tree.shown(question.node);
    format!("{label}{} {}", question.how.sign(), words.join(" "))
}

/// Plays a tree with answers from the command line, from standard input, or by hand.
pub(crate) fn simulate(args: &SimulateArgs, screen: &Screen) -> Result<Exit, Failure> {
    only(&[
        ("--rounds", args.rounds),
        ("--strict", args.strict),
        ("--trace", args.trace.is_some()),
        ("--interactive", args.interactive),
    ])?;
    let loaded = load(&args.model.model, &args.tree)?;
    warn(&loaded, screen);
    let tree = &loaded.tree;
    let machine = Machine::new(tree);
    let mut game = Game { tree, machine, ticks: Vec::new(), stop: None, ended: false };
    let by_hand = args.events.is_empty() && !args.json.json && std::io::stdin().is_terminal();
    let mut words: std::collections::VecDeque<String> = args.events.iter().cloned().collect();
    if args.events.is_empty() && !by_hand {
        let text = input::text("-", "a list of answers", input::SCRIPT_BYTES)?;
        let lines = text.lines().filter(|it| !it.trim_start().starts_with('#'));
        words.extend(lines.flat_map(str::split_whitespace).map(str::to_owned));
    }
    let mut shown = 0;
    let mut waits = None;
    while let Some(question) = game.go_on() {
        if by_hand {
            for row in &game.ticks[shown..] {
                screen.print(&render::tree::tick(row))?;
            }
            shown = game.ticks.len();
            screen.print(&format!("{}? ", asked(&game.machine, &question)))?;
        }
        let said = match words.pop_front() {
            Some(said) => said,
            None if by_hand => match input::answer()? {
                Some(line) => line,
                None => break,
            },
            None => {
                waits = Some(asked(&game.machine, &question));
                break;
            }
        };
        // `LEAF=S` says for which question an answer is meant.
        let (of, letter) = said.split_once('=').unwrap_or(("", &said));
        let is_said = |it: &Reply| match it {
            Reply::Net(_) | Reply::Rest => word(tree, *it) == letter,
            _ => it.letter().to_string() == letter.to_ascii_uppercase(),
        };
        let reply = question.replies.iter().copied().find(is_said);
        let is_meant = of.is_empty() || tree.find(of) == Some(question.node);
        match reply.filter(|_| is_meant) {
            Some(reply) => game.stop = Some(game.machine.reply(reply)),
            None if by_hand && matches!(said.as_str(), "q" | "quit") => break,
            None if by_hand => screen.note("one of the letters, or quit"),
            None => {
                let message =
                    format!("`{said}` is no answer to {}", asked(&game.machine, &question));
                return Err(Failure::new(message).help(
                    "S success, F failure, R running, K skipped; T open, N closed; the number of a \
                     child; a move, or -",
                ));
            }
        }
    }
    if let Some(said) = words.front() {
        let message = format!("`{said}` is one answer too many: the run has ended");
        return Err(Failure::new(message).help("leave it out"));
    }
    let answer = TreeSimulateAnswer {
        schema: "cotama/simulate-tree/1",
        model: args.model.model.clone(),
        ticks: game.ticks,
        asked: waits,
    };
    if args.json.json {
        Screen::json(&answer)?;
        return Ok(Exit::Success);
    }
    for row in &answer.ticks[shown..] {
        screen.print(&render::tree::tick(row))?;
    }
    if let Some(question) = &answer.asked {
        screen.print(&format!("asked: {question}\n"))?;
    }
    Ok(Exit::Success)
}
