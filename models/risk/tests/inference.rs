//! Posteriors, separation, coherence, quantiles against known answers.

use crate::common::{cells, network};
use cotama_risk::{Convention, Fixed, NoAnswer, coherence, quantile};

/// `name=value` pairs between commas or spaces.
fn pairs(text: &str, between: char) -> impl Iterator<Item = (&str, &str)> {
    text.split(between).filter_map(|it| it.split_once('='))
}

#[test]
fn all_35_posteriors_are_those_of_exact_fractions() {
    let mut asked = 0;
    for row in cells("expected.tsv").iter().filter(|it| it[1] == "infer") {
        let net = network(row[2].strip_suffix(".bif").unwrap());
        let spec = row[3].strip_prefix("query=").unwrap();
        let (query, evidence) = spec.split_once(" evidence=").unwrap();
        let query = net.variable(query).unwrap();
        let evidence: Vec<_> =
            pairs(evidence, ',').map(|(name, state)| net.state(name, state).unwrap()).collect();
        let answer = net.infer(query, &evidence).unwrap();
        let wanted: f64 = row[4].parse().unwrap();
        assert!((answer.probability_of_evidence - wanted).abs() < 1e-12, "{row:?} {answer:?}");
        for (state, value) in pairs(&row[5], ' ') {
            let state = net.nodes()[query].variable.state(state).unwrap();
            let wanted: f64 = value.parse().unwrap();
            assert!((answer.posterior[state] - wanted).abs() < 1e-12, "{row:?} {answer:?}");
        }
        asked += 1;
    }
    assert_eq!(asked, 35);
}

/// The largest bound of the 35 answers, in units of 2⁻³⁰: 27 millionths, where the evidence has a
/// probability of 3 in 10,000.
const WORST: u32 = 29_343;

#[test]
fn an_answer_in_fixed_point_is_within_its_bound() {
    let (mut worst, mut asked) = (0, 0);
    for row in cells("expected.tsv").iter().filter(|it| it[1] == "infer") {
        let net = network(row[2].strip_suffix(".bif").unwrap());
        let spec = row[3].strip_prefix("query=").unwrap();
        let (query, evidence) = spec.split_once(" evidence=").unwrap();
        let query = net.variable(query).unwrap();
        let (given, states): (Vec<_>, Vec<_>) =
            pairs(evidence, ',').map(|(name, state)| net.state(name, state).unwrap()).unzip();
        let states: Vec<u8> = states.iter().map(|it| *it as u8).collect();
        let fixed = Fixed::new(&net, query, &given).unwrap();
        let (posterior, answer) = fixed.answer(&states).unwrap();
        for (state, value) in pairs(&row[5], ' ') {
            let state = net.nodes()[query].variable.state(state).unwrap();
            let off =
                f64::from(posterior[state]) - value.parse::<f64>().unwrap() * f64::from(1 << 30);
            assert!(off.abs() <= f64::from(answer.error), "{row:?} {off} {answer:?}");
        }
        worst = worst.max(answer.error);
        asked += 1;
    }
    assert_eq!((asked, worst), (35, WORST));
}

#[allow(unreachable_pub)] // as firmware has it
mod printed {
    include!("golden/asia_lung.rs");
}

#[test]
fn a_printed_query_is_the_query() {
    let asia = network("asia");
    let given = ["dysp", "xray"].map(|it| asia.variable(it).unwrap());
    let fixed = Fixed::new(&asia, asia.variable("lung").unwrap(), &given).unwrap();
    cotama_golden::compare("tests/golden/asia_lung.rs", &fixed.to_rust("P(lung | dysp, xray)"));
    const SCRATCH: usize = printed::QUERY.scratch;
    for states in [[0, 0], [0, 1], [1, 0], [1, 1]] {
        let (mut scratch, mut posterior) = ([0; SCRATCH], [0; 2]);
        let answer = printed::QUERY.answer(&states, &mut scratch, &mut posterior).unwrap();
        assert_eq!((posterior.to_vec(), answer), fixed.answer(&states).unwrap());
    }
    assert_eq!(fixed.bytes(), (638, 144));
}

#[test]
fn impossible_evidence_is_an_error_in_fixed_point_too() {
    let asia = network("asia");
    let given = ["lung", "either"].map(|it| asia.variable(it).unwrap());
    let fixed = Fixed::new(&asia, asia.variable("xray").unwrap(), &given).unwrap();
    assert!(fixed.answer(&[0, 1]).is_err());
}

