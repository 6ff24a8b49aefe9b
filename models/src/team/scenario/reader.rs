//! Reading a team's file.

mod places;
mod robot;
mod skill;
mod task;

use super::{
    FORMAT, Fault, FaultKind, FaultTime, Formation, MANY, MAX_ROBOTS, Method, Quality, Scenario,
    Seat, Stage, Travel, Trust, Ways,
};
use crate::missions::faults::Expected;
use crate::missions::reader::fields::{Fields, Reported, Sink, document, document_of_either};
use crate::missions::{Diagnostic, MissionErrors, Spanned};
use crate::names::{quoted, unknown};
use crate::robots::RobotFile;
use crate::team::{Capability, CapabilitySet};
use places::{Places, floor};
use robot::{Files, robot, row, shared_row};
use skill::{skill, skills};
use std::ops::{Range, RangeInclusive};

/// Value of `format` in files of a team's faults.
pub const FAULTS: &str = "cotama-team-faults/1";
/// Times in ms, up to a day.
const AMOUNTS: RangeInclusive<i64> = 0..=86_400_000;
const PERMILLE: RangeInclusive<i64> = 0..=1_000;

/// Names of a file that others refer to.
#[derive(Default)]
struct Names {
    places: Places,
    skills: Vec<String>,
    robots: Vec<String>,
    tasks: Vec<String>,
    /// The files of the robots that could be read, by their numbers.
    files: Vec<Option<RobotFile>>,
}

impl Scenario {
    /// Reads a `cotama-team/1` file, in TOML, or in JSON with the same keys. `source_name` is its
    /// name in messages. The seed is 0.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// use cotama_models::team::scenario::Scenario;
    /// let text = "format = 'cotama-team/1'\nname = 'x'\nskils = []\n";
    /// let errors = Scenario::parse("x.toml", text).unwrap_err().to_string();
    /// let first = "x.toml:3:1: unknown key `skils` in the file; did you mean `skills`?";
    /// assert!(errors.contains(first), "{errors}");
    /// ```
    pub fn parse(source_name: &str, text: &str) -> Result<Self, MissionErrors> {
        Self::parse_on(source_name, text, None, &[])
    }

