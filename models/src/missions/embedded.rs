//! The missions that come with the program.

/// A mission file that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Embedded {
    /// Name of the mission.
    pub name: &'static str,
    /// Description in one line.
    pub description: &'static str,
    /// The text of the file.
    pub text: &'static str,
}

const MISSIONS: [Embedded; 4] = [
    Embedded {
        name: "patrol",
        description: "Patrol of Lambert et al. 2024: 187 m through two halls, two valves to \
                      inspect, 600 s and 2.4 Wh",
        text: include_str!("../../missions/patrol.toml"),
    },
    Embedded {
        name: "delivery",
        description: "Delivery of Durand et al. 2010: to office A, receive an object, to office B, \
                      deliver it; supervised by COTAMA",
        text: include_str!("../../missions/delivery.toml"),
    },
    Embedded {
        name: "shift",
        description: "Shift of the transport robot, under the supervisors that its file makes",
        text: include_str!("../../missions/shift.toml"),
    },
    Embedded {
        name: "ward",
        description: "The same shift over the floor of a clinic, by lasers and marks",
        text: include_str!("../../missions/ward.toml"),
    },
];

/// All missions that come with the program.
///
/// ```
/// use cotama_models::missions::embedded;
/// let names: Vec<_> = embedded::embedded().iter().map(|it| it.name).collect();
/// assert_eq!(names, ["patrol", "delivery", "shift", "ward"]);
/// ```
pub fn embedded() -> &'static [Embedded] {
    &MISSIONS
}

/// The mission of this name.
///
/// ```
/// use cotama_models::missions::embedded;
/// assert!(embedded::mission("delivery").unwrap().text.contains("robot = \"p3dx-delivery\""));
/// assert_eq!(embedded::mission("nope"), None);
/// ```
pub fn mission(name: &str) -> Option<Embedded> {
    embedded().iter().copied().find(|mission| mission.name == name)
}
