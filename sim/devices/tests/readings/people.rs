//! Stories of people in a hall of 20 m, and over the office.
#![allow(clippy::unwrap_used, clippy::float_cmp)]

use cotama_core::units::Millis;
use cotama_devices::{Disc, Habits, People, Routes, Streams};
use cotama_floor::{Needs, Path, Planner, Point, Surface, Version, embedded, metres};

fn hall() -> Routes {
    let places = [[0.0, 0.0], [20.0, 0.0]].map(Point::from);
    Routes::by(&places, |from, to| Path::new(vec![from, to])).unwrap()
}

/// A person at 1 m/s, who stays 1 s in a place and never stops.
fn walker() -> People {
    let stays = Millis(1_000)..=Millis(1_000);
    let habits = Habits { speed_m_s: 1.0..=1.0, stays, stops: 0.0, ..Habits::default() };
    People::new(1, &habits, hall(), &Streams::new(1), "people").unwrap()
}

fn robot(x: f64) -> Disc {
    Disc { centre: Point::new(x, 0.0), radius: 0.25 }
}

/// Returns how far the walker is from where the walk began, at some times in seconds.
fn walked(robots: &[Disc], times: &[u64]) -> Vec<f64> {
    let mut people = walker();
    let begin = people.advance(Millis(0), robots)[0].centre;
    let mut at = |seconds: &u64| {
        let here = people.advance(Millis(1_000 * seconds), robots)[0].centre;
        ((here - begin).norm() * 1_000.0).round() / 1_000.0
    };
    times.iter().map(&mut at).collect()
}

#[test]
fn a_person_stays_walks_and_arrives() {
    assert_eq!(walked(&[], &[1, 2, 11, 21, 22]), [0.0, 1.0, 10.0, 20.0, 20.0]);
}

/// The robot stands in the middle: the person stops before the gap at 10.1 s, turns back at 13.1 s
/// and takes the first step at 13.2 s.
#[test]
fn a_person_stops_before_a_robot_and_turns_back() {
    let room = 10.0 - 0.25 - 0.25 - 0.4;
    let walked = walked(&[robot(10.0)], &[1, 5, 11, 13, 16]);
    assert_eq!(walked, [0.0, 4.0, room, room, 6.3]);
}

#[test]
fn a_person_who_stands_in_the_way_goes_on_when_a_robot_waits() {
    let long = Millis(100_000)..=Millis(100_000);
    let habits = Habits {
        speed_m_s: 1.0..=1.0,
        stays: Millis(0)..=Millis(0),
        stops: 1.0,
        stands: long,
        ..Habits::default()
    };
    let mut people = People::new(1, &habits, hall(), &Streams::new(1), "people").unwrap();
    let stood = people.advance(Millis(30_000), &[])[0].centre;
    assert_eq!(people.advance(Millis(40_000), &[])[0].centre, stood);
    for side in [-0.8, 0.8] {
        let mut people = people.clone();
        let robots = [robot(stood.x + side)];
        assert_eq!(people.advance(Millis(42_900), &robots)[0].centre, stood);
        let gone = people.advance(Millis(45_000), &robots)[0].centre;
        assert!((gone.x - stood.x) * side < -1.0, "away from the robot: {gone} from {stood}");
    }
}

fn office() -> (impl Surface, Routes) {
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Real, &[]).unwrap();
    let needs = Needs { radius_m: 0.25, cell_m: 0.1, ..Needs::default() };
    let places: Vec<_> = office.places.iter().map(|it| metres(it.at)).collect();
    let routes = Routes::plan(&Planner::new(&surface, needs).unwrap(), &places).unwrap();
    (surface, routes)
}

#[test]
fn people_walk_through_no_wall_and_into_no_robot() {
    let (surface, routes) = office();
    let habits = Habits { stays: Millis(0)..=Millis(3_000), ..Habits::default() };
    let mut people = People::new(12, &habits, routes, &Streams::new(3), "people").unwrap();
    let robots = [[5.0, 10.0], [15.0, 12.0], [12.0, 9.8]].map(Point::from);
    let robots = robots.map(|centre| Disc { centre, radius: 0.25 });
    let mut moved = 0.0;
    let mut before = people.advance(Millis(0), &robots).to_vec();
    for now in (50..600_000).step_by(50).map(Millis) {
        let discs = people.advance(now, &robots);
        for (disc, before) in discs.iter().zip(&before) {
            let step = (disc.centre - before.centre).norm();
            assert!(step <= 0.075 + 1e-9, "{step} m in 50 ms");
            moved += step;
            assert!(surface.clearance(disc.centre, 0.25) >= 0.24, "{} at {now}", disc.centre);
            let gap = robots.iter().map(|it| it.gap(disc)).fold(f64::INFINITY, f64::min);
            assert!(gap > 0.3, "{gap}"); // 0.4 m at each decision; a corner is cut in between
        }
        before.clear();
        before.extend_from_slice(discs);
    }
    assert!(moved > 1_000.0, "{moved}");
}

#[test]
fn people_are_in_the_same_places_however_often_they_are_asked() {
    let (_, routes) = office();
    let new = |count| {
        People::new(count, &Habits::default(), routes.clone(), &Streams::new(3), "people").unwrap()
    };
    let (mut often, mut once, mut more) = (new(8), new(8), new(9));
    (0..3_000).for_each(|it| {
        often.advance(Millis(37 * it), &[]);
    });
    let end = Millis(37 * 3_000);
    assert_eq!(often.advance(end, &[]), once.advance(end, &[]));
    assert_eq!(once.advance(end, &[]), &more.advance(end, &[])[..8]);
}

#[test]
fn a_person_before_a_door_that_has_closed_turns_back() {
    let mut people = walker();
    let leaf = [[10.0, -1.0], [10.0, 1.0]].map(Point::from);
    let mut at = |ms, leaves: Vec<[Point; 2]>| {
        people.set_leaves(leaves);
        people.advance(Millis(ms), &[])[0].centre.x
    };
    let closed: Vec<f64> = (0..600).map(|it| at(it * 100, vec![leaf])).collect();
    let nearest = closed.iter().map(|it| (it - 10.0).abs()).fold(f64::MAX, f64::min);
    assert!((0.25..0.5).contains(&nearest), "{nearest}");
    let is_left = |it: &f64| *it < 10.0;
    assert!(closed.iter().all(|it| is_left(it) == is_left(&closed[0])));
    let open: Vec<f64> = (600..1_200).map(|it| at(it * 100, Vec::new())).collect();
    assert!(open.contains(&0.0) && open.contains(&20.0));
}
