//! All nets by name.

use cotama_models::nets::{Model, all, find};

#[test]
fn every_net_is_found_and_sound() {
    let names: Vec<&str> = all().iter().map(|entry| entry.name).collect();
    assert_eq!(
        names.join(" "),
        "door watchdog charger crossing ace_request ace_selection ace_behaviour ace_accuracy \
         philosophers token_ring kanban fms swimming_pool team team_old team_text"
    );
    for entry in all() {
        let net = match entry.model {
            Model::Defined { .. } => find(entry.name).unwrap(),
            Model::Family(family) => find(&format!("{}:{}", entry.name, family.least)).unwrap(),
        };
        assert_eq!(net.view().net().defect(), None);
        assert_eq!(net.doc, entry.description);
        assert!(entry.description.ends_with('.'));
    }
}

#[test]
fn the_largest_nets_can_still_be_built() {
    for entry in all() {
        if let Model::Family(family) = entry.model {
            let net = family.net(family.most).unwrap();
            let largest = net.places.iter().map(|place| place.initial).max();
            assert!(largest <= Some(65_535) && net.transitions.len() <= 130_000, "{}", net.name);
            assert!(family.net(family.most + 1).is_err() && family.net(family.least - 1).is_err());
        }
    }
}

#[test]
fn a_wrong_name_gets_advice() {
    let says = |name: &str| find(name).unwrap_err().to_string();
    assert_eq!(says("watchdgo"), "there is no net `watchdgo`; did you mean `watchdog`?");
    assert_eq!(
        says("lift"),
        "there is no net `lift`; there are door, watchdog, charger, crossing, ace_request, \
         ace_selection, ace_behaviour, ace_accuracy, philosophers:N, token_ring:N, kanban:N, \
         fms:N, swimming_pool:N, team:N, team_old:N, team_text:N"
    );
    assert_eq!(says("kanban"), "`kanban` is a family of nets: say which one, as `kanban:5`");
    assert_eq!(says("door:5"), "`door` is one net and takes no number: say `door`");
    assert_eq!(
        says("fms:two"),
        "`two` is no number from 0 to 4294967295: say which net of the family, as `fms:5`"
    );
    assert_eq!(
        says("fms:-1"),
        "`-1` is no number from 0 to 4294967295: say which net of the family, as `fms:5`"
    );
    assert_eq!(says("kanban:0"), "there is no kanban:0; n is from 1 to 65535");
    assert_eq!(says("token_ring:51"), "there is no token_ring:51; n is from 1 to 50");
    assert_eq!(says(&"x\n".repeat(1_000)).len(), 316);
}
