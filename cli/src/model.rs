//! Models from the command line: by name or from a file.

use crate::catalogue::{self, Entry, Kind};
use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind::{self, Kind as FileKind};
use crate::mission;
use crate::names::{is_name, near};
use crate::robot;
use crate::team::{self, Chosen, Protocol, Team};
use cotama_core::net::owned::OwnedNet;
use cotama_core::net::{Known, TransitionId};
use cotama_core::system::owned::OwnedSystem;
use cotama_core::system::{Component, System};
use cotama_models::missions::{Mission, embedded};
use cotama_models::nets;
use cotama_models::robots::requirements::Requirement as RobotRequirement;
use cotama_models::robots::supervisors::Step;
use cotama_models::robots::{self, Robot};
use cotama_models::team::protocol::Requirement;
use cotama_models::team::scenario::Scenario;
use cotama_verification::formats::json::{self, Wrong};
use cotama_verification::pnml::{self, Imported, Limits, PnmlErrors};
use cotama_verification::pt::Extras;
use cotama_verification::tina;
use cotama_verification::tpn::{self, Interval, NotANet, TimeNet};
use std::path::Path;

/// A net and what is known of it.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) net: OwnedNet,
    /// How it was checked while this program was compiled, if it was.
    pub(crate) known: Option<Known>,
    /// Ids of places and transitions in its PNML file; empty for other models.
    pub(crate) place_ids: Vec<String>,
    pub(crate) transition_ids: Vec<String>,
    pub(crate) labels: Box<Labels>,
    /// Inhibitor arcs, reset arcs and priorities, which `net` does not hold.
    pub(crate) extras: Extras,
    /// The error that it has random delays, for all who do not leave time out.
    pub(crate) random: Option<PnmlErrors>,
    /// Notes on labels that its reader left out.
    pub(crate) notes: Vec<String>,
    /// Requirements of the protocol of a team; empty for other models.
    pub(crate) requirements: Vec<Requirement>,
}

/// Labels of transitions in a PNML file, for those who compare them with a log.
#[derive(Debug, Default)]
pub(crate) struct Labels {
    /// Transitions that no log shows.
    pub(crate) invisible: Vec<TransitionId>,
    /// Names that several share.
    pub(crate) shared: Vec<(TransitionId, String)>,
}

impl Loaded {
    fn new(net: OwnedNet, known: Option<Known>) -> Self {
        Self {
            net,
            known,
            place_ids: Vec::new(),
            transition_ids: Vec::new(),
            labels: Box::default(),
            extras: Extras::default(),
            random: None,
            notes: Vec::new(),
            requirements: Vec::new(),
        }
    }

    /// The net, if it is all; `what` would be done with it.
    ///
    /// # Errors
    /// When that would lose its inhibitor arcs, reset arcs, priorities or random delays.
    pub(crate) fn plain(self, name: &str, what: &str) -> Result<OwnedNet, Failure> {
        if let Some(random) = self.random {
            return Err(random.into());
        }
        if self.extras.is_empty() {
            return Ok(self.net);
        }
        let message = format!("its {} cannot be {what}", self.extras.named());
        Err(Failure::of(input::name(name), message)
            .help("`cotama check` and `cotama statespace` know them, `--format pnml` writes them"))
    }
}

/// The model that a name stands for.
#[derive(Debug)]
pub(crate) enum Found {
    Net(Box<Loaded>),
    /// A time net, whose intervals can be those of no net.
    Time(TimeNet),
    /// Nets that work together.
    System(&'static System<'static>),
    /// Nets that work together, from a file.
    Owned(Box<Owned>),
}

/// A system from a file, or the supervisors that the file of a robot makes.
#[derive(Debug)]
pub(crate) struct Owned {
    pub(crate) system: OwnedSystem,
    /// Requirements of a robot's supervisors.
    pub(crate) requirements: Vec<RobotRequirement>,
    /// The robot, and the objectives of its mission.
    pub(crate) robot: Option<(Robot, Vec<Step>)>,
}

impl From<&Robot> for Found {
    fn from(robot: &Robot) -> Self {
        Self::under(robot, &[])
    }
}

