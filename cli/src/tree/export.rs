//! `cotama export` of a behaviour tree.

use super::{load, net, only, warn};
use crate::args::{DrawnAs, ExportArgs, Format};
use crate::exit::{Exit, Failure};
use crate::export::{put, written};
use crate::output::Screen;
use cotama_trees::export as write;
use cotama_trees::picture;
use cotama_trees::tree::{Kind, Tree};
use serde_json::{Value, json};

/// Writes a tree as a file.
pub(crate) fn export(args: &ExportArgs, format: Format, screen: &Screen) -> Result<Exit, Failure> {
    only(&[
        ("--semantics", args.semantics.is_some()),
        ("--net", args.net.is_some()),
        ("--style", args.style.is_some()),
    ])?;
    let loaded = load(&args.model.model, &args.tree)?;
    warn(&loaded, screen);
    let tree = &loaded.tree;
    let text = match format {
        Format::Svg => picture::svg(tree, None),
        Format::Dot => write::dot(tree),
        Format::Mermaid => write::mermaid(tree),
        Format::Btcpp => write::btcpp(tree),
        Format::Json => format!("{:#}\n", document(tree)),
        Format::Pnml | Format::Jani => {
            let net = net::of(tree, format)?;
            written(&net.view().net(), format, DrawnAs::Auto, screen)?
        }
        _ => {
            let message = "a behaviour tree is not written in this format";
            return Err(Failure::new(message)
                .help("formats of trees: svg, dot, mermaid, btcpp, json, pnml, jani"));
        }
    };
    put(&text, args.output.as_deref(), screen)?;
    Ok(Exit::Success)
}

/// Returns the tree as data: nodes in preorder, with parents from 1.
fn document(tree: &Tree) -> Value {
    let nodes: Vec<_> = tree
        .nodes
        .iter()
        .enumerate()
        .map(|(at, it)| {
            let ports = it.ports.iter().map(|it| (it.0.clone(), Value::from(it.1.as_str())));
            let scripts = write::scripts(it).into_iter();
            let scripts = scripts.map(|it| (it.0.to_owned(), Value::from(it.1)));
            let leaf = match it.kind {
                Kind::Leaf(kind) => Some(kind.word()),
                _ => None,
            };
            json!({
                "uid": at + 1,
                "parent": it.parent.map(|it| it + 1),
                "tag": it.tag,
                "name": it.name,
                "label": it.label,
                "leaf": leaf,
                "ports": ports.collect::<serde_json::Map<_, _>>(),
                "scripts": scripts.collect::<serde_json::Map<_, _>>(),
                "file": tree.files.get(it.place.file as usize),
                "line": it.place.line,
            })
        })
        .collect();
    json!({ "schema": "cotama/tree/1", "tree": tree.name, "nodes": nodes })
}
