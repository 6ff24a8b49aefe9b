//! `cotama floor`: floors and paths over them.

use crate::common::Folder;
use serde_json::json;

#[test]
fn a_path_over_the_office_says_how_long_it_is_and_which_zones_it_crosses() {
    let folder = Folder::new("floor_office");
    let answer =
        folder.cotama(&["floor", "office", "--from", "dock", "--to", "office B", "--json"]);
    let answer = answer.json(0);
    let path = &answer["path"];
    let length = path["length_mm"].as_u64().unwrap();
    assert!((14_000..15_000).contains(&length), "{length}");
    let zones: Vec<_> = path["zones"].as_array().unwrap().iter().map(|it| &it["zone"]).collect();
    assert_eq!(zones, ["store", "corridor"]);
    // The straight line is shorter than a path through doors.
    let corners = path["corners_mm"].as_array().unwrap();
    assert!(corners.len() > 2 && corners[0] == json!([8_000, 700]), "{corners:?}");
}

#[test]
fn a_closed_door_leaves_no_path_until_it_is_opened() {
    let folder = Folder::new("floor_door");
    let to_d = ["floor", "office", "--from", "dock", "--to", "office D"];
    let none = folder.cotama(&to_d);
    assert_eq!(none.code, Some(1));
    assert!(none.stdout.contains("closed are door D: `--open` opens one"), "{}", none.stdout);
    let open = folder.cotama(&[&to_d[..], &["--open", "door D", "--output", "d.svg"]].concat());
    assert_eq!(open.code, Some(0));
    assert!(folder.read("d.svg").contains("class=\"way\""));
    let wide = folder.cotama(&[&to_d[..], &["--open", "door D", "--radius", "600"]].concat());
    assert_eq!(wide.code, Some(1));
}

#[test]
fn a_new_floor_has_a_path_from_room_to_room() {
    let folder = Folder::new("floor_new");
    assert_eq!(folder.cotama(&["new", "floor", "shop"]).code, Some(0));
    let path = ["floor", "shop.toml", "--from", "left", "--to", "right", "--json"];
    let answer = folder.cotama(&path).json(0);
    assert_eq!(answer["path"]["zones"][0]["zone"], "doorway");
    folder.write(
        "shop.toml",
        folder.read("shop.toml").replace("state = \"open\"", "state = \"ajar\""),
    );
    let refused = folder.cotama(&path[..2]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("unknown state of a door"), "{}", refused.stderr);
}

#[test]
fn a_map_of_ros_is_read_with_its_image_and_crossed() {
    let folder = Folder::new("floor_map");
    let wall = |x: usize, y: usize| {
        usize::from(x == 0 || y == 0 || x == 39 || y == 29 || x == 20 && y > 9)
    };
    let cells =
        (0..30).flat_map(|y| (0..40).map(move |x| if wall(x, y) == 1 { "0" } else { "254" }));
    let image = format!("P2 40 30 255\n{}\n", cells.collect::<Vec<_>>().join(" "));
    folder.write("hall.pgm", image);
    let text = "image: hall.pgm\nresolution: 0.1\norigin: [-1.0, 0, 0]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    folder.write("hall.yaml", text);
    let shown = folder.cotama(&["floor", "hall.yaml", "--json"]).json(0);
    assert_eq!((&shown["width_mm"], &shown["map"]["columns"]), (&json!(4_000), &json!(40)));
    let path = ["floor", "hall.yaml", "--from", "0,1500", "--to", "2000,1500", "--json"];
    // Round the wall in the middle, which leaves a gap at the upper end.
    let length = folder.cotama(&path).json(0)["path"]["length_mm"].as_u64().unwrap();
    assert!(length > 2_300, "{length}");
    folder.write("hall.yaml", text.replace("hall.pgm", "none.pgm"));
    let refused = folder.cotama(&["floor", "hall.yaml"]);
    assert_eq!((refused.code, refused.stderr.contains("none.pgm")), (Some(2), true));
}

