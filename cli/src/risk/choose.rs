//! `cotama risk choose`, and the file of its model.

use super::{mistaken, network, refused};
use crate::answers::risk::ChooseAnswer;
use crate::args::{ChoiceRuleName, ChooseArgs, Level, MemoryName};
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input::{self, MISSION_BYTES, folder_of};
use crate::names::near;
use crate::output::Screen;
use crate::render;
use cotama_risk::{ChoiceRule, Measure, Memory, Model, Names, Network, Seen, TWO_WAYS, Wrong};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use toml::Spanned;

/// The model that comes with the program.
const EMBEDDED: &str = "two-ways";

/// A model as it stands in its file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    network: Spanned<String>,
    utility: f64,
    trials: usize,
    choice: Spanned<String>,
    hidden: Spanned<String>,
    #[serde(default)]
    given: BTreeMap<String, Spanned<String>>,
    outcome: Outcome,
    #[serde(default)]
    observed: Vec<Spanned<String>>,
    cost: Cost,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Outcome {
    variable: Spanned<String>,
    success: Spanned<String>,
    failure: Spanned<String>,
}

#[derive(Deserialize)]
struct Cost {
    variable: Spanned<String>,
    #[serde(flatten)]
    bounds: BTreeMap<String, (f64, f64)>,
}

