//! Texts: read, refused, written.

use crate::common::{cells, data, network, text};
use cotama_risk::{Cells, Data, Network, Rule, Wrong, discretise};

fn refused(file: &str) -> Wrong {
    let text = text(&format!("bad/{file}"));
    if file.ends_with(".csv") {
        Data::from_csv(&text).unwrap_err()
    } else {
        Network::from_bif(&text).unwrap_err()
    }
}

#[test]
fn a_bad_file_is_refused_where_it_is_wrong() {
    let mut files = 0;
    for row in cells("bad/expected.tsv").iter().filter(|it| it[0] != "one_state.csv") {
        let wrong = refused(&row[0]);
        if row[1] != "-" {
            assert_eq!(wrong.line.to_string(), row[1], "{row:?}: {wrong}");
        }
        files += 1;
    }
    assert_eq!(files, 15);
}

#[test]
fn a_refusal_says_cause_place_and_near_name() {
    let told = |file| refused(file).to_string();
    assert_eq!(
        told("unknown_parent.bif"),
        "30:22: no variable Cancre\n  help: did you mean `Cancer`?"
    );
    assert_eq!(told("cycle.bif"), "18:1: Pollution -> Cancer -> Xray -> Pollution is a cycle");
    assert_eq!(
        told("row_sum.bif"),
        "26:3: row (high, True) of Cancer sums to 1.01\n  help: probabilities of a row sum to 1"
    );
    assert_eq!(told("missing_row.bif"), "24:1: Cancer has no row for (low, False)");
    assert_eq!(
        told("twice_row.bif"),
        "28:3: Cancer has two rows for (low, False)\n  help: remove one of them"
    );
    assert_eq!(told("unknown_state.bif"), "27:4: Pollution has no state medium");
    assert_eq!(told("no_table.bif"), "6:10: Smoker has no probability block");
    assert_eq!(told("negative.bif"), "22:9: probability -0.3 of Smoker");
    assert_eq!(told("truncated.bif"), "25:23: the file ends inside a block\n  help: is it whole?");
    assert_eq!(told("wrong_count.bif"), "4:19: Pollution declares 3 states and lists 2");
    assert_eq!(told("ragged.csv"), "6:1: 4 cells, the header has 5");
    assert!(told("empty_cell.csv").starts_with("8:1: cell 3 (Cancer) is empty"));
    assert!(told("same_name.csv").starts_with("1:1: two columns are called Smoker"));
    assert!(told("header_only.csv").starts_with("no rows"));
    assert!(told("empty.csv").starts_with("empty file"));
}

#[test]
fn a_column_of_one_state_is_read_and_named() {
    let data = Data::from_csv(&text("bad/one_state.csv")).unwrap();
    assert_eq!(data.constant(), ["Pollution", "Cancer"]);
}

#[test]
fn one_network_in_two_spellings_is_the_same() {
    let other = network("cancer_spelled_otherwise");
    for (one, two) in network("cancer").nodes().iter().zip(other.nodes()) {
        assert_eq!(one, two);
    }
}

#[test]
fn a_flat_table_has_the_state_of_its_variable_slowest() {
    let dog = network("dog_problem");
    let node = &dog.nodes()[dog.variable("dog-out").unwrap()];
    assert_eq!(node.table, [0.99, 0.01, 0.97, 0.03, 0.9, 0.1, 0.3, 0.7]);
}

#[test]
fn the_same_network_in_xml_is_the_same() {
    for name in ["cancer", "dog_problem"] {
        let file = text(&format!("{name}.xmlbif"));
        let (found, notes) = Network::from_xmlbif(&file).unwrap();
        assert_eq!((&found, notes.len()), (&network(name), 0), "{name}");
        let wrong = Network::from_xmlbif(&file.replace("</NETWORK>\n</BIF>", "")).unwrap_err();
        assert!(wrong.message.ends_with("the file ends inside <NETWORK>"), "{wrong}");
    }
    let wrong = |from: &str, to: &str| {
        Network::from_xmlbif(&text("cancer.xmlbif").replacen(from, to, 1)).unwrap_err().to_string()
    };
    assert_eq!(
        wrong("<FOR>Smoker</FOR>", "<FOR>Smokre</FOR>"),
        "35:8: no variable Smokre\n  help: did you mean `Smoker`?"
    );
    assert_eq!(wrong("0.9 0.1", "-0.9 1.9"), "32:10: probability -0.9 of Pollution");
    assert_eq!(wrong("0.9 0.1", "0.9"), "32:10: the table of Pollution has 1 numbers, not 2");
    assert_eq!(wrong("low", "&high;"), "7:12: an entity that is none of XML's five");
}

