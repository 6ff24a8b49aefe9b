//! Discrete-event simulation of robot missions.