#[test]
fn places_and_doors_that_are_not_there_are_refused_with_near_names() {
    let folder = Folder::new("floor_refused");
    for (arguments, said) in [
        (&["floor", "offices"][..], "there is no floor offices"),
        (
            &["floor", "office", "--from", "dok", "--to", "lab"],
            "unknown place `dok`; did you mean `dock`?",
        ),
        (
            &["floor", "office", "--from", "dock", "--to", "lab", "--open", "door X"],
            "unknown door `door X`; did you mean `door A`?",
        ),
        (&["floor", "office", "--output", "x.png"], "a floor is drawn as SVG"),
        (&["floor", "office", "--from", "dock"], "--to"),
    ] {
        let refused = folder.cotama(arguments);
        assert_eq!(refused.code, Some(2), "{arguments:?}");
        assert!(refused.stderr.contains(said), "{}", refused.stderr);
    }
}

#[test]
fn a_mission_over_a_map_warns_of_the_map_as_the_floor_itself_does() {
    let folder = Folder::new("floor_warned");
    folder.write("hall.pgm", format!("P2 60 40 255\n{}\n", "254 ".repeat(60 * 40)));
    let text = "image: hall.pgm\nresolution: 0.1\norigin: [0, 0, 0.5]\nnegate: 0\n\
                occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    folder.write("hall.yaml", text);
    let over = r#"
format = "panorama-mission/2"
name = "over"
robot = "transport"
floor = "hall.yaml"
from = "1000,1000"
limits = { order = ["duration", "energy"], duration_ms = 400_000, energy_mj = 50_000_000 }
objective = [{ id = "Over", does = "drive", to = "5000,3000" }]
"#;
    folder.write("over.toml", over);
    let warning = "hall.yaml:3:9: warning: the yaw 0.5 is not used; turn the image\n";
    for arguments in
        [&["floor", "hall.yaml"][..], &["plan", "over.toml"], &["run", "over.toml", "--no-report"]]
    {
        let said = folder.cotama(arguments);
        assert_eq!((said.code, said.stderr.as_str()), (Some(0), warning), "{arguments:?}");
    }
    folder.write("hall.yaml", text.replace("0.5]", "0]"));
    assert_eq!(folder.cotama(&["plan", "over.toml"]).stderr, "");
}

