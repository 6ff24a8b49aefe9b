//! Writing a team as a file.

use super::{
    FAULTS, FORMAT, Fault, FaultKind, FaultTime, Give, Needs, RoleSpec, Row, Scenario, Seat,
    Supply, Take, TaskSpec, Travel, Trust, USUAL,
};
use crate::team::{CapabilitySet, Reliability, Skill};
use crate::toml_text::quoted;
use cotama_core::team::Combine;
use std::fmt::Write;

/// The keys of a table; writing to a string cannot fail.
struct Lines<'s> {
    scenario: &'s Scenario,
    text: String,
}

impl Scenario {
    /// As the text of a `cotama-team/1` file, which reads as the same.
    pub fn to_toml(&self) -> String {
        let mut lines = Lines { scenario: self, text: String::new() };
        lines.write();
        lines.text
    }
}

impl Scenario {
    /// These faults as the text of a `cotama-team-faults/1` file, a line each, which
    /// [`faults`](Self::faults_of) reads again.
    pub fn faults_to_toml(&self, faults: &[Fault]) -> String {
        let mut text = format!("format = {}\n", quoted(FAULTS));
        if faults.is_empty() {
            return text;
        }
        text.push_str("fault = [\n");
        for it in faults {
            let mut lines = Lines { scenario: self, text: String::new() };
            lines.fault(it);
            let keys: Vec<&str> = lines.text.lines().collect();
            let _ = writeln!(text, "  {{ {} }},", keys.join(", "));
        }
        text + "]\n"
    }
}

