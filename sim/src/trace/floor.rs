//! The floor of a mission or a team, and the ways over it, in what is stored.

use cotama_core::units::Millimetres;
use cotama_models::missions::{Asked, Leg, Refusal, Way};
use cotama_models::reading::quoted;
use cotama_models::team::scenario::{self, Ways};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The floor of a mission or a team, and the ways over it: a replay plans none again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FloorText {
    /// The name of the file.
    pub source: String,
    /// The whole text of the file.
    pub text: String,
    /// The way from place to place of a mission, or between each pair of places of a team.
    pub legs: Vec<LegText>,
    /// The places of a team, in mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub places_mm: Vec<[i32; 2]>,
    /// The zones that the mission names, with the parts of the path in each, in mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub zones: Vec<(String, Vec<(u64, u64)>)>,
    /// The names of its doors.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub doors: Vec<String>,
    /// The ways of the people whom the mission names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub people: Vec<Vec<LegText>>,
}

/// The way from one place to the next.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LegText {
    /// Length.
    pub length_mm: u64,
    /// Corners, from the left lower corner of the floor.
    pub points_mm: Vec<[i32; 2]>,
}

impl FloorText {
    /// Returns the text of a way; what is wrong with it is left out.
    pub fn of(way: &Way) -> Self {
        let zones = way.asked.zones.iter().zip(&way.zones);
        let zone = |(name, spans): (&String, &Result<Vec<Range<u64>>, Refusal>)| {
            let spans = spans.as_ref().ok()?.iter().map(|it| (it.start, it.end)).collect();
            Some((name.clone(), spans))
        };
        Self {
            source: way.source.clone(),
            text: way.text.to_string(),
            legs: way.legs.iter().flatten().map(LegText::of).collect(),
            places_mm: Vec::new(),
            zones: zones.filter_map(zone).collect(),
            doors: way.doors.clone().unwrap_or_default(),
            people: { way.people.iter() }
                .map(|it| it.iter().flatten().map(LegText::of).collect())
                .collect(),
        }
    }

    /// Returns the way that a mission takes.
    pub fn way(&self, mission: &str) -> Way {
        let asked = Asked::of(mission).unwrap_or_default();
        let zone = |name: &String| {
            let it = self.zones.iter().find(|it| it.0 == *name);
            let unknown = || Refusal::new(format!("the zone {} is not stored", quoted(name)));
            it.map(|it| it.1.iter().map(|it| it.0..it.1).collect()).ok_or_else(unknown)
        };
        Way {
            source: self.source.clone(),
            text: self.text.as_str().into(),
            start: Ok(()),
            doors: Ok(self.doors.clone()),
            legs: self.legs.iter().map(|it| Ok(it.leg())).collect(),
            zones: asked.zones.iter().map(zone).collect(),
            people: { self.people.iter() }
                .map(|it| it.iter().map(|it| Ok(it.leg())).collect())
                .collect(),
            asked,
        }
    }

    /// Returns the text of the ways of a team that has read them: all are good.
    pub fn of_team(ways: &Ways) -> Self {
        Self {
            source: ways.source.clone(),
            text: ways.text.to_string(),
            legs: ways.legs.iter().flatten().map(LegText::of).collect(),
            places_mm: ways.places.iter().flatten().copied().collect(),
            zones: Vec::new(),
            people: Vec::new(),
            doors: Vec::new(),
        }
    }

    /// Returns the ways of a team, by the text of its file.
    pub fn ways(&self, team: &str) -> Ways {
        Ways {
            source: self.source.clone(),
            text: self.text.as_str().into(),
            asked: scenario::Asked::of(team).unwrap_or_default(),
            doors: Ok(()),
            places: self.places_mm.iter().map(|it| Ok(*it)).collect(),
            legs: self.legs.iter().map(|it| Ok(it.leg())).collect(),
        }
    }
}

impl LegText {
    fn of(leg: &Leg) -> Self {
        Self { length_mm: leg.length.0, points_mm: leg.points.clone() }
    }

    fn leg(&self) -> Leg {
        Leg { points: self.points_mm.clone(), length: Millimetres(self.length_mm) }
    }
}