/// The networks of the repository of bnlearn and like ones: each is read, written, and read as it
/// was.
#[test]
fn public_networks_are_read_and_written() {
    let Some(folder) = cotama_golden::public_folder("COTAMA_RISK_DIR", "public networks") else {
        return;
    };
    let mut read = 0;
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        if path.extension().is_some_and(|it| it == "bif") {
            let text = std::fs::read_to_string(&path).unwrap();
            let (net, _) = Network::from_bif(&text).unwrap_or_else(|it| panic!("{path:?}: {it}"));
            let (again, notes) = Network::from_bif(&net.to_bif()).unwrap();
            for (one, two) in net.nodes().iter().zip(again.nodes()) {
                let both = one.table.iter().zip(&two.table);
                assert!(both.into_iter().all(|it| (it.0 - it.1).abs() < 1e-12), "{path:?}");
            }
            assert!(notes.is_empty(), "{path:?}: {notes:?}");
            read += 1;
        }
    }
    assert!(read > 0, "no file ends in .bif");
}

#[test]
fn a_written_network_is_read_as_it_was() {
    for name in ["cancer", "asia", "two_ways", "sixteen", "dog_problem"] {
        let network = network(name);
        let (again, notes) = Network::from_bif(&network.to_bif()).unwrap();
        assert_eq!((&again, notes.len()), (&network, 0), "{name}");
    }
}

#[test]
fn written_data_is_read_as_it_was() {
    let rows = data("two_ways");
    assert_eq!(Data::from_csv(&rows.to_csv()).unwrap(), rows);
    let quoted = "\"a,b\",c\r\n\"say \"\"so\"\"\",1\r\n\r\n two , 2 \r\n";
    let cells = Cells::parse(quoted).unwrap();
    assert_eq!(cells.header, ["a,b", "c"]);
    assert_eq!(cells.columns, [["say \"so\"", "two"], ["1", "2"]]);
    assert_eq!(Cells::parse(&cells.to_csv()).unwrap(), cells);
}

#[test]
fn rows_that_miss_1_by_their_rounding_are_normalised_and_named() {
    let file = |row: &str| {
        format!(
            "network n {{ }}\nvariable a {{ type discrete [ 3 ] {{ x, y, z }}; }}\n\
             probability ( a ) {{ table {row}; }}\n"
        )
    };
    let (net, notes) = Network::from_bif(&file("0.3333, 0.3333, 0.3333")).unwrap();
    assert_eq!(net.nodes()[0].table, [1.0 / 3.0; 3]);
    assert_eq!(
        notes,
        ["1 row misses a sum of 1 by less than the rounding of its numbers, and is normalised: \
          line 3"]
    );
    assert_eq!(Network::from_bif(&file("0.3333, 0.3333, 0.33")).unwrap_err().line, 3);
    assert_eq!(Network::from_bif(&file("0.5, 0.5, 1e-7")).unwrap().1.len(), 1);
    // Six digits each, wherever the point is; and two digits, which miss too much.
    assert_eq!(Network::from_bif(&file("0.0205584, 0.979441, 5.53e-7")).unwrap().1.len(), 1);
    assert!(Network::from_bif(&file("0.5, 0.49, 0.001")).is_err());
    assert_eq!(Network::from_bif(&file("0.452774, 0.547225, 0")).unwrap().1.len(), 1);
    // Single precision, written with the digits of double precision, as pyAgrum does.
    let single = file("0.9723618030548096, 0.027638191357254982, 0");
    assert_eq!(Network::from_bif(&single).unwrap().1.len(), 1);
}

#[test]
fn states_stand_in_the_order_of_their_numbers_or_letters() {
    let data = Data::from_csv("a,b\n10,x10\n9,x9\n-1,x1\n").unwrap();
    assert_eq!(data.variables()[0].states, ["-1", "9", "10"]);
    assert_eq!(data.variables()[1].states, ["x1", "x10", "x9"]);
}

#[test]
fn steps_have_equal_width_or_equal_frequency_or_tell_of_a_class() {
    let text: String = (0..12).map(|it| format!("{},{}\n", it * it, it / 4)).collect();
    let cells = Cells::parse(&format!("v,class\n{text}")).unwrap();
    let cut = |rule| discretise(&cells, &rule).unwrap().1.remove(0);
    assert_eq!(cut(Rule::Width { bins: 3 }).counts, [7, 2, 3]);
    assert_eq!(cut(Rule::Frequency { bins: 3 }).cuts, [16.0, 64.0]);
    assert_eq!(cut(Rule::Frequency { bins: 3 }).counts, [4, 4, 4]);
    // Classes that touch at 16 and 64 pay for both cuts.
    let mdl = cut(Rule::Mdl { class: "class".to_owned() });
    assert_eq!((mdl.cuts, mdl.counts), (vec![16.0, 64.0], vec![4, 4, 4]));
    let noise: String = (0..12).map(|it| format!("{it},{}\n", it % 2)).collect();
    let cells = Cells::parse(&format!("v,class\n{noise}")).unwrap();
    let rule = Rule::Mdl { class: "clas".to_owned() };
    assert_eq!(
        discretise(&cells, &rule).unwrap_err().to_string(),
        "no column clas\n  help: did you mean `class`?"
    );
    let rule = Rule::Mdl { class: "class".to_owned() };
    assert_eq!(discretise(&cells, &rule).unwrap().1[0].counts, [12], "noise pays for no cut");
}