impl Lines<'_> {
    fn line(&mut self, key: &str, value: impl std::fmt::Display) {
        let _ = writeln!(self.text, "{key} = {value}");
    }

    fn head(&mut self, head: &str) {
        let _ = writeln!(self.text, "\n{head}");
    }

    fn place(&self, place: super::Place) -> String {
        quoted(self.scenario.floor.name(place))
    }

    fn skill(&self, number: u8) -> &str {
        self.scenario.skills.get(usize::from(number)).map_or("?", |it| it)
    }

    fn write(&mut self) {
        let it = self.scenario;
        self.line("format", quoted(FORMAT));
        self.line("name", quoted(&it.name));
        let skills: Vec<_> = it.skills.iter().map(|it| quoted(it)).collect();
        self.line("skills", format!("[{}]", skills.join(", ")));
        self.head("[network]");
        self.line("delay_ms", it.network.delay_ms);
        self.line("jitter_ms", it.network.jitter_ms);
        self.line("loss_permille", it.network.loss_permille);
        self.line("copies_permille", it.network.copies_permille);
        self.head("[auction]");
        self.line("method", quoted(it.method.name()));
        self.line("formation", quoted(it.formation.name()));
        if let Some(robot) = it.auctioneer.robot() {
            self.line("auctioneer", quoted(&it.robots[robot].name));
        }
        if matches!(it.auctioneer, Seat::Queue(_)) {
            self.line("takeover", true);
        }
        self.line("slack_permille", it.slack_permille);
        self.line("second_best", it.second_best);
        if it.trust != Trust::default() {
            self.line("trust", quoted(it.trust.name()));
        }
        match it.travel {
            Travel::Plain => {}
            Travel::Mean => self.line("travel", quoted("mean")),
            Travel::Quantile(permille) => {
                self.line("travel", quoted("quantile"));
                self.line("travel_permille", permille);
            }
        }
        self.floor();
        for robot in &it.robots {
            self.head("[[robot]]");
            self.line("name", quoted(&robot.name));
            if robot.file.source() != USUAL {
                self.line("file", quoted(robot.file.source()));
            }
            self.line("at", self.place(robot.start));
            let skilled = |it: &Skill| self.skilled(it, robot.fails.of(it.capability));
            let skills: Vec<_> = robot.skills.iter().map(skilled).collect();
            self.line("skills", format!("[{}]", skills.join(", ")));
            if robot.stay.joins_ms > 0 {
                self.line("joins_ms", robot.stay.joins_ms);
            }
            if let Some(leaves) = robot.stay.leaves_ms {
                self.line("leaves_ms", leaves);
            }
            if let Some(supply) = &robot.supply {
                self.supply(supply);
            }
        }
        it.tasks.iter().for_each(|it| self.task(it));
        for it in &it.faults {
            self.head("[[fault]]");
            self.fault(it);
        }
    }

    fn floor(&mut self) {
        let floor = &self.scenario.floor;
        self.head("[floor]");
        let list = |all: &[String]| {
            let all: Vec<_> = all.iter().map(|it| quoted(it)).collect();
            format!("[{}]", all.join(", "))
        };
        if let Some(on) = floor.on() {
            self.line("on", quoted(&on.floor));
            for (key, doors) in [("open", &on.open), ("close", &on.close)] {
                if !doors.is_empty() {
                    self.line(key, list(doors));
                }
            }
        }
        let places: Vec<_> = (0..floor.places()).map(|it| self.place(super::Place(it))).collect();
        self.line("places", format!("[{}]", places.join(", ")));
        if floor.on().is_some_and(|it| !it.has_ways()) {
            return;
        }
        for (a, b, length) in floor.ways() {
            self.head("[[floor.way]]");
            self.line("between", format!("[{}, {}]", places[a], places[b]));
            if floor.on().is_none_or(|it| !it.measures(a, b)) {
                self.line("length_mm", length);
            }
            let crowds = &self.scenario.crowds;
            if let Some(crowd) = crowds.iter().find(|it| it.between == (a, b)) {
                self.line("delays_ms", format!("{:?}", crowd.delays_ms));
                if let Some(seen) = &crowd.seen_ms {
                    self.line("seen_ms", format!("{seen:?}"));
                }
            }
        }
    }

    fn supply(&mut self, supply: &Supply) {
        let Supply { charge_permille, reserve_permille, home, charger_w } = *supply;
        let home = self.place(home);
        let charge = format!("charge_permille = {charge_permille}");
        let reserve = format!("reserve_permille = {reserve_permille}");
        let rest = format!("home = {home}, charger_w = {charger_w}");
        self.line("battery", format!("{{ {charge}, {reserve}, {rest} }}"));
    }

    /// A skill with its reliability, where that is not certain; as a table where uses fail.
    fn skilled(&self, skill: &Skill, fails: u16) -> String {
        let name = self.skill(skill.capability.number());
        let table =
            |known: &str| format!("{{ name = {}{known}, fails_permille = {fails} }}", quoted(name));
        match skill.reliability {
            Reliability::CERTAIN if fails > 0 => table(""),
            Reliability::CERTAIN => quoted(name),
            Reliability::Permille(parts) if fails > 0 => table(&format!(", permille = {parts}")),
            Reliability::Permille(parts) => quoted(&format!("{name} {parts}/1000")),
            Reliability::Uses { succeeded, failed } if fails > 0 => {
                table(&format!(", succeeded = {succeeded}, failed = {failed}"))
            }
            Reliability::Uses { succeeded, failed } => {
                quoted(&format!("{name} {succeeded}+{failed}"))
            }
        }
    }

    fn any(&self, set: CapabilitySet) -> String {
        let names: Vec<_> = set.iter().map(|it| self.skill(it.number())).collect();
        quoted(&names.join(" | "))
    }

    fn needs(&self, needs: &Needs) -> String {
        let all: Vec<_> = needs.0.iter().map(|it| self.any(*it)).collect();
        format!("[{}]", all.join(", "))
    }

    fn task(&mut self, task: &TaskSpec) {
        self.head("[[task]]");
        self.line("name", quoted(&task.name));
        self.line("arrives_ms", task.arrival_ms);
        if let Some(before) = task.after {
            self.line("after", quoted(&self.scenario.tasks[before].name));
        }
        self.line("from", self.place(task.start));
        self.line("to", self.place(task.goal));
        self.line("skip_ms", task.utility_ms);
        let combine = match task.combine {
            Combine::Sum => "sum",
            Combine::Mean => "mean",
            Combine::Max => "max",
        };
        self.line("combine", quoted(combine));
        for plan in &task.plans {
            self.head("[[task.plan]]");
            self.line("name", quoted(&plan.name));
            self.line("extra_ms", plan.extra_ms);
            plan.roles.iter().for_each(|it| self.role(it));
        }
    }

    fn role(&mut self, role: &RoleSpec) {
        self.head("[[task.plan.role]]");
        self.line("name", quoted(&role.name));
        if let [only] = &role.actions[..] {
            self.line("needs", self.needs(only));
        } else {
            let actions: Vec<_> = role.actions.iter().map(|it| self.needs(it)).collect();
            self.line("actions", format!("[{}]", actions.join(", ")));
        }
        let take = match role.take {
            Take::Object => quoted("object"),
            Take::Partner(place) => format!("{{ partner_at = {} }}", self.place(place)),
            Take::Words(place) => format!("{{ words_at = {} }}", self.place(place)),
        };
        self.line("take", take);
        let give = match role.give {
            Give::Goal => quoted("goal"),
            Give::Nobody => quoted("nobody"),
            Give::Partner(place) => format!("{{ partner_at = {} }}", self.place(place)),
        };
        self.line("give", give);
        self.line("take_ms", role.take_ms);
        self.line("give_ms", role.give_ms);
    }

    fn mode(&mut self, robot: usize, mode: Row) {
        let name = self.scenario.robots.get(robot).map_or("?", |it| mode.name(it.file.robot()));
        self.line("mode", quoted(name));
    }

    fn fault(&mut self, fault: &Fault) {
        let it = self.scenario;
        match fault.when {
            FaultTime::At(at) => self.line("at_ms", at),
            FaultTime::During { robot, task, stage, time, after_ms } => {
                self.line("while", quoted(&it.robots[robot].name));
                self.line("stage", quoted(stage.name()));
                self.line("of", quoted(&it.tasks[task].name));
                self.line("time", time);
                self.line("after_ms", after_ms);
            }
        }
        match fault.what {
            FaultKind::Robot(robot, mode) => {
                self.line("robot", quoted(&it.robots[robot].name));
                self.mode(robot, mode);
            }
            FaultKind::Auctioneer(mode) => self.mode(0, mode),
            FaultKind::Shifted(task) => self.line("shifts", quoted(&it.tasks[task].name)),
            FaultKind::Turned(task, hides) => {
                self.line("turns", quoted(&it.tasks[task].name));
                let hides: Vec<_> =
                    hides.iter().map(|it| quoted(self.skill(it.number()))).collect();
                self.line("hides", format!("[{}]", hides.join(", ")));
            }
        }
    }
}
