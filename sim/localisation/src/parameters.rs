//! Parameters of the filter, by the names that Nav2's AMCL gives them.

mod reader;

pub use reader::{KEYS_WITHOUT_MEANING, MAX_TEXT};

use cotama_floor::Pose;

/// The model that says how likely readings are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// `beam`: the mixture of hit, short, max and random of each beam, summed as cubes.
    Beam,
    /// `likelihood_field`: the distance from an end point to the nearest thing, summed as cubes.
    LikelihoodField,
    /// `likelihood_field_prob`: the same distances, as a product over the beams.
    LikelihoodFieldProb,
}

impl Model {
    const ALL: [(&'static str, Self); 3] = [
        ("beam", Self::Beam),
        ("likelihood_field", Self::LikelihoodField),
        ("likelihood_field_prob", Self::LikelihoodFieldProb),
    ];

    /// Returns the name that Nav2 gives it.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|it| it.1 == self).map_or("", |it| it.0)
    }
}

/// Parameters of the filter: names, meaning and defaults are those of Nav2's AMCL
/// (`nav2_amcl/src/amcl_node.cpp`, branch main of 2025).
///
/// Fields say where this filter differs.
///
/// ```
/// use cotama_localisation::{Model, Parameters};
/// let text = "amcl:\n  ros__parameters:\n    use_sim_time: True\n    max_beams: 30\n    \
///             laser_model_type: \"beam\"\n    z_hit: 0.9\n";
/// let (parameters, ignored) = Parameters::parse("nav2_params.yaml", text).unwrap();
/// assert_eq!((parameters.max_beams, parameters.z_hit), (30, 0.9));
/// assert_eq!((parameters.laser_model_type, parameters.max_particles), (Model::Beam, 2_000));
/// assert_eq!(
///     ignored[0].to_string(),
///     "nav2_params.yaml:3:5: warning: `use_sim_time` has no meaning here"
/// );
/// let wrong = Parameters::parse("nav2_params.yaml", &text.replace("z_hit", "z_hitt"));
/// let wrong = wrong.unwrap_err().to_string();
/// assert!(wrong.starts_with("nav2_params.yaml:6:5: unknown key `z_hitt`; did you mean `z_hit`"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Parameters {
    /// Noise of a rotation by rotation: variance over the square of the rotation.
    pub alpha1: f64,
    /// Noise of a rotation by translation: variance in rad² over m².
    pub alpha2: f64,
    /// Noise of a translation by translation: variance over the square of the translation.
    pub alpha3: f64,
    /// Noise of a translation by rotation: variance in m² over rad².
    pub alpha4: f64,
    /// Noise of robots that move aside; read and not used, as all robots here are differential.
    pub alpha5: f64,
    /// Rate of the share of beams that end early, in 1/m.
    pub lambda_short: f64,
    /// Distances to the nearest thing are at most this, in metres.
    pub laser_likelihood_max_dist: f64,
    /// The range in metres, if it is less than the sensor's; -1 for that of the sensor.
    pub laser_max_range: f64,
    /// Readings up to this count as none, in metres; -1 for all that the sensor says.
    pub laser_min_range: f64,
    /// The model of the beams.
    pub laser_model_type: Model,
    /// The most beams of a reading that are looked at. Nav2 takes each n-th beam, and so up to
    /// twice as many; here there are never more.
    pub max_beams: usize,
    /// The most particles.
    pub max_particles: usize,
    /// The least particles.
    pub min_particles: usize,
    /// The largest distance between the distribution and its estimate, ε of KLD-sampling.
    pub pf_err: f64,
    /// The quantile z of the standard normal distribution, by which that distance is kept; Nav2
    /// uses the number as it is, so that the default of 0.99 keeps it in 84 of 100 cases.
    pub pf_z: f64,
    /// Rate at which the short-term mean likelihood follows; 0 for no recovery.
    pub recovery_alpha_fast: f64,
    /// Rate at which the long-term mean likelihood follows; 0 for no recovery.
    pub recovery_alpha_slow: f64,
    /// Updates from one resampling to the next.
    pub resample_interval: usize,
    /// Deviation of a hit in metres.
    pub sigma_hit: f64,
    /// An update needs a turn of more than this, in radians, ..
    pub update_min_a: f64,
    /// .. or a way of more than this along the x or the y axis of the odometry, in metres.
    pub update_min_d: f64,
    /// Weight of hits. The four need not add up to 1, as those of Nav2 do not.
    pub z_hit: f64,
    /// Weight of beams that see nothing.
    pub z_max: f64,
    /// Weight of beams at random.
    pub z_rand: f64,
    /// Weight of beams that end early.
    pub z_short: f64,
    /// The pose of `initial_pose` where `set_initial_pose` is true.
    pub initial_pose: Option<Pose>,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            alpha1: 0.2,
            alpha2: 0.2,
            alpha3: 0.2,
            alpha4: 0.2,
            alpha5: 0.2,
            lambda_short: 0.1,
            laser_likelihood_max_dist: 2.0,
            laser_max_range: 100.0,
            laser_min_range: -1.0,
            laser_model_type: Model::LikelihoodField,
            max_beams: 60,
            max_particles: 2_000,
            min_particles: 500,
            pf_err: 0.05,
            pf_z: 0.99,
            recovery_alpha_fast: 0.0,
            recovery_alpha_slow: 0.0,
            resample_interval: 1,
            sigma_hit: 0.2,
            update_min_a: 0.2,
            update_min_d: 0.25,
            z_hit: 0.5,
            z_max: 0.05,
            z_rand: 0.5,
            z_short: 0.05,
            initial_pose: None,
        }
    }
}

