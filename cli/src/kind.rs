//! The kind of a file, as far as its beginning tells: so that a file of another kind leads to the
//! command that reads it, and not to an error in every line.

use crate::catalogue;
use crate::exit::Failure;
use crate::foreign::{self, Foreign};
use crate::input;
use crate::names::quoted;
use cotama_models::missions::embedded;
use std::io::Read;

/// A kind of file that some command reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Mission,
    /// A mission with performance axes of its own.
    Axes,
    Faults,
    Pnml,
    /// A property file of the Model Checking Contest.
    Properties,
    JsonNet,
    JsonSystem,
    Tina,
    Certificate,
    Trace,
    /// A recorded run, with a line of JSON for each thing that happened.
    Recording,
    Instance,
    Team,
    /// A team at work.
    TeamAtWork,
    TeamFaults,
    TeamTrace,
    Fmeca,
    /// Measured detections of a robot's failures.
    Measurement,
    /// Margins learned from runs.
    Margins,
    Robot,
    Floor,
    /// A behaviour tree of BehaviorTree.CPP.
    Tree,
}

/// The kinds that hold a model.
pub(crate) const MODELS: [Kind; 6] =
    [Kind::Pnml, Kind::JsonNet, Kind::JsonSystem, Kind::Tina, Kind::TeamAtWork, Kind::Robot];
/// So many bytes tell.
const LOOKED_AT: usize = 64 << 10;

impl Kind {
    /// The kind of a file that begins so, if that is clear.
    fn of(bytes: &[u8]) -> Option<Self> {
        let start = beginning(bytes);
        let start = start.as_str();
        if start.starts_with('<') {
            return match foreign::root(start)? {
                "pnml" => Some(Self::Pnml),
                "property-set" => Some(Self::Properties),
                "root" | "BehaviorTree" | "TreeNodesModel" => Some(Self::Tree),
                _ => None,
            };
        }
        if start.starts_with('{') {
            return Self::of_json(start);
        }
        let mut lines = start.lines().map(str::trim_start);
        let format = lines.clone().find_map(|it| it.strip_prefix("format"));
        let value = format.and_then(|it| it.trim_start().strip_prefix('=')).map(str::trim_start);
        match value.map(|it| it.trim_start_matches(['"', '\''])) {
            Some(it) if it.starts_with("panorama-mission/") => return Some(Self::Mission),
            Some(it) if it.starts_with("cotama-axes/") => return Some(Self::Axes),
            Some(it) if it.starts_with("panorama-faults/") => return Some(Self::Faults),
            Some(it) if it.starts_with("cotama-fmeca/") => return Some(Self::Fmeca),
            Some(it) if it.starts_with("cotama-measurement/") => return Some(Self::Measurement),
            Some(it) if it.starts_with("cotama-margins/") => return Some(Self::Margins),
            Some(it) if it.starts_with("cotama-team-faults/") => return Some(Self::TeamFaults),
            Some(it) if it.starts_with("cotama-robot/") => return Some(Self::Robot),
            Some(it) if it.starts_with("cotama-floor/") => return Some(Self::Floor),
            Some(it) if it.starts_with("cotama-team/") => return Some(Self::TeamAtWork),
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
            ("cotama-system/", Self::JsonSystem),
            ("cotama-certificate/", Self::Certificate),
            ("cotama-tree-certificate/", Self::Certificate),
            ("cotama-trace/", Self::Trace),
            ("cotama/team-trace/", Self::TeamTrace),
            ("cotama-recording/", Self::Recording),
        ];
        let format = start.split_once("\"format\"").map(|it| it.1.trim_start_matches([':', ' ']));
        let formats = [
            ("\"cotama-team-assignment/", Self::Team),
            ("\"cotama-team/", Self::TeamAtWork),
            ("\"cotama-robot/", Self::Robot),
            ("\"axes-case/", Self::Axes),
            ("\"cotama-axes/", Self::Axes),
        ];
        if let Some(it) = formats.iter().find(|it| format.is_some_and(|is| is.starts_with(it.0))) {
            return Some(it.1);
        }
        let named = start.split_once("\"schema\"").map(|it| it.1.trim_start_matches([':', ' ']));
        let schema = named.map(|it| it.trim_start_matches('"'));
        let known = schema.and_then(|it| schemas.into_iter().find(|known| it.starts_with(known.0)));
        let is_instance =
            schema.is_none() && start.contains("\"limits\"") && start.contains("\"activities\"");
        known.map(|it| it.1).or(is_instance.then_some(Self::Instance))
    }

