//! The ways of a team over a floor: the path between each two of its places.

use crate::floor::{Floor, Version};
use crate::route::{Needs, Planner};
use crate::surface::Surface;
use crate::way::Ground;
use crate::way::places::{leg, no_path, place};
use cotama_models::missions::{Leg, NoLeg, Refusal};
use cotama_models::team::scenario::{Asked, Ways};

impl Ground<'_> {
    /// Plans a way between each pair of places that a team asks for, as those of missions are
    /// planned: each pair once, from the smaller number to the larger. What cannot be answered says
    /// why: nothing else fails.
    ///
    /// ```
    /// use cotama_floor::{Ground, Needs, embedded};
    /// use cotama_models::team::scenario::Asked;
    /// let office = embedded::OFFICE.floor().unwrap();
    /// let places = ["dock", "office B", "office D", "attic"].map(String::from).to_vec();
    /// let asked = Asked { floor: "office".into(), places, ..Asked::default() };
    /// let text = embedded::OFFICE.text;
    /// let ways = Ground::Drawing(&office).ways("office", text, asked, Needs::default());
    /// assert_eq!(ways.legs[0].as_ref().unwrap().length.0, 14_507);
    /// assert_eq!(ways.places[3].as_ref().unwrap_err().message, "unknown place `attic`");
    /// // The door of office D is closed.
    /// assert!(ways.legs[1].is_err());
    /// ```
    pub fn ways(self, source: &str, text: &str, asked: Asked, needs: Needs) -> Ways {
        let (doors, floor) = match self {
            Self::Drawing(floor) => match floor.with_doors(&asked.open, &asked.close) {
                Ok(it) => (Ok(()), Some(it)),
                Err(why) => (Err(why), Some(floor.clone())),
            },
            Self::Map(_) if asked.open.is_empty() && asked.close.is_empty() => (Ok(()), None),
            Self::Map(_) => (Err(Refusal::new("a map has no doors").help("leave them out")), None),
        };
        let floor = floor.as_ref();
        let legs = match (self, floor.map(|it| it.surface(Version::Charted, &[]))) {
            (_, Some(Ok(surface))) => legs(&surface, floor, &asked, needs),
            (Self::Map(grid), _) => legs(grid, None, &asked, needs),
            (_, Some(Err(why))) => none(&asked, &why.to_string()),
            (Self::Drawing(_), None) => Vec::new(),
        };
        // A map is held as its cells: its own text names an image, which is another file.
        let text = match self {
            Self::Drawing(_) => text.into(),
            Self::Map(grid) => grid.to_text().into(),
        };
        let mm = |it: f64| (it * 1_000.0).round() as i32;
        let at = |name: &String| place(floor, name).map(|it| [mm(it.x), mm(it.y)]);
        let places = asked.places.iter().map(at).collect();
        Ways { source: source.to_owned(), text, asked, doors, places, legs }
    }
}

/// No way between any places, for one reason.
fn none(asked: &Asked, why: &str) -> Vec<Result<Leg, NoLeg>> {
    vec![Err(NoLeg::Floor(Refusal::new(why))); asked.pairs().len()]
}

fn legs(
    surface: &dyn Surface,
    floor: Option<&Floor>,
    asked: &Asked,
    needs: Needs,
) -> Vec<Result<Leg, NoLeg>> {
    let planner = match Planner::new(surface, needs) {
        Ok(it) => it,
        Err(why) => return none(asked, &why.to_string()),
    };
    let names = &asked.places;
    let way = |(from, to): (usize, usize)| {
        let ends = names.get(from).zip(names.get(to)).ok_or(NoLeg::Start)?;
        let start = place(floor, ends.0).map_err(|_| NoLeg::Start)?;
        let goal = place(floor, ends.1).map_err(NoLeg::Goal)?;
        let path = planner.route(start, goal);
        path.map(|it| leg(&it))
            .map_err(|why| no_path(why, floor, [ends.0, ends.1], needs.radius_m, "robot"))
    };
    asked.pairs().into_iter().map(way).collect()
}
