//! Measures how fast trees are explored: `speed FILE.xml ..`, or `speed parallel N`.

use cotama_trees::explore::{Assumptions, Limits, Space};
use cotama_trees::reader::{Options, read};
use std::time::Instant;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let text = |n: usize| {
        let child = |it| {
            format!("<RetryUntilSuccessful num_attempts=\"3\"><A{it}/></RetryUntilSuccessful>")
        };
        let children: String = (1..=n).map(child).collect();
        format!(
            "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\"><Parallel success_count=\"{n}\" \
             failure_count=\"1\">{children}</Parallel></BehaviorTree></root>"
        )
    };
    let (files, family) = match words.as_slice() {
        [word, n] if word == "parallel" => (vec!["tree.xml".to_owned()], n.parse().ok()),
        _ => (words.clone(), None),
    };
    let begun = Instant::now();
    for file in &files {
        let mut from = |path: &str| match family {
            Some(n) => Ok(text(n).into_bytes()),
            None => std::fs::read(path).map_err(|it| it.to_string()),
        };
        let loaded = match read(file, &mut from, &Options::default()) {
            Ok(loaded) => loaded,
            Err(refusal) => {
                println!("{refusal}");
                continue;
            }
        };
        let begun = Instant::now();
        let limits = Limits::default();
        let mut space = Space::explore(&loaded.tree, false, Assumptions::default(), limits);
        let explored = begun.elapsed().as_secs_f64();
        let facts = space.facts(&[]);
        println!(
            "{file}: {} states, {} questions, {} edges, {} MB, {explored:.3} s, facts {:.3} s, {}",
            facts.states,
            facts.questions,
            facts.edges,
            space.bytes() >> 20,
            begun.elapsed().as_secs_f64() - explored,
            if space.is_complete() { "complete" } else { "not complete" }
        );
    }
    println!("{:.3} s", begun.elapsed().as_secs_f64());
}
