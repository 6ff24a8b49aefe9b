//! Models from the command line: by name or from a file.

use crate::catalogue::{self, Entry, Kind};
use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind;
use crate::names::{is_name, near};
use cotama_core::net::Known;
use cotama_core::net::owned::OwnedNet;
use cotama_core::system::{Component, System};
use cotama_models::nets;
use cotama_verification::formats::json::{self, JsonNetError};
use cotama_verification::pnml::{self, Imported, Limits};
use cotama_verification::tina;
use cotama_verification::tpn::{self, Interval, NotANet, TimeNet};
use std::path::Path;

/// A net and what is known of it.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) net: OwnedNet,
    /// How it was checked while this program was compiled, if it was.
    pub(crate) known: Option<Known>,
    /// What its PNML file calls places and transitions; nothing of other models.
    pub(crate) place_ids: Vec<String>,
    pub(crate) transition_ids: Vec<String>,
}

impl Loaded {
    fn new(net: OwnedNet, known: Option<Known>) -> Self {
        Self { net, known, place_ids: Vec::new(), transition_ids: Vec::new() }
    }
}

/// What a name stands for.
#[derive(Debug)]
pub(crate) enum Found {
    Net(Loaded),
    /// A time net, whose intervals can be those of no net.
    Time(TimeNet),
    /// Nets that work together.
    System(&'static System<'static>),
}

/// What is done with the system of this name; a net is a system of one.
pub(crate) fn with_system<T>(
    name: &str,
    then: impl FnOnce(&System<'_>) -> T,
) -> Result<T, Failure> {
    let net = match find(name)? {
        Found::System(system) => return Ok(then(system)),
        Found::Net(loaded) => loaded.net,
        Found::Time(net) => played(name, &net)?,
    };
    let view = net.view();
    Ok(then(&System::alone(&[Component::alone(&view.net())])))
}

/// The model of this name, or of the file at this path.
pub(crate) fn find(name: &str) -> Result<Found, Failure> {
    let (family, number) =
        name.split_once(':').map_or((name, None), |(family, it)| (family, Some(it)));
    match catalogue::entry(family) {
        Some(Entry { kind: Kind::Net(net, known), .. }) if number.is_none() => {
            Ok(Found::Net(Loaded::new(OwnedNet::from(net), Some(known))))
        }
        Some(Entry { kind: Kind::Family(_), .. }) => {
            let net = nets::find(name).map_err(|error| Failure::new(error.to_string()))?;
            Ok(Found::Net(Loaded::new(net, None)))
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

fn unknown(name: &str, family: &str) -> Failure {
    let entries = catalogue::entries();
    let number = &name[family.len()..];
    let guess = near(family, entries.iter().map(|it| it.name))
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
    let end = Path::new(path).extension().map(|end| end.to_string_lossy().to_lowercase());
    let start = bytes.trim_ascii_start();
    let is_tina = || {
        let word = start.split(u8::is_ascii_whitespace).next().unwrap_or_default();
        word.starts_with(b"#") || [b"net", b"tr".as_slice(), b"pl", b"nt"].contains(&word)
    };
    match end.as_deref() {
        Some("json") => own(path, bytes),
        Some("net") => time_net(path, &bytes),
        Some("pnml" | "xml") => imported(path, &bytes),
        _ if start.first() == Some(&b'{') => own(path, bytes),
        _ if is_tina() => time_net(path, &bytes),
        _ => imported(path, &bytes),
    }
}

fn imported(path: &str, bytes: &[u8]) -> Result<Found, Failure> {
    let Imported { net, place_ids, transition_ids } =
        pnml::read_within(input::name(path), bytes, Limits::default())?;
    Ok(Found::Net(Loaded { place_ids, transition_ids, ..Loaded::new(net, None) }))
}

fn own(path: &str, bytes: Vec<u8>) -> Result<Found, Failure> {
    let text = input::utf8(path, "a model", bytes)?;
    match json::read(&text) {
        Ok(net) => Ok(Found::Net(Loaded::new(net, None))),
        Err(error) => Err(refused(input::name(path), text, error)),
    }
}

fn time_net(path: &str, bytes: &[u8]) -> Result<Found, Failure> {
    let source = input::name(path);
    tina::read(source, bytes).map(Found::Time).map_err(|error| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        let at = (error.line, error.column);
        FileErrors::at_character(source, text, at, error.message, error.help).into()
    })
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
    if net.transitions().iter().all(|it| it.interval == Interval::ANY) {
        played.transitions.iter_mut().for_each(|it| it.within = None);
    }
    Ok(played)
}

fn refused(source: &str, text: String, error: JsonNetError) -> Failure {
    match error {
        JsonNetError::Json { line, column, what } if line > 0 => {
            FileErrors::at(source, text, line, column, what).into()
        }
        other => Failure::of(source, other.to_string())
            .help("`cotama export door --format json` shows how such a file looks"),
    }
}