/// Reasons why parameters make no sense.
#[derive(Clone, Debug, PartialEq)]
pub enum ParametersError {
    /// A number is out of its range.
    Range {
        /// The name of the parameter.
        key: &'static str,
        /// The number.
        found: f64,
        /// The least that is allowed.
        least: f64,
        /// The most that is allowed.
        most: f64,
    },
    /// `min_particles` is more than `max_particles`.
    Particles {
        /// The least particles.
        min: usize,
        /// The most particles.
        max: usize,
    },
    /// `z_hit` and `z_rand` are both 0, so that no reading is possible.
    Impossible,
    /// The initial pose is not finite, or further than 1,000 km away.
    InitialPose,
}

impl core::fmt::Display for ParametersError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Range { key, found, least, most } => {
                write!(f, "`{key}` is {found}; give a number from {least} to {most}")
            }
            Self::Particles { min, max } => {
                write!(f, "`min_particles` is {min}, more than `max_particles`, {max}")
            }
            Self::Impossible => f.write_str("`z_hit` and `z_rand` are 0; give one of them weight"),
            Self::InitialPose => f.write_str("`initial_pose` is beyond 1,000 km; use a nearer one"),
        }
    }
}

impl core::error::Error for ParametersError {}

/// A parameter that is a number.
struct Key {
    name: &'static str,
    range: [f64; 2],
    is_whole: bool,
    get: fn(&Parameters) -> f64,
    set: fn(&mut Parameters, f64),
}

macro_rules! keys {
    (
        numbers { $($name:ident: $least:literal, $most:literal;)* }
        counts { $($count:ident: $few:literal, $many:literal;)* }
    ) => {
        /// All parameters that are numbers, with their ranges.
        const KEYS: &[Key] = &[
            $(Key {
                name: stringify!($name),
                range: [$least, $most],
                is_whole: false,
                get: |it| it.$name,
                set: |it, value| it.$name = value,
            },)*
            $(Key {
                name: stringify!($count),
                range: [$few, $many],
                is_whole: true,
                get: |it| it.$count as f64,
                set: |it, value| it.$count = value as usize,
            },)*
        ];
    };
}

keys! {
    numbers {
        alpha1: 0.0, 100.0;
        alpha2: 0.0, 100.0;
        alpha3: 0.0, 100.0;
        alpha4: 0.0, 100.0;
        alpha5: 0.0, 100.0;
        lambda_short: 0.0, 100.0;
        laser_likelihood_max_dist: 0.01, 100.0;
        laser_max_range: -1.0, 1_000.0;
        laser_min_range: -1.0, 1_000.0;
        pf_err: 0.000_1, 1.0;
        pf_z: 0.0, 10.0;
        recovery_alpha_fast: 0.0, 1.0;
        recovery_alpha_slow: 0.0, 1.0;
        sigma_hit: 0.001, 10.0;
        update_min_a: 0.0, 7.0;
        update_min_d: 0.0, 100.0;
        z_hit: 0.0, 1.0;
        z_max: 0.0, 1.0;
        z_rand: 0.0, 1.0;
        z_short: 0.0, 1.0;
    }
    counts {
        max_beams: 2.0, 4_096.0;
        max_particles: 1.0, 200_000.0;
        min_particles: 1.0, 200_000.0;
        resample_interval: 1.0, 1_000.0;
    }
}

impl Parameters {
    /// Checks the ranges of all parameters.
    ///
    /// # Errors
    /// The first that makes no sense.
    pub fn check(&self) -> Result<(), ParametersError> {
        for key in KEYS {
            let (found, [least, most]) = ((key.get)(self), key.range);
            if !(least..=most).contains(&found) {
                return Err(ParametersError::Range { key: key.name, found, least, most });
            }
        }
        let (min, max) = (self.min_particles, self.max_particles);
        if min > max {
            return Err(ParametersError::Particles { min, max });
        }
        if self.z_hit == 0.0 && self.z_rand == 0.0 {
            return Err(ParametersError::Impossible);
        }
        let is_near = |it: &Pose| {
            it.rotation.angle().is_finite()
                && it.translation.vector.iter().all(|it| (-1e6..=1e6).contains(it))
        };
        if !self.initial_pose.as_ref().is_none_or(is_near) {
            return Err(ParametersError::InitialPose);
        }
        Ok(())
    }
}
