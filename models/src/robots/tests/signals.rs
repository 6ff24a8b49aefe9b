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
}
