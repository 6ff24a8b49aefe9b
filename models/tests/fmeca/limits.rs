//! Large and wicked files: the limits are reached, and reported.

use cotama_models::fmeca::{Analysis, MAX_GROUPED, MAX_MODES, MAX_PAIRS};
use std::fmt::Write;

/// Rows with these flags, always and sometimes.
fn rows(flags: impl Iterator<Item = (String, String)>) -> String {
    let mut text = String::from(
        "id,function,component,failure,cause,effect,severity,mtbf_h,latency_ms,flags,sometimes\n",
    );
    for (at, (always, sometimes)) in flags.enumerate() {
        writeln!(text, "M{at},f,c,x,y,z,weak,100,5,{always},{sometimes}").unwrap();
    }
    text
}

fn read(text: &str) -> Analysis {
    Analysis::parse_csv("large.csv", text).unwrap()
}

#[test]
fn as_many_rows_as_are_read_and_one_more() {
    let one = |_| ("same".to_owned(), String::new());
    let most = read(&rows((0..MAX_MODES).map(one)));
    let told = most.diagnose(&most.sound());
    // All are alike: one group, and more pairs than are told.
    assert_eq!(told.groups.list, [(0..MAX_MODES).collect::<Vec<_>>()]);
    assert_eq!(told.pairs.len(), MAX_PAIRS);
    assert_eq!(told.pairs.len() + told.pairs_left_out, MAX_MODES * (MAX_MODES - 1) / 2);
    let more = rows((0..=MAX_MODES).map(one));
    let errors = Analysis::parse_csv("large.csv", &more).unwrap_err().to_string();
    assert!(errors.contains("there are 4097 rows; at most 4096 are read"), "{errors}");
    let mode = "[[mode]]\nid = 'A'\n".repeat(MAX_MODES + 1);
    let errors = Analysis::parse("large.toml", &format!("format = 'cotama-fmeca/1'\n{mode}"));
    let errors = errors.unwrap_err().to_string();
    assert!(errors.contains("`mode` has 4097 entries; at most 4096 are allowed"), "{errors}");
}

/// Every row but its partner: 2 to the 40 groups. Row 2k needs flag k, row 2k+1 never raises it.
#[test]
fn too_many_groups_are_cut_off_and_that_is_said() {
    let pairs = 40;
    let all = |but: usize| -> String {
        let names = (0..pairs).filter(|&it| it != but).map(|it| format!("f{it}"));
        names.collect::<Vec<_>>().join(";")
    };
    let wicked = (0..2 * pairs).map(|at| {
        let pair = at / 2;
        let always = if at % 2 == 0 { format!("any;f{pair}") } else { "any".to_owned() };
        (always, all(pair))
    });
    let wicked = read(&rows(wicked));
    let told = wicked.diagnose(&wicked.sound());
    assert!(!told.groups.complete);
    let members: usize = told.groups.list.iter().map(Vec::len).sum();
    assert!(members <= MAX_GROUPED && told.groups.list.len() == MAX_GROUPED / pairs);
    assert!(told.groups.list.iter().all(|it| it.len() == pairs));
    assert_eq!(told.pairs.len(), 2 * pairs * (pairs - 1));
}

/// Rows that are alike in a ring: as many groups as rows, found at once.
#[test]
fn many_small_groups_are_complete() {
    let number = 1000;
    let ring = (0..number).map(|at| {
        (format!("f{at}"), format!("f{};f{}", (at + 1) % number, (at + number - 1) % number))
    });
    let ring = read(&rows(ring));
    let told = ring.diagnose(&ring.sound());
    assert!(told.groups.complete);
    assert_eq!(told.groups.list.len(), number);
    assert!(told.groups.list.iter().all(|it| it.len() == 2));
}
