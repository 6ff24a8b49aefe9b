//! Floors that robots drive on: the world in the plane.
//!
//! A floor comes from a drawing of ours ([`Floor`], a `cotama-floor/1` file) or from a map of ROS
//! ([`map_server`]). The first is made of straight pieces ([`Segments`]), the second of cells
//! ([`Grid`]); both answer the questions of sensors, bodies and planners through one trait,
//! [`Surface`]: how far a ray goes and what it hits, how much room there is, whether a body fits.
//! [`Field`] computes distances once on a grid, [`Planner`] finds a [`Path`] from place to place,
//! [`picture`] draws it all.
//!
//! Lengths of files are whole numbers of mm; here they are metres and radians in double precision.
//! All functions beyond the arithmetic of IEEE 754 are those of `libm`, so that the same floor
//! gives the same bytes on every machine.
//!
//! *Speed.* Millions of rays a second at a range of 8 m on one core of a shared machine (a Xeon of
//! 2.65 GHz as a program sees it; the best of 41 rounds, as others work beside it), by
//! `benches/rays.rs` on the public maps that it names:
//!
//! | floor | rays at random | scans of 360 rays |
//! | --- | --- | --- |
//! | `willow_full_10cm`, 584 x 526 cells | 12.7 | 18.5 |
//! | `nav2_depot_5cm`, 604 x 307 cells | 15.0 | 22.0 |
//! | `turtlebot3_world_5cm`, 125 x 116 cells | 20.3 | 22.7 |
//! | the office that ships, as stretches | 6.9 | 9.0 |
//!
//! ```
//! use cotama_floor::{Needs, Planner, Ray, Sense, Surface, Version, embedded, metres};
//! let office = embedded::OFFICE.floor().unwrap();
//! let surface = office.surface(Version::Real, &[]).unwrap();
//! // From the corridor through the glass of the lounge: a laser looks through, a sonar does not.
//! let ray = Ray::at([11.0, 10.0].into(), -core::f64::consts::FRAC_PI_2);
//! let seen = |sense| surface.hit(&ray, 10.0, sense).map(|it| it.distance.round());
//! assert_eq!((seen(Sense::Light), seen(Sense::Sound)), (Some(8.0), Some(1.0)));
//! let planner = Planner::new(&surface, Needs::default()).unwrap();
//! let place = |name| metres(office.place(name).unwrap().at);
//! let path = planner.route(place("kitchen"), place("lab")).unwrap();
//! assert!((13_000..15_000).contains(&path.length_mm()), "{}", path.length_mm());
//! ```
#![allow(clippy::cast_precision_loss)] // cells and rows need no more than 24 bits
#![allow(clippy::cast_sign_loss)] // what becomes a cell was made at least 0 before

pub mod embedded;
mod field;
mod floor;
mod geometry;
mod grid;
mod held;
pub mod map_server;
mod octants;
mod path;
pub mod picture;
mod route;
mod segments;
mod surface;
mod way;
mod ways;
pub mod yaml;

pub use field::{Field, FieldError, Measure};
pub use floor::{
    Door, FORMAT, Floor, Furniture, Line, MAX_MM, MAX_NAME, MAX_POINTS, Mark, Outline, Place,
    PointMm, ROUND, Version, Zone, metres,
};
pub use geometry::{Bounds, Point, Pose, Ray, Vector, is_inside};
pub use grid::{Cell, Grid, GridError, MAX_CELLS};
pub use held::Held;
pub use path::{Path, Projection};
pub use route::{Needs, Planner, RouteError};
pub use segments::{MAX_SEGMENTS, MAX_SIZE_M, MAX_SOLIDS, Segment, Segments, SegmentsError};
pub use surface::{Footprint, Hit, Kind, Sense, Surface};
pub use way::{Ground, PERSON_RADIUS_M};
