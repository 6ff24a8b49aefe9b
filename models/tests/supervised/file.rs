//! A mission file as its parts, so that it can be generated, broken and printed.

use cotama_fuzz::split_mix;
use std::fmt::{self, Write};

/// `SplitMix64` (Steele, Lea, Flood, OOPSLA 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    pub(crate) fn below(&mut self, end: u64) -> u64 {
        self.next() % end.max(1)
    }

    fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len() as u64) as usize]
    }
}

#[derive(Clone)]
pub(crate) struct Objective {
    pub(crate) id: String,
    pub(crate) does: Option<String>,
    pub(crate) start: u64,
    pub(crate) end: u64,
    /// The task that the file names, which it can leave to what the objective does.
    pub(crate) task: Option<&'static str>,
}

impl Objective {
    pub(crate) fn new(id: &str, does: &str, start: u64, end: u64) -> Self {
        Self { id: id.into(), does: Some(does.into()), start, end, task: None }
    }

    /// The task that leads what it does.
    fn own_task(&self) -> &'static str {
        match self.does.as_deref() {
            Some("drive") => "MOV",
            Some("receive") => "RCV",
            Some("deliver") => "DLV",
            Some("wait") => "WAI",
            _ => "GRASP",
        }
    }
}

/// An option of a task.
pub(crate) struct Option_ {
    pub(crate) id: &'static str,
    pub(crate) task: &'static str,
    pub(crate) needs: Option<&'static str>,
    /// Further lines.
    pub(crate) more: &'static str,
}

/// A mission file.
pub(crate) struct File {
    pub(crate) format: &'static str,
    pub(crate) robot: Option<&'static str>,
    pub(crate) path_length: u64,
    pub(crate) limits: [u64; 2],
    /// Further sections.
    pub(crate) sections: String,
    pub(crate) options: Vec<Option_>,
    pub(crate) objectives: Vec<Objective>,
    pub(crate) zones: String,
    pub(crate) events: String,
}

const MODES: [&str; 6] = ["RT1", "LOC2", "SON1", "COL1", "COM1", "OPR1"];
const ANSWERS: [&str; 6] = [
    "\"Teleoperation\", \"Teleprogramming\", \"done\"",
    "\"Teleoperation\", \"done\"",
    "\"Teleprogramming\", \"done\"",
    "\"give_up\"",
    "\"Teleoperation\", \"give_up\"",
    "\"Teleprogramming\", \"Teleoperation\", \"done\"",
];
/// What a plain mission says itself, and one under supervisors leaves to the file of its robot.
const BODY: &str = "\
[robot]
mass_g = 9000
speed_max_mm_s = 300
impact_energy_max_mj = 4000
[motion_power]
c0 = 4890
c1 = 7400
c2 = 0
[hardware.base]
units = 1
power_mw = 0
";

fn standing(id: &'static str, task: &'static str) -> Option_ {
    Option_ { id, task, needs: None, more: "duration_ms = 20000\npower_mw = 4600\n" }
}

impl File {
    /// A right mission: one object or more, received after at least one drive and delivered after
    /// at least another.
    pub(crate) fn right(seed: u64) -> Self {
        let mut random = Random(seed);
        let mut objectives = Vec::new();
        let mut x = 0;
        let add = |does: &str, length: u64, x: &mut u64, objectives: &mut Vec<Objective>| {
            let id = format!("{does}-{}", objectives.len() + 1);
            objectives.push(Objective::new(&id, does, *x, *x + length));
            *x += length;
        };
        for _ in 0..=random.below(3) {
            for does in ["receive", "deliver"] {
                if random.below(3) == 0 {
                    add(random.one_of(&["wait", "grasp"]), 0, &mut x, &mut objectives);
                }
                for _ in 0..=random.below(2) {
                    add("drive", 1000 * (1 + random.below(30)), &mut x, &mut objectives);
                }
                add(does, 0, &mut x, &mut objectives);
            }
        }
        for it in &mut objectives {
            it.task = (random.below(2) == 0).then(|| it.own_task());
        }
        let tasks = [("in", "RCV"), ("over", "DLV"), ("pause", "WAI"), ("grip", "GRASP")];
        let mut options: Vec<_> = tasks.into_iter().map(|it| standing(it.0, it.1)).collect();
        for it in &mut options {
            it.needs = (random.below(2) == 0).then_some("{}");
        }
        Self {
            format: "panorama-mission/2",
            robot: Some("p3dx-delivery"),
            path_length: x,
            limits: [100_000_000, 1_000_000_000],
            sections: String::new(),
            options,
            objectives,
            zones: zones(&mut random, x),
            events: events(&mut random, x),
        }
    }

