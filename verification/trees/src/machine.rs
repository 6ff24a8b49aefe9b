//! Executor: a tick as the library does it.
//!
//! A [`Machine`] holds a tree between two ticks, or within one while it waits for an answer: every
//! choice of the world is a [`Question`], and everything else follows. The ways through a tick are
//! no calls within calls: a node knows from its cells for which child it waits, so that a machine
//! can be put aside in the middle of a tick as a few words, and be taken up again.

mod beside;
mod boards;
mod catching;
mod cells;
mod choices;
mod controls;
mod decorators;
mod halting;
mod leaves;
mod nav2;
mod parallel;
mod queues;
mod timers;
mod watched;
mod words;

use crate::tree::{Answer, Kind, Tree};
pub use beside::Vain;
pub(crate) use boards::Store;
pub(crate) use catching::catches;
use catching::{Catching, From};
pub(crate) use cells::Layout;
pub(crate) use queues::{item, items};
use std::fmt;
use timers::Beat;
pub(crate) use watched::Watched;
pub use words::{Event, How, MOST_CHOICES, MOST_MOVES, Question, Reply, Status, Stop, Thrown};

/// The cause of an exception, before a node is named.
pub(crate) struct Fault(pub(crate) String);

pub(crate) fn fault<T>(why: impl fmt::Display) -> Result<T, Fault> {
    Err(Fault(why.to_string()))
}

fn idle() -> Fault {
    Fault("a condition was skipped, and the node answers IDLE".to_owned())
}

/// Next step of a node.
pub(crate) enum Move {
    /// Ticks the child at this place.
    Child(usize),
    /// Answers its parent.
    Answer(Answer),
    /// Asks the world.
    Ask,
    /// Answers IDLE, which throws in the parent.
    Idle,
}

/// Outcome of a node's part of a tick.
type Step = Result<Move, Fault>;

fn answer(it: Answer) -> Step {
    Ok(Move::Answer(it))
}

fn child(at: usize) -> Step {
    Ok(Move::Child(at))
}

/// Point from which a tick goes on.
enum Cursor {
    Enter(usize),
    Leave(usize, Answer),
    /// At the timers after this one: date, node.
    Timers(Option<(i64, usize)>),
    Step(usize, Result<Move, Fault>),
}

/// A tree with everything that it remembers.
pub struct Machine<'t> {
    pub(crate) tree: &'t Tree,
    pub(crate) layout: Layout,
    pub(crate) cells: Vec<u32>,
    /// Value of each entry, by the numbers of the store.
    pub(crate) entries: Vec<u32>,
    pub(crate) store: Store,
    /// Dates of timers, in ms.
    dates: Vec<i64>,
    /// The date, where timers go by the clock.
    clock: Option<i64>,
    pub(crate) now: i64,
    /// The node that asks.
    pub(crate) at: Option<usize>,
    /// A wake-up is pending.
    pub(crate) wake: bool,
    pub(crate) events: Vec<Event>,
    /// Answers of each node so far, as bits.
    pub(crate) said: Vec<u8>,
    /// Child and control node that failed at once upon the child's SUCCESS, the latest.
    pub(crate) lost: Vec<(u32, u32)>,
    /// For each node, the cell that notes its answer of this tick, where this is watched.
    pub(crate) watched: Vec<Option<usize>>,
    /// Cells of statuses that are kept where a run has ended.
    pub(crate) kept: Vec<usize>,
    /// Time between two ticks, where they come at a period.
    beat: Option<Beat>,
    /// Cells of the supervisor.
    beside: Option<beside::Beside>,
    /// Events that leaves offered to the supervisor in vain, the latest.
    pub(crate) refused: Vec<Vain>,
    /// Leaves that started in the supervisor, each with an action that ran, the latest.
    pub(crate) begun: Vec<(u32, u32)>,
    /// Questions within halting, where a node asks there.
    catching: Option<Catching>,
    /// The node in whose tick an exception was thrown, within halting.
    named: Option<usize>,
}

