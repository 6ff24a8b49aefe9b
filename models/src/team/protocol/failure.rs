//! Failures, and the robots that take over.

use super::auctioneer::{numbered, suffix};
use super::coalition::subsets;
use super::draft::Draft;
use super::team::Defect;

impl Draft<'_> {
    /// A robot breaks down, its auctioneers with it; or it gives its role up.
    pub(super) fn fails(&mut self, r: usize) {
        let tasks: Vec<_> = (0..self.tasks.len()).collect();
        let robot = &self.robots[r];
        let (up, down, idle) = (robot.up, robot.down, robot.idle);
        let mut at = vec![("idle".to_owned(), idle)];
        for &t in tasks.iter().filter(|&&t| self.bidders(t).contains(&r)) {
            at.push((format!("waiting.t{}", t + 1), robot.waiting[t]));
            at.push((format!("executing.t{}", t + 1), robot.executing[t]));
        }
        for (word, place) in at {
            for led in subsets(&tasks, |_| true) {
                let mut take = vec![self.failures, up, place];
                let (mut give, mut read) = (vec![down, self.failed], vec![]);
                for (t, it) in self.tasks.iter().enumerate() {
                    if led.contains(&t) {
                        take.extend([it.leader[r], it.led]);
                        give.extend([it.follower[r], it.vacant]);
                    } else {
                        read.push(it.follower[r]);
                    }
                }
                let leads = numbered(".leads.t", &led);
                let name = format!("r{}.crash.{word}{leads}", r + 1);
                self.add(&name, &take, &read, &give);
            }
        }
        for t in tasks {
            if !self.bidders(t).contains(&r) {
                continue;
            }
            let answer = &self.tasks[t].answers[r];
            let (acked, left) = (answer.acked, answer.left);
            let executing = self.robots[r].executing[t];
            let (failures, failed) = (self.failures, self.failed);
            let name = format!("r{}.give_up.t{}", r + 1, t + 1);
            if self.has(Defect::FailureUnsaid) {
                self.add(&name, &[failures, executing], &[], &[failed, idle]);
            } else {
                self.add(&name, &[failures, executing, acked], &[], &[failed, left, idle]);
            }
        }
    }

    /// The first robot that is alive takes a task over when its auctioneer is silent.
    pub(super) fn takes_over(&mut self, task: usize) {
        let it = &self.tasks[task];
        let (led, vacant) = (it.led, it.vacant);
        let phases = [
            ("open", it.open),
            ("announced", it.announced),
            ("awarded", it.awarded),
            ("executing", it.executing),
            ("withdrawn", it.withdrawn),
            ("done", it.done),
            ("reported", it.reported),
        ];
        let (open, lost) = (it.open, it.lost);
        let places: Vec<_> = it.leader.iter().copied().zip(it.follower.iter().copied()).collect();
        for (s, &(leader, follower)) in places.iter().enumerate() {
            let mut read: Vec<_> = self.robots[..s].iter().map(|it| it.down).collect();
            read.push(self.robots[s].up);
            let name = format!("r{}.take_over.t{}", s + 1, task + 1);
            if self.has(Defect::TakesOverEarly) {
                for (q, _) in places.iter().enumerate().filter(|it| it.0 != s) {
                    let read = [self.robots[s].up, places[q].0];
                    self.add(&format!("{name}{}", suffix(&[q])), &[follower], &read, &[leader]);
                }
            }
            if self.has(Defect::NobodyTakesOver) {
                continue;
            }
            let copied = !self.has(Defect::TasksNotCopied) && !self.has(Defect::TasksForgotten);
            if copied {
                self.add(&name, &[vacant, follower], &read, &[led, leader]);
            }
            let unknown = [
                (Defect::TasksNotCopied, open, "as_open"),
                (Defect::TasksForgotten, lost, "unknown"),
            ];
            for (defect, to, word) in unknown {
                if !self.has(defect) {
                    continue;
                }
                for (phase_word, phase) in phases {
                    let name = format!("{name}.{phase_word}.{word}");
                    if phase == to {
                        let read = [&read[..], &[phase]].concat();
                        self.add(&name, &[vacant, follower], &read, &[led, leader]);
                    } else {
                        let take = [vacant, follower, phase];
                        self.add(&name, &take, &read, &[led, leader, to]);
                    }
                }
            }
        }
    }

    /// From some time on no deadline is early; failures need not happen.
    pub(super) fn settles(&mut self) {
        let (untimely, failures) = (self.untimely, self.failures);
        self.add("network.settles", &[untimely], &[], &[]);
        if self.team.failures > 0 {
            self.add("failure.spared", &[failures], &[], &[]);
        }
    }
}
