//! Stories of a radio link in a hall with walls every metre from x = 10.5 m on.
#![allow(clippy::unwrap_used, clippy::float_cmp, clippy::cast_precision_loss)]

use cotama_core::units::Millis;
use cotama_devices::{Fault, Link, LinkSettings, Mode, Streams};
use cotama_floor::{Bounds, Cell, Grid, Kind, Point, Segment, Segments};

fn hall() -> Segments {
    let bounds = Bounds { least: Point::origin(), most: Point::new(20.0, 2.0) };
    let wall = |at: usize| {
        let x = 10.5 + at as f64;
        let kind = [Kind::Wall, Kind::Door][at % 2];
        Segment { from: Point::new(x, 0.0), to: Point::new(x, 2.0), kind }
    };
    let pane = [[5.0, 0.0], [5.0, 2.0]].map(Point::from);
    let pane = Segment { from: pane[0], to: pane[1], kind: Kind::Glass };
    let segments: Vec<_> = (0..8).map(wall).chain([pane]).collect();
    Segments::new(bounds, &segments, &[]).unwrap()
}

fn quiet() -> LinkSettings {
    LinkSettings { noise_db: 0.0, ..LinkSettings::wifi() }
}

/// Returns the level so far from an access point at the origin, to 0.01 dB.
fn level(x: f64) -> f64 {
    let level = quiet().level(&hall(), Point::new(0.0, 1.0), Point::new(x, 1.0));
    (level * 100.0).round() / 100.0
}

#[test]
fn a_level_falls_by_its_exponent_a_decade_and_by_its_walls() {
    assert_eq!([0.0, 1.0, 10.0].map(level), [-40.0, -40.0, -70.0]); // through a pane of glass
    let distance = |x: f64| -40.0 - 30.0 * libm::log10(x);
    let with_walls = |x: f64, walls: f64| ((distance(x) - 3.1 * walls) * 100.0).round() / 100.0;
    assert_eq!(level(11.0), with_walls(11.0, 1.0));
    assert_eq!(level(14.0), with_walls(14.0, 4.0));
    assert_eq!(level(17.0), with_walls(17.0, 4.0)); // behind seven, four of which count
}

#[test]
fn a_link_over_a_map_of_cells_counts_walls_as_one_over_a_drawing() {
    // A wall of two cells, and one of a single cell, 0.5 m wide each.
    let cell = |it: char| if it == '#' { Cell::Occupied } else { Cell::Free };
    let cells: Vec<_> = "..##..#...".chars().map(cell).collect();
    let grid = Grid::new(10, &cells, 0.5, Point::origin()).unwrap();
    let level = |x: f64| quiet().level(&grid, Point::new(0.25, 0.25), Point::new(x, 0.25));
    let near = |x: f64, expected: f64| (level(x) - expected).abs() < 1e-9;
    assert!(near(0.9, -40.0) && near(1.2, -43.1) && near(4.25, -46.2 - 30.0 * libm::log10(4.0)));
}

#[test]
fn a_robot_hears_the_best_access_point() {
    let points = [Point::new(0.0, 1.0), Point::new(9.0, 1.0)];
    let mut link = Link::new(&quiet(), &points, &Streams::new(7), "wifi").unwrap();
    link.sense(Millis(0), Point::new(8.5, 1.0), &hall());
    assert_eq!(link.latest(Millis(0)).unwrap().value, -40.0);
}

#[test]
fn a_link_that_fades_loses_its_level_in_time_and_for_good() {
    let mut link = Link::new(&quiet(), &[Point::origin()], &Streams::new(7), "wifi").unwrap();
    let fading = Fault::new(Mode::fading(30.0, Millis(10_000))).unwrap().from(Millis(1_000));
    link.faults().replace(&[fading], &Streams::new(7), "wifi").unwrap();
    let mut level = |now: u64| {
        link.sense(Millis(now), Point::new(0.5, 0.5), &hall());
        link.latest(Millis(now)).unwrap().value
    };
    let times = [500, 1_000, 6_000, 11_000, 60_000];
    assert_eq!(times.map(&mut level), [-40.0, -40.0, -55.0, -70.0, -70.0]);
}
