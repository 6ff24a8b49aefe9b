//! Nets of other tools with inhibitor arcs, reset arcs, priorities and random delays: checked,
//! written, or refused with the reason by who cannot play them.

use crate::common::Folder;

/// A crane that lifts while nobody is below, and a clean-up that empties the yard.
const CRANE: &str = "<pnml><net id='crane' type='P/T net'>
<place id='down'><initialMarking><value>Default,1</value></initialMarking></place>
<place id='up'/><place id='yard'><initialMarking><value></value></initialMarking></place>
<transition id='lift'/><transition id='lower'/><transition id='enter'/><transition id='clear'/>
<arc id='x' source='down' target='lift'/><arc id='x' source='lift' target='up'/>
<arc id='x' source='up' target='lower'/><arc id='x' source='lower' target='down'/>
<arc id='x' source='yard' target='lift'><arctype><text>inhibitor</text></arctype></arc>
<arc id='x' source='enter' target='yard'/>
<arc id='x' source='yard' target='enter' type='inhibitor'><inscription><text>4</text></inscription>
</arc>
<arc id='x' source='down' target='enter' type='read'/>
<arc id='x' source='yard' target='clear'><type value='reset'/></arc>
<arc id='x' source='yard' target='clear'><type value='test'/></arc>
</net></pnml>";

/// Two ways out of `low`.
fn battery(timed: bool, dock: u32) -> String {
    let transition = |id: &str, priority: u32| {
        format!(
            "<transition id='{id}'><timed><value>{timed}</value></timed>\
             <priority><value>{priority}</value></priority></transition>"
        )
    };
    format!(
        "<pnml><net id='battery' type='P/T net'>
         <place id='low'><initialMarking><value>Default,1</value></initialMarking></place>
         <place id='full'/><place id='flat'/>
         {}{}<arc source='low' target='dock'/><arc source='dock' target='full'/>
         <arc source='low' target='go'/><arc source='go' target='flat'/></net></pnml>",
        transition("dock", dock),
        transition("go", 1)
    )
}

fn code(folder: &Folder, args: &[&str]) -> i32 {
    folder.cotama(args).code.unwrap()
}

#[test]
fn a_net_with_inhibitor_and_reset_arcs_is_checked_with_a_certificate() {
    let folder = Folder::new("special_check");
    folder.write("crane.pnml", CRANE);
    for (asked, exit) in [
        ("AG !(up & yard >= 1)", 0),
        ("EF up", 0),
        ("EF yard = 4", 0),
        ("AG yard <= 4", 0),
        ("AG yard <= 3", 1),
        ("AG EF up", 0),
        ("deadlock_free", 0),
    ] {
        let it = ["check", "crane.pnml", "--property", asked, "--certificate", "it.json"];
        assert_eq!(code(&folder, &it), exit, "{asked}");
        let model = ["verify", "it.json", "--model", "crane.pnml", "--property", asked];
        assert_eq!(code(&folder, &model), 0, "{asked}");
    }
}

#[test]
fn an_exported_net_means_the_same() {
    let folder = Folder::new("special_export");
    folder.write("crane.pnml", CRANE);
    let export = ["export", "crane.pnml", "--format", "pnml", "--output", "again.pnml"];
    assert_eq!(code(&folder, &export), 0);
    let size = |file: &str| {
        let said = folder.cotama(&["statespace", file, "--json"]).stdout;
        let said: serde_json::Value = serde_json::from_str(&said).unwrap();
        ["states", "arcs", "deadlocks", "max_place"].map(|it| said[it].clone())
    };
    assert_eq!(size("crane.pnml"), size("again.pnml"));
    assert_eq!(size("again.pnml")[0], "6");
}

