//! The section `amcl` of a `nav2_params.yaml`.

use super::{KEYS, Key, Model, Parameters};
use cotama_floor::map_server::Warning;
use cotama_floor::yaml::{self, Expected, Node, Tree, Value, number, truth};
use cotama_floor::{Pose, Vector};
use cotama_models::missions::MissionErrors;
use cotama_models::reading::{Diagnostic, Position, Sink, quoted, unknown};

/// The longest text, in bytes.
pub const MAX_TEXT: usize = 256 << 10;

/// Parameters of Nav2's AMCL that are read and mean nothing here: topics, frames, what is stored
/// and sent, and the numbers of beam skipping, which is refused.
pub const KEYS_WITHOUT_MEANING: [&str; 18] = [
    "always_reset_initial_pose",
    "base_frame_id",
    "beam_skip_distance",
    "beam_skip_error_threshold",
    "beam_skip_threshold",
    "bond_heartbeat_period",
    "first_map_only",
    "freespace_downsampling",
    "global_frame_id",
    "introspection_mode",
    "map_topic",
    "odom_frame_id",
    "random_seed",
    "save_pose_rate",
    "scan_topic",
    "tf_broadcast",
    "transform_tolerance",
    "use_sim_time",
];

const OTHERS: [&str; 5] =
    ["do_beamskip", "initial_pose", "laser_model_type", "robot_model_type", "set_initial_pose"];

const EXPECTED: Expected = Expected {
    text: "the parameters of Nav2",
    example: "write `amcl:`, below it `  ros__parameters:`, and below that the parameters",
};

impl Parameters {
    /// Reads the section `amcl` of a `nav2_params.yaml` as it is; other sections are passed over,
    /// and what is not said keeps its default. `source_name` is its name in messages.
    ///
    /// A key that Nav2 does not know is an error, as is one with no meaning if it asks for what is
    /// not here: `do_beamskip: true`, and a model of motion that is not differential. The others of
    /// [`KEYS_WITHOUT_MEANING`] are warnings. Numbers and truth values are written as in maps.
    ///
    /// # Errors
    /// All errors of the text, with their places.
    pub fn parse(source_name: &str, text: &str) -> Result<(Self, Vec<Warning>), MissionErrors> {
        let read = |tree: &Tree, whole, sink: &Sink| read((source_name, text), tree, whole, sink);
        yaml::parse((source_name, text), MAX_TEXT, EXPECTED, read)
    }
}

type Entries<'t> = Vec<(&'t str, &'t Node, &'t Node)>;

/// Names, keys and values of a mapping; a name that is there twice is reported.
fn entries<'t>(tree: &'t Tree, node: &'t Node, sink: &Sink) -> Option<Entries<'t>> {
    let Value::Map(pairs) = &node.value else {
        let it = Diagnostic::new(node.span.clone(), "a mapping is expected here", "no keys");
        sink.report(it.help(EXPECTED.example));
        return None;
    };
    let mut all: Entries<'t> = Vec::new();
    for (key, value) in pairs {
        let (key, value) = (tree.get(*key)?, tree.get(*value)?);
        let name = if let Value::Text(name) = &key.value { name.as_str() } else { "" };
        if all.iter().any(|it| it.0 == name) {
            let message = format!("{} is there twice", quoted(name));
            let it = Diagnostic::new(key.span.clone(), message, "again");
            sink.report(it.help("keep one of them"));
        } else {
            all.push((name, key, value));
        }
    }
    Some(all)
}

/// Returns the value of a key that must be there.
fn section<'t>(all: &Entries<'t>, key: &str, sink: &Sink) -> Option<&'t Node> {
    let found = all.iter().find(|it| it.0 == key).map(|it| it.2);
    if found.is_none() {
        let at = all.first().map_or(0, |it| it.1.span.start);
        let it = Diagnostic::new(at..at, format!("missing key `{key}`"), "not here");
        sink.report(it.help(EXPECTED.example));
    }
    found
}

