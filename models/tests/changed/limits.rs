//! Each limit of what is read, met and passed by one.

use cotama_models::fmeca::{Analysis, MAX_FLAGS, MAX_PROBES};
use cotama_models::missions::{MAX_DIAGNOSTICS, Mission, embedded};
use cotama_models::team::instance::Instance;
use std::fmt::Write;

/// What is said of an instance with these parts, of one task of this kind for two robots.
fn instance(denominator: u64, task: &str) -> Result<Instance, String> {
    let text = format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"large\", \
         \"kind\": \"simultaneous\", \"cost_denominator\": {denominator}, \
         \"robots\": [\"a\", \"b\"], \"tasks\": [{task}]}}"
    );
    Instance::parse("large.json", &text).map_err(|it| it.to_string())
}

/// The most that tasks cost: the largest of their plans, or what leaving them undone costs.
#[test]
fn costs_in_parts_fill_63_bits_and_no_more() {
    let most = 1_000_000_000_u64;
    let plan = |name: &str, extra: u64, cost: u64| {
        format!(
            "{{\"name\": \"{name}\", \"extra_cost\": {extra}, \"roles\": [\
             {{\"name\": \"one\", \"cost\": [{cost}, 1]}}, \
             {{\"name\": \"two\", \"cost\": [2, null]}}]}}"
        )
    };
    let task = |number: u32, skip: u64, plans: &[String]| {
        format!(
            "{{\"name\": \"t{number}\", \"skip_cost\": {skip}, \"combine\": \"sum\", \
             \"plans\": [{}]}}",
            plans.join(", ")
        )
    };
    // Two roles of the largest cost, and more for the plan; tasks that are dear to leave.
    let large = task(0, 7, &[plan("small", 3, 5), plan("large", 999_999_937, most)]);
    let dear = (1..9).map(|number| task(number, 999_999_929, &[plan("small", 3, 5)]));
    let all: Vec<_> = std::iter::once(large).chain(dear).collect();
    let units = 2 * most + 999_999_937 + 8 * 999_999_929;
    let largest = i64::MAX as u64 / units;
    assert!(instance(largest, &all.join(", ")).is_ok());
    let said = instance(largest + 1, &all.join(", ")).unwrap_err();
    assert!(said.contains("in such parts the cost may pass 63 bits"), "{said}");
    // With one of them less they may be finer.
    assert!(instance(largest + 1, &all[1..].join(", ")).is_ok());
    assert!(instance(largest + 1, &all[..8].join(", ")).is_ok());
}

const HEAD: &str = "id,function,component,failure,cause,effect,severity,mtbf_h,latency_ms,flags\n";

fn csv(text: &str) -> Result<Analysis, String> {
    Analysis::parse_csv("large.csv", text).map_err(|it| it.to_string())
}

#[test]
fn a_text_has_1_000_characters_and_no_more() {
    let row = |length: usize| format!("{HEAD}A,f,c,{},y,z,weak,100,5,a\n", "ä".repeat(length));
    assert!(csv(&row(1_000)).is_ok());
    for length in [1_001, 1_002, 5_000] {
        let said = csv(&row(length)).unwrap_err();
        assert!(said.contains("has more than 1000 characters"), "{said}");
    }
}

#[test]
fn an_id_has_64_characters_and_no_more() {
    let row = |length: usize| format!("{HEAD}{},f,c,x,y,z,weak,100,5,a\n", "i".repeat(length));
    assert!(csv(&row(64)).is_ok() && csv(&row(65)).is_err() && csv(&row(0)).is_err());
    let mission = embedded::mission("patrol").unwrap().text;
    let named = |length: usize| mission.replace("\"M7\"", &format!("\"{}\"", "M".repeat(length)));
    assert!(Mission::parse("", &named(64)).is_ok() && Mission::parse("", &named(65)).is_err());
    assert!(Mission::parse("", &named(0)).is_err());
}

#[test]
fn latencies_and_times_between_failures_have_their_largest() {
    let row = |mtbf: &str, latency: &str| format!("{HEAD}A,f,c,x,y,z,weak,{mtbf},{latency},a\n");
    assert!(csv(&row("1000000000", "1000000000")).is_ok());
    assert!(csv(&row("1000000001", "5")).is_err() && csv(&row("5", "1000000001")).is_err());
    assert!(csv(&row("0.001", "0")).is_ok() && csv(&row("0.0001", "0")).is_err());
}

#[test]
fn as_many_flags_as_are_read_and_one_more() {
    let row = |first: usize, count: usize| {
        let names: Vec<_> = (first..first + count).map(|it| format!("f{it}")).collect();
        format!("M{first},f,c,x,y,z,weak,100,5,{}\n", names.join(";"))
    };
    let rows = |last: usize| format!("{HEAD}{}{}", row(0, 4_000), row(4_000, last));
    let most = csv(&rows(MAX_FLAGS - 4_000)).unwrap();
    assert_eq!(most.flags().len(), MAX_FLAGS);
    let said = csv(&rows(MAX_FLAGS - 3_999)).unwrap_err();
    assert!(said.contains("the rows name 4097 flags; at most 4096 are read"), "{said}");
}

