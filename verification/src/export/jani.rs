//! JANI, the exchange format of quantitative checkers.
