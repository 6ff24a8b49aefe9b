//! Floors that robots drive on: the world in the plane.
#![allow(clippy::cast_precision_loss)] // cells and rows need no more than 24 bits
#![allow(clippy::cast_sign_loss)] // what becomes a cell was made at least 0 before

pub mod embedded;
mod field;
mod floor;
mod geometry;
mod grid;
pub mod map_server;
mod octants;
mod path;
pub mod picture;
mod route;
mod segments;
mod surface;

pub use field::{Field, FieldError, Measure};
pub use floor::{
    Door, FORMAT, Floor, Furniture, Line, MAX_MM, MAX_NAME, MAX_POINTS, Mark, Outline, Place,
    PointMm, ROUND, Version, Zone, metres,
};
pub use geometry::{Bounds, Point, Pose, Ray, Vector, is_inside};
pub use grid::{Cell, Grid, GridError, MAX_CELLS};
pub use path::{Path, Projection};
pub use route::{Needs, Planner, RouteError};
pub use segments::{MAX_SEGMENTS, MAX_SIZE_M, MAX_SOLIDS, Segment, Segments, SegmentsError};
pub use surface::{Footprint, Hit, Kind, Sense, Surface};
