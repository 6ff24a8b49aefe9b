//! `cotama floor`: a floor, its places, and paths over it.
#![allow(clippy::cast_precision_loss)] // a radius in mm needs no more than 14 bits
#![allow(clippy::cast_sign_loss)] // lengths and room are at least 0

use crate::answers::floor::{DoorRow, Drawn, FloorAnswer, Mapped, PathRow, PlaceRow, SpanRow};
use crate::args::FloorArgs;
use crate::exit::{Exit, Failure};
use crate::input;
use crate::kind::{self, Kind};
use crate::names::quoted;
use crate::output::{self, Screen};
use crate::render;
use crate::render::style::NAME;
use cotama_floor::map_server::{Map, Metadata};
use cotama_floor::{Cell, Floor, Grid, Ground, Needs, Surface, embedded, metres, picture};
use cotama_models::missions::{Asked, NoLeg, Refusal, Way};
use cotama_models::robots::RobotFile;
use cotama_models::team::scenario::{self, Ways};
use cotama_sim::fleet::floors;
use std::ops::Range;
use std::path::Path;

/// The largest drawing, and the largest image of a map.
const FLOOR_BYTES: u64 = 4 << 20;
const IMAGE_BYTES: u64 = 256 << 20;

/// A floor, as it was read.
enum Read {
    Drawing(Box<Floor>),
    Map { name: String, grid: Box<Grid> },
}

impl Read {
    fn ground(&self) -> Ground<'_> {
        match self {
            Self::Drawing(it) => Ground::Drawing(it),
            Self::Map { grid, .. } => Ground::Map(grid),
        }
    }
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
    let read = match read(&args.floor, Some(screen))? {
        Read::Drawing(it) => Read::Drawing(Box::new(it.with_doors(&args.open, &args.close)?)),
        map @ Read::Map { .. } => map,
    };
    let (path, no_path) = match (&args.from, &args.to) {
        (Some(from), Some(to)) => match found(&read, args, from, to)? {
            Ok(it) => (Some(it), None),
            Err(why) => (None, Some(why)),
        },
        _ => (None, None),
    };
    if let Some(file) = &args.output {
        let corners = path.iter().flat_map(|it| &it.corners_mm).map(|it| metres(*it));
        let way = cotama_floor::Path::new(corners.collect());
        let drawn = match &read {
            Read::Drawing(it) => picture::floor(it, way.as_ref()),
            Read::Map { name, grid } => picture::grid(name, grid, way.as_ref()),
        };
        output::file(file, drawn.as_bytes())?;
        screen.note(&format!("written: {NAME}{}{NAME:#}", file.display()));
    }
    let answer = answer(&read, path, no_path);
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
    screen: Option<&Screen>,
) -> Result<Option<Way>, Failure> {
    let radius = robot.and_then(|it| it.robot().body.as_ref()).map(|it| it.radius.0);
    let needs = radius.map_or(Needs::default(), needs).beyond(asked.clearance);
    let Some((name, text)) = named(&asked.floor, folder)? else { return Ok(None) };
    Ok(Some(read(&name, screen)?.ground().way(&name, &text, asked, needs)))
}

/// Plans the ways of a team over the floor that it names, for its robots; `None` where there is no
/// such floor beside the team, which the reader of teams says.
///
/// # Errors
/// When the floor cannot be read.
pub(crate) fn ways(
    asked: scenario::Asked,
    folder: Option<&Path>,
    robots: &[RobotFile],
) -> Result<Option<Ways>, Failure> {
    let needs = floors::needs(robots.iter().chain([&scenario::usual()]));
    let Some((name, text)) = named(&asked.floor, folder)? else { return Ok(None) };
    Ok(Some(read(&name, None)?.ground().ways(&name, &text, asked, needs)))
}

/// The name and the text of a floor beside a file, or else of one that ships; `None` where there is
/// neither.
fn named(floor: &str, folder: Option<&Path>) -> Result<Option<(String, String)>, Failure> {
    let beside = folder.map(|it| it.join(floor)).filter(|it| it.exists());
    let Some(file) = beside.map(|it| it.display().to_string()) else {
        return Ok(embedded::named(floor).map(|it| (floor.to_owned(), it.text.to_owned())));
    };
    let text = input::text(&file, "a floor", FLOOR_BYTES)?;
    Ok(Some((file, text)))
}

