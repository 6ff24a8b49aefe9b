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
        (&["floor", "office", "--from", "dok", "--to", "lab"], "did you mean dock?"),
        (
            &["floor", "office", "--from", "dock", "--to", "lab", "--open", "door X"],
            "there is no door",
        ),
        (&["floor", "office", "--output", "x.png"], "a floor is drawn as SVG"),
        (&["floor", "office", "--from", "dock"], "--to"),
    ] {
        let refused = folder.cotama(arguments);
        assert_eq!(refused.code, Some(2), "{arguments:?}");
        assert!(refused.stderr.contains(said), "{}", refused.stderr);
    }
}
