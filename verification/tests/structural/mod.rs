//! The engine that looks at the structure of nets: textbook nets with known results, random nets
//! against a plain search, large nets, and the published nets of the Model Checking Contest.

mod contest;
mod flows;
mod large;
mod nets;
mod random;
mod siphons;
mod textbook;
