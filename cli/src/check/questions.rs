//! The questions: properties from the command line, from a file, or the laws of the model.

use crate::args::CheckArgs;
use crate::exit::Failure;
use crate::file_errors::{FileError, FileErrors, Mark};
use crate::input;
use crate::kind::{self, Kind};
use crate::models::law;
use crate::render::visible;
use crate::subject::Subject;
use cotama_core::net::PlaceId;
use cotama_core::net::owned::OwnedNet;
use cotama_verification::pnml::Location;
use cotama_verification::property::{self, Atom, Formula, Property, PropertyError, Question, mcc};
use cotama_verification::pt::Pt;
use std::borrow::Cow;

/// The questions to a model.
#[derive(Debug, Default)]
pub(super) struct Asked {
    pub(super) properties: Vec<Property>,
    /// Laws that are checked only while a program is compiled.
    pub(super) left_out: Vec<String>,
    /// Whether these are laws, which speak of the net without time.
    pub(super) are_laws: bool,
    /// Whether nobody asked: these are the laws or the usual questions.
    pub(super) is_usual: bool,
    /// The requirements that the properties stand for, one each.
    pub(super) requirements: Vec<Claim>,
    /// For each question, the model with the observers it needs; `None` if it needs none.
    pub(super) watched: Vec<Option<Subject>>,
}

/// A requirement by its number, in a sentence.
#[derive(Clone, Debug)]
pub(super) struct Claim {
    pub(super) id: Cow<'static, str>,
    pub(super) sentence: Cow<'static, str>,
}

/// Returns the questions on the command line or in a file; without either, the laws of the model,
/// or the usual questions.
pub(super) fn asked(args: &CheckArgs, subject: &Subject) -> Result<Asked, Failure> {
    let pt = subject.model.pt();
    let mut properties = Vec::new();
    for text in &args.property {
        properties.push(one(text, args.initial, subject)?);
    }
    if let Some(path) = &args.properties {
        properties.extend(file(path, args.initial, subject)?);
    }
    if !properties.is_empty() {
        return Ok(Asked { properties, ..Asked::default() });
    }
    if !subject.requirements.is_empty() {
        return protocol(subject);
    }
    if subject.rounds.is_some() && !subject.required.is_empty() {
        return self::required(subject);
    }
    let laws = subject.net.as_ref().map(laws).unwrap_or_default();
    if laws.are_laws {
        return Ok(laws);
    }
    Ok(Asked { properties: usual(pt), is_usual: true, ..laws })
}

/// The requirements of the protocol of a team.
fn protocol(subject: &Subject) -> Result<Asked, Failure> {
    let mut asked = Asked { is_usual: true, ..Asked::default() };
    for it in &subject.requirements {
        let property = property::parse(&it.text, subject.model.pt())
            .map_err(|error| Failure::new(format!("{}: {error}", it.id)))?;
        asked.properties.push(Property { name: it.id.to_owned(), ..property });
        asked.requirements.push(Claim { id: it.id.into(), sentence: it.sentence.into() });
    }
    Ok(asked)
}

/// The requirements of the supervisors of a robot.
fn required(subject: &Subject) -> Result<Asked, Failure> {
    let mut asked = Asked { is_usual: true, ..Asked::default() };
    for it in &subject.required {
        let refused = |error: String| Failure::new(format!("{}: {error}", it.id));
        let watched = match &it.watches[..] {
            [] => None,
            all => subject.watched_by(all).map_err(|error| refused(error.to_string()))?,
        };
        let pt = watched.as_ref().unwrap_or(subject).model.pt();
        let property = property::parse(&it.text, pt).map_err(|error| refused(error.to_string()))?;
        asked.properties.push(Property { name: it.id.clone(), ..property });
        let (id, sentence) = (it.id.clone().into(), it.sentence.clone().into());
        asked.requirements.push(Claim { id, sentence });
        asked.watched.push(watched);
    }
    Ok(asked)
}

/// A property that was typed, or a question by its name.
pub(crate) fn one(text: &str, initial: bool, subject: &Subject) -> Result<Property, Failure> {
    let (name, pt) = (text.trim(), subject.model.pt());
    if let Some(known) = mcc::examination(name).filter(|_| pt.place(name).is_none()) {
        return Ok(known);
    }
    parsed(text, initial, subject).map_err(|error| {
        let source = error.source_name.clone();
        let mark = mark(&error, text, 0);
        errors(&source, text.to_owned(), vec![(error, mark)])
    })
}

fn file(path: &str, initial: bool, subject: &Subject) -> Result<Vec<Property>, Failure> {
    const WHAT: &str = "a file of properties";
    let text = kind::text(path, WHAT, input::PROPERTIES_BYTES, &[Kind::Properties])?;
    let name = input::name(path);
    let properties = if text.trim_start().starts_with('<') {
        mcc::read(name, text.as_bytes(), subject.model.pt(), subject.ids()).map_err(|error| {
            let mark = mark(&error, &text, 0);
            errors(name, text, vec![(error, mark)])
        })?
    } else {
        lines(name, text, initial, subject)?
    };
    if properties.is_empty() {
        return Err(Failure::of(name, "there is no property in it").help(
            "one a line, as `name: AG !(a & b)`; or a property file of the Model Checking Contest",
        ));
    }
    Ok(properties)
}

