//! `cotama risk`: networks learned from runs, asked, and used to choose.

mod calibrate;
mod choose;
mod learn;
mod observe;

use crate::answers::risk::{
    CoherenceAnswer, CoherentRow, CutRow, DiscretiseAnswer, InferAnswer, SeparatedAnswer,
};
use crate::args::{
    CoherenceArgs, DiscretiseArgs, FixedArgs, InferArgs, RiskArgs, RiskCommand, RuleName,
    SampleArgs, SeparatedArgs,
};
use crate::exit::{Exit, Failure};
use crate::file_errors::FileErrors;
use crate::input;
use crate::kind;
use crate::names::{is_name, near};
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use cotama_risk::{
    Cells, EMBEDDED, Fixed, Network, NoAnswer, Rule, Wrong, coherence as coherences,
    discretise as discretised,
};
use std::path::Path;

/// The most bytes of data, and of a network or a model.
const DATA_BYTES: u64 = 64 << 20;
const NETWORK_BYTES: u64 = 64 << 20;

/// Does what the words behind `risk` say.
pub(crate) fn risk(args: &RiskArgs, screen: &Screen) -> Result<Exit, Failure> {
    match &args.command {
        RiskCommand::Learn(args) => learn::learn(args, screen),
        RiskCommand::Infer(args) => infer(args, screen),
        RiskCommand::Coherence(args) => coherence(args, screen),
        RiskCommand::Discretise(args) => discretise(args, screen),
        RiskCommand::Separated(args) => separated(args, screen),
        RiskCommand::Choose(args) => choose::choose(args, screen),
        RiskCommand::Calibrate(args) => calibrate::calibrate(args, screen),
        RiskCommand::Table(args) => table(args, screen),
        RiskCommand::Sample(args) => sample(args, screen),
        RiskCommand::Observe(args) => observe::observe(args),
    }
}

/// A refusal of a text, at its place.
fn refused(path: &str, text: String, wrong: Wrong) -> Failure {
    let Wrong { line, column, message, help } = wrong;
    if line > 0 {
        let place = (line, column);
        return FileErrors::at_character(input::name(path), text, place, message, help).into();
    }
    let failure = Failure::of(input::name(path), message);
    match help {
        Some(help) => failure.help(help),
        None => failure,
    }
}

/// A refusal of words on the command line.
fn mistaken(option: &str, wrong: Wrong) -> Failure {
    let failure = Failure::new(format!("{option}: {}", wrong.message));
    match wrong.help {
        Some(help) => failure.help(help),
        None => failure,
    }
}

/// Refuses an option that would change nothing.
fn idle(given: &[(&str, bool, &str)]) -> Result<(), Failure> {
    given.iter().find(|it| it.1).map_or(Ok(()), |(option, _, of)| {
        let message = format!("{option} changes nothing here: it is of {of}");
        Err(Failure::new(message).help(format!("leave {option} out")))
    })
}

/// A table of texts, and the text that it is of.
fn cells(path: &str) -> Result<(Cells, String), Failure> {
    let what = "data in CSV";
    let bytes = input::bytes(path, what, DATA_BYTES)?;
    kind::expect(path, &bytes, what, &[])?;
    let text = input::utf8(path, what, bytes)?;
    let read = Cells::parse(&text);
    Ok((read.map_err(|wrong| refused(path, text.clone(), wrong))?, text))
}

/// Reads a network, that of a name or of a path.
fn network(name: &str, screen: &Screen) -> Result<Network, Failure> {
    if let Some((name, _, text)) = EMBEDDED.iter().find(|it| it.0 == name) {
        let read = Network::from_bif(text);
        return Ok(read.map_err(|wrong| refused(name, (*text).to_owned(), wrong))?.0);
    }
    if is_name(name) && !Path::new(name).exists() {
        let failure = Failure::new(format!("no network is called `{name}`"));
        let names = EMBEDDED.iter().map(|it| it.0);
        let help = near(name, names.clone()).map_or_else(
            || {
                let names: Vec<_> = names.collect();
                format!("there are {}, or give the path of a file", names.join(", "))
            },
            |near| format!("did you mean `{near}`?"),
        );
        return Err(failure.help(help));
    }
    let text = input::text(name, "a network in BIF", NETWORK_BYTES)?;
    let is_xml = text.trim_start().starts_with('<');
    let read = if is_xml { Network::from_xmlbif(&text) } else { Network::from_bif(&text) };
    let (network, notes) = read.map_err(|wrong| refused(name, text.clone(), wrong))?;
    notes.iter().for_each(|it| screen.note(&format!("{}: {it}", input::name(name))));
    Ok(network)
}

