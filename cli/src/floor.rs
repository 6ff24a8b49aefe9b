//! `cotama floor`: a floor, its places, and paths over it.
#![allow(clippy::cast_precision_loss)] // a radius in mm needs no more than 14 bits
#![allow(clippy::cast_sign_loss)] // lengths and room are at least 0

use crate::answers::floor::{DoorRow, Drawn, FloorAnswer, Mapped, PathRow, PlaceRow, SpanRow};
use crate::args::FloorArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::kind::{self, Kind};
use crate::names::{near, quoted};
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use cotama_floor::map_server::{Map, Metadata};
use cotama_floor::{
    Cell, Floor, Grid, Ground, Needs, Path as Way, Planner, Point, RouteError, Surface, Version,
    embedded, metres, picture,
};
use cotama_models::missions::{Asked, Way as MissionWay};
use cotama_models::robots::RobotFile;
use std::path::Path;

/// The largest drawing, and the largest image of a map.
const FLOOR_BYTES: u64 = 4 << 20;
const IMAGE_BYTES: u64 = 256 << 20;

/// A floor, as it was read.
enum Read {
    Drawing(Box<Floor>),
    Map { name: String, grid: Box<Grid> },
}

/// Shows a floor, or a path over it.
pub(crate) fn floor(args: &FloorArgs, screen: &Screen) -> Result<Exit, Failure> {
    if let Some(path) = &args.output {
        output::place(path)?;
        if path.extension().is_none_or(|it| !it.eq_ignore_ascii_case("svg")) {
            let message = format!("{}: a floor is drawn as SVG", path.display());
            return Err(Failure::new(message).help("end the name in .svg"));
        }
    }
    let read = read(&args.floor, Some(screen))?;
    let found = match (&args.from, &args.to) {
        (Some(from), Some(to)) => Some(found(&read, args, from, to)?),
        _ => None,
    };
    let (path, no_path) = match found {
        Some(Ok(it)) => (Some(it), None),
        Some(Err(why)) => (None, Some(why)),
        None => (None, None),
    };
    if let Some(file) = &args.output {
        let drawn = match &read {
            Read::Drawing(it) => picture::floor(&with_doors(it, args)?, path.as_ref()),
            Read::Map { name, grid } => picture::grid(name, grid, path.as_ref()),
        };
        output::file(file, drawn.as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", file.display()));
    }
    let answer = answer(&read, args, path.as_ref(), no_path)?;
    if args.json.json {
        Screen::json(&answer)?;
    } else {
        screen.print(&render::floor::screen(&answer, screen.width()))?;
    }
    Ok(if answer.no_path.is_some() { Exit::Violated } else { Exit::Success })
}

/// Plans the way of a mission over the floor that it names, for its robot; `None` where there is no
/// such floor beside the mission, which the reader of missions says.
///
/// # Errors
/// When the floor cannot be read.
pub(crate) fn way(
    asked: Asked,
    folder: Option<&Path>,
    robot: Option<&RobotFile>,
) -> Result<Option<MissionWay>, Failure> {
    let radius = robot.and_then(|it| it.robot().body.as_ref()).map(|it| it.radius.0);
    let of_robot = |it: u64| Needs { radius_m: it as f64 / 1_000.0, ..Needs::default() };
    let needs = radius.map_or(Needs::default(), of_robot);
    let beside = folder.map(|it| it.join(&asked.floor)).filter(|it| it.exists());
    let name = match beside {
        Some(file) => file.display().to_string(),
        None if asked.floor == OFFICE => asked.floor.clone(),
        None => return Ok(None),
    };
    let text = match name.as_str() {
        OFFICE => embedded::OFFICE.text.to_owned(),
        file => input::text(file, "a floor", FLOOR_BYTES)?,
    };
    Ok(Some(match read(&name, None)? {
        Read::Drawing(floor) => Ground::Drawing(&floor).way(&name, &text, asked, needs),
        Read::Map { grid, .. } => Ground::Map(&grid).way(&name, &text, asked, needs),
    }))
}

/// The drawing of a name, or in a file.
///
/// # Errors
/// When it cannot be read, or is a map.
pub(crate) fn drawing(name: &str) -> Result<Floor, Failure> {
    match read(name, None)? {
        Read::Drawing(it) => Ok(*it),
        Read::Map { .. } => Err(Failure::new(format!("{} is a map, without places", quoted(name)))
            .help("give `office`, or a drawing: `cotama new floor NAME` begins one")),
    }
}

/// The floor that comes with the program.
const OFFICE: &str = "office";

/// The floor of a name, or in a file.
fn read(name: &str, screen: Option<&Screen>) -> Result<Read, Failure> {
    if name == OFFICE {
        return Ok(Read::Drawing(Box::new(embedded::OFFICE.floor()?)));
    }
    let end = Path::new(name).extension().map(|it| it.to_string_lossy().to_lowercase());
    match end.as_deref() {
        Some("yaml" | "yml") => map(name, screen),
        Some("toml") => {
            let text = kind::text(name, "a floor", FLOOR_BYTES, &[Kind::Floor])?;
            Ok(Read::Drawing(Box::new(Floor::parse(input::name(name), &text)?)))
        }
        _ => Err(Failure::new(format!("there is no floor {}", quoted(name)))
            .help("give `office`, FILE.toml (`cotama new floor NAME` begins one) or FILE.yaml")),
    }
}

fn map(name: &str, screen: Option<&Screen>) -> Result<Read, Failure> {
    let text = input::text(name, "the text of a map", FLOOR_BYTES)?;
    let (metadata, warnings) = Metadata::parse(input::name(name), &text)?;
    if let Some(screen) = screen {
        warnings.iter().for_each(|it| screen.note(&it.to_string()));
    }
    let image = metadata.image_path(Path::new(name));
    let image = image.to_string_lossy();
    let bytes = input::bytes(&image, "the image of a map", IMAGE_BYTES)?;
    let map = Map::read(&metadata, &image, &bytes)
        .map_err(|it| Failure::new(it.to_string()).help("give a PNG or PGM that Nav2 reads"))?;
    let grid = map.grid().map_err(|it| Failure::of(&*image, it.to_string()))?;
    let name =
        Path::new(name).file_stem().map_or_else(String::new, |it| it.to_string_lossy().into());
    Ok(Read::Map { name, grid: Box::new(grid) })
}

/// A drawing with doors opened and closed as it is asked for.
fn with_doors(floor: &Floor, args: &FloorArgs) -> Result<Floor, Failure> {
    let mut floor = floor.clone();
    for (name, is_open) in
        args.open.iter().map(|it| (it, true)).chain(args.close.iter().map(|it| (it, false)))
    {
        let Some(door) = floor.doors.iter_mut().find(|it| it.name == *name) else {
            let known: Vec<_> = floor.doors.iter().map(|it| it.name.as_str()).collect();
            return Err(unknown("door", name, &known));
        };
        door.is_open = is_open;
    }
    Ok(floor)
}

fn unknown(what: &str, name: &str, known: &[&str]) -> Failure {
    let guess = near(name, known.iter().copied())
        .map_or_else(String::new, |it| format!("; did you mean {}?", quoted(it)));
    let failure = Failure::new(format!("there is no {what} {}{guess}", quoted(name)));
    failure.help(format!("known: {}", known.join(", ")))
}

/// A place by its name, or as X,Y in mm.
fn place(floor: Option<&Floor>, name: &str) -> Result<Point, Failure> {
    if let Some(it) = floor.and_then(|it| it.place(name)) {
        return Ok(metres(it.at));
    }
    let numbers = name.split_once(',').map(|(x, y)| (x.trim().parse::<i32>(), y.trim().parse()));
    match (numbers, floor) {
        (Some((Ok(x), Ok(y))), _) => Ok(metres([x, y])),
        (_, Some(floor)) => {
            let known: Vec<_> =
                floor.places.iter().chain(&floor.docks).map(|it| it.name.as_str()).collect();
            Err(unknown("place", name, &known))
        }
        (_, None) => Err(Failure::new(format!("{} is no place of a map", quoted(name)))
            .help("write X,Y in mm, as 1500,-2000")),
    }
}

/// The path from place to place, or why there is none.
fn found(
    read: &Read,
    args: &FloorArgs,
    from: &str,
    to: &str,
) -> Result<Result<Way, String>, Failure> {
    let drawing = match read {
        Read::Drawing(it) => Some(with_doors(it, args)?),
        Read::Map { .. } if args.open.is_empty() && args.close.is_empty() => None,
        Read::Map { .. } => return Err(Failure::new("a map has no doors").help("leave them out")),
    };
    let (start, goal) = (place(drawing.as_ref(), from)?, place(drawing.as_ref(), to)?);
    let segments = drawing.as_ref().map(|it| it.surface(Version::Charted, &[])).transpose();
    let segments = segments.map_err(|it| Failure::of(&args.floor, it.to_string()))?;
    let surface: &dyn Surface = match (&segments, read) {
        (Some(it), _) => it,
        (None, Read::Map { grid, .. }) => &**grid,
        (None, Read::Drawing(_)) => return Err(Failure::new("a drawing has no surface")),
    };
    let needs = Needs { radius_m: args.radius as f64 / 1_000.0, ..Needs::default() };
    let planner = Planner::new(surface, needs).map_err(|it| Failure::new(it.to_string()))?;
    Ok(match planner.route(start, goal) {
        Ok(it) => Ok(it),
        Err(RouteError::Start(room)) => Err(no_room(from, room, args.radius)),
        Err(RouteError::Goal(room)) => Err(no_room(to, room, args.radius)),
        Err(_) => {
            let closed = drawing.iter().flat_map(|it| &it.doors).filter(|it| !it.is_open);
            let closed: Vec<_> = closed.map(|it| it.name.as_str()).collect();
            let doors = match &closed[..] {
                [] => String::new(),
                all => format!("; closed are {}: `--open` opens one", all.join(", ")),
            };
            Err(format!(
                "nothing leads from {} to {} for this robot{doors}",
                quoted(from),
                quoted(to)
            ))
        }
    })
}

fn no_room(at: &str, room_m: f64, radius_mm: u64) -> String {
    let room = (room_m * 1_000.0) as u64;
    format!("a robot of {radius_mm} mm radius has no room at {}: {room} mm are free", quoted(at))
}

fn answer(
    read: &Read,
    args: &FloorArgs,
    path: Option<&Way>,
    no_path: Option<String>,
) -> Result<FloorAnswer, Failure> {
    let mm = |it: f64| (it * 1_000.0).round();
    let (name, title, size, drawing, map) = match read {
        Read::Drawing(it) => {
            let it = with_doors(it, args)?;
            let size = it.size.map(|it| u64::from(it.unsigned_abs()));
            (it.name.clone(), it.title.clone(), size, Some(drawn(&it)), None)
        }
        Read::Map { name, grid } => {
            let bounds = grid.bounds();
            let size = [mm(bounds.width()) as u64, mm(bounds.height()) as u64];
            (name.clone(), String::new(), size, None, Some(mapped(grid)))
        }
    };
    let row = |it: &Way| PathRow {
        from: args.from.clone().unwrap_or_default(),
        to: args.to.clone().unwrap_or_default(),
        radius_mm: args.radius,
        length_mm: it.length_mm(),
        corners_mm: it.points().iter().map(|it| [mm(it.x) as i64, mm(it.y) as i64]).collect(),
        zones: match read {
            Read::Drawing(floor) => spans(floor, it),
            Read::Map { .. } => Vec::new(),
        },
    };
    let path = path.map(row);
    let [width_mm, height_mm] = size;
    let schema = "cotama/floor/1";
    Ok(FloorAnswer { schema, name, title, width_mm, height_mm, drawing, map, path, no_path })
}

fn spans(floor: &Floor, path: &Way) -> Vec<SpanRow> {
    let mm = |it: f64| (it * 1_000.0).round() as u64;
    let zones = floor.zones.iter().flat_map(|zone| {
        path.spans(&zone.corners()).into_iter().map(|it| SpanRow {
            zone: zone.name.clone(),
            x_start_mm: mm(it.start),
            x_end_mm: mm(it.end),
        })
    });
    let mut zones: Vec<_> = zones.collect();
    zones.sort_by_key(|it| (it.x_start_mm, it.x_end_mm));
    zones
}

fn drawn(it: &Floor) -> Drawn {
    let places = it.places.iter().map(|it| (it, false)).chain(it.docks.iter().map(|it| (it, true)));
    let place = |(it, dock): (&cotama_floor::Place, bool)| PlaceRow {
        name: it.name.clone(),
        x_mm: it.at[0],
        y_mm: it.at[1],
        dock,
    };
    Drawn {
        walls: it.walls.len(),
        glass: it.glass.len(),
        furniture: it.furniture.len(),
        uncharted: it.furniture.iter().filter(|it| !it.is_charted).count(),
        marks: it.marks.len(),
        doors: it
            .doors
            .iter()
            .map(|it| DoorRow { name: it.name.clone(), open: it.is_open })
            .collect(),
        places: places.map(place).collect(),
        zones: it.zones.iter().map(|it| it.name.clone()).collect(),
    }
}

fn mapped(grid: &Grid) -> Mapped {
    let of = |kind: Cell| grid.cells().iter().filter(|it| **it == kind).count();
    Mapped {
        columns: grid.width(),
        rows: grid.height(),
        cell_mm: grid.resolution() * 1_000.0,
        free: of(Cell::Free),
        occupied: of(Cell::Occupied),
        unknown: of(Cell::Unknown),
    }
}
