//! The text of a map.

use crate::yaml::{self, Expected, Node, Tree, Value, number, truth};
use cotama_models::missions::MissionErrors;
use cotama_models::reading::{Diagnostic, Position, Sink, quoted, unknown};
use std::fmt;
use std::path::{Path, PathBuf};

/// The longest text, in bytes.
pub const MAX_TEXT: usize = 64 << 10;

/// How greys become values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Free, occupied, or unknown.
    Trinary,
    /// Parts of 100 between the thresholds.
    Scale,
    /// The grey itself.
    Raw,
}

/// The text of a map: which image, where it lies, and what its greys mean.
#[derive(Clone, Debug, PartialEq)]
pub struct Metadata {
    /// Path of the image, as it is written.
    pub image: String,
    /// Side of a cell in metres.
    pub resolution: f64,
    /// The left lower corner: x and y in metres, and the yaw in radians, which is not used.
    pub origin: [f64; 3],
    /// Whether white is occupied.
    pub negate: bool,
    /// How greys become values.
    pub mode: Mode,
    /// From here on a cell is occupied, from 0 (white) to 1 (black).
    pub occupied_thresh: f64,
    /// Up to here a cell is free.
    pub free_thresh: f64,
}

/// A fact about a text that was read, but perhaps not as it was meant.
///
/// Its `Display` is `file:line:column: warning: message`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The name of the file, as the caller gave it.
    pub source_name: String,
    /// The place.
    pub position: Position,
    /// The fact.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Position { line, column } = self.position;
        write!(f, "{}:{line}:{column}: warning: {}", self.source_name, self.message)
    }
}

const KEYS: [&str; 7] =
    ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"];

const EXPECTED: Expected = Expected {
    text: "the text of a map",
    example: "write `image: map.pgm` and so on, a line each",
};

impl Metadata {
    /// Reads the text of a map. `source_name` is its name in messages.
    ///
    /// # Errors
    /// All errors of the text, with their places.
    pub fn parse(source_name: &str, text: &str) -> Result<(Self, Vec<Warning>), MissionErrors> {
        let read = |tree: &Tree, whole, sink: &Sink| read((source_name, text), tree, whole, sink);
        yaml::parse((source_name, text), MAX_TEXT, EXPECTED, read)
    }

    /// Returns the path of the image, given that of the text.
    ///
    /// ```
    /// # use cotama_floor::map_server::Metadata;
    /// # let text = "image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: no\n\
    /// #             occupied_thresh: 0.6\nfree_thresh: 0.2\n";
    /// let (metadata, _) = Metadata::parse("maps/a.yaml", text).unwrap();
    /// assert_eq!(metadata.image_path("maps/a.yaml".as_ref()).to_str(), Some("maps/a.pgm"));
    /// ```
    pub fn image_path(&self, of_text: &Path) -> PathBuf {
        of_text.parent().unwrap_or(Path::new("")).join(&self.image)
    }
}

fn read(
    (source_name, text): (&str, &str),
    tree: &Tree,
    whole: usize,
    sink: &Sink,
) -> Option<(Metadata, Vec<Warning>)> {
    let entries = tree.entries(whole, EXPECTED, sink)?;
    let mut keys = Keys { tree, entries, sink, missing: Vec::new() };
    let image = keys.text("image");
    let resolution = keys.resolution();
    let origin = keys.origin();
    let free_thresh = keys.number("free_thresh");
    let occupied_thresh = keys.number("occupied_thresh");
    let mode = keys.mode();
    let negate = keys.negate();
    let others = keys.finish();
    let metadata = Metadata {
        image: image?,
        resolution: resolution?,
        origin: origin?,
        negate: negate?,
        mode: mode?,
        occupied_thresh: occupied_thresh?,
        free_thresh: free_thresh?,
    };
    let warning = |at: usize, message: String| Warning {
        source_name: source_name.into(),
        position: Position::of(text, at),
        message,
    };
    let place = |key: &str| keys.get(key).map_or(0, |it| it.span.start);
    let mut warnings: Vec<_> = others.into_iter().map(|it| warning(it.0, it.1)).collect();
    if metadata.origin[2] != 0.0 {
        let message = format!("the yaw {} is not used; turn the image", metadata.origin[2]);
        warnings.push(warning(place("origin"), message));
    }
    if metadata.occupied_thresh <= metadata.free_thresh && metadata.mode != Mode::Raw {
        let message = "`occupied_thresh` is not above `free_thresh`: free wins".to_owned();
        warnings.push(warning(place("occupied_thresh"), message));
    }
    warnings.sort_by_key(|it| it.position);
    Some((metadata, warnings))
}

struct Keys<'t> {
    tree: &'t Tree,
    entries: Vec<(&'t Node, &'t Node)>,
    sink: &'t Sink,
    missing: Vec<&'static str>,
}

fn name(key: &Node) -> &str {
    if let Value::Text(name) = &key.value { name } else { "" }
}

