//! The engines of the checker, one module each, their front `check`, and the certificates of what
//! they find. One program: each links and compiles the library's generic code anew.

mod certificates;
mod check;
mod coverability;
mod forged;
mod numbered;
mod properties;
mod reductions;
mod special;
mod statespace;
mod structural;
mod stubborn;
mod team;
mod temporal;
mod tpn;