#[test]
fn a_command_that_cannot_play_or_write_such_a_net_says_so() {
    let folder = Folder::new("special_refused");
    folder.write("crane.pnml", CRANE);
    folder.write("run.jsonl", "{\"t_ms\":1,\"fired\":\"lift\"}\n");
    let commands: [&[&str]; 8] = [
        &["simulate", "crane.pnml", "lift"],
        &["conform", "crane.pnml", "run.jsonl"],
        &["estimate", "crane.pnml", "--property", "EF up"],
        &["models", "crane.pnml"],
        &["export", "crane.pnml", "--format", "dot"],
        &["export", "crane.pnml", "--format", "json"],
        &["export", "crane.pnml", "--format", "jani"],
        &["export", "crane.pnml", "--format", "net"],
    ];
    for command in commands {
        let refused = folder.cotama(command);
        assert_eq!(refused.code, Some(2), "{command:?}");
        assert!(refused.stderr.contains("inhibitor arcs"), "{command:?}: {}", refused.stderr);
    }
}

#[test]
fn priorities_are_kept_and_said() {
    let folder = Folder::new("special_priorities");
    for (dock, exit, states) in [(2, 0, "2"), (1, 1, "3"), (0, 1, "2")] {
        folder.write("battery.xml", battery(false, dock));
        let asked = ["check", "battery.xml", "--property", "AG !flat"];
        assert_eq!(code(&folder, &asked), exit, "priority {dock}");
        let said = folder.cotama(&["statespace", "battery.xml", "--json"]).stdout;
        let said: serde_json::Value = serde_json::from_str(&said).unwrap();
        assert_eq!(said["states"], states, "priority {dock}");
        let note = "its priorities are kept; without them there are 3 states and 2 arcs";
        let notes: &[&str] = if dock == 1 { &[] } else { &[note] };
        assert_eq!(said["notes"], serde_json::json!(notes), "priority {dock}");
    }
}

/// The page of a robot that drives while no human is there, or so it is meant.
fn gate(more: &str) -> String {
    format!(
        "<pnml xmlns='http://www.pnml.org/version-2009/grammar/pnml'>
         <net id='gate' type='http://www.pnml.org/version-2009/grammar/ptnet'><page id='g'>
         <place id='idle'><initialMarking><text>1</text></initialMarking></place>
         <place id='moving'/><place id='human'/>
         <transition id='drive'/><transition id='enter'/>
         <arc id='a1' source='idle' target='drive'/><arc id='a2' source='drive' target='moving'/>
         <arc id='a3' source='enter' target='human'/>
         <arc id='a4' source='human' target='enter' type='inhibitor'/>
         {more}</page></net></pnml>"
    )
}

#[test]
fn each_spelling_of_an_arc_has_its_verdict_and_a_certificate_of_it() {
    let folder = Folder::new("special_spelled");
    let arc = |more: &str, inside: &str| {
        format!("<arc id='a9' source='human' target='drive'{more}>{inside}</arc>")
    };
    // Nobody is there at the start: an ordinary arc and a read arc hinder the robot, an inhibitor
    // arc lets it drive only then, and a reset arc sends the human away.
    let (first, alone, left) = ("E[human <= 0 U moving]", "EF (moving & human)", "AG !(human > 1)");
    for (spelled, drives_at_once, drives_behind) in [
        (arc("", ""), false, true),
        (arc("", "<arctype><text>normal</text></arctype>"), false, true),
        (arc("", "<arctype><text>inhibitor</text></arctype>"), true, false),
        (arc("", "<arctype>inhibitor</arctype>"), true, false),
        (arc("", "<type>inhibitor</type>"), true, false),
        (arc("", "<type id='inhibitor'/>"), true, false),
        (arc("", "<inhibitor><value>1</value></inhibitor>"), true, false),
        (arc("", "<k:kind xmlns:k='urn:k'>inhibitor</k:kind>"), true, false),
        (
            arc(
                "",
                "<toolspecific tool='x' version='1'><arcType>inhibitor</arcType></toolspecific>",
            ),
            true,
            false,
        ),
        (arc(" arctype='inhibitor'", ""), true, false),
        (arc(" inhibitor='true'", ""), true, false),
        ("<inhibitorArc id='a9' source='human' target='drive'/>".to_owned(), true, false),
        (arc("", "<arctype>reset</arctype>"), true, true),
        (arc(" type='reset'", ""), true, true),
        ("<resetArc id='a9' source='human' target='drive'/>".to_owned(), true, true),
        (arc("", "<arctype>read</arctype>"), false, true),
        (arc("", "<type value='test'/>"), false, true),
        (arc(" read='true'", ""), false, true),
    ] {
        folder.write("gate.pnml", gate(&spelled));
        // Behind the human: who stands there when the robot starts.
        let behind = "E[moving <= 0 U (human & EX moving)]";
        for (asked, holds) in
            [(first, drives_at_once), (behind, drives_behind), (alone, true), (left, true)]
        {
            let line = ["check", "gate.pnml", "--property", asked, "--certificate", "it.json"];
            assert_eq!(code(&folder, &line), i32::from(!holds), "{asked}: {spelled}");
            let line = ["verify", "it.json", "--model", "gate.pnml", "--property", asked];
            assert_eq!(code(&folder, &line), 0, "{asked}: {spelled}");
        }
    }
}

