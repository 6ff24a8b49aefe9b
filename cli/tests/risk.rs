//! `cotama risk`: what it answers, writes and refuses. The numbers are proven in the tests of
//! `cotama-risk`.

use crate::common::{Folder, golden};
use crate::help::examples;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// A file of known data.
fn known(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../models/risk/data");
    std::fs::read_to_string(folder.join(name)).unwrap()
}

/// A folder with these files.
fn folder(name: &str, files: &[&str]) -> Folder {
    let folder = Folder::new(name);
    files.iter().for_each(|it| folder.write(it.rsplit('/').next().unwrap(), known(it)));
    folder
}

fn near(found: &Value, wanted: f64) {
    assert!((found.as_f64().unwrap() - wanted).abs() < 1e-9, "{found} {wanted}");
}

#[test]
fn a_learned_network_is_optimal_and_says_so() {
    let folder = folder("risk_learn", &["cancer.csv"]);
    let line = ["risk", "learn", "cancer.csv", "--out", "cancer.bif", "--json"];
    let answer = folder.cotama(&line).json(0);
    near(&answer["value"], -4_267.672_429_946);
    assert_eq!(answer["proof"], "optimal");
    assert_eq!(answer["parents"]["Cancer"], json!(["Pollution", "Smoker"]));
    assert_eq!(answer["parents"]["Pollution"], json!([]));
    assert_eq!(answer["compelled"][0], json!(["Pollution", "Cancer"]));
    // Written and asked: the share of the data, with a prior of size one.
    let line = ["risk", "infer", "cancer.bif", "--query", "Smoker", "--json"];
    let smoke = |row: &&str| row.split(',').nth(1) == Some("True");
    let smokers = u32::try_from(known("cancer.csv").lines().filter(smoke).count()).unwrap();
    let wanted = (f64::from(smokers) + 0.5) / 2_001.0;
    near(&folder.cotama(&line).json(0)["posterior"]["True"], wanted);
    let shown = folder.cotama(&["risk", "learn", "cancer.csv"]);
    golden("risk_learn.txt", &shown.stdout);
}

#[test]
fn each_method_names_its_proof() {
    let folder = folder("risk_methods", &["cancer.csv"]);
    for (options, proof) in [
        ("--method hill --seed 3 --restarts 2", "local"),
        ("--method k2 --order Pollution,Smoker,Cancer,Xray,Dyspnoea", "given order"),
        ("--method mcmc --steps 500", "none"),
        ("--score bdeu --ess 1", "optimal"),
    ] {
        let words = ["risk", "learn", "cancer.csv", "--json"].into_iter();
        let words: Vec<_> = words.chain(options.split(' ')).collect();
        let answer = folder.cotama(&words).json(0);
        assert_eq!(answer["proof"], proof);
        assert_eq!(answer["bound"].is_null(), proof == "optimal", "{answer}");
    }
    let line = ["risk", "learn", "cancer.csv", "--json", "--require", "Xray->Smoker"];
    let line = [&line[..], &["--forbid", "Smoker->Cancer", "--max-parents", "1"]].concat();
    let answer = folder.cotama(&line).json(0);
    assert_eq!(answer["parents"]["Smoker"], json!(["Xray"]));
    assert_eq!(answer["max_parents"], 1);
}

#[test]
fn a_limit_of_exact_search_is_an_answer() {
    let folder = folder("risk_limit", &["cancer.csv"]);
    let line = ["risk", "learn", "cancer.csv", "--limit-variables", "4", "--json"];
    let answer = folder.cotama(&line).json(3);
    assert_eq!((&answer["method"], &answer["proof"]), (&json!("hill"), &json!("local")));
    assert_eq!(answer["limit"], "5 variables, and the limit of exact search is 4");
    assert!(answer["bound"].as_f64() > answer["value"].as_f64());
}

