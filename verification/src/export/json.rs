//! The whole net as JSON.
