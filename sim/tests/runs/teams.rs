//! Teams on floors: lengths are those of the planner, positions lie on free floor, traces replay.

use cotama_floor::{Floor, Needs, Planner, Surface, Version, embedded, metres};
use cotama_models::robots::RobotFile;
use cotama_models::team::scenario::{Asked, On, Place, Scenario, Spot, usual};
use cotama_sim::fleet::floors::{needs, ways};
use cotama_sim::fleet::record::{Fate, Record};
use cotama_sim::fleet::scenarios::{FleetOptions, ServiceOptions, fleet, service};
use cotama_sim::fleet::trace::{Trace, replay};
use proptest::prelude::*;

/// A team in the office: places of the floor stand for those of the team.
const CREW: &str = include_str!("../../../cli/templates/team.toml");

fn read(text: &str) -> Result<Scenario, String> {
    let ways = Asked::of(text).and_then(ways);
    Scenario::parse_on("crew.toml", text, ways.as_ref(), &[]).map_err(|it| it.to_string())
}

fn crew() -> Scenario {
    read(CREW).unwrap()
}

/// The room around each position that a trace gives, at least: in metres.
fn least_room(trace: &Trace, floor: &Floor) -> f64 {
    let surface = floor.surface(Version::Charted, &[]).unwrap();
    let scenario = trace.scenario().unwrap();
    let spots = trace.records.iter().filter_map(|it| match *it {
        Record::At { from, to, done_mm, .. } => {
            Some(Spot { from: Place(from), to: Place(to), done_mm })
        }
        _ => None,
    });
    let room = |it: Spot| surface.clearance(metres(scenario.floor.at_mm(it).unwrap()), 1.0);
    let rooms: Vec<f64> = spots.map(room).collect();
    assert!(rooms.len() > 20, "{}", rooms.len());
    rooms.into_iter().fold(1.0, f64::min)
}

#[test]
fn distances_of_a_team_are_those_of_the_planner_of_missions() {
    let scenario = crew();
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Charted, &[]).unwrap();
    let planner = Planner::new(&surface, needs([&usual()])).unwrap();
    let at = |it: usize| metres(office.place(scenario.floor.name(Place(it))).unwrap().at);
    for a in 0..scenario.floor.places() {
        for b in a + 1..scenario.floor.places() {
            let planned = planner.route(at(a), at(b)).unwrap().length_mm();
            let [from, to] = [a, b].map(|it| Spot::at(Place(it)));
            let found = [(from, to), (to, from)].map(|it| scenario.floor.distance(it.0, it.1));
            assert_eq!(found, [Some(planned); 2], "{a} {b}");
        }
    }
    assert_eq!(needs([&usual()]), Needs::default());
}

#[test]
fn a_team_on_a_floor_replays_byte_for_byte_and_its_file_is_read_as_it_was_written() {
    let trace = Trace::of(&crew());
    assert_eq!(trace.run().count(Fate::Done), 3);
    let text = trace.to_json_lines();
    let stored = Trace::parse("crew.jsonl", &text).unwrap();
    let (again, difference) = replay(&stored).unwrap();
    assert_eq!(difference, None);
    assert_eq!(again.to_json_lines(), text);
    for scenario in [crew(), service(&ServiceOptions::default())] {
        assert_eq!(read(&scenario.to_toml()).unwrap(), scenario);
    }
}

#[test]
fn robots_drive_where_the_floor_is_free() {
    let radius = needs([&usual()]).radius_m;
    let small = FleetOptions { robots: 8, tasks: 24, failures: 1, ..FleetOptions::default() };
    let disturbances = true;
    let quiet = ServiceOptions { disturbances, ..ServiceOptions::default() };
    for (scenario, floor) in [
        (crew(), embedded::OFFICE),
        (service(&quiet), embedded::SERVICE),
        (fleet(&small), embedded::FLEET),
    ] {
        let room = least_room(&Trace::of(&scenario), &floor.floor().unwrap());
        // Corners and positions are rounded to mm.
        assert!(room > radius - 0.003, "{}: {room}", floor.name);
    }
}

#[test]
fn floors_of_the_shipped_teams_are_drawn_to_the_lengths_that_their_files_say() {
    let lengths = |scenario: &Scenario| {
        let ways = scenario.floor.on().and_then(On::ways).unwrap();
        let planned = ways.legs.iter().map(|it| it.as_ref().unwrap().length.0);
        scenario.floor.ways().map(|it| it.2).zip(planned).collect::<Vec<_>>()
    };
    let service = lengths(&service(&ServiceOptions::default()));
    let drawn = [(4_000, 4_001), (6_000, 6_001), (9_000, 9_061), (40_000, 40_001)];
    assert_eq!(service, drawn);
    let fleet = lengths(&fleet(&FleetOptions::default()));
    let off = |it: &(u64, u64)| it.0.abs_diff(it.1) * 25 > it.0;
    assert_eq!((fleet.len(), fleet.iter().find(|it| off(it))), (73, None));
}

#[test]
fn a_place_that_cannot_be_reached_is_one_message() {
    let behind = CREW.replace("to = \"office B\"", "to = \"office D\"");
    let errors = read(&behind).unwrap_err();
    assert_eq!(errors.matches("crew.toml:").count(), 1, "{errors}");
    assert!(errors.contains("nothing leads from `dock` to `office D` for this robot"), "{errors}");
    assert!(errors.contains("closed are door D: `open` opens one"), "{errors}");
    let open =
        behind.replace("floor = \"office\"", "floor = { on = \"office\", open = [\"door D\"] }");
    assert_eq!(read(&open).unwrap().floor.places(), crew().floor.places());
    let unknown = read(&CREW.replace("\"dock\"", "\"dok\"")).unwrap_err();
    assert!(unknown.contains("unknown place `dok`; did you mean `dock`?"), "{unknown}");
    assert_eq!(unknown.matches("crew.toml:").count(), 1, "{unknown}");
    let none = read(&CREW.replace("\"office\"", "\"attic\"")).unwrap_err();
    assert!(none.contains("there is no floor `attic`, and no file of this name"), "{none}");
    assert_eq!(none.matches("crew.toml:").count(), 1, "{none}");
}

