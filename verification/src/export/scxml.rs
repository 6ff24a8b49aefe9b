//! SCXML, for nets that are state machines.