fn read(
    (source_name, text): (&str, &str),
    tree: &Tree,
    whole: usize,
    sink: &Sink,
) -> Option<(Parameters, Vec<Warning>)> {
    let amcl = section(&entries(tree, tree.get(whole)?, sink)?, "amcl", sink)?;
    let all = section(&entries(tree, amcl, sink)?, "ros__parameters", sink)?;
    let all = entries(tree, all, sink)?;
    let mut parameters = Parameters::default();
    let mut warnings = Vec::new();
    let (mut is_set, mut pose) = (false, Pose::identity());
    for (name, key, value) in &all {
        if let Some(key) = KEYS.iter().find(|it| it.name == *name) {
            if let Some(number) = in_range(key, value, sink) {
                (key.set)(&mut parameters, number);
            }
        } else if KEYS_WITHOUT_MEANING.contains(name) {
            warnings.push(Warning {
                source_name: source_name.into(),
                position: Position::of(text, key.span.start),
                message: format!("`{name}` has no meaning here"),
            });
        } else {
            match *name {
                "laser_model_type" => {
                    let model = model(value, sink);
                    parameters.laser_model_type = model.unwrap_or(parameters.laser_model_type);
                }
                "robot_model_type" => motion(value, sink),
                "do_beamskip" if truth_of(name, value, sink) == Some(true) => {
                    value.wrong(name, "false", "beams are not skipped here", sink);
                }
                "do_beamskip" => {}
                "set_initial_pose" => is_set = truth_of(name, value, sink).unwrap_or(false),
                "initial_pose" => pose = initial_pose(tree, value, sink).unwrap_or(pose),
                _ => stray(name, key, sink),
            }
        }
    }
    parameters.initial_pose = is_set.then_some(pose);
    if sink.is_empty()
        && let Err(error) = parameters.check()
    {
        let key = all.iter().find(|it| error.to_string().contains(&format!("`{}`", it.0)));
        let at = key.map_or(0..0, |it| it.2.span.clone());
        let it = Diagnostic::new(at, error.to_string(), "against another one");
        sink.report(it.help("change one of them"));
    }
    Some((parameters, warnings))
}

fn stray(name: &str, key: &Node, sink: &Sink) {
    let known = KEYS.iter().map(|it| it.name).chain(OTHERS).chain(KEYS_WITHOUT_MEANING);
    let (message, help) = unknown("key", name, known);
    sink.report(Diagnostic::new(key.span.clone(), message, "not known").help(help));
}

fn in_range(key: &Key, node: &Node, sink: &Sink) -> Option<f64> {
    let [least, most] = key.range;
    let found = if let Value::Text(text) = &node.value { number(text) } else { None };
    let fits = |it: &f64| (least..=most).contains(it) && (!key.is_whole || it.fract() == 0.0);
    let found = found.filter(fits);
    if found.is_none() {
        let kind = if key.is_whole { "a whole number" } else { "a number" };
        let help = "Nav2's default is a good begin: leave the line out";
        node.wrong(key.name, &format!("{kind} from {least} to {most}"), help, sink);
    }
    found
}

fn truth_of(key: &str, node: &Node, sink: &Sink) -> Option<bool> {
    let found = if let Value::Text(text) = &node.value { truth(text) } else { None };
    if found.is_none() {
        node.wrong(key, "true or false", "write `true` or `false`", sink);
    }
    found
}

fn model(node: &Node, sink: &Sink) -> Option<Model> {
    let names = Model::ALL.map(|it| it.0);
    let Value::Text(text) = &node.value else {
        node.wrong("laser_model_type", "a word", "write `likelihood_field`", sink);
        return None;
    };
    let found = Model::ALL.iter().find(|it| it.0 == text).map(|it| it.1);
    if found.is_none() {
        let (message, help) = unknown("model", text, names.into_iter());
        sink.report(Diagnostic::new(node.span.clone(), message, "not known").help(help));
    }
    found
}

fn motion(node: &Node, sink: &Sink) {
    let is_known = matches!(&node.value, Value::Text(text)
        if text == "differential" || text == "nav2_amcl::DifferentialMotionModel");
    if !is_known {
        let help = "all robots here have two driven wheels";
        node.wrong("robot_model_type", "nav2_amcl::DifferentialMotionModel", help, sink);
    }
}

/// Reads `x`, `y` and `yaw`; `z` is read and means nothing.
fn initial_pose(tree: &Tree, node: &Node, sink: &Sink) -> Option<Pose> {
    const NAMES: [&str; 4] = ["x", "y", "z", "yaw"];
    let mut at = [0.0; 4];
    for (name, key, value) in entries(tree, node, sink)? {
        let Some((found, place)) = at.iter_mut().zip(NAMES).find(|it| it.1 == name) else {
            let (message, help) = unknown("key", name, NAMES.into_iter());
            sink.report(Diagnostic::new(key.span.clone(), message, "not known").help(help));
            continue;
        };
        let read = if let Value::Text(text) = &value.value { number(text) } else { None };
        match read.filter(|it| (-1e6..=1e6).contains(it)) {
            Some(it) => *found = it,
            None => value.wrong(place, "-1000000 to 1000000", "give metres and radians", sink),
        }
    }
    let [x, y, _, yaw] = at;
    Some(Pose::new(Vector::new(x, y), yaw))
}