    /// A few words for it.
    const fn words(self) -> &'static str {
        match self {
            Self::Mission => "a mission",
            Self::Axes => "a mission with axes",
            Self::Faults => "a file of faults",
            Self::Pnml => "PNML, a net",
            Self::Properties => "a property file",
            Self::JsonNet => "a net in JSON",
            Self::JsonSystem => "a system of nets in JSON",
            Self::Tina => "a net of TINA",
            Self::Certificate => "a certificate",
            Self::Trace => "a trace",
            Self::Recording => "a recorded run",
            Self::Fmeca => "an FMECA",
            Self::Measurement => "a measurement",
            Self::Margins => "a file of margins",
            Self::Instance => "an allocation instance",
            Self::Team => "a team with its tasks",
            Self::TeamAtWork => "a team at work",
            Self::TeamFaults => "a file of a team's faults",
            Self::TeamTrace => "the trace of a team",
            Self::Robot => "a robot",
            Self::Floor => "a floor",
            Self::Tree => "a behaviour tree",
        }
    }

    /// Returns a hint at the source of such a file.
    const fn origin(self) -> &'static str {
        match self {
            Self::Mission => "`cotama new mission NAME` begins one",
            Self::Axes => "`cotama new axes NAME` begins one",
            Self::Faults => "one in which nothing goes wrong is `format = \"panorama-faults/1\"`",
            Self::Pnml | Self::JsonNet | Self::JsonSystem | Self::Tina => {
                "`cotama models` lists those that come with the program"
            }
            Self::Properties => "a property a line, as `name: AG !(a & b)`",
            Self::Certificate => "`cotama check MODEL --certificate FILE` writes one",
            Self::Trace => "`cotama run MISSION --trace FILE` writes one",
            Self::Recording => "`cotama help conform` shows one",
            Self::Fmeca => "`cotama new fmeca NAME` begins one",
            Self::Measurement => "`cotama fmeca --measure MISSION --output FILE` writes one",
            Self::Margins => "`cotama risk calibrate RUNS.csv --out FILE` writes one",
            Self::Instance => "`cotama help allocate` shows one",
            Self::Team => "`cotama help assign` shows one",
            Self::TeamAtWork => "`cotama show service` prints one",
            Self::TeamFaults => "`cotama campaign service --out DIR` writes some",
            Self::TeamTrace => "`cotama run fleet --trace FILE` writes one",
            Self::Robot => "`cotama new robot NAME` begins one",
            Self::Floor => "`cotama new floor NAME` begins one",
            Self::Tree => "Groot2 draws one, in the format of BehaviorTree.CPP 4",
        }
    }

    /// The command that reads it.
    fn command(self, file: &str) -> String {
        match self {
            Self::Mission | Self::Axes => format!("cotama plan {file}"),
            Self::Faults => format!("cotama run MISSION --faults {file}"),
            Self::Pnml
            | Self::JsonNet
            | Self::JsonSystem
            | Self::Tina
            | Self::Robot
            | Self::Tree => {
                format!("cotama check {file}")
            }
            Self::Properties => format!("cotama check MODEL --properties {file}"),
            Self::Certificate => format!("cotama verify {file}"),
            Self::Trace | Self::TeamTrace | Self::TeamFaults => format!("cotama replay {file}"),
            Self::Recording => format!("cotama conform MODEL {file}"),
            Self::Fmeca => format!("cotama fmeca {file}"),
            Self::Measurement => format!("cotama fmeca --measured {file}"),
            Self::Margins => format!("cotama run MISSION --margins {file}"),
            Self::Floor => format!("cotama floor {file}"),
            Self::Instance => format!("cotama allocate {file}"),
            Self::Team => format!("cotama assign {file}"),
            Self::TeamAtWork => format!("cotama run {file}"),
        }
    }
}

/// The text of a file of one of these kinds, or of standard input for `-`; `what` says what it
/// should be.
pub(crate) fn text(path: &str, what: &str, limit: u64, wanted: &[Kind]) -> Result<String, Failure> {
    let bytes = input::bytes(path, what, limit)?;
    expect(path, &bytes, what, wanted)?;
    input::utf8(path, what, bytes)
}

/// Whether a file is there that begins as one of this kind.
pub(crate) fn is(path: &str, kind: Kind) -> bool {
    let mut start = Vec::new();
    let read =
        std::fs::File::open(path).and_then(|it| it.take(LOOKED_AT as u64).read_to_end(&mut start));
    read.is_ok() && Kind::of(&start) == Some(kind)
}

/// Whether a text begins as one of this kind.
pub(crate) fn is_of(text: impl AsRef<[u8]>, kind: Kind) -> bool {
    Kind::of(text.as_ref()) == Some(kind)
}