/// A mission over the office, with one more text in place of another.
fn rounds(from: &str, to: &str) -> String {
    let text = include_str!("texts/rounds.toml");
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

#[test]
fn a_mission_from_place_to_place_runs_as_the_same_one_in_lengths() {
    let folder = Folder::new("floor_mission");
    folder.write("rounds.toml", rounds("rounds", "rounds"));
    let run = |file: &str| {
        let trace = format!("{file}.jsonl");
        let answer =
            folder.cotama(&["run", file, "--no-report", "--trace", &trace, "--json"]).json(0);
        let replay = folder.cotama(&["replay", &trace]);
        assert!(replay.stdout.contains("identical: the run was the same again"), "{file}");
        let mut answer = answer;
        answer["trace"] = json!(null);
        assert_eq!((&answer["outcome"], &answer["x_mm"]), (&json!("completed"), &json!(40_748)));
        answer
    };
    let plan = folder.cotama(&["plan", "rounds.toml", "--json"]).json(0);
    let rows = plan["activities"].as_array().unwrap();
    let end = |of: &str| {
        let all = rows.iter().filter(|it| it["objective"] == of);
        all.map(|it| it["x_end_mm"].as_u64().unwrap()).max().unwrap()
    };
    let ends = ["ToOffice", "TakeUp", "ToLab", "HandOver", "Home"].map(end);
    let slow: Vec<_> = rows.iter().filter(|it| it["speed_max_mm_s"] == 600).collect();
    assert_eq!((ends[0], slow.len()), (14_507, 3)); // the corridor is crossed three times
    let mut text = rounds("floor = \"office\"\nfrom = \"dock\"", "path_length_mm = LENGTH")
        .replace("LENGTH", &ends[4].to_string());
    let (zone, of) = ("[[zone]]\nid = \"corridor\"", |it: usize| {
        let (start, end) = (&slow[it]["x_start_mm"], &slow[it]["x_end_mm"]);
        format!("[[zone]]\nid = \"corridor{it}\"\nx_start_mm = {start}\nx_end_mm = {end}")
    });
    let all = [0, 1, 2].map(|it| format!("{}\nspeed_max_mm_s = 600", of(it))).join("\n");
    text = text.replacen(&format!("{zone}\nspeed_max_mm_s = 600"), &all, 1);
    let mut before = 0;
    for (does, end) in ["drive", "receive", "drive", "deliver", "drive"].into_iter().zip(ends) {
        let said = format!("does = \"{does}\"");
        let lengths = format!("does  = \"{does}\"\nx_start_mm = {before}\nx_end_mm = {end}");
        text = text.replacen(&said, &lengths, 1);
        before = end;
    }
    for to in ["office B", "lab", "dock"] {
        text = text.replacen(&format!("to = \"{to}\"\n"), "", 1);
    }
    folder.write("line.toml", text);
    assert_eq!(run("rounds.toml"), run("line.toml"));
}

#[test]
fn a_new_mission_goes_over_a_new_floor_and_over_the_office() {
    let folder = Folder::new("floor_new_mission");
    assert_eq!(folder.cotama(&["new", "floor", "shop"]).code, Some(0));
    for (name, robot, floor) in
        [("tour", "transport", "office"), ("round", "p3dx-delivery", "shop.toml")]
    {
        let new = folder.cotama(&["new", "mission", name, "--robot", robot, "--floor", floor]);
        assert_eq!(new.code, Some(0), "{}", new.stderr);
        let run = folder.cotama(&["run", &format!("{name}.toml"), "--no-report", "--json"]);
        assert_eq!(run.json(0)["outcome"], "completed", "{name}");
    }
    let alone = folder.cotama(&["new", "mission", "hall", "--floor", "office"]);
    assert_eq!(alone.code, Some(2));
    assert!(alone.stderr.contains("--floor is for missions of a robot"), "{}", alone.stderr);
}

#[test]
fn each_mistake_about_a_floor_is_one_message_at_its_place() {
    let folder = Folder::new("floor_mistakes");
    let lab = "to = \"lab\"";
    for (from, to, place, message) in [
        ("\"office\"", "\"ofice\"", "4:9", "there is no floor `ofice`, and no file of this name"),
        ("\"dock\"", "\"dok\"", "5:8", "unknown place `dok`; did you mean `dock`?"),
        (lab, "to = \"labb\"", "37:6", "unknown place `labb`; did you mean `lab`?"),
        (lab, "to = 7", "37:6", "`to` must be a string, not an integer"),
        (lab, "", "34:1", "this drive leads nowhere: it starts and ends at 14507 mm"),
        (lab, "to = \"8000,-500\"", "37:6", "no room at `8000,-500`"),
        ("does = \"receive\"", "does = \"receive\"\nto = \"lab\"", "34:6", "only one that drives"),
        ("id = \"corridor\"", "id = \"coridor\"", "24:6", "unknown zone `coridor`"),
        ("from =", "open = [\"dor D\"]\nfrom =", "5:8", "unknown door `dor D`"),
        ("from =", "path_length_mm = 9\nfrom =", "5:18", "a length of the path, which the floor"),
        ("floor = \"office\"", "path_length_mm = 9", "5:8", "`from` speaks of a floor"),
    ] {
        folder.write("rounds.toml", rounds(from, to));
        let said = folder.cotama(&["plan", "rounds.toml"]);
        assert_eq!(said.code, Some(2), "{to}");
        let has = |it: &str| said.stderr.contains(it);
        assert!(has(message) && has(&format!("rounds.toml:{place}\n")), "{to}\n{}", said.stderr);
    }
    let too_wide = rounds("from =", "clearance_mm = 300\nfrom =");
    folder.write("rounds.toml", too_wide);
    let said = folder.cotama(&["plan", "rounds.toml"]).stderr;
    assert!(said.contains("nothing leads from `dock` to `office B`"), "{said}");
    let nowhere = rounds(lab, "to = \"office D\"");
    folder.write("rounds.toml", &nowhere);
    let said = folder.cotama(&["plan", "rounds.toml"]).stderr;
    assert!(said.contains("nothing leads from `office B` to `office D`"), "{said}");
    assert!(said.contains("closed are door D: `open` opens one"), "{said}");
    folder.write("rounds.toml", nowhere.replacen("from =", "open = [\"door D\"]\nfrom =", 1));
    assert_eq!(folder.cotama(&["plan", "rounds.toml"]).code, Some(0));
}
