//! Laws, on 5,000 random tables of data and networks of 3 to 6 variables each.

use cotama_risk::{
    Constraints, Counts, Dag, Data, Families, Fixed, Limits, Network, Node, Plan, Score, Variable,
    Wish, chain, coherence, dags, exact, hill, k2,
};
use cotama_streams::{Stream, Streams};

const RUNS: u64 = 5_000;

fn variable(name: usize, states: usize) -> Variable {
    let states = (0..states).map(|it| format!("s{it}")).collect();
    Variable { name: format!("v{name}"), states }
}

/// A random graph: arcs along a random order.
fn random_dag(stream: &mut Stream, variables: usize) -> Dag {
    let mut order: Vec<usize> = (0..variables).collect();
    for at in (1..variables).rev() {
        order.swap(at, stream.below(at as u64 + 1) as usize);
    }
    let mut parents = vec![0; variables];
    for (at, to) in order.iter().enumerate() {
        for from in &order[..at] {
            if stream.below(5) < 2 {
                parents[*to] |= 1 << from;
            }
        }
    }
    Dag::new(parents).unwrap()
}

/// A random network, its probabilities in 64ths, and these as whole numbers.
fn random_network(stream: &mut Stream) -> (Network, Vec<Vec<u64>>, Dag) {
    let count = 3 + stream.below(4) as usize;
    let dag = random_dag(stream, count);
    let states: Vec<usize> = (0..count).map(|_| 2 + stream.below(2) as usize).collect();
    let (mut nodes, mut whole) = (Vec::new(), Vec::new());
    for at in 0..count {
        let parents: Vec<usize> =
            (0..count).filter(|it| dag.parents()[at] >> it & 1 == 1).collect();
        let rows: usize = parents.iter().map(|it| states[*it]).product();
        let mut table = Vec::new();
        for _ in 0..rows {
            let mut left = 64 - states[at] as u64;
            for state in 0..states[at] {
                let last = state + 1 == states[at];
                let share = if last { left } else { stream.below(left + 1) };
                left -= share;
                table.push(share + 1);
            }
        }
        let shares = table.iter().map(|it| *it as f64 / 64.0).collect();
        nodes.push(Node { variable: variable(at, states[at]), parents, table: shares });
        whole.push(table);
    }
    (Network::new("random", nodes).unwrap(), whole, dag)
}

/// Rows drawn from a random network.
fn random_data(stream: &mut Stream, most: usize) -> Data {
    let (net, whole, _) = loop {
        let made = random_network(stream);
        if made.0.nodes().len() <= most {
            break made;
        }
    };
    let rows = 1 + stream.below(120) as usize;
    let mut columns = vec![Vec::new(); net.nodes().len()];
    for _ in 0..rows {
        let mut row = vec![0; net.nodes().len()];
        for at in net.order() {
            let node = &net.nodes()[*at];
            let place = node
                .parents
                .iter()
                .fold(0, |place, it| place * net.nodes()[*it].variable.states.len() + row[*it]);
            let states = node.variable.states.len();
            let mut draw = stream.below(64);
            let shares = &whole[*at][place * states..(place + 1) * states];
            row[*at] = shares
                .iter()
                .position(|it| {
                    let hit = draw < *it;
                    draw = draw.saturating_sub(*it);
                    hit
                })
                .unwrap();
        }
        row.iter().zip(&mut columns).for_each(|(state, column)| column.push(*state as u16));
    }
    let variables = net.nodes().iter().map(|it| it.variable.clone()).collect();
    Data::new(variables, columns).unwrap()
}

/// Calls for each graph of so many variables.
fn each_dag(variables: usize, mut call: impl FnMut(&Dag)) {
    let others = 1_u64 << (variables - 1);
    let wide = |set: u64, at: usize| set & ((1 << at) - 1) | (set >> at) << (at + 1);
    for mut number in 0..others.pow(variables as u32) {
        let parents = (0..variables).map(|at| {
            let set = number % others;
            number /= others;
            wide(set, at)
        });
        if let Some(dag) = Dag::new(parents.collect()) {
            call(&dag);
        }
    }
}

