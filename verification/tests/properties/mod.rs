//! Questions to a net: the language, the files of the Model Checking Contest, and the forms that
//! engines read.

mod contest;
mod fuzz;
mod language;
mod limits;
mod normal_forms;
pub(crate) mod oracle;
pub(crate) mod random;
mod round_trip;
