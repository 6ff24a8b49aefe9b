//! Robots as they are drawn, and another reading of what makes no sense in them.

use std::collections::BTreeSet;
use std::fmt::Write;

/// A robot as it is drawn: modules with what they need, configurations, failures.
pub struct Drawn {
    hardware: usize,
    /// For each module, its hardware and the modules that it needs.
    modules: Vec<(Vec<usize>, Vec<usize>)>,
    /// Sub-objective, and modules.
    configurations: Vec<(usize, Vec<usize>)>,
    operator: Option<usize>,
    failures: Vec<Failure>,
}

struct Failure {
    hardware: Vec<usize>,
    modules: Vec<usize>,
    severity: [usize; 2],
    restarts: bool,
    asks: bool,
    /// Position in [`MASKS`]; none beyond.
    masks: usize,
    latency_ms: usize,
    /// Of [`MOTIONS`]; none beyond.
    motion: usize,
    /// Position in [`ENDS`]; none beyond.
    ends: usize,
    /// Position in [`SETTINGS`]; none beyond.
    sets: usize,
}

const SUB_OBJECTIVES: [(&str, &str); 4] =
    [("Plan", "autonomous"), ("Drive", "autonomous"), ("Hand", "operator"), ("Route", "operator")];
const RUNS_AWAY: usize = 3;
const MOTIONS: [&str; 6] = [
    "motion = \"blocked\"\nhelped = true",
    "slowed_permille = 500",
    "motion = \"dead\"",
    "motion = \"runaway\"",
    "motion = \"silent\"",
    "motion = \"mindless\"",
];
const ENDS: [&str; 3] = [
    "persistence = \"transient\"\nends_ms = 4000",
    "persistence = \"intermittent\"",
    "helped = true",
];
const SETTINGS: [&str; 3] = [
    "set = { speed_permille = 400 }",
    "set = { speed_permille = 400, times = 1 }",
    "set = { speed_permille = 400, times = 2, mends = true, holds_ms = 0 }",
];
const MASKS: [&str; 3] = ["", ", lasts_ms = 2000", ", on = \"order\", lasts_ms = 5000"];
const ON_ORDER: usize = 2;
const SEVERITIES: [&str; 4] = ["weak", "medium", "hard", "fatal"];

impl Drawn {
    /// Draws one of 3 to 7 modules and 5 to 9 failures by whole numbers below what is asked.
    #[must_use]
    pub fn new(below: &mut impl FnMut(u32) -> usize) -> Self {
        let modules = 3 + below(5);
        Self::of(below, [modules, modules + 2], 4)
    }

    /// Draws one of 3 to 12 modules and 3 to 20 failures.
    #[must_use]
    #[allow(dead_code)] // stories draw it, which share this file
    pub fn large(below: &mut impl FnMut(u32) -> usize) -> Self {
        let modules = 3 + below(10);
        let failures = if below(4) > 0 { modules + below(9) } else { 3 + below(18) };
        Self::of(below, [modules, failures], 2 * modules as u32)
    }