#[test]
fn ways_that_a_file_names_are_the_only_ones() {
    let ways = "floor = { on = \"office\", way = [\n\
                {between = [\"dock\", \"lounge\"]},\n\
                {between = [\"lounge\", \"corridor east\"], length_mm = 9000},\n\
                {between = [\"lounge\", \"store\"]},\n\
                {between = [\"lounge\", \"office B\"]},\n\
                {between = [\"lounge\", \"kitchen\"]},\n\
                {between = [\"lounge\", \"meeting room\"]},\n\
                {between = [\"lounge\", \"corridor west\"]}] }";
    let scenario = read(&CREW.replace("floor = \"office\"", ways)).unwrap();
    let place = |name| {
        let all = 0..scenario.floor.places();
        Spot::at(Place(all.into_iter().find(|it| scenario.floor.name(Place(*it)) == name).unwrap()))
    };
    let distance = |a, b| scenario.floor.distance(place(a), place(b)).unwrap();
    let through = distance("dock", "lounge") + 9_000;
    assert_eq!(distance("dock", "corridor east"), through);
    // The floor only draws the way whose length is said: half of it is half of its path.
    let half = Spot { from: place("lounge").from, to: place("corridor east").from, done_mm: 4_500 };
    assert!(scenario.floor.at_mm(half).is_some());
    assert_eq!(read(&scenario.to_toml()).unwrap(), scenario);
}

proptest! {
    #[test]
    fn a_drive_passes_the_points_of_its_course(
        a in 0_usize..7,
        b in 0_usize..7,
        part in 0_u64..=1_000,
    ) {
        let scenario = CREW_READ.with(Clone::clone);
        let floor = &scenario.floor;
        let [from, to] = [a, b].map(|it| Spot::at(Place(it % floor.places())));
        let whole = floor.distance(from, to).unwrap();
        let there = floor.gone(from, to, whole * part / 1_000);
        let course = floor.course(from, to);
        prop_assert_eq!(course.last().unwrap().0, whole);
        let gone = whole * part / 1_000;
        let next = course.iter().position(|it| it.0 >= gone).unwrap();
        let (before, after) = (course[next.saturating_sub(1)], course[next]);
        let at = metres(floor.at_mm(there).unwrap());
        let (a, b) = (metres(before.1), metres(after.1));
        // On the piece between the two corners, to the mm.
        let off = (at - a).norm() + (at - b).norm() - (b - a).norm();
        prop_assert!(off < 0.006, "{off}");
    }
}

thread_local! {
    static CREW_READ: Scenario = crew();
}

/// The crew with a robot of a file beside the team: the transport robot, and a slower one of its
/// kind.
fn of_several_kinds() -> Scenario {
    let shipped = RobotFile::shipped("transport").unwrap();
    let slow = shipped.text().replace("speed_mm_s = 1_500", "speed_mm_s = 500");
    let slow = RobotFile::parse("lift.toml", &slow).unwrap();
    let text = CREW
        .replace("name = \"Anna\"", "name = \"Anna\"\nfile = \"transport\"")
        .replace("name = \"Cleo\"", "name = \"Cleo\"\nfile = \"lift.toml\"")
        .replace("robot = \"Ben\"\nmode = \"SON2\"", "robot = \"Cleo\"\nmode = \"CAM1\"");
    let ways = Asked::of(&text).and_then(ways);
    Scenario::parse_on("crew.toml", &text, ways.as_ref(), &[slow]).unwrap()
}

#[test]
fn each_robot_of_a_team_drives_and_fails_as_its_own_file_says() {
    let crew = of_several_kinds();
    let paces = crew.robots.iter().map(|it| it.pace(0));
    assert_eq!(paces.collect::<Vec<_>>(), [Some(1_500), Some(300), Some(500)]);
    let parcel = &crew.tasks[0].plans[0].roles[0];
    let bids = [0, 1, 2].map(|robot| crew.bid(robot, 0, parcel).unwrap());
    assert_eq!(bids, [58_217, 102_638, 113_956]);
    // Anna as a Pioneer plans for 2 s a drive in place of 14 s, and is five times as slow.
    assert_eq!(self::crew().bid(0, 0, parcel), Some(71_089));
    let trace = Trace::of(&crew);
    assert_eq!((trace.run().count(Fate::Done), trace.run().is_sound()), (3, true));
    let words = trace.words();
    let failed = trace.records.iter().find_map(|it| match it {
        Record::Fails { robot, mode, .. } => Some(words(*robot, mode)),
        _ => None,
    });
    assert_eq!(failed.as_deref(), Some("CAM1, depth camera: no depth image"));
    let runs = |name: &str| {
        trace.records.iter().any(
            |it| matches!(it, Record::Configured { configuration, .. } if configuration == name),
        )
    };
    assert!(runs("Follow.Low"));
}

#[test]
fn a_trace_holds_the_files_of_a_teams_robots() {
    let trace = Trace::of(&of_several_kinds());
    let names: Vec<_> = trace.header.files.iter().map(|it| it.source.as_str()).collect();
    assert_eq!(names, ["lift.toml"]);
    let stored = Trace::parse("crew.jsonl", &trace.to_json_lines()).unwrap();
    assert_eq!(replay(&stored).unwrap().1, None);
}
