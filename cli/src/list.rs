//! `cotama list`: what comes with the program.

use crate::answers::{ListAnswer, Listed};
use crate::args::ListArgs;
use crate::catalogue;
use crate::exit::{Exit, Failure};
use crate::output::Screen;
use crate::render::described;
use crate::render::style::{HEADING, NAME};
use crate::team::Team;
use crate::ways;
use cotama_models::missions::embedded;
use cotama_models::robots;
use std::fmt::Write;

/// Lists what comes with the program.
pub(crate) fn list(args: &ListArgs, screen: &Screen) -> Result<Exit, Failure> {
    let missions = embedded::embedded().iter();
    let with_axes = cotama_axes::EMBEDDED.iter().map(|it| (it.name, it.description));
    let missions = missions.map(|it| (it.name, it.description)).chain(with_axes);
    let missions =
        missions.map(|it| Listed { name: it.0.to_owned(), description: it.1.to_owned() }).collect();
    let models = catalogue::entries();
    let models = models
        .iter()
        .map(|it| Listed { name: it.shown_name(), description: it.sentence().to_owned() });
    let models = models.collect();
    let robots = robots::EMBEDDED
        .iter()
        .map(|it| Listed { name: it.name.to_owned(), description: it.description.to_owned() });
    let robots = robots.collect();
    let scenarios = Team::ALL
        .iter()
        .map(|it| Listed { name: it.0.name().to_owned(), description: it.1.to_owned() });
    let ways = Listed { name: ways::NAME_OF_ALL.to_owned(), description: ways::ABOUT.to_owned() };
    let scenarios = scenarios.chain([ways]).collect();
    let maps = cotama_floor::embedded::ALL.iter().map(|it| Listed {
        name: it.name.trim_end_matches(".toml").to_owned(),
        description: it.description.to_owned(),
    });
    let maps = maps.collect();
    let answer = ListAnswer { schema: "cotama/list/1", missions, models, robots, scenarios, maps };
    if args.json.json {
        Screen::json(&answer)?;
        return Ok(Exit::Success);
    }
    let mut text = String::new();
    let parts = [
        ("missions", &answer.missions),
        ("models", &answer.models),
        ("robots", &answer.robots),
        ("scenarios", &answer.scenarios),
        ("maps", &answer.maps),
    ];
    for (title, entries) in parts.into_iter().filter(|(_, entries)| !entries.is_empty()) {
        let _ = writeln!(text, "{HEADING}{title}{HEADING:#}");
        let longest = entries.iter().map(|entry| entry.name.len()).max().unwrap_or(0);
        for entry in entries {
            text += &described(&entry.name, longest, NAME, &entry.description, screen.width());
        }
    }
    if let Some(first) = answer.missions.first() {
        let _ = writeln!(
            text,
            "\nnext: {NAME}cotama plan {}{NAME:#}, {NAME}cotama models{NAME:#}",
            first.name
        );
    }
    screen.print(&text)?;
    Ok(Exit::Success)
}
