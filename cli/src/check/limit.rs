//! Teams whose protocol is too large for a net: each requirement is unknown, and why.

use super::{junit, sarif};
use crate::answers::check::{CheckAnswer, EvidenceName, ResultRow, VerdictName};
use crate::args::CheckArgs;
use crate::exit::{Exit, Failure};
use crate::output::{self, Screen};
use crate::render;
use crate::team::{self, Chosen, Protocol};
use cotama_models::team::protocol::REQUIREMENTS;
use cotama_verification::property::mcc;

/// Why there is no net of the team that is to be checked; `None` where there is one, or it is
/// another model.
pub(super) fn of(args: &CheckArgs) -> Result<Option<String>, Failure> {
    let Some(team) = Chosen::of(&args.model)? else { return Ok(None) };
    let scenario = team.scenario();
    Ok(Protocol::of(&scenario).is_none().then(|| team::too_large(&scenario)))
}

/// Says that nothing is known.
pub(super) fn told(args: &CheckArgs, why: &str, screen: &Screen) -> Result<Exit, Failure> {
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
    let own = REQUIREMENTS.iter().map(|it| row(it.0, Some(it.0.into()), Some(it.1.into())));
    let asked = args.property.iter().chain(&args.properties).map(|it| row(it, None, None));
    let is_usual = args.property.is_empty() && args.properties.is_none();
    let results: Vec<_> = if is_usual { own.collect() } else { asked.collect() };
    let answer = CheckAnswer {
        schema: "cotama/check/1",
        model: args.model.clone(),
        timed: false,
        time_unit: None,
        semantics: None,
        notes: vec![why.to_owned()],
        left_out: Vec::new(),
        interrupted: None,
        results,
        otherwise: Vec::new(),
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