    /// Draws one of so many modules and failures; one module of `standing` stands on nothing.
    fn of(below: &mut impl FnMut(u32) -> usize, size: [usize; 2], standing: u32) -> Self {
        let [many, rows] = size;
        let hardware = 1 + below(4);
        let mut modules: Vec<(Vec<usize>, Vec<usize>)> = Vec::new();
        for at in 0..many {
            let own = if below(standing) > 0 { vec![below(hardware as u32)] } else { vec![] };
            let needs = if at > 0 && below(2) == 0 { vec![below(at as u32)] } else { vec![] };
            modules.push((own, needs));
        }
        let many = modules.len() as u32;
        let operator = (below(3) > 0).then(|| below(many));
        let mut configurations = Vec::new();
        for sub_objective in 0..if operator.is_some() { 2 + below(3) } else { 1 + below(2) } {
            // Mostly, each does without a module of the one before it.
            let mut all: Vec<usize> = (0..many as usize).filter(|_| below(3) == 0).collect();
            all.push(below(many));
            all.sort_unstable();
            all.dedup();
            for _ in 0..=below(3) {
                configurations.push((sub_objective, all.clone()));
                // What others need is needed still: the last module is needed by none.
                if all.len() < 2 || all.pop().is_none() {
                    break;
                }
            }
        }
        let mut failures = Vec::new();
        for at in 0..rows {
            // Mostly each module fails by itself, and mildly.
            let mut severity = || [0, 1, 1, 2, 3][if below(4) > 0 { below(3) } else { below(5) }];
            let severity = [severity(), severity()];
            let severity = if operator.is_none() { [severity[0].min(1), 1] } else { severity };
            let one = at < modules.len() && below(3) > 0;
            let motion = below(20);
            // A motor that runs away is fatal, or the file is refused.
            let severity = if motion == RUNS_AWAY { [3, 3] } else { severity };
            let ends = if motion == 0 { ENDS.len() } else { below(6) };
            let sets = if severity == [3, 3] { SETTINGS.len() } else { below(12) };
            let asks = operator.is_some() && severity != [2, 2] && below(8) == 0;
            let masks = below(12);
            let has_none = severity == [3, 3] && !(asks && masks == ON_ORDER)
                || masks == ON_ORDER && !(asks || operator.is_some() && severity.contains(&2))
                || failures.iter().filter(|it: &&Failure| it.masks < MASKS.len()).count() == 8;
            let masks = if has_none { MASKS.len() } else { masks };
            failures.push(Failure {
                hardware: if one || below(3) > 0 { vec![] } else { vec![below(hardware as u32)] },
                modules: if one { vec![at] } else { vec![] },
                severity,
                restarts: below(6) == 0,
                asks,
                masks,
                latency_ms: 100 + 100 * below(30),
                motion,
                ends,
                sets,
            });
        }
        Self { hardware, modules, configurations, operator, failures }
    }

    /// Returns the text of its file.
    #[must_use]
    pub fn text(&self) -> String {
        let list = |prefix: &str, all: &[usize]| {
            all.iter().map(|it| format!("\"{prefix}{it}\"")).collect::<Vec<_>>().join(", ")
        };
        let mut text = "format = \"cotama-robot/1\"\nname = \"drawn\"\n\
            [body]\nspeed_max_mm_s = 100\nacceleration_mm_s2 = 100\n\
            motion_power = { c0 = 1000, c1 = 1000, c2 = 0 }\n"
            .to_owned();
        for it in 0..self.hardware {
            let _ = writeln!(text, "[hardware.h{it}]");
        }
        for (at, (hardware, needs)) in self.modules.iter().enumerate() {
            let (hardware, needs) = (list("h", hardware), list("m", needs));
            let _ = writeln!(text, "[module.m{at}]\nhardware = [{hardware}]\nneeds = [{needs}]");
        }
        let flags: Vec<_> = (0..self.failures.len()).collect();
        let _ = writeln!(text, "[observer.eye]\nflags = [{}]", list("f", &flags));
        if let Some(it) = self.operator {
            let _ = writeln!(text, "[operator]\nneeds = [\"m{it}\"]");
        }
        for (at, (sub_objective, required)) in self.configurations.iter().enumerate() {
            let (name, mode) = SUB_OBJECTIVES[*sub_objective];
            let speed = if *sub_objective % 3 == 0 { 0 } else { 100 };
            let _ = writeln!(
                text,
                "[[configuration]]\nname = \"C{at}\"\nsub_objective = \"{name}\"\n\
                 mode = \"{mode}\"\nrequired = [{}]\nspeed_mm_s = {speed}",
                list("m", required)
            );
        }
        for (at, it) in self.failures.iter().enumerate() {
            let [own, operator] = it.severity.map(|it| SEVERITIES[it]);
            let loses = [list("h", &it.hardware), list("m", &it.modules)];
            let loses: Vec<_> = loses.into_iter().filter(|it| !it.is_empty()).collect();
            let _ = writeln!(
                text,
                "[[failure]]\nid = \"X{at}\"\nmode = \"drawn\"\nflags = [\"f{at}\"]\n\
                 severity = {{ autonomous = \"{own}\", operator = \"{operator}\" }}\n\
                 loses = [{}]",
                loses.join(", ")
            );
            let _ = writeln!(text, "latency_ms = {}", it.latency_ms);
            if let Some(it) = MOTIONS.get(it.motion) {
                let _ = writeln!(text, "{it}");
            }
            for it in [ENDS.get(it.ends), SETTINGS.get(it.sets)].into_iter().flatten() {
                let _ = writeln!(text, "{it}");
            }
            if it.asks {
                let _ = writeln!(text, "ask = {{ times = 1 }}");
            }
            if let Some(it) = MASKS.get(it.masks) {
                let _ = writeln!(text, "mask = {{ flags = [\"f{at}\"]{it} }}");
            }
            if it.restarts {
                let module = self.restarted(at);
                let _ = writeln!(text, "restart = {{ module = \"m{module}\", times = 1 }}");
            }
        }
        text
    }