#[test]
fn a_posterior_has_all_its_digits() {
    let folder = Folder::new("risk_infer");
    let line = ["risk", "infer", "cancer", "--query", "Cancer", "--evidence", "Xray=positive"];
    let answer = folder.cotama(&[&line[..], &["--json"]].concat()).json(0);
    near(&answer["probability_of_evidence"], 0.208_141);
    near(&answer["posterior"]["True"], 0.050_288_025_905_516);
    assert_eq!(answer["evidence"], json!({ "Xray": "positive" }));
    golden("risk_infer.txt", &folder.cotama(&line).stdout);
    let line = ["risk", "infer", "asia", "--query", "tub", "--evidence", "smoke=yes", "--json"];
    assert_eq!(folder.cotama(&line).json(0)["without_influence"], json!(["smoke"]));
}

#[test]
fn pairs_stand_in_the_order_of_their_coherence() {
    let folder = Folder::new("risk_coherence");
    let line = ["risk", "coherence", "two-ways", "--svg", "a.svg", "--dot", "a.dot", "--json"];
    let answer = folder.cotama(&line).json(0);
    let etas: Vec<_> =
        answer["pairs"].as_array().unwrap().iter().map(|it| it["eta"].as_f64().unwrap()).collect();
    assert!(etas.len() == 15 && etas.is_sorted_by(|a, b| a >= b));
    assert!(folder.read("a.svg").contains("<title>way - run_time: "));
    assert!(folder.read("a.dot").contains("\"way\" -> \"run_time\" [label=\""));
    golden("risk_coherence.txt", &folder.cotama(&["risk", "coherence", "two-ways"]).stdout);
}

#[test]
fn measurements_become_steps() {
    let folder = Folder::new("risk_discretise");
    folder.write("runs.csv", "l,way\n1,a\n2,a\n3,b\n10,b\n");
    let line = ["risk", "discretise", "runs.csv"];
    assert_eq!(folder.cotama(&line).stdout, "l,way\n<4,a\n<4,a\n<4,b\n>=7,b\n");
    let line = [&line[..], &["--bins", "2", "--rule", "frequency", "--json"]].concat();
    let answer = folder.cotama(&line).json(0);
    assert_eq!(answer["columns"][0], json!({ "name": "l", "cuts": [3.0], "counts": [2, 2] }));
    assert_eq!(answer["kept"], json!(["way"]));
    let ended = folder.cotama(&["risk", "discretise", "runs.csv", "--out", "steps.csv"]);
    assert_eq!((ended.code, folder.read("steps.csv").lines().count()), (Some(0), 5));
    assert!(ended.stdout.contains("as before: way"), "{ended:?}");
}

#[test]
fn an_open_path_is_exit_code_1_and_its_witness() {
    let folder = Folder::new("risk_separated");
    let line = ["risk", "separated", "asia", "--x", "asia", "--y", "smoke", "--json"];
    assert_eq!(folder.cotama(&line).json(0)["separated"], true);
    let answer = folder.cotama(&[&line[..], &["--given", "xray"]].concat()).json(1);
    assert_eq!(answer["path"], json!(["asia", "tub", "either", "lung", "smoke"]));
    assert_eq!(answer["arcs"], json!(["->", "->", "<-", "<-"]));
    let shown = folder.cotama(&[&line[..7], &["--given", "xray"]].concat()).stdout;
    assert!(shown.ends_with("  asia -> tub -> either <- lung <- smoke\n"), "{shown}");
}

#[test]
fn a_choice_follows_measure_rule_and_belief() {
    let folder = folder("risk_choose", &["two_ways.toml", "two_ways.bif"]);
    let choose = |options: &str| {
        let words = ["risk", "choose", "two_ways.toml", "--json"].into_iter();
        let words: Vec<_> = words.chain(options.split_whitespace()).collect();
        folder.cotama(&words).json(0)
    };
    near(&choose("")["reward"], 62.618_083_120_3);
    near(&choose("--known ratio=r3_1")["reward"], 42.273_649_6);
    assert_eq!(choose("--known ratio=r3_1")["choice"], "long");
    // The odd case of the thesis, and its remedy.
    assert_eq!(choose("--known ratio=r3_1 --measure 0.75")["choice"], "short");
    let cured = choose("--known ratio=r3_1 --measure 0.75 --rule total");
    assert_eq!((&cured["choice"], &cured["sequence"][0]), (&json!("long"), &json!("long")));
    let twice = choose("--failed short/low --failed short/low");
    assert_eq!((&twice["choice"], &twice["trials"]), (&json!("long"), &json!(1)));
    near(&twice["belief"]["r5_1"], 0.552_928_159_690_9);
    let sum = choose("--failed short/low --failed short/low --memory sum");
    assert_eq!(sum["choice"], "short");
    golden("risk_choose.txt", &folder.cotama(&["risk", "choose", "two-ways"]).stdout);
}