impl<'t> Machine<'t> {
    /// Makes a tree that was never ticked; timers are questions.
    pub fn new(tree: &'t Tree) -> Machine<'t> {
        let layout = Layout::of(tree);
        let mut machine = Machine {
            tree,
            cells: vec![0; layout.widths.len()],
            layout,
            entries: Vec::new(),
            store: Store::of(tree),
            dates: vec![0; tree.nodes.len()],
            clock: None,
            now: 0,
            at: None,
            wake: false,
            events: Vec::new(),
            said: vec![0; tree.nodes.len()],
            lost: Vec::new(),
            watched: vec![None; tree.nodes.len()],
            kept: Vec::new(),
            beat: None,
            beside: None,
            refused: Vec::new(),
            begun: Vec::new(),
            catching: None,
            named: None,
        };
        for (node, it) in tree.nodes.iter().enumerate() {
            if matches!(it.kind, Kind::PathLongerOnApproach | Kind::SingleTrigger) {
                machine.set(node, 0, 1);
            }
        }
        machine.fill();
        machine.beside();
        machine.catching();
        machine
    }

    /// Makes a tree whose timers go by a clock that begins at 0 ms.
    pub fn with_clock(tree: &'t Tree) -> Machine<'t> {
        Machine { clock: Some(0), ..Machine::new(tree) }
    }

    /// Lets time pass.
    pub fn wait(&mut self, ms: i64) {
        if let Some(clock) = &mut self.clock {
            *clock += ms;
            self.now = *clock;
        }
    }

    /// Makes a tree that is ticked every so many ms: timers and rates count, and ask nothing.
    pub fn with_period(tree: &'t Tree, ms: u32) -> Machine<'t> {
        let mut machine = Machine::new(tree);
        machine.count(ms);
        machine
    }

    /// Returns the status of a node.
    #[inline]
    pub fn status(&self, node: usize) -> Status {
        Status::of_code(self.cells[node])
    }

    /// Returns what happened since the last call.
    pub fn take_events(&mut self) -> Vec<Event> {
        std::mem::take(&mut self.events)
    }

    /// Returns and forgets whether a wake-up is pending.
    pub fn take_wake(&mut self) -> bool {
        std::mem::take(&mut self.wake)
    }

    #[inline]
    pub(crate) fn put_status(&mut self, node: usize, status: Status) {
        self.cells[node] = status as u32;
    }

    #[inline]
    pub(crate) fn is_active(&self, node: usize) -> bool {
        self.cells[node] != 0
    }

    #[inline]
    pub(crate) fn child(&self, node: usize, position: usize) -> usize {
        self.tree.nodes[node].children[position]
    }

    #[inline]
    pub(crate) fn children(&self, node: usize) -> &'t [usize] {
        &self.tree.nodes[node].children
    }

    /// Ticks the root once, up to the first question.
    pub fn tick(&mut self) -> Stop {
        self.begin(From::Tick, Vec::new())
    }

    /// Goes on to the next question, whatever halting asks.
    fn go(&mut self, from: From) -> Stop {
        let (node, reply) = match from {
            From::Tick => {
                self.pass();
                return self.ask_net().unwrap_or_else(|| self.reply_rest());
            }
            From::Halt => return self.halt_all(),
            From::Reply(node, reply) => (node, reply),
        };
        match reply {
            Reply::Net(at) => {
                self.moved(at);
                let asked = self.ask_net();
                return asked.unwrap_or_else(|| self.reply_rest());
            }
            Reply::Rest => return self.reply_rest(),
            _ => {
                let how = self.question_of(node).how;
                self.events.push(Event::Asked(node as u32, how, reply));
            }
        }
        if let Kind::Delay { .. } | Kind::Timeout { .. } | Kind::Sleep { .. } =
            self.tree.nodes[node].kind
        {
            let place = (self.date(node), node);
            if reply == Reply::Yes
                && let Err(fault) = self.fire(node)
            {
                return self.thrown(None, fault);
            }
            return self.run(Cursor::Timers(Some(place)), None);
        }
        let cursor = self.replied(node, reply);
        self.run(cursor, None)
    }

    /// Returns the point from which a tick goes on after a reply.
    fn replied(&mut self, node: usize, reply: Reply) -> Cursor {
        let yes = reply == Reply::Yes;
        match self.tree.nodes[node].kind {
            Kind::ManualSelector { .. } => Cursor::Step(node, choices::chosen(self, node, reply)),
            Kind::PauseResumeController => Cursor::Step(node, choices::served(self, node, yes)),
            _ => match reply {
                Reply::Leaf(answer) => Cursor::Leave(node, answer),
                _ => Cursor::Step(node, decorators::looked(self, node, yes)),
            },
        }
    }

    /// Goes on when the supervisor has done what it does.
    fn reply_rest(&mut self) -> Stop {
        if let Some(stop) = self.cancelled() {
            return stop;
        }
        let ticks = self.take_gone_off();
        self.run(if ticks { Cursor::Enter(0) } else { Cursor::Timers(None) }, None)
    }

    fn question_of(&self, node: usize) -> Question {
        if node == self.tree.nodes.len() {
            return self.question_of_net();
        }
        match self.tree.nodes[node].kind {
            Kind::Leaf(kind) => leaves::question(self, node, kind),
            Kind::ManualSelector { .. } => choices::question(self, node),
            _ => Question { node, how: How::Looks, replies: &[Reply::Yes, Reply::No] },
        }
    }

    /// Walks through a tick, up to a question or the answer of the root; within halting, up to that
    /// of the child that catches.
    fn run(&mut self, mut cursor: Cursor, within: Option<usize>) -> Stop {
        loop {
            cursor = match cursor {
                Cursor::Timers(after) => match self.timers(after) {
                    Ok(Some(node)) => return self.ask(node),
                    Ok(None) => {
                        self.beat();
                        if self.has_gone_off()
                            && let Some(asked) = self.ask_net()
                        {
                            return asked;
                        }
                        self.take_gone_off();
                        Cursor::Enter(0)
                    }
                    Err(fault) => return self.thrown(None, fault),
                },
                Cursor::Enter(node) => match self.guarded(node) {
                    Err(fault) => return self.thrown(self.tree.nodes[node].parent, fault),
                    Ok(Some(answer)) => Cursor::Leave(node, answer),
                    Ok(None) => Cursor::Step(node, enter(self, node)),
                },
                Cursor::Step(node, step) => match step {
                    Err(fault) => return self.thrown(Some(node), fault),
                    Ok(Move::Ask) => match self.asked(node, within.is_some()) {
                        Ok(cursor) => cursor,
                        Err(stop) => return stop,
                    },
                    Ok(Move::Child(at)) => Cursor::Enter(self.child(node, at)),
                    Ok(Move::Answer(answer)) => Cursor::Leave(node, answer),
                    Ok(Move::Idle) => return self.thrown(self.tree.nodes[node].parent, idle()),
                },
                Cursor::Leave(node, answer) => {
                    let parent = self.tree.nodes[node].parent;
                    if let Err(fault) = self.leave(node, answer) {
                        return self.thrown(parent, fault);
                    }
                    let Some(parent) = parent.filter(|_| within != Some(node)) else {
                        if within.is_none() {
                            if answer.is_done() {
                                self.put_status(0, Status::Idle);
                            }
                            self.rest();
                        }
                        return Stop::Answered(answer);
                    };
                    let step = answered(self, parent, self.tree.nodes[node].position, answer);
                    if let (Ok(Move::Answer(Answer::Failure)), Answer::Success) = (&step, answer)
                        && self.tree.nodes[parent].family == crate::signature::Family::Control
                    {
                        self.lost.push((node as u32, parent as u32));
                    }
                    Cursor::Step(parent, step)
                }
            }
        }
    }

    fn ask(&mut self, node: usize) -> Stop {
        self.at = Some(node);
        Stop::Asked(self.question_of(node))
    }

    /// Looks at the guards; returns an answer if the node is not to be ticked.
    fn guarded(&mut self, node: usize) -> Result<Option<Answer>, Fault> {
        let guards = &self.tree.nodes[node].guards;
        let status = self.status(node);
        if status == Status::Idle {
            let all = [
                (&guards.failure_if, Answer::Failure),
                (&guards.success_if, Answer::Success),
                (&guards.skip_if, Answer::Skipped),
            ];
            for (script, answer) in all {
                if let Some(script) = script
                    && self.holds(node, script)?
                {
                    return Ok(Some(answer));
                }
            }
        }
        let Some(script) = &guards.while_ else { return Ok(None) };
        if !matches!(status, Status::Idle | Status::Running) || self.holds(node, script)? {
            return Ok(None);
        }
        if status == Status::Running {
            self.halt(node)?;
        }
        Ok(Some(Answer::Skipped))
    }

    /// Takes a node's answer: scripts afterwards, status, what it kept within the tick.
    fn leave(&mut self, node: usize, answer: Answer) -> Result<(), Fault> {
        let it = &self.tree.nodes[node];
        let status = match answer {
            Answer::Success => Some(Status::Success),
            Answer::Failure => Some(Status::Failure),
            Answer::Running => Some(Status::Running),
            Answer::Skipped => None,
        };
        if answer.is_done() {
            let first = match answer {
                Answer::Success => &it.afterwards.on_success,
                _ => &it.afterwards.on_failure,
            };
            for script in [first, &it.afterwards.post].into_iter().flatten() {
                self.script(node, script)?;
            }
        }
        self.said[node] |= 1 << answer as u8;
        if let Some(cell) = self.watched[node] {
            self.cells[cell] = answer as u32 + 1;
        }
        if let Some(status) = status {
            self.put_status(node, status);
        }
        if it.family == crate::signature::Family::Decorator {
            let child = it.children[0];
            if matches!(self.status(child), Status::Success | Status::Failure) {
                self.put_status(child, Status::Idle);
            }
        }
        let (from, to) = self.layout.transient[node];
        self.cells[from..to].fill(0);
        Ok(())
    }
}

/// Begins the tick of a node.
fn enter(m: &mut Machine, node: usize) -> Result<Move, Fault> {
    let tree = m.tree;
    match &tree.nodes[node].kind {
        Kind::Leaf(kind) => Ok(leaves::enter(m, node, *kind)),
        kind => match controls::enter(m, node, kind) {
            Some(step) => step,
            None => match nav2::enter(m, node, kind) {
                Some(step) => step,
                None => match decorators::enter(m, node, kind) {
                    Some(step) => step,
                    None => leaves::built_in(m, node, kind),
                },
            },
        },
    }
}

/// Takes the answer of a child.
fn answered(m: &mut Machine, node: usize, at: usize, answer: Answer) -> Result<Move, Fault> {
    let tree = m.tree;
    let kind = &tree.nodes[node].kind;
    match controls::answered(m, node, kind, at, answer) {
        Some(step) => step,
        None => match nav2::answered(m, node, kind, at, answer) {
            Some(step) => step,
            None => decorators::answered(m, node, kind, answer),
        },
    }
}
