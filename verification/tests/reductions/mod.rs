//! Structural reductions: each rule on its figure, all of them on random nets and on public ones.

mod figures;
mod net;
mod public;
mod random;
mod space;
