//! Words about signals that make no sense are refused.

use super::broken::refused;

#[test]
fn roles_watches_and_harms_are_known_words_and_fit_what_they_stand_beside() {
    let role = "[module.scan]\nhardware = [\"lidar\"]\n";
    assert_eq!(
        refused(role, &format!("{role}roles = [\"localization\"]\n")),
        "r.toml:10:10: unknown role `localization`; did you mean `localisation`? | help: write \
         `localisation`"
    );
    let flags = "flags = [\"late\", \"silent\", \"stuck\"]\n";
    assert_eq!(
        refused(flags, &format!("{flags}watches = [\"no ranges\", \"told\"]\n")),
        "r.toml:16:11: 3 flags have 2 signals | help: write \"told\" for a flag that no \
         signal raises"
    );
    let row = "id = \"LID1\"\n";
    let harm = |it: &str| refused(row, &format!("{row}harm = {{ {it} }}\n"));
    assert_eq!(
        harm("is = \"motor wek\""),
        "r.toml:36:15: unknown harm `motor wek`; did you mean `motor weak`? | help: write \
         `motor weak`"
    );
    assert_eq!(
        harm("is = \"motor weak\", unit = 2"),
        "r.toml:36:36: there are two sides | help: write 0 for the left one, or 1 for the right one"
    );
    assert_eq!(
        harm("is = \"sonar far\", unit = 16"),
        "r.toml:36:35: `unit` must be 0 to 15, not `16` | help: change the value"
    );
    let devices = "help: `[body]` has the devices: `[[body.laser]]`, from 0 on, `[body.camera]`, \
                   `[body.gyro]`, `sonars`";
    assert_eq!(
        harm("is = \"gyro dead\""),
        format!("r.toml:36:15: the robot has no such device | {devices}")
    );
    assert_eq!(
        refused(flags, &format!("{flags}watches = [\"laser silent\", \"told\", \"told\"]\n")),
        format!("r.toml:16:12: no laser of the robot gives this signal | {devices}")
    );
}

#[test]
fn devices_of_a_body_are_read_with_the_hardware_that_they_are() {
    let robot = crate::robots::Robot::shipped("transport").unwrap();
    let sensing = &robot.body.as_ref().unwrap().sensing;
    let hardware = |it: usize| robot.hardware[it].name.as_str();
    let lasers: Vec<_> = sensing.lasers.iter().map(|it| hardware(it.hardware)).collect();
    assert_eq!(lasers, ["lidar", "safety_scanner", "safety_scanner"]);
    assert_eq!(hardware(sensing.camera.unwrap().hardware), "camera");
    assert_eq!(hardware(sensing.gyro.unwrap().hardware), "imu");
    let text = crate::robots::embedded("transport").unwrap().text;
    let far = text.replacen("least_mm = 50", "least_mm = 10_000", 1);
    let far = far.replacen("range_mm = 20_000", "range_mm = 9_000", 1);
    let other = text.replacen("hardware = \"lidar\"", "hardware = \"lidr\"", 1);
    let refusal = |text: &str| crate::robots::Robot::parse("t", text).unwrap_err().to_string();
    let far = refusal(&far);
    assert!(far.contains("the least range is not below the range"), "{far}");
    let other = refusal(&other);
    assert!(other.contains("unknown hardware `lidr`; did you mean `lidar`?"), "{other}");
}
