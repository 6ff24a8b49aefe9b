//! Records a robot with a laser as lines of JSON, for `tests/evidence/compare/localisation.py`.
//!
//! Usage: `record_localisation FILE SEED [MAP.yaml X,Y X,Y ..]`, points in metres; without a map a
//! round through the office. The first line has the map as both sides get it: cells, of the office
//! those within half a cell of a wall. The others have, for each update, the truth, the odometry,
//! the ranges, and for each model of this crate the pose and the time that the update took.
#![allow(clippy::unwrap_used, clippy::cast_precision_loss)]

#[path = "../tests/localisation/common/mod.rs"]
mod common;

use common::{RANGE_M, RAYS, laser, office, route, route_on, with_laser, with_laser_on};
use cotama_floor::map_server::{Map, Metadata};
use cotama_floor::{Cell, Field, Grid, Measure, Point, Pose, Sense, Surface, Version};
use cotama_localisation::{Chart, Localiser, Model, Parameters};
use cotama_streams::Streams;
use nalgebra::Matrix3;
use std::fmt::Write as _;
use std::time::Instant;

const CELL_M: f64 = 0.05;
const ROUND: [&str; 7] =
    ["dock", "office B", "lab", "meeting room", "lounge", "open office", "corridor east"];

/// The office as a robot knows it, in cells.
fn as_cells(floor: &dyn Surface) -> Grid {
    let field = Field::of(floor, CELL_M, 1.0, Measure::Seen(Sense::Light)).unwrap();
    let is_wall = |it: &f32| f64::from(*it) <= CELL_M / 2.0 + 1e-4;
    let cell = |it: &f32| if is_wall(it) { Cell::Occupied } else { Cell::Free };
    let cells: Vec<_> = field.values().iter().map(cell).collect();
    Grid::new(field.columns(), &cells, CELL_M, floor.bounds().least).unwrap()
}

fn map(file: &str) -> Grid {
    let text = std::fs::read_to_string(file).unwrap();
    let (metadata, _) = Metadata::parse(file, &text).unwrap();
    let image = std::fs::read(metadata.image_path(file.as_ref())).unwrap();
    Map::read(&metadata, &metadata.image, &image).unwrap().grid().unwrap()
}

fn point(text: &str) -> Point {
    let (x, y) = text.split_once(',').unwrap();
    Point::new(x.parse().unwrap(), y.parse().unwrap())
}

fn pose(it: &Pose) -> String {
    let at = it.translation.vector;
    format!("[{},{},{}]", at.x, at.y, it.rotation.angle())
}

fn list<T: std::fmt::Display>(all: impl Iterator<Item = T>) -> String {
    format!("[{}]", all.map(|it| it.to_string()).collect::<Vec<_>>().join(","))
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let streams = Streams::new(arguments[1].parse().unwrap());
    let (grid, moments) = if let Some(file) = arguments.get(2) {
        let grid = map(file);
        let points: Vec<_> = arguments[3..].iter().map(|it| point(it)).collect();
        let moments = with_laser_on(&grid, &route_on(&grid, &points), streams);
        (grid, moments)
    } else {
        (as_cells(&office(Version::Charted)), with_laser(&route(&ROUND), streams))
    };
    let spread = [0.04, 0.04, 0.01];
    let charts =
        [(Model::Beam, 0.1), (Model::LikelihoodField, 0.05), (Model::LikelihoodFieldProb, 0.05)]
            .map(|(laser_model_type, cell_m)| {
                // Those of the filter that AMCL begins with, which its binding does not change.
                let parameters = Parameters {
                    laser_model_type,
                    pf_err: 0.01,
                    pf_z: 3.0,
                    ..Parameters::default()
                };
                Chart::new(&grid, cell_m, &laser(), &parameters).unwrap()
            });
    let mut localisers = charts.each_ref().map(|chart| {
        let mut it = Localiser::new(chart, &streams, "robot");
        it.start_at(&moments[0].truth, &Matrix3::from_diagonal(&spread.into())).unwrap();
        it
    });
    let mut text = String::new();
    let cells = grid.cells().iter().map(|it| match it {
        Cell::Free => 0,
        Cell::Occupied => 100,
        Cell::Unknown => -1,
    });
    let origin = grid.bounds().least;
    writeln!(
        text,
        "{{\"width\":{},\"height\":{},\"resolution\":{},\"origin\":[{},{}],\"rays\":{RAYS},\
         \"range\":{RANGE_M},\"spread\":{},\"cells\":{}}}",
        grid.width(),
        grid.height(),
        grid.resolution(),
        origin.x,
        origin.y,
        list(spread.iter()),
        list(cells),
    )
    .unwrap();
    for moment in &moments {
        let found = localisers.iter_mut().filter_map(|localiser| {
            let start = Instant::now();
            let is_updated = localiser.update(&moment.odometry, &moment.ranges);
            let ms = start.elapsed().as_secs_f64() * 1e3;
            let model = localiser.chart().parameters().laser_model_type.name();
            let found = pose(&localiser.estimate().pose);
            is_updated.then(|| format!("\"{model}\":{{\"pose\":{found},\"ms\":{ms}}}"))
        });
        let found: Vec<_> = found.collect();
        if !found.is_empty() {
            let (truth, odometry) = (pose(&moment.truth), pose(&moment.odometry));
            let ranges = list(moment.ranges.iter().map(|it| it.min(RANGE_M)));
            writeln!(
                text,
                "{{\"truth\":{truth},\"odometry\":{odometry},\"ranges\":{ranges},\
                 \"found\":{{{}}}}}",
                found.join(",")
            )
            .unwrap();
        }
    }
    std::fs::write(&arguments[0], text).unwrap();
}
