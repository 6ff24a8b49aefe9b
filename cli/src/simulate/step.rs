//! The words of the command line: what is offered, and when.

use crate::exit::Failure;
use crate::names::near;
use cotama_core::net::{EventId, Net};
use cotama_core::units::Millis;
use cotama_verification::conform::MAX_MS;
use std::collections::BTreeMap;

/// Time passes up to `at`, then these events are offered: at most one, but for a round.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Step {
    pub(super) at: Millis,
    pub(super) events: Vec<EventId>,
}

/// The events in the lines of a text; what begins with `#` is left out.
pub(super) fn lines(text: &str) -> Vec<String> {
    let lines =
        text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.map(str::to_owned).collect()
}

/// The words that a net understands.
#[derive(Debug)]
pub(super) struct Words<'n> {
    names: BTreeMap<&'n str, EventId>,
    list: Vec<&'n str>,
    what: &'static str,
    rounds: bool,
    loose: bool,
}

impl<'n> Words<'n> {
    /// The names of the events; `by_name` says that they are those of transitions.
    pub(super) fn new(net: &Net<'n>, by_name: bool, rounds: bool) -> Self {
        let list: Vec<_> = net.events.iter().map(|it| it.name).collect();
        // The first of several events of one name, which a file can have, is meant.
        let names =
            list.iter().enumerate().rev().map(|(id, &name)| (name, EventId(id as u32))).collect();
        Self {
            names,
            list,
            what: if by_name { "transition" } else { "event" },
            rounds,
            loose: false,
        }
    }

    /// The same, where the number of an event and the beginning of its name stand for it.
    pub(super) fn loose(self) -> Self {
        Self { loose: true, ..self }
    }

    /// All words of a script, from time zero.
    pub(super) fn script(&self, words: &[String]) -> Result<Vec<Step>, Failure> {
        let mut now = Millis(0);
        let mut steps = Vec::with_capacity(words.len());
        for word in words {
            let step = self.step(word, now)?;
            now = step.at;
            steps.push(step);
        }
        Ok(steps)
    }

    /// One word, at this time.
    pub(super) fn step(&self, word: &str, now: Millis) -> Result<Step, Failure> {
        // A name is a name, whatever is in it.
        if let Some(&event) = self.names.get(word) {
            return Ok(Step { at: now, events: vec![event] });
        }
        if let Some(wait) = word.strip_prefix('+') {
            let wait: u64 = wait.parse().map_err(|_| no_time(word, wait))?;
            let at = now.0.checked_add(wait).filter(|it| *it <= MAX_MS);
            let at = at.ok_or_else(|| no_time(word, "the time then"))?;
            return Ok(Step { at: Millis(at), events: vec![] });
        }
        match word.rsplit_once('@') {
            Some((events, at)) if at.bytes().all(|it| it.is_ascii_digit()) => {
                let time = at.parse().ok().filter(|it| *it <= MAX_MS).map(Millis);
                let time = time.ok_or_else(|| no_time(word, at))?;
                if time < now {
                    let message =
                        format!("{word}: it is {} ms already, and time does not go back", now.0);
                    return Err(
                        Failure::new(message).help("times count from the start, in milliseconds")
                    );
                }
                Ok(Step { at: time, events: self.events(events)? })
            }
            _ => Ok(Step { at: now, events: self.events(word)? }),
        }
    }

    fn events(&self, word: &str) -> Result<Vec<EventId>, Failure> {
        if self.rounds && !self.names.contains_key(word) {
            return word.split(',').map(|word| self.event(word.trim())).collect();
        }
        Ok(vec![self.event(word)?])
    }

    fn event(&self, word: &str) -> Result<EventId, Failure> {
        if let Some(&event) = self.names.get(word) {
            return Ok(event);
        }
        if self.loose {
            let numbered =
                word.parse::<usize>().ok().filter(|it| (1..=self.list.len()).contains(it));
            if let Some(number) = numbered {
                return Ok(EventId(number as u32 - 1));
            }
            let mut begun = self.names.range(word..).take_while(|(name, _)| name.starts_with(word));
            match (begun.next(), begun.next()) {
                (Some((_, &event)), None) if !word.is_empty() => return Ok(event),
                (Some((first, _)), Some((second, _))) if !word.is_empty() => {
                    let message = format!("`{word}` can be `{first}`, `{second}` or another");
                    return Err(Failure::new(message).help("write more of the name"));
                }
                _ => {}
            }
        }
        Err(self.unknown(word))
    }

    fn unknown(&self, word: &str) -> Failure {
        const SHOWN: usize = 30;
        let what = self.what;
        if self.list.is_empty() {
            return Failure::new(format!("there is no event `{word}`: the net has none"))
                .help("it moves by itself as time passes; `+1000` lets a second pass");
        }
        // In a system a name alone is not enough.
        let ending = format!(".{word}");
        let guess = self.list.iter().copied().find(|it| it.ends_with(&ending));
        let guess = guess
            .or_else(|| near(word, self.list.iter().copied()))
            .map_or_else(String::new, |near| format!("; did you mean `{near}`?"));
        let shown: Vec<_> = self.list.iter().take(SHOWN).copied().collect();
        let more = if self.list.len() > SHOWN { ", ..." } else { "" };
        let message = format!("there is no {what} `{word}`{guess}");
        let rounds = word.contains(',')
            && !self.rounds
            && word.split(',').all(|it| self.names.contains_key(it.trim()));
        Failure::new(message).help(if rounds {
            "several at once: --rounds".to_owned()
        } else {
            format!("{what}s: {}{more}", shown.join(", "))
        })
    }
}

