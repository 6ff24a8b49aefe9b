//! Room, ways and pictures, against what is slow and plain.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

use crate::common;
use crate::common::{maps, part};
use cotama_floor::{
    Bounds, Cell, Footprint, Grid, Needs, Path, Planner, Point, Pose, Sense, Surface, Vector,
    Version, embedded, metres, picture,
};
use cotama_fuzz::Random;

fn random_grid(random: &mut Random, share: usize) -> Grid {
    let (width, height) = (1 + random.below(40), 1 + random.below(40));
    let kinds = [Cell::Occupied, Cell::Unknown];
    let cells: Vec<_> = (0..width * height)
        .map(|_| if random.below(100) < share { kinds[random.below(2)] } else { Cell::Free })
        .collect();
    Grid::new(width, &cells, 0.5, Point::new(1.0, -2.0)).unwrap()
}

/// The boxes of all cells of a kind.
fn boxes(grid: &Grid, is_one: impl Fn(Cell) -> bool) -> Vec<Bounds> {
    let mut all = Vec::new();
    for (at, cell) in grid.cells().iter().enumerate() {
        let corner = Vector::new((at % grid.width()) as f64, (at / grid.width()) as f64) * 0.5;
        let least = grid.bounds().least + corner;
        if is_one(*cell) {
            all.push(Bounds { least, most: least + Vector::repeat(0.5) });
        }
    }
    all
}

#[test]
fn distances_on_cells_are_those_to_the_nearest_of_all_cells() {
    let mut random = Random(3);
    for share in [0, 1, 5, 40, 90].into_iter().cycle().take(40) {
        let grid = random_grid(&mut random, share);
        let walls = boxes(&grid, |it| it == Cell::Occupied);
        let blocked = boxes(&grid, |it| it != Cell::Free);
        let bounds = grid.bounds();
        let nearest = |all: &[Bounds], at: Point, most: f64| {
            let to = |it: &Bounds| {
                let off = (it.least - at).sup(&(at - it.most)).sup(&Vector::zeros());
                off.norm()
            };
            all.iter().map(to).fold(most, f64::min)
        };
        for _ in 0..200 {
            let x = bounds.least.x + (part(&mut random) * 1.4 - 0.2) * bounds.width();
            let y = bounds.least.y + (part(&mut random) * 1.4 - 0.2) * bounds.height();
            let at = Point::new(x, y);
            let most = part(&mut random) * 12.0;
            let distance = grid.distance(at, most, Sense::Light);
            assert!((distance - nearest(&walls, at, most)).abs() < 1e-9, "{at:?}");
            let room = nearest(&blocked, at, most.min(bounds.margin(at)));
            assert!((grid.clearance(at, most) - room).abs() < 1e-9, "{at:?}");
        }
    }
}

#[test]
fn distances_in_the_office_are_those_to_the_nearest_of_all_stretches() {
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Real, &[]).unwrap();
    let mut random = Random(5);
    let mut all: Vec<(bool, Point, Point)> = Vec::new();
    let mut line = |is_glass: bool, points: &[Point], is_closed: bool| {
        all.extend(points.windows(2).map(|it| (is_glass, it[0], it[1])));
        if is_closed {
            all.push((is_glass, points[0], points[points.len() - 1]));
        }
    };
    for (lines, is_glass) in [(&office.walls, false), (&office.glass, true)] {
        for it in lines {
            let points: Vec<_> = it.points.iter().map(|it| metres(*it)).collect();
            line(is_glass, &points, it.is_closed);
        }
    }
    office.furniture.iter().for_each(|it| line(false, &it.corners(), true));
    for it in &office.doors {
        it.leaf(it.is_open).iter().for_each(|leaf| line(it.is_glass, leaf, false));
    }
    let to = |at: Point, a: Point, b: Point| {
        let (to, way) = (at - a, b - a);
        let part = (to.dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
        (to - way * part).norm()
    };
    for _ in 0..3_000 {
        let at = Point::new(part(&mut random) * 32.0 - 1.0, part(&mut random) * 22.0 - 1.0);
        let most = part(&mut random) * 6.0;
        let nearest = |glass: bool| {
            let seen = all.iter().filter(|it| glass || !it.0);
            seen.map(|it| to(at, it.1, it.2)).fold(most, f64::min)
        };
        for (sense, glass) in [(Sense::Light, false), (Sense::Sound, true)] {
            let distance = surface.distance(at, most, sense);
            assert!((distance - nearest(glass)).abs() < 1e-9, "{at:?} {sense:?}: {distance}");
        }
    }
}

#[test]
fn a_footprint_is_free_where_all_points_of_it_are() {
    let body = [[0.3, 0.2], [0.3, -0.2], [-0.35, -0.2], [-0.2, 0.0], [-0.35, 0.2]];
    let footprint = Footprint::polygon(body.map(Point::from).to_vec()).unwrap();
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Real, &[]).unwrap();
    let mut random = Random(9);
    let grid = random_grid(&mut random, 10);
    let (mut free, mut taken) = (0, 0);
    for floor in [&surface as &dyn Surface, &grid] {
        let bounds = floor.bounds();
        for _ in 0..4_000 {
            let at = bounds.least.coords
                + Vector::new(
                    part(&mut random) * bounds.width(),
                    part(&mut random) * bounds.height(),
                );
            let pose = Pose::new(at, part(&mut random) * 7.0);
            // Rows of points of the body.
            let points = (0..400).map(|it| {
                let (x, y) = (f64::from(it % 20) / 19.0, f64::from(it / 20) / 19.0);
                Point::new(-0.35 + 0.65 * x, -0.2 + 0.4 * y)
            });
            let inside = points.filter(|it| cotama_floor::is_inside(footprint.corners(), *it));
            let all_free = inside.map(|it| floor.clearance(pose * it, 0.05)).fold(1.0, f64::min);
            let is_free = floor.is_free(&footprint, &pose);
            // Between the points is up to 24 mm.
            assert!(!is_free || all_free > 0.0, "{pose:?} is not free");
            assert!(is_free || all_free < 0.05, "{pose:?} is free, {all_free}");
            free += usize::from(is_free);
            taken += usize::from(!is_free);
        }
    }
    assert!(free > 500 && taken > 500, "{free} {taken}");
}

