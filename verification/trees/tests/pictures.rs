//! Pictures of random trees: nothing overlaps, nothing crosses.

use crate::maker::Maker;
use cotama_trees::picture::svg;
use cotama_trees::reader::read_text;

/// A rectangle: left, top, right, bottom. Lines are rectangles without width or height.
type Box = [i64; 4];

fn numbers(text: &str) -> Vec<i64> {
    let parts = text.split(|it: char| !it.is_ascii_digit() && it != '.');
    parts.filter_map(|it| it.parse().ok()).collect()
}

fn attribute(line: &str, name: &str) -> i64 {
    let from = line.find(&format!(" {name}=\"")).unwrap() + name.len() + 3;
    numbers(&line[from..])[0]
}

/// Returns boxes of nodes, boxes of their words, and lines: down, then to the right.
fn read(svg: &str) -> (Vec<Box>, Vec<Box>, Vec<[Box; 2]>) {
    let (mut nodes, mut words, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for line in svg.lines() {
        if line.starts_with("<path") {
            let [x, y, middle, to] = numbers(line.split("d=").nth(1).unwrap())[..] else {
                panic!("{line}")
            };
            lines.push([[x, y, x, middle], [x, middle, to, middle]]);
        } else if line.starts_with("<rect") {
            let [x, y, w, h] = ["x", "y", "width", "height"].map(|it| attribute(line, it));
            nodes.push([x, y, x + w, y + h]);
            let text = line.rsplit("<text").next().unwrap();
            let (x, y) = (attribute(text, "x"), attribute(text, "y"));
            let mut said = String::new();
            let mut within = false;
            for it in text.split_once('>').unwrap().1.chars() {
                match it {
                    '<' => within = true,
                    '>' => within = false,
                    it if !within => said.push(it),
                    _ => {}
                }
            }
            for sign in ["&quot;", "&lt;", "&gt;", "&amp;"] {
                said = said.replace(sign, ".");
            }
            words.push([x, y - 10, x + 8 * said.chars().count() as i64, y + 3]);
        }
    }
    (nodes, words, lines)
}

fn meet(a: &Box, b: &Box) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[test]
fn no_node_overlaps_and_no_line_crosses() {
    let mut maker = Maker::new("pictures");
    let mut largest = 0;
    for number in 0..300 {
        let text = maker.tree_of(2 + number % 11);
        let tree = read_text(&text).unwrap().tree;
        if tree.nodes.len() > 200 {
            continue;
        }
        largest = largest.max(tree.nodes.len());
        let letters = "SFRK-".repeat(40);
        let picture = svg(&tree, Some(&letters));
        let (nodes, words, lines) = read(&picture);
        assert_eq!((nodes.len(), lines.len()), (tree.nodes.len(), tree.nodes.len() - 1));
        let size = numbers(picture.split("viewBox=").nth(1).unwrap());
        let (width, height) = (size[2], size[3]);
        let all: Vec<_> = nodes.iter().chain(&words).collect();
        for (at, one) in all.iter().enumerate() {
            assert!(one[0] >= 0 && one[1] >= 0 && one[2] <= width && one[3] <= height, "{text}");
            assert!(all[at + 1..].iter().all(|it| !meet(one, it)), "{text}");
        }
        // A line may touch the nodes at its ends.
        let thick = |it: &Box| [it[0], it[1], it[2].max(it[0] + 1), it[3].max(it[1] + 1)];
        for [down, right] in &lines {
            for it in [down, right].map(thick) {
                assert!(all.iter().all(|one| !meet(&it, one)), "{text}");
            }
            // Only lines of one parent meet: they begin at one point.
            for [other, along] in &lines {
                let same = down[0] == other[0] && down[1] == other[1];
                assert!(same || !meet(&thick(down), &thick(along)), "{text}");
                assert!(same || !meet(&thick(down), &thick(other)), "{text}");
            }
        }
    }
    assert_eq!(largest, 182);
}
