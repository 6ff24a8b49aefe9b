//! `cotama risk learn`.

use super::{cells, idle, mistaken, refused, written};
use crate::answers::risk::{ArcRow, BootstrapAnswer, LearnAnswer, LearnedFrom};
use crate::args::{LearnArgs, MethodName, ScoreName};
use crate::exit::{Exit, Failure};
use crate::output::{self, Screen};
use crate::render;
use cotama_risk::{
    ArcCounts, Constraints, Counts, Dag, Data, Families, Limits, Network, Rule, Score, Wish, Wrong,
    bootstrap, chain, discretise, exact, hill, k2, upper_bound,
};

const STEPS: u64 = 2_000;
const RESTARTS: u64 = 10;
/// The most parents of a variable by `k2`, where no other bound is given.
const K2_PARENTS: usize = 3;

/// A graph, and what its search says of it.
struct Found {
    dag: Dag,
    method: &'static str,
    proof: &'static str,
    limit: Option<String>,
    order: Option<Vec<usize>>,
    memory_bytes: Option<u64>,
    acceptance: Option<f64>,
}

/// Learns a network.
pub(super) fn learn(args: &LearnArgs, screen: &Screen) -> Result<Exit, Failure> {
    refuse_idle(args)?;
    if let Some(path) = &args.out {
        output::place(path)?;
        let is = |end: &str| path.extension().is_some_and(|it| it.eq_ignore_ascii_case(end));
        if !is("bif") && !is("dot") {
            let message = format!("{}: a network is written as BIF or DOT", path.display());
            return Err(Failure::new(message).help("end the name in .bif or .dot"));
        }
    }
    let (cells, text) = cells(&args.data)?;
    let data = cells.into_data().map_err(|wrong| refused(&args.data, text, wrong))?;
    let constant: Vec<String> = data.constant().iter().map(|it| (*it).to_owned()).collect();
    for name in &constant {
        screen.note(&format!("{name} has one state only: it can have no arcs that pay"));
    }
    let constraints = constraints(args, &data)?;
    let ess = args.ess.unwrap_or(10.0);
    let score = match args.score {
        ScoreName::Bic => Score::Bic,
        ScoreName::Bdeu => Score::Bdeu { ess },
    };
    let mut families = Families::new(&data, score);
    let found = search(args, &data, &mut families, &constraints)?;
    if let Some(path) = &args.out {
        let name = path.file_stem().and_then(|it| it.to_str()).unwrap_or("network");
        let counts = Counts::new(&data, &found.dag, None);
        let network = counts.and_then(|it| it.network(name, args.prior));
        let network = network.map_err(|it| mistaken("--out", it))?;
        let is_dot = path.extension().is_some_and(|it| it.eq_ignore_ascii_case("dot"));
        let text = if is_dot { network.to_dot() } else { Ok(network.to_bif()) };
        written(path, &text.map_err(super::unanswered)?, screen)?;
    }
    let mut answer = answer(args, &data, &mut families, &found, constant);
    if let Some(resamples) = args.bootstrap {
        let learn = |data: &Data| {
            let mut families = Families::new(data, score);
            Ok::<_, Failure>(search(args, data, &mut families, &constraints)?.dag)
        };
        let arcs = bootstrap(&data, resamples, args.seed.unwrap_or(1), learn)?;
        answer.bootstrap = Some(shares(&data, &arcs));
    }
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        let names: Vec<_> = data.variables().iter().map(|it| it.name.as_str()).collect();
        screen.print(&render::risk::learn(&answer, &names, screen.width()))?;
    }
    Ok(if answer.limit.is_some() { Exit::Unknown } else { Exit::Success })
}

