//! Checks of a definition that need no meaning of its names.

use super::data::Signal;
use super::lookup::{Found, Meant};
use super::source::Source;
use super::text::{Text, same};
use super::variant::MOST;

impl Source<'_> {
    /// Refuses what a declaration alone shows to be wrong.
    #[track_caller]
    pub(super) const fn check(&self) {
        let text = Text::new().with("net ").name(self.name).with(": ");
        let mut at = 0;
        while at < self.own_places() {
            let it = self.declared(at);
            let flag = at >= self.places.len() && at < self.places.len() + self.flags.len();
            if flag && it.initial > 1 {
                text.with("the flag ")
                    .name(it.name)
                    .with(" starts with ")
                    .number(it.initial)
                    .with("; it is `true` or `false`, what counts further is a counter")
                    .stop();
            }
            if it.bound == 0 || it.bound > MOST {
                text.with("the bound ")
                    .number(it.bound)
                    .with(" of ")
                    .name(it.name)
                    .with(" is not from 1 to 65,535")
                    .stop();
            }
            if it.initial > it.bound {
                let text = text
                    .name(it.name)
                    .with(" starts with ")
                    .number(it.initial)
                    .with(", more than its bound ")
                    .number(it.bound);
                if it.initial > MOST {
                    text.with("; a bound is at most 65,535").stop();
                }
                text.with("; declare a larger bound, as `")
                    .with(it.name)
                    .with(": ")
                    .digits(it.initial)
                    .with(" of ")
                    .digits(it.initial)
                    .with("`")
                    .stop();
            }
            let mut other = 0;
            while other < at {
                if same(self.declared(other).name, it.name) {
                    text.with("two places, flags or counters are called ").name(it.name).stop();
                }
                other += 1;
            }
            at += 1;
        }
        unique_signals(text, "events", self.events);
        unique_signals(text, "outputs", self.outputs);
        let mut at = 0;
        while at < self.lines.len() {
            let line = &self.lines[at];
            let mut other = 0;
            while other < at {
                if same(self.lines[other].name, line.name) {
                    text.with("two transitions are called ").name(line.name).stop();
                }
                other += 1;
            }
            if let Some((earliest, latest)) = line.within {
                let late = match latest {
                    Some(latest) => latest,
                    None => earliest,
                };
                if earliest > late {
                    self.at_line(line)
                        .with("it may fire from ")
                        .number(earliest)
                        .with(" ms on and not after ")
                        .number(late)
                        .with(" ms, so never")
                        .stop();
                }
                if late >= u32::MAX as u64 {
                    self.at_line(line)
                        .with("its interval reaches to ")
                        .number(late)
                        .with(" ms, and at most 4,294,967,294 ms (49 days) can be counted")
                        .stop();
                }
            }
            if line.priority < i16::MIN as i64 || line.priority > i16::MAX as i64 {
                self.at_line(line)
                    .with("its priority ")
                    .with(if line.priority < 0 { "-" } else { "" })
                    .number(line.priority.unsigned_abs())
                    .with(" is not from -32,768 to 32,767")
                    .stop();
            }
            at += 1;
        }
        let mut at = 0;
        while at < self.groups.len() {
            let group = self.groups[at];
            if !matches!(self.find(group.name), Found::Group(found) if found == at) {
                text.with("the group ")
                    .name(group.name)
                    .with(" has the name of another group or place")
                    .stop();
            }
            let mut member = 0;
            while member < group.members.len() {
                let name = group.members[member];
                let text = text.with("in group ").name(group.name).with(": ");
                match self.find(name) {
                    Found::Place(_) => {}
                    Found::Data(..) => {
                        text.name(name).with(" is data, not a place; test it in guards").stop()
                    }
                    Found::Group(_) => {
                        text.name(name).with(" is a group itself; name its places").stop()
                    }
                    Found::Nothing => self.nothing(text, name, Meant::Place),
                }
                let mut other = 0;
                while other < member {
                    if same(group.members[other], group.members[member]) {
                        text.name(name).with(" is named twice").stop();
                    }
                    other += 1;
                }
                member += 1;
            }
            at += 1;
        }
    }
}

#[track_caller]
const fn unique_signals(text: Text, what: &str, signals: &[Signal<'_>]) {
    let mut at = 0;
    while at < signals.len() {
        let mut other = 0;
        while other < at {
            if same(signals[other].name, signals[at].name) {
                text.with("two ").with(what).with(" are called ").name(signals[at].name).stop();
            }
            other += 1;
        }
        at += 1;
    }
}