    /// Makes a plain mission of it, which says itself what its robot is, but for what objectives
    /// do.
    pub(crate) fn without_robot(&mut self) {
        (self.format, self.robot) = ("panorama-mission/1", None);
        self.sections += BODY;
        let drive = Option_ { id: "drive", task: "MOV", needs: Some("{ base = 1 }"), more: "" };
        self.options.iter_mut().for_each(|it| it.needs = Some("{}"));
        self.options.push(drive);
        for it in &mut self.objectives {
            it.task = Some(it.own_task());
        }
        (self.zones, self.events) = (String::new(), String::new());
    }

    /// Makes a right plain mission of it.
    pub(crate) fn plain(&mut self) {
        self.without_robot();
        self.objectives.iter_mut().for_each(|it| it.does = None);
    }

    /// Adds drives at the end, up to so many objectives.
    pub(crate) fn lengthen(&mut self, objectives: usize) {
        while self.objectives.len() < objectives {
            let id = format!("more-{}", self.objectives.len());
            let (start, end) = (self.path_length, self.path_length + 1000);
            self.objectives.push(Objective::new(&id, "drive", start, end));
            self.path_length = end;
        }
    }

    /// The position of the first objective, or the last, that does this.
    pub(crate) fn first(&self, does: &str) -> usize {
        self.objectives.iter().position(|it| it.does.as_deref() == Some(does)).unwrap()
    }

    pub(crate) fn last(&self, does: &str) -> usize {
        self.objectives.iter().rposition(|it| it.does.as_deref() == Some(does)).unwrap()
    }
}

fn zones(random: &mut Random, path_length: u64) -> String {
    let mut zones = String::new();
    for zone in 0..random.below(3) {
        let start = random.below(path_length);
        let end = start + 1 + random.below(path_length - start);
        let requires =
            random.one_of(&["", "require_hardware = \"PF.DEG\"\n", "require_tio = \"PF.DEG\"\n"]);
        let _ = write!(
            zones,
            "[[zone]]\nid = \"zone{zone}\"\nx_start_mm = {start}\nx_end_mm = \
             {end}\nspeed_max_mm_s = 200\n{requires}"
        );
    }
    zones
}

fn events(random: &mut Random, path_length: u64) -> String {
    let mut events = String::new();
    for _ in 0..random.below(4) {
        let (x, after) = (random.below(path_length + 1), random.below(60_000));
        let when = match random.below(4) {
            0 => format!("t_ms = {after}"),
            1 => format!("during = \"Following\"\nafter_ms = {after}"),
            2 => "during = \"Waits\"".to_owned(),
            _ => format!("x_mm = {x}"),
        };
        let until = random.one_of(&["", "until_t_ms = 90000\n", "until_during = \"Waits\"\n"]);
        events += &(failure(&when, random.one_of(&MODES)) + until);
        events += &operator(random.below(path_length + 1), random.one_of(&ANSWERS));
        let (kind, more) = random.one_of(&[
            ("repair", "mode = \"RT1\""),
            ("obstacle", "delay_ms = 400"),
            ("odometry", "extra_mm = 30"),
        ]);
        let _ = writeln!(events, "[[run.event]]\nx_mm = {x}\nkind = \"{kind}\"\n{more}");
    }
    events
}

pub(crate) fn failure(when: &str, mode: &str) -> String {
    format!("[[run.event]]\n{when}\nkind = \"failure\"\nmode = \"{mode}\"\n")
}

pub(crate) fn operator(x: u64, answers: &str) -> String {
    format!(
        "[[run.event]]\nx_mm = {x}\nkind = \"operator\"\nanswers = [{answers}]\ndelay_ms = 5000\n"
    )
}

impl fmt::Display for File {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { format, robot, path_length, limits: [duration, energy], .. } = self;
        writeln!(f, "format = \"{format}\"\nname = \"generated\"")?;
        if let Some(robot) = robot {
            writeln!(f, "robot = \"{robot}\"")?;
        }
        writeln!(
            f,
            "path_length_mm = {path_length}\n[limits]\norder = [\"duration\", \"energy\"]"
        )?;
        writeln!(f, "duration_ms = {duration}\nenergy_mj = {energy}")?;
        f.write_str(&self.sections)?;
        for Option_ { id, task, needs, more } in &self.options {
            writeln!(f, "[[tio]]\nid = \"{id}\"\ntask = \"{task}\"")?;
            if let Some(needs) = needs {
                writeln!(f, "needs = {needs}")?;
            }
            f.write_str(more)?;
        }
        for Objective { id, does, start, end, task } in &self.objectives {
            writeln!(f, "[[objective]]\nid = \"{id}\"")?;
            if let Some(does) = does {
                writeln!(f, "does = \"{does}\"")?;
            }
            writeln!(f, "x_start_mm = {start}\nx_end_mm = {end}")?;
            if let Some(task) = task {
                writeln!(f, "tasks = [\"{task}\"]")?;
            }
        }
        write!(f, "{}{}", self.zones, self.events)
    }
}
