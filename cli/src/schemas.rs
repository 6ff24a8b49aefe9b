//! The schemas of answers in JSON. They are made of the types, and kept in `schemas/cotama.json`,
//! so that the program does not make them; a test of this file compares both.

use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// The schemas of all answers by command, and the definitions that they share.
const ALL: &str = include_str!("../schemas/cotama.json");

/// The schema of the answer of one command, with the definitions that it names.
#[derive(Debug, Serialize)]
pub(crate) struct AnswerSchema {
    #[serde(rename = "$schema")]
    draft: Value,
    #[serde(flatten)]
    own: Map<String, Value>,
    #[serde(rename = "$defs", skip_serializing_if = "BTreeMap::is_empty")]
    definitions: BTreeMap<String, Value>,
}

impl AnswerSchema {
    /// The schema of this command; none if it has no answer.
    pub(crate) fn of(command: &str) -> Option<Self> {
        let mut all: Value = serde_json::from_str(ALL).ok()?;
        let Value::Object(own) = all.get_mut("answers")?.get_mut(command)?.take() else {
            return None;
        };
        let mut definitions = BTreeMap::new();
        own.values().for_each(|it| add_named(it, &all, &mut definitions));
        Some(Self { draft: all.get("$schema")?.clone(), own, definitions })
    }
}

/// Adds the definitions that a part of a schema names, and those that they name.
fn add_named(part: &Value, all: &Value, named: &mut BTreeMap<String, Value>) {
    match part {
        Value::Array(parts) => parts.iter().for_each(|it| add_named(it, all, named)),
        Value::Object(parts) => parts.values().for_each(|it| add_named(it, all, named)),
        Value::String(text) => {
            let Some(name) = text.strip_prefix("#/$defs/") else { return };
            let Some(definition) = all.pointer(text.trim_start_matches('#')) else { return };
            if named.insert(name.to_owned(), definition.clone()).is_none() {
                add_named(definition, all, named);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use crate::answers::assign::AssignAnswer;
    use crate::answers::axes::AxesAnswer;
    use crate::answers::axes_run::AxesRunAnswer;
    use crate::answers::campaign::CampaignAnswer;
    use crate::answers::check::tree::{
        TreeAnswer, TreeConformAnswer, TreeSimulateAnswer, TreeSpaceAnswer,
    };
    use crate::answers::check::{CheckAnswer, StatespaceAnswer, VerifyAnswer};
    use crate::answers::conform::ConformAnswer;
    use crate::answers::curves::CurvesAnswer;
    use crate::answers::error::ErrorAnswer;
    use crate::answers::estimate::EstimateAnswer;
    use crate::answers::explain::ExplainAnswer;
    use crate::answers::explain::bids::BidsAnswer;
    use crate::answers::floor::FloorAnswer;
    use crate::answers::fmeca::{FmecaAnswer, MeasureAnswer};
    use crate::answers::model::{ModelsAnswer, PlayAnswer, SimulateAnswer};
    use crate::answers::new::NewAnswer;
    use crate::answers::risk::{
        CalibrateAnswer, ChooseAnswer, CoherenceAnswer, DiscretiseAnswer, InferAnswer, LearnAnswer,
        SeparatedAnswer,
    };
    use crate::answers::team::TeamAnswer;
    use crate::answers::ways::WaysAnswer;
    use crate::answers::{AllocateAnswer, ListAnswer, PlanAnswer, ReplayAnswer, RunAnswer};
    use cotama_verification::conform::LINE_SCHEMA;
    use schemars::generate::SchemaSettings;
    use schemars::transform::RecursiveTransform;
    use schemars::{JsonSchema, Schema};
    use serde_json::{Map, Value, json};
    use std::path::Path;

    const DRAFT: &str = "https://json-schema.org/draft/2020-12/schema";

    /// The schema is of written answers, not of readable ones: a field that is always written is
    /// required.
    fn of<T: JsonSchema>() -> Value {
        let settings = SchemaSettings::draft2020_12().for_serialize();
        let schemas = settings.with_transform(RecursiveTransform(in_one_line)).into_generator();
        schemas.into_root_schema_for::<T>().into()
    }

    /// A description does not show where the comment that it is made of goes on in another line.
    fn in_one_line(schema: &mut Schema) {
        if let Some(Value::String(text)) = schema.get_mut("description") {
            *text = text.replace('\n', " ");
        }
    }

    #[test]
    fn the_stored_schemas_are_those_of_the_types() {
        let schemas = [
            ("list", of::<ListAnswer>()),
            ("plan", of::<PlanAnswer>()),
            ("plan-axes", of::<AxesAnswer>()),
            ("explain", of::<ExplainAnswer>()),
            ("explain-team", of::<BidsAnswer>()),
            ("run", of::<RunAnswer>()),
            ("run-axes", of::<AxesRunAnswer>()),
            ("run-team", of::<TeamAnswer>()),
            ("run-two-ways", of::<WaysAnswer>()),
            ("allocate", of::<AllocateAnswer>()),
            ("assign", of::<AssignAnswer>()),
            ("assign-curves", of::<CurvesAnswer>()),
            ("replay", of::<ReplayAnswer>()),
            ("models", of::<ModelsAnswer>()),
            ("simulate", of::<SimulateAnswer>()),
            ("play", of::<PlayAnswer>()),
            ("simulate-tree", of::<TreeSimulateAnswer>()),
            ("check", of::<CheckAnswer>()),
            ("check-tree", of::<TreeAnswer>()),
            ("statespace", of::<StatespaceAnswer>()),
            ("statespace-tree", of::<TreeSpaceAnswer>()),
            ("estimate", of::<EstimateAnswer>()),
            ("verify", of::<VerifyAnswer>()),
            ("conform", of::<ConformAnswer>()),
            ("conform-tree", of::<TreeConformAnswer>()),
            ("recording", serde_json::from_str(LINE_SCHEMA).unwrap()),
            ("floor", of::<FloorAnswer>()),
            ("fmeca", of::<FmecaAnswer>()),
            ("measure", of::<MeasureAnswer>()),
            ("campaign", of::<CampaignAnswer>()),
            ("risk-learn", of::<LearnAnswer>()),
            ("risk-infer", of::<InferAnswer>()),
            ("risk-coherence", of::<CoherenceAnswer>()),
            ("risk-discretise", of::<DiscretiseAnswer>()),
            ("risk-separated", of::<SeparatedAnswer>()),
            ("risk-choose", of::<ChooseAnswer>()),
            ("risk-calibrate", of::<CalibrateAnswer>()),
            ("new", of::<NewAnswer>()),
            ("error", of::<ErrorAnswer>()),
        ];
        let (mut all, mut shared) = (Map::new(), Map::new());
        for (command, mut schema) in schemas {
            let own = schema.as_object_mut().unwrap();
            assert_eq!(own.remove("$schema").unwrap(), DRAFT, "{command}");
            for (name, definition) in
                own.remove("$defs").iter().flat_map(|it| it.as_object().unwrap())
            {
                let other = shared.insert(name.clone(), definition.clone());
                assert!(other.is_none_or(|it| it == *definition), "two types are called {name}");
            }
            all.insert(command.into(), schema);
        }
        let about = "Answers of `cotama COMMAND --json`; `cotama schema COMMAND` prints one alone.";
        let all =
            json!({ "$schema": DRAFT, "description": about, "answers": all, "$defs": shared });
        let stored = Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas/cotama.json");
        cotama_golden::compare(stored, &cotama_golden::json_lines(&all));
    }
}