impl<'t> Keys<'t> {
    /// The value of a key; of several ones the first.
    fn get(&self, key: &str) -> Option<&'t Node> {
        self.entries.iter().find(|it| name(it.0) == key).map(|it| it.1)
    }

    fn required(&mut self, key: &'static str) -> Option<&'t Node> {
        let node = self.get(key);
        if node.is_none() {
            self.missing.push(key);
        }
        node
    }

    fn wrong(&self, node: &Node, key: &str, expected: &str, help: &str) {
        node.wrong(key, expected, help, self.sink);
    }

    fn text(&mut self, key: &'static str) -> Option<String> {
        let node = self.required(key)?;
        match &node.value {
            Value::Text(text) if !text.is_empty() => Some(text.clone()),
            _ => {
                self.wrong(node, key, "a path", "write the path of the image");
                None
            }
        }
    }

    fn number_of(&self, node: &Node, key: &str) -> Option<f64> {
        let number = if let Value::Text(text) = &node.value { number(text) } else { None };
        if number.is_none() {
            self.wrong(node, key, "a decimal number", "write it with digits and a point");
        }
        number
    }

    fn number(&mut self, key: &'static str) -> Option<f64> {
        let node = self.required(key)?;
        self.number_of(node, key)
    }

    fn resolution(&mut self) -> Option<f64> {
        let node = self.required("resolution")?;
        let it = self.number_of(node, "resolution")?;
        if (0.001..=10.0).contains(&it) {
            return Some(it);
        }
        self.wrong(node, "resolution", "0.001 to 10 (m)", "give the side of a cell in metres");
        None
    }

    fn origin(&mut self) -> Option<[f64; 3]> {
        const HELP: &str = "write x and y in metres and the yaw: `origin: [-1.0, -2.0, 0.0]`";
        let node = self.required("origin")?;
        let Value::List(items) = &node.value else {
            self.wrong(node, "origin", "a list of 3", HELP);
            return None;
        };
        if items.len() != 3 {
            self.wrong(node, "origin", "a list of 3", HELP);
            return None;
        }
        let nodes: Vec<_> = items.iter().filter_map(|it| self.tree.get(*it)).collect();
        let all: Vec<_> = nodes.iter().map(|it| self.number_of(it, "origin")).collect();
        let all: [f64; 3] = all.into_iter().collect::<Option<Vec<_>>>()?.try_into().ok()?;
        let far = all.iter().take(2).position(|it| !(-1e6..=1e6).contains(it));
        if let Some(node) = far.and_then(|it| nodes.get(it)) {
            self.wrong(node, "origin", "-1000000 to 1000000 (m)", "use a nearer origin");
            return None;
        }
        Some(all)
    }

    fn mode(&self) -> Option<Mode> {
        let Some(node) = self.get("mode") else { return Some(Mode::Trinary) };
        let Value::Text(text) = &node.value else {
            self.wrong(node, "mode", "a word", "write `trinary`, `scale` or `raw`");
            return None;
        };
        match text.to_ascii_lowercase().as_str() {
            "trinary" => Some(Mode::Trinary),
            "scale" => Some(Mode::Scale),
            "raw" => Some(Mode::Raw),
            _ => {
                let known = ["trinary", "scale", "raw"].into_iter();
                let (message, help) = unknown("mode", text, known);
                let it = Diagnostic::new(node.span.clone(), message, "not known");
                self.sink.report(it.help(help));
                None
            }
        }
    }

    fn negate(&mut self) -> Option<bool> {
        let node = self.required("negate")?;
        let it = if let Value::Text(text) = &node.value { truth(text) } else { None };
        if it.is_none() {
            self.wrong(node, "negate", "0 or 1", "write 0 if black is occupied, else 1");
        }
        it
    }

    /// Reports the keys that are missing, and returns those that nobody reads.
    fn finish(&mut self) -> Vec<(usize, String)> {
        let mut others = Vec::new();
        for (at, (key, _)) in self.entries.iter().enumerate() {
            let said = name(key);
            if KEYS.contains(&said) {
                if self.entries.iter().take(at).any(|it| name(it.0) == said) {
                    others.push((key.span.start, format!("`{said}` is there twice: first wins")));
                }
                continue;
            }
            let (message, help) = unknown("key", said, self.missing.iter().copied());
            // With a near one that is missing it is an error, and only one.
            let near = self.missing.iter().position(|it| help == format!("write `{it}`"));
            let Some(near) = near else {
                others.push((key.span.start, format!("the key {} is not read", quoted(said))));
                continue;
            };
            self.missing.remove(near);
            self.sink.report(Diagnostic::new(key.span.clone(), message, "not known").help(help));
        }
        for key in &self.missing {
            let it = Diagnostic::new(0..0, format!("missing key `{key}`"), "not here");
            self.sink.report(it.help(format!("add a line `{key}: ..`")));
        }
        others
    }
}
