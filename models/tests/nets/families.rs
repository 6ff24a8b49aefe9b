//! The families against what is published of them.

use crate::laws;
use crate::textbook::explore;
use cotama_core::net::owned::{OwnedLaw, OwnedNet};
use cotama_models::nets::families::{fms, kanban, philosophers, swimming_pool, token_ring};

/// Places, transitions, arcs; a place that is read counts for an arc there and one back.
fn parts(net: &OwnedNet) -> (usize, usize, usize) {
    let arcs = net.transitions.iter().map(|it| it.take.len() + it.give.len() + 2 * it.read.len());
    (net.places.len(), net.transitions.len(), arcs.sum())
}

/// Reachable markings and firings, when all laws hold.
fn counts(net: &OwnedNet) -> (usize, usize) {
    let view = net.view();
    let net = view.net();
    assert_eq!(net.defect(), None);
    let graph = explore(&net, 100_000).unwrap();
    assert_eq!(laws::broken(&net, &graph), None);
    (graph.markings.len(), graph.edges())
}

#[test]
fn families_say_which_sums_of_tokens_stay_as_they_are() {
    let sums = |net: OwnedNet| {
        let sums = net.laws.iter().filter(|it| matches!(it, OwnedLaw::Invariant { .. }));
        sums.count()
    };
    let of = [philosophers(5), token_ring(5), kanban(2), fms(2), swimming_pool(2)];
    assert_eq!(of.map(|it| sums(it.unwrap())), [10, 6, 4, 6, 3]);
}

#[test]
fn philosophers_have_three_to_the_n_markings() {
    for n in 2..=8 {
        let net = philosophers(n).unwrap();
        assert_eq!(parts(&net), (5 * n as usize, 5 * n as usize, 16 * n as usize));
        assert_eq!(counts(&net).0, 3_usize.pow(n));
    }
    // Model Checking Contest, Philosophers-PT-000005.
    assert_eq!(counts(&philosophers(5).unwrap()), (243, 945));
}

#[test]
fn philosophers_starve_in_two_ways() {
    let net = philosophers(5).unwrap();
    let graph = explore(&net.view().net(), 1_000).unwrap();
    let dead = graph.firings.iter().filter(|it| it.is_empty()).count();
    assert_eq!(dead, 2); // Model Checking Contest, Philosophers-PT-000005
}

#[test]
fn a_token_ring_has_the_published_counts() {
    // Model Checking Contest, TokenRing-PT-005 and TokenRing-PT-010.
    let net = token_ring(5).unwrap();
    assert_eq!(parts(&net), (36, 156, 624));
    assert_eq!(counts(&net), (166, 365));
    assert_eq!(counts(&token_ring(10).unwrap()).0, 58_905);
}

#[test]
fn a_kanban_system_has_the_published_counts() {
    // Ciardo and Tilgner 1996, table of reachable markings.
    let markings = [1, 2, 3].map(|n| counts(&kanban(n).unwrap()).0);
    assert_eq!(markings, [160, 4_600, 58_400]);
    assert_eq!(parts(&kanban(5).unwrap()), (16, 16, 40));
}

#[test]
fn a_flexible_manufacturing_system_has_the_published_counts() {
    // Model Checking Contest, FMS-PT-00002: 3,444 markings and 16,311 firings. Those for 1 and 3
    // parts were counted by other explorers of the same net.
    let markings = [1, 2, 3].map(|n| counts(&fms(n).unwrap()).0);
    assert_eq!(markings, [120, 3_444, 48_590]);
    assert_eq!(counts(&fms(2).unwrap()).1, 16_311);
    assert_eq!(parts(&fms(2).unwrap()), (22, 20, 50));
}

#[test]
fn a_swimming_pool_has_the_published_counts() {
    // Model Checking Contest, SwimmingPool-PT-01.
    let net = swimming_pool(1).unwrap();
    assert_eq!(parts(&net), (9, 7, 20));
    assert_eq!(counts(&net), (89_621, 450_003));
}

/// With the nets of the Model Checking Contest in the folder `COTAMA_MCC_DIR`: as many places,
/// transitions and arcs.
#[test]
fn the_contests_own_nets_have_as_many_parts() {
    let Some(folder) = cotama_golden::public_folder("COTAMA_MCC_DIR", "families of nets") else {
        return;
    };
    for (file, net) in [
        ("Philosophers-PT-000005", philosophers(5)),
        ("Philosophers-PT-000010", philosophers(10)),
        ("TokenRing-PT-005", token_ring(5)),
        ("Kanban-PT-00005", kanban(5)),
        ("FMS-PT-00002", fms(2)),
        ("FMS-PT-00005", fms(5)),
        ("SwimmingPool-PT-01", swimming_pool(1)),
    ] {
        let path = folder.join(format!("{file}.pnml"));
        let text = std::fs::read_to_string(&path)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let count = |tag: &str| text.matches(&format!("<{tag} ")).count();
        assert_eq!(
            parts(&net.unwrap()),
            (count("place"), count("transition"), count("arc")),
            "{file}"
        );
    }
}
