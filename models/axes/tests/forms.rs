//! Named forms: each is the formula that it stands for.

use super::small::WALK;
use super::table;
use cotama_axes::{Case, Lifted};

/// Values of the travelling and the standing activity of the walk, whose cost has these formulas.
fn values(unit: &str, travel: &str, stand: &str) -> [i64; 2] {
    let keys = "stand_ms = 1000\nload_coins = 7\nidle_mw = 3000\nshare_permille = 333\n";
    let text = WALK
        .replace("cost = 1\n", "cost = 1\nload_coins = 5\nshare_permille = 333\nrate_coins_s = 3\n")
        .replace("stand_ms = 1000\n", keys)
        .replace("unit = \"coins\"", &format!("unit = \"{unit}\""))
        .replace(
            "travel = \"div_up(option(cost) * length_mm, 1000)\"",
            &format!("travel = {travel}"),
        )
        .replace("stand = \"option(cost)\"", &format!("stand = {stand}"))
        .replace("[[zone]]\nid = \"near\"\nx_start_mm = 0\nx_end_mm = 5000\n", "");
    let case = Case::parse(&text).unwrap_or_else(|wrongs| panic!("{wrongs}"));
    let table = table(&case, Lifted::default());
    // The first option of each task; a walk of 10 m at 500 mm/s, at 1000 mW.
    [0, 1].map(|it| table.activities[it].candidates[0].value(0))
}

#[test]
fn a_form_is_the_formula_that_it_stands_for() {
    let stands = "{ form = \"sum\", of = [\"option(stand_ms)\"] }";
    let travels = "{ form = \"length_over_speed\" }";
    assert_eq!(values("ms", travels, stands), [20_000, 1_000]);
    assert_eq!(values("s", travels, "\"0\""), [20, 0]);
    let power = "{ form = \"power_times_time\", power = [\"motion_mw\", \"option(idle_mw)\"] }";
    assert_eq!(values("mJ", power, power), [20_000, 3_000]);
    assert_eq!(values("J", power, power), [20, 3]);
    let rate = "{ form = \"rate_times_time\", rate = \"option(rate_coins_s)\", \
                plus = [\"option(load_coins)\"] }";
    assert_eq!(values("coins", rate, rate), [65, 7]);
    let share = |round: &str| {
        format!("{{ form = \"share_of_length\", share = \"option(share_permille)\"{round} }}")
    };
    assert_eq!(values("um", &share(""), "\"0\""), [3_330_000, 0]);
    assert_eq!(values("mm", &share(""), "\"0\""), [3_330, 0]);
    assert_eq!(values("dm", &share(", round = \"up\""), "\"0\""), [34, 0]);
    assert_eq!(values("m", &share(", round = \"down\""), "\"0\""), [3, 0]);
}

/// An indicator may be the sum of others, whose inducers are then its own.
#[test]
fn a_sum_reads_other_indicators() {
    let energy = "[[axis]]\nid = \"all\"\n[[axis.indicator]]\nid = \"double\"\nunit = \"ms\"\n\
                  combine = \"sum\"\n\
                  travel = { form = \"sum\", of = [\"work.time\", \"duration_ms\"] }\n\
                  stand = { form = \"sum\", of = [\"work.time\", \"work.time\"] }\n";
    let case = Case::parse(&format!("{WALK}{energy}")).unwrap_or_else(|wrongs| panic!("{wrongs}"));
    let number = case.mission.indicator("all.double").unwrap();
    let table = table(&case, Lifted::default());
    let of = |it: usize| table.activities[it].candidates[0].value(number);
    assert_eq!([of(0), of(2)], [20_000, 2_000]);
}