/// The name of a variable.
fn named(network: &Network, variable: usize) -> String {
    network.nodes().get(variable).map_or_else(String::new, |it| it.variable.name.clone())
}

fn unanswered(why: NoAnswer) -> Failure {
    let failure = Failure::new(why.to_string());
    match why {
        NoAnswer::Impossible => failure.help("look for the evidence that cannot come together"),
        NoAnswer::TooLarge => failure.help("the network is too wide for exact answers"),
        NoAnswer::Malformed => failure.help("name each variable once"),
    }
}

fn infer(args: &InferArgs, screen: &Screen) -> Result<Exit, Failure> {
    let network = network(&args.network, screen)?;
    let query = network.variable(&args.query).map_err(|it| mistaken("--query", it))?;
    let state = |(variable, state): &(String, String)| network.state(variable, state);
    let evidence = args.evidence.iter().map(state).collect::<Result<Vec<_>, _>>();
    let evidence = evidence.map_err(|it| mistaken("--evidence", it))?;
    let answer = network.infer(query, &evidence).map_err(unanswered)?;
    let others = |at: usize| {
        let others = evidence.iter().map(|it| it.0);
        others.filter(|it| *it != at).collect::<Vec<_>>()
    };
    let idle = evidence.iter().map(|it| it.0);
    let idle = idle.filter(|it| network.open_path(*it, query, &others(*it)).is_none());
    let states = &network.nodes()[query].variable.states;
    let answer = InferAnswer {
        schema: "cotama/risk-infer/1",
        query: args.query.clone(),
        evidence: args.evidence.iter().cloned().collect(),
        probability_of_evidence: answer.probability_of_evidence,
        posterior: states.iter().cloned().zip(answer.posterior).collect(),
        without_influence: idle.map(|it| named(&network, it)).collect(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::risk::infer(&answer, states, screen.width()))?;
    }
    Ok(Exit::Success)
}

fn coherence(args: &CoherenceArgs, screen: &Screen) -> Result<Exit, Failure> {
    for path in [&args.svg, &args.dot].into_iter().flatten() {
        output::place(path)?;
    }
    let is_data = Path::new(&args.network).extension().is_some_and(|it| it == "csv");
    let (network, learned) = if is_data {
        let bins = args.bins.unwrap_or(3);
        let (network, from) = learn::of_measurements(&args.network, bins)?;
        (network, Some(from))
    } else {
        idle(&[("--bins", args.bins.is_some(), "data in CSV")])?;
        (network(&args.network, screen)?, None)
    };
    let mut all = coherences(&network).map_err(unanswered)?;
    all.sort_by(|a, b| b.eta.total_cmp(&a.eta).then((a.x, a.y).cmp(&(b.x, b.y))));
    if let Some(path) = &args.svg {
        written(path, &network.to_svg(&all), screen)?;
    }
    if let Some(path) = &args.dot {
        written(path, &network.to_dot().map_err(unanswered)?, screen)?;
    }
    let row = |it: &cotama_risk::Coherence| CoherentRow {
        x: named(&network, it.x),
        y: named(&network, it.y),
        information_nats: it.information,
        entropy_nats: it.entropy,
        eta: it.eta,
    };
    let answer = CoherenceAnswer {
        schema: "cotama/risk-coherence/1",
        network: network.name().to_owned(),
        learned,
        pairs: all.iter().map(row).collect(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::risk::coherence(&answer, screen.width()))?;
    }
    Ok(Exit::Success)
}

fn written(path: &Path, text: &str, screen: &Screen) -> Result<(), Failure> {
    output::file(path, text.as_bytes())?;
    screen.note(&format!("written: {NAME}{}{NAME:#}", path.display()));
    Ok(())
}

