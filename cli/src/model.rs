//! Models from the command line: by name or from a file.

use crate::catalogue::{self, Entry, Kind};
use crate::exit::Failure;
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind;
use crate::mission::is_name;
use cotama_core::net::Known;
use cotama_core::net::owned::OwnedNet;
use cotama_models::nets;
use cotama_verification::export::json::{self, JsonNetError};
use cotama_verification::pnml::{self, Imported, Limits};
use std::path::Path;

/// A net and what is known of it.
#[derive(Debug)]
pub(crate) struct Loaded {
    /// What the command line calls it.
    pub(crate) name: String,
    pub(crate) net: OwnedNet,
    /// How it was checked while this program was compiled, if it was.
    pub(crate) known: Option<Known>,
    /// What its PNML file calls places and transitions; nothing of other models.
    pub(crate) place_ids: Vec<String>,
    pub(crate) transition_ids: Vec<String>,
}

impl Loaded {
    fn new(name: &str, net: OwnedNet, known: Option<Known>) -> Self {
        Self {
            name: name.to_owned(),
            net,
            known,
            place_ids: Vec::new(),
            transition_ids: Vec::new(),
        }
    }
}

/// The net of this name, or of the file at this path.
pub(crate) fn load(name: &str) -> Result<Loaded, Failure> {
    let (family, number) =
        name.split_once(':').map_or((name, None), |(family, it)| (family, Some(it)));
    match catalogue::entry(family) {
        Some(Entry { kind: Kind::Net(net, known), .. }) if number.is_none() => {
            Ok(Loaded::new(name, OwnedNet::from(net), Some(known)))
        }
        Some(Entry { kind: Kind::Family(_), .. }) => {
            let net = nets::find(name).map_err(|error| Failure::new(error.to_string()))?;
            Ok(Loaded::new(name, net, None))
        }
        Some(Entry { kind: Kind::System(system), .. }) if number.is_none() => {
            let nets: Vec<_> = system.components.iter().map(|it| it.net.name).collect();
            Err(Failure::new(format!("`{name}` is a system of nets, and a net is needed here"))
                .help(format!("its nets: {}", nets.join(", "))))
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
        "`cotama models` lists those that come with the program; or give the path of a PNML or \
         JSON file",
    )
}

/// The name that was probably meant: one with at most one wrong letter of three, or else one that
/// begins with the word.
pub(crate) fn near<'a>(word: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // The distance takes time that grows with both lengths.
    let names = names.filter(|name| name.len() <= 64 && word.len() <= 64);
    let like = |(distance, name): &(usize, &str)| {
        let begins = word.len() >= 3 && name.starts_with(word);
        *distance <= (name.chars().count() / 3).max(1) || begins
    };
    let names = names.map(|name| (strsim::damerau_levenshtein(word, name), name));
    names.filter(like).min().map(|it| it.1)
}

fn file(path: &str) -> Result<Loaded, Failure> {
    const WHAT: &str = "a model";
    let bytes = input::bytes(path, WHAT, input::MODEL_BYTES)?;
    kind::expect(path, &bytes, WHAT, &kind::MODELS)?;
    let end = Path::new(path).extension().map(|end| end.to_string_lossy().to_lowercase());
    let is_json = match end.as_deref() {
        Some("json") => true,
        Some("pnml" | "xml") => false,
        _ => bytes.trim_ascii_start().first() == Some(&b'{'),
    };
    if is_json {
        let text = input::utf8(path, WHAT, bytes)?;
        let net = json::read(&text).map_err(|error| refused(input::name(path), text, error))?;
        return Ok(Loaded::new(path, net, None));
    }
    let Imported { net, place_ids, transition_ids } =
        pnml::read_within(input::name(path), &bytes, Limits::default())?;
    Ok(Loaded { place_ids, transition_ids, ..Loaded::new(path, net, None) })
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
