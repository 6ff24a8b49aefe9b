//! Robot missions as data.
#![cfg_attr(not(feature = "std"), no_std)]