/// One property a line, with a name before a colon or without.
fn lines(
    source: &str,
    text: String,
    initial: bool,
    subject: &Subject,
) -> Result<Vec<Property>, Failure> {
    let (mut properties, mut wrong, mut at) = (Vec::new(), Vec::new(), 0);
    for line in text.split_inclusive('\n') {
        let start = at;
        at += line.len();
        let line = line.trim_end();
        if line.trim_start().is_empty() || line.trim_start().starts_with('#') {
            continue;
        }
        let (name, formula) = named(line);
        match parsed(formula, initial, subject) {
            Ok(property) => {
                let name = name.map_or(property.name, str::to_owned);
                properties.push(Property { name, question: property.question });
            }
            Err(error) => {
                let mark = mark(&error, &text, start + line.len() - formula.len());
                wrong.push((error, mark));
            }
        }
    }
    if !wrong.is_empty() {
        return Err(errors(source, text, wrong));
    }
    Property::tell_apart(&mut properties);
    Ok(properties)
}

/// A property that was typed, named as it is written out. One that speaks of a single marking has
/// to say of which.
fn parsed(text: &str, initial: bool, subject: &Subject) -> Result<Property, PropertyError> {
    let (name, pt) = (text.trim(), subject.model.pt());
    let property = property::parse_with(text, pt, subject.ids())?;
    let is_state = property.question.formula().is_some_and(Formula::is_state);
    let of_the_start = property.question.formula().is_some_and(speaks_of_the_start);
    if (is_state || of_the_start) && !initial {
        let start = text.len() - text.trim_start().len();
        let what = if is_state { "this" } else { "a part of this" };
        let message = format!("{what} speaks of one marking, and no quantifier says of which");
        let is_word = |it: char| it.is_alphanumeric() || matches!(it, '!' | '_' | '.');
        let shown = match visible(name) {
            _ if name.chars().count() > 40 => "(..)".to_owned(),
            name if name.chars().all(is_word) => name,
            name => format!("({name})"),
        };
        let help = match property.question.formula() {
            Some(Formula::Atom(Atom::Deadlock)) => {
                "did you mean `EF deadlock`? some run comes to an end; or `deadlock_free`: none \
                 does; or, with --initial, at the start?"
                    .to_owned()
            }
            _ => format!(
                "did you mean `AG {shown}`? in all markings; or `EF {shown}`: in some marking; \
                 or, with --initial, at the start?"
            ),
        };
        let column = 1 + text[..start].chars().count();
        let at = Location { line: 1, column, span: start..start + name.len() };
        let (source_name, help) = ("property".to_owned(), Some(help));
        return Err(PropertyError { source_name, at, message, help });
    }
    if property.name == "deadlock_free" && property.question == Question::deadlock_free() {
        return Ok(property);
    }
    let name = property.question.display(pt).to_string();
    Ok(Property { name, ..property })
}

/// Whether a part of a formula stands outside of all quantifiers, and is about the first marking.
fn speaks_of_the_start(formula: &Formula) -> bool {
    match formula {
        Formula::Atom(_) => true,
        Formula::Not(inner) => speaks_of_the_start(inner),
        Formula::And(all) | Formula::Or(all) => all.iter().any(speaks_of_the_start),
        _ => false,
    }
}

/// A name before a colon, and what stands after it.
fn named(line: &str) -> (Option<&str>, &str) {
    let is_name = |name: &str| {
        !name.is_empty()
            && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'))
    };
    match line.split_once(':') {
        Some((name, formula)) if is_name(name.trim()) => (Some(name.trim()), formula),
        _ => (None, line),
    }
}

/// Returns the position of an error in a text of which the property begins at this byte.
fn mark(error: &PropertyError, text: &str, start: usize) -> Option<Mark> {
    let span = start + error.at.span.start..start + error.at.span.end;
    let before = text.get(..span.start)?;
    text.get(span.clone())?;
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    let line = 1 + before.bytes().filter(|&byte| byte == b'\n').count();
    Some(Mark { line, column: 1 + before[line_start..].chars().count(), span })
}

/// The errors at their places; as plain words where these are not in the text.
fn errors(source: &str, text: String, wrong: Vec<(PropertyError, Option<Mark>)>) -> Failure {
    const KEPT: usize = 100;
    if let Some((error, _)) = wrong.iter().find(|it| it.1.is_none()) {
        return Failure::new(error.to_string());
    }
    let errors = wrong.into_iter();
    let errors =
        errors.filter_map(|(error, at)| Some(FileError::new(error.message, at?, error.help)));
    let (source, errors) = (source.to_owned(), errors.collect());
    let mut errors = FileErrors { source, text, errors, omitted: 0 }.folded();
    errors.omitted = errors.errors.len().saturating_sub(KEPT);
    errors.errors.truncate(KEPT);
    errors.into()
}

/// The laws of a net.
fn laws(net: &OwnedNet) -> Asked {
    let view = net.view();
    let net = view.net();
    let (mut properties, mut left_out) = (Vec::new(), Vec::new());
    for it in net.laws {
        let name = law::text(&net, it);
        match cotama_verification::check::question(it) {
            Some(question) => properties.push(Property { name, question }),
            None => left_out.push(name),
        }
    }
    let are_laws = !properties.is_empty();
    Asked { properties, left_out, are_laws, is_usual: are_laws, ..Asked::default() }
}

/// Returns the usual questions to a net: is there no deadlock, is it 1-safe, or else how many
/// tokens are there, can each transition fire.
fn usual(pt: &Pt) -> Vec<Property> {
    let property = |name: &str, question| Property { name: name.to_owned(), question };
    let transitions = 0..pt.transitions.len() as u32;
    let one_each = pt.initial.iter().all(|&tokens| tokens <= 1)
        && transitions.flat_map(|it| pt.effects.of(it)).all(|&(_, change)| change.abs() <= 1);
    let tokens = if one_each {
        property("one_safe", Question::OneSafe)
    } else {
        property("bounds", Question::Bound((0..pt.places.len() as u32).map(PlaceId).collect()))
    };
    vec![
        property("deadlock_free", Question::deadlock_free()),
        tokens,
        property("quasi_live", Question::QuasiLiveness),
    ]
}
