//! Files of floors: broken ones with their messages, mutants, and the office that ships.
#![allow(clippy::unwrap_used)]

use crate::common;
use cotama_floor::{Floor, Kind, Point, Ray, Sense, Surface, Version, embedded};
use cotama_fuzz::{Random, mutant};
use std::f64::consts::FRAC_PI_2;

const HALL: &str = r#"format = "cotama-floor/1"
name = "hall"
size_mm = [9000, 6000]
[[wall]]
points_mm = [[0, 0], [9000, 0], [9000, 6000], [0, 6000]]
closed = true
[[glass]]
points_mm = [[4000, 0], [4000, 2500]]
[[door]]
name = "door"
hinge_mm = [4000, 2500]
latch_mm = [4000, 3400]
swing_deg = 90
state = "closed"
[[furniture]]
name = "desk"
outline_mm = [[6000, 1000], [7600, 1000], [7600, 1800], [6000, 1800]]
[[furniture]]
name = "pillar"
centre_mm = [2000, 2000]
radius_mm = 200
charted = false
[[mark]]
name = "qr 1"
at_mm = [0, 3000]
facing_deg = 0
size_mm = 150
[[place]]
name = "office A"
at_mm = [1000, 1000]
heading_deg = 90
[[dock]]
name = "dock"
at_mm = [8500, 5500]
heading_deg = 180
[[zone]]
name = "east"
outline_mm = [[4000, 0], [9000, 0], [9000, 6000], [4000, 6000]]
"#;

#[test]
fn broken_floors_say_what_is_wrong_and_where() {
    let mut said = Vec::new();
    for (from, to) in [
        ("cotama-floor/1", "cotama-floor/2"),
        ("format = \"cotama-floor/1\"\n", ""),
        ("name = \"hall\"\n", ""),
        ("\"hall\"", "\"\""),
        ("\"hall\"", "\" hall\""),
        ("[9000, 6000]", "[9000, 6.0]"),
        ("[9000, 6000]", "[9000]"),
        ("[9000, 6000]", "9000"),
        ("[9000, 6000]", "[900, 6000]"),
        ("size_mm = [9000, 6000]", "size_m = [9, 6]"),
        ("size_mm = [9000, 6000]\n", ""),
        ("[[wall]]", "[[walls]]"),
        ("[[wall]]", "[wall]"),
        ("[9000, 6000], [0, 6000]]", "[9000, 6000], [0, 7000]]"),
        ("[9000, 6000], [0, 6000]]", "[9000, 6000], [-1, 6000]]"),
        ("[9000, 6000], [0, 6000]]", "[9000, 6000], [0, 6000], [0, 0]]"),
        ("[9000, 0], [9000, 6000]", "[9000, 6000], [9000, 0]"),
        ("[[4000, 0], [4000, 2500]]", "[[4000, 0]]"),
        ("[[4000, 0], [4000, 2500]]", "[[4000, 0], [4000, 0]]"),
        ("[[4000, 0], [4000, 2500]]", "[[4000, 0], [4000, 2500]"),
        ("closed = true", "closed = 1"),
        ("closed = true", "closd = true"),
        ("latch_mm = [4000, 3400]", "latch_mm = [4000, 2600]"),
        ("latch_mm = [4000, 3400]", "latsh_mm = [4000, 3400]"),
        ("swing_deg = 90", "swing_deg = 270"),
        ("swing_deg = 90", "swing = 90"),
        ("\"closed\"", "\"ajar\""),
        ("\"closed\"", "\"close\""),
        (
            "hinge_mm = [4000, 2500]\nlatch_mm = [4000, 3400]",
            "hinge_mm = [0, 0]\nlatch_mm = [0, 900]",
        ),
        ("[7600, 1000], [7600, 1800]", "[7600, 1800], [7600, 1000]"),
        ("[7600, 1800], [6000, 1800]", "[6800, 1000]"),
        ("radius_mm = 200", "radius_mm = 2500"),
        ("radius_mm = 200", "radius_mm = 0"),
        ("centre_mm = [2000, 2000]\n", ""),
        ("\"pillar\"", "\"desk\""),
        ("at_mm = [0, 3000]", "at_mm = [500, 3000]"),
        ("facing_deg = 0", "facing_deg = 400"),
        ("size_mm = 150", "size_mm = \"150 mm\""),
        ("at_mm = [1000, 1000]", "at_mm = [6500, 1500]"),
        ("at_mm = [1000, 1000]", "at_mm = [4000, 1000]"),
        ("\"office A\"", "\"dock\""),
        ("heading_deg = 180\n", ""),
        ("heading_deg = 180", "heading_deg = 180\nradius_mm = 200"),
        ("[9000, 6000], [4000, 6000]]\n", "[4000, 6000], [9000, 6000]]\n"),
        ("[[zone]]\n", "[[zone]]\nname = \"west\"\n"),
    ] {
        assert!(HALL.contains(from), "{from}");
        let text = HALL.replacen(from, to, 1);
        let Err(errors) = Floor::parse("hall.toml", &text) else {
            panic!("{from:?} -> {to:?} is read")
        };
        said.push((format!("{from:?} -> {to:?}"), errors.to_string()));
    }
    assert!(said.len() >= 40);
    common::compare("broken_floors.txt", &said);
}