    /// Reads the same file of a team that stands on a floor, with the ways that were planned for
    /// what the file [asks](super::Asked). They are not looked at where the file names no floor;
    /// without them only a file can be read that says the lengths of its ways itself. `robots` are
    /// the files that it [names](Self::files_of) beside those that are shipped.
    ///
    /// # Errors
    /// All errors of the file, with their places: among them each place that the floor does not
    /// have, or that nothing leads to.
    pub fn parse_on(
        source_name: &str,
        text: &str,
        ways: Option<&Ways>,
        robots: &[RobotFile],
    ) -> Result<Self, MissionErrors> {
        let sink = Sink::default();
        let files = Files::new(robots);
        let scenario = document_of_either(text, &sink, FORMAT, |it| scenario(it, ways, files));
        match scenario.filter(|_| sink.is_empty()) {
            Some(scenario) => Ok(scenario),
            None => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

/// The faults of a team from a file, and the end that it records.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FaultsOfTeam {
    /// The faults, in place of those of the team.
    pub faults: Vec<Fault>,
    /// How a run with them ended.
    pub expected: Option<Expected>,
}

impl FaultsOfTeam {
    /// The team that a file names, by the name of an embedded one or its path; without it nothing
    /// else of the file can be read.
    pub fn team_of(text: &str) -> Option<String> {
        let file: toml::Table = text.parse().ok()?;
        Some(file.get("expected")?.get("mission")?.as_str()?.to_owned())
    }
}

impl Scenario {
    /// Reads a `cotama-team-faults/1` file for this team. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the file, with their places.
    ///
    /// ```
    /// use cotama_models::team::scenario::{FaultTime, service};
    /// let service = service().unwrap();
    /// let text = service.faults_to_toml(&service.faults[2..]);
    /// assert!(text.contains("robot = \"Eddie\", mode = \"EST1\""), "{text}");
    /// let read = service.faults_of("f.toml", &text).unwrap();
    /// assert_eq!(read.faults, service.faults[2..]);
    /// ```
    pub fn faults_of(&self, source_name: &str, text: &str) -> Result<FaultsOfTeam, MissionErrors> {
        let sink = Sink::default();
        let names = Names {
            places: Places::default(),
            skills: self.skills.clone(),
            robots: self.robots.iter().map(|it| it.name.clone()).collect(),
            tasks: self.tasks.iter().map(|it| it.name.clone()).collect(),
            files: self.robots.iter().map(|it| Some(it.file.clone())).collect(),
        };
        let read = document(text, &sink, FAULTS, |mut fields| {
            let faults = fields.tables_up_to("fault", false, MANY).unwrap_or_default();
            let faults: Vec<_> = faults.into_iter().map(|it| fault(it, &names)).collect();
            let expected = fields.optional_table("expected").ok();
            let expected = expected.map(|it| it.map(crate::missions::reader::expected));
            fields.finish();
            let expected = match expected? {
                Some(it) => Some(it?),
                None => None,
            };
            Some(FaultsOfTeam { faults: faults.into_iter().collect::<Option<_>>()?, expected })
        });
        match read.filter(|_| sink.is_empty()) {
            Some(read) => Ok(read),
            None => Err(MissionErrors::new(source_name, text, sink.into_diagnostics())),
        }
    }
}

fn scenario(mut fields: Fields<'_>, ways: Option<&Ways>, mut files: Files<'_>) -> Option<Scenario> {
    let name = fields.text("name");
    let mut names = Names::default();
    let known = fields.optional_texts("skills").unwrap_or_default();
    for it in &known {
        skill(&fields, it, &mut names);
    }
    let network = network(fields.optional_table("network"));
    let floor = floor(&mut fields, ways, &mut names);
    let (floor, crowds) = floor.map_or((None, Vec::new()), |it| (Some(it.0), it.1));
    // Where robots or tasks cannot be read no name of one is known, and nothing more is said.
    let robots = fields.tables_up_to("robot", true, MAX_ROBOTS);
    if robots.is_none() && fields.has("robot") {
        fields.abandon();
        return None;
    }
    let robots = robots.unwrap_or_default().into_iter();
    let robots: Vec<_> = robots.map(|it| robot(it, &mut names, &mut files)).collect();
    let auction = auction(fields.optional_table("auction"), &names);
    let tasks = fields.tables_up_to("task", true, MANY);
    if tasks.is_none() && fields.has("task") {
        fields.abandon();
        return None;
    }
    let tasks = tasks.unwrap_or_default().into_iter();
    let tasks: Vec<_> = tasks.map(|it| task::task(it, &mut names)).collect();
    let faults = fields.tables_up_to("fault", false, MANY).unwrap_or_default();
    let faults: Vec<_> = faults.into_iter().map(|it| fault(it, &names)).collect();
    fields.finish();
    let Auction { method, formation, auctioneer, slack_permille, second_best, trust, travel } =
        auction?;
    Some(Scenario {
        name: name?.value,
        skills: names.skills,
        floor: floor?,
        crowds,
        robots: robots.into_iter().collect::<Option<_>>()?,
        tasks: tasks.into_iter().collect::<Option<_>>()?,
        faults: faults.into_iter().collect::<Option<_>>()?,
        network: network?,
        method,
        formation,
        auctioneer,
        slack_permille,
        second_best,
        trust,
        travel,
        seed: 0,
    })
}

/// The position of a name among known ones; reports it when it is not there.
fn among(
    fields: &Fields<'_>,
    name: Option<&Spanned<String>>,
    what: &str,
    known: &[String],
) -> Option<usize> {
    let name = name?;
    fields.index_of(name, what, known.iter().map(String::as_str))
}

/// A name that must be new.
fn new_name(fields: &mut Fields<'_>, what: &str, known: &mut Vec<String>) -> Option<String> {
    let name = fields.text("name");
    let found = name.as_ref().filter(|it| {
        let twice = known.contains(&it.value);
        if twice || it.value.is_empty() {
            let why = if twice { "names two of them" } else { "is empty" };
            let message = format!("the {what} {} {why}", quoted(&it.value));
            let help = "give each a name of its own";
            fields.report(Diagnostic::new(it.span.clone(), message, "not a new name").help(help));
        }
        !twice && !it.value.is_empty()
    });
    // A name that is wrong holds its place, and is referred to by nobody.
    known.push(found.map_or_else(String::new, |it| it.value.clone()));
    found.map(|it| it.value.clone())
}

fn network(fields: Result<Option<Fields<'_>>, Reported>) -> Option<Quality> {
    let Some(mut fields) = fields.ok()? else { return Some(Quality::OFFICE) };
    let usual = Quality::OFFICE;
    let delay = fields.optional_integer("delay_ms", AMOUNTS);
    let jitter = fields.optional_integer("jitter_ms", AMOUNTS);
    let loss = fields.optional_integer("loss_permille", PERMILLE);
    let copies = fields.optional_integer("copies_permille", PERMILLE);
    fields.finish();
    Some(Quality {
        delay_ms: delay.ok()?.unwrap_or(usual.delay_ms),
        jitter_ms: jitter.ok()?.unwrap_or(usual.jitter_ms),
        loss_permille: loss.ok()?.unwrap_or(usual.loss_permille),
        copies_permille: copies.ok()?.unwrap_or(usual.copies_permille),
    })
}

/// How tasks are given out.
struct Auction {
    method: Method,
    formation: Formation,
    auctioneer: Seat,
    slack_permille: u32,
    second_best: bool,
    trust: Trust,
    travel: Travel,
}

impl Default for Auction {
    fn default() -> Self {
        Self {
            method: Method::default(),
            formation: Formation::default(),
            auctioneer: Seat::Desk,
            slack_permille: 1_000,
            second_best: false,
            trust: Trust::default(),
            travel: Travel::default(),
        }
    }
}

fn auction(fields: Result<Option<Fields<'_>>, Reported>, names: &Names) -> Option<Auction> {
    let usual = Auction::default();
    let Some(mut fields) = fields.ok()? else { return Some(usual) };
    let method = one_of(&mut fields, "method", "method", Method::ALL.map(|it| (it.name(), it)));
    let formation = Formation::ALL.map(|it| (it.name(), it));
    let formation = one_of(&mut fields, "formation", "formation", formation);
    let auctioneer = match fields.optional_text("auctioneer") {
        Ok(None) => Ok(None),
        Ok(name) => among(&fields, name.as_ref(), "robot", &names.robots).map(Some).ok_or(Reported),
        Err(it) => Err(it),
    };
    let takeover = fields.optional_flag("takeover");
    let slack = fields.optional_integer("slack_permille", 0..=1_000_000);
    let second_best = fields.optional_flag("second_best");
    let trust = one_of(&mut fields, "trust", "trust", Trust::ALL.map(|it| (it.name(), it)));
    let travel = travel(&mut fields);
    fields.finish();
    Some(Auction {
        method: method.ok()?.unwrap_or(usual.method),
        formation: formation.ok()?.unwrap_or(usual.formation),
        auctioneer: match (auctioneer.ok()?, takeover.ok()?.unwrap_or(false)) {
            (robot, true) => Seat::Queue(robot.unwrap_or(0)),
            (Some(robot), false) => Seat::Robot(robot),
            (None, false) => Seat::Desk,
        },
        slack_permille: slack.ok()?.unwrap_or(usual.slack_permille),
        second_best: second_best.ok()?.unwrap_or(usual.second_best),
        trust: trust.ok()?.unwrap_or(usual.trust),
        travel: travel.ok()?,
    })
}

/// Reads the delays that bids count with: `travel`, and for a quantile `travel_permille`.
fn travel(fields: &mut Fields<'_>) -> Result<Travel, Reported> {
    let usual = Travel::Quantile(900);
    let known = [("plain", Travel::Plain), ("mean", Travel::Mean), ("quantile", usual)];
    let travel = one_of(fields, "travel", "travel", known);
    if !fields.has("travel_permille") {
        fields.knows("travel_permille");
        return Ok(travel?.unwrap_or_default());
    }
    let permille = fields.optional_integer("travel_permille", 1..=1_000);
    if let (Some(Travel::Quantile(_)), Some(permille)) = (travel?, permille?) {
        return Ok(Travel::Quantile(permille));
    }
    let message = "`travel_permille` is of quantiles alone";
    let help = "write `travel = \"quantile\"`, or leave `travel_permille` out";
    let span = fields.span_of("travel_permille");
    fields.report(Diagnostic::new(span, message, "of what quantile?").help(help));
    Err(Reported)
}

/// A text out of a fixed set, which may be left out.
fn one_of<T: Copy, const N: usize>(
    fields: &mut Fields<'_>,
    key: &'static str,
    what: &str,
    known: [(&'static str, T); N],
) -> Result<Option<T>, Reported> {
    let Some(found) = fields.optional_text(key)? else { return Ok(None) };
    let at = fields.index_of(&found, what, known.iter().map(|it| it.0)).ok_or(Reported)?;
    Ok(Some(known[at].1))
}

fn fault(mut fields: Fields<'_>, names: &Names) -> Option<Fault> {
    let span = fields.whole();
    let when = moment(&mut fields, names, span.clone());
    let what = [fields.has("robot"), fields.has("shifts"), fields.has("turns")];
    let what = match what {
        [false, false, false] if fields.has("mode") => {
            shared_row(&mut fields, names).map(FaultKind::Auctioneer)
        }
        [true, false, false] => {
            let robot = fields.text("robot");
            let robot = among(&fields, robot.as_ref(), "robot", &names.robots);
            let row = row(&mut fields, names, robot);
            robot.zip(row).map(|(robot, row)| FaultKind::Robot(robot, row))
        }
        [false, true, false] => {
            let task = fields.text("shifts");
            among(&fields, task.as_ref(), "task", &names.tasks).map(FaultKind::Shifted)
        }
        [false, false, true] => {
            let task = fields.text("turns");
            let task = among(&fields, task.as_ref(), "task", &names.tasks);
            let hides = fields.texts("hides").unwrap_or_default();
            let hides = hides.iter().map(|it| {
                let at = among(&fields, Some(it), "skill", &names.skills)?;
                Capability::new(u8::try_from(at).ok()?)
            });
            let hides = hides.collect::<Option<Vec<_>>>();
            task.zip(hides).map(|(it, hides)| FaultKind::Turned(it, CapabilitySet::of(&hides)))
        }
        _ => {
            let message = "a fault is of one robot, or of the object of one task";
            let help = "write `robot` and `mode` (`mode` alone for the auctioneer), or `shifts`, \
                        or `turns` and `hides`";
            fields.report(Diagnostic::new(span, message, "one of these").help(help));
            fields.abandon();
            return None;
        }
    };
    fields.finish();
    Some(Fault { when: when?, what: what? })
}

/// When a fault happens: `at_ms`, or `while` a robot is in a `stage` `of` a task.
fn moment(fields: &mut Fields<'_>, names: &Names, span: Range<usize>) -> Option<FaultTime> {
    if !fields.has("while") {
        return fields.integer("at_ms", AMOUNTS).map(FaultTime::At);
    }
    if fields.has("at_ms") {
        let message = "a fault has one moment";
        let help = "leave out `at_ms`, or `while`";
        fields.report(Diagnostic::new(span, message, "two moments").help(help));
        let _ = fields.optional_integer::<u64>("at_ms", AMOUNTS);
    }
    let robot = fields.text("while");
    let robot = among(fields, robot.as_ref(), "robot", &names.robots);
    let stage = fields.text("stage");
    let stages = || Stage::ALL.iter().map(|it| it.name());
    let stage = stage.and_then(|it| fields.index_of(&it, "stage", stages()));
    let task = fields.text("of");
    let task = among(fields, task.as_ref(), "task", &names.tasks);
    let time = fields.optional_integer("time", 1..=1_000_000);
    let after_ms = fields.optional_integer("after_ms", AMOUNTS);
    Some(FaultTime::During {
        robot: robot?,
        task: task?,
        stage: Stage::ALL[stage?],
        time: time.ok()?.unwrap_or(1),
        after_ms: after_ms.ok()?.unwrap_or(0),
    })
}

/// Reports a name that is not known, with the nearest one.
fn not_known(fields: &Fields<'_>, name: &str, span: Range<usize>, what: &str, known: &[String]) {
    let (message, help) = unknown(what, name, known.iter().map(String::as_str));
    fields.report(Diagnostic::new(span, message, "not known").help(help));
}