    /// The module that a failure starts anew: mostly its own.
    fn restarted(&self, failure: usize) -> usize {
        if failure < self.modules.len() { failure } else { 0 }
    }

    /// Whether a module works after these failures, looked up from the top down.
    fn works(&self, module: usize, failed: &[usize]) -> bool {
        let (hardware, needs) = &self.modules[module];
        failed.iter().all(|it| {
            let it = &self.failures[*it];
            !it.modules.contains(&module) && !hardware.iter().any(|own| it.hardware.contains(own))
        }) && needs.iter().all(|it| self.works(*it, failed))
    }

    fn runs(&self, configuration: usize, failed: &[usize]) -> bool {
        self.configurations[configuration].1.iter().all(|it| self.works(*it, failed))
    }

    /// One failure for each set of modules that stops working with some.
    #[must_use]
    pub fn losses(&self) -> Vec<usize> {
        let gone = |failure: usize| -> Vec<bool> {
            (0..self.modules.len()).map(|it| self.works(it, &[failure])).collect()
        };
        let mut known = vec![vec![true; self.modules.len()]];
        (0..self.failures.len())
            .filter(|it| {
                let gone = gone(*it);
                let is_new = !known.contains(&gone);
                known.push(gone);
                is_new
            })
            .collect()
    }

    fn stands(&self, module: usize) -> bool {
        let (hardware, needs) = &self.modules[module];
        !hardware.is_empty() || needs.iter().any(|it| self.stands(*it))
    }

    /// Returns the parts that make no sense, in words of messages.
    #[must_use]
    pub fn faults(&self) -> BTreeSet<&'static str> {
        let mut faults = BTreeSet::new();
        if !(0..self.modules.len()).all(|it| self.stands(it)) {
            // The rest is not looked at then.
            return BTreeSet::from(["stands on no hardware"]);
        }
        // What takes the same modules counts once; of what takes the same one after another all.
        let losses = self.losses();
        let set = |bits: u32| -> Vec<usize> {
            let chosen = losses.iter().enumerate().filter(|it| bits >> it.0 & 1 == 1);
            chosen.map(|it| *it.1).collect()
        };
        let sets: Vec<Vec<usize>> = (0..1_u32 << losses.len()).map(set).collect();
        for (at, (objective, _)) in self.configurations.iter().enumerate() {
            let before = (0..at).filter(|it| self.configurations[*it].0 == *objective);
            let before: Vec<_> = before.collect();
            let is_best = |set: &Vec<usize>| {
                self.runs(at, set) && before.iter().all(|it| !self.runs(*it, set))
            };
            if !sets.iter().any(is_best) {
                faults.insert("never runs");
            }
        }
        let in_vain = |(at, it): (usize, &Failure)| {
            let loses = !it.modules.is_empty() || !it.hardware.is_empty();
            it.restarts && loses && self.works(self.restarted(at), &[at])
        };
        if self.failures.iter().enumerate().any(in_vain) {
            faults.insert("starts");
        }
        let decides = self.configurations.iter().any(|it| SUB_OBJECTIVES[it.0].1 == "operator");
        let asks = self.failures.iter().any(|it| it.asks);
        let is_hard = self.failures.iter().any(|it| it.severity[0] == 2);
        if asks && !decides || is_hard && self.operator.is_none() {
            faults.insert("nobody to ask");
        }
        if !decides && self.failures.iter().any(|it| it.masks == ON_ORDER) {
            faults.insert("nobody orders");
        }
        faults
    }
}