fn refuse_idle(args: &LearnArgs) -> Result<(), Failure> {
    let is = |method| args.method == method;
    idle(&[
        ("--ess", args.ess.is_some() && args.score == ScoreName::Bic, "the score `bdeu`"),
        ("--order", !args.order.is_empty() && !is(MethodName::K2), "the method `k2`"),
        (
            "--seed",
            args.seed.is_some()
                && (is(MethodName::K2) || is(MethodName::Exact))
                && args.bootstrap.is_none(),
            "the methods `hill` and `mcmc`, and of --bootstrap",
        ),
        ("--steps", args.steps.is_some() && !is(MethodName::Mcmc), "the method `mcmc`"),
        ("--restarts", args.restarts.is_some() && !is(MethodName::Hill), "the method `hill`"),
    ])
}

fn constraints(args: &LearnArgs, data: &Data) -> Result<Constraints, Failure> {
    let arcs = |option: &str, arcs: &[(String, String)]| {
        let arc = |(from, to): &(String, String)| Ok((data.variable(from)?, data.variable(to)?));
        arcs.iter().map(arc).collect::<Result<Vec<_>, Wrong>>().map_err(|it| mistaken(option, it))
    };
    let tier = |it: &String| {
        it.split(',').map(|it| data.variable(it.trim())).collect::<Result<Vec<_>, _>>()
    };
    let tiers = args.tier.iter().map(tier).collect::<Result<Vec<_>, _>>();
    let is_k2 = args.method == MethodName::K2;
    let wish = Wish {
        required: arcs("--require", &args.require)?,
        forbidden: arcs("--forbid", &args.forbid)?,
        tiers: tiers.map_err(|it| mistaken("--tier", it))?,
        max_parents: args.max_parents.map(|it| it as usize).or(is_k2.then_some(K2_PARENTS)),
    };
    let refused = |it: Wrong| mistaken("constraints", it);
    Constraints::new(data.variables().len(), &wish).map_err(refused)
}

fn search(
    args: &LearnArgs,
    data: &Data,
    families: &mut Families<'_>,
    constraints: &Constraints,
) -> Result<Found, Failure> {
    let seed = args.seed.unwrap_or(1);
    let found = |dag, method, proof| Found {
        dag,
        method,
        proof,
        limit: None,
        order: None,
        memory_bytes: None,
        acceptance: None,
    };
    Ok(match args.method {
        MethodName::Exact => {
            let bytes = args.limit_memory << 20;
            let limits = Limits { variables: args.limit_variables as usize, bytes };
            match exact(families, constraints, limits) {
                Ok(it) => {
                    Found { memory_bytes: Some(it.bytes), ..found(it.dag, "exact", "optimal") }
                }
                Err(why) => {
                    let dag = hill(families, constraints, RESTARTS, seed);
                    Found { limit: Some(why.to_string()), ..found(dag, "hill", "local") }
                }
            }
        }
        MethodName::Hill => {
            let restarts = args.restarts.unwrap_or(RESTARTS);
            found(hill(families, constraints, restarts, seed), "hill", "local")
        }
        MethodName::K2 => {
            let order = order(args, data)?;
            let dag = k2(families, &order, constraints);
            if !constraints.meets(&dag) {
                let message = "a required arc points against the order";
                return Err(Failure::new(message).help("give another --order"));
            }
            Found { order: Some(order), ..found(dag, "k2", "given order") }
        }
        MethodName::Mcmc => {
            let walk = chain(families, constraints, args.steps.unwrap_or(STEPS), seed);
            let acceptance = walk.acceptance();
            Found { acceptance, ..found(walk.best, "mcmc", "none") }
        }
    })
}

fn order(args: &LearnArgs, data: &Data) -> Result<Vec<usize>, Failure> {
    let count = data.variables().len();
    if args.order.is_empty() {
        return Ok((0..count).collect());
    }
    let order = args.order.iter().map(|it| data.variable(it.trim())).collect::<Result<Vec<_>, _>>();
    let order = order.map_err(|it| mistaken("--order", it))?;
    let missing = (0..count).find(|it| !order.contains(it));
    match missing {
        None if order.len() == count => Ok(order),
        None => Err(Failure::new("--order: a variable stands twice").help("name each once")),
        Some(it) => {
            let name = &data.variables()[it].name;
            Err(Failure::new(format!("--order: {name} is missing")).help("name each variable once"))
        }
    }
}

