//! Nets in and out: PNML, exchange formats, drawings and what a person sees of a verdict.

mod diagnosis;
mod drawings;
mod examples;
mod exports;
mod flat;
mod pnml_broken;
mod pnml_kinds;
mod pnml_public;
mod pnml_read;
mod pnml_round_trip;
