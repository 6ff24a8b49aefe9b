//! Rays against exact arithmetic: on stretches in integers of 128 bits, on cells by a walk from
//! line to line that compares fractions.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss, clippy::cast_sign_loss)]

use cotama_floor::{
    Bounds, Cell, Field, Grid, Kind, Measure, Needs, Planner, Point, Ray, Segment, Segments,
    SegmentsError, Sense, Surface, Vector, Version, embedded, metres,
};
use cotama_fuzz::Random;

/// Coordinates are multiples of 2⁻¹⁶ m, directions of 2⁻³⁰: all of them are doubles.
const POSITION: i32 = 16;
const DIRECTION: i32 = 30;
/// Half of the distance of 1 to the next double.
const EPSILON: f64 = f64::EPSILON / 2.0;

type Whole = [i128; 2];

fn double(at: Whole, bits: i32) -> [f64; 2] {
    at.map(|it| it as f64 / f64::from(1 << bits))
}

fn cross(a: Whole, b: Whole) -> i128 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Whole, b: Whole) -> i128 {
    a[0] * b[0] + a[1] * b[1]
}

fn direction(random: &mut Random) -> Whole {
    let angle = std::f64::consts::TAU * random.below(1 << 30) as f64 / f64::from(1 << 30);
    let scale = f64::from(1 << DIRECTION);
    [libm::cos(angle), libm::sin(angle)].map(|it| (it * scale).round() as i128)
}

/// The distance at which a ray meets a stretch, in 2⁻⁶⁰ m, and its error in the worst case.
fn exact(from: Whole, along: Whole, [a, b]: [Whole; 2]) -> Option<(i128, f64)> {
    let [a, b] = [a, b].map(|it| [it[0] - from[0], it[1] - from[1]]);
    let (side_a, side_b) = (cross(along, a), cross(along, b));
    if side_a.min(side_b) > 0 || side_a.max(side_b) < 0 || side_a == side_b {
        return None;
    }
    let (ahead_a, ahead_b) = (dot(along, a), dot(along, b));
    let above = ahead_a * side_b - ahead_b * side_a;
    let below = side_b - side_a;
    if (above < 0) != (below < 0) && above != 0 {
        return None;
    }
    let length = |it: Whole| {
        let [x, y] = double(it, POSITION);
        libm::hypot(x, y)
    };
    let span = length([b[0] - a[0], b[1] - a[1]]);
    let sine = below as f64 / f64::from(1 << DIRECTION) / f64::from(1 << POSITION) / span;
    let bound = 8.0 * EPSILON * (length(a) + length(b)) / sine.abs();
    Some(((above << (60 - POSITION - DIRECTION)) / below, bound))
}

