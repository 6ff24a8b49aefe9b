//! The page in which a system is played: one file, with all that it needs.

use super::coded::encode;
use super::letters::base64;
use super::outing::Outing;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use core::fmt::Write as _;
use cotama_core::net::{EventId, Net, PlaceId, Role, TransitionId};
use cotama_core::system::{Component, Delivery, Link, Of, System};
use cotama_core::text::{json as json_text, markup};
use cotama_core::units::Millis;
use cotama_drawing::figure::Style;
use cotama_drawing::page::{THEME, write as framed};
use cotama_drawing::svg::{Highlight, Part, STYLE, part, parts};
use cotama_models::robots::Robot;
use cotama_models::robots::supervisors::Step;
use cotama_play::{NotPlayed, Numbered};
use serde_json::{Value, json};

/// The module: this crate as built by `module/build.sh`.
const MODULE: &[u8] = include_bytes!("../module/module.wasm");
/// Larger nets are listed and not drawn: nobody would find anything.
const LARGEST: usize = 500;

const STYLES: [&str; 3] = [THEME, STYLE, include_str!("../page/page.css")];
const SCRIPTS: [&str; 13] = [
    include_str!("../page/engine.js"),
    include_str!("../page/elements.js"),
    include_str!("../page/drawing.js"),
    include_str!("../page/link.js"),
    include_str!("../page/files.js"),
    include_str!("../page/lists.js"),
    include_str!("../page/verdicts.js"),
    include_str!("../page/play.js"),
    include_str!("../page/switches.js"),
    include_str!("../page/robot.js"),
    include_str!("../page/axis.js"),
    include_str!("../page/course.js"),
    include_str!("../page/main.js"),
];

/// A model to be played.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'s> {
    /// The name that the program knows it by; empty where no other command plays it.
    pub command: &'s str,
    /// The robot whose supervisors they are, with the objectives of its mission.
    pub robot: Option<(&'s Robot, &'s [Step])>,
    /// The mission under a plan of faults.
    pub outing: Option<&'s Outing>,
    /// A note above all else; may be empty.
    pub note: &'s str,
}

/// Writes the page of a system, or of a net alone. No name in it can do anything: they reach the
/// page as text and as JSON.
///
/// ```
/// use cotama_core::system::{Component, System};
/// use cotama_models::nets::door;
/// use cotama_playground::{Subject, write};
/// let door = Subject { command: "door", robot: None, outing: None, note: "" };
/// let page = write(&door, &System::alone(&[Component::alone(&door::NET)]));
/// assert!(page.unwrap().starts_with("<!DOCTYPE html>"));
/// ```
///
/// # Errors
/// Why it cannot be played.
pub fn write(subject: &Subject<'_>, system: &System<'_>) -> Result<String, NotPlayed> {
    let numbered = Numbered::of(system);
    numbered.play(Millis(0), &mut |_, _| ())?;
    let by_name = numbered.is_plain();
    let numbered = if by_name { numbered.choosing(|_| true, Millis(0)) } else { numbered };
    let drawings: Vec<Option<Part>> =
        system.components.iter().enumerate().map(|(at, it)| drawn(it.net, at)).collect();
    let data = data(subject, system, &numbered, by_name, &drawings);
    // In JSON a `<` stands in texts alone, where its code means the same; so no text ends a script.
    let data = json_text(&data.to_string()).to_string().replace('<', "\\u003c");
    let mut body = format!("<main class=\"play\">\n<h1>{}</h1>\n", markup(system.name));
    if !system.doc.is_empty() {
        put(&mut body, format_args!("<p class=\"doc\">{}</p>\n", markup(system.doc)));
    }
    if !subject.note.is_empty() {
        put(&mut body, format_args!("<p class=\"doc\">{}</p>\n", markup(subject.note)));
    }
    let floor = subject.outing.and_then(|it| it.floor.as_ref());
    let drawn = floor.map_or_else(String::new, |it| format!("<div id=\"plane\">{}</div>", it[0]));
    body += &include_str!("../page/page.html").replace("<!--plane-->", &drawn);
    body += "<section id=\"nets\" aria-label=\"Drawings\">\n";
    for (at, (component, drawing)) in system.components.iter().zip(&drawings).enumerate() {
        body += &section(at, component, drawing.as_ref());
    }
    body += "</section>\n</main>\n";
    put(&mut body, format_args!("<script type=\"application/json\" id=\"data\">{data}</script>\n"));
    body += "<script>\n(function () {\n\"use strict\";\n";
    SCRIPTS.iter().for_each(|it| body += it);
    body += "}());\n</script>\n";
    let mut styles = Vec::from(STYLES);
    styles.extend(floor.map(|it| it[1].as_str()));
    Ok(framed(&format!("{}: played", system.name), &styles, &body))
}

fn put(out: &mut String, text: core::fmt::Arguments<'_>) {
    // Writing into a string cannot fail.
    let _ = out.write_fmt(text);
}