#[test]
fn an_unknown_part_of_a_net_is_refused_by_every_command() {
    let folder = Folder::new("special_unknown");
    for (part, said) in [
        ("<arc source='human' target='drive'><type value='flush'/></arc>", "the kind `flush`"),
        ("<arc source='human' target='drive' weight='2'/>", "an attribute `weight`"),
        ("<arc source='human' target='drive'><negated/></arc>", "`<negated>` of an arc"),
        ("<arc source='human' target='drive' inhibitor=''/>", "`` is neither `true` nor `false`"),
        ("<arc source='human' target='drive' read='?'/>", "`?` is neither `true` nor `false`"),
        ("<transition id='t' guard='x &gt; 0'/>", "a transition with the guard `x > 0`"),
        ("<transition id='t'><cost>1</cost></transition>", "`<cost>` of a transition"),
        ("<place id='p'><invariant><text>3</text></invariant></place>", "`<invariant>` of a place"),
        ("<transportArc source='human' target='drive'/>", "TAPAAL's own format"),
    ] {
        folder.write("gate.pnml", gate(part));
        for line in [
            &["check", "gate.pnml", "--property", "EF moving"][..],
            &["statespace", "gate.pnml"],
            &["simulate", "gate.pnml", "drive"],
            &["export", "gate.pnml", "--format", "pnml"],
        ] {
            let ended = folder.cotama(line);
            assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{part}: {ended:?}");
            assert!(ended.stderr.contains(said), "{part}: {}", ended.stderr);
        }
    }
}

#[test]
fn a_delay_in_the_part_of_a_tool_is_noted_once() {
    let folder = Folder::new("special_delays");
    let note = "delays in the parts of tools are left out: enabled transitions fire in any order";
    let interval = "<interval closure='closed'><cn>2</cn><cn>3</cn></interval>";
    for (tool, inside, noted) in [
        ("tina", interval.to_owned(), true),
        ("Tina", format!("<delay>{interval}</delay>"), true),
        ("Romeo", format!("<a><b>{interval}</b></a>"), true),
        ("nupn", "<delay>5</delay>".to_owned(), true),
        ("ProM", "<Interval/>".repeat(3), true),
        ("WoPeD", "<time>0</time><timeUnit>1</timeUnit>".to_owned(), false),
        ("tina", "<label>delay</label>".to_owned(), false),
    ] {
        let part = format!("<toolspecific tool='{tool}' version='1'>{inside}</toolspecific>");
        folder.write("gate.pnml", gate(&format!("<transition id='t'>{part}</transition>")));
        let line = ["check", "gate.pnml", "--property", "EF moving", "--json"];
        let notes = folder.cotama(&line).json(0)["notes"].clone();
        let expected: &[&str] = if noted { &[note] } else { &[] };
        assert_eq!(notes, serde_json::json!(expected), "{part}");
    }
}

