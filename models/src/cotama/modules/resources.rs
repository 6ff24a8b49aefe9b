//! The resources of modules: the hardware of the Pioneer 3-DX with its laptop, and the map.

use crate::cotama::members::members;

members! {
    /// A thing that can be lost under the modules.
    Resource,
    /// Things that can be lost.
    Resources(u16) {
        /// The robot's micro-controller board.
        Electronics = "electronics",
        /// The USB or serial link between the laptop and the robot.
        SerialLink = "serial link",
        /// The batteries of the robot.
        Battery = "battery",
        /// The sonar arrays, taken as one.
        SonarArrays = "sonar arrays",
        /// The wheel encoders.
        Encoders = "encoders",
        /// The drive motors with their gears and drivers.
        Motors = "motors",
        /// The bumper rings. No module needs them to run (inferred): a lost contact sensor takes
        /// protection, no function.
        Bumpers = "bumpers",
        /// The laptop's wireless card.
        WifiCard = "WiFi card",
        /// The access point.
        AccessPoint = "access point",
        /// The camera.
        Camera = "camera",
        /// The laptop's processor.
        LaptopCpu = "laptop CPU",
        /// The a-priori map of the building.
        Map = "map",
    }
}
