//! Models that are too large for one net, teams and systems: each question is unknown, and why.

use super::{junit, sarif};
use crate::answers::check::{CheckAnswer, EvidenceName, ResultRow, VerdictName};
use crate::args::{CheckArgs, Semantics};
use crate::exit::{Exit, Failure};
use crate::output::{self, Screen};
use crate::render;
use crate::subject::TooLarge;
use crate::team::{self, Chosen, Protocol};
use cotama_models::team::protocol::REQUIREMENTS;
use cotama_verification::property::mcc;
use std::borrow::Cow;

/// The questions to a net without laws and requirements.
const USUAL: [&str; 3] = ["deadlock_free", "one_safe", "quasi_live"];

/// A model without a net.
pub(super) struct Limit {
    why: String,
    semantics: Option<Semantics>,
    /// The numbers and sentences of its requirements.
    required: Vec<(Cow<'static, str>, Cow<'static, str>)>,
}

impl From<TooLarge> for Limit {
    fn from(TooLarge { why, semantics, required }: TooLarge) -> Self {
        let required = required.into_iter().map(|it| (it.id.into(), it.sentence.into()));
        Self { why, semantics, required: required.collect() }
    }
}

/// Why there is no net of the team that is to be checked; `None` where there is one, or it is
/// another model.
pub(super) fn of(args: &CheckArgs) -> Result<Option<Limit>, Failure> {
    let Some(team) = Chosen::of(&args.model)? else { return Ok(None) };
    let scenario = team.scenario();
    let required = REQUIREMENTS.iter().map(|it| (it.0.into(), it.1.into())).collect();
    Ok(Protocol::of(&scenario).is_none().then(|| {
        let (why, semantics) = (team::too_large(&scenario), None);
        Limit { why, semantics, required }
    }))
}

/// Says that nothing is known.
pub(super) fn told(args: &CheckArgs, limit: &Limit, screen: &Screen) -> Result<Exit, Failure> {
    let why = &limit.why;
    let row = |name: &str, id, sentence| ResultRow {
        name: name.to_owned(),
        id,
        sentence,
        property: name.to_owned(),
        verdict: VerdictName::Unknown,
        reason: Some(why.to_owned()),
        way_out: None,
        bound: None,
        response: None,
        engine: "none".to_owned(),
        techniques: Vec::new(),
        states: 0,
        evidence: EvidenceName::None,
        certificate: None,
        seconds: 0.0,
        vacuous: None,
        cause: None,
        trace: None,
        rest: None,
        unused: None,
    };
    let is_usual = args.property.is_empty() && args.properties.is_none();
    let results: Vec<_> = if !is_usual {
        args.property.iter().chain(&args.properties).map(|it| row(it, None, None)).collect()
    } else if limit.required.is_empty() {
        USUAL.iter().map(|it| row(it, None, None)).collect()
    } else {
        let own = |(id, sentence): &(Cow<'static, str>, Cow<'static, str>)| {
            row(id, Some(id.clone()), Some(sentence.clone()))
        };
        limit.required.iter().map(own).collect()
    };
    let answer = CheckAnswer {
        schema: "cotama/check/1",
        model: args.model.clone(),
        timed: false,
        time_unit: None,
        semantics: limit.semantics,
        notes: vec![why.to_owned()],
        left_out: Vec::new(),
        interrupted: None,
        results,
    };
    for (file, text) in [(&args.junit, junit::text(&answer)), (&args.sarif, sarif::text(&answer))] {
        if let Some(path) = file {
            output::file(path, text.as_bytes())?;
        }
    }
    if args.mcc {
        let line = |it: &ResultRow| mcc::answer(&it.name, mcc::Answer::Unknown, &[]) + "\n";
        Screen::raw(answer.results.iter().map(line).collect::<String>().as_bytes())?;
    } else if args.json.json {
        Screen::json(&answer)?;
    } else {
        let mut text = render::check::head(&answer.model, false, &answer.notes, screen.width());
        // The note of the head says why.
        for row in &answer.results {
            let row = ResultRow { reason: None, ..row.clone() };
            text += &render::check::result(&row, is_usual, None, screen.width());
        }
        screen.print(&text)?;
    }
    Ok(Exit::Unknown)
}
