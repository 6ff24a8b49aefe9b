//! Parts of a robot: what works after a loss, and names.

use super::{Failure, Mode, Observer, Parts, Robot, SubObjective, Where, members};

impl Robot {
    /// Returns the modules that can be used when these parts are lost or faulty: none that is
    /// faulty itself, stands on lost hardware, or needs a module that cannot be used.
    pub fn available(&self, lost: Parts) -> u64 {
        let mut available =
            (0..self.modules.len()).fold(0, |all, it| all | 1 << it) & !lost.modules;
        loop {
            let works = |it: &usize| {
                self.modules.get(*it).is_some_and(|it| {
                    it.needs.hardware & lost.hardware == 0
                        && it.needs.modules & !available == 0
                        && (it.one_of == 0 || it.one_of & available != 0)
                })
            };
            let left = members(available).filter(works).fold(0, |all, it| all | 1 << it);
            if left == available {
                return available;
            }
            available = left;
        }
    }

    /// Returns the modules that may be used when these parts are lost: those that can be
    /// ([`available`](Self::available)), but for what nobody watches any more where an observer
    /// says that it counts as lost then. (Durand et al., TAROS 2010, Section III.B has a vector of
    /// what is available; that it closes over what is watched is ours.)
    ///
    /// ```
    /// use cotama_models::robots::{Parts, Robot, embedded};
    /// let text = embedded("transport").unwrap().text;
    /// let text = text.replace("[observer.timing]", "[observer.timing]\nunwatched = \"lost\"");
    /// let robot = Robot::parse("transport.toml", &text);
    /// assert!(robot.unwrap_err().to_string().contains("is never blind"), "it needs no module");
    /// ```
    pub fn usable(&self, lost: Parts) -> u64 {
        let available = self.available(lost);
        let unwatched = self.unwatched(available);
        if unwatched == Parts::NONE { available } else { self.available(lost.union(unwatched)) }
    }

    /// The parts that count as lost since nobody watches them with these modules.
    fn unwatched(&self, available: u64) -> Parts {
        let blind = |it: &Observer| it.closes && it.needs.modules & !available != 0;
        if !self.observers.iter().any(blind) {
            return Parts::NONE;
        }
        let flags: Vec<bool> = self
            .observers
            .iter()
            .flat_map(|it| std::iter::repeat_n(blind(it), it.flags.len()))
            .collect();
        let is_dark = |flag: &usize| flags.get(*flag).copied().unwrap_or(false);
        let dark = |it: &&Failure| !it.flags.is_empty() && it.flags.iter().all(is_dark);
        self.failures.iter().filter(dark).fold(Parts::NONE, |all, it| all.union(it.loses))
    }

    /// Returns the number of a failure by its short name.
    pub fn failure(&self, id: &str) -> Option<usize> {
        self.failures.iter().position(|it| it.id == id)
    }

    /// All flags, each with the number of its observer, observer after observer.
    pub fn flags(&self) -> impl Iterator<Item = (usize, &str)> {
        let all = self.observers.iter().enumerate();
        all.flat_map(|(at, it)| it.flags.iter().map(move |flag| (at, flag.as_str())))
    }

    /// Returns the names of parts, hardware first.
    pub fn names_of(&self, parts: Parts) -> Vec<&str> {
        let hardware = members(parts.hardware).filter_map(|it| self.hardware.get(it));
        let modules = members(parts.modules).filter_map(|it| self.modules.get(it));
        let hardware = hardware.map(|it| it.name.as_str());
        hardware.chain(modules.map(|it| it.name.as_str())).collect()
    }

    /// Returns the name of a place in a drive: that of the sub-objective, `Waits` or `Idle`.
    pub fn place_name(&self, at: Where) -> &str {
        match at {
            Where::Rests => "Idle",
            Where::Waits => "Waits",
            Where::Runs { sub_objective, .. } => {
                self.sub_objectives.get(sub_objective).map_or("", |it| it.name.as_str())
            }
        }
    }

    /// Returns the configurations that can run after these losses, a bit each.
    pub fn running(&self, lost: u32) -> u32 {
        self.losses.after(lost).running
    }

    /// Returns the best configuration of a sub-objective that can run after these losses; `None`
    /// when none can.
    pub fn best(&self, sub_objective: usize, lost: u32) -> Option<usize> {
        let running = self.running(lost);
        let mut all = self.sub_objectives.get(sub_objective)?.configurations.iter().copied();
        all.find(|it| running >> it & 1 == 1)
    }

    /// Returns what the adapter takes in place of a configuration after these losses: the best one
    /// after it, in the order of ranks, that can run; where there is none, the best other one,
    /// which has come back.
    pub fn next(&self, of: usize, lost: u32) -> Option<usize> {
        let (running, it) = (self.running(lost), self.configurations.get(of)?);
        let all = self.sub_objectives.get(it.sub_objective)?;
        let all = || all.configurations.iter().copied();
        let runs = |it: &usize| running >> it & 1 == 1;
        let worse = all().skip_while(|it| *it != of).skip(1).find(runs);
        worse.or_else(|| all().take_while(|it| *it != of).find(runs))
    }

    /// Whether the operator can be reached after these losses.
    pub fn reaches_operator(&self, lost: u32) -> bool {
        self.losses.after(lost).reaches_operator
    }

    /// Whether the operator can be asked after these losses, and can do something then: he is
    /// reached, and a configuration in which he decides can run.
    pub fn can_ask(&self, lost: u32) -> bool {
        let helps = |(at, it): (usize, &SubObjective)| {
            it.mode == Mode::Operator && self.best(at, lost).is_some()
        };
        self.reaches_operator(lost) && self.sub_objectives.iter().enumerate().any(helps)
    }

    /// The sub-objectives of a mode that can be served after these losses, by number.
    pub fn served(&self, mode: Mode, lost: u32) -> impl Iterator<Item = usize> {
        let all = self.sub_objectives.iter().enumerate();
        let all = all.filter(move |it| it.1.mode == mode && self.best(it.0, lost).is_some());
        all.map(|it| it.0)
    }

    /// Returns the losses that these lost parts come to, a bit each.
    pub fn lost(&self, parts: Parts) -> u32 {
        let gone = !self.available(parts);
        let all = self.losses.losses.iter().enumerate();
        let all = all.filter(|it| members(it.1.modules).all(|module| gone >> module & 1 == 1));
        all.fold(0, |set, it| set | 1 << it.0)
    }
}