#[test]
fn a_flat_table_is_asked_as_its_fractions_say() {
    let dog = network("dog_problem");
    let state = |name, state| dog.state(name, state).unwrap();
    let ask = |name, evidence: &[(usize, usize)]| {
        dog.infer(dog.variable(name).unwrap(), evidence).unwrap().posterior[0]
    };
    let seen = [state("light-on", "true"), state("hear-bark", "false")];
    assert!((ask("family-out", &seen) - 4_420_548.0 / 8_831_351.0).abs() < 1e-15);
    assert!((ask("dog-out", &[]) - 0.395_83).abs() < 1e-15);
    assert!(
        (ask("bowel-problem", &[state("hear-bark", "true")]) - 0.024_066_244_070).abs() < 1e-12
    );
}

#[test]
fn impossible_evidence_is_an_error() {
    let asia = network("asia");
    let evidence = [asia.state("lung", "yes").unwrap(), asia.state("either", "no").unwrap()];
    let xray = asia.variable("xray").unwrap();
    assert_eq!(asia.infer(xray, &evidence), Err(NoAnswer::Impossible));
    assert_eq!(asia.infer(xray, &[(xray, 0)]), Err(NoAnswer::Malformed));
    assert_eq!(asia.infer(99, &[]), Err(NoAnswer::Malformed));
}

#[test]
fn the_coherence_of_all_pairs_is_that_of_exact_marginals() {
    let mut rows = 0;
    for row in cells("eta.tsv") {
        let net = network(&row[0]);
        let (x, y) = (net.variable(&row[1]).unwrap(), net.variable(&row[2]).unwrap());
        let all = coherence(&net).unwrap();
        let pair = all.iter().find(|it| (it.x, it.y) == (x.min(y), x.max(y))).unwrap();
        let found = [pair.information, pair.entropy, pair.eta];
        for (found, wanted) in found.iter().zip(&row[3..]) {
            let wanted: f64 = wanted.parse().unwrap();
            assert!((found - wanted).abs() < 1e-12, "{row:?} {pair:?}");
        }
        rows += 1;
    }
    assert_eq!(rows, 53);
}

#[test]
fn a_witness_names_the_open_path() {
    let asia = network("asia");
    let path = |from, to, given: &[&str]| {
        let number = |name: &str| asia.variable(name).unwrap();
        let given: Vec<_> = given.iter().map(|it| number(it)).collect();
        let name = |it: &usize| asia.nodes()[*it].variable.name.clone();
        asia.open_path(number(from), number(to), &given)
            .map(|it| it.variables.iter().map(name).collect::<Vec<_>>().join(" "))
    };
    assert_eq!(path("asia", "smoke", &[]), None);
    assert_eq!(path("asia", "smoke", &["xray"]).unwrap(), "asia tub either lung smoke");
    assert_eq!(path("asia", "smoke", &["xray", "lung"]), None);
    assert_eq!(path("smoke", "dysp", &["bronc"]).unwrap(), "smoke lung either dysp");
    assert_eq!(path("smoke", "dysp", &["bronc", "either"]), None);
}

/// The distribution function of a mixture of two normal ones: figure 4.11 of the thesis.
fn mixture(x: f64) -> f64 {
    let normal = |mean: f64, deviation: f64| {
        0.5 * (1.0 + libm::erf((x - mean) / (deviation * std::f64::consts::SQRT_2)))
    };
    0.6 * normal(2.5, 0.5) + 0.4 * normal(7.0, 0.7)
}

#[test]
fn quantiles_of_the_figure_are_those_of_its_density() {
    let step = 1e-4;
    let cell = |at: i32| {
        let x = f64::from(at) * step;
        (x, mixture(x) - mixture(x - step))
    };
    let cells: Vec<_> = (-50_000..150_000).map(cell).collect();
    let mean: f64 = cells.iter().map(|it| (it.0 - step / 2.0) * it.1).sum();
    assert!((mean - 4.3).abs() < 1e-6);
    // Printed as 2.98 and 6.52.
    let q = |level| quantile(&cells, level, Convention::Reached).unwrap();
    assert!((q(0.5) - 2.984).abs() < 1e-3 && (q(0.7) - 6.528).abs() < 1e-3);
}
