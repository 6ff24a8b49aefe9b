//! SCXML in the dialect of SCAN: typed data, no foreign attributes, a target for every transition,
//! delays as numbers, no cancelling. A chart needs a process list, and somebody who sends its
//! events and takes its outputs.

use anyhow::Context;
use quick_xml::events::{BytesStart, BytesText, Event};
use quick_xml::{Reader, Writer, XmlVersion};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

const ENVIRONMENT: &str = "environment";

pub fn read(text: &str, folder: &Path) -> anyhow::Result<String> {
    let mut reader = Reader::from_str(text);
    let mut writer = Writer::new(Vec::new());
    let mut dialect = Dialect::default();
    loop {
        match reader.read_event()? {
            Event::Eof => break,
            Event::Comment(_) => {}
            Event::Start(tag) => writer.write_event(Event::Start(dialect.tag(&tag)?))?,
            Event::Empty(tag) if tag.name().as_ref() == "cancel" => {
                dialect.changes.insert("<cancel>: left out, so a timer outlives its state");
            }
            Event::Empty(tag) => {
                let tag = dialect.tag(&tag)?;
                if let Some(annotation) = dialect.annotation.take() {
                    writer.write_event(Event::Comment(BytesText::from_escaped(annotation)))?;
                }
                writer.write_event(Event::Empty(tag))?;
            }
            event => writer.write_event(event)?,
        }
    }
    let name = dialect.name;
    fs::write(folder.join("chart.scxml"), writer.into_inner())?;
    fs::write(folder.join("environment.scxml"), environment(&name, &dialect.events)?)?;
    let process = |id: &str, file: &str| {
        format!("<process id=\"{id}\" moc=\"fsm\" path=\"./{file}.scxml\"/>")
    };
    let list = process(&name, "chart") + &process(ENVIRONMENT, "environment");
    let main =
        format!("<specification><model><processList>{list}</processList></model></specification>");
    let file = folder.join("main.xml");
    fs::write(&file, main)?;
    scan_scxml::load(&file, &[], true)?;
    Ok(dialect.changes.iter().fold(String::new(), |said, it| said + "  " + it + "\n"))
}

#[derive(Default)]
struct Dialect {
    name: String,
    state: String,
    events: BTreeSet<String>,
    /// The type of the data that comes next.
    annotation: Option<String>,
    changes: BTreeSet<&'static str>,
}

impl Dialect {
    fn tag(&mut self, tag: &BytesStart<'_>) -> anyhow::Result<BytesStart<'static>> {
        let element = tag.name().as_ref().to_owned();
        let mut attributes = Vec::new();
        for attribute in tag.attributes() {
            let attribute = attribute?;
            let key = attribute.key.as_ref().to_owned();
            let value = attribute.normalized_value(XmlVersion::Explicit1_0)?.into_owned();
            match (element.as_str(), key.as_str()) {
                (_, key) if key.contains("cotama") => {}
                ("send", "id") => {}
                ("send", "delay") => {
                    self.changes.insert("delay: a number without a unit");
                    attributes.push((
                        key,
                        value.strip_suffix("ms").context("a delay not in ms")?.to_owned(),
                    ));
                }
                ("send", "target") => attributes.push((key, ENVIRONMENT.to_owned())),
                _ => attributes.push((key, value)),
            }
        }
        let get = |key: &str| attributes.iter().find(|it| it.0 == key).map(|it| it.1.clone());
        match element.as_str() {
            "scxml" => self.name = get("name").context("a chart without a name")?,
            "state" => self.state = get("id").context("a state without an id")?,
            "data" => {
                let kind = if get("expr").is_some_and(|it| it.parse::<u32>().is_ok()) {
                    "int32"
                } else {
                    "boolean"
                };
                self.annotation =
                    Some(format!(" TYPE {}:{kind} ", get("id").context("data without an id")?));
                self.changes.insert("<data>: a comment with the type before it");
            }
            "transition" => {
                self.events.extend(get("event"));
                if get("target").is_none() {
                    self.changes.insert(
                        "<transition> without a target: one to its own state, so timers \
                            start again",
                    );
                    attributes.push(("target".to_owned(), self.state.clone()));
                }
            }
            _ => {}
        }
        let attributes = attributes.iter().map(|(key, value)| (key.as_str(), value.as_str()));
        Ok(BytesStart::new(element).with_attributes(attributes))
    }
}

/// A chart that sends each event once, one after the other, then stops.
fn environment(chart: &str, events: &BTreeSet<String>) -> anyhow::Result<String> {
    let mut text =
        String::from("<scxml xmlns=\"http://www.w3.org/2005/07/scxml\" version=\"1.0\" ");
    writeln!(text, "datamodel=\"ecmascript\" name=\"{ENVIRONMENT}\" initial=\"s0\">")?;
    for (number, event) in events.iter().enumerate() {
        let send = format!("<send event=\"{event}\" target=\"{chart}\"/>");
        let next = number + 1;
        writeln!(
            text,
            "<state id=\"s{number}\"><transition target=\"s{next}\">{send}</transition></state>"
        )?;
    }
    writeln!(text, "<state id=\"s{}\"/>\n</scxml>", events.len())?;
    Ok(text)
}