#[test]
fn as_many_probes_as_are_read_and_one_more() {
    let with = |count: usize| {
        let mut text =
            String::from("format = \"cotama-fmeca/1\"\ntitle = \"probes\"\nperiod_h = 1\n");
        for at in 0..count {
            writeln!(text, "[[probe]]\nname = \"p{at}\"\nshows = [\"A{}\"]", at % 2).unwrap();
        }
        for at in 0..2 {
            writeln!(
                text,
                "[[mode]]\nid = \"A{at}\"\nfunction = \"f\"\ncomponent = \"c\"\nfailure = \"x\"\n\
                 cause = \"y\"\neffect = \"z\"\nseverity = \"weak\"\nflags = [\"a\"]\n\
                 latency_ms = 1\nmtbf_h = 5"
            )
            .unwrap();
        }
        Analysis::parse("large.toml", &text).map_err(|it| it.to_string())
    };
    let most = with(MAX_PROBES).unwrap();
    assert_eq!(most.probes().len(), MAX_PROBES);
    let told = most.diagnose(&most.sound());
    assert_eq!(told.pairs.len(), 1);
    assert!(with(MAX_PROBES + 1).is_err());
}

#[test]
fn as_many_mistakes_as_are_told_and_one_more() {
    let mission = embedded::mission("patrol").unwrap().text;
    for count in [MAX_DIAGNOSTICS - 1, MAX_DIAGNOSTICS, MAX_DIAGNOSTICS + 1] {
        let wrong = (0..count).fold(String::new(), |text, it| text + &format!("wrong{it} = 1\n"));
        let errors = Mission::parse("", &format!("{wrong}{mission}")).unwrap_err();
        let told = count.min(MAX_DIAGNOSTICS);
        assert_eq!((errors.diagnostics().len(), errors.omitted()), (told, count - told));
    }
}

#[test]
fn as_many_zones_as_are_read_and_one_more() {
    let mission = embedded::mission("patrol").unwrap().text;
    let here = mission.matches("[[zone]]").count();
    let with = |count: usize| {
        let zone = |it| format!("[[zone]]\nid = \"z{it}\"\nx_start_mm = {it}\nx_end_mm = 187000\n");
        let zones: String = (here..count).map(zone).collect();
        Mission::parse("", &format!("{mission}{zones}")).map_err(|it| it.to_string())
    };
    let said = with(1_001).unwrap_err();
    assert!(said.contains("`zone` has 1001 entries; at most 1000 are allowed"), "{said}");
    if let Err(said) = with(1_000) {
        assert!(!said.contains("entries; at most"), "{said}");
    }
}

#[test]
fn json_is_64_deep_and_no_more() {
    let task = "{\"name\": \"t\", \"skip_cost\": 1, \"cost\": [1, 2]}";
    let deep = |depth: usize| {
        let more = format!(", \"deep\": {}{}", "[".repeat(depth), "]".repeat(depth));
        instance(1, &task.replace('}', &format!("{more}}}")))
    };
    let least = (1..100).find(|&depth| deep(depth).is_err()).unwrap();
    let said = deep(least).unwrap_err();
    assert!(said.contains("nested too deeply"), "{said}");
    assert_eq!(least, 65);
}

/// A name of up to 64 characters may be meant for one that is known; a longer one is not compared.
#[test]
fn advice_is_given_for_names_of_64_characters_and_no_more() {
    let mission = embedded::mission("patrol").unwrap().text.replace("\"L2\"", "\"LLL2\"");
    let known = "L".repeat(63);
    let said = |name: &str| {
        let text = mission.replace("\"LLL2\"", &format!("\"{known}\""));
        let text = text.replacen(
            &format!("require_tio = \"{known}\""),
            &format!("require_tio = \"{name}\""),
            1,
        );
        Mission::parse("", &text).unwrap_err().to_string()
    };
    assert!(said(&"L".repeat(64)).contains("did you mean"));
    for length in [65, 66, 70] {
        assert!(!said(&"L".repeat(length)).contains("did you mean"), "{length}");
    }
}

/// More robots than a search can have: each task alone costs so much at least, added up.
#[test]
fn an_instance_that_is_too_large_has_a_bound_task_by_task() {
    let robots: Vec<_> = (0..129).map(|it| format!("\"r{it}\"")).collect();
    let row = |least: u32| {
        let costs: Vec<_> = (0..129).map(|it| (least + it % 7).to_string()).collect();
        format!("{{\"name\": \"role{least}\", \"cost\": [{}]}}", costs.join(", "))
    };
    let task = |name: &str, skip: &str, combine: &str, extra: u32, roles: &[u32]| {
        let roles: Vec<_> = roles.iter().map(|it| row(*it)).collect();
        format!(
            "{{\"name\": \"{name}\", \"skip_cost\": {skip}, \"combine\": \"{combine}\", \
             \"plans\": [{{\"name\": \"p\", \"extra_cost\": {extra}, \"roles\": [{}]}}]}}",
            roles.join(", ")
        )
    };
    // In sixths: sums 6 (2 + 3 + 5), means 3 (10 + 20) + 6 * 4, largest 6 * 9, left undone 6 * 8.
    let tasks = [
        task("sum", "null", "sum", 5, &[2, 3]),
        task("mean", "null", "mean", 4, &[10, 20]),
        task("max", "900", "max", 0, &[7, 9]),
        task("skip", "8", "sum", 0, &[30]),
    ];
    let text = format!(
        "{{\"format\": \"cotama-team-assignment/1\", \"name\": \"large\", \
         \"kind\": \"simultaneous\", \"cost_denominator\": 6, \"robots\": [{}], \
         \"tasks\": [{}]}}",
        robots.join(", "),
        tasks.join(", ")
    );
    let answer = Instance::parse("large.json", &text).unwrap().solve(1_000).unwrap();
    assert_eq!((answer.cost(), answer.bound()), (None, Some(60 + 90 + 24 + 54 + 48)));
}