/// Chooses a way.
pub(super) fn choose(args: &ChooseArgs, screen: &Screen) -> Result<Exit, Failure> {
    let model = model(&args.model, screen)?;
    let prior = prior(args, &model)?;
    let failed =
        args.failed.iter().map(|it| trial(it, &model.model)).collect::<Result<Vec<_>, _>>()?;
    let (hidden, model) = (model.hidden, model.model);
    let Some(trials) = model.trials().checked_sub(failed.len()).filter(|it| *it > 0) else {
        let message = format!("--failed: all {} trials of the model are used up", model.trials());
        return Err(Failure::new(message).help("give fewer failed trials"));
    };
    let memory = match args.memory {
        MemoryName::Product => Memory::Product,
        MemoryName::Sum => Memory::Sum,
    };
    let measure = match args.measure {
        Level::Mean => Measure::Mean,
        Level::Quantile(level) => Measure::Quantile(level),
    };
    let (rule, rule_name) = match args.rule {
        ChoiceRuleName::Thesis => (ChoiceRule::Thesis, "thesis"),
        ChoiceRuleName::Exact => (ChoiceRule::Exact, "exact"),
        ChoiceRuleName::Total => (ChoiceRule::Total, "total"),
    };
    let belief = model.belief(&prior, &failed, memory);
    let estimate = model.estimate(&belief, trials, measure, rule);
    let way = |it: usize| model.way(it).to_owned();
    let answer = ChooseAnswer {
        schema: "cotama/risk-choose/1",
        measure: match args.measure {
            Level::Mean => "mean".to_owned(),
            Level::Quantile(level) => level.to_string(),
        },
        rule: rule_name,
        trials: trials as u64,
        belief: model.hidden_states().iter().cloned().zip(belief).collect(),
        costs: estimate.costs.iter().enumerate().map(|(at, it)| (way(at), *it)).collect(),
        choice: way(estimate.way),
        reward: estimate.reward,
        sequence: estimate.sequence.iter().map(|it| way(*it)).collect(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let states = model.hidden_states();
        screen.print(&render::risk::choose(&answer, &hidden, states, screen.width()))?;
    }
    Ok(Exit::Success)
}

/// A model, and the name of what it only believes.
struct Read {
    model: Model,
    hidden: String,
}

fn model(path: &str, screen: &Screen) -> Result<Read, Failure> {
    let what = "a model of a choice";
    let is_embedded = path == EMBEDDED;
    let text =
        if is_embedded { TWO_WAYS.to_owned() } else { input::text(path, what, MISSION_BYTES)? };
    let file: File = toml::from_str(&text).map_err(|error| {
        let at = error.span().map_or(0, |it| it.start);
        located(path, &text, at, error.message().to_owned(), None)
    })?;
    let named = file.network.get_ref();
    let beside = folder_of(Path::new(path)).join(named);
    let network = if is_embedded {
        network(EMBEDDED, screen)?
    } else if Path::new(named).is_relative() && beside.is_file() && path != "-" {
        network(&beside.display().to_string(), screen)?
    } else {
        network(named, screen)?
    };
    check(&file, &network)
        .map_err(|(at, wrong)| located(path, &text, at, wrong.message, wrong.help))?;
    let own = |it: &Spanned<String>| it.get_ref().clone();
    let bound = |(state, it): (&String, &(f64, f64))| (state.clone(), it.0, it.1);
    let names = Names {
        utility: file.utility,
        trials: file.trials,
        choice: own(&file.choice),
        hidden: own(&file.hidden),
        given: file.given.iter().map(|it| (it.0.clone(), own(it.1))).collect(),
        outcome: (
            own(&file.outcome.variable),
            own(&file.outcome.success),
            own(&file.outcome.failure),
        ),
        observed: file.observed.iter().map(own).collect(),
        cost: own(&file.cost.variable),
        bounds: file.cost.bounds.iter().map(bound).collect(),
    };
    let model = Model::new(&network, &names).map_err(|wrong| refused(path, text.clone(), wrong))?;
    Ok(Read { model, hidden: names.hidden })
}

/// The first name that is none of the network, and where it stands.
fn check(file: &File, network: &Network) -> Result<(), (usize, Wrong)> {
    let Outcome { variable, success, failure } = &file.outcome;
    let variables = [&file.choice, &file.hidden, variable, &file.cost.variable];
    for it in variables.into_iter().chain(&file.observed) {
        network.variable(it.get_ref()).map_err(|wrong| (it.span().start, wrong))?;
    }
    for it in [success, failure] {
        let found = network.state(variable.get_ref(), it.get_ref());
        found.map_err(|wrong| (it.span().start, wrong))?;
    }
    for (variable, it) in &file.given {
        let found = network.state(variable, it.get_ref());
        found.map_err(|wrong| (it.span().start, wrong))?;
    }
    for state in file.cost.bounds.keys() {
        let found = network.state(file.cost.variable.get_ref(), state);
        found.map_err(|wrong| (file.cost.variable.span().start, wrong))?;
    }
    Ok(())
}

fn located(path: &str, text: &str, at: usize, message: String, help: Option<String>) -> Failure {
    let before = text.get(..at).unwrap_or(text);
    let line = 1 + before.matches('\n').count();
    let column = 1 + before.rsplit('\n').next().unwrap_or("").chars().count();
    let place = (line, column);
    FileErrors::at_character(input::name(path), text.to_owned(), place, message, help).into()
}

fn prior(args: &ChooseArgs, read: &Read) -> Result<Vec<f64>, Failure> {
    let model = &read.model;
    let Some((variable, state)) = &args.known else { return Ok(model.prior().to_vec()) };
    if *variable != read.hidden {
        let message = format!("--known: the hidden variable is {}", read.hidden);
        return Err(Failure::new(message).help(format!("--known {}=STATE", read.hidden)));
    }
    let states = model.hidden_states();
    if !states.contains(state) {
        let wrong = Wrong {
            line: 0,
            column: 0,
            message: format!("{variable} has no state {state}"),
            help: near(state, states.iter().map(String::as_str))
                .map(|it| format!("did you mean `{it}`?"))
                .or_else(|| Some(format!("it has {}", states.join(", ")))),
        };
        return Err(mistaken("--known", wrong));
    }
    Ok(states.iter().map(|it| if it == state { 1.0 } else { 0.0 }).collect())
}

/// A failed trial, as `WAY/OBSERVATION`.
fn trial(text: &str, model: &Model) -> Result<Seen, Failure> {
    let (way, seen) = text.split_once('/').unwrap_or((text, ""));
    let observation = model.observations().iter().position(|it| it == seen);
    let Some((way, observation)) = model.way_of(way).zip(observation) else {
        let ways: Vec<_> = (0..model.ways()).map(|it| model.way(it)).collect();
        let message = format!("--failed: `{text}` is no trial of this model");
        let (ways, seen) = (ways.join(", "), model.observations().join(", "));
        return Err(Failure::new(message)
            .help(format!("WAY/OBSERVATION, of the ways {ways} and the observations {seen}")));
    };
    Ok(Seen { way, observation })
}