#[test]
fn ids_that_nothing_refers_to_and_empty_markings_change_no_state() {
    let folder = Folder::new("special_ids");
    let spaces = |file: &str, text: String| {
        folder.write(file, text);
        let said = folder.cotama(&["statespace", file, "--json"]).json(0);
        ["states", "arcs", "deadlocks"].map(|it| said[it].as_str().unwrap().to_owned())
    };
    let marked =
        |empty: &str| format!("<place id='p'><initialMarking>{empty}</initialMarking></place>");
    let plain = ["4", "4", "1"];
    for (part, expected) in [
        (String::new(), plain),
        // Equal ids of arcs, that of a place, that of a transition, and pages of any.
        ("<arc id='a1' source='idle' target='enter'/>".to_owned(), ["3", "2", "2"]),
        ("<arc id='human' source='human' target='drive'/>".to_owned(), ["4", "3", "1"]),
        ("<arc id='drive' source='human' target='drive' type='reset'/>".to_owned(), plain),
        ("<page id='drive'/><page id='a1'/>".to_owned(), plain),
        ("<page id='a1'><page id='a1'/></page>".to_owned(), plain),
        ("<page id='later'/><transition id='later'/>".to_owned(), ["4", "8", "0"]),
        (marked("<value></value>"), plain),
        (marked("<value/>"), plain),
        (marked("<text></text>"), plain),
        (marked("<text/>"), plain),
        (marked("<text> \n</text>"), plain),
        (marked("<value>Default,0</value>"), plain),
    ] {
        assert_eq!(spaces("gate.pnml", gate(&part)), expected, "{part}");
    }
}

/// Two ways out of `low`, each of which says when it goes.
fn delayed(dock: &str, go: &str) -> String {
    let said = "<timed><value>true</value></timed><priority><value>7</value></priority>";
    let there = "<timed><value>true</value></timed><priority><value>1</value></priority>";
    battery(true, 7).replacen(said, dock, 1).replacen(there, go, 1)
}

#[test]
fn random_delays_are_left_out_where_that_is_asked_for() {
    let folder = Folder::new("special_random");
    let random = "<timed><value>true</value></timed>";
    let at_once = "<timed><value>false</value></timed>";
    let first = |it: &str| format!("{it}<priority><value>7</value></priority>");
    let rated = |it: &str| format!("<rate><value>2.5</value></rate>{it}");
    let any = "enabled transitions fire in any order";
    let ordered = "immediate ones before the";
    // Whether `flat` and whether `full` can be reached, and how many states there are.
    for (dock, go, flat, full, states, said) in [
        (random.to_owned(), random.to_owned(), 0, 0, "3", any),
        // Where all are random, priorities say nothing.
        (first(random), random.to_owned(), 0, 0, "3", any),
        (rated(random), rated(random), 0, 0, "3", any),
        ("<timed><text>true</text></timed>".to_owned(), random.to_owned(), 0, 0, "3", any),
        ("<timed><value>True</value></timed>".to_owned(), random.to_owned(), 0, 0, "3", any),
        (
            format!("<infiniteServer><value>true</value></infiniteServer>{random}"),
            random.to_owned(),
            0,
            0,
            "3",
            any,
        ),
        // Immediate transitions go before those with random delays, whatever these say.
        (random.to_owned(), at_once.to_owned(), 0, 1, "2", ordered),
        (first(random), at_once.to_owned(), 0, 1, "2", ordered),
        (rated(at_once), rated(random), 1, 0, "2", ordered),
    ] {
        folder.write("battery.xml", delayed(&dock, &go));
        for asked in ["EF flat", "EF full"] {
            let refused = folder.cotama(&["check", "battery.xml", "--property", asked]);
            assert_eq!(refused.code, Some(2), "{dock} {go}");
            assert!(refused.stderr.contains("--untimed leaves delays out"), "{}", refused.stderr);
        }
        for (asked, expected) in [("EF flat", flat), ("EF full", full)] {
            let line = ["check", "battery.xml", "--property", asked, "--untimed"];
            let untimed = folder.cotama(&line);
            assert_eq!(untimed.code, Some(expected), "{asked}: {dock} {go}");
            let note = untimed.stdout.contains("random delays are left out")
                && untimed.stdout.contains(said);
            assert!(note, "{}", untimed.stdout);
        }
        let space = folder.cotama(&["statespace", "battery.xml", "--untimed", "--json"]).json(0);
        assert_eq!(space["states"], states, "{dock} {go}");
    }
}
