//! Structures against proven optima.

use crate::common::{cells, data};
use cotama_risk::{Constraints, Dag, Families, Limits, Score, exact, k2};

/// Reads `name<-a,b; ..` as a graph.
fn graph(text: &str, names: &[&str]) -> Dag {
    let number = |name: &str| names.iter().position(|it| *it == name).unwrap();
    let mut parents = vec![0; names.len()];
    for family in text.split("; ") {
        let (child, of) = family.split_once("<-").unwrap();
        let of = of.split(',').filter(|it| !it.is_empty());
        parents[number(child)] = of.fold(0, |mask, it| mask | 1 << number(it));
    }
    Dag::new(parents).unwrap()
}

#[test]
fn every_structure_has_the_score_that_is_proven() {
    let mut checked = [0; 3];
    for row in cells("expected.tsv").iter().filter(|it| it[1] == "learn") {
        let data = data(row[2].strip_suffix(".csv").unwrap());
        let names: Vec<_> = data.variables().iter().map(|it| it.name.as_str()).collect();
        let score = if row[3].contains("bic") { Score::Bic } else { Score::Bdeu { ess: 10.0 } };
        let mut families = Families::new(&data, score);
        let named = graph(&row[5], &names);
        let wanted: f64 = row[4].parse().unwrap();
        assert!((families.of(&named) - wanted).abs() < 1e-6, "{row:?}");
        if row[3].contains("method=exact") {
            let none = Constraints::none(names.len()).unwrap();
            let found = exact(&mut families, &none, Limits::default()).unwrap();
            assert!((found.score - wanted).abs() < 1e-6, "{row:?}: {found:?}");
            if row[0].starts_with("cancer") || row[0].starts_with("two_ways/bic") {
                assert_eq!(found.dag.compelled(), named.compelled(), "{row:?}");
            }
            checked[0] += 1;
        } else if let Some((_, order)) = row[3].split_once("order=") {
            let (order, most) = order.split_once(" max_parents=").unwrap();
            let number = |name: &str| names.iter().position(|it| *it == name).unwrap();
            let order: Vec<_> = order.split(',').map(number).collect();
            let wish = cotama_risk::Wish {
                max_parents: Some(most.parse().unwrap()),
                ..Default::default()
            };
            let bound = Constraints::new(names.len(), &wish).unwrap();
            assert_eq!(k2(&mut families, &order, &bound), named, "{row:?}");
            checked[1] += 1;
        } else {
            checked[2] += 1;
        }
    }
    assert_eq!(checked, [8, 12, 6]);
}
