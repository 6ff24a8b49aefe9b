//! Texts of Nav2, and texts that are wrong.
#![allow(clippy::unwrap_used)]

use cotama_floor::{Pose, Vector};
use cotama_fuzz::{Random, mutant};
use cotama_localisation::{KEYS_WITHOUT_MEANING, MAX_TEXT, Parameters};

/// The section as Nav2 ships it, with neighbours.
const TEXT: &str = r#"
bt_navigator:
  ros__parameters:
    plugin_lib_names:
    - nav2_compute_path_to_pose_action_bt_node
amcl:
  ros__parameters:
    use_sim_time: True
    alpha1: 0.2
    alpha2: 0.2
    alpha3: 0.2
    alpha4: 0.2
    alpha5: 0.2
    base_frame_id: "base_footprint"
    beam_skip_distance: 0.5
    beam_skip_error_threshold: 0.9
    beam_skip_threshold: 0.3
    do_beamskip: false
    global_frame_id: "map"
    lambda_short: 0.1
    laser_likelihood_max_dist: 2.0
    laser_max_range: 100.0
    laser_min_range: -1.0
    laser_model_type: "likelihood_field"
    max_beams: 60
    max_particles: 2000
    min_particles: 500
    odom_frame_id: "odom"
    pf_err: 0.05
    pf_z: 0.99
    recovery_alpha_fast: 0.0
    recovery_alpha_slow: 0.0
    resample_interval: 1
    robot_model_type: "nav2_amcl::DifferentialMotionModel"
    save_pose_rate: 0.5
    sigma_hit: 0.2
    tf_broadcast: true
    transform_tolerance: 1.0
    update_min_a: 0.2
    update_min_d: 0.25
    z_hit: 0.5
    z_max: 0.05
    z_rand: 0.5
    z_short: 0.05
    scan_topic: scan
controller_server:
  ros__parameters:
    controller_frequency: 20.0
"#;

fn said(text: &str) -> String {
    Parameters::parse("nav2.yaml", text).unwrap_err().to_string()
}

#[test]
fn the_section_of_nav2_is_read_as_it_is() {
    let (parameters, ignored) = Parameters::parse("nav2.yaml", TEXT).unwrap();
    assert_eq!(parameters, Parameters::default());
    assert_eq!(ignored.len(), 11);
    assert!(
        ignored.iter().all(|it| KEYS_WITHOUT_MEANING.iter().any(|key| it.message.contains(key)))
    );
}

#[test]
fn the_initial_pose_counts_where_it_is_to_be_set() {
    let pose = "    initial_pose: {x: -2.0, y: -0.5, z: 0.0, yaw: 1.0}\n";
    let at = |more: &str| {
        let text = TEXT.replace("    scan_topic: scan\n", &format!("{pose}{more}"));
        Parameters::parse("nav2.yaml", &text).unwrap().0.initial_pose
    };
    assert_eq!(at(""), None);
    assert_eq!(at("    set_initial_pose: false\n"), None);
    let expected = Pose::new(Vector::new(-2.0, -0.5), 1.0);
    assert_eq!(at("    set_initial_pose: true\n"), Some(expected));
}

#[test]
fn a_mistake_is_told_at_its_place_with_its_remedy() {
    for (from, to, expected) in [
        (
            "z_hit: 0.5",
            "z_hit: 1.5",
            "nav2.yaml:41:12: `z_hit` must be a number from 0 to 1, not `1.5`",
        ),
        (
            "max_beams: 60",
            "max_beams: 60.5",
            "nav2.yaml:25:16: `max_beams` must be a whole number from 2 to 4096, not `60.5`",
        ),
        (
            "alpha1: 0.2",
            "alpha1: [1]",
            "nav2.yaml:9:13: `alpha1` must be a number from 0 to 100, not a list of 1",
        ),
        ("alpha1:", "alpha_1:", "nav2.yaml:9:5: unknown key `alpha_1`; did you mean `alpha1`?"),
        (
            "\"likelihood_field\"",
            "likelyhood_field",
            "nav2.yaml:24:23: unknown model `likelyhood_field`; did you mean `likelihood_field`?",
        ),
        (
            "do_beamskip: false",
            "do_beamskip: true",
            "nav2.yaml:18:18: `do_beamskip` must be false, not `true`",
        ),
        (
            "DifferentialMotionModel",
            "OmniMotionModel",
            "nav2.yaml:34:23: `robot_model_type` must be nav2_amcl::DifferentialMotionModel, not",
        ),
        (
            "min_particles: 500",
            "min_particles: 5000",
            "nav2.yaml:26:20: `min_particles` is 5000, more than `max_particles`, 2000",
        ),
        ("alpha2: 0.2", "alpha1: 0.2", "nav2.yaml:10:5: `alpha1` is there twice"),
        ("amcl:\n", "acml:\n", "nav2.yaml:2:1: missing key `amcl`"),
        (
            "amcl:\n  ros__parameters",
            "amcl:\n  parameters",
            "nav2.yaml:7:3: missing key `ros__parameters`",
        ),
        ("alpha1: 0.2", "alpha1: \"0.2", "nav2.yaml:9:13: not YAML: "),
    ] {
        let found = said(&TEXT.replacen(from, to, 1));
        assert!(found.starts_with(expected), "{found}\n{expected}");
        assert!(found.contains("help: "), "{found}");
    }
    assert!(said("").contains("the text is empty"), "{}", said(""));
    assert!(said(&" ".repeat(MAX_TEXT + 1)).contains("more than 262144 bytes"));
}

#[test]
fn mutants_of_the_text_are_read_or_refused_but_nothing_else() {
    let words = ["amcl:", "ros__parameters:", "1e9", "-1", "&a ", "*a", "[", "{", "initial_pose:"];
    let (mut random, texts) = (Random(1), [TEXT.as_bytes().to_vec()]);
    let mut read = [0, 0];
    for _ in 0..3_000 {
        let text = mutant(&mut random, &texts, &words);
        match Parameters::parse("nav2.yaml", &String::from_utf8_lossy(&text)) {
            Ok((it, _)) => {
                it.check().unwrap();
                read[0] += 1;
            }
            Err(it) => {
                assert!(it.to_string().starts_with("nav2.yaml:"), "{it}");
                read[1] += 1;
            }
        }
    }
    assert!(read.iter().all(|it| *it > 300), "{read:?}");
}
