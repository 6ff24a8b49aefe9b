//! What kind of file something is, as far as its beginning tells: so that a file of another kind
//! leads to the command that reads it, and not to an error in every line.

use crate::catalogue;
use crate::exit::Failure;
use crate::input;
use crate::names::quoted;
use cotama_models::missions::embedded;

/// A kind of file that some command reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Mission,
    Faults,
    Pnml,
    /// A property file of the Model Checking Contest.
    Properties,
    JsonNet,
    Tina,
    Certificate,
    Trace,
    Instance,
    Team,
}

/// The kinds that hold a model.
pub(crate) const MODELS: [Kind; 3] = [Kind::Pnml, Kind::JsonNet, Kind::Tina];
/// So many bytes tell.
const LOOKED_AT: usize = 64 << 10;

impl Kind {
    /// The kind of a file that begins so, if that is clear.
    fn of(bytes: &[u8]) -> Option<Self> {
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(LOOKED_AT)]);
        let start = start.trim_start_matches('\u{feff}').trim_start();
        if start.starts_with('<') {
            let elements = [("<pnml", Self::Pnml), ("<property-set", Self::Properties)];
            return elements.into_iter().find(|it| start.contains(it.0)).map(|it| it.1);
        }
        if start.starts_with('{') {
            return Self::of_json(start);
        }
        let mut lines = start.lines().map(str::trim_start);
        let format = lines.clone().find_map(|it| it.strip_prefix("format"));
        let value = format.and_then(|it| it.trim_start().strip_prefix('=')).map(str::trim_start);
        match value.map(|it| it.trim_start_matches(['"', '\''])) {
            Some(it) if it.starts_with("panorama-mission/") => return Some(Self::Mission),
            Some(it) if it.starts_with("panorama-faults/") => return Some(Self::Faults),
            _ => {}
        }
        let first = lines.find(|it| !it.is_empty() && !it.starts_with('#'))?;
        let word = first.split_whitespace().next()?;
        let is_tina = matches!(word, "net" | "tr" | "pl") && !first.contains('=');
        is_tina.then_some(Self::Tina)
    }

    fn of_json(start: &str) -> Option<Self> {
        let schemas = [
            ("cotama/net/", Self::JsonNet),
            ("cotama-certificate/", Self::Certificate),
            ("cotama-trace/", Self::Trace),
        ];
        let format = start.split_once("\"format\"").map(|it| it.1.trim_start_matches([':', ' ']));
        if format.is_some_and(|it| it.starts_with("\"cotama-team-assignment/")) {
            return Some(Self::Team);
        }
        let named = start.split_once("\"schema\"").map(|it| it.1.trim_start_matches([':', ' ']));
        let schema = named.map(|it| it.trim_start_matches('"'));
        let known = schema.and_then(|it| schemas.into_iter().find(|known| it.starts_with(known.0)));
        let is_instance =
            schema.is_none() && start.contains("\"limits\"") && start.contains("\"activities\"");
        known.map(|it| it.1).or(is_instance.then_some(Self::Instance))
    }

    /// What it is, in a few words.
    const fn words(self) -> &'static str {
        match self {
            Self::Mission => "a mission",
            Self::Faults => "a file of faults",
            Self::Pnml => "PNML, a net",
            Self::Properties => "a property file",
            Self::JsonNet => "a net in JSON",
            Self::Tina => "a net of TINA",
            Self::Certificate => "a certificate",
            Self::Trace => "a trace",
            Self::Instance => "an allocation instance",
            Self::Team => "a team with its tasks",
        }
    }

    /// Where one comes from.
    const fn origin(self) -> &'static str {
        match self {
            Self::Mission => "`cotama new mission NAME` begins one",
            Self::Faults => "one in which nothing goes wrong is `format = \"panorama-faults/1\"`",
            Self::Pnml | Self::JsonNet | Self::Tina => {
                "`cotama models` lists those that come with the program"
            }
            Self::Properties => "a property a line, as `name: AG !(a & b)`",
            Self::Certificate => "`cotama check MODEL --certificate FILE` writes one",
            Self::Trace => "`cotama run MISSION --trace FILE` writes one",
            Self::Instance => "`cotama help allocate` shows one",
            Self::Team => "`cotama help assign` shows one",
        }
    }

    /// The command that reads it.
    fn command(self, file: &str) -> String {
        match self {
            Self::Mission => format!("cotama plan {file}"),
            Self::Faults => format!("cotama run MISSION --faults {file}"),
            Self::Pnml | Self::JsonNet | Self::Tina => format!("cotama check {file}"),
            Self::Properties => format!("cotama check MODEL --properties {file}"),
            Self::Certificate => format!("cotama verify {file}"),
            Self::Trace => format!("cotama replay {file}"),
            Self::Instance => format!("cotama allocate {file}"),
            Self::Team => format!("cotama assign {file}"),
        }
    }
}

