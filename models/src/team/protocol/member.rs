//! The transitions of a robot: it bids, answers, waits for its partner, executes, leaves.

use super::auctioneer::suffix;
use super::draft::Draft;
use super::team::Defect;
use cotama_core::net::PlaceId;
use std::collections::BTreeSet;

/// A robot, a word before its number, what is read of it, and a word behind.
type Heard = (usize, &'static str, Vec<PlaceId>, &'static str);

impl Draft<'_> {
    pub(super) fn member(&mut self, task: usize, r: usize) {
        self.bids(task, r);
        if !self.bidders(task).contains(&r) {
            return;
        }
        self.answers(task, r);
        self.starts(task, r);
        self.leaves(task, r);
    }

    /// Returns the places in which a robot is busy with these tasks, each with a word for that.
    fn busy(&self, r: usize, tasks: impl Fn(usize) -> bool) -> Vec<(String, PlaceId)> {
        let robot = &self.robots[r];
        let named = |word: &str, places: &[PlaceId]| -> Vec<(String, PlaceId)> {
            let all = places.iter().enumerate().filter(|it| tasks(it.0));
            all.map(|it| (format!("{word}.t{}", it.0 + 1), *it.1)).collect()
        };
        [named("waiting", &robot.waiting), named("executing", &robot.executing)].concat()
    }

    fn bids(&mut self, task: usize, r: usize) {
        let it = &self.tasks[task];
        let (announced, answer, idle) = (it.announced, &it.answers[r], self.robots[r].idle);
        let (silent, bid, passed) = (answer.silent, answer.bid, answer.passed);
        let can = self.bidders(task).contains(&r);
        let number = (task + 1, r + 1);
        if can {
            let name = format!("t{}.bid.r{}", number.0, number.1);
            self.add(&name, &[silent], &[announced, idle], &[bid]);
        }
        if self.has(Defect::WaitsForAllBids) {
            let mut when = self.busy(r, |_| true);
            if !can {
                when.push(("incapable".to_owned(), idle));
            }
            for (word, place) in when {
                let name = format!("t{}.pass.r{}.{word}", number.0, number.1);
                self.add(&name, &[silent], &[announced, place], &[passed]);
            }
        }
    }

    /// Returns the messages in the air when the auctioneer has asked this robot: it asks in the
    /// order of numbers, the next one when the one before said yes.
    fn asked(&self, task: usize, r: usize) -> Vec<(String, Vec<PlaceId>)> {
        if self.has(Defect::AsksAllAtOnce) {
            return vec![(String::new(), vec![])];
        }
        let answers = &self.tasks[task].answers;
        let said = |p: usize| -> Vec<Heard> {
            let it = &answers[p];
            if p < r {
                vec![(p, ".after", vec![it.acked], ""), (p, ".though_left", vec![it.left], "")]
            } else {
                vec![(p, ".before", vec![it.named], "")]
            }
        };
        self.heard(task, r, said)
    }

    /// Returns what a robot hears of its partners, of all in each coalition: a name with words for
    /// each, and what is read.
    fn heard(
        &self,
        task: usize,
        r: usize,
        said: impl Fn(usize) -> Vec<Heard>,
    ) -> Vec<(String, Vec<PlaceId>)> {
        let ways = self.partners(task, r).into_iter().flat_map(|partners| {
            let whole = [&partners[..], &[r]].concat();
            let alone = self.others_silent(task, &whole);
            let begin = vec![(String::new(), alone)];
            partners.iter().fold(begin, |ways, &p| {
                let said = said(p);
                let longer = |way: &(String, Vec<PlaceId>), it: &Heard| {
                    let name = format!("{}{}{}{}", way.0, it.1, suffix(&[it.0]), it.3);
                    (name, [&way.1[..], &it.2].concat())
                };
                ways.iter().flat_map(|way| said.iter().map(|it| longer(way, it))).collect()
            })
        });
        ways.collect()
    }

    fn answers(&mut self, task: usize, r: usize) {
        let it = &self.tasks[task].answers[r];
        let (silent, named, acked, refused) = (it.silent, it.named, it.acked, it.refused);
        let old = it.old.clone();
        let (idle, waiting) = (self.robots[r].idle, self.robots[r].waiting[task]);
        let busy = self.busy(r, |other| other != task);
        let (t, number) = (task + 1, r + 1);
        for (after, read) in self.asked(task, r) {
            self.add(
                &format!("r{number}.ack.t{t}{after}"),
                &[named, idle],
                &read,
                &[acked, waiting],
            );
            for (word, place) in &busy {
                let read = [&read[..], &[*place]].concat();
                let name = format!("r{number}.nack.t{t}{after}.{word}");
                if self.has(Defect::AcksWhileBusy) {
                    self.add(&name, &[named], &read, &[acked, waiting]);
                } else {
                    self.add(&name, &[named], &read, &[refused]);
                }
            }
        }
        if self.has(Defect::FollowsOldAssign) {
            for (at, &place) in old.iter().skip(1).enumerate() {
                let name = format!("r{number}.ack_old.t{t}.{}", at + 1);
                self.add(&name, &[idle], &[silent, place], &[waiting]);
            }
        }
    }

    fn starts(&mut self, task: usize, r: usize) {
        let answers = &self.tasks[task].answers;
        let own = answers[r].acked;
        let (waiting, executing) = (self.robots[r].waiting[task], self.robots[r].executing[task]);
        let name = format!("r{}.start.t{}", r + 1, task + 1);
        if self.has(Defect::StartsAlone) {
            self.add(&name, &[waiting], &[own], &[executing]);
            return;
        }
        let heard = |p: usize| -> Vec<Heard> {
            let it = &self.tasks[task].answers[p];
            let mut heard =
                vec![(p, ".with", vec![it.acked], ""), (p, ".with", vec![it.left], ".late")];
            if let (true, Some(&old)) = (self.has(Defect::StartsOnOldAck), it.old.get(2)) {
                heard.push((p, ".with", vec![it.named, old], ".old"));
            }
            if self.has(Defect::SilenceIsConsent) {
                heard.push((p, ".with", vec![it.named, self.robots[p].down], ".silence"));
            }
            heard
        };
        for (word, read) in self.heard(task, r, heard) {
            let read = [&read[..], &[own]].concat();
            self.add(&format!("{name}{word}"), &[waiting], &read, &[executing]);
        }
    }

    /// A coalition's work ends for all its members at once.
    pub(super) fn finishes(&mut self, task: usize) {
        for coalition in self.coalitions(task) {
            let robots = coalition.iter().map(|&r| &self.robots[r]);
            let after = |r: usize| {
                let robot = &self.robots[r];
                let stays = self.has(Defect::StaysReserved);
                if stays { robot.waiting[task] } else { robot.idle }
            };
            let mut take: Vec<_> = robots.map(|it| it.executing[task]).collect();
            let mut give: Vec<_> = coalition.iter().map(|&r| after(r)).collect();
            let (unfinished, completed) = (self.tasks[task].unfinished, self.tasks[task].completed);
            let alone = self.others_silent(task, &coalition);
            let name = format!("t{}.finish{}", task + 1, suffix(&coalition));
            if !self.team.defects.is_empty() {
                let read = [&alone[..], &[completed]].concat();
                self.add(&format!("{name}.again"), &take, &read, &give);
            }
            take.push(unfinished);
            give.push(completed);
            self.add(&name, &take, &alone, &give);
        }
    }

    /// Released, or as a partner has left.
    fn leaves(&mut self, task: usize, r: usize) {
        let it = &self.tasks[task];
        let (withdrawn, completed, answer) = (it.withdrawn, it.completed, &it.answers[r]);
        let (named, acked, left, refused) =
            (answer.named, answer.acked, answer.left, answer.refused);
        let old = answer.old.clone();
        let robot = &self.robots[r];
        let (up, idle) = (robot.up, robot.idle);
        let (waiting, executing) = (robot.waiting[task], robot.executing[task]);
        let (t, number) = (task + 1, r + 1);
        let is_deaf = self.has(Defect::ExecutesOn);
        if !self.has(Defect::NoRelease) {
            let name = format!("r{number}.released.t{t}");
            self.add(&format!("{name}.asked"), &[named], &[up, withdrawn], &[refused]);
            self.add(&name, &[acked, waiting], &[withdrawn], &[left, idle]);
            if !is_deaf {
                self.add(
                    &format!("{name}.at_work"),
                    &[acked, executing],
                    &[withdrawn],
                    &[left, idle],
                );
            }
        }
        if self.has(Defect::CompletedIsLeft) {
            let name = format!("r{number}.released.t{t}.completed");
            self.add(&name, &[acked], &[withdrawn, completed, idle], &[left]);
        }
        if self.has(Defect::ObeysOldRelease) {
            for (at, old) in old.into_iter().skip(1).enumerate() {
                let name = format!("r{number}.released.t{t}.old_{}", at + 1);
                self.add(&name, &[acked, waiting], &[old], &[left, idle]);
            }
        }
        let partners: BTreeSet<_> = self.partners(task, r).into_iter().flatten().collect();
        for p in partners {
            let it = &self.tasks[task].answers[p];
            let (gone, never) = (it.left, it.refused);
            let name = format!("r{number}.stop.t{t}.r{}", p + 1);
            if !is_deaf {
                self.add(&format!("{name}.left"), &[acked, executing], &[gone], &[left, idle]);
            }
            // The text has no rule for a Nack, nor for who still waits.
            if !self.has(Defect::NoRelease) {
                let name = format!("{name}.waiting");
                self.add(&format!("{name}.left"), &[acked, waiting], &[gone], &[left, idle]);
                self.add(&format!("{name}.nack"), &[acked, waiting], &[never], &[left, idle]);
            }
        }
    }
}
