//! Files of teams at work that are none, told with their places and near names; the
//! messages are in `tests/golden/teams_at_work.txt`. Limits are told as such.

use cotama_models::team::scenario::Scenario;
use std::fmt::Write;

const SERVICE: &str = include_str!("../../teams/service.toml");

/// One text of the service, and another in its place.
const BROKEN: [(&str, &str); 67] = [
    ("cotama-team/1", "cotama-team/2"),
    ("format = \"cotama-team/1\"\n", ""),
    ("name = \"service\"\n", ""),
    ("skills = [\"move\", \"detect\"", "skils = [\"move\", \"detect\""),
    ("\"cue-hold\", \"dialogue\", \"badge\"]", "\"cue hold\"]"),
    ("[network]", "[netwrk]"),
    ("delay_ms = 5", "delay_ms = -5"),
    ("jitter_ms = 45", "jitter = 45"),
    ("loss_permille = 0", "loss_permille = 1001"),
    ("copies_permille = 5", "copies_permille = 0.5"),
    ("method = \"optimal\"", "method = \"optimum\""),
    ("formation = \"distributed\"", "formation = \"distribute\""),
    ("auctioneer = \"Eddie\"", "auctioneer = \"Eddi\""),
    ("slack_permille = 500", "takeover = \"yes\""),
    ("slack_permille = 500", "slack_permille = \"half\""),
    ("second_best = true", "second_best = 1"),
    ("second_best = true", "trust = \"learnt\""),
    ("second_best = true", "trst = \"learned\""),
    ("on = \"service\"", "on = 7"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\njoins_ms = 5000\nleaves_ms = 5000\n"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\njoin_ms = 5000\n"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\nfile = \"transprt\"\n"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\nfile = 7\n"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\nfile = \"transport\"\n"),
    ("places = [\"desk\",", "places = [\"desk\", \"desk\","),
    ("length_mm = 6000", "length_mm = 0"),
    ("length_mm = 6000", "length_mm = \"6 m\""),
    ("between = [\"hall\", \"kitchen\"]", "between = [\"hall\", \"kitchn\"]"),
    ("between = [\"hall\", \"kitchen\"]", "between = [\"hall\", \"hall\"]"),
    ("name = \"Jimmy\"", "name = \"Eddie\""),
    ("name = \"Jimmy\"", "name = \"\""),
    ("at = \"billiards\"", "at = \"biliards\""),
    ("\"grasp-3f\"]", "\"grasp-3f 7\"]"),
    ("\"grasp-3f\"]", "\"grasp-3f 1001/1000\"]"),
    ("\"grasp-3f\"]", "{ nam = \"grasp-3f\" }]"),
    ("\"grasp-3f\"]", "{ name = \"grasp-3f\", fails = 200 }]"),
    ("\"grasp-3f\"]", "{ name = \"grasp-3f\", fails_permille = 1001 }]"),
    ("\"grasp-3f\"]", "{ name = \"grasp-3f\", permille = 900, failed = 1 }]"),
    ("\"grasp-3f\"]", "{ name = \"grasp-3f\", succeeded = -1 }]"),
    ("\"grasp-3f\"]", "{ name = \"grasp 3f\" }]"),
    ("\"grasp-3f\"]", "9]"),
    ("after = \"order\"", "after = \"ordr\""),
    ("skip_ms = 600000", "skip = 600000"),
    ("from = \"kitchen\"", "from = \"kichen\""),
    ("combine = \"mean\"", "combine = \"average\""),
    ("extra_ms = 300000", "extra_ms = 99999999999"),
    ("[\"dialogue\"]]", "[\"dialog\"]]"),
    ("take = \"object\"", "take = \"objekt\""),
    ("give = \"goal\"", "give = { partner_at = \"desk\" }"),
    ("give = \"nobody\"", "give = { words_at = \"desk\" }"),
    ("take_ms = 15000\n", ""),
    ("stage = \"takes\"", "stage = \"take\""),
    ("while = \"Eddie\"", "while = \"Edie\""),
    ("shifts = \"serve\"", "shifts = \"serv\""),
    ("hides = [\"grasp-2f\"]", "hides = [\"grasp-2\"]"),
    ("mode = \"EST1\"", "mode = \"EST\""),
    ("length_mm = 6000", "length_mm = 6000\ndelays_ms = []"),
    ("length_mm = 6000", "length_mm = 6000\ndelays_ms = [0, -5]"),
    ("length_mm = 6000", "length_mm = 6000\nseen_ms = [5]"),
    (
        "length_mm = 6000",
        "length_mm = 6000\ndelays_ms = [5]\n[[floor.way]]\nbetween = [\"kitchen\", \"hall\"]\n\
         length_mm = 6000\ndelays_ms = [5]",
    ),
    ("length_mm = 6000", "length_mm = 6000\ndelay_ms = [5]"),
    ("second_best = true", "travel = \"median\""),
    ("second_best = true", "travel = \"mean\"\ntravel_permille = 900"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\nbattery = { home = \"hall\" }\n"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\nbattery = { home = \"hal\", charger_w = 90 }\n"),
    ("name = \"Eddie\"\n", "name = \"Eddie\"\nbattery = { home = \"hall\", charger_w = 1 }\n"),
    (
        "name = \"Eddie\"\n",
        "name = \"Eddie\"\nbattery = { home = \"hall\", charger_w = 90, charge_permille = 0 }\n",
    ),
];

#[test]
fn broken_teams_are_refused_at_their_places() {
    let mut said = String::new();
    for (old, new) in BROKEN {
        assert!(SERVICE.contains(old), "{old}");
        let errors = Scenario::parse("team.toml", &SERVICE.replacen(old, new, 1)).err();
        let errors = errors.unwrap_or_else(|| panic!("{new} is accepted"));
        let (old, new) = (old.escape_debug(), new.escape_debug());
        let _ = write!(said, "--- {old} => {new}\n{errors}\n");
    }
    cotama_golden::compare("tests/golden/teams_at_work.txt", &said);
}

/// The first message of the service with as many more tables of a kind as are too many.
fn beyond(table: impl Fn(usize) -> String, count: usize) -> String {
    let more: String = (0..count).map(table).collect();
    let errors = Scenario::parse("team.toml", &format!("{SERVICE}\n{more}")).unwrap_err();
    let message = &errors.diagnostics()[0].message;
    message.clone()
}

#[test]
fn a_team_beyond_a_limit_is_refused_with_the_limit() {
    let robot = |it: usize| format!("[[robot]]\nname = \"r{it}\"\nat = \"hall\"\nskills = []\n");
    let found = beyond(robot, 61);
    assert_eq!(found, "`robot` has 65 entries; at most 64 are allowed");
    let fault = |it: usize| format!("[[fault]]\nat_ms = {it}\nshifts = \"serve\"\n");
    let found = beyond(fault, 9_998);
    assert_eq!(found, "`fault` has 10001 entries; at most 10000 are allowed");
    let plan = |_| "[[task.plan]]\nname = \"p\"\n".to_owned();
    let task = "[[task]]\nname = \"more\"\nfrom = \"hall\"\nto = \"desk\"\nskip_ms = 1\n";
    let plans = |it: usize| if it == 0 { task.to_owned() } else { plan(it) };
    assert_eq!(beyond(plans, 18), "`plan` has 17 entries; at most 16 are allowed");
    let names: Vec<String> = (0..33).map(|it| format!("\"s{it}\"")).collect();
    let many =
        |_| format!("[[robot]]\nname = \"many\"\nat = \"hall\"\nskills = [{}]\n", names.join(", "));
    assert_eq!(beyond(many, 1), "there are more than 32 skills");
    let skills = vec!["\"move\""; 1_001].join(", ");
    let long = |_| format!("[[robot]]\nname = \"long\"\nat = \"hall\"\nskills = [{skills}]\n");
    let found = beyond(long, 1);
    assert_eq!(found, "`skills` has 1001 entries; at most 1000 are allowed");
}