fn drawn(net: &Net<'_>, at: usize) -> Option<Part> {
    let parts = net.places.len() + net.transitions.len();
    let prefix = format!("n{at}-");
    (parts <= LARGEST).then(|| part(net, Style::Auto, &Highlight::default(), &prefix))
}

/// The drawing of a net under its name.
fn section(at: usize, component: &Component<'_>, drawing: Option<&Part>) -> String {
    let (name, doc) = (markup(component.name), markup(component.net.doc));
    let mut out = format!(
        "<details class=\"net\" id=\"net-{at}\" open=\"open\"><summary>{name} \
         <span class=\"note\">{doc}</span></summary>\n"
    );
    match drawing {
        Some(Part { width, height, text }) => {
            put(
                &mut out,
                format_args!(
                    "<div class=\"scroll\">\
                 <svg xmlns=\"http://www.w3.org/2000/svg\" class=\"cotama\" \
                 width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
                 role=\"group\" aria-label=\"{name}\">\n{text}</svg></div>\n"
                ),
            );
        }
        None => out += "<p class=\"note\">Too large to be drawn.</p>\n",
    }
    out + "</details>\n"
}

fn data(
    subject: &Subject<'_>,
    system: &System<'_>,
    numbered: &Numbered,
    by_name: bool,
    drawings: &[Option<Part>],
) -> Value {
    let view = numbered.whole().view();
    let net = view.net();
    let place = |(at, it): (usize, &cotama_core::net::Place<'_>)| {
        let shown = at < numbered.shown_places() && !matches!(it.role, Role::Complement(_));
        json!([it.name, shown, u32::from(it.role == Role::Mailbox)])
    };
    let nets = system.components.iter().zip(drawings).enumerate().map(|(at, (it, drawing))| {
        let component = at as u16;
        let place = |id: u32| numbered.place(Of { component, id: PlaceId(id) }).map(|it| it.0);
        let drawn = if drawing.is_some() { parts(it.net, Style::Auto) } else { Vec::new() };
        json!({
            "name": it.name,
            "first": numbered.first_transition(at).map(|it| it.0),
            "places": (0..it.net.places.len() as u32).map(place).collect::<Vec<_>>(),
            "parts": drawn,
        })
    });
    let transitions = (0..net.transitions.len() as u32).map(|id| {
        let (event, cause) = answers(system, numbered, TransitionId(id));
        json!([numbered.transition(TransitionId(id)), event, cause])
    });
    json!({
        "command": subject.command,
        "robot": subject.robot.map(|(robot, steps)| super::robot::data(robot, steps, numbered)),
        "outing": subject.outing.map(Outing::data),
        "name": system.name,
        "system": numbered.is_system(),
        "mail": system.links.iter().any(|it| matches!(it.delivery, Delivery::Mail { .. })),
        "by_name": by_name,
        "places": net.places.iter().enumerate().map(place).collect::<Vec<_>>(),
        "events": net.events.iter().map(|it| json!([it.name, it.doc])).collect::<Vec<_>>(),
        "outputs": net.outputs.iter().map(|it| it.name).collect::<Vec<_>>(),
        "transitions": transitions.collect::<Vec<_>>(),
        "nets": nets.collect::<Vec<_>>(),
        "model": base64(&encode(system)),
        "module": base64(MODULE),
    })
}

/// The event from outside that a transition answers, if any, and in words what else makes it fire.
fn answers(
    system: &System<'_>,
    numbered: &Numbered,
    id: TransitionId,
) -> (Option<u32>, Option<String>) {
    if let Some(EventId(choice)) = numbered.choice(id) {
        return (Some(choice), None);
    }
    let nets = system.components.len();
    let after = (0..nets).find(|&at| numbered.first_transition(at + 1).is_none_or(|it| it > id));
    let Some(at) = after else { return (None, None) };
    let Some(TransitionId(first)) = numbered.first_transition(at) else { return (None, None) };
    let net = system.components[at].net;
    let Some(it) = net.transitions.get((id.0 - first) as usize) else { return (None, None) };
    let Some(event) = it.on else {
        let why = match it.within {
            None => "fires by itself, as soon as it is enabled".into(),
            Some(within) => format!("fires by itself, {} ms after it is enabled", within.earliest),
        };
        return (None, Some(why));
    };
    let of = Of { component: at as u16, id: event };
    if let Some(EventId(event)) = numbered.event(of) {
        return (Some(event), None);
    }
    let from = system.links.iter().filter(|it| it.to == of).filter_map(|it| said(system, it));
    let from: Vec<String> = from.collect();
    let name = net.events.get(event.0 as usize).map_or("?", |it| it.name);
    (None, Some(format!("answers {name}, which other nets say: {}", from.join(", "))))
}

/// The name of the output of a link.
fn said(system: &System<'_>, link: &Link) -> Option<String> {
    let from = system.components.get(usize::from(link.from.component))?;
    let output = from.net.outputs.get(link.from.id.0 as usize)?;
    Some(format!("{}.{}", from.name, output.name))
}