/// How files of some kinds begin that no command reads, and what they are.
const PAGES: [(&[u8], &str); 3] = [
    (b"\x89PNG", "a picture (PNG)"),
    (b"\xff\xd8\xff", "a picture (JPEG)"),
    (b"%PDF", "a page (PDF)"),
];
/// The same of what the readers of models refuse themselves, with its place.
const BINARIES: [(&[u8], &str); 3] = [
    (b"PK\x03\x04", "an archive (ZIP)"),
    (b"\x1f\x8b", "an archive (gzip)"),
    (b"\x7fELF", "a program (ELF)"),
];

/// The text of a file of one of these kinds, or of standard input for `-`; `what` says what it
/// should be.
pub(crate) fn text(path: &str, what: &str, limit: u64, wanted: &[Kind]) -> Result<String, Failure> {
    let bytes = input::bytes(path, what, limit)?;
    expect(path, &bytes, what, wanted)?;
    input::utf8(path, what, bytes)
}

/// Refuses a file that is empty, or clearly of a kind that is not read here; `what` says what is.
pub(crate) fn expect(path: &str, bytes: &[u8], what: &str, wanted: &[Kind]) -> Result<(), Failure> {
    let begins = |it: &&(&[u8], &'static str)| bytes.starts_with(it.0);
    let page = PAGES.iter().find(begins).map(|it| it.1);
    let binary = || BINARIES.iter().find(begins).map(|it| it.1);
    let empty = || bytes.trim_ascii().is_empty().then_some("empty");
    let other = || if wanted == MODELS { None } else { binary().or_else(empty) };
    if let Some(is) = page.or_else(other) {
        let message = format!("this is {is}, and {what} is needed here");
        let failure = Failure::of(input::name(path), message);
        return Err(failure.help(wanted.first().map_or("", |it| it.origin())));
    }
    match Kind::of(bytes).filter(|it| !wanted.contains(it)) {
        None => Ok(()),
        Some(kind) => {
            let message = format!("this is {}, and {what} is needed here", kind.words());
            Err(Failure::of(input::name(path), message)
                .help(format!("try `{}`", kind.command(&quoted(path)))))
        }
    }
}

/// Why the name of a model is none of a mission, if it is a model's.
pub(crate) fn model_for_mission(name: &str) -> Option<Failure> {
    let model = name.split_once(':').map_or(name, |it| it.0);
    catalogue::entry(model)?;
    let failure = Failure::new(format!("`{name}` is a model, and a mission is needed here"));
    Some(failure.help(format!("try `cotama check {name}`, or `cotama list` for the missions")))
}

/// Why the name of a mission is none of a model, if it is a mission's.
pub(crate) fn mission_for_model(name: &str) -> Option<Failure> {
    embedded::mission(name)?;
    let failure = Failure::new(format!("`{name}` is a mission, and a model is needed here"));
    Some(failure.help(format!("try `cotama plan {name}`, or `cotama models` for the models")))
}

#[cfg(test)]
mod tests {
    use super::Kind;

    #[test]
    fn a_file_is_known_by_its_beginning() {
        let kind = |text: &str| Kind::of(text.as_bytes());
        let cases = [
            ("# a walk\nformat = 'panorama-mission/1'\n", Kind::Mission),
            ("format=\"panorama-faults/9\"", Kind::Faults),
            ("\u{feff}<?xml version=\"1.0\"?>\n<pnml xmlns=\"..\">", Kind::Pnml),
            ("<?xml?><property-set>", Kind::Properties),
            ("{\n  \"schema\": \"cotama/net/1\"", Kind::JsonNet),
            ("{\"schema\":\"cotama-certificate/1\",", Kind::Certificate),
            ("{\"schema\":\"cotama-trace/1\",", Kind::Trace),
            ("{\"limits\":{},\"activities\":[]}", Kind::Instance),
            ("{\"format\": \"cotama-team-assignment/1\",", Kind::Team),
            ("# lamp\nnet lamp\ntr on off -> lit", Kind::Tina),
        ];
        for (text, expected) in cases {
            assert_eq!(kind(text), Some(expected), "{text}");
        }
        for unclear in ["", "{}", "<svg/>", "net = 1", "format = 'other/1'", "hello"] {
            assert_eq!(kind(unclear), None, "{unclear}");
        }
    }
}
