//! Behaviour selection and behaviour control of ACE, the Autonomous City Explorer.
//!
//! On 31 August 2008 a robot went 1.5 km through Munich, from the university to Marienplatz,
//! without a map, by asking 38 passers-by. F. Rohrmueller's dissertation (TU Muenchen 2011,
//! appendix B) prints how it chose what to do: subsystems *trigger* behaviours, a priority check
//! accepts or refuses them, and a control loop of 2 Hz checks every waypoint of the active one and
//! gives up after too many failed trials.
//!
//! Here it is as four nets, which stand alone and are made to be composed:
//!
//! | net | what it decides |
//! | --- | --- |
//! | [`request`] | what a subsystem that asks is told; one net for each subsystem |
//! | [`selection`] | which subsystem's behaviour is active |
//! | [`behaviour`] | which of the five behaviours that is, and whether the path planner runs |
//! | [`accuracy`] | whether the active behaviour succeeds, how strictly that is checked |
//!
//! What is marked *print* in the documentation of a net stands in the dissertation; what is marked
//! *reading* is our interpretation, or completes what is not said there.

pub mod accuracy;
pub mod behaviour;
pub mod request;
pub mod robot;
pub mod selection;
