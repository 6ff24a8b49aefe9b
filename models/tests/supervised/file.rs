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
    pub(crate) task: String,
}

impl Objective {
    pub(crate) fn new(id: &str, does: &str, start: u64, end: u64) -> Self {
        let task = match does {
            "drive" => "MOV",
            "receive" => "RCV",
            "deliver" => "DLV",
            _ => "WAI",
        };
        Self { id: id.into(), does: Some(does.into()), start, end, task: task.into() }
    }
}

pub(crate) struct Option_ {
    pub(crate) id: String,
    pub(crate) task: &'static str,
    pub(crate) configuration: Option<String>,
    pub(crate) needs: Vec<String>,
    /// Further lines.
    pub(crate) more: String,
}

/// A mission file.
pub(crate) struct File {
    pub(crate) supervision: String,
    pub(crate) path_length: u64,
    pub(crate) limits: [u64; 2],
    pub(crate) modules: Vec<String>,
    pub(crate) options: Vec<Option_>,
    pub(crate) objectives: Vec<Objective>,
    pub(crate) zones: String,
    pub(crate) events: String,
}

const MODULES: [&str; 11] =
    ["P3D", "SIM", "UST", "MCL", "NAV", "PPL", "GUI", "SMZ", "DVZ", "LAN", "CAM"];
const MODES: [&str; 6] = ["RT1", "LOC2", "SON1", "COL1", "COM1", "OPR1"];
const ANSWERS: [&str; 7] = [
    "\"teleoperate\", \"teleprogram\", \"path\"",
    "\"teleoperate\", \"goal\"",
    "\"teleprogram\", \"waypoints\"",
    "\"teleprogram\", \"path\"",
    "\"give_up\"",
    "\"teleoperate\", \"give_up\"",
    "\"teleoperate\", \"teleprogram\", \"waypoints\"",
];

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.into()).collect()
}

fn configured(id: &str, needs: &[&str], more: &str) -> Option_ {
    let configuration = Some(id.into());
    Option_ { id: id.into(), task: "MOV", configuration, needs: owned(needs), more: more.into() }
}

fn standing(id: &str, task: &'static str) -> Option_ {
    let more = "duration_ms = 20000\npower_mw = 4600\n".into();
    Option_ { id: id.into(), task, configuration: None, needs: owned(&["P3D"]), more }
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
                    add("wait", 0, &mut x, &mut objectives);
                }
                for _ in 0..=random.below(2) {
                    add("drive", 1000 * (1 + random.below(30)), &mut x, &mut objectives);
                }
                add(does, 0, &mut x, &mut objectives);
            }
        }
        let optimal = ["P3D", "SIM", "UST", "MCL", "NAV", "SMZ"];
        let mut options = vec![
            configured("PF.OPT", &optimal, "quality_per_dm = 4\n"),
            configured("PF.OPTR", &optimal, "quality_per_dm = 3\n"),
            configured("PF.ODO", &["P3D", "SIM", "UST", "NAV", "SMZ"], ""),
            configured("PF.DEG", &["P3D", "NAV", "GUI"], "speed_max_mm_s = 150\n"),
        ];
        // The operator can drive, so that not all of them are needed.
        for option in (1..4).rev() {
            if random.below(4) == 0 {
                options.remove(option);
            }
        }
        options.extend([standing("in", "RCV"), standing("over", "DLV"), standing("pause", "WAI")]);
        let mut zones = String::new();
        for zone in 0..random.below(3) {
            let start = random.below(x);
            let end = start + 1 + random.below(x - start);
            let hardware = random.one_of(&[
                "",
                "require_hardware = \"UST\"\n",
                "require_hardware = \"P3D\"\n",
            ]);
            let _ = write!(
                zones,
                "[[zone]]\nid = \"zone{zone}\"\nx_start_mm = {start}\nx_end_mm = \
                 {end}\nspeed_max_mm_s = 200\n{hardware}"
            );
        }
        let mut events = String::new();
        for _ in 0..random.below(4) {
            let mode = random.one_of(&MODES);
            events += &failure(random.below(x + 1), mode);
            events += &operator(random.below(x + 1), random.one_of(&ANSWERS));
        }
        Self {
            supervision: "[supervision]\ndecides = \"cotama\"\n".into(),
            path_length: x,
            limits: [100_000_000, 1_000_000_000],
            modules: owned(&MODULES),
            options,
            objectives,
            zones,
            events,
        }
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

    pub(crate) fn without_module(&mut self, module: &str) {
        self.modules.retain(|it| it != module);
    }
}

pub(crate) fn failure(x: u64, mode: &str) -> String {
    format!("[[run.event]]\nx_mm = {x}\nkind = \"failure\"\nmode = \"{mode}\"\n")
}

pub(crate) fn operator(x: u64, answers: &str) -> String {
    format!(
        "[[run.event]]\nx_mm = {x}\nkind = \"operator\"\nanswers = [{answers}]\ndelay_ms = 5000\n"
    )
}

impl fmt::Display for File {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { supervision, path_length, limits: [duration, energy], .. } = self;
        writeln!(
            f,
            "format = \"panorama-mission/1\"\nname = \"generated\"\npath_length_mm = {path_length}"
        )?;
        write!(f, "{supervision}")?;
        writeln!(f, "[limits]\norder = [\"duration\", \"energy\"]\nduration_ms = {duration}")?;
        writeln!(f, "energy_mj = {energy}\n[robot]\nmass_g = 9000\nspeed_max_mm_s = 300")?;
        writeln!(f, "impact_energy_max_mj = 4000\n[motion_power]\nc0 = 4890\nc1 = 7400\nc2 = 0")?;
        for module in &self.modules {
            writeln!(f, "[hardware.{module}]\nunits = 1\npower_mw = 0")?;
        }
        for Option_ { id, task, configuration, needs, more } in &self.options {
            writeln!(f, "[[tio]]\nid = \"{id}\"\ntask = \"{task}\"")?;
            if let Some(configuration) = configuration {
                writeln!(f, "configuration = \"{configuration}\"")?;
            }
            let needs: Vec<_> = needs.iter().map(|it| format!("{it} = 1")).collect();
            write!(f, "needs = {{ {} }}\n{more}", needs.join(", "))?;
        }
        for Objective { id, does, start, end, task } in &self.objectives {
            writeln!(f, "[[objective]]\nid = \"{id}\"")?;
            if let Some(does) = does {
                writeln!(f, "does = \"{does}\"")?;
            }
            writeln!(f, "x_start_mm = {start}\nx_end_mm = {end}\ntasks = [\"{task}\"]")?;
        }
        write!(f, "{}{}", self.zones, self.events)
    }
}
