//! The floor of a mission, and the way over it, in what is stored.

use cotama_core::units::Millimetres;
use cotama_models::missions::{Asked, Leg, Refusal, Way};
use cotama_models::reading::quoted;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The floor of a mission, and the way over it: a replay plans no way again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FloorText {
    /// The name of the file.
    pub source: String,
    /// The whole text of the file.
    pub text: String,
    /// The way from place to place.
    pub legs: Vec<LegText>,
    /// The zones that the mission names, with the parts of the path in each, in mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub zones: Vec<(String, Vec<(u64, u64)>)>,
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
        let leg = |it: &Leg| LegText { length_mm: it.length.0, points_mm: it.points.clone() };
        let zones = way.asked.zones.iter().zip(&way.zones);
        let zone = |(name, spans): (&String, &Result<Vec<Range<u64>>, Refusal>)| {
            let spans = spans.as_ref().ok()?.iter().map(|it| (it.start, it.end)).collect();
            Some((name.clone(), spans))
        };
        Self {
            source: way.source.clone(),
            text: way.text.to_string(),
            legs: way.legs.iter().flatten().map(leg).collect(),
            zones: zones.filter_map(zone).collect(),
            people: way.people.iter().map(|it| it.iter().flatten().map(leg).collect()).collect(),
        }
    }

    /// Returns the way that a mission takes.
    pub fn way(&self, mission: &str) -> Way {
        let leg = |it: &LegText| {
            Ok(Leg { points: it.points_mm.clone(), length: Millimetres(it.length_mm) })
        };
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
            doors: Ok(()),
            legs: self.legs.iter().map(leg).collect(),
            zones: asked.zones.iter().map(zone).collect(),
            people: self.people.iter().map(|it| it.iter().map(leg).collect()).collect(),
            asked,
        }
    }
}
