//! Configurations: which modules run together for one sub-objective in one mode of autonomy.
//!
//! Durand et al., TAROS 2010, name the sets of the optimal and of the most degraded path following and the modules of the
//! robot; the other sets are inferred from what each module does.

/// A set of modules that does one sub-objective in one mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Configuration {
    /// Its id.
    pub id: &'static str,
    /// The modules without which it does not run.
    pub required: &'static [&'static str],
}

impl Configuration {
    const fn of(id: &'static str, required: &'static [&'static str]) -> Self {
        Self { id, required }
    }
}

/// Autonomous path following, best first: between these the adapter supervisor switches.
///
/// ```
/// use cotama_models::cotama::configurations::PATH_FOLLOWING;
/// let ids: Vec<_> = PATH_FOLLOWING.iter().map(|it| it.id).collect();
/// assert_eq!(ids, ["PF.OPT", "PF.OPTR", "PF.ODO", "PF.DEG"]);
/// assert_eq!(PATH_FOLLOWING[3].required, ["P3D", "NAV", "GUI"]);
/// ```
pub static PATH_FOLLOWING: [Configuration; 4] = [
    // Stated; the WiFi link, listed with it, is taken as optional.
    Configuration::of("PF.OPT", &["P3D", "SIM", "UST", "MCL", "NAV", "SMZ"]),
    // The same set with fewer particles: stated.
    Configuration::of("PF.OPTR", &["P3D", "SIM", "UST", "MCL", "NAV", "SMZ"]),
    // Odometry in place of localisation: inferred.
    Configuration::of("PF.ODO", &["P3D", "SIM", "UST", "NAV", "SMZ"]),
    // Neither avoidance nor localisation: stated.
    Configuration::of("PF.DEG", &["P3D", "NAV", "GUI"]),
];

/// The operator edits way-points or a path, the robot stands: inferred.
pub static TELEPROGRAMMING: Configuration = Configuration::of("TP", &["P3D", "NAV", "LAN"]);

/// The operator drives, without avoidance: what teleoperation needs at least. Stated in words.
pub static TELEOPERATION: Configuration = Configuration::of("TO.DEG", &["P3D", "NAV", "CAM", "LAN"]);

/// Whether no way to drive does without this module: when it is lost, stopping is all that is left.
///
/// ```
/// use cotama_models::cotama::configurations::is_vital;
/// assert!(is_vital("P3D") && is_vital("NAV"));
/// assert!(!is_vital("UST"));
/// ```
pub fn is_vital(module: &str) -> bool {
    PATH_FOLLOWING.iter().chain([&TELEOPERATION]).all(|it| it.required.contains(&module))
}