#[test]
fn every_way_has_room_and_is_the_same_again() {
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Charted, &[true; 9]).unwrap();
    let planner = Planner::new(&surface, Needs::default()).unwrap();
    let again = Planner::new(&surface, Needs::default()).unwrap();
    let all: Vec<_> = office.places.iter().chain(&office.docks).collect();
    for (number, from) in all.iter().enumerate() {
        for to in [1, 5].map(|it| all[(number + it) % all.len()]) {
            let ends = [metres(from.at), metres(to.at)];
            let path = planner.route(ends[0], ends[1]).unwrap();
            assert_eq!(path, again.route(ends[0], ends[1]).unwrap());
            let mut along = 0.0;
            while along < path.length() {
                let at = Point::from(path.pose(along).translation.vector);
                let room = surface.clearance(at, 1.0);
                assert!(room > 0.26 - 0.003, "{} to {}: {room} m at {along}", from.name, to.name);
                let place = path.project_between(at, along - 0.1, along + 0.1);
                assert!((place.along - along).abs() < 1e-6 && place.aside.abs() < 1e-6);
                along += 0.05;
            }
            let straight = (ends[1] - ends[0]).norm();
            assert!(path.length() >= straight - 1e-9 && path.length() < 70.0);
        }
    }
}

#[test]
fn closed_doors_and_surprises_change_the_way() {
    let office = embedded::OFFICE.floor().unwrap();
    let place = |name| metres(office.place(name).unwrap().at);
    let route = |version, are_open: &[bool], needs| {
        let surface = office.surface(version, are_open).unwrap();
        let planner = Planner::new(&surface, needs).unwrap();
        planner.route(place("dock"), place("meeting room")).map(|it| it.length_mm())
    };
    let needs = Needs::default();
    let open = route(Version::Charted, &[], needs).unwrap();
    let mut doors = office.doors_at_first();
    let meeting = office.doors.iter().position(|it| it.name == "door meeting").unwrap();
    doors[meeting] = false;
    let closed = route(Version::Charted, &doors, needs).unwrap_err();
    assert!(closed.to_string().starts_with("no way from start to goal"), "{closed}");
    // The store's door is 0.8 m wide, less its leaf.
    let wide = route(Version::Charted, &[], Needs { radius_m: 0.45, ..needs }).unwrap_err();
    assert!(wide.to_string().starts_with("no way from start to goal"), "{wide}");
    assert!(route(Version::Real, &[], needs).unwrap() >= open);
}

#[test]
fn spans_of_the_zones_have_the_lengths_that_they_cut() {
    let path = Path::new([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0]].map(Point::from).to_vec());
    let path = path.unwrap();
    // A zone that the path enters twice, one that it only touches, and a concave one.
    let twice = [[2.0, -1.0], [11.0, -1.0], [11.0, 4.0], [9.0, 4.0], [9.0, -0.5], [2.0, -0.5]];
    assert_eq!(path.spans(&twice.map(Point::from)), [9.0..14.0]);
    let touched = [[2.0, 0.0], [4.0, -2.0], [0.0, -2.0]].map(Point::from);
    assert_eq!(path.spans(&touched), []);
    let comb = [
        [1.0, -1.0],
        [6.0, -1.0],
        [6.0, 1.0],
        [5.0, 1.0],
        [5.0, -0.5],
        [2.0, -0.5],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    assert_eq!(path.spans(&comb.map(Point::from)), [1.0..2.0, 5.0..6.0]);
}

#[test]
fn ways_on_the_public_maps_are_as_short_as_said() {
    let Some(folder) = common::folder() else { return };
    let text = std::fs::read_to_string(folder.join("missions.toml")).unwrap();
    let numbers = |line: &str| -> Vec<f64> {
        let line = line.split('=').nth(1).unwrap().trim().trim_matches(['[', ']', '"']);
        line.split(',').filter_map(|it| it.trim().parse().ok()).collect()
    };
    let mut count = 0;
    for (name, map) in maps(&folder) {
        // With no liked room it is the shortest way. The ways that are said keep 0.3 m from the
        // centres of cells.
        let radius_m = 0.3 - map.resolution() / 2.0;
        let needs = Needs { radius_m, liked_m: radius_m, cell_m: map.resolution() };
        let planner = Planner::new(&map, needs).unwrap();
        for mission in text.split("[[mission]]").filter(|it| it.contains(&name)) {
            let of = |key: &str| numbers(mission.lines().find(|it| it.starts_with(key)).unwrap());
            let (a, b, said) = (of("a ="), of("b ="), of("shortest_m")[0]);
            let path = planner.route(Point::new(a[0], a[1]), Point::new(b[0], b[1])).unwrap();
            let share = path.length() / said;
            println!("{name}: {:.2} m, said {said} m", path.length());
            assert!((0.9..1.03).contains(&share), "{name}: {} of {said}", path.length());
            count += 1;
        }
        std::hint::black_box(picture::grid(&name, &map, None));
    }
    assert_eq!(count, 12);
}