/// The best score over all orders, each variable with the best parents from those before it.
fn best_of_all_orders(families: &mut Families<'_>, constraints: &Constraints) -> f64 {
    fn beyond(
        families: &mut Families<'_>,
        constraints: &Constraints,
        before: u64,
        score: f64,
        best: &mut f64,
    ) {
        let count = families.data().variables().len();
        if before == (1 << count) - 1 {
            *best = best.max(score);
        }
        for child in (0..count).filter(|it| before >> it & 1 == 0) {
            let mut own = f64::NEG_INFINITY;
            let mut parents = before;
            loop {
                if constraints.allow(child, parents) {
                    own = own.max(families.family(child, parents));
                }
                if parents == 0 {
                    break;
                }
                parents = (parents - 1) & before;
            }
            beyond(families, constraints, before | 1 << child, score + own, best);
        }
    }
    let mut best = f64::NEG_INFINITY;
    beyond(families, constraints, 0, 0.0, &mut best);
    best
}

fn scores(stream: &mut Stream) -> Score {
    match stream.below(2) {
        0 => Score::Bic,
        _ => Score::Bdeu { ess: [0.5, 1.0, 10.0][stream.below(3) as usize] },
    }
}

#[test]
fn the_exact_search_finds_what_all_graphs_have() {
    let streams = Streams::new(1);
    for run in 0..RUNS {
        let mut stream = streams.stream(&format!("enumerated {run}"));
        let data = random_data(&mut stream, 6);
        let count = data.variables().len();
        let mut families = Families::new(&data, scores(&mut stream));
        let pick = |stream: &mut Stream| {
            let from = stream.below(count as u64) as usize;
            (from, (from + 1 + stream.below(count as u64 - 1) as usize) % count)
        };
        let mut wish = Wish::default();
        match stream.below(5) {
            0 => wish.required.push(pick(&mut stream)),
            1 => wish.forbidden.extend([pick(&mut stream), pick(&mut stream)]),
            2 => wish.tiers = vec![vec![1], vec![0, 2]],
            3 => wish.max_parents = Some(stream.below(3) as usize),
            _ => {}
        }
        let constraints = Constraints::new(count, &wish).unwrap();
        let found = exact(&mut families, &constraints, Limits::default()).unwrap();
        assert!(constraints.meets(&found.dag));
        if count > 4 {
            let best = best_of_all_orders(&mut families, &constraints);
            assert!((found.score - best).abs() < 1e-9, "{run}: {found:?}, not {best}");
            continue;
        }
        let (mut best, mut seen) = (f64::NEG_INFINITY, 0);
        let mut fewest = usize::MAX;
        each_dag(count, |dag| {
            seen += 1;
            if constraints.meets(dag) {
                let score = families.of(dag);
                let arcs = dag.arcs().count();
                if score > best + 1e-9 {
                    (best, fewest) = (score, arcs);
                } else if score > best - 1e-9 {
                    fewest = fewest.min(arcs);
                }
            }
        });
        assert_eq!(Some(seen), dags(count as u32));
        assert!((found.score - best).abs() < 1e-9, "{run}: {found:?}, not {best}");
        assert_eq!(found.dag.arcs().count(), fewest, "{run}");
    }
}

#[test]
fn graphs_of_a_class_have_one_score_and_share_the_compelled_arcs() {
    let streams = Streams::new(2);
    for run in 0..RUNS {
        let mut stream = streams.stream(&format!("class {run}"));
        let data = random_data(&mut stream, 6);
        let count = data.variables().len();
        let mut families = Families::new(&data, scores(&mut stream));
        let dag = random_dag(&mut stream, count);
        let (canonical, compelled) = (dag.canonical(), dag.compelled());
        assert_eq!(canonical.compelled(), compelled, "{dag:?}");
        assert_eq!(canonical.canonical(), canonical);
        let (one, two) = (families.of(&dag), families.of(&canonical));
        assert!((one - two).abs() < 1e-9, "{run}: {one} {two}");
        if count > 4 {
            continue;
        }
        // A member of the class has the same skeleton and colliders, and its arcs differ in all
        // that is not compelled.
        let edges = |dag: &Dag| {
            let mut edges: Vec<_> = dag.arcs().map(|(a, b)| (a.min(b), a.max(b))).collect();
            edges.sort_unstable();
            edges
        };
        let mut common: Option<Vec<(usize, usize)>> = None;
        each_dag(count, |other| {
            if edges(other) != edges(&dag) || other.compelled() != compelled {
                return;
            }
            assert!((families.of(other) - one).abs() < 1e-9, "{run}");
            let arcs: Vec<_> = other.arcs().collect();
            match &mut common {
                None => common = Some(arcs),
                Some(common) => common.retain(|it| arcs.contains(it)),
            }
        });
        let mut common = common.unwrap();
        common.sort_unstable();
        assert_eq!(common, compelled, "{dag:?}");
    }
}