/// Refuses a file that is empty, of another tool, or clearly of a kind that is not read here;
/// `what` says what is.
pub(crate) fn expect(path: &str, bytes: &[u8], what: &str, wanted: &[Kind]) -> Result<(), Failure> {
    let refused = |is: &str, help: String| {
        let message = format!("this is {is}, and {what} is needed here");
        Err(Failure::of(input::name(path), message).help(help))
    };
    let start = beginning(bytes);
    if is_empty(bytes) {
        return refused("empty", wanted.first().map_or("", |it| it.origin()).to_owned());
    }
    if let Some(Foreign { is, out }) = foreign::of_bytes(bytes).or_else(|| foreign::of_text(&start))
    {
        return refused(is, out.to_owned());
    }
    if let Some(kind) = Kind::of(bytes).filter(|it| !wanted.contains(it)) {
        let help = match (path, kind) {
            // What was read of standard input is gone.
            ("-", Kind::Axes) => "one is read from a file: `cotama plan CASE.json`".into(),
            ("-", Kind::TeamAtWork) => "a team is read from a file: `cotama run TEAM.toml`".into(),
            _ => format!("try `{}`", kind.command(&quoted(path))),
        };
        return refused(kind.words(), help);
    }
    let is_toml =
        |it: &Kind| matches!(it, Kind::Mission | Kind::Faults | Kind::TeamAtWork | Kind::Robot);
    let is_toml = !wanted.is_empty() && wanted.iter().all(is_toml);
    let reads_yaml = [Kind::Properties, Kind::Fmeca].iter().any(|it| wanted.contains(it));
    if !reads_yaml && foreign::is_yaml(&start) {
        let help =
            if is_toml { "missions are TOML: `key = value`, tables as `[limits]`; " } else { "" };
        let origin = wanted.first().map_or("", |it| it.origin());
        return refused("YAML, it seems", format!("{help}{origin}"));
    }
    if is_toml && start.starts_with('{') && !wanted.contains(&Kind::TeamAtWork) {
        let help = "missions are TOML: `key = value`, tables as `[limits]`; `cotama new mission \
            NAME` begins one";
        return refused("JSON", help.to_owned());
    }
    Ok(())
}

fn is_empty(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.trim_ascii().is_empty()
}

/// The beginning of a file, without a byte order mark and white space.
fn beginning(bytes: &[u8]) -> String {
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(LOOKED_AT)]);
    start.trim_start_matches('\u{feff}').trim_start().to_owned()
}

/// Why the name of a model is none of a plain mission, if it is that of a model, or of a mission
/// with axes.
pub(crate) fn model_for_mission(name: &str) -> Option<Failure> {
    if cotama_axes::embedded(name).is_some() {
        let message = format!("`{name}` is a mission with axes, and a plain one is needed here");
        return Some(Failure::new(message).help(format!("try `cotama plan {name}`")));
    }
    let model = name.split_once(':').map_or(name, |it| it.0);
    catalogue::entry(model)?;
    let failure = Failure::new(format!("`{name}` is a model, and a mission is needed here"));
    Some(failure.help(format!("try `cotama check {name}`, or `cotama list` for the missions")))
}

/// Why the name of a mission is none of a model, if it is a mission's.
pub(crate) fn mission_for_model(name: &str) -> Option<Failure> {
    embedded::mission(name)?;
    let message = format!("`{name}` is a plain mission, and a model is needed here");
    let failure = Failure::new(message);
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
            ("<!-- a --><root BTCPP_format=\"4\">", Kind::Tree),
            ("{\n  \"schema\": \"cotama/net/1\"", Kind::JsonNet),
            ("{\"schema\": \"cotama-system/1\"", Kind::JsonSystem),
            ("{\"schema\":\"cotama-certificate/1\",", Kind::Certificate),
            ("{\"schema\":\"cotama-trace/1\",", Kind::Trace),
            ("{\"schema\":\"cotama/team-trace/2\",", Kind::TeamTrace),
            ("# two rooms\nformat = \"cotama-team/1\"", Kind::TeamAtWork),
            ("{\"limits\":{},\"activities\":[]}", Kind::Instance),
            ("{\"format\": \"cotama-team-assignment/1\",", Kind::Team),
            ("{\"format\": \"axes-case/1\", \"id\": \"a\"", Kind::Axes),
            ("format = 'cotama-axes/1'", Kind::Axes),
            ("{\n \"name\": \"a\",\n \"format\": \"cotama-team/1\"", Kind::TeamAtWork),
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