impl Found {
    /// The supervisors of a robot, in a mission of these objectives.
    fn under(robot: &Robot, steps: &[Step]) -> Self {
        let system = robots::supervisors::of_mission(robot, steps);
        let requirements = robots::requirements::of_mission(robot, steps);
        let robot = Some((robot.clone(), steps.to_vec()));
        Self::Owned(Box::new(Owned { system, requirements, robot }))
    }

    /// The supervisors of a mission's robot, if it has one.
    pub(crate) fn of_mission(mission: &Mission) -> Option<Self> {
        mission.robot().map(|it| Self::under(it.robot(), &mission.steps()))
    }
}

impl From<OwnedSystem> for Found {
    fn from(system: OwnedSystem) -> Self {
        Self::Owned(Box::new(Owned { system, requirements: Vec::new(), robot: None }))
    }
}

impl From<Protocol> for Found {
    fn from(Protocol { net, requirements, notes }: Protocol) -> Self {
        Self::from(Loaded { notes, requirements, ..Loaded::new(net, None) })
    }
}

impl From<Loaded> for Found {
    fn from(loaded: Loaded) -> Self {
        Self::Net(Box::new(loaded))
    }
}

/// Calls a function with the system of this name, and with what the file of a net says for logs;
/// a net is a system of one.
pub(crate) fn with_system<T>(
    name: &str,
    then: impl FnOnce(&System<'_>, &Labels) -> T,
) -> Result<T, Failure> {
    with_found(name, find(name)?, then)
}

/// The same of a model that was found.
pub(crate) fn with_found<T>(
    name: &str,
    found: Found,
    then: impl FnOnce(&System<'_>, &Labels) -> T,
) -> Result<T, Failure> {
    let (net, labels) = match found {
        Found::System(system) => return Ok(then(system, &Labels::default())),
        Found::Owned(it) => return Ok(it.system.with(|it| then(it, &Labels::default()))),
        Found::Net(mut loaded) => {
            let labels = std::mem::take(&mut loaded.labels);
            (loaded.plain(name, "played")?, labels)
        }
        Found::Time(net) => (played(name, &net)?, Box::default()),
    };
    let view = net.view();
    Ok(then(&System::alone(&[Component::alone(&view.net())]), &labels))
}

/// The model of this name, or of the file at this path.
pub(crate) fn find(name: &str) -> Result<Found, Failure> {
    if let Some(team) = Team::named(name) {
        return protocol(name, &Chosen::Known(team).scenario());
    }
    if let Some(robot) = robot::robot(name)? {
        return Ok(Found::from(&robot));
    }
    if let Some(found) = of_mission(name)? {
        return Ok(found);
    }
    let (family, number) =
        name.split_once(':').map_or((name, None), |(family, it)| (family, Some(it)));
    match catalogue::entry(family) {
        Some(Entry { kind: Kind::Net(net, known), .. }) if number.is_none() => {
            Ok(Found::from(Loaded::new(OwnedNet::from(net), Some(known))))
        }
        Some(Entry { kind: Kind::Family(_), .. }) => {
            let net = nets::find(name).map_err(|error| Failure::new(error.to_string()))?;
            Ok(Found::from(Loaded::new(net, None)))
        }
        Some(Entry { kind: Kind::System(system), .. }) if number.is_none() => {
            Ok(Found::System(system))
        }
        Some(_) => {
            Err(Failure::new(format!("`{family}` is no family of nets and takes no number"))
                .help(format!("say `{family}`")))
        }
        None if is_name(name) && !Path::new(name).exists() => {
            Err(kind::mission_for_model(name).unwrap_or_else(|| unknown(name, family)))
        }
        None => file(name),
    }
}

/// The supervisors of the mission of this name or file, if it is one that names its robot.
fn of_mission(name: &str) -> Result<Option<Found>, Failure> {
    Ok(mission_with_robot(name)?.and_then(|it| Found::of_mission(&it)))
}

/// The mission of this name or file, if it is one that names its robot. Its floor decides nothing
/// for its supervisors, so nothing warns of it.
pub(crate) fn mission_with_robot(name: &str) -> Result<Option<Mission>, Failure> {
    let text = match embedded::mission(name) {
        Some(it) => it.text.to_owned(),
        None if kind::is(name, FileKind::Mission) => {
            kind::text(name, "a mission file", input::MISSION_BYTES, &[FileKind::Mission])?
        }
        None => return Ok(None),
    };
    if Mission::robot_of(&text).is_none() {
        return Ok(None);
    }
    mission::load(name, None).map(Some)
}

/// The supervisors of a robot in a mission: one that names it, or a plain one.
pub(crate) fn of_robot(name: &str, of: &str) -> Result<Found, Failure> {
    let Some(robot) = robot::robot(name)? else {
        return Err(Failure::new(format!("--mission: `{name}` is no robot"))
            .help("give the name of a robot, or the path of its file, before it"));
    };
    Ok(Found::under(&robot, &steps(name, &robot, of)?))
}

/// Returns the objectives of a mission of a robot, for its global supervisor.
pub(crate) fn steps(name: &str, robot: &Robot, of: &str) -> Result<Vec<Step>, Failure> {
    let mission = mission::under(of, name)?;
    match mission.robot() {
        Some(it) if it.robot() == robot => Ok(mission.steps()),
        other => {
            let other = other.map_or("none", |it| it.robot().name.as_str());
            let message = format!("--mission: the robot of `{of}` is {other}, not `{name}`");
            Err(Failure::new(message)
                .help("name a mission of this robot, or the other robot before it"))
        }
    }
}

fn unknown(name: &str, family: &str) -> Failure {
    let entries = catalogue::entries();
    let number = &name[family.len()..];
    let teams = Team::ALL.iter().map(|it| it.0.name());
    let teams = teams.chain(robots::EMBEDDED.iter().map(|it| it.name));
    let guess = near(family, entries.iter().map(|it| it.name).chain(teams))
        .map_or_else(String::new, |near| format!("; did you mean `{near}{number}`?"));
    Failure::new(format!("there is no model `{name}`, and no file of this name{guess}")).help(
        "`cotama models` lists those that come with the program; or give the path of a PNML, JSON \
         or TINA (.net) file",
    )
}

/// The model in a file, or on standard input: in the format that the end of its name says, or its
/// first characters.
fn file(path: &str) -> Result<Found, Failure> {
    const WHAT: &str = "a model";
    let bytes = input::bytes(path, WHAT, input::MODEL_BYTES)?;
    kind::expect(path, &bytes, WHAT, &kind::MODELS)?;
    if kind::is_of(&bytes, FileKind::TeamAtWork) {
        let text = input::utf8(path, WHAT, bytes)?;
        return protocol(path, &team::read(path, input::name(path), &text)?);
    }
    if kind::is_of(&bytes, FileKind::Robot) {
        let text = input::utf8(path, WHAT, bytes)?;
        return Ok(Found::from(robot::robot_file(path, &text)?.robot()));
    }
    let end = Path::new(path).extension().map(|end| end.to_string_lossy().to_lowercase());
    let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes).trim_ascii_start();
    let is_tina = || {
        let word = start.split(u8::is_ascii_whitespace).next().unwrap_or_default();
        word.starts_with(b"#") || [b"net", b"tr".as_slice(), b"pl", b"nt"].contains(&word)
    };
    match end.as_deref() {
        Some("json") => own(path, bytes),
        Some("net") => time_net(path, bytes),
        Some("pnml" | "xml") if !is_markup(&bytes) => Err(unlike(path, bytes)),
        _ if start.first() == Some(&b'{') => own(path, bytes),
        _ if is_tina() => time_net(path, bytes),
        _ if is_markup(&bytes) => imported(path, &bytes),
        _ => Err(unlike(path, bytes)),
    }
}

/// The protocol by which a team gives its tasks out.
fn protocol(name: &str, scenario: &Scenario) -> Result<Found, Failure> {
    Protocol::of(scenario).map(Found::from).ok_or_else(|| {
        Failure::of(input::name(name), team::too_large(scenario))
            .help("the simulator runs it: `cotama run`, `cotama campaign`")
    })
}

/// Whether a file begins with an element, in whatever encoding.
fn is_markup(bytes: &[u8]) -> bool {
    let is_mark = |it: &u8| matches!(it, 0 | 0xef | 0xbb | 0xbf | 0xfe | 0xff);
    bytes.iter().find(|it| !is_mark(it) && !it.is_ascii_whitespace()) == Some(&b'<')
}

/// A file that begins like none of the formats of models.
fn unlike(path: &str, bytes: Vec<u8>) -> Failure {
    let text = match input::utf8(path, "a model", bytes) {
        Ok(text) => text,
        Err(refused) => return refused,
    };
    let lead = text.len() - text.trim_start().len();
    let line = 1 + text[..lead].matches('\n').count();
    let column = 1 + lead - text[..lead].rfind('\n').map_or(0, |it| it + 1);
    let message = "this is neither PNML, JSON nor a .net of TINA".to_owned();
    let errors = FileErrors::at(input::name(path), text, line, column, message);
    errors.help("PNML begins with `<pnml`, JSON with `{`, and a .net with `net` or `tr`").into()
}

fn imported(path: &str, bytes: &[u8]) -> Result<Found, Failure> {
    let read = pnml::read_within(input::name(path), bytes, Limits::default())?;
    let Imported { net, place_ids, transition_ids, extras, random, notes, .. } = read;
    let labels = Box::new(Labels { invisible: read.invisible, shared: read.shared_names });
    let loaded = Loaded { place_ids, transition_ids, labels, ..Loaded::new(net, None) };
    Ok(Found::from(Loaded { extras, random, notes, ..loaded }))
}

/// A net or a system in JSON.
fn own(path: &str, bytes: Vec<u8>) -> Result<Found, Failure> {
    let text = input::utf8(path, "a model", bytes)?;
    let read = if kind::is_of(&text, FileKind::JsonSystem) {
        json::read_system(&text).map(Found::from)
    } else {
        json::read(&text).map(|it| Found::from(Loaded::new(it, None)))
    };
    read.map_err(|it| refused(input::name(path), text, it))
}

/// A net of TINA; one without any interval is a plain net, as in PNML.
fn time_net(path: &str, bytes: Vec<u8>) -> Result<Found, Failure> {
    let source = input::name(path);
    let text = input::utf8(path, "a model", bytes)?;
    let net = match tina::read(source, text.as_bytes()) {
        Ok(net) => net,
        Err(error) => {
            let at = (error.line, error.column);
            let errors = FileErrors::at_character(source, text, at, error.message, error.help);
            return Err(errors.into());
        }
    };
    match played(path, &net) {
        Ok(plain) if is_untimed(&net) => Ok(Found::from(Loaded::new(plain, None))),
        _ => Ok(Found::Time(net)),
    }
}

/// Whether no transition has an interval that excludes anything.
pub(crate) fn is_untimed(net: &TimeNet) -> bool {
    net.transitions().iter().all(|it| it.interval == Interval::ANY)
}

/// A time net as a net of milliseconds. One without any interval is a plain net, as in PNML.
pub(crate) fn played(path: &str, net: &TimeNet) -> Result<OwnedNet, Failure> {
    let mut played = tpn::to_net(net).map_err(|error| {
        let (NotANet::Open(id) | NotANet::Large(id) | NotANet::TakenAndRead(id)) = error;
        let it = net.transitions().get(id.0 as usize);
        let (name, interval) =
            it.map_or_else(Default::default, |it| (it.name.clone(), it.interval.to_string()));
        let why = match error {
            NotANet::Open(_) => format!("its interval {interval} has an open bound"),
            NotANet::Large(_) => format!("its interval {interval} has a bound above 4294967295"),
            NotANet::TakenAndRead(_) => "it takes from and reads one place".to_owned(),
        };
        Failure::new(format!(
            "{}: transition `{name}` cannot be used here: {why}",
            input::name(path)
        ))
        .help("`cotama check` and `cotama statespace` know what it means")
    })?;
    if is_untimed(net) {
        played.transitions.iter_mut().for_each(|it| it.within = None);
    }
    Ok(played)
}

fn refused(
    source: &str,
    text: String,
    Wrong { line, column, message, help, .. }: Wrong,
) -> Failure {
    let errors = FileErrors::at(source, text, line, column, message);
    let errors = match help {
        Some(help) => errors.help(help),
        None => errors,
    };
    errors.into()
}