fn no_time(word: &str, what: &str) -> Failure {
    Failure::new(format!("{word}: `{what}` is no time: whole milliseconds, at most {MAX_MS}")).help(
        "`+500` lets half a second pass; `EVENT@500` offers an event half a second after the \
            start",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use cotama_core::net::owned::OwnedNet;

    fn net(names: &[&str]) -> OwnedNet {
        let mut net = OwnedNet::new("n", "");
        for name in names {
            net.event(name, "").unwrap();
        }
        net
    }

    fn said(names: &[&str], rounds: bool, words: &[&str]) -> Result<Vec<(u64, Vec<u32>)>, Failure> {
        let net = net(names);
        let view = net.view();
        let words: Vec<_> = words.iter().map(|&it| it.to_owned()).collect();
        let steps = Words::new(&view.net(), false, rounds).script(&words)?;
        Ok(steps.iter().map(|it| (it.at.0, it.events.iter().map(|it| it.0).collect())).collect())
    }

    #[test]
    fn times_are_absolute_or_relative() {
        let steps = said(&["a", "b"], false, &["a", "b@5", "+7", "a"]).unwrap();
        assert_eq!(steps, [(0, vec![0]), (5, vec![1]), (12, vec![]), (12, vec![0])]);
    }

    #[test]
    fn time_does_not_go_back_and_does_not_overflow() {
        assert!(said(&["a"], false, &["+10", "a@9"]).is_err());
        assert!(said(&["a"], false, &["+18446744073709551615", "+1"]).is_err());
        // The last time is that of a recording.
        assert!(said(&["a"], false, &["+9007199254740990", "a@9007199254740991"]).is_ok());
        assert!(said(&["a"], false, &["+9007199254740992"]).is_err());
        assert!(said(&["a"], false, &["a@9007199254740992"]).is_err());
        assert!(said(&["a"], false, &["a@9007199254740991", "+1"]).is_err());
        assert!(said(&["a"], false, &["+-1"]).is_err());
        assert!(said(&["a"], false, &["a@99999999999999999999"]).is_err());
    }

    #[test]
    fn a_name_is_a_name_whatever_is_in_it() {
        let steps =
            said(&["+1", "a@2", "a,b", "a"], true, &["+1", "a@2", "a,b", "a,b@3", "a,+1"]).unwrap();
        assert_eq!(
            steps,
            [(0, vec![0]), (0, vec![1]), (0, vec![2]), (3, vec![2]), (3, vec![3, 0])]
        );
    }

    #[test]
    fn of_two_events_of_one_name_the_first_is_meant() {
        assert_eq!(said(&["b", "a", "a"], false, &["a"]).unwrap(), [(0, vec![1])]);
    }

    #[test]
    fn beginnings_and_numbers_stand_for_events_by_hand() {
        let net = net(&["open", "opened", "close"]);
        let view = net.view();
        let words = Words::new(&view.net(), false, false).loose();
        let event = |word: &str| words.step(word, Millis(0)).ok().map(|step| step.events[0].0);
        assert_eq!(["c", "2", "open", "opene"].map(event), [Some(2), Some(1), Some(0), Some(1)]);
        assert_eq!(["o", "0", "4", "x", ""].map(event), [None; 5]);
        let Err(Failure::Message { message, .. }) = words.step("o", Millis(0)) else { panic!() };
        assert_eq!(message, "`o` can be `open`, `opened` or another");
    }

    #[test]
    fn comments_and_empty_lines_are_left_out() {
        assert_eq!(lines("# a\n\n b \r\nc # d\n"), ["b", "c # d"]);
    }
}

/// Mutants of scripts, for tests and fuzz targets.
#[cfg(any(test, feature = "fuzz"))]
pub(crate) mod mutants {
    use super::{Words, lines};
    use cotama_core::net::owned::OwnedNet;
    use cotama_core::units::Millis;
    use cotama_fuzz::Reader;

    pub(crate) const READER: Reader = Reader {
        name: "steps",
        words: &[
            "Call\n",
            "Blo\n",
            "+",
            "@",
            ",",
            "+1\n",
            "a@2\n",
            "a,b\n",
            "#",
            "18446744073709551615",
        ],
        read,
    };

    /// A script, and each of its lines as if typed by hand.
    fn read(bytes: &[u8]) -> bool {
        let mut net = OwnedNet::new("n", "");
        for name in ["Call", "Blocked", "Blown", "a@2", "+1", "a,b"] {
            net.event(name, "").expect("few events");
        }
        let view = net.view();
        let net = view.net();
        let lines = lines(&String::from_utf8_lossy(bytes));
        let script = Words::new(&net, false, true).script(&lines);
        if let Ok(steps) = &script {
            assert!(steps.is_sorted_by_key(|it| it.at));
        }
        let by_hand = Words::new(&net, true, false).loose();
        for line in &lines {
            if let Ok(step) = by_hand.step(line, Millis(7)) {
                assert!(step.at >= Millis(7) && step.events.len() <= 1);
            }
        }
        script.is_ok()
    }

    #[test]
    fn reads_or_refuses_a_thousand_mutants() {
        READER.run(1_000);
    }

    #[test]
    #[ignore = "a minute in a release build, by hand"]
    fn reads_or_refuses_a_million_mutants() {
        READER.run_a_million();
    }
}
