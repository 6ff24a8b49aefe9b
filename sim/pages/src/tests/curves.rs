use super::assert_sound;
use super::layout::check_drawings;
use crate::curves::{Curves, Messages, html};
use cotama_models::team::curves::{benchmark, growth};

/// Teams of up to so many robots, with the messages of Table 3.1.
fn curves(most: u64) -> Curves {
    let messages = |n: u64| Messages {
        singles: 4 * n,
        central: n * n + 3 * n,
        distributed: 3 * n * n + 3 * n,
    };
    let teams = || 2..=most as usize;
    Curves {
        growth: teams().map(|it| (growth(it), messages(it as u64))).collect(),
        benchmark: teams().flat_map(|it| (0..=it).map(move |own| benchmark(it, own))).collect(),
    }
}

#[test]
fn the_curves_stand_within_their_drawings_and_say_their_numbers() {
    for most in [2, 3, 8, 12] {
        let page = html(&curves(most));
        assert_sound(&page);
        assert!(check_drawings(&page, &most.to_string()) > 60);
    }
    let page = html(&curves(8));
    for figure in ["3.4a", "3.4b", "3.5a", "3.5b", "3.8"] {
        assert!(page.contains(&format!("Fig. {figure}")), "{figure}");
    }
    for said in [
        "all coalitions (MuRoCo): 22\u{202f}528; robots: 8",
        "orderings: 109\u{202f}600; robots: 8",
        "MuRoCo-D: 216; robots: 8",
        "least k/n: 0.708; robots: 8",
        "8 robots: 72; capable robots: 4",
        "cap2: each role has one who can: 0.856; capable robots: 1",
    ] {
        assert!(page.contains(said), "{said}");
    }
}

#[test]
fn curves_of_no_team_are_an_empty_page() {
    let page = html(&Curves { growth: Vec::new(), benchmark: Vec::new() });
    assert_sound(&page);
    assert!(!page.contains("<svg"));
}