/// Sums the joint distribution in whole numbers: the denominator is 64 for each variable.
fn counted(net: &Network, whole: &[Vec<u64>], fixed: &[(usize, usize)]) -> u128 {
    let count = net.nodes().len();
    let states = |at: usize| net.nodes()[at].variable.states.len();
    let all: usize = (0..count).map(states).product();
    let mut sum = 0;
    for number in 0..all {
        let mut rest = number;
        let row: Vec<usize> = (0..count)
            .map(|at| {
                let state = rest % states(at);
                rest /= states(at);
                state
            })
            .collect();
        if fixed.iter().all(|it| row[it.0] == it.1) {
            let share = |at: usize| {
                let parents = net.nodes()[at].parents.iter();
                let place = parents.fold(0, |place, it| place * states(*it) + row[*it]);
                u128::from(whole[at][place * states(at) + row[at]])
            };
            sum += (0..count).map(share).product::<u128>();
        }
    }
    sum
}

#[test]
fn a_posterior_is_the_exact_fraction() {
    let streams = Streams::new(3);
    for run in 0..RUNS {
        let mut stream = streams.stream(&format!("fractions {run}"));
        let (net, whole, _) = random_network(&mut stream);
        let count = net.nodes().len() as u64;
        let query = stream.below(count) as usize;
        let mut evidence: Vec<(usize, usize)> = Vec::new();
        for at in (0..count as usize).filter(|it| *it != query) {
            if stream.below(3) == 0 {
                let states = net.nodes()[at].variable.states.len() as u64;
                evidence.push((at, stream.below(states) as usize));
            }
        }
        let answer = net.infer(query, &evidence).unwrap();
        let all = counted(&net, &whole, &evidence);
        let whole_of = 64_f64.powi(net.nodes().len() as i32);
        assert!((answer.probability_of_evidence - all as f64 / whole_of).abs() < 1e-14);
        for (state, found) in answer.posterior.iter().enumerate() {
            evidence.push((query, state));
            let wanted = counted(&net, &whole, &evidence) as f64 / all as f64;
            evidence.pop();
            assert!((found - wanted).abs() < 1e-13, "{run}: {found} {wanted}");
        }
        // In fixed point: within the bound that comes with the answer. 64ths are exact there.
        let (given, states): (Vec<_>, Vec<_>) = evidence.iter().copied().unzip();
        let states: Vec<u8> = states.iter().map(|it| *it as u8).collect();
        let (posterior, fixed) = Fixed::new(&net, query, &given).unwrap().answer(&states).unwrap();
        for (state, found) in posterior.iter().enumerate() {
            evidence.push((query, state));
            let part = counted(&net, &whole, &evidence);
            evidence.pop();
            let off = (part << 30).abs_diff(u128::from(*found) * all);
            assert!(off <= u128::from(fixed.error) * all, "{run}: {found} {fixed:?}");
        }
    }
}

/// The mutual information of two variables given all states of others.
fn information(net: &Network, x: usize, y: usize, given: &[usize]) -> f64 {
    let states = |at: usize| net.nodes()[at].variable.states.len();
    let mut asked = given.to_vec();
    asked.extend([x, y]);
    let joint = Plan::new(net, &asked, &[]).unwrap().answer(net, &[]).unwrap().posterior;
    let mut sum = 0.0;
    for block in joint.chunks(states(x) * states(y)) {
        let all: f64 = block.iter().sum();
        for (at, cell) in block.iter().enumerate() {
            let row: f64 = block.chunks(states(y)).nth(at / states(y)).unwrap().iter().sum();
            let column: f64 = block.iter().skip(at % states(y)).step_by(states(y)).sum();
            sum += cell * libm::log(cell * all / (row * column));
        }
    }
    sum
}