/// Draws 10⁶ rays over a floor of 16 m with 60 stretches and a wall around.
#[test]
fn a_million_rays_on_stretches_are_as_far_as_exact_ones() {
    let mut random = Random(40);
    let size: i128 = 16 << POSITION;
    let mut point = || [0; 2].map(|_: i128| (random.below(16 << 10) as i128) << (POSITION - 10));
    let mut ends: Vec<[Whole; 2]> = (0..60).map(|_| [point(), point()]).collect();
    let corners = [[0, 0], [size, 0], [size, size], [0, size]];
    ends.extend((0..4).map(|it| [corners[it], corners[(it + 1) % 4]]));
    let at = |it: Whole| Point::from(double(it, POSITION));
    let segments: Vec<_> =
        ends.iter().map(|[a, b]| Segment { from: at(*a), to: at(*b), kind: Kind::Wall }).collect();
    let bounds = Bounds { least: Point::origin(), most: Point::new(16.0, 16.0) };
    let floor = Segments::new(bounds, &segments, &[]).unwrap();
    let (mut worst, mut furthest) = (0.0_f64, 0.0_f64);
    let mut drawn = Vec::new();
    for _ in 0..1_000_000 {
        let from = [0; 2].map(|_: i128| random.below(16 << POSITION) as i128);
        let along = direction(&mut random);
        let all = ends.iter().filter_map(|it| exact(from, along, *it));
        let (nearest, bound) = all.min_by_key(|it| it.0).expect("there is a wall around");
        let ray = Ray { from: at(from), along: Vector::from(double(along, DIRECTION)) };
        let hit = floor.hit(&ray, 40.0, Sense::Light).expect("there is a wall around");
        if drawn.len() < 50_000 {
            drawn.push((ray, hit.distance));
        }
        let found = (hit.distance * (1_u64 << 60) as f64) as i128;
        let error = (found - nearest).abs() as f64 / (1_u64 << 60) as f64;
        assert!(error <= bound, "{ray:?}: {} is off by {error}, not {bound}", hit.distance);
        (worst, furthest) = (worst.max(error / bound), furthest.max(error));
    }
    // Together they go as far, bit for bit; not beyond their range.
    let rays: Vec<_> = drawn.iter().map(|it| it.0).collect();
    let mut together = vec![0.0; rays.len()];
    for range in [40.0, 3.0] {
        floor.distances(&rays, range, Sense::Light, &mut together);
        for ((ray, alone), together) in drawn.iter().zip(&together) {
            let alone = if *alone <= range { *alone } else { f64::INFINITY };
            assert_eq!(alone.to_bits(), together.to_bits(), "{ray:?}");
        }
    }
    println!("largest error {furthest:e} m, at most {worst:.2} of its bound");
    assert!(worst > 0.01, "the bound says nothing");
}

#[test]
fn no_ray_slips_through_the_corners_of_a_room() {
    let mut random = Random(7);
    let mut corner = |at: usize| {
        let angle = std::f64::consts::TAU * (at as f64 + 0.3) / 40.0;
        let far = 3.0 + random.below(1_000) as f64 / 250.0;
        Point::new(8.0 + far * libm::cos(angle), 8.0 + far * libm::sin(angle))
    };
    let corners: Vec<_> = (0..40).map(&mut corner).collect();
    let next = corners.iter().cycle().skip(1);
    let walls = corners.iter().zip(next);
    let walls: Vec<_> =
        walls.map(|(a, b)| Segment { from: *a, to: *b, kind: Kind::Wall }).collect();
    let bounds = Bounds { least: Point::origin(), most: Point::new(16.0, 16.0) };
    let floor = Segments::new(bounds, &walls, &[]).unwrap();
    for round in 0..100_000 {
        let off = |it: usize| (it % 1_000) as f64 / 1_000.0 - 0.5;
        let from = Point::new(8.0 + off(random.below(1_000)), 8.0 + off(random.below(1_000)));
        let way = corners[round % 40] - from;
        let ray = Ray { from, along: way / way.norm() };
        let hit = floor.hit(&ray, 40.0, Sense::Light);
        assert!(hit.is_some_and(|it| it.distance <= way.norm() + 1e-9), "{ray:?}");
    }
}

#[test]
fn a_crowd_of_long_stretches_is_refused_and_not_thinned_out() {
    let bounds = Bounds { least: Point::origin(), most: Point::new(500.0, 500.0) };
    let crowd = |count: usize| {
        let step = 500.0 / count as f64;
        let across = |at: usize| Segment {
            from: Point::new(step * at as f64, 0.0),
            to: Point::new(500.0 - step * at as f64, 500.0),
            kind: Kind::Wall,
        };
        Segments::new(bounds, &(0..count).map(across).collect::<Vec<_>>(), &[])
    };
    assert_eq!(crowd(50_000).unwrap_err(), SegmentsError::Crowded);
    // The last one of as many as fit is there.
    let many = crowd(4_000).unwrap();
    let ray = Ray { from: Point::new(499.95, 1.0), along: Vector::new(-1.0, 0.0) };
    let hit = many.hit(&ray, 9.0, Sense::Light).unwrap();
    let last = 499.875 - 499.75 / 500.0;
    assert!((hit.distance - (499.95 - last)).abs() < 1e-9, "{hit:?}");
}

