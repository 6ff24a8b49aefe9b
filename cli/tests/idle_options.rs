//! Options that would change nothing are refused, and it is said which.

use crate::common::Folder;

/// A team with so many robots, all of whom can do its one task.
fn team(robots: usize) -> String {
    let names: Vec<_> = (0..robots).map(|it| format!("\"r{it}\"")).collect();
    let costs = vec!["1"; robots];
    format!(
        "{{\"format\":\"cotama-team-assignment/1\",\"name\":\"crowd\",\"kind\":\"single\",\
         \"cost_denominator\":1,\"robots\":[{}],\"tasks\":[{{\"name\":\"t\",\"skip_cost\":null,\
         \"cost\":[{}]}}]}}",
        names.join(","),
        costs.join(",")
    )
}

#[test]
fn an_option_that_its_mode_does_not_look_at_is_refused() {
    let folder = Folder::new("idle_options");
    for robots in [128, 129, 400] {
        folder.write(&format!("{robots}.json"), team(robots));
    }
    for (line, option) in [
        ("assign 129.json --greedy", "--greedy"),
        ("assign 400.json --greedy --json", "--greedy"),
        ("export delivery --format svg --style net", "--style"),
        ("export delivery --output a.svg --style states", "--style"),
        ("run fleet --steps 9", "--steps"),
        ("run service --steps 9", "--steps"),
        ("run fleet --seeds 2 --allocation optimal", "--allocation"),
        ("run fleet --seeds 1", "--seeds"),
        ("plan patrol --allocator panorama --objective quality", "--objective quality"),
        ("plan patrol --allocator panorama --objective front", "--objective front"),
        ("run patrol --allocator panorama --objective min-energy", "--objective min-energy"),
        ("plan patrol --objective front --steps 9", "--steps"),
        ("plan patrol --steps 9", "--steps"),
        ("plan delivery --allocator panorama --steps 9", "--steps"),
        ("run patrol --no-report --steps 9", "--steps"),
        ("run delivery --objective paper --no-report --steps 9", "--steps"),
        ("campaign patrol --runs 9 --steps 9", "--steps"),
        ("campaign patrol --runs 9 --policy rigid --steps 9", "--steps"),
        ("campaign delivery --runs 9 --allocator panorama --steps 9", "--steps"),
        ("allocate 128.json --allocator panorama --steps 9", "--steps"),
        ("allocate 128.json --allocator panorama --objective min-energy", "--objective min-energy"),
    ] {
        let words: Vec<_> = line.split(' ').collect();
        let ended = folder.cotama(&words);
        assert_eq!(ended.code, Some(2), "{line}: {ended:?}");
        assert!((ended.stderr + &ended.stdout).contains(option), "{line}");
    }
    assert_eq!(folder.files(".").len(), 3, "nothing is written");
    // The nearest right lines are taken.
    for (line, code) in [
        ("assign 128.json --greedy", 0),
        ("assign 129.json", 0),
        ("export delivery --format svg", 0),
        ("export delivery --format svg --semantics interleaving --style net", 0),
        ("plan patrol --allocator panorama --objective paper", 0),
        ("plan patrol --objective front --allocator exact", 0),
        ("plan patrol --allocator exact --steps 900", 0),
        ("plan patrol --objective quality --steps 900000", 0),
        ("plan delivery --steps 900000", 0),
        ("run patrol --no-report --allocator exact --steps 900", 0),
        ("campaign patrol --runs 9 --policy exact --steps 9000", 0),
    ] {
        let words: Vec<_> = line.split(' ').collect();
        let ended = folder.cotama(&words);
        assert_eq!(ended.code, Some(code), "{line}: {}", ended.stderr);
    }
}
