//! Trees against traces of the library and a second program; the folder comes from COTAMA_BT_DIR.

#![allow(missing_docs, clippy::unwrap_used, clippy::pedantic)]

mod broken;
mod certificates;
mod facts;
mod families;
mod folder;
mod found;
mod maker;
mod mutants;
mod pictures;
mod plain;
mod random;
mod skips;
mod steered;
mod supervised;
mod traces;
