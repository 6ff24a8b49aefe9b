//! The transitions of the auctioneer of a task.

use super::coalition::{blockers, subsets};
use super::draft::Draft;
use super::team::Defect;
use cotama_core::net::PlaceId;

/// `.r1.r2`, as names of transitions end.
pub(super) fn suffix(robots: &[usize]) -> String {
    numbered(".r", robots)
}

/// `.r1.r2`, or with another word.
pub(super) fn numbered(word: &str, numbers: &[usize]) -> String {
    let all: Vec<_> = numbers.iter().map(|at| format!("{word}{}", at + 1)).collect();
    all.concat()
}

/// A robot, what is read of it, and a word for that.
type Said = (usize, Vec<PlaceId>, &'static str);

/// All ways to take one from each list: what is read, and a name with a word for each.
fn choices(lists: &[Vec<Said>]) -> Vec<(Vec<PlaceId>, String)> {
    lists.iter().fold(vec![(vec![], String::new())], |ways, list| {
        let longer = |way: &(Vec<PlaceId>, String), said: &Said| {
            let name = format!("{}{}{}", way.1, suffix(&[said.0]), said.2);
            ([&way.0[..], &said.1].concat(), name)
        };
        ways.iter().flat_map(|way| list.iter().map(move |it| longer(way, it))).collect()
    })
}

impl Draft<'_> {
    pub(super) fn auctioneer(&mut self, task: usize) {
        self.announces(task);
        self.awards(task);
        self.counts_acks(task);
        self.withdraws(task);
        self.reopens(task);
        self.ends(task);
        self.counts_up(task);
    }

    fn announces(&mut self, task: usize) {
        let it = &self.tasks[task];
        let (open, announced, led) = (it.open, it.announced, it.led);
        let silent: Vec<_> = it.answers.iter().map(|it| it.silent).collect();
        let passed: Vec<_> = it.answers.iter().map(|it| it.passed).collect();
        let name = format!("t{}.announce", task + 1);
        if !self.has(Defect::WaitsForAllBids) {
            self.add(&name, &[open], &[&silent[..], &[led]].concat(), &[announced]);
            return;
        }
        // The auctioneer waits only for robots of which it heard an Alive.
        let all: Vec<_> = (0..self.team.robots).collect();
        for dead in subsets(&all, |size| size <= self.team.failures as usize) {
            let is_dead = |r: &usize| dead.contains(r);
            let pick = |r: usize| if is_dead(&r) { self.robots[r].down } else { self.robots[r].up };
            let mut read: Vec<_> = all.iter().map(|&r| pick(r)).collect();
            read.extend(all.iter().filter(|r| !is_dead(r)).map(|&r| silent[r]));
            read.push(led);
            let (mut take, mut give) = (vec![open], vec![announced]);
            take.extend(dead.iter().map(|&r| silent[r]));
            give.extend(dead.iter().map(|&r| passed[r]));
            let name = if dead.is_empty() {
                name.clone()
            } else {
                format!("{name}.without{}", suffix(&dead))
            };
            self.add(&name, &take, &read, &give);
        }
    }

    /// Any coalition of bidders may be the best one. The others' bids are used up.
    fn awards(&mut self, task: usize) {
        let waits = self.has(Defect::WaitsForAllBids);
        let it = &self.tasks[task];
        let (announced, awarded, open, led) = (it.announced, it.awarded, it.open, it.led);
        let answers: Vec<_> = it.answers.iter().map(|it| (it.silent, it.bid, it.passed)).collect();
        let named: Vec<_> = it.answers.iter().map(|it| it.named).collect();
        let old: Vec<_> = it.answers.iter().filter_map(|it| it.old.get(1).copied()).collect();
        let all: Vec<_> = (0..self.team.robots).collect();
        let bidders = self.bidders(task);
        let others = |bids: &[usize], but: &[usize]| -> Vec<usize> {
            all.iter().filter(|r| !bids.contains(r) && !but.contains(r)).copied().collect()
        };
        for coalition in self.coalitions(task) {
            let rest: Vec<_> = bidders.iter().filter(|r| !coalition.contains(r)).copied().collect();
            for outbid in subsets(&rest, |_| true) {
                let mut take = vec![announced];
                take.extend(coalition.iter().chain(&outbid).map(|&r| answers[r].1));
                let mut give = vec![awarded];
                give.extend(coalition.iter().map(|&r| named[r]));
                give.extend(outbid.iter().map(|&r| answers[r].0));
                let mut read = vec![led];
                for r in others(&coalition, &outbid) {
                    if waits {
                        take.push(answers[r].2);
                        give.push(answers[r].0);
                    } else {
                        read.push(answers[r].0);
                    }
                }
                let not = if outbid.is_empty() { "" } else { ".not" };
                let names = (suffix(&coalition), suffix(&outbid));
                let name = format!("t{}.award{}{not}{}", task + 1, names.0, names.1);
                self.add(&name, &take, &read, &give);
                if self.has(Defect::NamesOldBidders)
                    && let Some(&first) = coalition.first()
                    && old.len() > first
                {
                    take.retain(|place| *place != answers[first].1);
                    take.push(answers[first].0);
                    read.push(old[first]);
                    self.add(&format!("{name}.old"), &take, &read, &give);
                }
            }
        }
        if waits {
            let coalitions = self.coalitions(task);
            for bids in subsets(&bidders, |_| true) {
                if coalitions.iter().any(|it| it.iter().all(|r| bids.contains(r))) {
                    continue;
                }
                let mut take = vec![announced];
                take.extend(bids.iter().map(|&r| answers[r].1));
                take.extend(others(&bids, &[]).iter().map(|&r| answers[r].2));
                let mut give = vec![open];
                give.extend(all.iter().map(|&r| answers[r].0));
                let name = format!("t{}.too_few_bids{}", task + 1, suffix(&bids));
                self.add(&name, &take, &[led], &give);
            }
        }
    }

    fn counts_acks(&mut self, task: usize) {
        let it = &self.tasks[task];
        let (awarded, executing, led) = (it.awarded, it.executing, it.led);
        for coalition in self.coalitions(task) {
            let said_yes = |r: usize| {
                let it = &self.tasks[task].answers[r];
                let mut ways = vec![(r, vec![it.acked], "")];
                if let (true, Some(&old)) = (self.has(Defect::CountsOldAcks), it.old.get(2)) {
                    ways.push((r, vec![it.named, old], "_by_old_ack"));
                }
                if self.has(Defect::SilenceIsConsent) {
                    ways.push((r, vec![it.named, self.robots[r].down], "_by_silence"));
                }
                ways
            };
            let ways = choices(&coalition.iter().map(|&r| said_yes(r)).collect::<Vec<_>>());
            let alone = self.others_silent(task, &coalition);
            for (way, who) in ways {
                let name = format!("t{}.all_acked{who}", task + 1);
                let read = [&way[..], &alone, &[led]].concat();
                self.add(&name, &[awarded], &read, &[executing]);
            }
        }
    }

    /// Because of a "no", a silence, or an early deadline.
    fn withdraws(&mut self, task: usize) {
        let it = &self.tasks[task];
        let (awarded, executing, led) = (it.awarded, it.executing, it.led);
        let to = if self.has(Defect::ReopensAtOnce) { it.open } else { it.withdrawn };
        let to = if self.has(Defect::ReportsAwarded) { it.reported } else { to };
        let t = task + 1;
        let no_acks = self.has(Defect::NoDeadlineForAcks);
        let no_work = self.has(Defect::NoDeadlineForWork);
        if !no_acks {
            let untimely = self.untimely;
            self.add(&format!("t{t}.deadline"), &[awarded], &[led, untimely], &[to]);
        }
        for r in self.bidders(task) {
            let it = &self.tasks[task].answers[r];
            let (named, acked, left, refused) = (it.named, it.acked, it.left, it.refused);
            let down = self.robots[r].down;
            for (phase, word, deaf) in [(awarded, "award", no_acks), (executing, "work", no_work)] {
                let reasons: &[(&str, &[PlaceId])] = &[("left", &[left]), ("refused", &[refused])];
                let silences: &[(&str, &[PlaceId])] =
                    &[("silent_named", &[named, down]), ("silent", &[acked, down])];
                let silences = if deaf { &[] } else { silences };
                for (why, read) in reasons.iter().chain(silences) {
                    let name = format!("t{t}.withdraw_{word}.{why}.r{}", r + 1);
                    self.add(&name, &[phase], &[*read, &[led]].concat(), &[to]);
                }
            }
        }
    }

    /// When all members have said that they left, or are dead.
    fn reopens(&mut self, task: usize) {
        for coalition in self.coalitions(task) {
            let out = |r: usize| {
                let (it, down) = (&self.tasks[task].answers[r], self.robots[r].down);
                vec![
                    (r, vec![it.left], "_left"),
                    (r, vec![it.refused], "_refused"),
                    (r, vec![it.named, down], "_died_unasked"),
                    (r, vec![it.acked, down], "_died"),
                ]
            };
            let lists: Vec<_> = coalition.iter().map(|&r| out(r)).collect();
            let it = &self.tasks[task];
            let (withdrawn, open, led) = (it.withdrawn, it.open, it.led);
            let (unfinished, completed) = (it.unfinished, it.completed);
            let all_died: Vec<_> = coalition
                .iter()
                .flat_map(|&r| [self.tasks[task].answers[r].acked, self.robots[r].down])
                .collect();
            let alone = self.others_silent(task, &coalition);
            for (way, who) in choices(&lists) {
                let name = format!("t{}.reopen{who}", task + 1);
                let read = [&way[..], &alone, &[led]].concat();
                if way == all_died {
                    // If they completed it before, the news died with them.
                    let died = format!("{name}.news_died");
                    self.add(&died, &[withdrawn, completed], &read, &[open, unfinished]);
                    self.add(&name, &[withdrawn], &[&read[..], &[unfinished]].concat(), &[open]);
                } else {
                    self.add(&name, &[withdrawn], &read, &[open]);
                }
            }
        }
    }

    /// Done, or reported as too few are left who could.
    fn ends(&mut self, task: usize) {
        let t = task + 1;
        let it = &self.tasks[task];
        let (done, led, completed, open) = (it.done, it.led, it.completed, it.open);
        let (announced, reported) = (it.announced, it.reported);
        let phases = [(it.awarded, "award"), (it.executing, "work"), (it.withdrawn, "release")];
        let old = it.answers.iter().flat_map(|it| it.old.iter().skip(1).copied());
        let old: Vec<_> = old.collect();
        for (phase, word) in phases {
            self.add(&format!("t{t}.done.{word}"), &[phase], &[completed, led], &[done]);
        }
        if self.has(Defect::OpensDone) {
            for (at, place) in old.into_iter().enumerate() {
                self.add(&format!("t{t}.late_no.{}", at + 1), &[done], &[place, led], &[open]);
            }
        }
        if self.has(Defect::NeverReports) {
            return;
        }
        let job = &self.team.tasks[task];
        for dead in blockers(&job.capable(), &job.coalitions()) {
            let mut read: Vec<_> = dead.iter().map(|&r| self.robots[r].down).collect();
            read.push(led);
            let name = format!("t{t}.report.without{}", suffix(&dead));
            self.add(&name, &[announced], &read, &[reported]);
        }
    }

    /// The number of the round goes up: what is in the air is old now. One robot after the other,
    /// to have fewer orders.
    fn counts_up(&mut self, task: usize) {
        let open = self.tasks[task].open;
        for r in 0..self.team.robots {
            let it = &self.tasks[task].answers[r];
            let (silent, old) = (it.silent, it.old.clone());
            let can = self.bidders(task).contains(&r);
            let from = [
                ("named", it.named, 1),
                ("refused", it.refused, 1),
                ("acked", it.acked, 2),
                ("left", it.left, 2),
                ("bid", it.bid, 0),
                ("passed", it.passed, 0),
            ];
            let mut read: Vec<_> =
                self.tasks[task].answers[..r].iter().map(|it| it.silent).collect();
            read.push(open);
            for (word, place, level) in from {
                let name = format!("t{}.round_over.r{}.{word}", task + 1, r + 1);
                if !can && word != "passed" {
                    continue;
                }
                if old.is_empty() {
                    self.add(&name, &[place], &read, &[silent]);
                }
                for (before, &had) in old.iter().enumerate() {
                    let after = old[before.max(level)];
                    let name = format!("{name}.{before}");
                    if after == had {
                        let read = [&read[..], &[had]].concat();
                        self.add(&name, &[place], &read, &[silent]);
                    } else {
                        self.add(&name, &[place, had], &read, &[silent, after]);
                    }
                }
            }
        }
    }
}