/// Walks from line to line: the distances in cells at which the ray first touches an occupied cell,
/// and at which it first goes through one. They differ at corners only.
fn walk(grid: &Grid, from: Whole, along: Whole, bits: i32) -> [f64; 2] {
    let whole = 1_i128 << bits;
    let mut cell = from.map(|it| it.div_euclid(whole));
    let way = along.map(i128::signum);
    let is_wall = |at: Whole| {
        let inside = at.iter().all(|it| *it >= 0);
        inside && grid.cell(at[0] as usize, at[1] as usize) == Cell::Occupied
    };
    let sizes = [grid.width() as i128, grid.height() as i128];
    let mut touched = f64::INFINITY;
    let mut now = 0.0;
    loop {
        if (0..2).any(|it| cell[it] < 0 || cell[it] >= sizes[it]) {
            return [touched, f64::INFINITY];
        }
        if is_wall(cell) {
            return [touched.min(now), now];
        }
        // To the next line of each axis, as a fraction.
        let to = [0, 1].map(|it: usize| {
            let line = (cell[it] + i128::from(way[it] > 0)) * whole;
            ((line - from[it]).abs(), along[it].abs())
        });
        let difference = to[0].0 * to[1].1 - to[1].0 * to[0].1;
        let first = if to[0].1 == 0 { 1 } else { usize::from(to[1].1 != 0 && difference > 0) };
        now = to[first].0 as f64 / to[first].1 as f64 / whole as f64;
        now *= f64::from(1 << DIRECTION);
        let is_corner = difference == 0 && to[0].1 != 0 && to[1].1 != 0;
        let beside = [[cell[0] + way[0], cell[1]], [cell[0], cell[1] + way[1]]];
        if is_corner && beside.into_iter().any(is_wall) {
            touched = touched.min(now);
        }
        for axis in 0..2 {
            if is_corner || axis == first {
                cell[axis] += way[axis];
            }
        }
    }
}

#[test]
fn rays_on_cells_end_where_a_walk_from_line_to_line_ends() {
    let mut random = Random(11);
    let (mut corners, mut hits) = (0, 0);
    for (round, share) in [2, 10, 30, 60, 5, 20].into_iter().cycle().take(60).enumerate() {
        let (width, height) = (1 + random.below(90), 1 + random.below(70));
        let cells: Vec<_> = (0..width * height)
            .map(|_| if random.below(100) < share { Cell::Occupied } else { Cell::Free })
            .collect();
        let grid = Grid::new(width, &cells, 0.25, Point::new(-3.0, 2.0)).unwrap();
        let mut rays = Vec::new();
        let mut ends = Vec::new();
        for number in 0..4_000 {
            // Odd numbers of 2⁻⁹ of a cell are on no line.
            let bits = 9;
            let mut from = [width, height].map(|it| (random.below(it << 8) as i128) * 2 + 1);
            if number % 8 == 0 {
                // The middle of a cell, from where corners are met.
                from = from.map(|it| it >> bits << bits | 1 << (bits - 1));
            }
            let along = match number % 4 {
                // Ways that meet corners exactly, or go along an axis.
                0 => [[1, 1], [-1, 2], [3, -1], [-2, -3], [0, 1], [-1, 0]][random.below(6)]
                    .map(|it: i128| it << 20),
                _ => direction(&mut random),
            };
            ends.push(walk(&grid, from, along, bits));
            let at = double(from, bits).map(|it| it * 0.25);
            let from = Point::new(at[0] - 3.0, at[1] + 2.0);
            rays.push(Ray { from, along: Vector::from(double(along, DIRECTION)) });
        }
        let range = 1e6;
        let mut distances = vec![0.0; rays.len()];
        grid.distances(&rays, range, Sense::Light, &mut distances);
        for ((ray, distance), ends) in rays.iter().zip(distances).zip(ends) {
            let hit = grid.hit(ray, range, Sense::Sound).map_or(f64::INFINITY, |it| it.distance);
            assert_eq!(hit.to_bits(), distance.to_bits(), "alone and together: {ray:?}");
            let [touches, through] = ends.map(|it| it * 0.25);
            let slack = 1e-9 * (1.0 + if touches.is_finite() { touches } else { 0.0 });
            let good = distance >= touches - slack && distance <= through + slack;
            assert!(good, "{round}: {ray:?}: {distance}, not {touches} to {through}");
            corners += usize::from(touches < through);
            hits += usize::from(distance.is_finite());
            let short = grid.hit(ray, distance.min(50.0) * 0.999, Sense::Light);
            assert!(short.is_none() || distance == 0.0, "beyond its range: {ray:?}");
        }
    }
    println!("{hits} of 240000 rays hit, {corners} touched a corner first");
    assert!(hits > 100_000 && corners > 100, "{hits}, {corners}");
}