fn discretise(args: &DiscretiseArgs, screen: &Screen) -> Result<Exit, Failure> {
    let bins = args.bins.unwrap_or(3) as usize;
    let rule = match (args.rule, &args.class) {
        (RuleName::Width, None) => Rule::Width { bins },
        (RuleName::Frequency, None) => Rule::Frequency { bins },
        (RuleName::Mdl, class) => {
            idle(&[("--bins", args.bins.is_some(), "the rules `width` and `frequency`")])?;
            Rule::Mdl { class: class.clone().unwrap_or_default() }
        }
        (_, Some(_)) => return Err(idle_class()),
    };
    if let Some(path) = &args.out {
        output::place(path)?;
    }
    let (cells, _) = cells(&args.data)?;
    let (steps, cuts) = discretised(&cells, &rule).map_err(|it| mistaken("--class", it))?;
    let text = steps.to_csv();
    if let Some(path) = &args.out {
        written(path, &text, screen)?;
    }
    let is_cut = |name: &String| cuts.iter().any(|it| it.name == *name);
    let answer = DiscretiseAnswer {
        schema: "cotama/risk-discretise/1",
        rows: cells.columns.first().map_or(0, Vec::len) as u64,
        kept: cells.header.iter().filter(|it| !is_cut(it)).cloned().collect(),
        columns: cuts
            .iter()
            .map(|it| CutRow {
                name: it.name.clone(),
                cuts: it.cuts.clone(),
                counts: it.counts.iter().map(|it| *it as u64).collect(),
            })
            .collect(),
        csv: args.out.is_none().then_some(text),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else if let Some(csv) = &answer.csv {
        Screen::raw(csv.as_bytes())?;
    } else {
        screen.print(&render::risk::discretise(&answer, screen.width()))?;
    }
    Ok(Exit::Success)
}

fn idle_class() -> Failure {
    Failure::new("--class changes nothing here: it is of the rule `mdl`").help("add --rule mdl")
}

fn separated(args: &SeparatedArgs, screen: &Screen) -> Result<Exit, Failure> {
    let network = network(&args.network, screen)?;
    let number =
        |option: &str, name: &str| network.variable(name).map_err(|wrong| mistaken(option, wrong));
    let (x, y) = (number("--x", &args.x)?, number("--y", &args.y)?);
    let given = args.given.iter().map(|it| number("--given", it)).collect::<Result<Vec<_>, _>>()?;
    if x == y || given.contains(&x) || given.contains(&y) {
        return Err(Failure::new("a variable stands twice").help("name each variable once"));
    }
    let path = network.open_path(x, y, &given);
    let variables = path.iter().flat_map(|it| &it.variables);
    let arcs = path.iter().flat_map(|it| &it.forward);
    let answer = SeparatedAnswer {
        schema: "cotama/risk-separated/1",
        x: args.x.clone(),
        y: args.y.clone(),
        given: args.given.clone(),
        separated: path.is_none(),
        path: variables.map(|it| named(&network, *it)).collect(),
        arcs: arcs.map(|it| if *it { "->" } else { "<-" }).collect(),
    };
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::risk::separated(&answer, screen.width()))?;
    }
    Ok(if answer.separated { Exit::Success } else { Exit::Violated })
}

fn table(args: &FixedArgs, screen: &Screen) -> Result<Exit, Failure> {
    let network = network(&args.network, screen)?;
    let query = network.variable(&args.query).map_err(|it| mistaken("--query", it))?;
    let given = args.given.iter().map(|it| network.variable(it)).collect::<Result<Vec<_>, _>>();
    let given = given.map_err(|it| mistaken("--given", it))?;
    let fixed = Fixed::new(&network, query, &given).map_err(unanswered)?;
    let given = if args.given.is_empty() { "nothing".into() } else { args.given.join(", ") };
    let about = format!("Probabilities of {} given {given}, in this order", args.query);
    Screen::raw(fixed.to_rust(&render::visible(&about)).as_bytes())?;
    Ok(Exit::Success)
}

fn sample(args: &SampleArgs, screen: &Screen) -> Result<Exit, Failure> {
    let network = network(&args.network, screen)?;
    let data =
        network.sample(args.rows as usize, args.seed).map_err(|it| mistaken("--rows", it))?;
    Screen::raw(data.to_csv().as_bytes())?;
    Ok(Exit::Success)
}