fn answer(
    args: &LearnArgs,
    data: &Data,
    families: &mut Families<'_>,
    found: &Found,
    constant: Vec<String>,
) -> LearnAnswer {
    let name = |it: usize| data.variables()[it].name.clone();
    let parents = |mask: u64| (0..64).filter(|it| mask >> it & 1 == 1).map(name).collect();
    let columns = found.dag.parents().iter().enumerate();
    let order = found.order.clone().unwrap_or_else(|| found.dag.order());
    let bound = (found.proof != "optimal").then(|| upper_bound(families));
    let is_bdeu = args.score == ScoreName::Bdeu;
    let default = (args.method == MethodName::K2).then_some(K2_PARENTS as u64);
    LearnAnswer {
        schema: "cotama/risk-learn/1",
        rows: data.rows() as u64,
        score: if is_bdeu { "bdeu" } else { "bic" },
        ess: is_bdeu.then(|| args.ess.unwrap_or(10.0)),
        value: families.of(&found.dag),
        method: found.method,
        proof: found.proof,
        bound,
        limit: found.limit.clone(),
        order: order.into_iter().map(name).collect(),
        max_parents: args.max_parents.or(default),
        parents: columns.map(|(at, mask)| (name(at), parents(*mask))).collect(),
        compelled: found.dag.compelled().into_iter().map(|(a, b)| [name(a), name(b)]).collect(),
        constant,
        memory_bytes: found.memory_bytes,
        acceptance: found.acceptance,
        bootstrap: None,
    }
}

fn shares(data: &Data, arcs: &ArcCounts) -> BootstrapAnswer {
    let (names, count) = (data.variables(), data.variables().len());
    let pairs = (0..count).flat_map(|from| (0..count).map(move |to| (from, to)));
    let row = |(from, to): (usize, usize)| ArcRow {
        from: names[from].name.clone(),
        to: names[to].name.clone(),
        share: arcs.share(arcs.arc(from, to)),
        joined: arcs.share(arcs.joined(from, to)),
    };
    let arcs_seen = pairs.filter(|it| arcs.arc(it.0, it.1) > 0).map(row).collect();
    BootstrapAnswer { resamples: arcs.resamples, arcs: arcs_seen }
}

/// Learns a network of measurements: columns of many numbers are cut into so many steps of equal
/// frequency, and the graph is the best by BIC, or that of hill climbing where there are too many
/// variables.
pub(super) fn of_measurements(path: &str, bins: u64) -> Result<(Network, LearnedFrom), Failure> {
    let (cells, text) = cells(path)?;
    let rule = Rule::Frequency { bins: bins as usize };
    let (steps, cuts) = discretise(&cells, &rule).map_err(|it| mistaken("--bins", it))?;
    let data = steps.into_data().map_err(|wrong| refused(path, text, wrong))?;
    let none = Constraints::none(data.variables().len()).map_err(|it| mistaken("data", it))?;
    let mut families = Families::new(&data, Score::Bic);
    let (dag, proof) = match exact(&mut families, &none, Limits::default()) {
        Ok(it) => (it.dag, "optimal"),
        Err(_) => (hill(&mut families, &none, RESTARTS, 1), "local"),
    };
    let name = std::path::Path::new(path).file_stem().and_then(|it| it.to_str());
    let counts = Counts::new(&data, &dag, None);
    let network = counts.and_then(|it| it.network(name.unwrap_or("network"), 1.0));
    let from = LearnedFrom {
        rows: data.rows() as u64,
        cut: cuts.into_iter().map(|it| it.name).collect(),
        bins,
        proof,
    };
    Ok((network.map_err(|it| mistaken("data", it))?, from))
}