#[test]
fn every_bad_file_is_refused_at_its_line() {
    let folder = Folder::new("risk_bad");
    for row in known("bad/expected.tsv").lines().skip(1) {
        let cells: Vec<_> = row.split('\t').collect();
        folder.write(cells[0], known(&format!("bad/{}", cells[0])));
        let is_data = Path::new(cells[0]).extension().is_some_and(|it| it == "csv");
        let line = if is_data {
            ["risk", "learn", cells[0], "--method", "k2", "--json"]
        } else {
            ["risk", "infer", cells[0], "--query", "Cancer", "--json"]
        };
        let ended = folder.cotama(&line);
        if cells[0] == "one_state.csv" {
            assert_eq!(ended.json(0)["constant"][0], "Pollution");
            assert!(ended.stderr.contains("Pollution has one state only"), "{ended:?}");
            continue;
        }
        let answer = ended.json(2);
        assert_eq!(answer["file"], cells[0]);
        if cells[1] != "-" {
            assert_eq!(answer["line"].to_string(), cells[1], "{answer}");
        }
    }
    let line = ["risk", "infer", "unknown_parent.bif", "--query", "Cancer"];
    golden("risk_bad.txt", &folder.cotama(&line).stderr);
}

#[test]
fn a_mistake_of_the_command_line_says_what_was_meant() {
    let folder = folder("risk_mistakes", &["cancer.csv", "two_ways.toml", "two_ways.bif"]);
    folder.write("wrong.toml", known("two_ways.toml").replace("\"way\"", "\"wey\""));
    let mut said = String::new();
    for line in [
        "infer asai --query lung",
        "infer asia --query lnug",
        "infer asia --query lung --evidence xray=yess",
        "infer asia --query xray --evidence lung=yes --evidence either=no",
        "learn cancer.csv --ess 3",
        "learn cancer.csv --method hill --order Smoker",
        "learn cancer.csv --method k2 --order Smoker",
        "learn cancer.csv --require Smoker->Cancre",
        "learn cancer.csv --require Smoker->Cancer --forbid Smoker->Cancer",
        "learn cancer.csv --out net.xml",
        "discretise cancer.csv --rule mdl --class Smokre",
        "separated asia --x asia --y asia",
        "choose two-ways --known ratio=r31",
        "choose two-ways --failed short",
        "choose two-ways --failed short/low --failed short/low --failed short/low",
        "choose wrong.toml",
        "learn two_ways.toml",
    ] {
        let words: Vec<_> = ["risk"].into_iter().chain(line.split(' ')).collect();
        let ended = folder.cotama(&words);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{line}: {ended:?}");
        let _ = write!(said, "$ cotama risk {line}\n{}", ended.stderr);
    }
    golden("risk_mistakes.txt", &said);
}

#[test]
fn every_example_of_risk_runs_and_ends_as_it_says() {
    let parts =
        ["", "learn", "infer", "coherence", "discretise", "separated", "choose", "table", "sample"];
    for part in parts {
        let folder = Folder::new(&format!("risk_help_{part}"));
        let help = folder.shell(&format!("cotama risk {part} --help"));
        assert_eq!(help.code, Some(0));
        let examples = examples(&help.stdout);
        assert!(examples.len() >= 2, "{}", help.stdout);
        for example in examples {
            let expected = i32::from(example.contains("exit code 1"));
            let ended = folder.shell(&example);
            assert_eq!(ended.code, Some(expected), "{example}: {ended:?}");
        }
    }
}
