//! The public verdicts of the Model Checking Contest.

use crate::check::{folder, replay};
use cotama_verification::certificate::verify;
use cotama_verification::check::{Model, Options, Verdict, check_all};
use cotama_verification::pnml::{Limits, read_within};
use cotama_verification::property::{Ids, Property, mcc};
use cotama_verification::pt::Pt;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// A public net and its properties in a file.
fn read(folder: &Path, file: &Path) -> (Model, Vec<Property>) {
    let name = file.file_name().unwrap().to_str().unwrap();
    let net = folder.join(name.split_once('.').unwrap().0.to_owned() + ".pnml");
    let imported = read_within("net", &std::fs::read(net).unwrap(), Limits::default()).unwrap();
    let pt = Pt::from(&imported.net.view().net());
    match mcc::read(name, &std::fs::read(file).unwrap(), &pt, Ids::from(&imported)) {
        Ok(properties) => (Model::from(pt), properties),
        Err(error) => panic!("{error}"),
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let files =
        std::fs::read_dir(folder.join("properties")).unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> =
        files.filter(|file| file.extension().is_some_and(|it| it == "xml")).collect();
    files.sort();
    files
}

/// Verdicts by file and property.
fn verdicts(folder: &Path) -> BTreeMap<(String, String), String> {
    let table = std::fs::read_to_string(folder.join("properties/verdicts.tsv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<_> = line.split('\t').map(str::to_owned).collect();
        ((cells[0].clone(), cells[1].clone()), cells[2].clone())
    };
    table.lines().skip(1).map(row).collect()
}

fn shown(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Holds(holds) => holds.to_string().to_uppercase(),
        Verdict::Bound(most) => most.to_string(),
        other => format!("{other:?}"),
    }
}

/// How many answers are of each sort.
#[derive(Debug, Default, PartialEq, Eq)]
struct Counts {
    asked: usize,
    /// Questions with a public verdict.
    compared: usize,
    certified: usize,
    /// With a run that replays.
    shown: usize,
}

fn answers(folder: &Path, evidence: bool) -> Counts {
    let (verdicts, mut counts) = (verdicts(folder), Counts::default());
    for file in files(folder) {
        let name = file.file_name().unwrap().to_str().unwrap();
        let (model, properties) = read(folder, &file);
        let answers = check_all(&model, &properties, &Options { evidence, ..Options::default() });
        for (property, answer) in properties.iter().zip(&answers) {
            let text = format!("{}: {}", property.name, property.question.display(model.pt()));
            counts.asked += 1;
            assert!(!matches!(answer.verdict, Verdict::Unknown(_)), "{text}: {:?}", answer.verdict);
            if let Some(expected) = verdicts.get(&(name.to_owned(), property.name.clone())) {
                assert_eq!(&shown(&answer.verdict), expected, "{text}");
                counts.compared += 1;
            }
            counts.shown += usize::from(replay::replays(model.pt(), &property.question, answer));
            if let Ok(certificate) = answer.certificate(model.pt(), property) {
                verify(&certificate.text()).unwrap_or_else(|error| panic!("{text}\n{error}"));
                counts.certified += 1;
            }
        }
    }
    counts
}

#[test]
fn every_public_property_has_its_verdict_a_certificate_and_a_run() {
    let Some(folder) = folder("public verdicts") else { return };
    let counts = answers(&folder, true);
    let expected = Counts {
        asked: 496,
        compared: cotama_golden::figure("contest.verdicts"),
        certified: 483,
        shown: 335,
    };
    assert_eq!(counts, expected);
}

#[test]
fn verdicts_are_the_same_without_evidence() {
    let Some(folder) = folder("public verdicts without evidence") else { return };
    let counts = answers(&folder, false);
    let expected = Counts {
        asked: 496,
        compared: cotama_golden::figure("contest.verdicts"),
        certified: 335,
        shown: 335,
    };
    assert_eq!(counts, expected);
}
