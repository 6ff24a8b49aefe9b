//! Broken PNML files of many kinds: exit code 2 and the place in the file, whatever the command and
//! however little memory there is. What is said about each kind is tested where PNML is read.

use crate::common::Folder;

/// In place of a place: the file as a whole is none that is read.
const WHOLE: &str = "";

/// A page with places `p` and `q` and transitions `t` and `u`, and more from line 5 on.
fn page(more: &str) -> String {
    format!(
        "<pnml>\n<net id=\"n\" type=\"http://www.pnml.org/version-2009/grammar/ptnet\">\n\
         <page id=\"page\">\n\
         <place id=\"p\"/><place id=\"q\"/><transition id=\"t\"/><transition id=\"u\"/>\n{more}\n\
         </page>\n</net>\n</pnml>\n"
    )
}

fn marking(tokens: &str) -> String {
    page(&format!("<place id=\"r\"><initialMarking><text>{tokens}</text></initialMarking></place>"))
}

fn weight(weight: &str) -> String {
    page(&format!(
        "<arc id=\"a\" source=\"p\" target=\"t\"><inscription><text>{weight}</text></inscription>\
         </arc>"
    ))
}

fn bomb() -> String {
    let doubled = |level: usize| format!("<!ENTITY e{} \"&e{level};&e{level};\">\n", level + 1);
    let entities: String = (0..64).map(doubled).collect();
    format!("<!DOCTYPE pnml [\n<!ENTITY e0 \"ha\">\n{entities}]>\n<pnml><net id=\"&e64;\"/></pnml>")
}

fn nested(pages: usize) -> String {
    let (open, closed) = ("<page>".repeat(pages), "</page>".repeat(pages));
    format!("<pnml><net>{open}{closed}</net></pnml>")
}

/// Each file, its name, and the line and the column of what is wrong first.
fn broken() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let latin1 = page("<place id=\"T\u{fc}r\"/>").chars().map(|c| c as u8).collect();
    let texts = [
        ("empty", String::new(), WHOLE),
        ("plain_text", "net {Kanban}\ntr t1 p1 -> p2\n".to_owned(), "1:1"),
        ("web_page", "<!DOCTYPE html>\n<html><body>Not found</body></html>\n".to_owned(), WHOLE),
        ("cut", page("<place id=\"r\"").lines().take(5).collect::<Vec<_>>().join("\n"), "5:1"),
        ("not_closed", page("<place id=\"r\">"), "6:1"),
        ("control_character", page("<place id=\"\u{7}\"/>"), "5:12"),
        ("entity_bomb", bomb(), "1:1"),
        ("nested", nested(1_000_000), "1:1536"),
        ("encoding", "<?xml version=\"1.0\" encoding=\"EBCDIC-FR\"?>\n<pnml/>".to_owned(), "1:31"),
        ("no_net", "<pnml>\n</pnml>".to_owned(), "1:1"),
        ("two_nets", "<pnml>\n<net id=\"a\"/>\n<net id=\"b\"/>\n</pnml>".to_owned(), "3:1"),
        ("coloured", page("<place id=\"r\"><hlinitialMarking/></place>"), "5:15"),
        ("no_id", page("<place/>"), "5:1"),
        ("id_twice", page("<place id=\"p\"/>"), "5:12"),
        ("negative_tokens", marking("-1"), "5:37"),
        ("huge_tokens", marking("4294967296"), "5:37"),
        ("enormous_tokens", marking(&"9".repeat(100_000)), "5:37"),
        ("arc_to_nowhere", page("<arc id=\"a\" source=\"p\" target=\"T\"/>"), "5:32"),
        ("arc_between_places", page("<arc id=\"a\" source=\"p\" target=\"q\"/>"), "5:1"),
        ("no_weight", weight("0"), "5:54"),
        ("negative_weight", weight("-2"), "5:54"),
        ("huge_weight", weight("5000000000"), "5:54"),
        ("flush", page("<arc id=\"a\" source=\"p\" target=\"t\" type=\"flush\"/>"), "5:41"),
        ("negated", page("<arc id=\"a\" source=\"p\" target=\"t\"><negated/></arc>"), "5:35"),
        ("guard", page("<transition id=\"v\" guard=\"x > 0\"/>"), "5:27"),
        ("circle", page("<referencePlace id=\"r\" ref=\"r\"/>"), "5:29"),
    ];
    let texts = texts.into_iter().map(|(name, text, place)| (name, text.into_bytes(), place));
    let others = [
        ("compressed", b"\x1f\x8b\x08\0\0".to_vec(), WHOLE),
        ("program", b"\x7fELF\x02\x01\x01\0\0\0".to_vec(), WHOLE),
        ("latin1", latin1, "5:13"),
    ];
    texts.chain(others).collect()
}

#[test]
fn every_command_refuses_every_broken_file_at_its_place() {
    let folder = Folder::new("broken_pnml");
    let broken = broken();
    assert_eq!(broken.len(), 29);
    for (name, bytes, place) in broken {
        let file = format!("{name}.pnml");
        folder.write(&file, bytes);
        for command in [
            format!("models {file} --json"),
            format!("simulate {file}"),
            format!("export {file} -o it.svg"),
            format!("check {file} --json"),
            format!("statespace {file} --mcc"),
        ] {
            let ended = folder.shell(&format!("ulimit -v 500000; cotama {command}"));
            if command.ends_with("--json") {
                let error = ended.json(2);
                assert_eq!(error["file"], file.as_str(), "{command}");
                let said = format!("{}:{}", error["line"], error["column"]);
                assert_eq!(said, if place == WHOLE { "null:null" } else { place }, "{command}");
                continue;
            }
            assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{command}: {ended:?}");
            if place == WHOLE {
                assert!(ended.stderr.contains(&format!("{file}: this is ")), "{}", ended.stderr);
                continue;
            }
            let first = ended.stderr.split(&format!("{file}:")).nth(1).unwrap_or_default();
            let there = first.split(|c: char| !c.is_ascii_digit() && c != ':').next();
            assert_eq!(
                there.map(|it| it.trim_end_matches(':')),
                Some(place),
                "{command}: {}",
                ended.stderr
            );
        }
        std::fs::remove_file(folder.path().join(file)).unwrap();
    }
    assert_eq!(folder.files(""), [""; 0]);
}
