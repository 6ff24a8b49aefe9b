//! A robot's decisional level as Rust source: its supervisors, its tables, its names.

use super::supervisors::{self, Step};
use super::{MAX_PARTS, Module, OwnedTables, Robot, in_time};
use std::fmt::{Debug, Write};

/// The decisional level of a robot with the objectives of its mission, as Rust source: the modules
/// of [`supervisors::to_rust`], a module `tables` with [`Tables`](crate::level::Tables), a module
/// `names` with what flags, modules and the other numbers stand for, and a module `tasks` for the
/// executive. The source needs `cotama-core` and `cotama-models` without a heap.
///
/// ```
/// use cotama_models::robots::{Robot, to_rust};
/// let source = to_rust(&Robot::shipped("transport").unwrap(), &[]);
/// assert!(source.contains("pub static TABLES: Tables<'static> = Tables {"));
/// assert!(source.contains("    pub const CONFIGURATIONS: [&str; 8] = ["), "{source}");
/// ```
pub fn to_rust(robot: &Robot, steps: &[Step]) -> String {
    let system = supervisors::of_mission(robot, steps);
    let owned = OwnedTables::of(robot, steps, &system);
    let tables = owned.view();
    let mut text = supervisors::to_rust(&system);
    text += "
/// Numbers and facts that the decisional level needs at work.
pub mod tables {
    #![allow(unused_imports)] // a robot may have no setting, no mask, no operator
    use cotama_core::net::{EventId, PlaceId, TransitionId};
    use cotama_core::system::Of;
    use cotama_core::units::{MillimetresPerSecond, Millis};
    use cotama_models::level::Act::{Ask, Hide, Restart, Set};
    use cotama_models::level::Mode::{Autonomous, Operator};
    use cotama_models::level::{
        Acting, Configuration, Failure, Loss, Mask, Report, Setting, Step, SubObjective, Tables,
    };
    use cotama_models::severity::Persistence::{Intermittent, Permanent, Transient};
    use cotama_models::severity::Severity::{Fatal, Hard, Medium, Weak};

    /// All is numbered as in [`names`](super::names).
    pub static TABLES: Tables<'static> = Tables {
";
    let mut field = |name: &str, value: &dyn Debug| {
        let _ = writeln!(text, "        {name}: {value:?},"); // a text takes all
    };
    field("begins", &tables.begins);
    field("stopped", &tables.stopped);
    field("gives_up", &tables.gives_up);
    field("before", &tables.before);
    field("done", &tables.done);
    field("secures", &tables.secures);
    field("safe", &tables.safe);
    field("waits", &tables.waits);
    field("granted", &tables.granted);
    field("destroyed", &tables.destroyed);
    rows(&mut text, "steps", tables.steps);
    rows(&mut text, "sub_objectives", tables.sub_objectives);
    rows(&mut text, "configurations", tables.configurations);
    rows(&mut text, "losses", tables.losses);
    rows(&mut text, "reports", tables.reports);
    rows(&mut text, "failures", tables.failures);
    rows(&mut text, "masks", tables.masks);
    rows(&mut text, "acting", tables.acting);
    text += "    };\n}\n\n/// Names, by the numbers of the tables.\npub mod names {\n";
    let losses = &robot.losses;
    names(&mut text, "FLAGS", robot.flags().map(|it| it.1));
    names(&mut text, "MODULES", robot.modules.iter().map(|it| it.name.as_str()));
    names(&mut text, "SUB_OBJECTIVES", robot.sub_objectives.iter().map(|it| it.name.as_str()));
    names(&mut text, "CONFIGURATIONS", robot.configurations.iter().map(|it| it.name.as_str()));
    names(&mut text, "FAILURES", robot.failures.iter().map(|it| it.id.as_str()));
    names(&mut text, "LOSSES", losses.losses.iter().map(|it| it.name.as_str()));
    names(&mut text, "REPORTS", losses.reports.iter().map(|it| it.name.as_str()));
    text += "}\n";
    tasks(&mut text, robot);
    text
}

fn tasks(text: &mut String, robot: &Robot) {
    let number = |of: &Module| robot.modules.iter().position(|it| it.name == of.name);
    *text += "
/// The tasks of the executive.
pub mod tasks {
    use cotama_core::executive::Task;
    use cotama_core::units::Micros;

    /// For each configuration its modules, the most urgent first, by number, and their tasks.
";
    let all = &robot.configurations;
    let _ = writeln!(text, "    pub static TASKS: [&[(u8, Task)]; {}] = [", all.len());
    for it in all {
        let (modules, tasks) = in_time::tasks(robot, it);
        let modules = modules.into_iter().map(|it| number(it).unwrap_or(MAX_PARTS));
        *text += "        &[\n";
        row(text, "            ", modules.zip(tasks));
        *text += "        ],\n";
    }
    *text += "    ];\n}\n";
}

/// A line for each.
fn row(text: &mut String, indent: &str, all: impl Iterator<Item = impl Debug>) {
    for it in all {
        let _ = writeln!(text, "{indent}{it:?},"); // a text takes all
    }
}

fn rows(text: &mut String, name: &str, all: &[impl Debug]) {
    let _ = writeln!(text, "        {name}: &[");
    row(text, "            ", all.iter());
    *text += "        ],\n";
}

fn names<'n>(text: &mut String, name: &str, all: impl Iterator<Item = &'n str>) {
    let all: Vec<_> = all.collect();
    let doc = name.to_lowercase().replace('_', "-");
    let count = all.len();
    let _ =
        writeln!(text, "    /// Names of the {doc}.\n    pub const {name}: [&str; {count}] = [");
    row(text, "        ", all.iter());
    *text += "    ];\n";
}
