//! The readers of the program itself, for fuzz targets: the other readers are in libraries.

use crate::allocate::instance;
use crate::campaign::mutants;
use crate::simulate::step;
use cotama_fuzz::Reader;

/// All of them: instances of `allocate`, scripts of `simulate`, the two files of a campaign.
pub const ALL: [Reader; 4] =
    [instance::mutants::READER, step::mutants::READER, mutants::CAMPAIGNS, mutants::RUNS];