#[test]
fn rays_from_outside_enter_the_floor() {
    let mut cells = [Cell::Free; 9];
    cells[4] = Cell::Occupied;
    let grid = Grid::new(3, &cells, 1.0, Point::origin()).unwrap();
    for (from, angle, distance) in [
        ([-2.0, 1.5], 0.0, 3.0),
        ([1.5, 7.0], -std::f64::consts::FRAC_PI_2, 5.0),
        ([-2.0, 0.5], 0.0, f64::INFINITY),
        ([-2.0, 5.0], 0.0, f64::INFINITY),
        ([f64::NAN, 1.5], 0.0, f64::INFINITY),
        ([1.5, 1.5], 1.0, 0.0),
    ] {
        let ray = Ray::at(Point::from(from), angle);
        let mut out = [0.0];
        grid.distances(&[ray], 100.0, Sense::Light, &mut out);
        assert!(
            (out[0] - distance).abs() < 1e-12 || out[0].min(distance).is_infinite(),
            "{from:?}: {}",
            out[0]
        );
    }
}

/// Adds the bits of a number to a digest (FNV-1a).
fn add(digest: &mut u64, number: f64) {
    for byte in number.to_bits().to_le_bytes() {
        *digest = (*digest ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    }
}

/// A digest that is the same in every build and on every machine.
#[test]
fn the_office_has_the_same_bits_everywhere() {
    let office = embedded::OFFICE.floor().unwrap();
    let surface = office.surface(Version::Real, &[]).unwrap();
    let field = Field::of(&surface, 0.2, 1.0, Measure::Seen(Sense::Light)).unwrap();
    let cells: Vec<_> = field.values().iter().map(|it| *it < 0.1).collect();
    let cells: Vec<_> =
        cells.into_iter().map(|it| if it { Cell::Occupied } else { Cell::Free }).collect();
    let grid = Grid::new(field.columns(), &cells, 0.2, Point::origin()).unwrap();
    let mut digest = 0xcbf2_9ce4_8422_2325;
    let mut random = Random(1);
    for number in 0..20_000 {
        let mut part = || random.below(1 << 30) as f64 / f64::from(1 << 30);
        let at = Point::new(30.0 * part(), 20.0 * part());
        let ray = Ray::at(at, 7.0 * part());
        let floor: &dyn Surface = if number % 2 == 0 { &surface } else { &grid };
        let hit = floor.hit(&ray, 8.0, Sense::Sound);
        add(&mut digest, hit.map_or(-1.0, |it| it.distance + it.cosine));
        add(&mut digest, floor.clearance(at, 3.0));
    }
    let planner = Planner::new(&surface, Needs::default()).unwrap();
    let place = |name| metres(office.place(name).unwrap().at);
    let path = planner.route(place("dock"), place("office A")).unwrap();
    path.points().iter().flat_map(|it| [it.x, it.y]).for_each(|it| add(&mut digest, it));
    assert_eq!(format!("{digest:016x}"), "861873ebac8412cb");
}