/// The drawing of a name, or in a file.
///
/// # Errors
/// When it cannot be read, or is a map.
pub(crate) fn drawing(name: &str) -> Result<Floor, Failure> {
    match read(name, None)? {
        Read::Drawing(it) => Ok(*it),
        Read::Map { .. } => Err(Failure::new(format!("{} is a map, without places", quoted(name)))
            .help("give `office`, `clinic` or a drawing: `cotama new floor NAME` begins one")),
    }
}

/// The floor of a name, or in a file; warnings of a map go to the screen.
fn read(name: &str, screen: Option<&Screen>) -> Result<Read, Failure> {
    if let Some(it) = embedded::named(name) {
        return Ok(Read::Drawing(Box::new(it.floor()?)));
    }
    let end = Path::new(name).extension().map(|it| it.to_string_lossy().to_lowercase());
    match end.as_deref() {
        Some("yaml" | "yml") => map(name, screen),
        Some("toml") => {
            let text = kind::text(name, "a floor", FLOOR_BYTES, &[Kind::Floor])?;
            Ok(Read::Drawing(Box::new(Floor::parse(input::name(name), &text)?)))
        }
        _ => Err(Failure::new(format!("there is no floor {}", quoted(name))).help(
            "give `office`, `clinic`, FILE.toml (`cotama new floor NAME` begins one) or FILE.yaml",
        )),
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

/// The path from place to place, or why there is none.
fn found(
    read: &Read,
    args: &FloorArgs,
    from: &str,
    to: &str,
) -> Result<Result<PathRow, String>, Failure> {
    let all = if let Read::Drawing(it) = read { &it.zones[..] } else { &[] };
    let asked = Asked {
        floor: args.floor.clone(),
        from: from.to_owned(),
        to: vec![to.to_owned()],
        open: args.open.clone(),
        close: args.close.clone(),
        zones: all.iter().map(|it| it.name.clone()).collect(),
        ..Asked::default()
    };
    let way = read.ground().way(&args.floor, "", asked, needs(args.radius));
    way.doors?;
    way.start?;
    // One goal has one leg.
    let leg = match way.legs.into_iter().next().unwrap_or(Err(NoLeg::Start)) {
        Ok(it) => it,
        Err(NoLeg::Goal(why)) => return Err(why.into()),
        Err(NoLeg::Floor(why)) => return Err(Failure::of(&args.floor, why.message)),
        Err(why) => return Ok(Err(why.refusal("--open").map_or_else(String::new, in_one_line))),
    };
    let mut zones = Vec::new();
    for (zone, spans) in way.asked.zones.iter().zip(&way.zones) {
        let row = |it: &Range<u64>| SpanRow {
            zone: zone.clone(),
            x_start_mm: it.start,
            x_end_mm: it.end,
        };
        zones.extend(spans.iter().flatten().map(row));
    }
    zones.sort_by_key(|it| (it.x_start_mm, it.x_end_mm));
    Ok(Ok(PathRow {
        from: from.to_owned(),
        to: to.to_owned(),
        radius_mm: args.radius,
        length_mm: leg.length.0,
        corners_mm: leg.points,
        zones,
    }))
}

fn in_one_line(Refusal { message, help }: Refusal) -> String {
    [Some(message), help].into_iter().flatten().collect::<Vec<_>>().join("; ")
}

/// A robot of this radius.
fn needs(radius_mm: u64) -> Needs {
    Needs { radius_m: radius_mm as f64 / 1_000.0, ..Needs::default() }
}

fn answer(read: &Read, path: Option<PathRow>, no_path: Option<String>) -> FloorAnswer {
    let mm = |it: f64| (it * 1_000.0).round() as u64;
    let (name, title, [width_mm, height_mm], drawing, map) = match read {
        Read::Drawing(it) => {
            let size = it.size.map(|it| u64::from(it.unsigned_abs()));
            (it.name.clone(), it.title.clone(), size, Some(drawn(it)), None)
        }
        Read::Map { name, grid } => {
            let bounds = grid.bounds();
            let size = [mm(bounds.width()), mm(bounds.height())];
            (name.clone(), String::new(), size, None, Some(mapped(grid)))
        }
    };
    let schema = "cotama/floor/1";
    FloorAnswer { schema, name, title, width_mm, height_mm, drawing, map, path, no_path }
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