#[test]
fn doors_glass_and_surprises_are_seen_by_whom_they_should() {
    let hall = Floor::parse("hall.toml", HALL).unwrap();
    let see = |version, open: &[bool], from: [f64; 2], angle: f64, sense| {
        let surface = hall.surface(version, open).unwrap();
        let hit = surface.hit(&Ray::at(Point::from(from), angle), 20.0, sense).unwrap();
        ((hit.distance * 1_000.0).round() as i64, hit.kind)
    };
    let real = Version::Real;
    let through = |open: &[bool], sense| see(real, open, [1.0, 3.0], 0.0, sense);
    assert_eq!(through(&[], Sense::Light), (3_000, Kind::Door));
    assert_eq!(through(&[true], Sense::Light), (8_000, Kind::Wall));
    assert_eq!(see(real, &[], [3.0, 1.0], 0.0, Sense::Sound), (1_000, Kind::Glass));
    assert_eq!(see(real, &[], [3.0, 1.5], 0.0, Sense::Light), (3_000, Kind::Furniture));
    assert_eq!(see(real, &[], [2.0, 1.0], FRAC_PI_2, Sense::Light).1, Kind::Furniture);
    let charted = see(Version::Charted, &[], [2.0, 1.0], FRAC_PI_2, Sense::Light);
    assert_eq!(charted, (5_000, Kind::Wall));
    let surface = hall.surface(real, &[]).unwrap();
    let between = |a: [f64; 2], b: [f64; 2]| surface.walls_between(a.into(), b.into());
    assert_eq!(between([1.0, 3.0], [5.0, 3.0]), 1);
    assert_eq!(between([1.0, 4.0], [5.0, 4.0]), 0);
}

#[test]
fn the_office_that_ships_is_read() {
    let office = embedded::OFFICE.floor().unwrap();
    assert_eq!((office.doors.len(), office.zones.len(), office.marks.len()), (9, 6, 8));
    let again = office.surface(Version::Real, &office.doors_at_first()).unwrap();
    let once = office.surface(Version::Real, &[]).unwrap();
    let ray = Ray::at(Point::new(1.0, 10.2), 0.02);
    assert_eq!(once.hit(&ray, 40.0, Sense::Light), again.hit(&ray, 40.0, Sense::Light));
}

fn mutants(count: u64) {
    let texts: Vec<Vec<u8>> = vec![HALL.into()];
    let words = ["[[wall]]\n", "[[place]]\n", "points_mm = ", "[[0, 0], [1, 1]]", "[0, 0]", "true"];
    let (mut random, mut read) = (Random(1), 0);
    for _ in 0..count {
        let text = mutant(&mut random, &texts, &words);
        match Floor::parse("hall.toml", &String::from_utf8_lossy(&text)) {
            Ok(floor) => {
                read += 1;
                floor.surface(Version::Real, &[]).unwrap();
                floor.surface(Version::Charted, &vec![true; floor.doors.len()]).unwrap();
            }
            Err(errors) => assert!(errors.to_string().starts_with("hall.toml:")),
        }
    }
    println!("{count} mutants: {read} are read");
    assert!(read > count / 50 && read < count, "{read}");
}

#[test]
fn a_thousand_mutants_of_a_floor_are_read_or_refused() {
    mutants(1_000);
}

#[test]
#[ignore = "some minutes in a release build, by hand"]
fn a_hundred_thousand_mutants_of_a_floor_are_read_or_refused() {
    mutants(100_000);
}