#[test]
fn separated_variables_tell_nothing_of_each_other() {
    let streams = Streams::new(4);
    let (mut open, mut silent) = (0, 0);
    for run in 0..RUNS {
        let mut stream = streams.stream(&format!("separated {run}"));
        let (net, _, _) = random_network(&mut stream);
        let count = net.nodes().len();
        let x = stream.below(count as u64) as usize;
        let y = (x + 1 + stream.below(count as u64 - 1) as usize) % count;
        let given: Vec<usize> =
            (0..count).filter(|it| *it != x && *it != y && stream.below(3) == 0).collect();
        let told = information(&net, x, y, &given);
        match net.open_path(x, y, &given) {
            None => assert!(told.abs() < 1e-13, "{run}: separated, and {told}"),
            Some(path) => {
                assert_eq!((path.variables[0], path.variables[path.forward.len()]), (x, y));
                for (pair, forward) in path.variables.windows(2).zip(&path.forward) {
                    let (from, to) = if *forward { (pair[0], pair[1]) } else { (pair[1], pair[0]) };
                    assert!(net.nodes()[to].parents.contains(&from), "{run}: no arc of the path");
                }
                open += 1;
                silent += u64::from(told < 1e-12);
            }
        }
        assert_eq!(net.open_path(x, y, &given).is_some(), net.open_path(y, x, &given).is_some());
    }
    // Numbers in 64ths conspire at times: two rows of a table are equal.
    assert!(silent * 20 < open, "{silent} of {open} open paths tell nothing");
}

#[test]
fn no_search_is_above_the_exact_one_and_all_are_the_same_again() {
    let streams = Streams::new(5);
    for run in 0..500 {
        let mut stream = streams.stream(&format!("searched {run}"));
        let data = random_data(&mut stream, 6);
        let count = data.variables().len();
        let mut families = Families::new(&data, scores(&mut stream));
        let none = Constraints::none(count).unwrap();
        let best = exact(&mut families, &none, Limits::default()).unwrap();
        let climbed = hill(&mut families, &none, 3, run);
        let walked = chain(&mut families, &none, 200, run);
        let along = k2(&mut families, &best.dag.order(), &none);
        for dag in [&climbed, &walked.best, &along] {
            assert!(families.of(dag) <= best.score + 1e-9);
        }
        assert_eq!(walked.accepted + walked.refused, 200);
        assert!(cotama_risk::upper_bound(&families) >= best.score - 1e-9);
        assert_eq!(hill(&mut Families::new(&data, families.score()), &none, 3, run), climbed);
        assert_eq!(chain(&mut Families::new(&data, families.score()), &none, 200, run), walked);
    }
}

#[test]
fn counts_that_go_on_are_those_of_all_rows_and_of_a_window() {
    let mut stream = Streams::new(6).stream("counts");
    let data = random_data(&mut stream, 6);
    let dag = random_dag(&mut stream, data.variables().len());
    let row = |at: usize| -> Vec<u16> {
        (0..data.variables().len()).map(|it| data.column(it)[at]).collect()
    };
    let mut moving = Counts::new(&data, &dag, Some(10)).unwrap();
    for at in 0..data.rows() {
        moving.add(&row(at)).unwrap();
    }
    let last: Vec<Vec<u16>> = (0..data.variables().len())
        .map(|it| data.column(it)[data.rows().saturating_sub(10)..].to_vec())
        .collect();
    let few = Data::new(data.variables().to_vec(), last).unwrap();
    let wanted = Counts::new(&few, &dag, None).unwrap().network("n", 1.0).unwrap();
    assert_eq!(moving.network("n", 1.0).unwrap(), wanted);
    assert_eq!(
        coherence(&wanted).unwrap().len(),
        data.variables().len() * (data.variables().len() - 1) / 2
    );
    assert!(moving.add(&[]).is_err());
}
